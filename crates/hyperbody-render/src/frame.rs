//! The picture itself: look, light, smooth, and look again where a pixel holds more than one thing.

use rayon::prelude::*;

use crate::camera::Lens;
use crate::colour::{Encoder, Rgb};
use crate::image::Image;
use crate::light::Light;
use crate::occlusion::{self, Reach};
use crate::stage::Stage;
use crate::surface::{SKY, Scratch, Seen};

/// What a frame is made of.
pub(crate) struct Frame<'a, const N: usize> {
    pub(crate) stage: &'a Stage<N>,
    pub(crate) lens: Lens,
    pub(crate) light: Light,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Rays to the sun, and as many to the sky, per pixel.
    pub(crate) light_rays: u32,
    /// Samples of a pixel at an edge.
    pub(crate) edge_samples: u32,
    pub(crate) ghosts: bool,
    /// Told the number of rows done, of three times the height.
    pub(crate) progress: &'a (dyn Fn(u64) + Sync),
}

/// Where a pixel is sampled when once is not enough: point `index` of `count` of the plastic-number sequence
/// (M. Roberts, 2018), which is even for every count.
fn subpixel(index: u32) -> (f64, f64) {
    let step = f64::from(index);
    let (a, b) = (0.5 + step * 0.754_877_666_246_693, 0.5 + step * 0.569_840_290_998_053);
    (a - a.floor(), b - b.floor())
}

impl<const N: usize> Frame<'_, N> {
    /// The finished picture. Every pixel depends on the stage alone, so threads cannot change it.
    pub(crate) fn image(&self) -> Image {
        let width = self.width;
        let mut seen = vec![Seen::default(); width * self.height];
        self.rows(&mut seen, |x, y, scratch| self.sample(x as f64 + 0.5, y as f64 + 0.5, scratch));
        let mut raw = vec![Reach::default(); seen.len()];
        self.rows(&mut raw, |x, y, scratch| {
            self.stage.reach(&seen[y * width + x], &self.light, (x, y), self.light_rays, &mut scratch.stack)
        });
        let mut bytes = vec![[0_u8; 3]; seen.len()];
        let encoder = Encoder::new();
        self.rows(&mut bytes, |x, y, scratch| {
            let colour = if self.edge_samples > 1 && self.is_mixed(&seen, x, y) {
                self.mixed(&seen, &raw, (x, y), scratch)
            } else {
                let reach = occlusion::smoothed(&seen, &raw, width, (x, y), self.stage.size);
                self.shade(&seen[y * width + x], reach, x as f64 + 0.5, y as f64 + 0.5)
            };
            encoder.bytes(self.vignette(colour, x, y))
        });
        Image::new(self.width as u32, self.height as u32, bytes.into_iter().flatten().collect())
    }

    /// Fills every pixel, rows in parallel.
    fn rows<T: Send>(&self, pixels: &mut [T], fill: impl Fn(usize, usize, &mut Scratch<N>) -> T + Sync) {
        pixels.par_chunks_mut(self.width).enumerate().for_each_init(Scratch::default, |scratch, (y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = fill(x, y, scratch);
            }
            (self.progress)(1);
        });
    }

    fn sample(&self, x: f64, y: f64, scratch: &mut Scratch<N>) -> Seen {
        self.stage.look(&self.lens.ray(x, y), self.lens.pixel_angle, self.ghosts, scratch)
    }

    /// Whether a pixel and its neighbours show different things.
    fn is_mixed(&self, seen: &[Seen], x: usize, y: usize) -> bool {
        let here = &seen[y * self.width + x];
        let differs = |x: usize, y: usize| {
            let other = &seen[y * self.width + x];
            other.key != here.key || (other.veil_cover - here.veil_cover).abs() > 0.04
        };
        (x > 0 && differs(x - 1, y))
            || (x + 1 < self.width && differs(x + 1, y))
            || (y > 0 && differs(x, y - 1))
            || (y + 1 < self.height && differs(x, y + 1))
    }

    /// The mean of several samples; each takes its light from a pixel nearby that shows the same surface, if there is one.
    fn mixed(&self, seen: &[Seen], raw: &[Reach], (x, y): (usize, usize), scratch: &mut Scratch<N>) -> Rgb {
        let mut sum = Rgb::BLACK;
        for index in 0..self.edge_samples {
            let (dx, dy) = subpixel(index);
            let (at_x, at_y) = (x as f64 + dx, y as f64 + dy);
            let sample = self.sample(at_x, at_y, scratch);
            let reach = if sample.key == SKY {
                Reach { sun: 1.0, sky: 1.0 }
            } else {
                match self.nearby(seen, sample.key, (x, y), (dx, dy)) {
                    Some(at) => occlusion::smoothed(seen, raw, self.width, at, self.stage.size),
                    None => {
                        let rays = 2 * self.light_rays;
                        self.stage.reach(&sample, &self.light, (x + index as usize, y), rays, &mut scratch.stack)
                    }
                }
            };
            // Bright samples would outshine the rest of an edge and leave steps.
            let colour = self.shade(&sample, reach, at_x, at_y);
            sum += colour * (1.0 / (1.0 + 0.5 * colour.luminance()));
        }
        let mean = sum * (1.0 / self.edge_samples as f32);
        mean * (1.0 / (1.0 - 0.5 * mean.luminance()).max(0.05))
    }

    /// The nearest of the nine pixels around that shows the surface.
    fn nearby(&self, seen: &[Seen], key: u32, (x, y): (usize, usize), (dx, dy): (f64, f64)) -> Option<(usize, usize)> {
        let mut best: Option<(f64, (usize, usize))> = None;
        for row in y.saturating_sub(1)..(y + 2).min(self.height) {
            for column in x.saturating_sub(1)..(x + 2).min(self.width) {
                if seen[row * self.width + column].key == key {
                    let across = column as f64 + 0.5 - x as f64 - dx;
                    let down = row as f64 + 0.5 - y as f64 - dy;
                    let away = across * across + down * down;
                    if best.is_none_or(|(least, _)| away < least) {
                        best = Some((away, (column, row)));
                    }
                }
            }
        }
        best.map(|(_, at)| at)
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
