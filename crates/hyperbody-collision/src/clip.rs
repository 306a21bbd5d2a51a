//! Cutting a convex patch by half-spaces, in any dimension.
//!
//! The patch is kept as its vertices, each with the set of constraints that it makes tight. One cut is a step of the
//! double-description method (Motzkin, Raiffa, Thompson, Thrall 1953): vertices outside go, and every edge from inside
//! to outside leaves a new vertex. Two vertices of a patch of dimension d can be joined by an edge only if they share
//! at least d − 1 tight constraints. While every vertex is tight on exactly d constraints, as those of boxes and of
//! simplices in general position are, that is also enough; and up to d = 3 it is but for planes that meet in one edge by
//! chance, which a few vertices bear, since a false edge adds no more than a point of the patch. Otherwise a pair is an edge only if no third
//! vertex makes tight all that the two share (Fukuda, Prodon 1996). Vertices that coincide are made one, without which
//! two copies of a point would hide each other's edges.

use hyperbody_math::Vector;

/// Largest number of vertices of a patch. Two 5-cubes meet in fewer than 300; new vertices beyond the limit are left
/// out, which makes the patch smaller.
const MAX_PATCH_VERTICES: usize = 1024;

/// A vertex and the constraints it makes tight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipVertex<const N: usize, const W: usize> {
    pub(crate) point: Vector<N>,
    tight: [u64; W],
}

/// A patch being cut; room for 64·W constraints.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clipper<const N: usize, const W: usize> {
    pub(crate) vertices: Vec<ClipVertex<N, W>>,
    distances: Vec<f64>,
    /// What each bit stands for: a facet of the patch's own shape, or, from `own` on, of the cutting shape.
    features: Vec<u32>,
    own: usize,
    dimension: usize,
    /// Every vertex is tight on `dimension` constraints and no more.
    simple: bool,
}

impl<const N: usize, const W: usize> Clipper<N, W> {
    /// Starts a patch of the given dimension whose own constraints are the given facets of its shape.
    pub(crate) fn begin(&mut self, dimension: usize, own: impl IntoIterator<Item = u32>) {
        self.vertices.clear();
        self.features.clear();
        self.features.extend(own);
        self.own = self.features.len();
        self.dimension = dimension;
        self.simple = true;
    }

    /// Adds a vertex that makes the given own constraints tight.
    pub(crate) fn push(&mut self, point: Vector<N>, bits: impl IntoIterator<Item = usize>) {
        let mut tight = [0; W];
        for bit in bits {
            set(&mut tight, bit);
        }
        self.simple &= count(&tight) <= self.dimension;
        self.vertices.push(ClipVertex { point, tight });
    }

    /// Keeps what lies on the side normal·p ≤ offset, for a unit normal; points within `tolerance` of the plane count
    /// as on it. `feature` is the facet of the cutting shape that the plane comes from. `false` if nothing is left.
    pub(crate) fn cut(&mut self, normal: Vector<N>, offset: f64, tolerance: f64, feature: u32) -> bool {
        self.distances.clear();
        self.distances.extend(self.vertices.iter().map(|vertex| vertex.point.dot(normal) - offset));
        // A plane with nothing outside bounds nothing new; leaving it out keeps the vertices simple.
        if self.distances.iter().all(|&distance| distance <= tolerance) {
            return !self.vertices.is_empty();
        }
        let bit = self.features.len();
        if bit >= 64 * W {
            self.vertices.clear();
            return false;
        }
        self.features.push(feature);
        let before = self.vertices.len();
        for index in 0..before {
            if self.distances[index].abs() <= tolerance {
                set(&mut self.vertices[index].tight, bit);
                self.simple &= count(&self.vertices[index].tight) <= self.dimension;
            }
        }
        for outside in 0..before {
            if self.distances[outside] > tolerance {
                self.cross_edges_of(outside, before, tolerance, bit);
            }
        }
        self.drop_outside(before, tolerance);
        !self.vertices.is_empty()
    }

