//! What is seen of many flat sheets from one point: the lower envelope of linear functions over convex regions.
//!
//! Seen from the centre of a star polytope, its facets lie one behind the other. The solid ends where the last of them does. In
//! coordinates of a hyperplane in front of the eye each facet is a few convex regions, and how far it is there is a linear
//! function; so what is seen last is found by cutting the picture along the edges of regions, the farthest first, and along the
//! lines where two of them cross, until one facet alone is the last in every part.

use hyperbody_math::Vector;

use crate::Polytope;
use crate::decompose::clip;
use crate::hull::plane::Hyperplane;

/// A convex region of the picture with what it shows.
#[derive(Clone, Debug)]
pub(super) struct Sheet<const M: usize> {
    pub(super) region: Polytope<M>,
    /// The value at p is gradient·p + constant; the sheet with the least is the one that counts.
    pub(super) gradient: Vector<M>,
    pub(super) constant: f64,
}

impl<const M: usize> Sheet<M> {
    fn value(&self, p: Vector<M>) -> f64 {
        self.gradient.dot(p) + self.constant
    }

    /// Whether nothing of the part is nearer on this sheet than on another.
    fn hides_nothing_of(&self, other: &Self, part: &Polytope<M>, tolerance: f64) -> bool {
        part.vertices().iter().all(|&v| self.value(v) >= other.value(v) - tolerance)
    }

    fn place_of(&self, part: &Polytope<M>, tolerance: f64) -> Place {
        let beyond = |a: &Polytope<M>, b: &Polytope<M>| {
            a.facets().iter().any(|f| b.vertices().iter().all(|v| f.normal.dot(*v) - f.offset > -tolerance))
        };
        if beyond(&self.region, part) || beyond(part, &self.region) {
            return Place::Outside;
        }
        let inside = |v: &Vector<M>| self.region.facets().iter().all(|f| f.normal.dot(*v) - f.offset < tolerance);
        if part.vertices().iter().all(inside) { Place::Covers } else { Place::Partly }
    }

    /// A side of the region that passes through the inside of the part.
    fn side_within(&self, part: &Polytope<M>, tolerance: f64) -> Option<Hyperplane<M>> {
        let planes = self.region.facets().iter().map(|f| Hyperplane { normal: f.normal, offset: f.offset });
        planes.into_iter().find(|plane| {
            let heights = || part.vertices().iter().map(|&v| plane.distance(v));
            heights().any(|h| h > tolerance) && heights().any(|h| h < -tolerance)
        })
    }

    /// Where this sheet and another have the same value.
    fn crossing(&self, other: &Self) -> Option<Hyperplane<M>> {
        let gradient = self.gradient - other.gradient;
        let length = gradient.norm();
        (length > 0.0)
            .then(|| Hyperplane { normal: gradient / length, offset: (other.constant - self.constant) / length })
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    Outside,
    Partly,
    Covers,
}

/// Parts of the picture, each with the number of the sheet that has the least value there. `None` if some part is covered by no
/// sheet, or there are more than `most` parts.
pub(super) fn lowest<const M: usize>(
    picture: Polytope<M>,
    sheets: &[Sheet<M>],
    tolerance: f64,
    most: usize,
) -> Option<Vec<(Polytope<M>, usize)>> {
    let mut waiting: Vec<(Polytope<M>, Vec<usize>)> = vec![(picture, (0..sheets.len()).collect())];
    let mut seen = Vec::new();
    while let Some((part, near)) = waiting.pop() {
        let (plane, left) = match decide(&part, &near, sheets, tolerance)? {
            Decision::Seen(sheet) => {
                seen.push((part, sheet));
                if seen.len() > most {
                    return None;
                }
                continue;
            }
            Decision::Cut(plane, left) => (plane, left),
        };
        let halves = [clip(&part, &plane, tolerance), clip(&part, &plane.flipped(), tolerance)];
        waiting.extend(halves.into_iter().flatten().map(|half| (half, left.clone())));
    }
    Some(seen)
}

enum Decision<const M: usize> {
    Seen(usize),
    /// Cut there; these sheets may be seen in the halves.
    Cut(Hyperplane<M>, Vec<usize>),
}

fn decide<const M: usize>(
    part: &Polytope<M>,
    near: &[usize],
    sheets: &[Sheet<M>],
    tolerance: f64,
) -> Option<Decision<M>> {
    let middle = part.vertex_mean();
    let placed = near.iter().map(|&k| (k, sheets[k].place_of(part, tolerance)));
    let placed: Vec<(usize, Place)> = placed.filter(|(_, place)| *place != Place::Outside).collect();
    let by_value = |&a: &usize, &b: &usize| sheets[a].value(middle).total_cmp(&sheets[b].value(middle));
    let covering = || placed.iter().filter(|(_, place)| *place == Place::Covers).map(|&(k, _)| k);
    let first = covering().min_by(by_value);
    let counts = |k: usize| first.is_none_or(|a| k != a && !sheets[k].hides_nothing_of(&sheets[a], part, tolerance));
    let partly = placed.iter().filter(|&&(k, place)| place == Place::Partly && counts(k)).map(|&(k, _)| k);
    let left = || placed.iter().map(|&(k, _)| k).filter(|&k| Some(k) == first || counts(k)).collect();
    // The side of the sheet that hides the others is seen; those of hidden ones may not be.
    if let Some(side) = partly.min_by(by_value).and_then(|k| sheets[k].side_within(part, tolerance)) {
        return Some(Decision::Cut(side, left()));
    }
    let first = first?;
    let rival = covering().find(|&k| counts(k));
    Some(match rival.and_then(|k| sheets[k].crossing(&sheets[first])) {
        Some(plane) => Decision::Cut(plane, left()),
        None => Decision::Seen(first),
    })
}
