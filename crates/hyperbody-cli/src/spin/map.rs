//! Maps of stability, with the boundary that the closed form gives.

use std::sync::Mutex;
use std::time::Instant;

use hyperbody::dynamics::free_top::stability::{inner_turn_threshold, verdict_and_growth};
use hyperbody::dynamics::free_top::sweep::MapCell;
use hyperbody::dynamics::free_top::{
    FreeTop, FreeTopErrorKind, MapRange, PrincipalRotation, StabilityMap, Verdict, map_moments, map_spins, parse_spin,
};
use hyperbody::math::{Bivector, Dim, EvenAlgebra, Vector, planes};
use hyperbody_scene::DimensionVisitor;
use serde::Serialize;

use super::arguments::SpinArguments;
use super::body::{Body, numbers, refused};
use super::boundary::{Segment, boundary};
use super::csv::write_table;
use super::report::Named;
use crate::failure::Failure;
use crate::output::{labelled, number};
use crate::progress::Progress;

/// Growth below this is what rounding and slow drift make of stable rotations, 1/s per rad/s of the fastest turn.
const MEASURABLE: f64 = 1e-3;

/// How close to a threshold both its sides are looked at, relative to it.
const NEXT_TO: f64 = 1e-9;

#[derive(Serialize)]
pub(super) struct MapReport {
    pub(super) dimension: usize,
    pub(super) moments: Vec<f64>,
    pub(super) moments_unit: &'static str,
    /// The fixed spin of a map over moments, rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spin: Option<Named<f64>>,
    pub(super) x: Side,
    pub(super) y: Side,
    /// Rows from the first y up; null where the linear problem cannot tell.
    pub(super) stable: Vec<Vec<Option<bool>>>,
    /// From the eigenvalues, 1/s.
    pub(super) growth_rate: Vec<Vec<f64>>,
    /// From the linearised run, 1/s.
    pub(super) measured_growth_rate: Vec<Vec<f64>>,
    /// Where the closed form changes from stable to unstable, as segments between cells.
    pub(super) boundary: Vec<Segment>,
    /// The |b/a| above which a double rotation is stable whose one plane lies within the other by moments, where a map over spins
    /// shows one.
    pub(super) threshold: Option<f64>,
    /// The plane within and the plane around it, of that threshold.
    pub(super) inner_and_outer: Option<[String; 2]>,
    /// Cells in which verdict and measured growth disagree, among those where either grows measurably.
    pub(super) disagreements: usize,
    pub(super) compute_seconds: f64,
}

/// What varies along one side.
#[derive(Serialize)]
pub(super) struct Side {
    pub(super) varies: String,
    pub(super) unit: &'static str,
    pub(super) values: Vec<f64>,
}

/// What a map varies.
enum Varied {
    Planes([(usize, usize); 2]),
    Axes([usize; 2]),
}

/// Computes the map of the arguments, in whatever dimension the body has.
pub(super) struct Map<'a> {
    pub(super) body: &'a Body,
    pub(super) arguments: &'a SpinArguments,
}

impl DimensionVisitor for Map<'_> {
    type Output = Result<MapReport, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let top = self.body.top::<N>()?;
        let varied = varied::<N>(self.arguments.map.as_deref().unwrap_or_default())?;
        let spin = fixed_spin::<N>(self.arguments, &varied)?;
        let [x, y] = ranges(self.arguments, &varied, top.principal_moments().max_abs())?;
        let cells = usize::from(self.arguments.cells);
        let bar = Mutex::new((Progress::new("stability map", (cells * cells) as u64), 0_u64));
        let progress = |_, _| {
            // Rows end in any order; a poisoned lock only loses the bar.
            if let Ok(mut guard) = bar.lock() {
                guard.1 += cells as u64;
                let done = guard.1;
                guard.0.reach(done);
            }
        };
        let clock = Instant::now();
        let map = match varied {
            Varied::Planes(pair) => map_spins(&top, pair, x, y, &progress),
            Varied::Axes(axes) => map_moments(&top, axes, &spin, x, y, &progress),
        };
        // The moments of the body itself were accepted; what a cell refuses is a value of the range.
        let map = map.map_err(|error| match error.kind() {
            FreeTopErrorKind::Moments => refused("--range", &error),
            _ => refused("--map", &error),
        })?;
        let compute_seconds = clock.elapsed().as_secs_f64();
        let judge = |x: f64, y: f64| match varied {
            Varied::Planes(pair) => {
                verdict(&top, &(Bivector::plane(pair[0].0, pair[0].1, x) + Bivector::plane(pair[1].0, pair[1].1, y)))
            }
            Varied::Axes([first, second]) => {
                let mut moments = *top.principal_moments();
                (moments[first], moments[second]) = (x, y);
                FreeTop::new(moments).map_or(Verdict::Open, |top| verdict(&top, &spin))
            }
        };
        let threshold = threshold(&top, &varied);
        let side = |index: usize, range: &MapRange| side(&varied, index, range, self.body.unit);
        Ok(MapReport {
            dimension: N,
            moments: self.body.moments.clone(),
            moments_unit: self.body.unit,
            spin: matches!(varied, Varied::Axes(_)).then(|| {
                let turning = planes::all(N).filter(|&(i, j)| spin.get(i, j) != 0.0);
                Named(turning.map(|(i, j)| (planes::name(i, j), spin.get(i, j))).collect())
            }),
            x: side(0, &map.x),
            y: side(1, &map.y),
            stable: rows(&map, |cell| cell.verdict.stable()),
            growth_rate: rows(&map, |cell| cell.growth_rate),
            measured_growth_rate: rows(&map, |cell| cell.measured_growth_rate),
            boundary: boundary(&map, &judge),
            threshold: threshold.as_ref().map(|threshold| threshold.0),
            inner_and_outer: threshold.map(|threshold| threshold.1.map(|(i, j)| planes::name(i.min(j), i.max(j)))),
            disagreements: disagreements(&map, &varied, &spin),
            compute_seconds,
        })
    }
}

