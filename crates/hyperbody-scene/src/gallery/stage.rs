//! What most built-in scenes stand on: floors, pits, coordinates, heaps.

use hyperbody::math::planes;
use hyperbody::prelude::Material;

use super::random::Random;
use crate::model::{Body, NamedMaterial, Scene, ShapeSpec};

/// A scene with a sentence that says what to see.
pub(super) fn scene(dimension: usize, description: &str) -> Scene {
    let mut scene = Scene::new("", dimension);
    description.clone_into(&mut scene.description);
    scene
}

/// A point by its first coordinates; the others are zero.
pub(super) fn point(dimension: usize, first: &[f64]) -> Vec<f64> {
    let mut point = vec![0.0; dimension];
    for (coordinate, &value) in point.iter_mut().zip(first) {
        *coordinate = value;
    }
    point
}

/// `value` along one axis, zero along the others.
pub(super) fn along(dimension: usize, axis: usize, value: f64) -> Vec<f64> {
    let mut point = vec![0.0; dimension];
    point[axis] = value;
    point
}

/// The solid half-space below y = 0.
pub(super) fn floor(dimension: usize) -> Body {
    Body::new(ShapeSpec::HalfSpace { normal: along(dimension, 1, 1.0), offset: 0.0 }).named("floor").fixed()
}

/// A floor, and walls that face each other `2 · half_width` apart on every other axis.
pub(super) fn pit(dimension: usize, half_width: f64) -> Vec<Body> {
    let mut bodies = vec![floor(dimension)];
    for axis in (0..dimension).filter(|&axis| axis != 1) {
        for (sign, side) in [(-1.0, "far"), (1.0, "near")] {
            let wall = ShapeSpec::HalfSpace { normal: along(dimension, axis, sign), offset: -half_width };
            bodies.push(Body::new(wall).named(format!("{side} {} wall", planes::AXIS_NAMES[axis])).fixed());
        }
    }
    bodies
}

/// How far the layers of a heap are moved to either side, in spacings.
const SHIFT: f64 = 0.25;

/// How far each body of a heap starts off its place in the layer, m.
const SCATTER: f64 = 0.05;

/// Where the bodies of a heap start.
pub(super) struct Heap {
    pub(super) dimension: usize,
    /// Bodies along each axis but y.
    pub(super) across: usize,
    pub(super) layers: usize,
    /// Distance between neighbours, m.
    pub(super) spacing: f64,
    /// How far a body reaches from its centre, m: the walls stand where the outermost one just fits.
    pub(super) reach: f64,
    /// Largest turn in every plane, degrees.
    pub(super) largest_turn: f64,
    pub(super) seed: u64,
}

impl Heap {
    /// A pit with layers of bodies above it, each shifted against the one below and turned a little, so that they tumble.
    pub(super) fn bodies(&self, shape_of: impl Fn(usize) -> ShapeSpec) -> Vec<Body> {
        let mut random = Random::new(self.seed);
        let outermost = (self.across - 1) as f64 / 2.0 * self.spacing + SHIFT * self.spacing + SCATTER;
        let mut bodies = pit(self.dimension, ((outermost + self.reach) * 100.0).ceil() / 100.0);
        let per_layer = (1..self.dimension).fold(1, |count, _| count * self.across);
        for index in 0..per_layer * self.layers {
            let layer = index / per_layer;
            let mut cell = index % per_layer;
            let shift = if layer % 2 == 0 { -SHIFT } else { SHIFT } * self.spacing;
            let mut position = vec![1.3 + layer as f64 * self.spacing; self.dimension];
            for axis in (0..self.dimension).filter(|&axis| axis != 1) {
                let column = (cell % self.across) as f64 - (self.across - 1) as f64 / 2.0;
                cell /= self.across;
                // Rounded, so that written files stay short.
                let coordinate = column * self.spacing + shift + random.around_zero(SCATTER);
                position[axis] = (coordinate * 1e4).round() / 1e4;
            }
            let mut body = Body::new(shape_of(index)).at(position);
            for (i, j) in planes::all(self.dimension) {
                body = body.turned(&planes::name(i, j), random.around_zero(self.largest_turn));
            }
            bodies.push(body);
        }
        bodies
    }
}

/// A material by its name.
pub(super) fn material(name: impl Into<String>, friction: f64, restitution: f64) -> NamedMaterial {
    NamedMaterial { name: name.into(), material: Material { friction, restitution, ..Material::default() } }
}
