//! What a frame tells in words and numbers, beside its arrays.

use hyperbody::geometry::Solid;
use hyperbody::math::{Dim, EvenAlgebra, Vector};
use hyperbody::prelude::{BodyKind, Rotor};
use hyperbody_scene::Planes;
use serde_json::{Value, json};

use crate::cut::Drawn;
use crate::message::{BodyDescription, Kind, Report, SceneDescription};
use crate::running::Running;

pub(crate) fn numbers<const N: usize>(vector: Vector<N>) -> Value {
    vector.as_slice().into()
}

pub(crate) fn kind(kind: BodyKind) -> Kind {
    match kind {
        BodyKind::Dynamic => Kind::Dynamic,
        BodyKind::Static => Kind::Static,
        BodyKind::Kinematic => Kind::Kinematic,
    }
}

impl<const N: usize> Running<N>
where
    Dim<N>: EvenAlgebra,
    Solid<N>: Drawn<N>,
{
    pub(crate) fn describe(&self) -> SceneDescription {
        let (middle, extent) = self.extent();
        let alive = self.entries.iter().enumerate().filter(|(_, entry)| entry.handle.is_some());
        let bodies = alive.map(|(id, entry)| BodyDescription {
            id: id as u32,
            name: entry.name.clone(),
            kind: kind(entry.spec.kind),
            shape: entry.spec.shape.key(),
            endless: entry.drawable.half_space().is_some(),
            colour_index: entry.colour_index,
            colour: entry.spec.colour,
            mass: entry.mass,
            radius: entry.radius,
        });
        SceneDescription {
            builtin: None,
            title: self.scene.name.clone(),
            dimension: N,
            sentence: self.scene.description.clone(),
            gravity: self.world.gravity().iter().collect(),
            dt: self.world.dt(),
            bodies: bodies.collect(),
            middle: middle.iter().collect(),
            extent,
        }
    }

    pub(crate) fn report(&mut self) -> Report {
        let step = self.history.shown().map_or_else(|| self.step_count(), |moment| moment.step);
        let pose = self.view.pose;
        let axis = |k: usize| numbers(pose.rotation.matrix().column(k));
        let (seconds, back) = self.history.seconds(self.world.dt());
        let energy = self.history.shown().map_or_else(|| self.world.energy(), |moment| moment.energy);
        let selected = self.selected.and_then(|id| self.selected(id));
        let impacts = self.impacts();
        let hands = self.hands.iter().map(|hand| {
            json!({ "hand": hand.hand, "body": hand.body, "point": numbers(hand.point(&self.world)), "target": numbers(hand.target) })
        });
        Report {
            time: step as f64 * self.world.dt(),
            step,
            slice: json!({
                "origin": numbers(pose.translation),
                "axes": (0..self.view.drawn).map(axis).collect::<Vec<_>>(),
                "off": (self.view.drawn..N).map(axis).collect::<Vec<_>>(),
            }),
            selected,
            impacts,
            hands: hands.collect(),
            quarantined: self.world.quarantined().iter().filter_map(|&handle| self.id_of(handle)).collect(),
            history: json!({ "seconds": seconds, "secondsBack": back, "undo": self.history.last_change() }),
            energy: json!({ "kinetic": energy.kinetic, "potential": energy.potential, "total": energy.total() }),
        }
    }

    fn impacts(&mut self) -> Vec<Value> {
        let held = |handle| self.hands.iter().any(|hand| hand.handle == handle);
        let found = self.impacts.take(held);
        let told = found.into_iter().filter_map(|impact| {
            let (body, other) = (self.id_of(impact.bodies.0)?, self.id_of(impact.bodies.1)?);
            let holds = self.hands.iter().filter(|hand| hand.body == body || hand.body == other);
            let hands: Vec<u32> = holds.map(|hand| hand.hand).collect();
            Some(json!({
                "body": body, "other": other, "impulse": impact.impulse, "point": numbers(impact.point), "hands": hands,
            }))
        });
        told.collect()
    }

    /// What panels tell of a body, at the moment that is shown.
    fn selected(&self, id: u32) -> Option<Value> {
        let entry = self.entries.get(id as usize)?;
        let body = self.world.body(entry.handle?)?;
        let past = match self.history.shown() {
            Some(moment) => Some(moment.bodies.iter().find(|state| state.id == id)?),
            None => None,
        };
        let pose = past.map_or_else(|| body.pose(), |state| state.pose);
        let velocity = past.map_or_else(|| body.velocity(), |state| state.velocity);
        let angular_velocity = past.map_or_else(|| body.angular_velocity(), |state| state.angular_velocity);
        let centre = pose.transform_point(entry.centre_in_body);
        let rotation = pose.rotation.matrix();
        let planes = |bivector| serde_json::to_value(Planes::from_bivector(&bivector)).ok();
        let kinetic = past.map_or_else(|| body.kinetic_energy(), |state| state.kinetic);
        let angular_momentum = past.map_or_else(|| body.angular_momentum(), |state| state.angular_momentum);
        let potential = -body.mass() * entry.spec.gravity_scale * self.world.gravity().dot(centre);
        Some(json!({
            "body": id,
            "name": entry.name,
            "kind": kind(entry.spec.kind),
            "mass": body.mass(),
            "position": numbers(centre),
            "velocity": numbers(velocity),
            "rotation": (0..N).map(|row| numbers(rotation.row(row))).collect::<Vec<_>>(),
            "rotor": Rotor::from_rotation(&pose.rotation).coefficients(),
            "angularVelocity": planes(angular_velocity),
            "angularMomentum": planes(angular_momentum),
            "principalMoments": numbers(body.principal_moments()),
            "momentum": numbers(velocity * body.mass()),
            "energy": { "kinetic": kinetic, "potential": potential, "total": kinetic + potential },
            "sleeping": past.map_or_else(|| body.is_sleeping(), |state| state.asleep),
            "frozen": past.map_or(entry.frozen, |state| state.frozen),
        }))
    }
}
