//! Choosing the few points of a patch that hold it.
//!
//! Of a patch like a cube with twice as many corners as may be chosen, every second. Of others first the deepest, then, one
//! by one, the point farthest from the affine hull of those chosen (which gives a large simplex that spans the patch), then
//! the point farthest from all chosen, each with the point opposite to it across the middle of the patch if there is one: a
//! box then stands as deep on one side as on the other. Distances within a few percent of each other go to the point that
//! was chosen in the previous step, then to the smaller id, so that the choice is stable; but the deepest comes first.

use hyperbody_math::Vector;

use crate::limits;

/// A point that may become a contact point, in any one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<const N: usize> {
    pub(crate) position: Vector<N>,
    pub(crate) separation: f64,
    pub(crate) id: u32,
    /// Whether it is an odd or an even corner of a patch like a box; `None` of others.
    pub(crate) class: Option<bool>,
    /// Whether it was chosen in the previous step; found by the reduction.
    pub(crate) known: bool,
}

/// Relative difference of squared distances that rounding makes.
const EQUAL_DISTANCE: f64 = 1e-9;

/// A point counts as opposite within this share, squared, of the distance from the middle.
const OPPOSITE_SQ: f64 = 0.04;

/// Working memory of the reduction.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reducer<const N: usize> {
    pub(crate) candidates: Vec<Candidate<N>>,
    /// Offset of each candidate from the affine hull of the points chosen so far.
    residuals: Vec<Vector<N>>,
    /// Squared distance of each candidate to the nearest point chosen so far.
    nearest_sq: Vec<f64>,
    /// Mean of all candidates.
    middle: Vector<N>,
    /// Places of chosen points whose opposite has been looked for.
    paired: u32,
}

impl<const N: usize> Reducer<N> {
    /// Moves at most `limit` well-spread candidates to the front and forgets the rest. `previous` are the ids chosen
    /// in the previous step, `size` the extent of the shapes.
    pub(crate) fn reduce(&mut self, limit: usize, previous: &[u32], size: f64) {
        let tiny_sq = (limits::ON_PLANE * 1e3 * size) * (limits::ON_PLANE * 1e3 * size);
        if self.candidates.len() <= 1 || limit == 0 {
            self.candidates.truncate(limit);
            return;
        }
        for candidate in &mut self.candidates {
            candidate.known = previous.contains(&candidate.id);
        }
        self.keep_every_second(limit, size);
        self.choose_first(size);
        let mut chosen = 1;
        // Each turn chooses one point.
        while chosen < limit.min(self.candidates.len()) {
            let spanning = chosen < N;
            if !spanning && let Some(index) = self.opposite_of_unpaired(chosen) {
                self.choose(index, chosen);
                self.paired |= 1 << chosen;
                chosen += 1;
                continue;
            }
            let mut best = None;
            for index in chosen..self.candidates.len() {
                let nearest_sq = self.nearest_sq[index];
                let distance_sq = if spanning { self.residuals[index].norm_sq() } else { nearest_sq };
                if distance_sq > tiny_sq {
                    best = self.better(best, index, distance_sq);
                }
            }
            match best {
                Some((index, _)) => self.choose(index, chosen),
                // The hull is exhausted: go on by distance to the points, or end.
                None if spanning && self.spread_remains(chosen, tiny_sq) => {
                    let index = self.farthest(chosen);
                    self.choose(index, chosen);
                }
                None => break,
            }
            chosen += 1;
        }
        self.candidates.truncate(chosen);
    }

    /// Keeps one class of corners if it has `limit` of them and one as deep as any: every second corner of a cube spans it
    /// and each of its faces as evenly as all of them do. The class of the previous step stays if it can.
    fn keep_every_second(&mut self, limit: usize, size: f64) {
        if self.candidates.len() < 2 * limit {
            return;
        }
        let of_class = |class: bool| self.candidates.iter().filter(move |candidate| candidate.class == Some(class));
        let least = self.candidates.iter().map(|c| c.separation).fold(f64::INFINITY, f64::min);
        let suits = |class: &bool| {
            let deep = of_class(*class).any(|c| c.separation <= least + limits::EQUAL_DEPTH * size);
            deep && of_class(*class).count() == limit
        };
        let known = of_class(true).any(|candidate| candidate.known);
        if let Some(kept) = [known, !known].into_iter().find(suits) {
            self.candidates.retain(|candidate| candidate.class == Some(kept));
        }
    }

    /// The candidate opposite to the first chosen point that has no partner yet.
    fn opposite_of_unpaired(&mut self, chosen: usize) -> Option<usize> {
        for place in 0..chosen {
            if self.paired & (1 << place) != 0 {
                continue;
            }
            self.paired |= 1 << place;
            let point = self.candidates[place].position;
            let opposite = self.middle * 2.0 - point;
            let near_sq = OPPOSITE_SQ * (point - self.middle).norm_sq();
            let distance_sq = |place: usize| (self.candidates[place].position - opposite).norm_sq();
            // The nearest, not any: of a patch whose halves mirror each other the halves of what is chosen do, too.
            let nearest = |places: std::ops::Range<usize>| {
                let near = places.filter(|&place| distance_sq(place) <= near_sq);
                near.min_by(|&a, &b| distance_sq(a).total_cmp(&distance_sq(b)))
            };
            if let Some(partner) = nearest(0..chosen) {
                self.paired |= 1 << partner;
            } else if let Some(partner) = nearest(chosen..self.candidates.len()) {
                return Some(partner);
            }
        }
        None
    }

    fn spread_remains(&self, chosen: usize, tiny_sq: f64) -> bool {
        self.nearest_sq[chosen..].iter().any(|&distance_sq| distance_sq > tiny_sq)
    }

