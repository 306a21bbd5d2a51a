//! Where light comes from: a sun with a disc, a sky, and the ground's reflection.

use hyperbody::math::Vector;

use crate::camera::cross;
use crate::colour::Rgb;

/// Sun and sky, in slice coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Light {
    /// Towards the sun, unit.
    pub(crate) sun: Vector<3>,
    /// Two unit vectors across it.
    sun_frame: [Vector<3>; 2],
    pub(crate) sun_colour: Rgb,
    up: Vector<3>,
    zenith: Rgb,
    horizon: Rgb,
    ground: Rgb,
}

/// Radius of the sun's disc at unit distance. The true sun has 0.005; a larger one has softer shadows.
const SUN_RADIUS: f64 = 0.05;

impl Light {
    /// Light from over the left shoulder of an eye that looks along `forward`.
    pub(crate) fn new(up: Vector<3>, forward: Vector<3>) -> Self {
        let ahead = (forward - up * up.dot(forward)).try_normalize().unwrap_or_else(|| up.orthonormal_complement()[0]);
        let right = cross(ahead, up);
        let sun = (up * 1.0 - right * 0.75 - ahead * 0.28).normalize_or_zero();
        let [first, second, _] = sun.orthonormal_complement();
        Self {
            sun,
            sun_frame: [first, second],
            sun_colour: Rgb([1.30, 1.14, 0.92]),
            up,
            zenith: Rgb::from_hex(0x5E9BE0),
            horizon: Rgb::from_hex(0xEEF1F3),
            ground: Rgb::from_hex(0xB0A493) * 0.8,
        }
    }

    /// A direction towards a point of the sun's disc, by two numbers in [0, 1).
    #[inline]
    pub(crate) fn toward_sun(&self, [a, b]: [f64; 2]) -> Vector<3> {
        let [x, y] = disc([a, b]);
        let direction = self.sun + self.sun_frame[0] * (x * SUN_RADIUS) + self.sun_frame[1] * (y * SUN_RADIUS);
        direction * (1.0 / direction.norm())
    }

    /// What the eye sees in a direction where nothing is.
    pub(crate) fn sky(&self, direction: Vector<3>) -> Rgb {
        let height = self.up.dot(direction).max(0.0) as f32;
        // A pale band at the horizon, then quickly blue.
        self.horizon.mix(self.zenith, (2.2 * height).min(1.0).sqrt() * 0.95)
    }

    /// What a mirror shows in a direction: sky above, ground below, softly joined.
    pub(crate) fn surroundings(&self, direction: Vector<3>) -> Rgb {
        let height = self.up.dot(direction) as f32;
        let above = smooth(-0.15, 0.15, height);
        self.ground.mix(self.sky(direction), above)
    }

    /// The light that a surface gets from all around, were there nothing else.
    pub(crate) fn ambient(&self, normal: Vector<3>) -> Rgb {
        let share = 0.5 + 0.5 * self.up.dot(normal) as f32;
        let overhead = self.zenith.mix(self.horizon, 0.5) * 0.72;
        (self.ground * 0.75).mix(overhead, share)
    }
}

/// From 0 at `low` to 1 at `high`, smoothly.
pub(crate) fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A point of the unit disc from one of the unit square, areas in proportion (P. Shirley and K. Chiu, 1997).
pub(crate) fn disc([a, b]: [f64; 2]) -> [f64; 2] {
    use std::f64::consts::FRAC_PI_4;
    let (x, y) = (2.0 * a - 1.0, 2.0 * b - 1.0);
    if x == 0.0 && y == 0.0 {
        return [0.0; 2];
    }
    let (radius, angle) = if x.abs() > y.abs() { (x, FRAC_PI_4 * y / x) } else { (y, FRAC_PI_4 * (2.0 - x / y)) };
    let (sin, cos) = hyperbody::math::scalar::sin_cos(angle);
    [radius * cos, radius * sin]
}
