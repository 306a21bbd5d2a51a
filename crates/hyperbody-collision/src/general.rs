//! Two cores of any kind: distance search, and where they overlap the way out.

use hyperbody_geometry::Core;
use hyperbody_math::Vector;

use crate::box_sat::{Feature, separate_boxes};
use crate::difference::Difference;
use crate::epa::Penetration;
use crate::gjk::{self, Closest, Proximity, Seeds};
use crate::manifold::{ContactPoint, Manifold, max_points};
use crate::narrow::{PairCache, Scratch};
use crate::overlap::{self, WayOut};
use crate::pair::Pair;
use crate::patch::{self, Along};
use crate::round::Witness;
use crate::simplex::Simplex;
use crate::{descent, epa, limits};

/// Contacts of a pair about which nothing is known but what the cache holds.
pub(crate) fn collide<const N: usize>(
    pair: &Pair<'_, N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    let a_from_b = pair.world_from_a.relative(pair.world_from_b);
    let difference = Difference::new(&pair.a.core, &pair.b.core, &a_from_b);
    let overlapped = cache.feature != Feature::None;
    if overlapped && resting_overlap(pair, &difference, cache, scratch, out) {
        return;
    }
    search(pair, &difference, !overlapped, cache, scratch, out);
}

/// Straight to the distance search. `fresh` if an overlap would be a new one, worth a look at the facets first.
pub(crate) fn search<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    fresh: bool,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    out.clear();
    let toward_b = guess(difference, cache);
    let mut turns = 0;
    let proximity = gjk::closest(difference, &cache.seeds, toward_b, pair.margin + pair.rounding, &mut turns);
    scratch.effort.gjk_turns = scratch.effort.gjk_turns.max(turns);
    scratch.effort.gjk_runs += 1;
    match proximity {
        Proximity::Apart { normal } => {
            cache.normal = normal;
            cache.feature = Feature::None;
            cache.seeds = Seeds::default();
        }
        Proximity::Near(closest) => near(pair, difference, &closest, cache, scratch, out),
        Proximity::Overlap(simplex) => {
            if !(fresh && resting_overlap(pair, difference, cache, scratch, out)) {
                deep(pair, difference, &simplex, cache, scratch, out);
            }
        }
    }
}

/// The direction of the previous step, or else from centre to centre.
fn guess<const N: usize>(difference: &Difference<'_, N>, cache: &PairCache<N>) -> Vector<N> {
    if cache.normal == Vector::ZERO { difference.a_from_b.translation } else { cache.normal }
}

/// Disjoint cores within the margin.
fn near<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    closest: &Closest<N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    cache.normal = closest.normal;
    cache.feature = Feature::None;
    cache.seeds = Seeds::of(closest.simplex.vertices());
    let [on_a, on_b] = closest.simplex.witnesses(difference);
    let witness = Witness { normal: closest.normal, on_a, on_b, separation: closest.distance };
    let flat = !matches!((&pair.a.core, &pair.b.core), (Core::Point, _) | (_, Core::Point));
    let shown = if flat { build(pair, difference, closest.normal, cache, scratch, out) } else { None };
    complete(pair, difference, &witness, shown, cache, scratch, out);
}

