//! Couplings: one motion made to follow another, as teeth and threads do.
//!
//! A coupling is one held row. What it holds is a number of the place of both bodies, the same after each tooth or turn, so it
//! is known up to whole teeth from where the bodies are: nothing is counted along the way, nothing drifts however long they run, and what is
//! forced on by more than half a tooth jumps to the next one.
//!
//! # In n dimensions
//!
//! What a wheel turns in is a plane of its frame, whatever the dimension. Two wheels *mesh* at a point where their surfaces
//! move alike: that takes a direction which lies in both planes. Gears here turn in one and the same plane (spur gears and
//! rings with teeth inside); what holds them in it are their own joints, such as hinges to a carrier, which need not stand
//! still. With e the direction from the first wheel to the second, seen at the angle φ_a from the first and −e at φ_b from the
//! second, wheels roll on each other where
//!
//! z_a φ_a + z_b φ_b = const (mod 2π),
//!
//! with z the numbers of teeth. Its rate is, up to the factor d/(z_a + z_b), the velocity of the one surface against the other
//! at the point that divides the distance d of the centres as the teeth do. So the row is a force along the common tangent
//! at that point, equal and opposite on the two: momentum and angular momentum are kept, and no third body has to
//! be named. A rack is a wheel without end: x + r φ = const (mod 2πr). A screw turns in a plane and goes along an axis across it:
//! x − p θ/2π = const (mod p).
//!
//! Not here: wheels whose planes share a line only (bevel gears), and in 4D and up wheels whose planes share a point (a turn in
//! xy that drives one in zw), which touch nowhere: such a row would be two torques that some third body takes.

use std::f64::consts::TAU;

use hyperbody_math::{Matrix, Pose, Vector, planes, scalar};

use super::{Freedom, JointDef};
use crate::{BodyHandle, WorldError, WorldErrorKind};

/// What couples the motions of two bodies; axes and planes are those of the joint's frames.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Coupling {
    /// Wheels about the anchors that mesh between them.
    Gear {
        /// The plane in which both turn.
        plane: (u8, u8),
        /// Teeth of the first and the second wheel; negative for a wheel that runs inside a ring. Their sum is not 0.
        teeth: (i32, i32),
    },
    /// A wheel about the first anchor on a straight rack, which is the second body.
    Rack {
        /// Of the second frame: the rack runs along the first axis and lies at the negative side of the second one, seen from
        /// the wheel, if the radius is positive.
        plane: (u8, u8),
        /// Of the wheel, m; not 0.
        radius: f64,
    },
    /// A thread: the second body goes along an axis as it turns.
    Screw {
        /// The plane in which it turns.
        plane: (u8, u8),
        /// The axis of the first frame along which it goes, not one of the plane.
        along: u8,
        /// How far it goes in a whole turn, m; negative for left-handed threads, not 0.
        lead: f64,
    },
}

/// Most teeth of a wheel: with more, half a tooth would be less than what loaded joints give way.
const MOST_TEETH: i32 = 1000;

/// Least cosine between the planes of two wheels: 8°.
const PARALLEL: f64 = 0.99;

/// Least share of the distance of two wheels that lies in their plane.
const NEAREST: f64 = 0.1;

impl Coupling {
    /// What it holds, as it is: rad of teeth for gears, else m. `gap` leads from the first anchor to the second; the columns
    /// of `a` and `b` are the axes of the frames, all in the same coordinates.
    pub(crate) fn measure<const N: usize>(&self, gap: Vector<N>, a: &Matrix<N>, b: &Matrix<N>) -> f64 {
        let of = |frame: &Matrix<N>, axis: u8| frame.column(usize::from(axis));
        match *self {
            Self::Gear { plane: (i, j), teeth } => {
                let angle =
                    |frame, toward: Vector<N>| scalar::atan2(of(frame, j).dot(toward), of(frame, i).dot(toward));
                f64::from(teeth.0) * angle(a, gap) + f64::from(teeth.1) * angle(b, -gap)
            }
            Self::Rack { plane: (i, j), radius } => {
                let along = of(b, i);
                let turned = scalar::atan2(of(a, j).dot(along), of(a, i).dot(along));
                gap.dot(along) + radius * turned
            }
            Self::Screw { plane: (i, j), along, lead } => {
                let (ai, aj, bi, bj) = (of(a, i), of(a, j), of(b, i), of(b, j));
                let turned = scalar::atan2(aj.dot(bi) - ai.dot(bj), ai.dot(bi) + aj.dot(bj));
                gap.dot(of(a, along)) - lead / TAU * turned
            }
        }
    }

