//! Which joints have something to do in a step, and how they hang together.

use super::cluster::Link;
use super::nets::is_even;
use crate::body::Body;
use crate::joint::{Joint, WORLD};
use crate::solver::SolverInput;
use crate::solver::bodies::SolverBody;

/// The joints of a step, and buffers kept from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Members {
    /// Their slots in the world.
    pub(super) slots: Vec<u32>,
    /// Those that have rows, as the plan sees them.
    pub(super) links: Vec<Link>,
    /// By number of a body in the links: its row of the solver; the first stands for what impulses do not move.
    pub(super) rows: Vec<u32>,
    /// The other way round; 0 for what has no number yet.
    numbers: Vec<u32>,
}

impl Members {
    /// Takes the joints of the world that have something to do.
    pub(super) fn find<const N: usize>(&mut self, input: &SolverInput<'_, N>, bodies: &[SolverBody<N>]) {
        self.slots.clear();
        self.links.clear();
        self.rows.clear();
        self.rows.push(0);
        self.numbers.clear();
        self.numbers.resize(bodies.len(), 0);
        for (handle, joint) in input.joints.iter() {
            let a = input.bodies.at(joint.body_a);
            let Some(b) = input.bodies.at(joint.body_b) else { continue };
            let quarantined = b.quarantined || a.is_some_and(|a| a.quarantined);
            let moves = b.is_moving() || a.is_some_and(Body::is_moving);
            if quarantined || !moves || (a.is_none() && joint.body_a != WORLD) {
                continue;
            }
            if !joint.rows.is_empty() {
                self.link(joint, [a.map_or(0, |a| a.solver_index), b.solver_index], bodies);
            }
            self.slots.push(handle.index);
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "joints and bodies are counted in u32")]
    fn link<const N: usize>(&mut self, joint: &Joint<N>, rows: [u32; 2], bodies: &[SolverBody<N>]) {
        let even = rows.iter().all(|&row| is_even(&bodies[row as usize]));
        let mut number = |row: u32| {
            if bodies[row as usize].inverse_sqrt_mass == 0.0 {
                return 0;
            }
            let number = &mut self.numbers[row as usize];
            if *number == 0 {
                *number = self.rows.len() as u32;
                self.rows.push(row);
            }
            *number
        };
        self.links.push(Link {
            joint: self.slots.len() as u32,
            apart: joint.def.softness.is_some(),
            bounded: joint.rows.len() > joint.held,
            plain: even && joint.plain,
            bodies: rows.map(&mut number),
            rows: joint.rows.len() as u32,
        });
    }
}
