//! The sentence that says why a rotation is stable or not.

use hyperbody_math::planes;

use super::error::rounded;
use super::principal_rotation::PrincipalTurn;
use super::stability::{Block, BlockKind, MAX_DISTURBANCE, Partner, Stability, Verdict, inner_turn_threshold};
use super::top::FreeTop;

/// Why `stability` has its verdict.
pub(crate) fn why<const N: usize>(top: &FreeTop<N>, stability: &Stability<N>) -> String {
    if stability.rotation.turns().is_empty() {
        return "the body does not turn, there is no rotation to judge".to_owned();
    }
    let outside = 100.0 * stability.disturbance;
    if stability.disturbance > MAX_DISTURBANCE {
        return format!(
            "{outside:.0} % of the spin lies outside {}, the principal planes nearest to it: this is no disturbed steady \
             rotation, and only those are judged",
            stability.rotation.to_text()
        );
    }
    let reason = match stability.verdict {
        Verdict::Stable => why_stable(top, stability),
        Verdict::Unstable => why_unstable(top, stability),
        Verdict::Open => why_open(stability),
    };
    if stability.disturbance > 0.0 {
        format!(
            "judged as the rotation in {} ({outside:.2} % of the spin is disturbance): {reason}",
            stability.rotation.to_text()
        )
    } else {
        reason
    }
}

fn name(turn: PrincipalTurn) -> String {
    planes::name(turn.i, turn.j)
}

fn axis_name(axis: usize) -> char {
    planes::AXIS_NAMES[axis]
}

fn moment_of<const N: usize>(top: &FreeTop<N>, axis: usize) -> String {
    format!("J_{} = {}", axis_name(axis), rounded(top.principal_moments()[axis]))
}

fn why_stable<const N: usize>(top: &FreeTop<N>, stability: &Stability<N>) -> String {
    let reasons: Vec<String> = stability
        .blocks
        .iter()
        .filter_map(|block| match block.partner {
            Partner::Turn(other) => Some(pair_reason(top, block.turn, other, Verdict::Stable)),
            Partner::IdleAxis(_) => None,
        })
        .collect();
    let idle = stability.rotation.idle_axes();
    let mut sentences = Vec::new();
    if !idle.is_empty() {
        let turns = stability.rotation.turns().iter();
        let ranges: Vec<String> =
            turns.map(|turn| format!("{} and {}", moment_of(top, turn.i), moment_of(top, turn.j))).collect();
        sentences.push(format!("no other axis has a moment between {}", ranges.join(", or between ")));
    }
    sentences.extend(reasons);
    if sentences.is_empty() {
        "in two dimensions there is only one plane, and nothing that could disturb it".to_owned()
    } else {
        sentences.join("; ")
    }
}

fn why_unstable<const N: usize>(top: &FreeTop<N>, stability: &Stability<N>) -> String {
    // The block that grows fastest; the first of equals.
    let mut worst = stability.blocks[0];
    for &block in &stability.blocks {
        if block.growth_rate > worst.growth_rate {
            worst = block;
        }
    }
    let seconds = rounded(1.0 / worst.growth_rate);
    let how = if worst.kind == BlockKind::GrowingOscillation { "oscillates and grows" } else { "grows" };
    match worst.partner {
        Partner::IdleAxis(axis) => {
            let PrincipalTurn { i, j, .. } = worst.turn;
            format!(
                "{} lies between {} and {}: a disturbance in {} and {} {how} e-fold in {seconds} s",
                moment_of(top, axis),
                moment_of(top, i),
                moment_of(top, j),
                planes::name(i.min(axis), i.max(axis)),
                planes::name(j.min(axis), j.max(axis)),
            )
        }
        Partner::Turn(other) => {
            format!(
                "{}: a disturbance {how} e-fold in {seconds} s",
                pair_reason(top, worst.turn, other, Verdict::Unstable)
            )
        }
    }
}

/// What the order of the four moments says about two turning planes that have the given verdict.
fn pair_reason<const N: usize>(
    top: &FreeTop<N>,
    first: PrincipalTurn,
    second: PrincipalTurn,
    verdict: Verdict,
) -> String {
    let mut axes = [first.i, first.j, second.i, second.j];
    let moments = top.principal_moments();
    axes.sort_by(|&a, &b| moments[b].total_cmp(&moments[a]));
    let sorted = axes.map(|axis| moments[axis]);
    let order: Vec<String> = axes.iter().map(|&axis| moment_of(top, axis)).collect();
    let in_first = |axis: usize| axis == first.i || axis == first.j;
    let partner = (1..4).find(|&k| in_first(axes[k]) == in_first(axes[0])).unwrap_or(1);
    let (outer, inner) = if in_first(axes[0]) { (first, second) } else { (second, first) };
    if sorted.windows(2).all(|pair| pair[0] == pair[1]) {
        return format!(
            "the axes of {} and {} have equal moments, so that no plane drives another",
            name(first),
            name(second)
        );
    }
    if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
        return format!("{} and {} with {}, some of them equal", name(first), name(second), order.join(", "));
    }
    match partner {
        1 => format!(
            "{} has the two largest of {} and {} the two smallest, which is stable at all rates",
            name(outer),
            order.join(", "),
            name(inner)
        ),
        2 => format!(
            "{} and {} alternate in the order {}, which is unstable at all unequal rates",
            name(outer),
            name(inner),
            order.join(", ")
        ),
        _ => {
            let (ratio, threshold) = ((inner.rate / outer.rate).abs(), inner_turn_threshold(sorted));
            let (relation, turns) = if verdict == Verdict::Stable {
                ("above", "fast enough to hold")
            } else {
                ("below", "too slow to hold")
            };
            format!(
                "the inner turn {} is {turns} the outer one {}: |b/a| = {ratio:.6} is {relation} the threshold {threshold:.6} for {}",
                name(inner),
                name(outer),
                order.join(", ")
            )
        }
    }
}

fn why_open<const N: usize>(stability: &Stability<N>) -> String {
    let is_open = |block: &&Block| matches!(block.kind, BlockKind::Isoclinic | BlockKind::Drifting);
    let Some(block) = stability.blocks.iter().find(is_open) else {
        return "the linear problem does not decide".to_owned();
    };
    match (block.kind, block.partner) {
        (BlockKind::Isoclinic, Partner::Turn(other)) => format!(
            "{} and {} turn at the same rate: an isoclinic spin can be tilted to other steady spins at no cost, so the \
             linear problem does not decide",
            name(block.turn),
            name(other)
        ),
        (_, Partner::IdleAxis(axis)) => {
            let PrincipalTurn { i, j, .. } = block.turn;
            format!(
                "axis {} has the same moment as one of {} and {}: a disturbance neither oscillates nor grows exponentially \
                 but drifts in proportion to time, as when a symmetric top precesses",
                axis_name(axis),
                axis_name(i),
                axis_name(j)
            )
        }
        (_, Partner::Turn(other)) => format!(
            "{} and {} are exactly between stable and unstable: a disturbance drifts in proportion to time",
            name(block.turn),
            name(other)
        ),
    }
}
