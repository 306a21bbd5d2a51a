//! What there is to see: a world at one moment, cut by a slice.

use hyperbody::collision::ray::{Ray, RayHit};
use hyperbody::collision::{DynamicTree, RayStack};
use hyperbody::geometry::Aabb;
use hyperbody::geometry::shape::Piece;
use hyperbody::math::{Pose, Vector};
use hyperbody::prelude::BodyKind;

use crate::bodies::Bodies;
use crate::colour::{self, Rgb};
use crate::slice::Slice;
use crate::solid::{self, Solid};

/// Everything that rays of a picture can meet, in slice coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Stage<const N: usize> {
    /// Bodies that the slice cuts.
    pub(crate) cut: Solids<N>,
    /// Bodies beside the slice, each shown by its section through its own middle.
    pub(crate) ghosts: Solids<N>,
    pub(crate) planes: Vec<Plane>,
    pub(crate) bodies: Vec<BodyLook>,
    /// Against gravity, unit; the second direction of the slice if there is none.
    pub(crate) up: Vector<3>,
    /// Typical size of a body, m.
    pub(crate) size: f64,
    /// How far bodies reach from their middle, m: what "far away" means.
    pub(crate) spread: f64,
    /// Between the lines on floors and walls, m.
    pub(crate) mesh: f64,
    /// Height of the highest floor along `up`, m; 0 without one.
    pub(crate) floor_height: f64,
    pub(crate) tones: Tones,
}

/// Colours of what is no body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tones {
    pub(crate) floor: Rgb,
    pub(crate) lines: Rgb,
    pub(crate) wall: Rgb,
}

/// Pieces and the tree of their sections' bounds.
#[derive(Clone, Debug)]
pub(crate) struct Solids<const N: usize> {
    pub(crate) solids: Vec<Solid<N>>,
    tree: DynamicTree<3>,
}

/// The section of a half-space: normal·x ≤ offset is solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    /// Unit.
    pub(crate) normal: Vector<3>,
    pub(crate) offset: f64,
    /// Things stand on it.
    pub(crate) is_floor: bool,
}

/// What a body's look depends on besides its shape.
#[derive(Clone, Debug)]
pub(crate) struct BodyLook {
    pub(crate) kind: BodyKind,
    pub(crate) colour: Rgb,
    /// As glass beside the slice: its tint tells the direction.
    pub(crate) glass: Rgb,
    /// Whether the slice cuts it.
    pub(crate) is_cut: bool,
    /// The intervals that it takes up along the hidden directions; `None` for half-spaces.
    pub(crate) hidden_extents: Option<Vec<[f64; 2]>>,
    /// Middle in slice coordinates, hidden ones included.
    pub(crate) middle: Vec<f64>,
    /// Largest distance of a point of the body from the origin of its frame, m.
    pub(crate) radius: f64,
}

/// How far beside the slice bodies are still shown as ghosts, in typical sizes of a body.
pub(crate) const GHOST_REACH: f64 = 0.75;

impl BodyLook {
    /// The middle, without hidden coordinates.
    pub(crate) fn seen_middle(&self) -> Vector<3> {
        Vector::from_fn(|i| self.middle.get(i).copied().unwrap_or(0.0))
    }

    /// Distance from the slice along the hidden directions, m; `None` for half-spaces.
    pub(crate) fn gap(&self) -> Option<f64> {
        let extents = self.hidden_extents.as_ref()?;
        Some(extents.iter().map(|[low, high]| low.max(-high).max(0.0)).map(|gap| gap * gap).sum::<f64>().sqrt())
    }
}

impl<const N: usize> Solids<N> {
    fn new() -> Self {
        Self { solids: Vec::new(), tree: DynamicTree::new() }
    }

    fn add(&mut self, solid: Solid<N>, bounds: Aabb<3>) {
        self.tree.insert(bounds, self.solids.len() as u32);
        self.solids.push(solid);
    }

    /// The first surface that a ray meets from outside, by number and in the frame of the solid. A solid that it may well
    /// meet, by number, shortens the search.
    #[inline]
    pub(crate) fn first_hit(&self, ray: &Ray<3>, guess: u32, stack: &mut RayStack) -> Option<(u32, RayHit<N>)> {
        let guessed = self.solids.get(guess as usize).and_then(|solid| solid.cast(ray, ray.max_fraction));
        let mut first = guessed.filter(|hit| !hit.inside).map(|hit| (guess, hit));
        let ray = first.map_or(*ray, |(_, hit)| ray.up_to(hit.fraction));
        self.tree.cast_ray(&ray, stack, |index, reach| {
            if index == guess && first.is_some() {
                return Some(reach);
            }
            let Some(hit) = self.solids[index as usize].cast(&ray, reach) else { return Some(reach) };
            if hit.inside {
                return Some(reach);
            }
            if first.is_none_or(|(other, best)| (hit.fraction, index) < (best.fraction, other)) {
                first = Some((index, hit));
            }
            Some(hit.fraction)
        });
        first
    }

