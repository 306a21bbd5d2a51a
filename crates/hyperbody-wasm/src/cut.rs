//! From a solid of any dimension down to the two or three that are drawn.
//!
//! The frame of a slice has the drawn axes first and the off directions after them. The first cut is across the last off
//! direction; its result has the other axes as coordinates, so that every further cut is across the last coordinate, at zero.

use hyperbody::geometry::{SectionPolytope, SectionScratch, SliceFrame, Solid, Surface};
use hyperbody::math::{Pose, Vector};

use crate::mesh::{Mesh, cell_number};
use crate::round::{self, Sphere};

/// Memory of cuts, kept so that polytopes are cut without allocating.
#[derive(Debug)]
pub(crate) struct Cutter {
    scratch: SectionScratch,
    surface: Surface,
    sphere: Sphere,
    fine_sphere: Sphere,
    five: Option<SectionPolytope<5>>,
    four: Option<SectionPolytope<4>>,
    three: Option<SectionPolytope<3>>,
    two: Option<SectionPolytope<2>>,
}

impl Cutter {
    pub(crate) fn new() -> Self {
        Self {
            scratch: SectionScratch::default(),
            surface: Surface::new(),
            sphere: Sphere::new(2),
            fine_sphere: Sphere::new(3),
            five: None,
            four: None,
            three: None,
            two: None,
        }
    }

    /// The sphere for balls: fine where there are few.
    pub(crate) fn sphere(&self, fine: bool) -> &Sphere {
        if fine { &self.fine_sphere } else { &self.sphere }
    }
}

/// What is left of a solid in the dimensions that are drawn, in slice coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Section<'a> {
    /// In a slice of three dimensions.
    Three(&'a Solid<3>),
    /// In a slice of two.
    Two(&'a Solid<2>),
}

/// Solids that know how to be cut down to what is drawn. A trait because the step from N to N − 1 has to be written for each N.
pub(crate) trait Drawn<const N: usize> {
    /// Calls `done` with the section by the slice with the first `drawn` axes of `frame`, in their coordinates, unless it is
    /// empty. `drawn` is 2 or 3 and less than `N`.
    fn cut_down(&self, frame: &SliceFrame<N>, drawn: usize, cutter: &mut Cutter, done: Done<'_>);

    /// The solid itself, where it has no more dimensions than can be drawn.
    fn whole(&self) -> Option<Section<'_>> {
        None
    }
}

/// What is done with a section.
pub(crate) type Done<'a> = &'a mut dyn FnMut(Section<'_>, &mut Cutter);

/// One cut, into a polytope whose memory is used again.
fn cut<const N: usize, const M: usize>(
    solid: &Solid<N>,
    frame: &SliceFrame<N>,
    scratch: &mut SectionScratch,
    memory: &mut Option<SectionPolytope<M>>,
) -> Option<Solid<M>> {
    let Solid::Polytope(polytope) = solid else { return solid.section::<M>(frame) };
    let mut section = memory.take().unwrap_or_default();
    if polytope.section_into(frame, scratch, &mut section) {
        return Some(Solid::Polytope(section));
    }
    *memory = Some(section);
    None
}

macro_rules! cut_down_once {
    ($n:literal, $m:literal, $memory:ident) => {
        impl Drawn<$n> for Solid<$n> {
            fn cut_down(&self, frame: &SliceFrame<$n>, drawn: usize, cutter: &mut Cutter, done: Done<'_>) {
                let lower = cut::<$n, $m>(self, frame, &mut cutter.scratch, &mut cutter.$memory);
                let Some(lower) = lower else { return };
                match lower.whole() {
                    Some(section) if drawn == $m => done(section, cutter),
                    _ => lower.cut_down(&SliceFrame::new(Pose::IDENTITY), drawn, cutter, done),
                }
                if let Solid::Polytope(section) = lower {
                    cutter.$memory = Some(section);
                }
            }
        }
    };
}

cut_down_once!(6, 5, five);
cut_down_once!(5, 4, four);
cut_down_once!(4, 3, three);

impl Drawn<3> for Solid<3> {
    fn cut_down(&self, frame: &SliceFrame<3>, _drawn: usize, cutter: &mut Cutter, done: Done<'_>) {
        let Some(lower) = cut::<3, 2>(self, frame, &mut cutter.scratch, &mut cutter.two) else { return };
        done(Section::Two(&lower), cutter);
        if let Solid::Polytope(section) = lower {
            cutter.two = Some(section);
        }
    }

    fn whole(&self) -> Option<Section<'_>> {
        Some(Section::Three(self))
    }
}

impl Drawn<2> for Solid<2> {
    /// Never: a world of two dimensions is drawn whole.
    fn cut_down(&self, _: &SliceFrame<2>, _: usize, _: &mut Cutter, _: Done<'_>) {}

    fn whole(&self) -> Option<Section<'_>> {
        Some(Section::Two(self))
    }
}

impl Cutter {
    /// Adds a section to a mesh; cells are counted from `first_cell`.
    pub(crate) fn draw(&mut self, section: Section<'_>, first_cell: u32, fine: bool, mesh: &mut Mesh) {
        let cell = cell_number(first_cell);
        match section {
            Section::Three(Solid::Polytope(polytope)) => mesh.add_polytope(polytope, &mut self.surface, first_cell),
            Section::Three(Solid::Ball { centre, radius }) => self.sphere(fine).add_ball(*centre, *radius, cell, mesh),
            Section::Three(Solid::Curved(body)) => {
                self.sphere(fine).add_body(|direction| body.support(direction), cell, mesh);
            }
            Section::Two(Solid::Polytope(polytope)) => mesh.add_polygon(&corners_around(polytope), cell),
            Section::Two(Solid::Ball { centre, radius }) => round::add_flat(|u| *centre + u * *radius, cell, mesh),
            Section::Two(Solid::Curved(body)) => round::add_flat(|u| body.support(u), cell, mesh),
            _ => {}
        }
    }
}

/// The corners of a polygon counterclockwise.
fn corners_around(polygon: &SectionPolytope<2>) -> Vec<Vector<2>> {
    let centre = polygon.centre();
    let mut corners = polygon.vertices().to_vec();
    // An angle in disguise: grows with the angle from −π to π, without its cost.
    let turn = |corner: &Vector<2>| {
        let away = *corner - centre;
        let sum = away[0].abs() + away[1].abs();
        let share = if sum > 0.0 { away[0] / sum } else { 0.0 };
        if away[1] < 0.0 { share - 1.0 } else { 1.0 - share }
    };
    corners.sort_unstable_by(|a, b| turn(a).total_cmp(&turn(b)));
    corners
}
