//! One run of a free body and what is said of it.

use hyperbody::dynamics::free_top::stability::MAX_DISTURBANCE;
use hyperbody::dynamics::free_top::{
    Drift, DriftMeter, ExactMotion, FreeTop, Invariants, Method, RunPlan, Stability, TopRun, TopState, parse_spin,
    perturbed_run, plane_equations, run, stability,
};
use hyperbody::math::{Bivector, Dim, EvenAlgebra, Rotation, Vector, planes};
use hyperbody_scene::DimensionVisitor;

use super::arguments::SpinArguments;
use super::body::{Body, refused};
use super::report::{
    ClosedForm, Compared, Complex, Conserved, DriftReport, DriftSeries, DriveReport, Equation, FlipReport, Named,
    Period, Report, StabilityReport,
};
use crate::failure::Failure;
use crate::output::number;
use crate::progress::Progress;

/// Angles, in radians of the fastest turn, through which a disturbed run is followed: enough for a steady rotation to show
/// that it is stable, and at most.
const DISTURBED_RAD: f64 = 1e3;
const MAX_DISTURBED_RAD: f64 = 2e4;

/// E-foldings through which an unstable rotation is followed; from a part in 10¹⁰ to a part in 10⁴ it takes 13.8.
const DISTURBED_FOLDS: f64 = 20.0;

/// The step where none is given: one 240th of a second, as in a simulation.
const DEFAULT_DT: f64 = 1.0 / 240.0;

/// Angle in radians of one step from which on a run is not to be trusted, and the one that is recommended instead.
const TOO_LONG_RAD: f64 = 0.5;
const FINE_RAD: f64 = 0.1;

/// Largest deviation of the time between flips from its mean, relative, of what is called a period.
const REGULAR: f64 = 0.03;

/// Runs the body of the arguments, in whatever dimension it has.
pub(super) struct Trial<'a> {
    pub(super) body: &'a Body,
    pub(super) arguments: &'a SpinArguments,
}

impl DimensionVisitor for Trial<'_> {
    type Output = Result<Report, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let top = self.body.top::<N>()?;
        let (spin, push) = spin_of::<N>(self.arguments)?;
        let start = TopState::from_spin(&top, Rotation::IDENTITY, &spin).map_err(|error| refused("--spin", &error))?;
        let plan = plan(self.arguments, "--method", &self.arguments.method)?;
        let others = self.arguments.compare.iter().map(|name| self::plan(self.arguments, "--compare", name));
        let others = others.collect::<Result<Vec<RunPlan>, Failure>>()?;
        refuse_repeated(&plan, &others)?;
        let judged = stability(&top, &spin).map_err(|error| refused("--spin", &error))?;
        let record = follow(&top, &start, &plan, "--method")?;
        let mut compared = Vec::with_capacity(others.len());
        for other in &others {
            compared.push(compare(&top, &start, other, &record)?);
        }
        let exact = ExactMotion::new(&top, &start).ok();
        let warning = step_warning(&plan, &record);
        let flips = flip_report(&record, warning.is_none());
        let regular = flips.irregularity.is_some_and(|irregularity| irregularity <= REGULAR);
        Ok(Report {
            dimension: N,
            moments: self.body.moments.clone(),
            moments_unit: self.body.unit,
            spin: by_plane(&spin),
            push,
            method: plan.method.name(),
            seconds: plan.seconds,
            dt: record.dt,
            steps: record.steps,
            most_parts: record.most_parts,
            warning,
            stability: stability_report(&top, &judged)?,
            equations: equations(&top, &spin),
            conserved: conserved(&Invariants::of(&top, &start)),
            max_relative_drift: drift_report(record.drift),
            compared,
            flips,
            period: Period {
                measured: record.flips.period.filter(|_| regular),
                exact: exact.and_then(|exact| exact.period()).filter(|period| period.is_finite()),
            },
            closed_form: exact.map(|exact| ClosedForm {
                kind: kind_of(&exact),
                final_error: exact.state_at(plan.seconds).distance(record.final_state()),
            }),
            final_rotation: rows(&record.final_state().world_from_body),
            final_rotor: record.final_state().world_from_body_rotor().coefficients().to_vec(),
            times: record.times.clone(),
            angular_velocity: series_by_plane(record.spins.iter().copied()),
            energy: record.invariants.iter().map(|invariants| invariants.energy).collect(),
            angular_momentum: series_by_plane(record.invariants.iter().map(|invariants| invariants.momentum_in_world)),
            angular_momentum_in_body: series_by_plane(record.states.iter().map(|state| state.momentum_in_body)),
            angular_momentum_sq: record.invariants.iter().map(|invariants| invariants.momentum_sq).collect(),
            pfaffian: record.invariants.iter().map(|invariants| invariants.pfaffian).collect(),
            manakov: manakov_series(&record.invariants),
            rotation: record.states.iter().map(|state| rows(&state.world_from_body)).collect(),
            drift: drift_series(&top, &start, &record),
        })
    }
}