    /// Every surface that a ray meets from outside, by fraction and number.
    pub(crate) fn all_hits(&self, ray: &Ray<3>, stack: &mut RayStack, out: &mut Vec<(u32, RayHit<N>)>) {
        out.clear();
        self.tree.cast_ray(ray, stack, |index, reach| {
            let hit = self.solids[index as usize].cast(ray, reach).filter(|hit| !hit.inside);
            out.extend(hit.map(|hit| (index, hit)));
            Some(reach)
        });
        out.sort_unstable_by(|a, b| a.1.fraction.total_cmp(&b.1.fraction).then(a.0.cmp(&b.0)));
    }

    /// Whether a ray meets anything. What stood in the way of the last ray is tried first, and what does now is noted.
    #[inline]
    pub(crate) fn blocks(&self, ray: &Ray<3>, blocker: &mut u32, stack: &mut RayStack) -> bool {
        if let Some(solid) = self.solids.get(*blocker as usize)
            && solid.cast(ray, ray.max_fraction).is_some()
        {
            return true;
        }
        let mut blocked = false;
        self.tree.cast_ray(ray, stack, |index, reach| {
            blocked = self.solids[index as usize].cast(ray, reach).is_some();
            if blocked {
                *blocker = index;
            }
            (!blocked).then_some(reach)
        });
        blocked
    }
}

impl<const N: usize> Stage<N> {
    pub(crate) fn new(bodies: &Bodies<N>, slice: &Slice<N>) -> Self {
        let against_gravity = slice.pose().rotation.inverse_rotate(-bodies.gravity);
        let mut stage = Self {
            cut: Solids::new(),
            ghosts: Solids::new(),
            planes: Vec::new(),
            bodies: Vec::new(),
            up: Slice::seen(against_gravity).try_normalize().unwrap_or(Vector::unit(1)),
            size: 1.0,
            spread: 1.0,
            mesh: 1.0,
            floor_height: 0.0,
            tones: Tones {
                floor: Rgb::from_hex(0xCBC9C5),
                lines: Rgb::from_hex(0x7C8798),
                wall: Rgb::from_hex(0xBFD4EE),
            },
        };
        let mut sizes = Vec::new();
        let mut numbers = [0_u32; 2];
        for body in &bodies.all {
            let number = &mut numbers[usize::from(body.kind == BodyKind::Dynamic)];
            let body_from_slice = body.pose.relative(slice.pose());
            let middle: Vec<f64> = slice.coordinates(body.centre()).iter().collect();
            let mut look = BodyLook {
                kind: body.kind,
                colour: body.colour.map_or_else(
                    || {
                        if body.kind == BodyKind::Dynamic {
                            colour::of_body(*number)
                        } else {
                            colour::of_fixture(*number)
                        }
                    },
                    Rgb::from_srgb,
                ),
                glass: colour::of_side(middle.get(3..).unwrap_or(&[])).mix(Rgb::WHITE, 0.12),
                is_cut: false,
                hidden_extents: None,
                middle,
                radius: 0.0,
            };
            let mut is_solid = false;
            for (part, (body_from_piece, piece)) in body.shape.pieces().into_iter().enumerate() {
                let piece_from_slice = body_from_piece.inverse() * body_from_slice;
                match &piece {
                    Piece::HalfSpace { normal, offset } => stage.add_plane(*normal, *offset, &piece_from_slice),
                    Piece::Convex(convex) => {
                        is_solid = true;
                        if body.kind == BodyKind::Dynamic {
                            sizes.push(convex.bounding_radius());
                        }
                        look.radius = look.radius.max(body_from_piece.translation.norm() + convex.bounding_radius());
                        note_extents(&mut look, convex, &piece_from_slice);
                        stage.add_piece(&mut look, part as u32, piece, &piece_from_slice);
                    }
                }
            }
            if is_solid {
                *number += 1;
            }
            stage.bodies.push(look);
        }
        sizes.sort_unstable_by(f64::total_cmp);
        stage.size = sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
        stage.mesh = mesh(stage.size);
        stage.measure();
        stage.add_ghosts(bodies, slice);
        stage.cut.tree.rebuild();
        stage.ghosts.tree.rebuild();
        stage
    }

