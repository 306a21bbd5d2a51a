//! What a player does to a world, and how often it did.

/// Everything that a player may do, with how often out of a hundred.
macro_rules! operations {
    ($($name:ident $words:literal $weight:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Operation { $($name),* }

        pub(crate) const OPERATIONS: &[(Operation, &str, usize)] = &[$((Operation::$name, $words, $weight)),*];
    };
}

operations! {
    AddBody "bodies added" 13;
    RemoveBody "bodies removed" 7;
    AddJoint "joints added" 10;
    ChangeJoint "joints changed" 3;
    RemoveJoint "joints removed" 4;
    Teleport "bodies teleported" 4;
    Push "bodies pushed" 6;
    Lead "platforms led" 2;
    Wake "bodies woken" 2;
    ChangeShape "shapes changed" 4;
    ChangeBody "kinds of bodies changed" 3;
    Filter "filters changed" 3;
    Gravity "gravity changed" 1;
    Save "snapshots taken" 2;
    SaveBytes "snapshots through bytes" 1;
    Load "snapshots restored" 2;
    GoBack "roll-backs" 2;
    Step "steps" 31;
}

/// Counts over one or more worlds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// By operation: done, and refused as they had to be.
    pub(crate) done: [(u64, u64); OPERATIONS.len()],
    /// Calls with handles of what is gone, and how many of them were refused as stale.
    pub(crate) stale_tried: u64,
    pub(crate) stale_refused: u64,
    /// Pairs left when all bodies had been removed.
    pub(crate) pairs_leaked: u64,
    /// Most bodies, joints and pairs at once.
    pub(crate) most: [usize; 3],
    /// Bodies that ended in quarantine. Mechanisms of joints that contradict each other, made anyhow and changed for hours, throw some of
    /// them so far that no number is left; that is told and harms nothing else.
    pub(crate) quarantined: u64,
    /// Seeds whose world was not what it had to be.
    pub(crate) panics: Vec<usize>,
}

impl Tally {
    pub(crate) fn count(&mut self, operation: Operation, done: bool) {
        let (taken, refused) = &mut self.done[operation as usize];
        *if done { taken } else { refused } += 1;
    }

    pub(crate) fn add(&mut self, other: &Self) {
        for (sum, more) in self.done.iter_mut().zip(&other.done) {
            *sum = (sum.0 + more.0, sum.1 + more.1);
        }
        self.stale_tried += other.stale_tried;
        self.stale_refused += other.stale_refused;
        self.pairs_leaked += other.pairs_leaked;
        self.quarantined += other.quarantined;
        self.panics.extend(&other.panics);
        self.most = std::array::from_fn(|k| self.most[k].max(other.most[k]));
    }

    /// Whether nothing leaked or panicked, and no handle of what is gone was taken.
    pub(crate) fn is_clean(&self) -> bool {
        self.panics.is_empty()
            && self.pairs_leaked == 0
            && self.stale_tried == self.stale_refused
            && self.stale_tried > 0
    }
}
