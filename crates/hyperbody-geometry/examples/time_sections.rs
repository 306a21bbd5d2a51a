//! Times sections of regular polychora: `cargo run --release -p hyperbody-geometry --example time_sections`.
//!
//! The hyperplane turns and moves from one section to the next, as it does in a hand.

use std::time::Instant;

use hyperbody_geometry::regular::{Size, polytope};
use hyperbody_geometry::{SectionPolytope, SectionScratch, SliceFrame};
use hyperbody_math::Vector;

const ROUNDS: usize = 2000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:>10}  {:>9}  {:>9}  {:>9}  {:>14}", "body", "median µs", "p99 µs", "max µs", "mean vertices");
    for name in ["5-cell", "tesseract", "16-cell", "24-cell", "600-cell", "120-cell"] {
        let body = SectionPolytope::from_polytope(&polytope::<4>(name, Size::Circumradius(1.0))?);
        let (mut scratch, mut section) = (SectionScratch::default(), SectionPolytope::<3>::new());
        let mut times = Vec::with_capacity(ROUNDS);
        let mut vertices = 0;
        for round in 0..ROUNDS {
            let t = round as f64 * 0.01;
            let normal = Vector([(1.3 * t).sin(), (0.7 * t).cos(), (0.3 * t).sin(), 1.0]);
            let frame = SliceFrame::from_normal(normal, 0.6 * (2.1 * t).sin())?;
            let start = Instant::now();
            body.section_into(&frame, &mut scratch, &mut section);
            times.push(start.elapsed().as_secs_f64() * 1e6);
            vertices += section.vertices().len();
        }
        times.sort_by(f64::total_cmp);
        let at = |part: f64| times[((ROUNDS - 1) as f64 * part) as usize];
        let mean = vertices as f64 / ROUNDS as f64;
        println!("{name:>10}  {:>9.1}  {:>9.1}  {:>9.1}  {mean:>14.1}", at(0.5), at(0.99), at(1.0));
    }
    Ok(())
}