    /// Sets what depends on where the bodies are.
    fn measure(&mut self) {
        let moving = self.bodies.iter().filter(|look| look.kind == BodyKind::Dynamic);
        let middles: Vec<Vector<3>> = moving.map(BodyLook::seen_middle).collect();
        let mean = middles.iter().fold(Vector::ZERO, |sum, &middle| sum + middle) / middles.len().max(1) as f64;
        let mut away: Vec<f64> = middles.iter().map(|middle| middle.distance(mean)).collect();
        away.sort_unstable_by(f64::total_cmp);
        self.spread = away.get(away.len() * 19 / 20).copied().unwrap_or(self.size).max(self.size);
        let heights = self.planes.iter().filter(|plane| plane.is_floor).map(|plane| plane.offset);
        self.floor_height = heights.reduce(f64::max).unwrap_or(0.0);
    }

    fn add_plane(&mut self, normal: Vector<N>, offset: f64, piece_from_slice: &Pose<N>) {
        if let SlicePlane::Across { normal, offset } = slice_plane(normal, offset, piece_from_slice) {
            self.planes.push(Plane { normal, offset, is_floor: normal.dot(self.up) > 0.5 });
        }
    }

    fn add_piece(&mut self, look: &mut BodyLook, part: u32, piece: Piece<N>, piece_from_slice: &Pose<N>) {
        let Piece::Convex(convex) = &piece else { return };
        if let Some(bounds) = solid::section_bounds(convex, piece_from_slice) {
            look.is_cut = true;
            let body = self.bodies.len() as u32;
            self.cut.add(Solid::new(body, part, piece, piece_from_slice), bounds);
        }
    }

    /// Bodies that the slice does not cut, seen as if it went through their middles.
    fn add_ghosts(&mut self, bodies: &Bodies<N>, slice: &Slice<N>) {
        for (index, body) in bodies.all.iter().enumerate() {
            let look = &self.bodies[index];
            if look.is_cut || look.gap().is_none_or(|gap| gap > GHOST_REACH * self.size) {
                continue;
            }
            let hidden = Vector::from_fn(|i| if i < Slice::<N>::SEEN { 0.0 } else { look.middle[i] });
            let through_middle = Pose::new(slice.pose().rotation, slice.pose().transform_point(hidden));
            let body_from_slice = body.pose.relative(&through_middle);
            for (part, (body_from_piece, piece)) in body.shape.pieces().into_iter().enumerate() {
                let piece_from_slice = body_from_piece.inverse() * body_from_slice;
                let Piece::Convex(convex) = &piece else { continue };
                if let Some(bounds) = solid::section_bounds(convex, &piece_from_slice) {
                    self.ghosts.add(Solid::new(index as u32, part as u32, piece, &piece_from_slice), bounds);
                }
            }
        }
    }
}

/// The mesh of the grid beside bodies of a size: 1 m, or the power of ten of which the bodies are ten at most. Lines are as wide
/// as bodies ask for, and would leave no floor between them if the mesh stayed.
fn mesh(size: f64) -> f64 {
    let mut mesh = 1.0;
    while size > 10.0 * mesh && mesh < MOST_MESH {
        mesh *= 10.0;
    }
    mesh
}

/// The widest mesh, m.
const MOST_MESH: f64 = 1e15;

/// What the slice has of the boundary of a half-space.
pub(crate) enum SlicePlane {
    /// A plane across it: normal·x = offset, in slice coordinates.
    Across { normal: Vector<3>, offset: f64 },
    /// Nothing nearby: they run along each other, and the slice is so high above the solid, m.
    Along { height: f64 },
}

/// The boundary of the half-space normal·p ≤ offset, in the frame of the piece, as the slice has it.
pub(crate) fn slice_plane<const N: usize>(normal: Vector<N>, offset: f64, piece_from_slice: &Pose<N>) -> SlicePlane {
    let seen = Slice::seen(piece_from_slice.rotation.inverse_rotate(normal));
    let length = seen.norm();
    let below = offset - normal.dot(piece_from_slice.translation);
    // Nearly parallel to the slice: it is met far away or never.
    if length > 1e-6 {
        SlicePlane::Across { normal: seen / length, offset: below / length }
    } else {
        SlicePlane::Along { height: -below }
    }
}

/// Widens the intervals along the hidden directions by those of a piece.
fn note_extents<const N: usize>(
    look: &mut BodyLook,
    convex: &hyperbody::geometry::Convex<N>,
    piece_from_slice: &Pose<N>,
) {
    let own: Vec<[f64; 2]> =
        (Slice::<N>::SEEN..N).map(|hidden| solid::extent(convex, piece_from_slice, hidden)).collect();
    match &mut look.hidden_extents {
        Some(extents) => {
            for (extent, own) in extents.iter_mut().zip(own) {
                *extent = [extent[0].min(own[0]), extent[1].max(own[1])];
            }
        }
        None => look.hidden_extents = Some(own),
    }
}
