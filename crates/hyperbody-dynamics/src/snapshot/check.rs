//! Whether a state that was read can be one: every number within the range that calls on a world would hold it to, every
//! index that of something, every list in agreement with the others.

use hyperbody_geometry::tolerances::MAX_LENGTH;

use super::Snapshot;
use super::bytes::SnapshotError;
use crate::body::{Body, check_mass};
use crate::pairs::{Pair, PairRole};
use crate::vetting::in_bounds;
use crate::{BodyKind, World, WorldDef};

/// How far a stored direction may be from unit length.
const UNIT_TOLERANCE: f64 = 1e-9;

impl<const N: usize> Snapshot<N> {
    pub(super) fn check(&self) -> Result<(), SnapshotError> {
        let Self { gravity, dt, substeps, sleeping, tuning, .. } = *self;
        World::new(WorldDef { gravity, dt, substeps, sleeping, threads: 1, tuning })
            .map_err(SnapshotError::bad_state)?;
        for (handle, body) in self.bodies.iter() {
            check_body(body).map_err(|reason| SnapshotError::bad_state(format!("body {}: {reason}", handle.index)))?;
        }
        for pair in self.pairs.iter() {
            let (a, b) = (pair.collider_a, pair.collider_b);
            self.check_pair(pair)
                .map_err(|reason| SnapshotError::bad_state(format!("the pair of colliders {a} and {b} {reason}")))?;
        }
        self.check_islands()?;
        self.check_lists()
    }

    fn check_pair(&self, pair: &Pair<N>) -> Result<(), &'static str> {
        let body_of = |collider: u32| self.colliders.get(collider as usize)?.as_ref().map(|collider| collider.body);
        if (body_of(pair.collider_a), body_of(pair.collider_b)) != (Some(pair.body_a), Some(pair.body_b)) {
            return Err("does not name their bodies");
        }
        let (Some(a), Some(b)) = (self.bodies.at(pair.body_a), self.bodies.at(pair.body_b)) else {
            return Err("names a body that is not there");
        };
        let pushes = a.kind == BodyKind::Dynamic || b.kind == BodyKind::Dynamic;
        let notices = pair.role == PairRole::Sensor && (a.kind != BodyKind::Static || b.kind != BodyKind::Static);
        if pair.body_a == pair.body_b || !(pushes || notices) {
            return Err("is of one body, or of two that nothing moves");
        }
        if usize::from(pair.points) != pair.touches().len() || pair.touching > pair.points {
            return Err("counts other points than its contact has");
        }
        if pair.deepest < 0.0 {
            return Err("has a negative depth");
        }
        let normal = pair.normal().norm();
        if pair.points > 0 && (normal - 1.0).abs() > UNIT_TOLERANCE {
            return Err("has a normal that is not of length 1");
        }
        Ok(())
    }

    fn check_islands(&self) -> Result<(), SnapshotError> {
        let mut asleep = 0;
        for (island, members) in self.islands.sleeping.iter().enumerate() {
            for &member in members {
                let home = self.bodies.at(member).and_then(|body| body.asleep_in);
                if home != Some(island as u32) {
                    return Err(SnapshotError::bad_state(format!("body {member} is not asleep in island {island}")));
                }
            }
            let mut sorted = members.clone();
            sorted.sort_unstable();
            if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
                return Err(SnapshotError::bad_state(format!("island {island} names a body twice")));
            }
            asleep += members.len();
        }
        if asleep != self.bodies.values().filter(|body| body.asleep_in.is_some()).count() {
            return Err(SnapshotError::bad_state("a body sleeps in an island that does not know it"));
        }
        let mut free = vec![false; self.islands.sleeping.len()];
        for &island in &self.islands.free {
            let members = self.islands.sleeping.get(island as usize);
            if members.is_none_or(|members| !members.is_empty()) || std::mem::replace(&mut free[island as usize], true)
            {
                return Err(SnapshotError::bad_state(format!("island {island} is listed as free, but is not")));
            }
        }
        Ok(())
    }

    fn check_lists(&self) -> Result<(), SnapshotError> {
        let slots = self.bodies.slot_count();
        let there = |slot: u32| (slot as usize) < slots;
        if !self.ignored.0.iter().all(|&(a, b)| there(a) && there(b)) {
            return Err(SnapshotError::bad_state("a pair is switched off of which one body never was"));
        }
        if !self.wake_requests.iter().all(|&slot| there(slot)) {
            return Err(SnapshotError::bad_state("a body is to be woken that never was"));
        }
        for &handle in &self.quarantined {
            if self.bodies.get(handle).is_none_or(|body| !body.quarantined) {
                return Err(SnapshotError::bad_state(format!("body {} is not in quarantine", handle.index)));
            }
        }
        if !self.events.inside.is_sorted_by(|a, b| a < b) {
            return Err(SnapshotError::bad_state("what is inside sensors is out of order"));
        }
        if self.max_penetration < 0.0 {
            return Err(SnapshotError::bad_state(format!("the deepest overlap is {} m", self.max_penetration)));
        }
        if self.motions.iter().any(|motion| motion.way < 0.0 || motion.speed < 0.0) {
            return Err(SnapshotError::bad_state("a way or a speed is negative"));
        }
        Ok(())
    }
}

fn check_body<const N: usize>(body: &Body<N>) -> Result<(), String> {
    body.material.validate().map_err(|error| error.to_string())?;
    let dynamic = body.kind == BodyKind::Dynamic;
    if dynamic {
        check_mass(body.mass, &body.inertia).map_err(|error| error.to_string())?;
        if body.inertia.isotropic.is_none() && body.inertia.moments.iter().any(|moment| moment < 0.0) {
            return Err(format!("its moments are {:?}", body.inertia.moments.0));
        }
    }
    let inverse = if dynamic { 1.0 / body.mass } else { 0.0 };
    if body.inverse_mass != inverse || (!dynamic && body.mass != 0.0) {
        return Err(format!("its mass is {} kg, and the inverse {}", body.mass, body.inverse_mass));
    }
    if !in_bounds(body.centre) || body.led_to.is_some_and(|(centre, _)| !in_bounds(centre)) {
        return Err(format!("it is at {:?}, or led out of bounds", body.centre.0));
    }
    if body.centre_in_body.max_abs() > 2.0 * MAX_LENGTH {
        return Err(format!("its centre of mass lies at {:?} in its frame", body.centre_in_body.0));
    }
    if body.linear_damping < 0.0 || body.angular_damping < 0.0 || body.slow_time < 0.0 {
        return Err("its damping or its slow time is negative".to_owned());
    }
    if body.one_way.is_some_and(|side| (side.norm() - 1.0).abs() > UNIT_TOLERANCE) {
        return Err("its one-way side is no unit vector".to_owned());
    }
    if body.asleep_in.is_some() && !dynamic {
        return Err("it sleeps, but is not dynamic".to_owned());
    }
    Ok(())
}
