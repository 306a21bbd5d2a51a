//! What a run of a free body found, in the form that is printed as JSON. All series have one entry for each time.

use serde::{Serialize, Serializer};

use crate::output::number;

/// Values by name, in order; serialised as an object.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Named<T>(pub(super) Vec<(String, T)>);

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

#[derive(Serialize)]
pub(super) struct Report {
    pub(super) dimension: usize,
    /// Second moments by axis.
    pub(super) moments: Vec<f64>,
    /// Unit of the moments; energies and momenta are per unit mass where it is m².
    pub(super) moments_unit: &'static str,
    /// At the start, in the body frame, rad/s.
    pub(super) spin: Named<f64>,
    /// What every plane got that was to have no spin, rad/s.
    pub(super) push: f64,
    pub(super) method: &'static str,
    pub(super) seconds: f64,
    pub(super) dt: f64,
    pub(super) steps: u64,
    /// Most parts into which error control divided a step.
    pub(super) most_parts: u64,
    /// Why the run is not to be trusted: steps too long for the spin.
    pub(super) warning: Option<String>,
    pub(super) stability: StabilityReport,
    pub(super) equations: Vec<Equation>,
    pub(super) conserved: Conserved,
    pub(super) max_relative_drift: DriftReport,
    pub(super) compared: Vec<Compared>,
    pub(super) flips: FlipReport,
    pub(super) period: Period,
    /// How far the run is from the closed form at its end, where there is one.
    pub(super) closed_form: Option<ClosedForm>,
    /// Rows of the matrix that turns body axes into world axes, at the end.
    pub(super) final_rotation: Vec<Vec<f64>>,
    /// The same as a rotor: scalar, planes, 4-vectors, ….
    pub(super) final_rotor: Vec<f64>,
    /// s.
    pub(super) times: Vec<f64>,
    /// In the body frame, rad/s.
    pub(super) angular_velocity: Named<Vec<f64>>,
    pub(super) energy: Vec<f64>,
    /// In the world frame, where it is conserved.
    pub(super) angular_momentum: Named<Vec<f64>>,
    pub(super) angular_momentum_in_body: Named<Vec<f64>>,
    pub(super) angular_momentum_sq: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pfaffian: Option<Vec<f64>>,
    /// Manakov's integrals, by axis.
    pub(super) manakov: Named<Vec<f64>>,
    pub(super) rotation: Vec<Vec<Vec<f64>>>,
    /// Largest relative drift up to each time.
    pub(super) drift: DriftSeries,
}

#[derive(Serialize)]
pub(super) struct StabilityReport {
    /// Null where the linear problem cannot tell, or where the spin is no disturbed steady rotation.
    pub(super) stable: Option<bool>,
    /// Of the fastest growing disturbance, 1/s.
    pub(super) growth_rate: f64,
    /// From a run that was disturbed by a part in 10¹⁰, 1/s: zero where nothing grew to a part in 10⁴; null where there is no
    /// steady rotation to disturb.
    pub(super) measured_growth_rate: Option<f64>,
    /// Growth that this run rules out where it measured none, 1/s.
    pub(super) measured_growth_below: Option<f64>,
    pub(super) why: String,
    /// The steady rotation that was judged, rad/s.
    pub(super) rotation: Named<f64>,
    /// Fraction of the spin that lies outside of it.
    pub(super) disturbance: f64,
    /// Of the linearised motion, 1/s.
    pub(super) eigenvalues: Vec<Complex>,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct Complex {
    pub(super) real: f64,
    pub(super) imaginary: f64,
}

#[derive(Serialize)]
pub(super) struct Equation {
    pub(super) plane: String,
    pub(super) moment: f64,
    pub(super) text: String,
    /// At the start, rad/s².
    pub(super) rate: f64,
    pub(super) drives: Vec<DriveReport>,
    pub(super) never_driven_by: Vec<String>,
}

#[derive(Serialize)]
pub(super) struct DriveReport {
    pub(super) planes: [String; 2],
    pub(super) coefficient: f64,
    /// At the start, rad/s².
    pub(super) rate: f64,
}

/// The conserved quantities at the start.
#[derive(Serialize)]
pub(super) struct Conserved {
    pub(super) energy: f64,
    pub(super) angular_momentum_sq: f64,
    pub(super) angular_momentum: Named<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pfaffian: Option<f64>,
    pub(super) manakov: Named<f64>,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct DriftReport {
    pub(super) energy: f64,
    pub(super) angular_momentum_sq: f64,
    /// Of the momentum in the world frame, as a whole.
    pub(super) angular_momentum: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pfaffian: Option<f64>,
    pub(super) manakov: f64,
}

#[derive(Clone, Serialize)]
pub(super) struct DriftSeries {
    pub(super) energy: Vec<f64>,
    pub(super) angular_momentum_sq: Vec<f64>,
    pub(super) angular_momentum: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pfaffian: Option<Vec<f64>>,
    pub(super) manakov: Vec<f64>,
}

/// The same run by another method.
#[derive(Serialize)]
pub(super) struct Compared {
    pub(super) method: &'static str,
    pub(super) steps: u64,
    pub(super) max_relative_drift: DriftReport,
    /// Of the attitude (its matrix) and the relative momentum at the end, from those of the run.
    pub(super) final_difference: f64,
    pub(super) times: Vec<f64>,
    pub(super) drift: DriftSeries,
}

#[derive(Serialize)]
pub(super) struct FlipReport {
    /// The plane whose momentum changes its sign.
    pub(super) plane: String,
    /// s; none where the steps are too long to find them.
    pub(super) times: Vec<f64>,
    /// Largest deviation of the time between flips from its mean, relative to it.
    pub(super) irregularity: Option<f64>,
}

/// Of the momentum in the body frame, s; two flips make a period.
#[derive(Serialize)]
pub(super) struct Period {
    /// Null unless the time between flips is the same to a few percent.
    pub(super) measured: Option<f64>,
    /// From Jacobi's functions; null where they do not apply, or on the separatrix, where it is infinite.
    pub(super) exact: Option<f64>,
}

#[derive(Serialize)]
pub(super) struct ClosedForm {
    pub(super) kind: &'static str,
    /// Of the attitude (its matrix) and the relative momentum at the end.
    pub(super) final_error: f64,
}

impl Report {
    /// The spin at the start in words: "xz = 1 rad/s, 0.001 rad/s in every other plane". At most `most` planes are named.
    pub(super) fn spin_text(&self, most: usize) -> String {
        let turning: Vec<&(String, f64)> =
            self.spin.0.iter().filter(|(_, rate)| *rate != 0.0 && *rate != self.push).collect();
        let mut parts: Vec<String> =
            turning.iter().take(most).map(|(plane, rate)| format!("{plane} = {}", number(*rate))).collect();
        if turning.len() > most {
            parts.push("…".to_owned());
        }
        if parts.is_empty() {
            return "none".to_owned();
        }
        let push = if self.push == 0.0 {
            String::new()
        } else {
            format!(", {} rad/s in every other plane", number(self.push))
        };
        format!("{} rad/s{push}", parts.join(", "))
    }

    /// The time step in words: "1/240 s" where that is what was meant.
    pub(super) fn dt_text(&self) -> String {
        let per_second = (1.0 / self.dt).round();
        if (1e-6..0.1).contains(&self.dt) && (per_second * self.dt - 1.0).abs() < 1e-9 {
            format!("1/{per_second} s")
        } else {
            format!("{} s", number(self.dt))
        }
    }
}
