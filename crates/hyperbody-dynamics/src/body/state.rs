//! What the world keeps of a body: the state of the equations of motion, and the constants of its mass.
//!
//! The state of rotation is the angular momentum in the world frame, because free motion keeps it; the angular
//! velocity follows from it and the attitude.

use hyperbody_geometry::{MassProperties, Shape};
use hyperbody_math::{Bivector, Pose, Rotation, Vector};

use crate::vetting::in_bounds;
use crate::{BodyDef, BodyKind, Groups, Material, WorldError, error::WorldErrorKind};

/// Second moments of a body in its principal frame.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Inertia<const N: usize> {
    /// The moment of every plane where they are all equal (cubes, regular polytopes, balls; everything in 2D): then
    /// angular momentum and velocity are parallel and the principal frame does not matter.
    pub(crate) isotropic: Option<f64>,
    /// J_i, kg·m²; plane (i, j) has the moment J_i + J_j.
    pub(crate) moments: Vector<N>,
    /// The attitude of the principal frame in the body's frame.
    pub(crate) body_from_principal: Rotation<N>,
}

/// Relative difference of principal moments below which a body counts as isotropic: rounding in second moments of
/// symmetric shapes is two orders smaller, and 1e-12 moves a spin by 1e-12 of itself a radian.
const ISOTROPY_TOLERANCE: f64 = 1e-12;

impl<const N: usize> Inertia<N> {
    pub(crate) fn from_mass_properties(properties: &MassProperties<N>) -> Self {
        let (moments, body_from_principal) = properties.principal();
        let largest = moments.max_abs();
        let equal = (0..N).all(|i| (moments[i] - moments[0]).abs() <= ISOTROPY_TOLERANCE * largest);
        let isotropic = if N == 2 {
            Some(moments.iter().sum())
        } else {
            equal.then(|| 2.0 * moments.iter().sum::<f64>() / N as f64)
        };
        let body_from_principal = if isotropic.is_some() { Rotation::IDENTITY } else { body_from_principal };
        Self { body_from_principal, moments, isotropic }
    }

    /// The smallest moment of a plane, kg·m².
    pub(crate) fn smallest_plane_moment(&self) -> f64 {
        self.isotropic.unwrap_or_else(|| {
            hyperbody_math::planes::all(N).map(|(i, j)| self.plane_moment(i, j)).fold(f64::INFINITY, f64::min)
        })
    }

    /// Moment of plane (i, j) of the principal frame, kg·m².
    #[inline]
    pub(crate) fn plane_moment(&self, i: usize, j: usize) -> f64 {
        self.isotropic.unwrap_or(self.moments[i] + self.moments[j])
    }

    /// Angular momentum of an angular velocity, both in the world frame.
    pub(crate) fn momentum(&self, world_from_body: &Rotation<N>, angular_velocity: &Bivector<N>) -> Bivector<N> {
        if let Some(moment) = self.isotropic {
            return *angular_velocity * moment;
        }
        let frame = *world_from_body * self.body_from_principal;
        let local = frame.inverse_rotate_bivector(angular_velocity);
        frame.rotate_bivector(&local.scale_planes(|i, j| self.plane_moment(i, j)))
    }

    /// Angular velocity of an angular momentum, both in the world frame.
    #[inline]
    pub(crate) fn velocity(&self, world_from_body: &Rotation<N>, angular_momentum: &Bivector<N>) -> Bivector<N> {
        if let Some(moment) = self.isotropic {
            return *angular_momentum * (1.0 / moment);
        }
        let frame = *world_from_body * self.body_from_principal;
        let local = frame.inverse_rotate_bivector(angular_momentum);
        frame.rotate_bivector(&local.scale_planes(|i, j| 1.0 / self.plane_moment(i, j)))
    }
}

