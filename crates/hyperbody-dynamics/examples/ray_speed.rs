//! Rays a second on one thread against 1,000 cubes in a pile, in every dimension:
//! `cargo run --release -p hyperbody-dynamics --example ray_speed`

mod common;

use std::time::Instant;

use common::Random;
use hyperbody_collision::ray::Ray;
use hyperbody_dynamics::{BodyDef, QueryFilter, QueryScratch, World, WorldDef, WorldError};
use hyperbody_geometry::Shape;
use hyperbody_math::{Bivector, Rotation, Vector};

const BODIES: usize = 1000;
const RAYS: usize = 1_000_000;

impl Random {
    fn vector<const N: usize>(&mut self, reach: f64) -> Vector<N> {
        Vector::from_fn(|_| self.next() * reach)
    }

    fn rotation<const N: usize>(&mut self) -> Rotation<N> {
        let mut turn = Bivector::ZERO;
        for i in 0..N {
            for j in i + 1..N {
                turn.set(i, j, self.next());
            }
        }
        Rotation::exp(&turn)
    }
}

/// Turned cubes with edges of 1 m in a grid 1.6 m apart, as they lie in a pile, on a floor.
fn pile<const N: usize>(random: &mut Random) -> Result<(World<N>, f64), WorldError> {
    let mut world = World::<N>::new(WorldDef::default())?;
    world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0)?))?;
    let across = (1..).find(|k: &usize| k.pow(N as u32) >= BODIES).unwrap_or(1);
    let half_width = 0.8 * across as f64;
    for index in 0..BODIES {
        let mut cell = index;
        let corner = Vector::from_fn(|_| {
            let column = cell % across;
            cell /= across;
            1.6 * column as f64 + 0.8 - half_width
        });
        let position = corner + Vector::unit(1) * (half_width + 0.2) + random.vector(0.2);
        world.add_body(BodyDef::new(Shape::cuboid([0.5; N])?).position(position).rotation(random.rotation()))?;
    }
    Ok((world, half_width))
}

/// Time that this process has had the processor, where the system tells (Linux): what a machine shared with others leaves
/// out.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|nanoseconds| nanoseconds * 1e-9)
}

fn time<const N: usize>() -> Result<(), WorldError> {
    let mut random = Random(2020);
    let (world, half_width) = pile::<N>(&mut random)?;
    let queries = world.queries();
    let up = Vector::unit(1) * half_width;
    // From outside of the pile through any two of its points.
    let rays: Vec<Ray<N>> = (0..RAYS)
        .map(|_| {
            let target = random.vector::<N>(half_width) + up;
            let away = random.vector::<N>(1.0).normalize_or_zero();
            Ray::between(target + away * (3.0 * half_width), target).up_to(2.0)
        })
        .collect();
    let mut scratch = QueryScratch::default();
    let mut timed = |name: &str, cast: &mut dyn FnMut(&Ray<N>, &mut QueryScratch<N>) -> bool| {
        let (start, busy) = (Instant::now(), processor_seconds());
        let hits = rays.iter().filter(|ray| cast(ray, &mut scratch)).count();
        let seconds = start.elapsed().as_secs_f64();
        let rate = |seconds: f64| RAYS as f64 / seconds / 1e6;
        let alone = processor_seconds().zip(busy).map_or(f64::NAN, |(after, before)| rate(after - before));
        println!(
            "{N}D {name:9} {:6.2} million rays/s, {alone:6.2} million per second of the processor, {:3.0} % hit",
            rate(seconds),
            1e2 * hits as f64 / RAYS as f64
        );
    };
    timed("first hit", &mut |ray, scratch| queries.ray_cast(ray, scratch, &QueryFilter::ALL).is_some());
    timed("any hit", &mut |ray, scratch| queries.ray_meets_any(ray, scratch, &QueryFilter::ALL));
    Ok(())
}

fn main() -> Result<(), WorldError> {
    time::<2>()?;
    time::<3>()?;
    time::<4>()?;
    time::<5>()?;
    time::<6>()
}
