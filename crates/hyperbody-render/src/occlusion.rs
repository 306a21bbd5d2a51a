//! How much sun and sky reach a point: a few rays a pixel, spread so that every block of 4 × 4 pixels holds the whole
//! pattern, and then a mean over four such blocks that stays on the same surface (interleaved sampling; A. Keller and
//! W. Heidrich, 2001). The pattern is fixed: the same picture every time.

use hyperbody::collision::RayStack;
use hyperbody::collision::ray::Ray;
use hyperbody::math::Vector;

use crate::light::{Light, disc};
use crate::stage::Stage;
use crate::surface::{NO_SOLID, SKY, Seen};

/// Shares of the sun and of the sky that reach a point, in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Reach {
    pub(crate) sun: f32,
    pub(crate) sky: f32,
}

/// Width and height of a block of the pattern.
pub(crate) const BLOCK: usize = 4;

/// The place of each pixel of a block in the pattern; neighbours far apart (B. E. Bayer, 1973).
const ORDER: [[u32; BLOCK]; BLOCK] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// How far rays look for what keeps the sky away, in sizes of a body.
const SKY_REACH: f64 = 3.0;

/// Point `index` of `count` of the Hammersley set, turned on the torus by `shift`.
fn pattern(index: u32, count: u32, shift: [f64; 2]) -> [f64; 2] {
    let first = (f64::from(index) + 0.5) / f64::from(count) + shift[0];
    let second = f64::from(index.reverse_bits()) / 4_294_967_296.0 + shift[1];
    [first - first.floor(), second - second.floor()]
}

/// The directions of all rays of a block, which every block repeats.
#[derive(Clone, Debug)]
pub(crate) struct LightRays {
    /// Rays to the sun, and as many to the sky, per pixel.
    per_pixel: usize,
    /// Towards points of the sun's disc, unit.
    sun: Vec<Vector<3>>,
    /// Directions about a normal, dense as its cosine: parts across it, and along it.
    sky: Vec<[f64; 3]>,
}

impl LightRays {
    pub(crate) fn new(light: &Light, per_pixel: u32) -> Self {
        let count = per_pixel * (BLOCK * BLOCK) as u32;
        let about = |[x, y]: [f64; 2]| [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()];
        Self {
            per_pixel: per_pixel as usize,
            sun: (0..count).map(|index| light.toward_sun(pattern(index, count, [0.37, 0.21]))).collect(),
            sky: (0..count).map(|index| about(disc(pattern(index, count, [0.0, 0.5])))).collect(),
        }
    }
}

/// What stood in the way of rays of light from the pixel before, which is likely to stand in the way again. It is forgotten
/// at the beginning of a row: a picture depends on what was tried first only where rounding decides, and then rows must not
/// depend on the thread that draws them.
#[derive(Debug)]
pub(crate) struct Blockers {
    sun: u32,
    /// By the numbers of a pixel's rays to the sky, which point alike in pixels that are neighbours.
    sky: [u32; 4],
}

impl Default for Blockers {
    fn default() -> Self {
        Self { sun: NO_SOLID, sky: [NO_SOLID; 4] }
    }
}

impl<const N: usize> Stage<N> {
    /// What reaches the point of a sample at a pixel.
    pub(crate) fn reach(
        &self,
        seen: &Seen,
        light: &Light,
        (x, y): (usize, usize),
        rays: &LightRays,
        (blockers, stack): (&mut Blockers, &mut RayStack),
    ) -> Reach {
        if seen.key == SKY || seen.haze > 0.995 {
            return Reach::OPEN;
        }
        let origin = seen.point + seen.normal * (1e-4 * self.size + 1e-9 * seen.distance);
        let place = ORDER[y % BLOCK][x % BLOCK] as usize;
        let indices = (0..rays.per_pixel).map(|ray| place + ray * BLOCK * BLOCK);
        let mut sun = 0;
        if seen.normal.dot(light.sun) > -0.05 {
            for index in indices.clone() {
                sun += u32::from(!self.is_dark(origin, rays.sun[index], f64::INFINITY, &mut blockers.sun, stack));
            }
        }
        let [first, second, _] = seen.normal.orthonormal_complement();
        let mut sky = 0;
        for (number, [across, beside, along]) in indices.map(|index| rays.sky[index]).enumerate() {
            let toward = first * across + second * beside + seen.normal * along;
            let blocker = &mut blockers.sky[number % 4];
            sky += u32::from(!self.is_dark(origin, toward, SKY_REACH * self.size, blocker, stack));
        }
        let count = rays.per_pixel as f32;
        Reach { sun: sun as f32 / count, sky: sky as f32 / count }
    }

    /// Whether something stands in the way; walls, which are of glass, do not.
    fn is_dark(
        &self,
        origin: Vector<3>,
        toward: Vector<3>,
        reach: f64,
        blocker: &mut u32,
        stack: &mut RayStack,
    ) -> bool {
        let floor = self.planes.iter().filter(|plane| plane.is_floor).any(|plane| {
            let height = plane.normal.dot(origin) - plane.offset;
            let closing = -plane.normal.dot(toward);
            height > 0.0 && closing > 0.0 && height < closing * reach
        });
        floor || self.cut.blocks(&Ray::new(origin, toward).up_to(reach), blocker, stack)
    }
}

impl Reach {
    /// Where nothing stands in the way.
    pub(crate) const OPEN: Self = Self { sun: 1.0, sky: 1.0 };
}

/// The mean of the blocks around a pixel over pixels of the same surface, or of one that goes on nearly flat.
pub(crate) struct Smoother<'a> {
    seen: &'a [Seen],
    raw: &'a [Reach],
    width: usize,
    height: usize,
    /// Typical size of a body, m.
    size: f64,
    /// For each pixel how many up to it, in its row, lie open: where all around do, there is nothing to count.
    open: Vec<u16>,
}

