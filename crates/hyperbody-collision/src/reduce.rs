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
            let is_near = |candidate: &Candidate<N>| (candidate.position - opposite).norm_sq() <= near_sq;
            if let Some(partner) = self.candidates[..chosen].iter().position(is_near) {
                self.paired |= 1 << partner;
            } else if let Some(partner) = self.candidates[chosen..].iter().position(is_near) {
                return Some(chosen + partner);
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
