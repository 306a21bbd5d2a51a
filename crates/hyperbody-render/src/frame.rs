//! The picture itself: look, light, smooth, and look again where a pixel holds more than one thing.

use std::ops::Range;

use rayon::prelude::*;

use crate::camera::Lens;
use crate::colour::{Encoder, Rgb};
use crate::image::Image;
use crate::light::Light;
use crate::occlusion::{BLOCK, Blockers, LightRays, Reach, Smoother};
use crate::stage::Stage;
use crate::surface::{NO_SOLID, SKY, Scratch, Seen};

/// What a frame is made of.
pub(crate) struct Frame<'a, const N: usize> {
    pub(crate) stage: &'a Stage<N>,
    pub(crate) lens: Lens,
    pub(crate) light: Light,
    /// Rays for light: those of every pixel, and those of samples that no pixel nearby speaks for.
    pub(crate) rays: [LightRays; 2],
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Rows that are worked on together.
    pub(crate) rows_at_once: usize,
    /// Samples of a pixel at an edge.
    pub(crate) edge_samples: u32,
    pub(crate) ghosts: bool,
    /// Told the number of rows done, of four times the height.
    pub(crate) progress: &'a (dyn Fn(u64) + Sync),
}

/// Most pixels that are worked on together: what is known of each takes some 150 bytes, and a picture of 8192 × 8192 pixels
/// would take 10 GB at once.
const PIXELS_AT_ONCE: usize = 2_000_000;

/// Rows beyond its own that a band needs: the mean of the light reaches four rows down, from a neighbour of the pixel.
const MARGIN: usize = BLOCK + 1;

/// Some rows of a picture, and all that is known of them and of the rows around.
struct Band {
    /// The first row that is known.
    first: usize,
    /// What is known of pixels, by rows.
    seen: Vec<Seen>,
    reach: Vec<Reach>,
}

/// Whether two samples show different things.
fn is_other(a: &Seen, b: &Seen) -> bool {
    a.key != b.key || (a.veil_cover - b.veil_cover).abs() > 0.04
}

/// Samples of a pixel beside an edge that have to agree for the others to be spared: the middle and four near the corners.
const FIRST_SAMPLES: u32 = 5;

/// The order of the first points, those first that matter for [`FIRST_SAMPLES`].
const FIRST_POINTS: [u32; 8] = [0, 1, 3, 6, 4, 2, 5, 7];

/// Where a pixel is sampled when once is not enough, first in its middle: points of the plastic-number sequence
/// (M. Roberts, 2018), which are even for every count.
fn subpixel(index: u32) -> (f64, f64) {
    let step = f64::from(*FIRST_POINTS.get(index as usize).unwrap_or(&index));
    let (a, b) = (0.5 + step * 0.754_877_666_246_693, 0.5 + step * 0.569_840_290_998_053);
    (a - a.floor(), b - b.floor())
}

impl Band {
    /// The place of a pixel of the picture.
    fn index(&self, width: usize, x: usize, y: usize) -> usize {
        (y - self.first) * width + x
    }
}