    /// Adds the points where the edges from one outside vertex to the inside cross the plane.
    fn cross_edges_of(&mut self, outside: usize, before: usize, tolerance: f64, bit: usize) {
        let far = self.vertices[outside];
        let far_distance = self.distances[outside];
        for inside in 0..before {
            let near_distance = self.distances[inside];
            if near_distance >= -tolerance || self.vertices.len() >= MAX_PATCH_VERTICES {
                continue;
            }
            let near = self.vertices[inside];
            let mut shared = [0; W];
            for word in 0..W {
                shared[word] = near.tight[word] & far.tight[word];
            }
            let trust_count = self.simple || (self.dimension <= 3 && before <= FEW_VERTICES);
            let edge = has_at_least(&shared, self.dimension - 1)
                && (trust_count || !self.shared_by_a_third(&shared, [inside, outside], before));
            if edge {
                let t = near_distance / (near_distance - far_distance);
                set(&mut shared, bit);
                self.add_crossing(
                    ClipVertex { point: near.point.lerp(far.point, t), tight: shared },
                    before,
                    tolerance,
                );
            }
        }
    }

    /// Whether a vertex beside the pair makes all the given constraints tight.
    fn shared_by_a_third(&self, shared: &[u64; W], pair: [usize; 2], before: usize) -> bool {
        let holds = |tight: &[u64; W]| (0..W).all(|word| tight[word] & shared[word] == shared[word]);
        (0..before).any(|index| !pair.contains(&index) && holds(&self.vertices[index].tight))
    }

    /// Adds a point on the new plane, or joins it to one already there.
    fn add_crossing(&mut self, crossing: ClipVertex<N, W>, before: usize, tolerance: f64) {
        if !self.simple {
            let close = |point: Vector<N>| (point - crossing.point).max_abs() <= SAME_POINT * tolerance;
            let on_plane = |index: usize| index >= before || self.distances[index].abs() <= tolerance;
            let twin = (0..self.vertices.len()).find(|&index| on_plane(index) && close(self.vertices[index].point));
            if let Some(twin) = twin {
                for word in 0..W {
                    self.vertices[twin].tight[word] |= crossing.tight[word];
                }
                return;
            }
        }
        self.vertices.push(crossing);
    }

    /// Removes the outside ones of the first `before` vertices.
    fn drop_outside(&mut self, before: usize, tolerance: f64) {
        let mut kept = 0;
        for index in 0..self.vertices.len() {
            if index < before && self.distances[index] > tolerance {
                continue;
            }
            self.vertices[kept] = self.vertices[index];
            kept += 1;
        }
        self.vertices.truncate(kept);
    }

    /// A number for the set of features that meet at a vertex: the facets of the patch's own shape and those of the
    /// cutting shape, each marked by the given parity. It does not depend on the order of the cuts.
    pub(crate) fn feature_id(&self, vertex: usize, own_parity: u32) -> u32 {
        let mut id = 0_u32;
        for word in 0..W {
            let mut bits = self.vertices[vertex].tight[word];
            // Clears one bit per turn.
            while bits != 0 {
                let bit = 64 * word + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let parity = if bit < self.own { own_parity } else { 1 - own_parity };
                id = id.wrapping_add(feature_hash(self.features[bit], parity));
            }
        }
        id
    }
}

/// A well-mixed number for facet `feature` of shape a (`parity` 0) or b (1): the finaliser of MurmurHash3 (Appleby).
pub(crate) fn feature_hash(feature: u32, parity: u32) -> u32 {
    let mut hash = (feature << 1 | parity).wrapping_add(0x9e37_79b9);
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// Up to this many vertices false edges cost less than telling them apart.
const FEW_VERTICES: usize = 20;

/// Distance of two vertices, in parts of the tolerance of planes, up to which they are one: where planes meet at a
/// small angle their crossing is less certain than they are.
const SAME_POINT: f64 = 100.0;

#[inline]
fn count<const W: usize>(words: &[u64; W]) -> usize {
    words.iter().map(|word| word.count_ones() as usize).sum()
}

/// Whether at least so many bits are set: what counting them tells too, but without the instruction that counts bits, which
/// not every processor has, that takes many others.
#[inline]
fn has_at_least<const W: usize>(words: &[u64; W], least: usize) -> bool {
    let mut words = *words;
    for _ in 1..least {
        // The lowest bit goes.
        let mut below = true;
        for word in &mut words {
            let empty = *word == 0;
            *word = if below { *word & word.wrapping_sub(1) } else { *word };
            below &= empty;
        }
    }
    least == 0 || words.iter().any(|&word| word != 0)
}

#[inline]
fn set<const W: usize>(words: &mut [u64; W], bit: usize) {
    words[bit / 64] |= 1 << (bit % 64);
}
