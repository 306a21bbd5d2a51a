//! Handles that notice when what they named is gone, and the storage behind them.
//!
//! A slot that is freed raises its generation, so that an old handle no longer fits. Freed slots are used again in
//! the order last freed, first used, which depends on the calls alone.

use std::marker::PhantomData;

/// Names a body of one world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyHandle {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

/// Names a joint of one world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointHandle {
    pub(crate) index: u32,
    pub(crate) generation: u32,
}

/// What an [`Arena`] is addressed by.
pub(crate) trait Handle: Copy {
    fn new(index: u32, generation: u32) -> Self;
    fn parts(self) -> (u32, u32);
}

impl Handle for BodyHandle {
    fn new(index: u32, generation: u32) -> Self {
        Self { index, generation }
    }
    fn parts(self) -> (u32, u32) {
        (self.index, self.generation)
    }
}

impl Handle for JointHandle {
    fn new(index: u32, generation: u32) -> Self {
        Self { index, generation }
    }
    fn parts(self) -> (u32, u32) {
        (self.index, self.generation)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Slot<T> {
    pub(crate) generation: u32,
    pub(crate) value: Option<T>,
}

/// Values in numbered slots, addressed by generational handles.
#[derive(Clone, Debug)]
pub(crate) struct Arena<T, H> {
    pub(crate) slots: Vec<Slot<T>>,
    pub(crate) free: Vec<u32>,
    handle: PhantomData<H>,
}

impl<T, H: Handle> Arena<T, H> {
    pub(crate) const fn new() -> Self {
        Self { slots: Vec::new(), free: Vec::new(), handle: PhantomData }
    }

    /// Stores `value`, or gives it back if 2³² − 1 slots are taken.
    pub(crate) fn insert(&mut self, value: T) -> Result<H, T> {
        if let Some(index) = self.free.pop() {
            let slot = &mut self.slots[index as usize];
            slot.value = Some(value);
            return Ok(H::new(index, slot.generation));
        }
        let Ok(index) = u32::try_from(self.slots.len()) else { return Err(value) };
        if index == u32::MAX {
            return Err(value);
        }
        self.slots.push(Slot { generation: 0, value: Some(value) });
        Ok(H::new(index, 0))
    }

    pub(crate) fn remove(&mut self, handle: H) -> Option<T> {
        let (index, generation) = handle.parts();
        let slot = self.slots.get_mut(index as usize)?;
        if slot.generation != generation {
            return None;
        }
        let value = slot.value.take()?;
        slot.generation = slot.generation.wrapping_add(1);
        self.free.push(index);
        Some(value)
    }

    pub(crate) fn get(&self, handle: H) -> Option<&T> {
        let (index, generation) = handle.parts();
        let slot = self.slots.get(index as usize)?;
        (slot.generation == generation).then_some(slot.value.as_ref()).flatten()
    }

    pub(crate) fn get_mut(&mut self, handle: H) -> Option<&mut T> {
        let (index, generation) = handle.parts();
        let slot = self.slots.get_mut(index as usize)?;
        (slot.generation == generation).then_some(slot.value.as_mut()).flatten()
    }

    /// The value in slot `index`, whatever its generation.
    pub(crate) fn at(&self, index: u32) -> Option<&T> {
        self.slots.get(index as usize)?.value.as_ref()
    }

    /// The value in slot `index`, whatever its generation.
    pub(crate) fn at_mut(&mut self, index: u32) -> Option<&mut T> {
        self.slots.get_mut(index as usize)?.value.as_mut()
    }

    pub(crate) fn handle_at(&self, index: u32) -> Option<H> {
        let slot = self.slots.get(index as usize)?;
        slot.value.is_some().then(|| H::new(index, slot.generation))
    }

    /// Number of slots, taken or free.
    pub(crate) fn slot_count(&self) -> usize {
        self.slots.len()
    }

    pub(crate) fn len(&self) -> usize {
        self.slots.len() - self.free.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (H, &T)> {
        self.slots.iter().enumerate().filter_map(|(index, slot)| {
            #[expect(clippy::cast_possible_truncation, reason = "insert keeps indices below 2³²")]
            slot.value.as_ref().map(|value| (H::new(index as u32, slot.generation), value))
        })
    }

    pub(crate) fn values(&self) -> impl Iterator<Item = &T> {
        self.slots.iter().filter_map(|slot| slot.value.as_ref())
    }

    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.slots.iter_mut().filter_map(|slot| slot.value.as_mut())
    }
}
