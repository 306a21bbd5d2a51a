//! What a snapshot is made of, part by part, as bytes. Structures list all of their fields, so that a new one cannot be
//! forgotten; what is a buffer, or follows from the rest, is marked `unset` and made anew by `assemble`.

use hyperbody_collision::{ContactPoint, max_points};
use hyperbody_geometry::bytes::{BytesError, Reader, Stored, Writer};
use hyperbody_geometry::{stored, stored_choice};
use hyperbody_math::{Bivector, Vector};

use crate::BodyKind;
use crate::body::{Body, Inertia};
use crate::events::{BrokenJoint, Events, SensorEvent, SensorPhase};
use crate::filter::{Groups, IgnoredPairs};
use crate::handle::{Arena, BodyHandle, Handle, JointHandle, Slot};
use crate::islands::Islands;
use crate::joint::{Coupling, Freedom, Joint, JointDef, Motor, Spring, WORLD};
use crate::material::{CombineRule, Material};
use crate::meetings::Meetings;
use crate::pairs::{Anchors, Contact, Meeting, NONE, Pair, PairRole, Pairs, Passage, Search, Touch, Touches, in_order};
use crate::tuning::Tuning;
use crate::world::Motion;

stored!(BodyHandle { index, generation });
stored!(JointHandle { index, generation });
stored!(Groups { memberships, mask });
stored_choice!(BodyKind { Dynamic = 0, Static = 1, Kinematic = 2 });
stored_choice!(CombineRule { GeometricMean = 0, Average = 1, Minimum = 2, Multiply = 3, Maximum = 4 });
stored!(Material {
    friction,
    restitution,
    density,
    rolling_resistance,
    twisting_resistance,
    friction_rule,
    restitution_rule
});
stored!(Tuning {
    contact_hz,
    contact_damping_ratio,
    push_out_speed,
    slop,
    speculative_distance,
    recycle_distance,
    restitution_threshold,
    joint_hz,
    joint_damping_ratio,
    joint_budget: wide,
    sleep_speed,
    sleep_time,
    max_speed,
    max_spin,
    tree_margin,
});
stored!(Inertia<N> { body_from_principal, moments, isotropic: wide_option });
stored!(Body<N> {
    kind,
    shape,
    material,
    colliders,
    joints: unset,
    mass,
    inverse_mass,
    inertia,
    centre_in_body,
    radius: unset,
    core_radius: unset,
    is_ball: unset,
    centre,
    rotation,
    velocity,
    angular_velocity,
    angular_momentum,
    force,
    torque,
    pushed,
    steady_force,
    steady_torque,
    surface_velocity,
    led_to,
    arrived,
    gravity_scale,
    linear_damping,
    angular_damping,
    groups,
    sensor,
    one_way,
    contact_hook,
    refilter,
    can_sleep,
    slow_time,
    strayed,
    asleep_in,
    quarantined,
    vetted: unset,
    solver_index: unset,
});
stored!(Motion<N> { way: wide, speed: wide, velocity: unset, awake, plain: unset, moved });

stored!(Motor { speed, max_force: wide });
stored!(Spring { target, hz, damping_ratio, max_force: wide });
stored!(Freedom { locked, limits, motor, spring });
stored!(JointDef<N> {
    a,
    b,
    frame_a,
    frame_b,
    axes,
    planes,
    cone,
    distance: open,
    coupling,
    phase,
    softness,
    max_force: wide,
    max_torque: wide,
    break_force: wide,
    break_torque: wide,
    collide,
});