/// The spin of the arguments, and the push that it contains in every other plane, rad/s.
fn spin_of<const N: usize>(arguments: &SpinArguments) -> Result<(Bivector<N>, f64), Failure> {
    let text = arguments.spin.as_deref().unwrap_or_default();
    let spin = parse_spin::<N>(text).map_err(|error| refused("--spin", &error))?;
    let fraction = arguments.disturb;
    if !(0.0..=1.0).contains(&fraction) {
        return Err(Failure::Input(format!("--disturb: {fraction} is no fraction of the spin; give one from 0 to 1")));
    }
    let push = fraction * spin.norm();
    let pushed = Bivector::from_fn(|i, j| if spin.get(i, j) == 0.0 { push } else { spin.get(i, j) });
    Ok((pushed, push))
}

fn plan(arguments: &SpinArguments, option: &str, method: &str) -> Result<RunPlan, Failure> {
    let method = Method::from_name(method.trim()).map_err(|error| refused(option, &error))?;
    let mut plan = RunPlan::new(method, arguments.seconds, arguments.dt.unwrap_or(DEFAULT_DT))
        .map_err(|error| refused("--seconds, --dt", &error))?;
    plan.tolerance = arguments.tolerance;
    if plan.tolerance.is_some_and(|tolerance| !(tolerance > 0.0 && tolerance.is_finite())) {
        return Err(Failure::Input(format!(
            "--tolerance: {} is no tolerance; it must be finite and positive, such as 1e-9",
            arguments.tolerance.unwrap_or(f64::NAN)
        )));
    }
    let steps = plan.steps().map_err(|error| refused("--seconds, --dt", &error))?;
    // The default step is shortened without a word.
    if arguments.dt.is_some_and(|dt| dt > plan.seconds) {
        return Err(Failure::Input(format!(
            "--dt: a step of {} s is longer than the whole run of {} s; give a shorter --dt or more --seconds",
            number(plan.dt),
            number(plan.seconds)
        )));
    }
    plan.record_every = (steps / u64::from(arguments.samples)).max(1);
    Ok(plan)
}

/// Comparing a method with itself says nothing.
fn refuse_repeated(plan: &RunPlan, others: &[RunPlan]) -> Result<(), Failure> {
    for (index, other) in others.iter().enumerate() {
        let name = other.method.name();
        if other.method == plan.method {
            return Err(Failure::Input(format!("--compare: {name} is what the run itself takes; name other methods")));
        }
        if others[..index].iter().any(|earlier| earlier.method == other.method) {
            return Err(Failure::Input(format!("--compare: {name} is named twice; name every method once")));
        }
    }
    Ok(())
}

/// What to say of steps that are too long for the spin.
fn step_warning<const N: usize>(plan: &RunPlan, record: &TopRun<N>) -> Option<String> {
    let norms = record.spins.iter().map(Bivector::norm);
    let fastest = norms.filter(|norm| norm.is_finite()).fold(0.0, f64::max);
    let angle = fastest * record.dt;
    if angle <= TOO_LONG_RAD {
        return None;
    }
    let followed = plan.method == Method::Exact || plan.tolerance.is_some();
    let trouble = if followed {
        "too far to find every flip".to_owned()
    } else {
        format!("too far for {}, so that neither motion nor drift is to be trusted", plan.method.name())
    };
    Some(format!(
        "a step turns the body by {} rad, {trouble}; --dt {:.0e} would do. No flips and no period are reported",
        number(angle),
        FINE_RAD / fastest
    ))
}

fn follow<const N: usize>(
    top: &FreeTop<N>,
    start: &TopState<N>,
    plan: &RunPlan,
    option: &str,
) -> Result<TopRun<N>, Failure> {
    let steps = plan.steps().map_err(|error| refused("--seconds, --dt", &error))?;
    let mut progress = Progress::new(plan.method.name(), steps);
    let report = &mut |done, _| progress.reach(done);
    run(top, start, plan, report).map_err(|error| refused(option, &error))
}

fn compare<const N: usize>(
    top: &FreeTop<N>,
    start: &TopState<N>,
    plan: &RunPlan,
    with: &TopRun<N>,
) -> Result<Compared, Failure> {
    let record = follow(top, start, plan, "--compare")?;
    Ok(Compared {
        method: plan.method.name(),
        steps: record.steps,
        max_relative_drift: drift_report(record.drift),
        final_difference: record.final_state().distance(with.final_state()),
        drift: drift_series(top, start, &record),
        times: record.times,
    })
}

fn stability_report<const N: usize>(top: &FreeTop<N>, judged: &Stability<N>) -> Result<StabilityReport, Failure> {
    let turns = judged.rotation.turns();
    let fastest = turns.iter().map(|turn| turn.rate.abs()).fold(0.0, f64::max);
    let (measured_growth_rate, measured_growth_below) = if fastest > 0.0 && judged.disturbance <= MAX_DISTURBANCE {
        let folds = if judged.growth_rate > 0.0 { DISTURBED_FOLDS / judged.growth_rate } else { 0.0 };
        let seconds = folds.clamp(DISTURBED_RAD / fastest, MAX_DISTURBED_RAD / fastest);
        let run = perturbed_run(top, &judged.rotation, seconds).map_err(|error| refused("--spin", &error))?;
        (Some(if run.ran_away { run.growth_rate } else { 0.0 }), run.growth_bound)
    } else {
        (None, None)
    };
    Ok(StabilityReport {
        stable: judged.verdict.stable(),
        growth_rate: judged.growth_rate,
        measured_growth_rate,
        measured_growth_below,
        why: judged.why.clone(),
        rotation: Named(turns.iter().map(|turn| (planes::name(turn.i, turn.j), turn.rate)).collect()),
        disturbance: judged.disturbance,
        eigenvalues: judged
            .eigenvalues
            .iter()
            .map(|value| Complex { real: value.real, imaginary: value.imaginary })
            .collect(),
    })
}