/// An overlap that is shallow or was one in the previous step: the best facet normal, or the facet of D that won then,
/// if it can be shown to be good enough without a search. `false` leaves the pair to the search.
fn resting_overlap<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) -> bool {
    if pair.rounding > 0.0 {
        return false;
    }
    let thickness = overlap::thickness(difference);
    let facet = overlap::best_facet(difference, thickness, cache.feature, guess(difference, cache));
    let mixed = overlap::known_facet(difference, cache.seeds.keys(), cache.normal);
    let leave_at = |way: &WayOut<N>| overlap::worth_leaving_facet(way.depth, thickness, cache.feature);
    let (way, enough) = match (facet, mixed) {
        (Some(facet), Some(mixed)) if mixed.depth >= leave_at(&facet) => (facet, leave_at(&facet)),
        (_, Some(mixed)) => (mixed, mixed.depth),
        (Some(facet), None) => (facet, leave_at(&facet)),
        (None, None) => return false,
    };
    if way.depth <= 0.0 {
        return false;
    }
    let shown = build(pair, difference, way.normal, cache, scratch, out);
    if !shown.is_some_and(|shown| shown <= -way.depth + patch_tolerance(difference, -way.depth)) {
        return false;
    }
    let bound = overlap::least_possible_depth(difference, pair.world_from_a, out);
    let same = way.feature == cache.feature && way.facet == cache.facet;
    let confirmed = bound >= enough;
    let harmless = bound >= limits::RECHECK_FRACTION * way.depth || way.depth <= limits::SHALLOW * thickness;
    let trusted = same && harmless && cache.unconfirmed < limits::RECHECK_AFTER;
    if confirmed || trusted {
        cache.unconfirmed = if confirmed { 0 } else { cache.unconfirmed + 1 };
        (cache.normal, cache.feature, cache.facet) = (way.normal, way.feature, way.facet);
    }
    confirmed || trusted
}

/// Overlapping cores, by the full search.
fn deep<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    simplex: &Simplex<N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    cache.unconfirmed = 0;
    cache.seeds = Seeds::default();
    let thickness = overlap::thickness(difference);
    let facet = preferred_facet(pair, difference, thickness, cache);
    let enough = facet.map_or(f64::INFINITY, |way| overlap::worth_leaving_facet(way.depth, thickness, cache.feature));
    let boxes = matches!((&pair.a.core, &pair.b.core), (Core::Box { .. }, Core::Box { .. }));
    let mut found = None;
    if !boxes {
        found = Some(penetrate(difference, simplex, enough, scratch));
    }
    // A facet normal that is nearly best shows the contact, or else the best does.
    if let Some(way) = facet.filter(|_| found.is_none_or(|found| found.at_least >= enough || found.depth >= enough)) {
        (cache.normal, cache.feature, cache.facet) = (way.normal, way.feature, way.facet);
        let shown = build(pair, difference, way.normal, cache, scratch, out);
        if shown.is_some_and(|shown| shown <= -way.depth + patch_tolerance(difference, -way.depth)) {
            return;
        }
        found = Some(penetrate(difference, simplex, f64::INFINITY, scratch));
    }
    let Some(found) = found else { return };
    (cache.normal, cache.feature, cache.facet) = (found.normal, Feature::Mixed, 0);
    cache.seeds = found.facet.map_or_else(Seeds::default, |vertices| Seeds::of(&vertices));
    let witness = deepest(difference, &found);
    let shown = build(pair, difference, found.normal, cache, scratch, out);
    complete(pair, difference, &witness, shown, cache, scratch, out);
}

/// The best facet normal of the two, or for boxes the best separating axis of any kind.
fn preferred_facet<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    thickness: f64,
    cache: &PairCache<N>,
) -> Option<WayOut<N>> {
    if let (Core::Box { half_extents: half_a }, Core::Box { half_extents: half_b }) = (&pair.a.core, &pair.b.core) {
        let axis = separate_boxes(half_a, half_b, difference.a_from_b, f64::INFINITY, cache.feature).best;
        return Some(WayOut { normal: axis.normal, depth: -axis.separation, feature: axis.feature, facet: 0 });
    }
    overlap::best_facet(difference, thickness, cache.feature, guess(difference, cache))
}

pub(crate) fn penetrate<const N: usize>(
    difference: &Difference<'_, N>,
    simplex: &Simplex<N>,
    enough: f64,
    scratch: &mut Scratch<N>,
) -> Penetration<N> {
    let (found, cost) = epa::penetrate(difference, simplex.vertices(), enough, &mut scratch.hull);
    scratch.effort.epa_runs += 1;
    scratch.effort.epa_vertices = scratch.effort.epa_vertices.max(cost.vertices);
    scratch.effort.epa_facets = scratch.effort.epa_facets.max(cost.facets);
    scratch.effort.epa_unfinished += u64::from(cost.descent_turns > 0);
    scratch.effort.descent_turns = scratch.effort.descent_turns.max(cost.descent_turns);
    found
}

