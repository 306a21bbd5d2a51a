//! Sections: what a person sees of a body of four dimensions.

use hyperbody::geometry::{SectionPolytope, SliceFrame};
use hyperbody::prelude::*;

use crate::{Outcome, claim};

pub(crate) fn run() -> Outcome {
    // All signs of four halves: a tesseract with edges of one metre. Any points make a polytope, in any dimension.
    let corner = |index: usize| Vector(std::array::from_fn(|axis| if index >> axis & 1 == 0 { -0.5 } else { 0.5 }));
    let corners: Vec<Vector<4>> = (0..16).map(corner).collect();
    let tesseract = SectionPolytope::from_polytope(&Polytope::from_points(&corners)?);

    let straight: SectionPolytope<3> = tesseract.section(&SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.2)?);
    claim(straight.face_counts() == [8, 12, 6], "cut straight, a tesseract is a cube")?;

    let across: SectionPolytope<3> = tesseract.section(&SliceFrame::from_normal([0.5; 4], 0.0)?);
    claim(across.face_counts() == [6, 12, 8], "cut across its long diagonal, an octahedron")?;
    let volume = across.mass_properties().mass;
    claim((volume - 4.0 / 3.0).abs() < 1e-12, "of 4/3 of a cubic metre")?;
    let cells: Vec<u32> = across.facet_sources().to_vec();
    println!("  its faces come from the cells {cells:?} of the tesseract");

    // Curved shapes have exact sections, too; their volume needs no triangles.
    let ball = Shape::<4>::ball(1.0)?;
    let cut = ball.section_volume(&SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.6)?, 1e-9)?;
    let expected = 4.0 / 3.0 * std::f64::consts::PI * 0.8_f64.powi(3);
    claim((cut - expected).abs() < 1e-9, "a ball of radius 1, cut 0.6 off its middle, is one of radius 0.8")
}
