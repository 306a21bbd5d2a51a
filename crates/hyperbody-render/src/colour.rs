//! Colours: linear light inside, sRGB bytes outside.

use std::ops::{Add, AddAssign, Mul};

use hyperbody::math::scalar;

/// Linear red, green and blue; 1 is the brightest that a screen shows before tone mapping.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Rgb(pub(crate) [f32; 3]);

impl Rgb {
    pub(crate) const BLACK: Self = Self([0.0; 3]);
    pub(crate) const WHITE: Self = Self([1.0; 3]);

    pub(crate) const fn grey(value: f32) -> Self {
        Self([value; 3])
    }

    /// A colour as designers write it.
    pub(crate) fn from_hex(hex: u32) -> Self {
        Self([16, 8, 0].map(|shift| to_linear((hex >> shift & 255) as f32 / 255.0)))
    }

    /// Red, green and blue in sRGB, 0..=1.
    pub(crate) fn from_srgb(parts: [f64; 3]) -> Self {
        Self(parts.map(|part| to_linear(part.clamp(0.0, 1.0) as f32)))
    }

    /// Component by component.
    pub(crate) fn times(self, other: Self) -> Self {
        Self([self.0[0] * other.0[0], self.0[1] * other.0[1], self.0[2] * other.0[2]])
    }

    /// From self (0) to other (1).
    pub(crate) fn mix(self, other: Self, share: f32) -> Self {
        self * (1.0 - share) + other * share
    }

    pub(crate) fn luminance(self) -> f32 {
        0.2126 * self.0[0] + 0.7152 * self.0[1] + 0.0722 * self.0[2]
    }

    /// Stronger (> 1) or paler (< 1) at the same luminance.
    pub(crate) fn saturated(self, factor: f32) -> Self {
        let grey = self.luminance();
        Self(self.0.map(|component| (grey + (component - grey) * factor).max(0.0)))
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, other: Self) {
        for (a, b) in self.0.iter_mut().zip(other.0) {
            *a += b;
        }
    }
}

impl Mul<f32> for Rgb {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self(self.0.map(|component| component * factor))
    }
}

/// The sRGB transfer function (IEC 61966-2-1), from encoded to linear.
fn to_linear(encoded: f32) -> f32 {
    let encoded = f64::from(encoded);
    let linear = if encoded <= 0.04045 { encoded / 12.92 } else { scalar::pow((encoded + 0.055) / 1.055, 2.4) };
    linear as f32
}

fn to_encoded(linear: f32) -> f32 {
    let linear = f64::from(linear.clamp(0.0, 1.0));
    let encoded = if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * scalar::pow(linear, 1.0 / 2.4) - 0.055 };
    encoded as f32
}

/// Entries of the table of [`Encoder`]: steps far below one byte value.
const TABLE: usize = 4096;

/// From scene light to bytes: bright colours are compressed, and the sRGB curve is looked up in a table.
pub(crate) struct Encoder {
    table: Vec<f32>,
}

impl Encoder {
    pub(crate) fn new() -> Self {
        // Finer steps in the dark, where the sRGB curve is steep.
        let root = |index: usize| index as f32 / (TABLE - 1) as f32;
        Self { table: (0..TABLE).map(|index| 255.0 * to_encoded(root(index) * root(index))).collect() }
    }

    /// A byte for each component.
    pub(crate) fn bytes(&self, colour: Rgb) -> [u8; 3] {
        compressed(colour).0.map(|linear| {
            let place = linear.clamp(0.0, 1.0).sqrt() * (TABLE - 1) as f32;
            let low = (place as usize).min(TABLE - 2);
            let value = self.table[low] + (self.table[low + 1] - self.table[low]) * (place - low as f32);
            (value + 0.5) as u8
        })
    }
}

/// Colours up to 0.76 as they are, brighter ones pressed below 1 and paler the brighter they are: the neutral tone map
/// of the Khronos Group (2024), without its correction for reflections of black.
fn compressed(colour: Rgb) -> Rgb {
    const START: f32 = 0.76;
    const PALING: f32 = 0.15;
    let peak = colour.0.iter().fold(0.0, |peak, &component| f32::max(peak, component));
    if peak <= START {
        return colour;
    }
    let rest = 1.0 - START;
    let pressed = 1.0 - rest * rest / (peak + rest - START);
    let pale = 1.0 - 1.0 / (PALING * (peak - pressed) + 1.0);
    (colour * (pressed / peak)).mix(Rgb::grey(pressed), pale)
}

/// Colours that go together, by the number of the body; warm and cool in turn.
pub(crate) fn of_body(number: u32) -> Rgb {
    const PALETTE: [u32; 10] =
        [0xE8553A, 0x2A9D9F, 0xF2A93B, 0x4C6FD6, 0xE9728F, 0x5FB36A, 0x8A5FC7, 0xF4D35E, 0x3DA5D9, 0xF2E9DC];
    // Rows of ten in a grid of bodies would line up.
    Rgb::from_hex(PALETTE[(number + number / 10 * 3 + number / 50) as usize % PALETTE.len()])
}

/// What stands still by itself: ramps, hooks, static blocks.
pub(crate) fn of_fixture(number: u32) -> Rgb {
    const PALETTE: [u32; 3] = [0xC9BFB2, 0xB7B9C2, 0xBFC6BA];
    Rgb::from_hex(PALETTE[number as usize % PALETTE.len()])
}

/// The tint of what lies beside the slice, by the direction in which it lies: from blue on the positive side of the first
/// hidden direction to orange on the negative side, and green and pink along the second.
pub(crate) fn of_side(hidden: &[f64]) -> Rgb {
    let (first, second) = (hidden.first().copied().unwrap_or(0.0), hidden.get(1).copied().unwrap_or(0.0));
    let length = (first * first + second * second).sqrt();
    if length == 0.0 {
        return Rgb::grey(0.5);
    }
    let (along, across) = ((first / length) as f32, (second / length) as f32);
    let ends = [(along, 0x3B7DFF), (-along, 0xFF8A2B), (across, 0x3CC46B), (-across, 0xE65AA8)];
    let mut sum = Rgb::BLACK;
    let mut weights = 0.0;
    for (weight, hex) in ends.into_iter().filter(|(weight, _)| *weight > 0.0) {
        sum += Rgb::from_hex(hex) * weight;
        weights += weight;
    }
    sum * (1.0 / weights)
}