/// Where the cores are deepest along a way out: the foot of the origin on the facet of D, or else where the cores touch
/// once they have gone that way.
pub(crate) fn deepest<const N: usize>(difference: &Difference<'_, N>, way: &Penetration<N>) -> Witness<N> {
    if let Some([on_a, on_b]) = way.points {
        return Witness { normal: way.normal, on_a, on_b, separation: -way.depth };
    }
    let across = way.normal * way.depth;
    let found =
        way.facet.and_then(|vertices| Simplex::foot_on(&vertices)).map(|foot| foot.clamped().witnesses(difference));
    // A facet of D may come in slivers none of which holds the foot.
    let opposite = |&[on_a, on_b]: &[Vector<N>; 2]| {
        (on_a - on_b - across).norm_sq()
            <= (limits::TOUCHING * difference.scale) * (limits::TOUCHING * difference.scale)
    };
    let [on_a, on_b] =
        found.filter(opposite).unwrap_or_else(|| descent::touching_points(difference, way.normal, way.depth));
    // Midway, and apart along the normal by the depth.
    let middle = (on_a + on_b) * 0.5;
    let half = across * 0.5;
    Witness { normal: way.normal, on_a: middle + half, on_b: middle - half, separation: -way.depth }
}

/// Fills `out` with the patch along a normal, or a facet's all but equal to it; see [`patch::build`].
pub(crate) fn build<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    normal: Vector<N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) -> Option<f64> {
    build_along(pair, difference, Along::Nearly(normal), cache, scratch, out)
}

fn build_along<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    along: Along<N>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) -> Option<f64> {
    let (a, b) = pair.sides();
    out.clear();
    let memory = &mut cache.patch;
    patch::build(&a, &b, difference.a_from_b, along, pair.margin, memory, &mut scratch.patch, out)
}

/// How much farther apart (or less deep) than `separation` a patch may be and still show the contact.
pub(crate) fn patch_tolerance<const N: usize>(difference: &Difference<'_, N>, separation: f64) -> f64 {
    limits::SHOWS * difference.smaller + limits::FACET_PREFERENCE_RELATIVE * (-separation).max(0.0)
}

/// Adds the witness (in a's frame) unless the patch shows the contact.
fn complete<const N: usize>(
    pair: &Pair<'_, N>,
    difference: &Difference<'_, N>,
    witness: &Witness<N>,
    shown: Option<f64>,
    cache: &mut PairCache<N>,
    scratch: &mut Scratch<N>,
    out: &mut Manifold<N>,
) {
    let tolerance = patch_tolerance(difference, witness.separation);
    if shown.is_some_and(|shown| shown <= witness.separation + tolerance) {
        return;
    }
    let mut alone = Manifold::EMPTY;
    pair.push(&witness.transformed(pair.world_from_a), WITNESS_ID, &mut alone);
    let Some(&point) = alone.points().first() else { return };
    scratch.effort.witness_points += 1;
    // A patch along a facet's normal would not be in the shapes along the witness's; that of b's went through b's frame.
    let snapped = (out.normal - alone.normal).norm_sq() > ROUNDED * ROUNDED;
    if !out.is_empty() && snapped {
        build_along(pair, difference, Along::Exactly(witness.normal), cache, scratch, out);
    }
    out.normal = alone.normal;
    put_first(point, out);
}

/// What two ways to the same unit vector differ by at most.
const ROUNDED: f64 = 1e-14;

/// Name of the point that only the closest or deepest points show.
const WITNESS_ID: u32 = 0x5157_0001;

/// Adds a point; a full manifold gives up its last.
fn put_first<const N: usize>(point: ContactPoint<N>, out: &mut Manifold<N>) {
    if out.points().len() < max_points(N) {
        out.push(point);
    } else if let Some(last) = out.points_mut().last_mut() {
        *last = point;
    }
}
