//! Where and in which direction coupled bodies press on each other: the rows of `joint/coupling.rs`.

use std::f64::consts::TAU;

use hyperbody_math::{Bivector, Vector};

use super::geometry::Geometry;
use crate::joint::Coupling;

/// A force between two bodies at one point, and a torque beside it.
pub(super) struct Mesh<const N: usize> {
    /// Unit, world.
    pub(super) direction: Vector<N>,
    /// The point, from the first anchor.
    pub(super) point: Vector<N>,
    /// Torque for each unit of force, m; by world planes.
    pub(super) twist: Option<Bivector<N>>,
}

impl<const N: usize> Mesh<N> {
    /// The torque for each unit of force, m, about a point that is given from the first anchor.
    pub(super) fn about(&self, point: Vector<N>) -> Bivector<N> {
        Bivector::wedge(self.point - point, self.direction) + self.twist.unwrap_or(Bivector::ZERO)
    }
}

impl<const N: usize> Geometry<N> {
    pub(super) fn mesh(&self, coupling: &Coupling) -> Mesh<N> {
        let of_a = |axis: u8| self.axes.column(usize::from(axis));
        let of_b = |axis: u8| self.axes * self.relative.column(usize::from(axis));
        match *coupling {
            Coupling::Gear { plane: (i, j), teeth } => {
                let (along_i, along_j) = (of_a(i).dot(self.gap), of_a(j).dot(self.gap));
                let tangent = of_a(j) * along_i - of_a(i) * along_j;
                Mesh {
                    direction: tangent.try_normalize().unwrap_or(of_a(j)),
                    point: self.gap * (f64::from(teeth.0) / f64::from(teeth.0 + teeth.1)),
                    twist: None,
                }
            }
            Coupling::Rack { plane: (i, j), radius } => {
                Mesh { direction: of_b(i), point: of_b(j) * -radius, twist: None }
            }
            Coupling::Screw { plane: (i, j), along, lead } => Mesh {
                direction: of_a(along),
                point: self.gap,
                twist: Some(Bivector::wedge(of_a(i), of_a(j)) * (-lead / TAU)),
            },
        }
    }

    /// How far the bodies are from where the coupling holds them, m.
    pub(super) fn off_mesh(&self, coupling: &Coupling, phase: f64) -> f64 {
        let frame_b = self.axes * self.relative;
        let off = coupling.off(coupling.measure(self.gap, &self.axes, &frame_b) - phase);
        off * coupling.scale(self.reach(coupling))
    }

    /// How far the anchors are from each other in the plane of the coupling, m.
    fn reach(&self, coupling: &Coupling) -> f64 {
        let (i, j) = coupling.plane();
        let along = |axis: u8| self.axes.column(usize::from(axis)).dot(self.gap);
        (along(i) * along(i) + along(j) * along(j)).sqrt()
    }

    /// m after which everything is as before, but for whole teeth and turns.
    pub(super) fn mesh_period(&self, coupling: &Coupling) -> f64 {
        (coupling.period() * coupling.scale(self.reach(coupling))).abs()
    }
}
