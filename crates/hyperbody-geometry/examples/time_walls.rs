//! Times `Surface::without_walls` for sections of star polychora: `cargo run --release -p hyperbody-geometry --example time_walls`.

use std::time::Instant;

use hyperbody_geometry::regular::Size;
use hyperbody_geometry::{SectionPolytope, SectionScratch, SliceFrame, Surface, star};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{:>12}  {:>8}  {:>8}  {:>13}  {:>9}", "star", "pieces", "polygons", "without walls", "median ms");
    let frame = SliceFrame::from_normal([0.3, -0.2, 0.5, 0.8], 0.1)?;
    for symbol in ["{5/2,5,3}", "{3,5,5/2}", "{5/2,5,5/2}", "{3,3,5/2}"] {
        let (mut surface, mut pieces) = (Surface::new(), 0);
        let (mut scratch, mut section) = (SectionScratch::default(), SectionPolytope::<3>::new());
        for cell in star::cells::<4>(&star::symbol(symbol)?, Size::Circumradius(1.0), usize::MAX)? {
            SectionPolytope::from_polytope(&cell).section_into(&frame, &mut scratch, &mut section);
            pieces += usize::from(!section.is_empty());
            surface.add_polytope(&section, 0);
        }
        let mut left = 0;
        let mut times: Vec<f64> = Vec::new();
        for _ in 0..9 {
            let start = Instant::now();
            left = surface.without_walls().polygon_count();
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times.sort_by(f64::total_cmp);
        println!("{symbol:>12}  {pieces:>8}  {:>8}  {left:>13}  {:>9.1}", surface.polygon_count(), times[4]);
    }
    Ok(())
}
