//! What a step solves: bodies that move, and contacts that can do something to them, taken from the world in a fixed order.

use std::ops::Range;

use hyperbody_math::Vector;

use super::bodies::{Sizes, SolverBody};
use super::colours::{ActiveContact, Colours};
use super::division::Division;
use super::gyro::Gyro;
use super::joints::Tension;
use super::{Damped, Solver, SolverInput};
use crate::BodyKind;
use crate::ahead::fetch;
use crate::body::Body;
use crate::handle::Slot;
use crate::pairs::{Contact, Meeting, Pairs};
use crate::threads::{Pool, both};
use crate::vetting::shortened;

/// Pairs that are asked for before their turn comes; see [`crate::ahead`].
const AHEAD: usize = 12;

/// Where a body is in the solver, and what its contacts ask about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    /// Of the solver's bodies.
    row: u32,
    moves: bool,
    is_ball: bool,
}

/// A contact that is away from its pair while it is solved: so several threads may write to contacts, wherever their pairs are.
#[derive(Debug)]
pub(super) struct Taken<const N: usize> {
    /// Its slot.
    pair: u32,
    meeting: Meeting,
    contact: Option<Box<Contact<N>>>,
}

/// What collecting the bodies of a part finds beside their rows, ascending by row.
#[derive(Debug)]
pub(super) struct Collected<const N: usize> {
    gyros: Vec<Gyro<N>>,
    damped: Vec<Damped>,
}

/// What collecting bodies reads.
struct Collect<'a, const N: usize> {
    tension: &'a Tension,
    gravity: Vector<N>,
    /// Speed that a body may gain in a second, m/s.
    steepest: f64,
    dt: f64,
    /// Length of a substep, s.
    h: f64,
}

/// The bodies of consecutive parts.
struct Bodies<'a, const N: usize> {
    parts: Range<usize>,
    slots: &'a mut [Slot<Body<N>>],
    seats: &'a mut [Option<Seat>],
    rows: &'a mut [SolverBody<N>],
    collected: &'a mut [Collected<N>],
}

impl<const N: usize> Solver<N> {
    pub(super) fn collect_bodies(&mut self, input: &mut SolverInput<'_, N>, h: f64) {
        let slots = input.bodies.slots.as_mut_slice();
        self.tension.find(input.joints, slots.len(), h);
        self.division.divide(slots.len());
        self.collected.resize_with(self.division.count(), || Collected { gyros: Vec::new(), damped: Vec::new() });
        self.seats.clear();
        self.seats.resize(slots.len(), None);
        let seats = self.seats.as_mut_slice();
        let steepest = input.tuning.max_speed / input.dt;
        let collect = Collect { tension: &self.tension, gravity: input.gravity, steepest, dt: input.dt, h };
        if let [collected] = self.collected.as_mut_slice() {
            let bodies = &mut self.bodies;
            bodies.clear();
            collect.part((0, slots, seats), 0, collected, |body| bodies.push(body));
            self.division.note_rows(bodies.len());
        } else {
            self.counts.resize(self.division.count(), 0);
            count_rows(slots, self.division.share(), &mut self.counts, input.pool);
            let mut rows = 0;
            for count in &self.counts {
                rows += count;
                self.division.note_rows(rows);
            }
            // Settled worlds have as many in every step.
            self.bodies.resize(rows, SolverBody::RESTING);
            let parts = 0..self.division.count();
            let all = Bodies { parts, slots, seats, rows: &mut self.bodies, collected: &mut self.collected };
            collect.parts(&self.division, all, input.pool);
        }
        self.gyros.clear();
        self.damped.clear();
        if let [Collected { gyros, damped }] = self.collected.as_mut_slice() {
            std::mem::swap(&mut self.gyros, gyros);
            std::mem::swap(&mut self.damped, damped);
        } else {
            for Collected { gyros, damped } in &mut self.collected {
                self.gyros.append(gyros);
                self.damped.append(damped);
            }
        }
        self.state.clear();
        self.state.resize(self.bodies.len() * Sizes::<N>::STATE, 0.0);
    }