/// A body of a world: first what its pairs ask for at every step, then what moving it on takes, then the rest. Of a large pile
/// each line of cache that is asked for in vain is waited for.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct Body<const N: usize> {
    pub(crate) kind: BodyKind,
    /// Whether it is one ball about its centre of mass, whose surface stays as it is when it turns.
    pub(crate) is_ball: bool,
    /// Its state turned non-finite; it stays where it last was, out of the simulation.
    pub(crate) quarantined: bool,
    /// Nobody touched it since the last step, which left it sound and within the limits.
    pub(crate) vetted: bool,
    /// The sleeping island that it belongs to.
    pub(crate) asleep_in: Option<u32>,
    /// Row of this step's solver, 0 for bodies that no impulse moves.
    pub(crate) solver_index: u32,
    /// Largest distance of a point of the body from its centre of mass, m: turns spin into speed.
    pub(crate) radius: f64,
    /// Of the centre of mass, m/s.
    pub(crate) velocity: Vector<N>,
    /// Centre of mass in the world, m.
    pub(crate) centre: Vector<N>,
    /// World frame, rad/s. Of dynamic bodies it follows from the momentum and the attitude.
    pub(crate) angular_velocity: Bivector<N>,

    /// Attitude.
    pub(crate) rotation: Rotation<N>,
    /// Centre of mass in the body's frame, m.
    pub(crate) centre_in_body: Vector<N>,
    /// About the centre of mass, world frame, kg·m²/s. Zero unless dynamic.
    pub(crate) angular_momentum: Bivector<N>,
    /// kg; zero unless dynamic.
    pub(crate) mass: f64,
    /// 1/kg; zero unless dynamic.
    pub(crate) inverse_mass: f64,
    pub(crate) gravity_scale: f64,
    pub(crate) linear_damping: f64,
    pub(crate) angular_damping: f64,
    /// Least radius of a core of its pieces, m: going farther in a step, it might pass through something.
    pub(crate) core_radius: f64,
    /// How long it has been slow, s.
    pub(crate) slow_time: f64,
    /// How its surface runs along it, as a conveyor's does, body frame, m/s.
    pub(crate) surface_velocity: Vector<N>,
    /// Pushes of the user until the end of the next step, world frame, N and N·m.
    pub(crate) force: Vector<N>,
    pub(crate) torque: Bivector<N>,
    /// How far it has gone (m) and turned (rad) while it was slow.
    pub(crate) strayed: (Vector<N>, Bivector<N>),
    /// Pushes that go on from step to step, world frame, N and N·m.
    pub(crate) steady_force: Vector<N>,
    pub(crate) steady_torque: Bivector<N>,
    /// Of dynamic bodies only.
    pub(crate) inertia: Inertia<N>,
    /// Whether pushes that go on have been added for the running step.
    pub(crate) pushed: bool,
    pub(crate) can_sleep: bool,
    /// Of kinematic bodies: whether it was led somewhere in the last step.
    pub(crate) arrived: bool,
    /// Whom it meets, or how, was changed since the last step.
    pub(crate) refilter: bool,
    pub(crate) contact_hook: bool,
    pub(crate) sensor: bool,
    pub(crate) groups: Groups,

    pub(crate) shape: Shape<N>,
    pub(crate) material: Material,
    /// Slots of its colliders, one for each convex piece.
    pub(crate) colliders: Vec<u32>,
    /// Slots of its joints, ascending.
    pub(crate) joints: Vec<u32>,
    /// Of kinematic bodies: where it is led in the next step.
    pub(crate) led_to: crate::steering::Target<N>,
    /// Unit, body frame: the side that holds, if it is one-way.
    pub(crate) one_way: Option<Vector<N>>,
}

/// Centre of mass and inertia for bodies that no impulse moves.
fn immovable<const N: usize>() -> (f64, Vector<N>, Inertia<N>) {
    let inertia =
        Inertia { body_from_principal: Rotation::IDENTITY, moments: Vector::ZERO, isotropic: Some(f64::INFINITY) };
    (0.0, Vector::ZERO, inertia)
}