/// The number of the kind, then axes and numbers; the definition of the joint says whether they can be.
impl Stored for Coupling {
    fn write(&self, out: &mut Writer) {
        match *self {
            Self::Gear { plane, teeth } => {
                ((0_u8, plane), (teeth.0.cast_unsigned(), teeth.1.cast_unsigned())).write(out);
            }
            Self::Rack { plane, radius } => ((1_u8, plane), radius).write(out),
            Self::Screw { plane, along, lead } => ((2_u8, plane), (along, lead)).write(out),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (kind, plane): (u8, (u8, u8)) = Stored::read(from)?;
        match kind {
            0 => {
                let (a, b): (u32, u32) = Stored::read(from)?;
                Ok(Self::Gear { plane, teeth: (a.cast_signed(), b.cast_signed()) })
            }
            1 => Ok(Self::Rack { plane, radius: Stored::read(from)? }),
            2 => {
                let (along, lead) = Stored::read(from)?;
                Ok(Self::Screw { plane, along, lead })
            }
            other => Err(from.error(format!("{other} stands for no coupling"))),
        }
    }
}

/// Rows and groups follow from the definition.
impl<const N: usize> Stored for Joint<N> {
    fn write(&self, out: &mut Writer) {
        self.def.write(out);
        (self.arm_a, self.arm_b).write(out);
        self.impulses.write(out);
        (self.step_impulse, self.step_twist).write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let def: JointDef<N> = Stored::read(from)?;
        let groups = def.validate().and_then(|()| def.groups());
        let groups = groups.map_err(|error| from.error(format!("a joint: {error}")))?;
        let (arm_a, arm_b) = Stored::read(from)?;
        let impulses: Vec<[f64; 2]> = Stored::read(from)?;
        let (step_impulse, step_twist): (Vector<N>, Bivector<N>) = Stored::read(from)?;
        let ends = (def.a.map_or(WORLD, |body| body.index), def.b.index);
        let joint = Self::new(def, groups, (ends.0, Vector::ZERO), (ends.1, Vector::ZERO));
        if impulses.len() != joint.rows.len() {
            let rows = joint.rows.len();
            return Err(from.error(format!("a joint has {} impulses for {rows} rows", impulses.len())));
        }
        Ok(Self { arm_a, arm_b, impulses, step_impulse, step_twist, ..joint })
    }
}

stored_choice!(SensorPhase { Enter = 0, Leave = 1 });
stored!(SensorEvent { sensor, other, phase });
stored!(BrokenJoint<N> { joint, bodies, force, torque });
stored!(Meetings<N> { dropped, gone, found: unset, order: unset, counting: unset });
stored!(Events<N> {
    contacts: unset,
    asked: unset,
    quiet,
    meetings,
    sensors,
    woken,
    slept,
    broken,
    inside,
    noticed: unset,
});
stored!(Islands { sleeping, free, parent: unset, least_slow_time: unset, became: unset, held: unset, changes });

impl Stored for IgnoredPairs {
    fn write(&self, out: &mut Writer) {
        out.length(self.0.len());
        self.0.iter().for_each(|pair| pair.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let pairs: Vec<(u32, u32)> = Stored::read(from)?;
        if !(pairs.is_sorted_by(|a, b| a < b) && pairs.iter().all(|(a, b)| a < b)) {
            return Err(from.error("pairs that are switched off are out of order"));
        }
        Ok(Self(pairs.into_iter().collect()))
    }
}

stored_choice!(PairRole { Solid = 0, Ruled = 1, Sensor = 2 });
stored_choice!(Meeting { Apart = 0, Touching = 1, Asleep = 2 });
stored_choice!(Passage { Apart = 0, Held = 1, Passing = 2 });
stored!(Search<N> { a_from_b, cache });
stored!(Pair<N> {
    collider_a,
    collider_b,
    body_a,
    body_b,
    holds_until: wide,
    deepest,
    points,
    touching,
    bounces,
    resists,
    role,
    overlaps,
    suspect,
    round,
    meeting,
    met,
    passage,
    search,
    contact,
});

/// A touch with its anchors, as bytes hold them.
struct AnchoredTouch<const N: usize> {
    point: ContactPoint<N>,
    normal_impulse: f32,
    step_impulse: f32,
    anchors: Anchors<N>,
}

stored!(AnchoredTouch<N> { point, normal_impulse, step_impulse, anchors });

impl<const N: usize> Stored for Contact<N> {
    fn write(&self, out: &mut Writer) {
        (self.radii, (self.friction, self.restitution)).write(out);
        (self.resistance, (self.surface, self.share_of_b)).write(out);
        (self.friction_impulse, (self.twist_impulse, (self.normal, self.normal_in_a))).write(out);
        // Those of balls have no anchors.
        let anchors = self.anchors.iter().copied().chain(std::iter::repeat((Vector::ZERO, Vector::ZERO)));
        let anchored = self.touches.iter().zip(anchors).map(|(touch, anchors)| AnchoredTouch {
            point: touch.point,
            normal_impulse: touch.normal_impulse,
            step_impulse: touch.step_impulse,
            anchors,
        });
        anchored.collect::<Vec<_>>().write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (radii, (friction, restitution)): ((f64, f64), (f64, f64)) = Stored::read(from)?;
        let (resistance, (surface, share_of_b)): ((f64, f64), (Vector<N>, f64)) = Stored::read(from)?;
        let least = [radii.0, radii.1, friction, restitution, resistance.0, resistance.1, share_of_b];
        if least.iter().any(|&value| value < 0.0) {
            return Err(from.error("radii, friction, restitution or resistance of a contact are negative"));
        }
        let (friction_impulse, (twist_impulse, (normal, normal_in_a))) = Stored::read(from)?;
        let touches: Vec<AnchoredTouch<N>> = Stored::read(from)?;
        if touches.len() > max_points(N) {
            return Err(from.error(format!(
                "a contact has {} points; there are at most {} in {N} dimensions",
                touches.len(),
                max_points(N)
            )));
        }
        let bare = |AnchoredTouch { point, normal_impulse, step_impulse, .. }: &_| Touch {
            point: *point,
            normal_impulse: *normal_impulse,
            step_impulse: *step_impulse,
        };
        Ok(Self {
            touches: Touches::List(touches.iter().map(bare).collect()),
            anchors: touches.iter().map(|touch| touch.anchors).collect(),
            normal,
            friction,
            restitution,
            resistance,
            surface,
            share_of_b,
            friction_impulse,
            twist_impulse,
            normal_in_a,
            radii,
        })
    }
}

/// That a list of free slots names each slot without value once, and no other.
fn check_free(free: &[u32], taken: &[bool], from: &Reader<'_>) -> Result<(), BytesError> {
    let mut taken = taken.to_vec();
    for &slot in free {
        if taken.get_mut(slot as usize).is_none_or(|taken| std::mem::replace(taken, true)) {
            return Err(from.error(format!("slot {slot} is listed as free, but is taken, listed twice, or not there")));
        }
    }
    if taken.iter().all(|&taken| taken) {
        return Ok(());
    }
    Err(from.error("a slot is neither taken nor listed as free"))
}

impl<T: Stored> Stored for Slot<T> {
    fn write(&self, out: &mut Writer) {
        self.generation.write(out);
        self.value.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        Ok(Self { generation: Stored::read(from)?, value: Stored::read(from)? })
    }
}

impl<T: Stored, H: Handle> Stored for Arena<T, H> {
    fn write(&self, out: &mut Writer) {
        self.slots.write(out);
        self.free.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut arena = Self::new();
        (arena.slots, arena.free) = (Stored::read(from)?, Stored::read(from)?);
        let taken: Vec<bool> = arena.slots.iter().map(|slot| slot.value.is_some()).collect();
        check_free(&arena.free, &taken, from)?;
        Ok(arena)
    }
}

impl<const N: usize> Stored for Pairs<N> {
    fn write(&self, out: &mut Writer) {
        self.slots.write(out);
        self.free.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut pairs = Self { slots: Stored::read(from)?, free: Stored::read(from)?, ..Self::new() };
        let taken: Vec<bool> = pairs.slots.iter().map(Option::is_some).collect();
        check_free(&pairs.free, &taken, from)?;
        pairs.keys.resize(pairs.slots.len(), NONE);
        for (slot, pair) in pairs.slots.iter().enumerate() {
            let Some(pair) = pair else { continue };
            let key = (pair.collider_a, pair.collider_b);
            pairs.keys[slot] = key;
            if key.0 >= key.1 || pairs.slot_of.insert(in_order(&key), slot as u32).is_some() {
                return Err(from.error(format!("the pair of colliders {key:?} is out of order, or there twice")));
            }
        }
        Ok(pairs)
    }
}