fn verdict<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Verdict {
    PrincipalRotation::new(spin).map_or(Verdict::Open, |rotation| verdict_and_growth(top, &rotation).0)
}

fn varied<const N: usize>(text: &str) -> Result<Varied, Failure> {
    let names: Vec<&str> = text.split(',').map(str::trim).collect();
    let axis = |name: &str| match name.chars().collect::<Vec<char>>()[..] {
        [letter] => planes::axis_from_name(N, letter),
        _ => None,
    };
    let axes: String = planes::AXIS_NAMES[..N].iter().collect();
    if N < 4 && names.iter().any(|name| name.chars().count() == 2) {
        return Err(Failure::Input(format!(
            "--map: \"{text}\": two planes without a common axis take four dimensions, and this body has {N}; map over the \
             moments of two of its axes {axes} instead, such as --map x,y --spin xy=1"
        )));
    }
    if let [first, second] = names[..] {
        if let (Some(first), Some(second)) = (planes::from_name(N, first), planes::from_name(N, second)) {
            return Ok(Varied::Planes([first, second]));
        }
        if let (Some(first), Some(second)) = (axis(first), axis(second)) {
            return Ok(Varied::Axes([first, second]));
        }
    }
    Err(Failure::Input(format!(
        "--map: \"{text}\" is neither two planes without a common axis, such as xw,yz, nor two axes, such as y,z; the \
         axes are {axes}"
    )))
}

fn fixed_spin<const N: usize>(arguments: &SpinArguments, varied: &Varied) -> Result<Bivector<N>, Failure> {
    match (varied, &arguments.spin) {
        (Varied::Planes(_), None) => Ok(Bivector::ZERO),
        (Varied::Planes(_), Some(_)) => Err(Failure::Input(
            "--spin: a map over two planes varies the spin itself; leave --spin out, or map over two axes".to_owned(),
        )),
        (Varied::Axes(_), None) => Err(Failure::Input(
            "--spin: a map over moments needs a steady spin whose stability it shows, such as xw=1,yz=0.9".to_owned(),
        )),
        (Varied::Axes(_), Some(text)) => {
            let spin = parse_spin::<N>(text).map_err(|error| refused("--spin", &error))?;
            PrincipalRotation::new(&spin).map_err(|error| refused("--spin", &error))?;
            Ok(spin)
        }
    }
}

fn ranges(arguments: &SpinArguments, varied: &Varied, largest_moment: f64) -> Result<[MapRange; 2], Failure> {
    let ends = match (&arguments.range, varied) {
        (Some(text), _) => numbers("--range", text)?,
        (None, Varied::Planes(_)) => vec![-1.5, 1.5],
        (None, Varied::Axes(_)) => vec![0.02 * largest_moment, 1.25 * largest_moment],
    };
    let [x1, x2, y1, y2] = match ends[..] {
        [from, to] => [from, to, from, to],
        [x1, x2, y1, y2] => [x1, x2, y1, y2],
        _ => {
            return Err(Failure::Input(format!(
                "--range: {} numbers; give FROM,TO for both sides or X1,X2,Y1,Y2",
                ends.len()
            )));
        }
    };
    let range =
        |from, to| MapRange::new(from, to, usize::from(arguments.cells)).map_err(|error| refused("--range", &error));
    Ok([range(x1, x2)?, range(y1, y2)?])
}

fn side(varied: &Varied, index: usize, range: &MapRange, unit: &'static str) -> Side {
    let (varies, unit) = match varied {
        Varied::Planes(pair) => (planes::name(pair[index].0, pair[index].1), "rad/s"),
        Varied::Axes(axes) => (planes::AXIS_NAMES[axes[index]].to_string(), unit),
    };
    Side { varies, unit, values: (0..range.count()).map(|index| range.value(index)).collect() }
}

fn rows<T>(map: &StabilityMap, value: impl Fn(&MapCell) -> T) -> Vec<Vec<T>> {
    map.cells.chunks(map.x.count()).map(|row| row.iter().map(&value).collect()).collect()
}

