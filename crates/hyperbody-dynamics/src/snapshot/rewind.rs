//! The last steps of a world, to go back by as many as one likes: rollback of network games, undo, "what if" of planners.
//!
//! One snapshot a step, in a ring that is bounded twice, by a number of steps and by memory: the oldest moments go when either
//! is full. Whole snapshots were chosen over differences: nearly every number of an awake world changes in every step, so
//! differences would be as large, and going back would have to undo them one by one. Worlds that step from the same state
//! do the same to the bit, so who goes back and applies the same changes arrives at the same place.

use std::collections::VecDeque;

use hyperbody_geometry::Shape;

use crate::pairs::Pair;
use crate::{Snapshot, World, WorldError, WorldErrorKind};

/// The past of one world: [`record`](Rewind::record) each step before taking it, and go [`back`](Rewind::back).
///
/// ```
/// use hyperbody_dynamics::{BodyDef, Rewind, World, WorldDef};
/// use hyperbody_geometry::Shape;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut world = World::<4>::new(WorldDef::default())?;
/// let body = world.add_body(BodyDef::new(Shape::cuboid([0.5; 4])?))?;
///
/// // Two seconds of the past, in at most 16 MiB.
/// let mut past = Rewind::new(120, 16 << 20);
/// for _ in 0..60 {
///     past.record(&world)?;
///     world.step();
/// }
/// let there = world.state_hash();
///
/// // A push that came too late: eight steps back, apply it, and go through the steps again.
/// past.back(&mut world, 8)?;
/// assert_eq!(world.step_count(), 52);
/// world.body_mut(body).ok_or("it is there")?.apply_impulse([0.0, 0.0, 0.0, 2.0])?;
/// for _ in 0..8 {
///     past.record(&world)?;
///     world.step();
/// }
/// assert_ne!(world.state_hash(), there);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Rewind<const N: usize> {
    /// Ascending in their steps, each with the memory that it takes.
    moments: VecDeque<(usize, Snapshot<N>)>,
    most_steps: usize,
    most_bytes: usize,
    bytes: usize,
}

impl<const N: usize> Rewind<N> {
    /// Holds nothing yet, and at most `steps` moments in `bytes` bytes of memory, polytopes and products not counted, which worlds
    /// share with their past as long as a body of that shape is in either. In 4D a body takes about 2 kB, and a touch 3 kB.
    #[must_use]
    pub fn new(steps: usize, bytes: usize) -> Self {
        Self { moments: VecDeque::new(), most_steps: steps, most_bytes: bytes, bytes: 0 }
    }

    /// Keeps the world as it is now, before its next step, and gives up the oldest moments if there is no more room. What it held of
    /// this step and of later ones is replaced: after going back there is another future.
    ///
    /// # Errors
    /// If this one moment takes more memory than the whole past may, or the past may hold no step. Then nothing is kept of it.
    pub fn record(&mut self, world: &World<N>) -> Result<(), WorldError> {
        self.forget_from(world.step_count());
        let bytes = world.memory_of_state();
        if bytes > self.most_bytes || self.most_steps == 0 {
            return Err(WorldError::new(
                WorldErrorKind::Full,
                format!(
                    "one moment of this world takes {bytes} bytes; the past may hold {} steps in {} bytes: allow more",
                    self.most_steps, self.most_bytes
                ),
            ));
        }
        // Room first, so that the bound holds while the world is copied.
        while self.bytes + bytes > self.most_bytes || self.moments.len() >= self.most_steps {
            let Some((freed, _)) = self.moments.pop_front() else { break };
            self.bytes -= freed;
        }
        self.moments.push_back((bytes, world.snapshot()));
        self.bytes += bytes;
        Ok(())
    }

    /// Takes the world back by `steps` steps, to the bit: to where it was when the step that is taken back first was recorded.
    /// Going back by 0 steps undoes what was changed since the last record, if that was of this step. Handles are
    /// good again as they were then, and what was held of later steps is forgotten. Handles that were given out after that moment are
    /// to be dropped: what is added next may get the same ones.
    ///
    /// # Errors
    /// If that moment is not held (never recorded, or given up for newer ones). The world stays as it is.
    pub fn back(&mut self, world: &mut World<N>, steps: u64) -> Result<(), WorldError> {
        let here = world.step_count();
        let held = here.checked_sub(steps).and_then(|step| self.position(step));
        let Some(at) = held else { return Err(self.not_held(here, steps)) };
        world.restore(&self.moments[at].1);
        self.forget_from(world.step_count() + 1);
        Ok(())
    }