fn equations<const N: usize>(top: &FreeTop<N>, spin: &Bivector<N>) -> Vec<Equation> {
    let name = |(i, j): (usize, usize)| planes::name(i, j);
    plane_equations(top, spin)
        .into_iter()
        .map(|equation| Equation {
            plane: name(equation.plane),
            moment: equation.moment,
            text: equation.to_text(),
            rate: equation.rate,
            drives: equation
                .drives
                .iter()
                .map(|drive| DriveReport {
                    planes: drive.planes.map(name),
                    coefficient: drive.coefficient,
                    rate: drive.rate,
                })
                .collect(),
            never_driven_by: equation.never_driven_by.iter().copied().map(name).collect(),
        })
        .collect()
}

fn conserved<const N: usize>(invariants: &Invariants<N>) -> Conserved {
    Conserved {
        energy: invariants.energy,
        angular_momentum_sq: invariants.momentum_sq,
        angular_momentum: by_plane(&invariants.momentum_in_world),
        pfaffian: invariants.pfaffian,
        manakov: by_axis(&invariants.manakov),
    }
}

fn kind_of<const N: usize>(exact: &ExactMotion<N>) -> &'static str {
    match exact {
        ExactMotion::Steady(_) => "steady",
        ExactMotion::Blocks(_) => "blocks",
        ExactMotion::ThreeAxes(_) => "three axes",
        _ => "closed form",
    }
}

fn drift_report(drift: Drift) -> DriftReport {
    DriftReport {
        energy: drift.energy,
        angular_momentum_sq: drift.momentum_sq,
        angular_momentum: drift.momentum_in_world,
        pfaffian: drift.pfaffian,
        manakov: drift.manakov,
    }
}

/// The flips, if steps are short enough to find them.
fn flip_report<const N: usize>(record: &TopRun<N>, found: bool) -> FlipReport {
    let flips = &record.flips;
    FlipReport {
        plane: planes::name(flips.plane.0, flips.plane.1),
        times: if found { flips.times.clone() } else { Vec::new() },
        irregularity: flips.irregularity.filter(|_| found),
    }
}

/// The largest drift up to each recorded time; between them it may have been larger.
fn drift_series<const N: usize>(top: &FreeTop<N>, start: &TopState<N>, record: &TopRun<N>) -> DriftSeries {
    let mut meter = DriftMeter::new(top, start);
    let mut drifts = Vec::with_capacity(record.invariants.len());
    for invariants in &record.invariants {
        meter.observe(invariants);
        drifts.push(meter.drift());
    }
    let series = |value: fn(&Drift) -> f64| drifts.iter().map(value).collect::<Vec<f64>>();
    DriftSeries {
        energy: series(|drift| drift.energy),
        angular_momentum_sq: series(|drift| drift.momentum_sq),
        angular_momentum: series(|drift| drift.momentum_in_world),
        pfaffian: drifts.iter().map(|drift| drift.pfaffian).collect(),
        manakov: series(|drift| drift.manakov),
    }
}

fn by_plane<const N: usize>(values: &Bivector<N>) -> Named<f64> {
    Named(planes::all(N).zip(values.planes()).map(|((i, j), value)| (planes::name(i, j), value)).collect())
}

fn by_axis<const N: usize>(values: &Vector<N>) -> Named<f64> {
    Named((0..N).map(|axis| (planes::AXIS_NAMES[axis].to_string(), values[axis])).collect())
}

fn series_by_plane<const N: usize>(values: impl Iterator<Item = Bivector<N>>) -> Named<Vec<f64>> {
    let mut series: Vec<(String, Vec<f64>)> = planes::all(N).map(|(i, j)| (planes::name(i, j), Vec::new())).collect();
    for bivector in values {
        for ((_, list), value) in series.iter_mut().zip(bivector.planes()) {
            list.push(value);
        }
    }
    Named(series)
}

fn manakov_series<const N: usize>(invariants: &[Invariants<N>]) -> Named<Vec<f64>> {
    let of_axis = |axis: usize| invariants.iter().map(|invariants| invariants.manakov[axis]).collect();
    Named((0..N).map(|axis| (planes::AXIS_NAMES[axis].to_string(), of_axis(axis))).collect())
}

fn rows<const N: usize>(rotation: &Rotation<N>) -> Vec<Vec<f64>> {
    (0..N).map(|row| rotation.matrix().row(row).iter().collect()).collect()
}
