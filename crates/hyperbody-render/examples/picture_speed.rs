//! How long pictures take, with soft shadows, for a scene after three seconds, by default a pile of 500 tesseracts:
//! `cargo run --release -p hyperbody-render --example picture_speed [--check] [SCENE]`
//!
//! Of that pile, each size has a limit on two cores, and is said to keep it or not; with `--check` the exit status is 1 if one does
//! not. Other scenes and single threads have none. That pictures are the same for every number of threads is compared on the way.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody_render::{Bodies, Settings, Slice, frame_bodies, render};
use hyperbody_scene::{AnyWorld, DimensionVisitor, Scene, built_in, visit_dimension};

/// Pixels across and down, and how long a picture of the pile may take on two cores, s.
const SIZES: [(u32, u32, f64); 2] = [(1280, 720, 4.0), (640, 360, 0.5)];

/// Pictures of each size; the fastest counts, for others only waited longer.
const ROUNDS: usize = 5;

/// The threads that the limits are said for.
const LIMITED: usize = 2;

struct Time<'a> {
    world: &'a AnyWorld,
    /// Whether it is the pile, which the limits are said for.
    is_limited: bool,
}

impl DimensionVisitor for Time<'_> {
    /// Whether all pictures that have limits keep them.
    type Output = Result<bool, Box<dyn Error>>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let world = self.world.get::<N>().ok_or("the world has another dimension")?;
        let slice = Slice::natural();
        let bodies = Bodies::of(world);
        let camera = frame_bodies(&bodies, &slice, 16.0 / 9.0);
        let mut kept = true;
        for (width, height, limit) in SIZES {
            let mut first = None;
            for threads in [1, LIMITED] {
                let settings = Settings { width, height, threads, ..Settings::default() };
                let mut fastest = f64::INFINITY;
                for _ in 0..ROUNDS {
                    let start = Instant::now();
                    let image = render(&bodies, &slice, Some(&camera), &settings, &|_| ())?;
                    fastest = fastest.min(start.elapsed().as_secs_f64());
                    if *first.get_or_insert_with(|| image.clone()) != image {
                        return Err(format!("{width} × {height}: {threads} threads draw another picture").into());
                    }
                }
                let verdict = if !(self.is_limited && threads == LIMITED) {
                    String::new()
                } else if fastest <= limit {
                    format!(", keeps the limit of {limit} s")
                } else {
                    kept = false;
                    format!(", EXCEEDS the limit of {limit} s")
                };
                let plural = if threads == 1 { "" } else { "s" };
                println!("{width} × {height}, {threads} thread{plural}: {fastest:.3} s{verdict}");
            }
        }
        Ok(kept)
    }
}

/// Tesseracts, 5 × 5 × 5 in each of four layers, turned at random, that fall into a pit.
fn pile() -> Result<Scene, Box<dyn Error>> {
    // The generator of D. Lehmer (1951), with the multiplier of S. Park and K. Miller (1988): random enough for a heap.
    let mut state = 500_u64;
    let mut random = |reach: f64| {
        state = state * 48_271 % 2_147_483_647;
        reach * (2.0 * state as f64 / 2_147_483_647.0 - 1.0)
    };
    let mut bodies =
        vec![r#"{"kind": "static", "shape": {"half_space": {"normal": [0, 1, 0, 0], "offset": 0}}}"#.to_owned()];
    for axis in [0, 2, 3] {
        for side in [1, -1] {
            let mut normal = [0; 4];
            normal[axis] = side;
            bodies.push(format!(
                r#"{{"kind": "static", "shape": {{"half_space": {{"normal": {normal:?}, "offset": -5.65}}}}}}"#
            ));
        }
    }
    for number in 0..500_u32 {
        let layer = number / 125;
        let shift = if layer % 2 == 0 { -4.3 } else { -3.35 };
        let [x, z, w] = [1, 5, 25].map(|step| shift + 1.9125 * f64::from(number / step % 5) + random(0.05));
        let y = 1.3 + 1.9 * f64::from(layer);
        let turns: Vec<String> = ["xy", "xz", "xw", "yz", "yw", "zw"]
            .map(|plane| format!(r#"{{"plane": "{plane}", "angle_deg": {}}}"#, random(20.0)))
            .into();
        bodies.push(format!(
            r#"{{"shape": {{"box": {{"half_extents": [0.5, 0.5, 0.5, 0.5]}}}}, "position": [{x}, {y}, {z}, {w}],
                "rotation": [{}]}}"#,
            turns.join(", ")
        ));
    }
    let text = format!(
        r#"{{"format": "hyperbody-scene", "version": 1, "dimension": 4, "gravity": [0, -9.81, 0, 0], "bodies": [{}]}}"#,
        bodies.join(", ")
    );
    Ok(Scene::from_json(&text)?)
}

fn main() -> ExitCode {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    let is_check = names.iter().any(|name| name == "--check");
    names.retain(|name| name != "--check");
    if is_check && !names.is_empty() {
        eprintln!("error: --check is for the pile, whose limits it knows; leave {} out, or --check", names.join(" "));
        return ExitCode::from(2);
    }
    match measure(names.first().map(String::as_str)) {
        Ok(kept) => ExitCode::from(u8::from(is_check && !kept)),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn measure(name: Option<&str>) -> Result<bool, Box<dyn Error>> {
    let scene = match name {
        None => pile()?,
        Some(name) if Path::new(name).is_file() => Scene::load(Path::new(name))?,
        Some(name) => {
            built_in(name).map_err(|nearest| format!("there is no scene {name}; the nearest is {nearest}"))?
        }
    };
    let mut world = AnyWorld::new(&scene, 1)?;
    while world.time() < 3.0 {
        world.step();
    }
    let time = Time { world: &world, is_limited: name.is_none() };
    visit_dimension(world.dimension(), time).ok_or("the dimension is out of range")?
}
