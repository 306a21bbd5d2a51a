//! How long pictures take, with soft shadows, for a scene after three seconds:
//! `cargo run --release -p hyperbody-render --example picture_speed [SCENE]`

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody_render::{Bodies, Settings, Slice, frame_bodies, render};
use hyperbody_scene::{AnyWorld, DimensionVisitor, Scene, built_in, visit_dimension};

/// Pictures of each size; the fastest counts, for others only waited longer.
const ROUNDS: usize = 5;

struct Time<'a>(&'a AnyWorld);

impl DimensionVisitor for Time<'_> {
    type Output = Result<(), Box<dyn Error>>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let world = self.0.get::<N>().ok_or("the world has another dimension")?;
        let slice = Slice::natural();
        let bodies = Bodies::of(world);
        let camera = frame_bodies(&bodies, &slice, 16.0 / 9.0);
        for (width, height) in [(1280, 720), (640, 360)] {
            for threads in [1, 2] {
                let settings = Settings { width, height, threads, ..Settings::default() };
                let mut fastest = f64::INFINITY;
                for _ in 0..ROUNDS {
                    let start = Instant::now();
                    render(&bodies, &slice, Some(&camera), &settings, &|_| ())?;
                    fastest = fastest.min(start.elapsed().as_secs_f64());
                }
                println!("{width} × {height}, {threads} threads: {fastest:.3} s");
            }
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "pit4d".to_owned());
    let path = Path::new(&name);
    let scene = if path.is_file() {
        Scene::load(path)?
    } else {
        built_in(&name).map_err(|nearest| format!("there is no scene {name}; the nearest is {nearest}"))?
    };
    let mut world = AnyWorld::new(&scene, 1)?;
    while world.time() < 3.0 {
        world.step();
    }
    visit_dimension(world.dimension(), Time(&world)).ok_or("the dimension is out of range")?
}