impl<const N: usize> Body<N> {
    pub(crate) fn new(def: BodyDef<N>) -> Result<Self, WorldError> {
        def.validate()?;
        if matches!(def.shape, Shape::HalfSpace { .. }) && def.kind != BodyKind::Static {
            return Err(WorldError::new(
                WorldErrorKind::BadShape,
                "a half-space has no end and no mass: its body must be static",
            ));
        }
        let (mass, centre_in_body, inertia) = match def.kind {
            BodyKind::Dynamic => {
                let mut properties = def.shape.mass_properties(def.material.density)?;
                if let Some(mass) = def.mass {
                    properties = properties.scaled(mass / properties.mass);
                }
                let inertia = Inertia::from_mass_properties(&properties);
                check_mass(properties.mass, &inertia)?;
                (properties.mass, properties.centre, inertia)
            }
            BodyKind::Static | BodyKind::Kinematic => immovable(),
        };
        let velocity = if def.kind == BodyKind::Static { Vector::ZERO } else { def.velocity };
        let angular_velocity = if def.kind == BodyKind::Static { Bivector::ZERO } else { def.angular_velocity };
        let angular_momentum = match def.kind {
            BodyKind::Dynamic => inertia.momentum(&def.rotation, &angular_velocity),
            BodyKind::Static | BodyKind::Kinematic => Bivector::ZERO,
        };
        Ok(Self {
            kind: def.kind,
            material: def.material,
            colliders: Vec::new(),
            joints: Vec::new(),
            mass,
            inverse_mass: if mass > 0.0 { 1.0 / mass } else { 0.0 },
            inertia,
            centre_in_body,
            radius: 0.0,
            is_ball: false,
            core_radius: f64::INFINITY,
            centre: def.position + def.rotation.rotate(centre_in_body),
            rotation: def.rotation,
            velocity,
            angular_velocity,
            angular_momentum,
            force: Vector::ZERO,
            torque: Bivector::ZERO,
            pushed: false,
            steady_force: Vector::ZERO,
            steady_torque: Bivector::ZERO,
            surface_velocity: def.surface_velocity,
            led_to: None,
            arrived: false,
            gravity_scale: def.gravity_scale,
            linear_damping: def.linear_damping,
            angular_damping: def.angular_damping,
            groups: def.groups,
            sensor: def.sensor,
            one_way: def.one_way.and_then(Vector::try_normalize),
            contact_hook: def.contact_hook,
            refilter: false,
            can_sleep: def.can_sleep,
            slow_time: 0.0,
            strayed: (Vector::ZERO, Bivector::ZERO),
            asleep_in: None,
            quarantined: false,
            vetted: false,
            solver_index: 0,
            shape: def.shape,
        })
    }

    /// The pose of the body's frame.
    #[inline]
    pub(crate) fn world_from_body(&self) -> Pose<N> {
        Pose::new(self.rotation, self.centre - self.rotation.rotate(self.centre_in_body))
    }

    /// Moved by impulses in this step.
    #[inline]
    pub(crate) fn is_moving(&self) -> bool {
        self.kind == BodyKind::Dynamic && self.asleep_in.is_none() && !self.quarantined
    }

    /// Whether the tree and the pairs have to look at it in this step.
    #[inline]
    pub(crate) fn is_awake(&self) -> bool {
        self.kind != BodyKind::Static && self.asleep_in.is_none() && !self.quarantined
    }

    /// Speed of its fastest point about the centre of mass, m/s.
    #[inline]
    pub(crate) fn surface_speed_by_spin(&self) -> f64 {
        if self.radius > 0.0 { self.angular_velocity.norm() * self.radius } else { 0.0 }
    }

    /// How its surface runs, world axes, m/s.
    pub(crate) fn surface_in_world(&self) -> Vector<N> {
        if self.surface_velocity == Vector::ZERO { Vector::ZERO } else { self.rotation.rotate(self.surface_velocity) }
    }

