//! A shape as the slice sees it: its convex pieces ready to be cut, how far they reach, and the lines of its wireframe.

use hyperbody::geometry::{Solid, Surface};
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::Shape;

use crate::cut::{Cutter, Drawn, Section};
use crate::mesh::{Mesh, single};
use crate::round::{self, CapsuleSection};
use crate::view::{View, seen};

/// A convex piece in the frame of its body.
#[derive(Clone, Debug)]
enum Piece<const N: usize> {
    Solid(Solid<N>),
    /// A capsule about the origin from −`half` to `half`, whose sections have a closed form.
    Capsule {
        half: Vector<N>,
        radius: f64,
    },
}

/// What is drawn of all bodies of one shape.
#[derive(Clone, Debug)]
pub(crate) struct Drawable<const N: usize> {
    /// With the number of the first cell of each.
    pieces: Vec<(u32, Piece<N>)>,
    /// Ends of the segments of the wireframe, two and two, in the frame of the body.
    wires: Vec<Vector<N>>,
    /// The whole body in its own coordinates, where a world has no more dimensions than are drawn.
    whole: Mesh,
}

impl<const N: usize> Drawable<N>
where
    Solid<N>: Drawn<N>,
{
    pub(crate) fn new(shape: &Shape<N>, cutter: &mut Cutter) -> Self {
        let mut pieces = Vec::new();
        if let Shape::Capsule { half_length, radius, along } = shape {
            pieces.push((0, Piece::Capsule { half: Vector::unit(*along) * *half_length, radius: *radius }));
        } else {
            let mut first = 0;
            for solid in shape.solids() {
                let cells =
                    if let Solid::Polytope(polytope) = &solid { polytope.facet_sources().len() as u32 } else { 1 };
                pieces.push((first, Piece::Solid(solid)));
                first += cells;
            }
        }
        let wires = pieces.iter().flat_map(|(_, piece)| piece.wires()).collect();
        let mut drawable = Self { pieces, wires, whole: Mesh::default() };
        if N <= 3 {
            drawable.draw_whole(cutter);
        }
        drawable
    }

    fn draw_whole(&mut self, cutter: &mut Cutter) {
        for (first, piece) in &self.pieces {
            match piece {
                Piece::Solid(solid) => {
                    if let Some(section) = solid.whole() {
                        cutter.draw(section, *first, true, &mut self.whole);
                    }
                }
                Piece::Capsule { half, radius } => {
                    capsule(half, *radius, &Pose::IDENTITY, N, cutter, true, &mut self.whole);
                }
            }
        }
    }

    /// The half-space that the body is, as normal and offset in its frame.
    pub(crate) fn half_space(&self) -> Option<(Vector<N>, f64)> {
        self.pieces.iter().find_map(|(_, piece)| match piece {
            Piece::Solid(Solid::HalfSpace { normal, offset }) => Some((*normal, *offset)),
            _ => None,
        })
    }

    /// From where to where the body reaches along slice axis `axis`, measured from the slice.
    pub(crate) fn extent(&self, body_from_slice: &Pose<N>, axis: usize) -> [f64; 2] {
        let direction = body_from_slice.rotation.matrix().column(axis);
        let start = direction.dot(body_from_slice.translation);
        let reach = |d: Vector<N>| self.pieces.iter().map(|(_, p)| p.reach(d)).fold(f64::NEG_INFINITY, f64::max);
        [-reach(-direction) - start, reach(direction) - start]
    }

    /// Adds the section of the body at `world_from_body`.
    pub(crate) fn draw(
        &self,
        world_from_body: &Pose<N>,
        view: &View<N>,
        cutter: &mut Cutter,
        fine: bool,
        mesh: &mut Mesh,
    ) {
        if view.drawn == N {
            let slice_from_body = view.pose.relative(world_from_body);
            let row = |axis: usize| {
                if axis < N { seen(slice_from_body.rotation.matrix().row(axis), N) } else { Vector::unit(2) }
            };
            mesh.add_placed(&self.whole, [row(0), row(1), row(2)], seen(slice_from_body.translation, N));
            return;
        }
        let frame = view.frame_in(world_from_body);
        for (first, piece) in &self.pieces {
            match piece {
                Piece::Solid(solid) => solid.cut_down(&frame, view.drawn, cutter, &mut |section, cutter| {
                    cutter.draw(section, *first, fine, mesh);
                }),
                Piece::Capsule { half, radius } => {
                    capsule(half, *radius, frame.space_from_slice(), view.drawn, cutter, fine, mesh);
                }
            }
        }
    }

    /// Adds the section to a surface for files, as number `source`. Curved pieces within `tolerance`, m.
    pub(crate) fn export(
        &self,
        world_from_body: &Pose<N>,
        view: &View<N>,
        cutter: &mut Cutter,
        (tolerance, source): (f64, u32),
        surface: &mut Surface,
    ) {
        let frame = view.frame_in(world_from_body);
        let slice_from_body = view.pose.relative(world_from_body);
        for (_, piece) in &self.pieces {
            let as_solid = piece.solid();
            let mut add = |section: Section<'_>, place: &Pose<3>| {
                if let Section::Three(solid) = section
                    && let Ok(Some(polytope)) = solid.to_polytope(tolerance)
                {
                    surface.add_polytope(&polytope.with_source(0).placed(place), source);
                }
            };
            if view.drawn == N {
                let place = three_dimensional(&slice_from_body);
                if let (Some(section), Some(place)) = (as_solid.whole(), place) {
                    add(section, &place);
                }
            } else {
                as_solid.cut_down(&frame, view.drawn, cutter, &mut |section, _| add(section, &Pose::IDENTITY));
            }
        }
    }

    /// Adds the wireframe: ends of segments in slice coordinates, and the off coordinate of each.
    pub(crate) fn add_wires(
        &self,
        world_from_body: &Pose<N>,
        view: &View<N>,
        lines: &mut Vec<f32>,
        off: &mut Vec<f32>,
    ) {
        let slice_from_body = view.pose.relative(world_from_body);
        for &end in &self.wires {
            let coordinates = slice_from_body.transform_point(end);
            lines.extend(single(seen(coordinates, view.drawn)));
            off.push(signed_off(coordinates, view.drawn) as f32);
        }
        for (_, piece) in &self.pieces {
            let (ends, radius) = match piece {
                Piece::Solid(Solid::Ball { centre, radius }) => ([*centre; 2], *radius),
                Piece::Capsule { half, radius } => ([-*half, *half], *radius),
                Piece::Solid(_) => continue,
            };
            let count = if ends[0] == ends[1] { 1 } else { 2 };
            for &end in &ends[..count] {
                let coordinates = slice_from_body.transform_point(end);
                let (centre, height) = (seen(coordinates, view.drawn), signed_off(coordinates, view.drawn) as f32);
                for (i, j) in [(0, 1), (1, 2), (2, 0)].into_iter().take(if view.drawn == 3 { 3 } else { 1 }) {
                    let at = |u: Vector<2>| centre + (Vector::unit(i) * u[0] + Vector::unit(j) * u[1]) * radius;
                    let around: Vec<Vector<3>> = round::circle().map(at).collect();
                    for (index, &point) in around.iter().enumerate() {
                        lines.extend(single(point));
                        lines.extend(single(around[(index + 1) % around.len()]));
                        off.extend([height; 2]);
                    }
                }
            }
        }
    }
}

