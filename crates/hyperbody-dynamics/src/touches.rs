//! The points of a contact.
//!
//! Every stage of a step comes to all of them, and in a large pile each line of cache is waited for. So what only the narrow phase
//! reads stands apart (`Contact::anchors`), and a point that stays alone, as between balls, lies in the contact itself.

use std::ops::{Deref, DerefMut};

use hyperbody_collision::ContactPoint;
use hyperbody_math::Vector;

/// One point of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch<const N: usize> {
    pub(crate) point: ContactPoint<N>,
    /// Warm start: normal impulse over one substep, N·s.
    pub(crate) normal_impulse: f32,
    /// Normal impulse over the last step, N·s.
    pub(crate) step_impulse: f32,
}

impl<const N: usize> Touch<N> {
    pub(crate) fn new(point: ContactPoint<N>) -> Self {
        Self { point, normal_impulse: 0.0, step_impulse: 0.0 }
    }
}

/// The two surfaces' points of a touch, each in its collider's frame.
pub(crate) type Anchors<const N: usize> = (Vector<N>, Vector<N>);

/// The points of a contact, as a slice.
#[derive(Clone, Debug)]
pub(crate) enum Touches<const N: usize> {
    /// The one point of a ball.
    Alone(Touch<N>),
    /// Has room for as many as there can be, so that no step asks for memory, and for no more.
    List(Vec<Touch<N>>),
}

impl<const N: usize> Touches<N> {
    /// No points, and room for so many.
    pub(crate) fn with_room(most: usize) -> Self {
        Self::List(Vec::with_capacity(most))
    }

    /// What they take beside the contact, bytes.
    pub(crate) fn memory(&self) -> usize {
        match self {
            Self::Alone(_) => 0,
            Self::List(list) => size_of_val(list.as_slice()),
        }
    }

    pub(crate) fn as_slice(&self) -> &[Touch<N>] {
        self
    }

    pub(crate) fn clear(&mut self) {
        self.replace(std::iter::empty());
    }

    /// Puts others in their place.
    pub(crate) fn replace(&mut self, touches: impl ExactSizeIterator<Item = Touch<N>>) {
        match self {
            Self::Alone(alone) if touches.len() == 1 => touches.for_each(|touch| *alone = touch),
            Self::Alone(_) => *self = Self::List(touches.collect()),
            Self::List(list) => {
                list.clear();
                list.extend(touches);
            }
        }
    }
}

impl<const N: usize> Deref for Touches<N> {
    type Target = [Touch<N>];

    #[inline]
    fn deref(&self) -> &[Touch<N>] {
        match self {
            Self::Alone(touch) => std::slice::from_ref(touch),
            Self::List(list) => list,
        }
    }
}

impl<const N: usize> DerefMut for Touches<N> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [Touch<N>] {
        match self {
            Self::Alone(touch) => std::slice::from_mut(touch),
            Self::List(list) => list,
        }
    }
}