impl<const N: usize> Frame<'_, N> {
    /// Rows of so many pixels that may be worked on together.
    pub(crate) fn rows_at_once(width: u32) -> usize {
        (PIXELS_AT_ONCE / width as usize).max(8 * MARGIN)
    }

    /// The finished picture. Every pixel depends on the stage alone, so threads cannot change it.
    pub(crate) fn image(&self) -> Image {
        let mut pixels = vec![[0_u8; 3]; self.width * self.height];
        let encoder = Encoder::new();
        for (number, own) in pixels.chunks_mut(self.width * self.rows_at_once).enumerate() {
            let start = number * self.rows_at_once;
            let rows = start..start + own.len() / self.width;
            let band = self.band(&rows);
            self.rows(own, start, &rows, |y, row, scratch| {
                for (x, pixel) in row.iter_mut().enumerate() {
                    let at = band.index(self.width, x, y);
                    let colour = if self.edge_samples > 1 && self.is_mixed(&band, x, y) {
                        self.mixed(&band, (x, y), scratch)
                    } else {
                        self.shade(&band.seen[at], band.reach[at], x as f64 + 0.5, y as f64 + 0.5)
                    };
                    *pixel = encoder.bytes(self.vignette(colour, x, y));
                }
            });
        }
        Image::new(self.width as u32, self.height as u32, pixels.into_flattened())
    }

    /// All that is known of some rows, and of those around.
    fn band(&self, own: &Range<usize>) -> Band {
        let (first, last) = (own.start.saturating_sub(MARGIN), (own.end + MARGIN).min(self.height));
        let count = self.width * (last - first);
        let mut seen = vec![Seen::default(); count];
        self.rows(&mut seen, first, own, |y, row, scratch| {
            let mut guess = NO_SOLID;
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = self.sample(x as f64 + 0.5, y as f64 + 0.5, guess, scratch);
                guess = pixel.solid;
            }
        });
        let mut raw = vec![Reach::default(); count];
        self.rows(&mut raw, first, own, |y, row, scratch| {
            let mut blockers = Blockers::default();
            for (x, (pixel, seen)) in row.iter_mut().zip(&seen[(y - first) * self.width..]).enumerate() {
                let memory = (&mut blockers, &mut scratch.stack);
                *pixel = self.stage.reach(seen, &self.light, (x, y), &self.rays[0], memory);
            }
        });
        let mut reach = vec![Reach::default(); count];
        let smoother = Smoother::new(&seen, &raw, self.width, self.stage.size);
        self.rows(&mut reach, first, own, |y, row, _| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = smoother.at(x, y - first);
            }
        });
        Band { first, seen, reach }
    }

    /// Fills the rows from `first` on in parallel, and tells of the band's own rows.
    fn rows<T: Send>(
        &self,
        pixels: &mut [T],
        first: usize,
        own: &Range<usize>,
        fill: impl Fn(usize, &mut [T], &mut Scratch<N>) + Sync,
    ) {
        pixels.par_chunks_mut(self.width).enumerate().for_each_init(Scratch::default, |scratch, (number, row)| {
            let y = first + number;
            fill(y, row, scratch);
            if own.contains(&y) {
                (self.progress)(1);
            }
        });
    }

    fn sample(&self, x: f64, y: f64, guess: u32, scratch: &mut Scratch<N>) -> Seen {
        self.stage.look(&self.lens.ray(x, y), self.lens.pixel_angle, self.ghosts, guess, scratch)
    }

    /// Whether a pixel and its neighbours show different things.
    fn is_mixed(&self, band: &Band, x: usize, y: usize) -> bool {
        let here = &band.seen[band.index(self.width, x, y)];
        let differs = |x: usize, y: usize| is_other(here, &band.seen[band.index(self.width, x, y)]);
        (x > 0 && differs(x - 1, y))
            || (x + 1 < self.width && differs(x + 1, y))
            || (y > 0 && differs(x, y - 1))
            || (y + 1 < self.height && differs(x, y + 1))
    }

    /// The mean of several samples; each takes its light from a pixel nearby that shows the same surface, if there is one.
    fn mixed(&self, band: &Band, (x, y): (usize, usize), scratch: &mut Scratch<N>) -> Rgb {
        let here = &band.seen[band.index(self.width, x, y)];
        let mut sum = Rgb::BLACK;
        let (mut count, mut agree) = (0.0, true);
        for index in 0..self.edge_samples {
            // The edge is the neighbour's.
            if index == FIRST_SAMPLES && agree {
                break;
            }
            let (dx, dy) = subpixel(index);
            let (at_x, at_y) = (x as f64 + dx, y as f64 + dy);
            // The first one is the middle of the pixel, which is known.
            let sample = if index == 0 { *here } else { self.sample(at_x, at_y, here.solid, scratch) };
            let reach = if sample.key == SKY {
                Reach::OPEN
            } else {
                self.nearby(band, sample.key, (x, y), (dx, dy)).unwrap_or_else(|| {
                    let place = (x + index as usize, y);
                    let memory = (&mut Blockers::default(), &mut scratch.stack);
                    self.stage.reach(&sample, &self.light, place, &self.rays[1], memory)
                })
            };
            agree &= !is_other(here, &sample);
            count += 1.0;
            // Bright samples would outshine the rest of an edge and leave steps.
            let colour = self.shade(&sample, reach, at_x, at_y);
            sum += colour * (1.0 / (1.0 + 0.5 * colour.luminance()));
        }
        let mean = sum * (1.0 / count);
        mean * (1.0 / (1.0 - 0.5 * mean.luminance()).max(0.05))
    }

    /// What reaches the nearest of the nine pixels around that shows the surface.
    fn nearby(&self, band: &Band, key: u32, (x, y): (usize, usize), (dx, dy): (f64, f64)) -> Option<Reach> {
        let mut best: Option<(f64, Reach)> = None;
        for row in y.saturating_sub(1)..(y + 2).min(self.height) {
            for column in x.saturating_sub(1)..(x + 2).min(self.width) {
                let at = band.index(self.width, column, row);
                if band.seen[at].key == key {
                    let across = column as f64 + 0.5 - x as f64 - dx;
                    let down = row as f64 + 0.5 - y as f64 - dy;
                    let away = across * across + down * down;
                    if best.is_none_or(|(least, _)| away < least) {
                        best = Some((away, band.reach[at]));
                    }
                }
            }
        }
        best.map(|(_, reach)| reach)
    }

    /// The light that comes from a sample to the eye.
    fn shade(&self, seen: &Seen, reach: Reach, x: f64, y: f64) -> Rgb {
        let view = self.lens.ray(x, y).direction;
        let sky = self.light.sky(view);
        let mut colour = sky;
        if seen.key != SKY {
            let normal = seen.bent_normal;
            let facing_sun = normal.dot(self.light.sun).max(0.0) as f32;
            let sun = self.light.sun_colour * (facing_sun * reach.sun);
            // Corners that the sky does not reach still get what their surroundings reflect.
            let around = self.light.ambient(normal) * (0.12 + 0.88 * reach.sky);
            colour = seen.albedo.times(sun + around);
            colour += self.shine(seen, reach, view) * seen.gloss;
            colour = colour.mix(sky, seen.haze);
        }
        colour * (1.0 - seen.veil_cover) + seen.veil
    }

    /// The reflection of a clear coat: sky and ground by Fresnel's law (C. Schlick, 1994), and the sun's glint.
    fn shine(&self, seen: &Seen, reach: Reach, view: hyperbody::math::Vector<3>) -> Rgb {
        let normal = seen.bent_normal;
        let facing = (-view.dot(normal)).clamp(0.0, 1.0) as f32;
        let rest = 1.0 - facing;
        let fresnel = 0.04 + 0.96 * (rest * rest) * (rest * rest) * rest;
        let mirrored = view - normal * (2.0 * view.dot(normal));
        let around = self.light.surroundings(mirrored) * (fresnel * (0.2 + 0.8 * reach.sky) * 0.75);
        let half = (self.light.sun - view).normalize_or_zero();
        let mut glint = normal.dot(half).max(0.0) as f32;
        for _ in 0..7 {
            glint *= glint;
        }
        around + self.light.sun_colour * (glint * reach.sun * 0.45)
    }

    /// A little darker towards the corners.
    fn vignette(&self, colour: Rgb, x: usize, y: usize) -> Rgb {
        let across = 2.0 * (x as f32 + 0.5) / self.width as f32 - 1.0;
        let down = 2.0 * (y as f32 + 0.5) / self.height as f32 - 1.0;
        colour * (1.0 - 0.07 * (across * across + down * down))
    }
}
