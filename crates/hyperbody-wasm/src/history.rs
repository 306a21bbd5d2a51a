//! The last seconds: where everything was and how it moved, step by step, and before every change that can be taken back.

use std::collections::VecDeque;

use hyperbody::math::{Bivector, Pose, Vector};
use hyperbody::prelude::Energy;

/// Where a body was and how it moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BodyMoment<const N: usize> {
    /// The body's number.
    pub(crate) id: u32,
    pub(crate) pose: Pose<N>,
    pub(crate) velocity: Vector<N>,
    pub(crate) angular_velocity: Bivector<N>,
    /// For panels; restoring finds it anew from the velocities.
    pub(crate) angular_momentum: Bivector<N>,
    /// The same, J.
    pub(crate) kinetic: f64,
    pub(crate) asleep: bool,
    pub(crate) frozen: bool,
}

/// The world at one moment; bodies ascending by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Moment<const N: usize> {
    /// Steps since the scene's start.
    pub(crate) step: u64,
    pub(crate) energy: Energy,
    pub(crate) bodies: Vec<BodyMoment<N>>,
}

/// What the history may take, bytes.
const MOST_BYTES: usize = 64 << 20;

/// How far it reaches back at most, s.
const MOST_SECONDS: f64 = 20.0;

/// Changes that can be taken back.
const MOST_CHANGES: usize = 40;

/// Moments of the last seconds, and those before changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct History<const N: usize> {
    moments: VecDeque<Moment<N>>,
    changes: VecDeque<(&'static str, Moment<N>)>,
    /// How many moments back the one that is shown is; 0: the present.
    back: usize,
}

impl<const N: usize> History<N> {
    /// An empty moment to be filled and recorded, made of memory that is no longer needed.
    pub(crate) fn spare(&mut self, bodies: usize, dt: f64) -> Moment<N> {
        let size = (bodies * size_of::<BodyMoment<N>>()).max(1);
        let most = ((MOST_SECONDS / dt) as usize).min(MOST_BYTES / size).max(2);
        let mut spare = None;
        while self.moments.len() >= most {
            spare = self.moments.pop_front();
        }
        let mut moment = spare.unwrap_or_default();
        moment.bodies.clear();
        moment
    }

    /// Adds the present.
    pub(crate) fn record(&mut self, moment: Moment<N>) {
        self.moments.push_back(moment);
        self.back = 0;
    }

    /// Shows an earlier moment; the present for 0.
    pub(crate) fn show(&mut self, seconds_back: f64, dt: f64) {
        let steps = (seconds_back / dt).round().clamp(0.0, u32::MAX.into()) as usize;
        self.back = steps.min(self.moments.len().saturating_sub(1));
    }

    /// The earlier moment that is shown; `None` for the present.
    pub(crate) fn shown(&self) -> Option<&Moment<N>> {
        if self.back == 0 {
            return None;
        }
        self.moments.get(self.moments.len().checked_sub(self.back + 1)?)
    }

    /// Forgets everything after the moment that is shown, which is returned: it is the present now.
    pub(crate) fn forget_later(&mut self) -> Option<Moment<N>> {
        let shown = self.shown()?.clone();
        self.moments.truncate(self.moments.len() - self.back);
        self.changes.retain(|(_, before)| before.step <= shown.step);
        self.back = 0;
        Some(shown)
    }

    /// How far back the moments reach, and how far back the one shown is, s.
    pub(crate) fn seconds(&self, dt: f64) -> (f64, f64) {
        (self.moments.len().saturating_sub(1) as f64 * dt, self.back as f64 * dt)
    }

    /// Notes the world before a change.
    pub(crate) fn before(&mut self, change: &'static str, moment: Moment<N>) {
        if self.changes.len() == MOST_CHANGES {
            self.changes.pop_front();
        }
        self.changes.push_back((change, moment));
    }

    /// The last change, which is to be taken back.
    pub(crate) fn undo(&mut self) -> Option<(&'static str, Moment<N>)> {
        self.changes.pop_back()
    }

    /// What [`History::undo`] would take back.
    pub(crate) fn last_change(&self) -> Option<&'static str> {
        self.changes.back().map(|(change, _)| *change)
    }
}