/// The threshold of a map over spins, if one of its planes has the largest and the least of the four moments, and no idle
/// axis decides instead; with the inner and the outer plane.
fn threshold<const N: usize>(top: &FreeTop<N>, varied: &Varied) -> Option<(f64, [(usize, usize); 2])> {
    let Varied::Planes([first, second]) = *varied else { return None };
    let moment = |axis: usize| top.principal_moments()[axis];
    let ends = |(i, j): (usize, usize)| [moment(i).min(moment(j)), moment(i).max(moment(j))];
    let ([a, b], [c, d]) = (ends(first), ends(second));
    let [inner, outer] = if a < c && d < b {
        [second, first]
    } else if c < a && b < d {
        [first, second]
    } else {
        return None;
    };
    let mut moments = [a, b, c, d];
    moments.sort_by(|a, b| b.total_cmp(a));
    let threshold = inner_turn_threshold(moments);
    let double = |rate: f64| Bivector::plane(outer.0, outer.1, 1.0) + Bivector::plane(inner.0, inner.1, rate);
    let stable = |part: f64| verdict(top, &double(part * threshold)) == Verdict::Stable;
    (stable(1.0 + NEXT_TO) && !stable(1.0 - NEXT_TO)).then_some((threshold, [inner, outer]))
}

fn disagreements<const N: usize>(map: &StabilityMap, varied: &Varied, spin: &Bivector<N>) -> usize {
    let fixed =
        Vector::<N>::from_fn(|i| (0..N).map(|j| if i == j { 0.0 } else { spin.get(i, j).abs() }).fold(0.0, f64::max));
    let mut count = 0;
    for row in 0..map.y.count() {
        for column in 0..map.x.count() {
            let Some(cell) = map.cell(column, row) else { continue };
            let fastest = match varied {
                Varied::Planes(_) => map.x.value(column).abs().max(map.y.value(row).abs()),
                Varied::Axes(_) => fixed.max_abs(),
            };
            let grows = cell.measured_growth_rate > MEASURABLE * fastest;
            let should = cell.growth_rate > MEASURABLE * fastest;
            let differs = (grows || should) && cell.verdict != Verdict::Unstable;
            count += usize::from(differs || (should && !grows));
        }
    }
    count
}

/// One line for each cell.
pub(super) fn as_csv(report: &MapReport) -> String {
    let mut columns: Vec<(String, Vec<f64>)> = [&report.x, &report.y]
        .iter()
        .map(|side| side.varies.clone())
        .chain(["stable", "growth_rate", "measured_growth_rate"].map(str::to_owned))
        .map(|heading| (heading, Vec::new()))
        .collect();
    for (row, y) in report.y.values.iter().enumerate() {
        for (column, x) in report.x.values.iter().enumerate() {
            let stable = report.stable[row][column].map_or(f64::NAN, |stable| f64::from(u8::from(stable)));
            let values = [*x, *y, stable, report.growth_rate[row][column], report.measured_growth_rate[row][column]];
            for ((_, list), value) in columns.iter_mut().zip(values) {
                list.push(value);
            }
        }
    }
    write_table(&columns)
}

pub(super) fn as_text(report: &MapReport) -> String {
    let cells = report.stable.iter().flatten();
    let total = cells.clone().count();
    let share = |verdict: Option<bool>| {
        let count = cells.clone().filter(|&&stable| stable == verdict).count();
        format!("{:.2} %", 100.0 * count as f64 / total as f64)
    };
    let largest = report.growth_rate.iter().flatten().fold(0.0, |largest: f64, &rate| largest.max(rate));
    let moments: Vec<String> = report.moments.iter().map(|&moment| number(moment)).collect();
    let side = |side: &Side| {
        let what = if side.unit == "rad/s" { "spin in plane" } else { "second moment of axis" };
        let [first, last] =
            [side.values.first(), side.values.last()].map(|value| number(value.copied().unwrap_or(0.0)));
        format!("{what} {} from {first} to {last} {}, {} values", side.varies, side.unit, side.values.len())
    };
    let mut lines = vec![("across", side(&report.x)), ("up", side(&report.y))];
    if let Some(spin) = &report.spin {
        let spin: Vec<String> = spin.0.iter().map(|(plane, rate)| format!("{plane} {}", number(*rate))).collect();
        lines.push(("spin", format!("{} rad/s", spin.join(", "))));
    }
    lines.extend([
        ("stable", share(Some(true))),
        ("unstable", format!("{}, growth at most {} /s", share(Some(false)), number(largest))),
        ("open", share(None)),
    ]);
    if let (Some(threshold), Some([inner, outer])) = (report.threshold, &report.inner_and_outer) {
        lines.push(("threshold", format!("{inner} holds {outer} above a ratio of their rates of {threshold:.10}")));
    }
    lines.push(("disagreements", format!("{} cells between verdict and measured growth", report.disagreements)));
    lines.push(("computed in", format!("{:.2} s", report.compute_seconds)));
    format!(
        "Stability of steady rotations, J = ({}) {}\n\n{}",
        moments.join(", "),
        report.moments_unit,
        labelled(lines)
    )
}