    fn farthest(&self, chosen: usize) -> usize {
        let mut best = None;
        for index in chosen..self.candidates.len() {
            best = self.better(best, index, self.nearest_sq[index]);
        }
        best.map_or(chosen, |(index, _)| index)
    }

    /// The better of the best so far and a candidate, with their scores.
    fn better(&self, best: Option<(usize, f64)>, index: usize, distance_sq: f64) -> Option<(usize, f64)> {
        let Candidate { id, known, .. } = self.candidates[index];
        let score = if known { distance_sq * limits::COHERENCE_GAIN } else { distance_sq };
        // Opposite corners of boxes are equally far but for rounding.
        let Some((kept, most)) = best else { return Some((index, score)) };
        let equal = (score - most).abs() <= EQUAL_DISTANCE * most;
        let wins = if equal { id < self.candidates[kept].id } else { score > most };
        if wins { Some((index, score)) } else { best }
    }

    /// Chooses the first point: of the deepest, the one farthest from the middle.
    fn choose_first(&mut self, size: f64) {
        let least = self.candidates.iter().map(|c| c.separation).fold(f64::INFINITY, f64::min);
        let mut middle = Vector::ZERO;
        for candidate in &self.candidates {
            middle += candidate.position;
        }
        middle *= 1.0 / self.candidates.len() as f64;
        self.middle = middle;
        self.paired = 0;
        let mut best = None;
        for (index, candidate) in self.candidates.iter().enumerate() {
            if candidate.separation <= least + limits::EQUAL_DEPTH * size {
                best = self.better(best, index, (candidate.position - middle).norm_sq());
            }
        }
        self.candidates.swap(0, best.map_or(0, |(index, _)| index));
        let first = self.candidates[0].position;
        self.residuals.clear();
        self.residuals.extend(self.candidates.iter().map(|candidate| candidate.position - first));
        self.nearest_sq.clear();
        self.nearest_sq.extend(self.residuals.iter().map(|residual| residual.norm_sq()));
    }

    /// Swaps candidate `index` to place `chosen` and brings the distances of the others up to date.
    fn choose(&mut self, index: usize, chosen: usize) {
        self.candidates.swap(index, chosen);
        self.residuals.swap(index, chosen);
        self.nearest_sq.swap(index, chosen);
        let point = self.candidates[chosen].position;
        let direction = self.residuals[chosen].normalize_or_zero();
        for other in chosen + 1..self.candidates.len() {
            let along = self.residuals[other].dot(direction);
            self.residuals[other] -= direction * along;
            let distance_sq = (self.candidates[other].position - point).norm_sq();
            self.nearest_sq[other] = self.nearest_sq[other].min(distance_sq);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cubes in 4D, one on the other, that were turned within the space of three axes by an impact: what they share is a prism over a
    /// polygon of that space. A choice that does not mirror itself at the middle of the prism would turn them out of the space.
    #[test]
    fn what_is_chosen_of_a_prism_mirrors_itself() {
        // Place in the space and along the fourth axis, separation, id.
        let prism = [
            ([0.399996757, 0.298543511, 0.399997675], -0.5, -0.002912977, 1_390_962_319),
            ([0.4, 0.298547222, 0.047733535], -0.5, -0.002905556, 1_278_679_595),
            ([-0.4, 0.29756567, 0.39999027], -0.5, -0.00486866, 1_888_061_663),
            ([-0.4, 0.297566644, 0.307424909], -0.5, -0.004866712, 3_297_766_464),
            ([-0.399993488, 0.297574097, -0.4], 0.5, -0.004851807, 2_552_451_132),
            ([0.4, 0.298551934, -0.4], 0.5, -0.002896132, 1_030_463_607),
            ([0.399996757, 0.298543512, 0.399997675], 0.5, -0.002912976, 1_044_465_097),
            ([0.4, 0.298547223, 0.047733898], 0.5, -0.002905554, 932_182_373),
            ([0.4, 0.298547837, -0.010659089], 0.5, -0.002904326, 2_598_201_275),
            ([-0.4, 0.297565671, 0.39999027], 0.5, -0.004868659, 1_541_564_441),
            ([-0.4, 0.297566645, 0.307425273], 0.5, -0.004866711, 2_951_269_242),
            ([-0.399995594, 0.297571687, -0.171285827], 0.5, -0.004856625, 4_120_188_800),
            ([-0.399995594, 0.297571687, -0.171286505], -0.5, -0.004856626, 2_683_472_651),
            ([-0.399993488, 0.297574096, -0.4], -0.5, -0.004851808, 769_237_761),
            ([0.4, 0.298547837, -0.010661365], -0.5, -0.002904327, 1_161_485_126),
            ([0.4, 0.298551934, -0.4], -0.5, -0.002896133, 3_542_217_532),
        ];
        let mut reducer = Reducer::<4>::default();
        reducer.candidates.extend(prism.map(|([x, y, z], w, separation, id)| {
            let position = Vector([x, y, z, w]);
            Candidate { position, separation, id, class: None, known: false }
        }));
        reducer.reduce(8, &[1_390_962_319], 0.8);
        let chosen: Vec<Vector<4>> = reducer.candidates.iter().map(|candidate| candidate.position).collect();
        assert_eq!(chosen.len(), 8);
        for point in &chosen {
            let mirrored = *point - Vector::unit(3) * (2.0 * point[3]);
            let is_there = chosen.iter().any(|other| other.distance(mirrored) < 1e-4);
            assert!(is_there, "{mirrored:?} is missing among {chosen:?}");
        }
    }
}
