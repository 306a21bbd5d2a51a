//! Spins in words: `"xy=1, zw=0.2"`.

use hyperbody_math::{Bivector, planes};

use super::error::{FreeTopError, FreeTopErrorKind, Result};

/// The spin written as plane names with rates in rad/s, separated by commas: `"xy=1,zw=0.2"`. A name in descending order
/// such as `yx` is the same plane with the opposite sense; planes that are not named do not turn.
///
/// # Errors
/// If a part is not `plane=number`, a plane does not exist in `N` dimensions or is named twice, or a rate is not finite.
///
/// ```
/// use hyperbody_dynamics::free_top::parse_spin;
/// let spin = parse_spin::<4>("xy=1, wz=0.2")?;
/// assert_eq!(spin.get(2, 3), -0.2);
/// assert!(parse_spin::<3>("xw=1").is_err());
/// # Ok::<(), hyperbody_dynamics::free_top::FreeTopError>(())
/// ```
pub fn parse_spin<const N: usize>(text: &str) -> Result<Bivector<N>> {
    let mut spin = Bivector::ZERO;
    let mut seen = [[false; N]; N];
    for part in text.split(',').map(str::trim) {
        let Some((name, rate)) = part.split_once('=') else {
            return Err(bad_spin(format!("\"{part}\" is not plane=rate, such as xy=1.5")));
        };
        let Some((i, j)) = planes::from_name(N, name.trim()) else {
            return Err(bad_spin(format!(
                "\"{}\" is no plane of {N} dimensions; the planes are {}",
                name.trim(),
                planes::all(N).map(|(i, j)| planes::name(i, j)).collect::<Vec<_>>().join(" ")
            )));
        };
        let rate = match rate.trim().parse::<f64>() {
            Ok(rate) if rate.is_finite() => rate,
            _ => return Err(bad_spin(format!("the rate \"{}\" of plane {name} is no finite number", rate.trim()))),
        };
        if seen[i.min(j)][i.max(j)] {
            return Err(bad_spin(format!("plane {} is given twice", planes::name(i.min(j), i.max(j)))));
        }
        seen[i.min(j)][i.max(j)] = true;
        spin.set(i, j, rate);
    }
    Ok(spin)
}

/// The planes of a spin that turn, as [`parse_spin`] reads them: `"xy=1, zw=0.2"`, or `"no spin"`.
#[must_use]
pub fn spin_to_text<const N: usize>(spin: &Bivector<N>) -> String {
    let parts: Vec<String> = planes::all(N)
        .filter(|&(i, j)| spin.get(i, j) != 0.0)
        .map(|(i, j)| format!("{}={}", planes::name(i, j), spin.get(i, j)))
        .collect();
    if parts.is_empty() { "no spin".to_owned() } else { parts.join(", ") }
}

fn bad_spin(message: String) -> FreeTopError {
    FreeTopError::new(FreeTopErrorKind::Spin, message)
}