    /// After how much of that everything is as before, but for whole teeth and turns.
    pub(crate) fn period(&self) -> f64 {
        match *self {
            Self::Gear { .. } => TAU,
            Self::Rack { radius, .. } => TAU * radius.abs(),
            Self::Screw { lead, .. } => lead.abs(),
        }
    }

    /// m for each unit of what it holds, with the anchors `distance` apart in its plane.
    pub(crate) fn scale(&self, distance: f64) -> f64 {
        match *self {
            Self::Gear { teeth, .. } => distance / f64::from(teeth.0 + teeth.1),
            Self::Rack { .. } | Self::Screw { .. } => 1.0,
        }
    }

    /// The part of a difference that is not whole teeth and turns.
    pub(crate) fn off(&self, difference: f64) -> f64 {
        let period = self.period();
        difference - period * (difference / period).round()
    }

    pub(crate) fn plane(&self) -> (u8, u8) {
        match *self {
            Self::Gear { plane, .. } | Self::Rack { plane, .. } | Self::Screw { plane, .. } => plane,
        }
    }

    /// Why wheels that lie like this do not mesh.
    fn cannot_mesh<const N: usize>(&self, gap: Vector<N>, a: &Matrix<N>, b: &Matrix<N>) -> Option<&'static str> {
        if matches!(self, Self::Screw { .. }) {
            return None;
        }
        let of = |frame: &Matrix<N>, axis: u8| frame.column(usize::from(axis));
        let (i, j) = self.plane();
        let (ai, aj, bi, bj) = (of(a, i), of(a, j), of(b, i), of(b, j));
        let together = ai.dot(bi) * aj.dot(bj) - ai.dot(bj) * aj.dot(bi);
        if together.abs() < PARALLEL {
            return Some("the wheels turn in different planes; the planes of both frames must be parallel");
        }
        let (x, y) = (ai.dot(gap), aj.dot(gap));
        let reach = (x * x + y * y).sqrt();
        (matches!(self, Self::Gear { .. }) && reach < (NEAREST * gap.norm()).max(1e-6)).then_some(
            "the wheels have their centres at the same place of their plane; they must lie apart in it to mesh between them",
        )
    }

    /// Within a joint of which the axes and planes may do this. Not generic, so that programs hold it once.
    pub(crate) fn validate(&self, axes: &[Freedom], of_planes: &[Freedom]) -> Result<(), WorldError> {
        let (n, plane) = (axes.len(), self.plane());
        let (i, j) = (usize::from(plane.0.min(plane.1)), usize::from(plane.0.max(plane.1)));
        if i == j || j >= n {
            return Err(WorldError::bad_number(format!(
                "the plane of a coupling has the axes {} and {}; it needs two different ones below {n}",
                plane.0, plane.1
            )));
        }
        match *self {
            Self::Gear { teeth: (a, b), .. } => {
                let good = |count: i32| count != 0 && (-MOST_TEETH..=MOST_TEETH).contains(&count);
                if !(good(a) && good(b) && a + b != 0) {
                    return Err(WorldError::bad_number(format!(
                        "the wheels have {a} and {b} teeth; each needs 1 to {MOST_TEETH}, one of the two negative if it runs inside the other, and not as many as the other then"
                    )));
                }
            }
            Self::Rack { radius, .. } => check_length("the radius of the wheel", radius)?,
            Self::Screw { along, lead, .. } => {
                check_length("the lead of the screw", lead)?;
                let along = usize::from(along);
                if along >= n || along == i || along == j {
                    return Err(WorldError::bad_number(format!(
                        "the screw goes along axis {along}; that needs to be one below {n} across its plane"
                    )));
                }
                if of_planes[planes::index(n, i, j)].locked || axes[along].locked {
                    let message = "a screw needs its plane and its axis free; take JointDef::screw";
                    return Err(WorldError::new(WorldErrorKind::NotAllowed, message));
                }
            }
        }
        Ok(())
    }
}

