//! One view of boxes, polytopes, segments and points: facets, their planes, vertices and neighbours.
//!
//! Facets of a box are numbered 2i for +e_i and 2i + 1 for −e_i.

use hyperbody_geometry::{Core, Polytope};
use hyperbody_math::{Pose, Vector};

use crate::clip::Clipper;
use crate::limits;

/// Stands for no facet.
pub(crate) const NO_FACET: u32 = u32::MAX;

/// A core as its facets. All in the frame of the core.
#[derive(Clone, Copy)]
pub(crate) enum Faces<'a, const N: usize> {
    Box(&'a Vector<N>),
    Polytope(&'a Polytope<N>),
    Segment(&'a Vector<N>),
    Point,
}

impl<'a, const N: usize> Faces<'a, N> {
    pub(crate) fn of(core: &'a Core<N>) -> Self {
        match core {
            Core::Point => Self::Point,
            Core::Segment { half } => Self::Segment(half),
            Core::Box { half_extents } => Self::Box(half_extents),
            Core::Polytope(polytope) => Self::Polytope(polytope),
        }
    }

    /// The facet at the farthest vertex in `direction` whose normal is most aligned with it, with the cosine for a
    /// unit direction; `previous` if that is as good to a small tolerance. `None` for segments and points.
    pub(crate) fn facet_toward(&self, direction: Vector<N>, previous: u32) -> Option<(usize, f64)> {
        let best = match self {
            Self::Box(_) => {
                let along = direction.axis_of_max_abs();
                (2 * along + usize::from(direction[along] < 0.0), direction[along].abs())
            }
            Self::Polytope(polytope) => {
                let vertex = polytope.support_vertex(direction);
                let facets = polytope.facets_of_vertex(vertex);
                let cosine = |facet: u32| polytope.facets()[facet as usize].normal.dot(direction);
                let mut best = (*facets.first()? as usize, f64::NEG_INFINITY);
                for &facet in facets {
                    if cosine(facet) > best.1 {
                        best = (facet as usize, cosine(facet));
                    }
                }
                let height = polytope.vertices()[vertex].dot(direction);
                if facets.binary_search(&previous).is_err() && !reaches(polytope, previous, direction, height) {
                    return Some(best);
                }
                best
            }
            Self::Segment(_) | Self::Point => return None,
        };
        let cosine = self.cosine(previous, direction);
        let stays = cosine.is_some_and(|cosine| cosine >= best.1 - limits::REFERENCE_PREFERENCE);
        Some(if stays { (previous as usize, cosine.unwrap_or(best.1)) } else { best })
    }

    /// Normal of a facet times a direction; `None` if there is no such facet.
    fn cosine(&self, facet: u32, direction: Vector<N>) -> Option<f64> {
        match self {
            Self::Box(_) if (facet as usize) < 2 * N => Some(box_normal::<N>(facet as usize).dot(direction)),
            Self::Polytope(polytope) => polytope.facets().get(facet as usize).map(|facet| facet.normal.dot(direction)),
            _ => None,
        }
    }

    /// Outward unit normal and offset of a facet.
    pub(crate) fn plane(&self, facet: usize) -> (Vector<N>, f64) {
        match self {
            Self::Box(half_extents) => (box_normal(facet), half_extents[facet / 2]),
            Self::Polytope(polytope) => (polytope.facets()[facet].normal, polytope.facets()[facet].offset),
            Self::Segment(_) | Self::Point => (Vector::ZERO, 0.0),
        }
    }

    /// Calls `f` with number, normal and offset of every facet that shares a ridge with `facet`, in a fixed order.
    #[inline]
    pub(crate) fn for_each_neighbour(&self, facet: usize, mut f: impl FnMut(usize, Vector<N>, f64)) {
        match self {
            Self::Box(half_extents) => {
                for other in (0..2 * N).filter(|other| other / 2 != facet / 2) {
                    f(other, box_normal(other), half_extents[other / 2]);
                }
            }
            Self::Polytope(polytope) => {
                for &other in &polytope.facets()[facet].neighbours {
                    let plane = &polytope.facets()[other as usize];
                    f(other as usize, plane.normal, plane.offset);
                }
            }
            Self::Segment(_) | Self::Point => {}
        }
    }

    /// Number of clipping constraints that the facet brings along.
    pub(crate) fn neighbour_count(&self, facet: usize) -> usize {
        match self {
            Self::Box(_) => 2 * N,
            Self::Polytope(polytope) => polytope.facets()[facet].neighbours.len(),
            Self::Segment(_) => 2,
            Self::Point => 0,
        }
    }

    /// Puts the vertices of a facet, mapped by `target_from_core`, into the clipper, each with the bits of the
    /// neighbouring facets that hold it. A segment or point is its own facet.
    pub(crate) fn load_facet<const W: usize>(
        &self,
        facet: usize,
        target_from_core: &Pose<N>,
        clipper: &mut Clipper<N, W>,
    ) {
        match self {
            Self::Box(half_extents) => load_box_facet(half_extents, facet, target_from_core, clipper),
            Self::Polytope(polytope) => load_polytope_facet(polytope, facet, target_from_core, clipper),
            Self::Segment(half) => {
                let reach = target_from_core.rotation.rotate(**half);
                clipper.begin(1, 0..2);
                clipper.push(target_from_core.translation + reach, [0]);
                clipper.push(target_from_core.translation - reach, [1]);
            }
            Self::Point => {
                clipper.begin(0, 0..0);
                clipper.push(target_from_core.translation, []);
            }
        }
    }
}

/// Whether a facet has a vertex that is as high along `direction` as the highest, to a small tolerance.
fn reaches<const N: usize>(polytope: &Polytope<N>, facet: u32, direction: Vector<N>, height: f64) -> bool {
    let least = height - limits::SAME_HEIGHT * polytope.bounding_radius();
    let high = |&vertex: &u32| polytope.vertices()[vertex as usize].dot(direction) >= least;
    polytope.facets().get(facet as usize).is_some_and(|facet| facet.vertices.iter().any(high))
}

/// Outward normal of a facet of a box.
#[inline]
fn box_normal<const N: usize>(facet: usize) -> Vector<N> {
    let mut normal = Vector::ZERO;
    normal[facet / 2] = 1.0 - 2.0 * (facet % 2) as f64;
    normal
}

/// The 2^(N−1) corners of a box facet; bit f is facet f of the box.
fn load_box_facet<const N: usize, const W: usize>(
    half_extents: &Vector<N>,
    facet: usize,
    target_from_core: &Pose<N>,
    clipper: &mut Clipper<N, W>,
) {
    clipper.begin(N - 1, 0..2 * N as u32);
    let rotation = target_from_core.rotation.matrix();
    let reach: [Vector<N>; N] = std::array::from_fn(|axis| rotation.column(axis) * half_extents[axis]);
    let along = facet / 2;
    let centre = target_from_core.transform_point(half_extents.scale(box_normal(facet)));
    for corner in 0..1_usize << (N - 1) {
        let mut point = centre;
        let mut bits = [0; N];
        for (place, axis) in (0..N).filter(|&axis| axis != along).enumerate() {
            let negative = corner >> place & 1;
            point += if negative == 0 { reach[axis] } else { -reach[axis] };
            bits[place] = 2 * axis + negative;
        }
        clipper.push(point, bits.into_iter().take(N - 1));
    }
}

/// The vertices of a polytope's facet; bit k is the k-th of its neighbours.
fn load_polytope_facet<const N: usize, const W: usize>(
    polytope: &Polytope<N>,
    facet: usize,
    target_from_core: &Pose<N>,
    clipper: &mut Clipper<N, W>,
) {
    let facet = &polytope.facets()[facet];
    clipper.begin(N - 1, facet.neighbours.iter().copied());
    for &vertex in &facet.vertices {
        let point = target_from_core.transform_point(polytope.vertices()[vertex as usize]);
        let holders = polytope.facets_of_vertex(vertex as usize);
        // Both lists ascend.
        let mut rest = holders;
        let bits = facet.neighbours.iter().enumerate().filter_map(|(bit, neighbour)| {
            while rest.first().is_some_and(|holder| holder < neighbour) {
                rest = &rest[1..];
            }
            (rest.first() == Some(neighbour)).then_some(bit)
        });
        clipper.push(point, bits);
    }
}