    /// Takes the contacts of pairs with points and at least one body that impulses move, part after part, in the order of their
    /// slots.
    pub(super) fn collect_contacts(&mut self, pairs: &mut Pairs<N>, pool: Option<&Pool>) {
        self.active.clear();
        self.taken.clear();
        let Pairs { slots, contacts, .. } = pairs;
        for (index, &slot) in contacts.iter().enumerate() {
            if let Some(&coming) = contacts.get(index + AHEAD) {
                fetch(&slots[coming as usize], usize::MAX);
            }
            let Some(pair) = slots[slot as usize].as_mut().filter(|pair| pair.points > 0) else { continue };
            let seats = (self.seats[pair.body_a as usize], self.seats[pair.body_b as usize]);
            let (Some(a), Some(b)) = seats else { continue };
            let moves = [a.moves, b.moves];
            if moves == [false; 2] {
                continue;
            }
            let Some(contact) = pair.contact.take() else { continue };
            #[expect(clippy::cast_possible_truncation, reason = "no more contacts than slots of pairs")]
            self.active.push(ActiveContact {
                taken: self.taken.len() as u32,
                body_a: a.row,
                body_b: b.row,
                moves,
                surface: pair.surface(),
                points: pair.points,
                round: pair.points == 1 && !pair.resists && (a.is_ball || !a.moves) && (b.is_ball || !b.moves),
            });
            self.taken.push(Taken { pair: slot, meeting: Meeting::Apart, contact: Some(contact) });
            // What does not move belongs nowhere.
            let slots = match moves {
                [true, true] => [pair.body_a, pair.body_b],
                [true, false] => [pair.body_a; 2],
                [false, _] => [pair.body_b; 2],
            };
            self.division.note_contact(slots);
        }
        self.division.sort_contacts(&mut self.active);
        self.colours.resize_with(self.division.len(), Colours::default);
        Colours::assign(&mut self.colours, 0, &self.active, &self.division, pool);
        self.contacts.allocate(&self.colours, &self.active, &mut self.division);
        for (block, held) in self.contacts.blocks.iter().zip(&mut self.contacts.held) {
            for (contact, &index) in held.contacts.iter_mut().zip(&block.contacts) {
                // No index is that of an empty lane.
                *contact =
                    self.active.get(index as usize).and_then(|active| self.taken[active.taken as usize].contact.take());
            }
        }
    }

    /// The other way round.
    pub(super) fn give_back_contacts(&mut self, pairs: &mut Pairs<N>) {
        for (block, held) in self.contacts.blocks.iter().zip(&mut self.contacts.held) {
            for ((contact, &meeting), &index) in held.contacts.iter_mut().zip(&held.meetings).zip(&block.contacts) {
                if let Some(active) = self.active.get(index as usize) {
                    let taken = &mut self.taken[active.taken as usize];
                    (taken.contact, taken.meeting) = (contact.take(), meeting);
                }
            }
        }
        for index in 0..self.taken.len() {
            if let Some(coming) = self.taken.get(index + AHEAD) {
                fetch(&pairs.slots()[coming.pair as usize], usize::MAX);
            }
            let Taken { pair, meeting, contact } = &mut self.taken[index];
            let (meeting, contact) = (*meeting, contact.take());
            if let Some(pair) = pairs.get_mut(*pair) {
                (pair.contact, pair.meeting) = (contact, meeting);
            }
        }
    }
}

/// Counts the rows of consecutive parts, of which each has so many slots.
fn count_rows<const N: usize>(slots: &[Slot<Body<N>>], share: usize, counts: &mut [usize], pool: Option<&Pool>) {
    if let [count] = counts {
        *count = 1 + slots.iter().filter_map(|slot| slot.value.as_ref()).filter(|body| has_row(body)).count();
        return;
    }
    let (left, right) = counts.split_at_mut(counts.len() / 2);
    let (of_left, of_right) = slots.split_at((left.len() * share).min(slots.len()));
    both(pool, || count_rows(of_left, share, left, pool), || count_rows(of_right, share, right, pool));
}