impl<const N: usize> Piece<N> {
    fn reach(&self, direction: Vector<N>) -> f64 {
        match self {
            Self::Solid(solid) => solid.reach(direction),
            Self::Capsule { half, radius } => half.dot(direction).abs() + radius * direction.norm(),
        }
    }

    fn solid(&self) -> Solid<N> {
        match self {
            Self::Solid(solid) => solid.clone(),
            Self::Capsule { half, radius } => {
                let convex = hyperbody::geometry::Convex {
                    core: hyperbody::geometry::Core::Segment { half: *half },
                    radius: *radius,
                };
                Solid::Curved(std::sync::Arc::new(convex))
            }
        }
    }

    /// Edges of polytopes; for other curved bodies those of a rough polytope, up to the dimension where that is cheap.
    fn wires(&self) -> Vec<Vector<N>> {
        let rough = match self {
            Self::Solid(Solid::Polytope(polytope)) => Some(polytope.clone()),
            Self::Solid(curved @ Solid::Curved(_)) if N <= 4 => {
                let size = (0..N).map(|axis| curved.reach(Vector::unit(axis))).fold(0.0, f64::max);
                curved.to_polytope(ROUGHNESS * size).ok().flatten()
            }
            Self::Capsule { half, .. } => return vec![-*half, *half],
            Self::Solid(_) => None,
        };
        let Some(polytope) = rough else { return Vec::new() };
        let ends = polytope.faces(1).flat_map(|ends| ends.iter().map(|&end| polytope.vertices()[end as usize]));
        ends.collect()
    }
}

/// Tolerance of the wireframe of curved bodies, in parts of their size.
const ROUGHNESS: f64 = 0.1;

/// Adds the section of a capsule about the origin of the frame `body_from_slice` is in.
fn capsule<const N: usize>(
    half: &Vector<N>,
    radius: f64,
    body_from_slice: &Pose<N>,
    drawn: usize,
    cutter: &Cutter,
    fine: bool,
    mesh: &mut Mesh,
) {
    let middle = body_from_slice.inverse_transform_point(Vector::ZERO);
    let along = body_from_slice.rotation.inverse_rotate(*half);
    let off = |f: &dyn Fn(usize) -> f64| (drawn..N).map(f).sum::<f64>();
    let (room, slope, rise_sq) = (
        radius * radius - off(&|k| middle[k] * middle[k]),
        off(&|k| middle[k] * along[k]),
        off(&|k| along[k] * along[k]),
    );
    if drawn == 3 {
        let section = CapsuleSection { middle: seen(middle, 3), along: seen(along, 3), room, slope, rise_sq };
        if let Some(range) = section.range() {
            cutter.sphere(fine).add_body(|u| section.support(u, range), 0, mesh);
        }
    } else {
        let flat = |v: Vector<N>| Vector([v[0], v[1]]);
        let section = CapsuleSection { middle: flat(middle), along: flat(along), room, slope, rise_sq };
        if let Some(range) = section.range() {
            round::add_flat(|u| section.support(u, range), 0, mesh);
        }
    }
}

/// The distance from the slice, with the sign of the first off coordinate that is not zero; 0 where all is drawn.
pub(crate) fn signed_off<const N: usize>(coordinates: Vector<N>, drawn: usize) -> f64 {
    let off = (drawn..N).map(|axis| coordinates[axis]);
    if drawn + 1 == N {
        return coordinates[drawn];
    }
    let length = off.clone().map(|c| c * c).sum::<f64>().sqrt();
    let negative = off.into_iter().find(|&c| c != 0.0).is_some_and(|c| c < 0.0);
    if negative { -length } else { length }
}

/// The pose of three dimensions that this one is, if it is.
fn three_dimensional<const N: usize>(pose: &Pose<N>) -> Option<Pose<3>> {
    if N != 3 {
        return None;
    }
    let m = pose.rotation.matrix();
    let matrix = hyperbody::math::Matrix::from_fn(|i, j| m[i][j]);
    let rotation = hyperbody::math::Rotation::from_matrix(matrix)?;
    Some(Pose::new(rotation, seen(pose.translation, 3)))
}
