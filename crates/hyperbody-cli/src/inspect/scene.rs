//! What a scene holds.

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::BodyKind;
use hyperbody_scene::{AnyWorld, DimensionVisitor, Scene, visit_dimension};
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{metres, number, numbers, table};

/// Rows of the table of bodies.
const SHOWN_BODIES: usize = 20;

#[derive(Serialize)]
pub(super) struct Report {
    scene: String,
    description: String,
    dimension: usize,
    gravity: Vec<f64>,
    dt: f64,
    substeps: u32,
    sleeping: bool,
    bodies: Vec<BodyReport>,
    joints: usize,
    /// Of the dynamic bodies, kg.
    mass: f64,
}

#[derive(Clone, Serialize)]
struct BodyReport {
    name: String,
    kind: &'static str,
    shape: &'static str,
    /// Of the origin of its frame, m.
    position: Vec<f64>,
    /// In kg; null for what is not dynamic.
    mass: Option<f64>,
    /// Null for half-spaces.
    volume: Option<f64>,
    /// Per unit mass, descending; null for half-spaces.
    principal_moments: Option<Vec<f64>>,
}

struct Visit<'a> {
    scene: &'a Scene,
    world: &'a AnyWorld,
}

impl DimensionVisitor for Visit<'_> {
    type Output = Vec<BodyReport>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let (Some(world), Some(handles)) = (self.world.get::<N>(), self.world.handles::<N>()) else {
            return Vec::new();
        };
        let mut reports = Vec::with_capacity(handles.len());
        for ((handle, name), body) in handles.iter().zip(self.world.body_names()).zip(&self.scene.bodies) {
            let Some(state) = world.body(*handle) else { continue };
            let properties = state.shape().mass_properties(1.0).ok();
            reports.push(BodyReport {
                name: name.clone(),
                kind: match state.kind() {
                    BodyKind::Dynamic => "dynamic",
                    BodyKind::Static => "static",
                    BodyKind::Kinematic => "kinematic",
                },
                shape: body.shape.key(),
                position: state.position().iter().collect(),
                mass: (state.kind() == BodyKind::Dynamic).then(|| state.mass()),
                volume: properties.map(|properties| properties.mass),
                principal_moments: properties
                    .map(|properties| properties.principal().0.iter().map(|moment| moment / properties.mass).collect()),
            });
        }
        reports
    }
}

pub(super) fn report(scene: &Scene) -> Result<Report, Failure> {
    let world = AnyWorld::new(scene, 1)?;
    let bodies = visit_dimension(scene.dimension, Visit { scene, world: &world }).unwrap_or_default();
    Ok(Report {
        scene: scene.name.clone(),
        description: scene.description.clone(),
        dimension: scene.dimension,
        gravity: scene.gravity.clone(),
        dt: scene.dt,
        substeps: scene.substeps,
        sleeping: scene.sleeping,
        joints: scene.joints.len(),
        mass: bodies.iter().filter_map(|body| body.mass).sum(),
        bodies,
    })
}

pub(super) fn as_text(report: &Report) -> String {
    let mut bodies = table(&["body", "kind", "shape", "position (m)", "mass (kg)", "principal moments (m²)"], 4);
    for body in report.bodies.iter().take(SHOWN_BODIES) {
        let position: Vec<String> = body.position.iter().copied().map(metres).collect();
        bodies.add_row([
            body.name.clone(),
            body.kind.to_owned(),
            body.shape.to_owned(),
            position.join("  "),
            body.mass.map_or_else(String::new, number),
            body.principal_moments.as_deref().map_or_else(String::new, numbers),
        ]);
    }
    let more = report.bodies.len().saturating_sub(SHOWN_BODIES);
    let mut text = format!("{}: a scene of {} dimensions\n", report.scene, report.dimension);
    if !report.description.is_empty() {
        text += &format!("{}\n", report.description);
    }
    text += &format!("\n{bodies}\n");
    if more > 0 {
        text += &format!("… and {more} more bodies (--json shows them all)\n");
    }
    let sleeping = if report.sleeping { "may sleep" } else { "stay awake" };
    text += &format!(
        "\n{} bodies of {} kg in motion, {} joints; gravity {} m/s²; steps of {} s in {} substeps; bodies at rest {sleeping}",
        report.bodies.len(),
        number(report.mass),
        report.joints,
        numbers(&report.gravity),
        number(report.dt),
        report.substeps
    );
    text
}