fn check_length(what: &str, length: f64) -> Result<(), WorldError> {
    if (1e-3..=1e6).contains(&length.abs()) {
        return Ok(());
    }
    Err(WorldError::bad_number(format!("{what} is {length} m; it must lie between 1e-3 and 1e6, of either sign")))
}

impl<const N: usize> JointDef<N> {
    /// Two wheels that mesh: `b` turns in the plane of the frames' axes i and j as the teeth between the anchors make it, the other
    /// way round than `a` unless one number of teeth is negative. That is the wheel which runs inside the other one's ring. They
    /// mesh as they lie when the joint is added. What holds the wheels in place, such as hinges, are joints of their own;
    /// `a: None` is a wheel that stands still in the world.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn gear(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        (i, j): (usize, usize),
        teeth: (i32, i32),
    ) -> Self {
        let coupling = Coupling::Gear { plane: axes_of::<N>(i, j), teeth };
        Self { coupling: Some(coupling), ..Self::free(a, b).frames(frame_a, frame_b) }
    }

    /// A wheel `a` of this radius (m), turning about its anchor in the plane of axes i and j, on a rack `b`, which runs along
    /// axis i of its frame and lies at the negative side of axis j, seen from the wheel; a negative radius puts it to the other
    /// side.
    ///
    /// # Panics
    /// If i = j or an axis is not below `N`.
    #[must_use]
    pub fn rack(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        (i, j): (usize, usize),
        radius: f64,
    ) -> Self {
        let coupling = Coupling::Rack { plane: axes_of::<N>(i, j), radius };
        Self { coupling: Some(coupling), ..Self::free(a, b).frames(frame_a, frame_b) }
    }

    /// Turns in the plane of axes i and j and goes along another axis, `lead` metres in a turn from i to j and on, and does nothing
    /// else.
    ///
    /// # Panics
    /// If an axis is not below `N` or two of the three are the same.
    #[must_use]
    pub fn screw(
        a: impl Into<Option<BodyHandle>>,
        b: BodyHandle,
        frame_a: Pose<N>,
        frame_b: Pose<N>,
        (i, j): (usize, usize),
        along: usize,
        lead: f64,
    ) -> Self {
        assert!(along < N && along != i && along != j, "a screw goes along another axis below {N}, got {along}");
        let def = Self::hinge(a, b, frame_a, frame_b, (i, j)).axis(along, Freedom::FREE);
        Self { coupling: Some(Coupling::Screw { plane: axes_of::<N>(i, j), along: along as u8, lead }), ..def }
    }

    /// The same, with what a coupling holds as the bodies lie now, where the definition does not say.
    pub(crate) fn meshed(mut self, world_from_a: &Pose<N>, world_from_b: &Pose<N>) -> Result<Self, WorldError> {
        let Some(coupling) = self.coupling else { return Ok(self) };
        let (a, b) = (*world_from_a * self.frame_a, *world_from_b * self.frame_b);
        let gap = b.translation - a.translation;
        if let Some(why) = coupling.cannot_mesh(gap, a.rotation.matrix(), b.rotation.matrix()) {
            return Err(WorldError::new(WorldErrorKind::NotAllowed, why));
        }
        if self.phase.is_some() {
            return Ok(self);
        }
        self.phase = Some(coupling.measure(gap, a.rotation.matrix(), b.rotation.matrix()));
        Ok(self)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "axes are fewer than seven")]
fn axes_of<const N: usize>(i: usize, j: usize) -> (u8, u8) {
    assert!(i != j && i < N && j < N, "a plane needs two different axes below {N}, got ({i}, {j})");
    (i as u8, j as u8)
}