/// Whether the solver asks for more of a body than that nothing moves it.
fn has_row<const N: usize>(body: &Body<N>) -> bool {
    let runs = || body.surface_velocity != Vector::ZERO && body.kind == BodyKind::Static;
    body.is_moving() || (body.kind == BodyKind::Kinematic || runs()) && !body.quarantined
}

impl<const N: usize> Collect<'_, N> {
    /// The bodies of some parts, halves of them at the same time where there are threads.
    fn parts(&self, division: &Division, all: Bodies<'_, N>, pool: Option<&Pool>) {
        let Bodies { parts: range, slots, seats, rows, collected } = all;
        let first_row = division.first_row(range.start);
        if let [collected] = collected {
            let mut rows = rows.iter_mut();
            let first_slot = range.start * division.share();
            return self.part((first_slot, slots, seats), first_row, collected, |body| {
                rows.next().into_iter().for_each(|row| *row = body);
            });
        }
        let middle = range.start + range.len() / 2;
        let middle_slot = ((middle - range.start) * division.share()).min(slots.len());
        let (left_slots, right_slots) = slots.split_at_mut(middle_slot);
        let (left_seats, right_seats) = seats.split_at_mut(middle_slot);
        let (left_rows, right_rows) = rows.split_at_mut(division.first_row(middle) - first_row);
        let (left_found, right_found) = collected.split_at_mut(middle - range.start);
        let (first, second) = (range.start..middle, middle..range.end);
        let left =
            Bodies { parts: first, slots: left_slots, seats: left_seats, rows: left_rows, collected: left_found };
        let right =
            Bodies { parts: second, slots: right_slots, seats: right_seats, rows: right_rows, collected: right_found };
        both(pool, || self.parts(division, left, pool), || self.parts(division, right, pool));
    }

    /// The bodies in consecutive slots, in that order; their rows start with `first_row`.
    fn part(
        &self,
        (first_slot, slots, seats): (usize, &mut [Slot<Body<N>>], &mut [Option<Seat>]),
        first_row: usize,
        collected: &mut Collected<N>,
        mut put: impl FnMut(SolverBody<N>),
    ) {
        // The first row belongs to no one: whoever is not moved by impulses points at it.
        put(SolverBody::RESTING);
        let mut row = first_row;
        for (index, (slot, seat)) in slots.iter_mut().zip(seats).enumerate() {
            let Some(body) = &mut slot.value else { continue };
            body.solver_index = 0;
            if !has_row(body) {
                *seat = Some(Seat { row: 0, moves: false, is_ball: body.is_ball });
                continue;
            }
            row += 1;
            #[expect(clippy::cast_possible_truncation, reason = "slots are counted in u32")]
            let slot = (first_slot + index) as u32;
            #[expect(clippy::cast_possible_truncation, reason = "no more rows than slots and parts")]
            let row_number = row as u32;
            body.solver_index = row_number;
            *seat = Some(Seat { row: row_number, moves: body.is_moving(), is_ball: body.is_ball });
            if !body.is_moving() {
                put(SolverBody::immovable(body));
                continue;
            }
            let added_moment = self.tension.added(slot, body.inertia.smallest_plane_moment());
            let mut solved = SolverBody::dynamic(slot, body, self.gravity, added_moment);
            solved.acceleration = shortened(solved.acceleration, self.steepest);
            if let Some(frame) = solved.frame {
                let moments = body.inertia.moments;
                collected.gyros.push(Gyro::new(row, frame, moments, body, added_moment, self.dt));
            }
            put(solved);
            if body.linear_damping > 0.0 || body.angular_damping > 0.0 {
                let factor = |rate: f64| 1.0 / (1.0 + self.h * rate);
                let (linear, angular) = (factor(body.linear_damping), factor(body.angular_damping));
                collected.damped.push(Damped { body: row, linear, angular });
            }
        }
    }
}