impl<'a> Smoother<'a> {
    pub(crate) fn new(seen: &'a [Seen], raw: &'a [Reach], width: usize, size: f64) -> Self {
        let mut open = vec![0; raw.len()];
        for (row, raw) in open.chunks_exact_mut(width).zip(raw.chunks_exact(width)) {
            let mut run: u16 = 0;
            for (open, reach) in row.iter_mut().zip(raw) {
                run = if *reach == Reach::OPEN { run.saturating_add(1) } else { 0 };
                *open = run;
            }
        }
        Self { seen, raw, width, height: raw.len() / width, size, open }
    }

    /// What reaches a pixel.
    pub(crate) fn at(&self, x: usize, y: usize) -> Reach {
        let rows = y.saturating_sub(BLOCK - 1)..(y + BLOCK + 1).min(self.height);
        let columns = x.saturating_sub(BLOCK - 1)..(x + BLOCK + 1).min(self.width);
        let is_open = |row: usize| usize::from(self.open[row * self.width + columns.end - 1]) >= columns.len();
        if rows.clone().all(is_open) {
            return Reach::OPEN;
        }
        let here = &self.seen[y * self.width + x];
        let (mut sun, mut sky, mut count) = (0.0, 0.0, 0.0);
        for row in rows {
            for index in row * self.width + columns.start..row * self.width + columns.end {
                let other = &self.seen[index];
                let same = other.key == here.key || (other.key != SKY && other.normal.dot(here.normal) > 0.95);
                let offset = other.point - here.point;
                if same && offset.dot(here.normal).abs() < 0.02 * self.size {
                    sun += self.raw[index].sun;
                    sky += self.raw[index].sky;
                    count += 1.0;
                }
            }
        }
        if count == 0.0 {
            return self.raw[y * self.width + x];
        }
        Reach { sun: sun / count, sky: sky / count }
    }
}

#[cfg(test)]
mod tests {
    use hyperbody::prelude::{BodyDef, Shape, World, WorldDef};

    use super::*;
    use crate::bodies::Bodies;
    use crate::slice::Slice;

    /// Radius of the sun's disc at unit distance, as the documentation of the look gives it.
    const SUN_RADIUS: f64 = 0.05;

    /// A floor, and a plate whose edge x = 0 hangs `height` above it; the plate fills x > 0.
    fn plate(height: f64) -> Stage<4> {
        let mut world = World::<4>::new(WorldDef::default()).unwrap();
        world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
        let plate = Shape::cuboid([50.0, 0.001, 50.0, 1.0]).unwrap();
        world.add_body(BodyDef::fixed(plate).position([50.0, height, 0.0, 0.0])).unwrap();
        Stage::new(&Bodies::of(&world), &Slice::natural())
    }

    /// Points of the sun's disc in rings of one area, as slopes dx/dy of the rays to them.
    fn slopes(light: &Light) -> Vec<f64> {
        let across = crate::camera::cross(light.sun, Vector::unit(2)).normalize_or_zero();
        let beside = crate::camera::cross(light.sun, across);
        let rings = (0..60).map(|ring| SUN_RADIUS * ((f64::from(ring) + 0.5) / 60.0).sqrt());
        let points = rings.flat_map(|radius| (0..180).map(move |turn| (radius, f64::from(turn).to_radians() * 2.0)));
        let toward =
            |(radius, angle): (f64, f64)| light.sun + across * (radius * angle.cos()) + beside * (radius * angle.sin());
        points.map(toward).map(|toward| toward[0] / toward[1]).collect()
    }

    /// The share of the sun that a point of the floor sees beside a plate: that of the disc's points whose rays pass the edge.
    /// So the half-shadow is as wide as the sun, from where the plate hangs: twice as wide from twice as high.
    #[test]
    fn half_shadows_are_as_wide_as_the_sun_from_their_edge() {
        let light = Light::new(Vector::unit(1), Vector([0.3, -0.2, -1.0]));
        let rays = LightRays::new(&light, 64);
        let slopes = slopes(&light);
        let (low, high) = slopes.iter().fold((f64::MAX, f64::MIN), |(low, high), &s| (s.min(low), s.max(high)));
        let mut widths = Vec::new();
        for height in [1.0, 2.0, 4.0] {
            let stage = plate(height);
            let mut partly = Vec::new();
            for step in -20..=120 {
                let x = -height * (low + (high - low) * f64::from(step) / 100.0);
                let seen = Seen { key: 1, point: Vector([x, 0.0, 0.0]), normal: Vector::unit(1), ..Seen::default() };
                let mut share = 0.0;
                for place in 0..BLOCK * BLOCK {
                    let memory = (&mut Blockers::default(), &mut RayStack::default());
                    share += stage.reach(&seen, &light, (place % BLOCK, place / BLOCK), &rays, memory).sun / 16.0;
                }
                let passing = slopes.iter().filter(|&&slope| x + height * slope < 0.0).count();
                let exact = passing as f64 / slopes.len() as f64;
                assert!(
                    (f64::from(share) - exact).abs() < 0.015,
                    "{share} instead of {exact} at {x}, {height} m below"
                );
                if (0.001..0.999).contains(&share) {
                    partly.push(x);
                }
            }
            widths.push((partly[0] - partly[partly.len() - 1]).abs());
            let exact = height * (high - low);
            assert!((widths[widths.len() - 1] / exact - 1.0).abs() < 0.06, "{widths:?} from {height} m, not {exact}");
        }
        assert!((widths[1] / widths[0] - 2.0).abs() < 0.1 && (widths[2] / widths[1] - 2.0).abs() < 0.1, "{widths:?}");
    }
}