    /// The earliest and the latest step that it can go back to, counted as by [`World::step_count`]; `None` if it holds nothing.
    #[must_use]
    pub fn steps(&self) -> Option<(u64, u64)> {
        Some((self.moments.front()?.1.step_count(), self.moments.back()?.1.step_count()))
    }

    /// Number of moments held.
    #[must_use]
    pub fn len(&self) -> usize {
        self.moments.len()
    }

    /// Whether it holds nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.moments.is_empty()
    }

    /// Memory that the moments take, bytes, shapes not counted.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.bytes
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.moments.clear();
        self.bytes = 0;
    }

    fn position(&self, step: u64) -> Option<usize> {
        self.moments.binary_search_by_key(&step, |(_, moment)| moment.step_count()).ok()
    }

    fn forget_from(&mut self, step: u64) {
        while let Some(&(bytes, ref moment)) = self.moments.back()
            && moment.step_count() >= step
        {
            self.bytes -= bytes;
            self.moments.pop_back();
        }
    }

    fn not_held(&self, here: u64, steps: u64) -> WorldError {
        let held = match self.steps() {
            None => "holds nothing: record every step before it is taken".to_owned(),
            Some((first, last)) => format!(
                "holds {} of the steps {first} to {last}: record every step, and allow more steps or memory",
                self.moments.len()
            ),
        };
        WorldError::new(
            WorldErrorKind::NotHeld,
            format!("the world is at step {here} and cannot go back by {steps}; the past {held}"),
        )
    }
}

impl<const N: usize> World<N> {
    /// What a snapshot of it takes, bytes, polytopes and products not counted, which are shared. Maps are counted with the nodes of their trees two thirds full.
    fn memory_of_state(&self) -> usize {
        fn of<T>(list: &[T]) -> usize {
            size_of_val(list)
        }
        let bodies = of(&self.bodies.slots)
            + self
                .bodies
                .values()
                .map(|body| of(&body.colliders) + of(&body.joints) + of_shape(&body.shape))
                .sum::<usize>();
        let joints = of(&self.joints.slots)
            + self
                .joints
                .values()
                .map(|joint| of(&joint.rows) + of(&joint.impulses) + of(&joint.def.planes))
                .sum::<usize>();
        let colliders = of(&self.colliders) + of(&self.motions) + self.tree.memory();
        // With a byte beside each place, of which an eighth at least stays empty.
        let in_map = self.pairs.slot_of.capacity() * 8 / 7 * (size_of::<(u64, u32)>() + 1);
        let met = self.pairs.slots.iter().flatten().map(Pair::memory).sum::<usize>();
        let lists = of(&self.pairs.keys) + of(&self.pairs.free) + of(&self.pairs.contacts) + of(&self.pairs.overlaps);
        let pairs = of(&self.pairs.slots) + met + lists + in_map;
        let ignored = self.ignored.0.len() * size_of::<(u32, u32)>() * 3 / 2;
        let (islands, events) = (&self.islands, &self.events);
        let asleep = of(&islands.sleeping) + islands.sleeping.iter().map(|island| of(island)).sum::<usize>();
        let resting = of(&islands.parent) + of(&islands.least_slow_time) + of(&islands.became) + of(&islands.held);
        let (meetings, listed) = (&events.meetings, events.contacts());
        let told = of(listed) + of(&meetings.found) + of(&meetings.order) + of(&meetings.dropped) + of(&meetings.gone);
        let noticed = of(&events.sensors) + of(&events.inside) + of(&events.noticed) + of(&events.broken);
        size_of::<Snapshot<N>>() + bodies + joints + colliders + pairs + ignored + asleep + resting + told + noticed
    }
}

/// What a shape takes beside itself.
fn of_shape<const N: usize>(shape: &Shape<N>) -> usize {
    match shape {
        Shape::Rounded { .. } => size_of::<Shape<N>>(),
        Shape::Compound { parts } => {
            size_of_val(parts.as_slice()) + parts.iter().map(|(_, part)| of_shape(part)).sum::<usize>()
        }
        _ => 0,
    }
}