    /// A kinematic body in motion.
    pub(crate) fn drifts(&self) -> bool {
        let still = self.velocity == Vector::ZERO && self.angular_velocity == Bivector::ZERO;
        self.kind == BodyKind::Kinematic && !self.quarantined && !still
    }

    /// A conveyor: its surface moves though the body may stand.
    pub(crate) fn runs(&self) -> bool {
        self.surface_velocity != Vector::ZERO && !self.quarantined
    }

    /// Comes to a full stop and rests until its island wakes.
    pub(crate) fn fall_asleep_in(&mut self, island: u32) {
        self.asleep_in = Some(island);
        self.velocity = Vector::ZERO;
        self.angular_velocity = Bivector::ZERO;
        self.angular_momentum = Bivector::ZERO;
    }

    pub(crate) fn kinetic_energy(&self) -> f64 {
        0.5 * (self.mass * self.velocity.norm_sq() + self.angular_momentum.dot(&self.angular_velocity))
    }

    /// Recomputes the angular velocity from the angular momentum and the attitude.
    #[inline]
    pub(crate) fn refresh_angular_velocity(&mut self) {
        if self.kind == BodyKind::Dynamic {
            self.angular_velocity = self.inertia.velocity(&self.rotation, &self.angular_momentum);
        }
    }

    /// Finite, and within [`crate::POSITION_LIMIT`], pushes included.
    pub(crate) fn state_is_sound(&self) -> bool {
        self.motion_is_sound() && self.force.is_finite() && self.torque.is_finite()
    }

    /// Finite, and within [`crate::POSITION_LIMIT`]. Never inlined: its masks would put what integrating keeps in registers on the stack.
    #[inline(never)]
    pub(crate) fn motion_is_sound(&self) -> bool {
        in_bounds(self.centre)
            && self.velocity.is_finite()
            && self.rotation.matrix().is_finite()
            && self.angular_momentum.is_finite()
            && self.angular_velocity.is_finite()
    }

    /// Ends being led from pose to pose; true if the body's velocities came from that.
    pub(crate) fn stop_leading(&mut self) -> bool {
        let led = self.led_to.take().is_some() || self.arrived;
        self.arrived = false;
        led
    }

    /// Takes the body out of the simulation, at rest at the given centre and attitude.
    pub(crate) fn quarantine(&mut self, (centre, rotation): (Vector<N>, Rotation<N>)) {
        self.quarantined = true;
        self.stop_leading();
        self.centre = centre;
        self.rotation = rotation;
        self.force = Vector::ZERO;
        self.torque = Bivector::ZERO;
        self.velocity = Vector::ZERO;
        self.angular_velocity = Bivector::ZERO;
        self.angular_momentum = Bivector::ZERO;
        (self.slow_time, self.strayed) = (0.0, (Vector::ZERO, Bivector::ZERO));
    }
}

/// Masses must survive division in single precision, in which the solver keeps its rows.
pub(crate) fn check_mass<const N: usize>(mass: f64, inertia: &Inertia<N>) -> Result<(), WorldError> {
    const RANGE: std::ops::RangeInclusive<f64> = 1e-15..=1e15;
    if !RANGE.contains(&mass) {
        return Err(WorldError::bad_number(format!(
            "the mass comes to {mass:?} kg; it must lie between 1e-15 and 1e15: change the density, the size, or give a mass"
        )));
    }
    for i in 0..N {
        for j in i + 1..N {
            let moment = inertia.plane_moment(i, j);
            if !(moment > 1e-24 && moment < 1e24) {
                return Err(WorldError::bad_number(format!(
                    "the moment of inertia of plane {} comes to {moment} kg·m²; it must lie between 1e-24 and 1e24",
                    hyperbody_math::planes::name(i, j)
                )));
            }
        }
    }
    Ok(())
}
