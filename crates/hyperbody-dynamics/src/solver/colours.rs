//! Which contacts may be solved side by side: those that share no moving body.
//!
//! Contacts are coloured greedily in their fixed order so that no two of one colour share a body; within a colour the
//! order does not matter, so the result depends neither on the width of vectors nor on threads. Contacts with the
//! immovable come in colours of their own, after the others: the last word is theirs, and nothing sinks into the ground
//! (after E. Catto, Box2D v3, 2024). What 64 colours don't hold is solved one by one.

use std::ops::Range;

use hyperbody_collision::MAX_POINTS;

use super::division::Division;
use super::lanes::WIDTH;
use crate::counting::Counting;
use crate::pairs::Surface;
use crate::threads::{Pool, both};

/// A contact to be solved: rows of its bodies, and what choosing its place asks of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ActiveContact {
    /// Its number in the order of pairs.
    pub(crate) taken: u32,
    /// Rows of the solver's bodies.
    pub(crate) body_a: u32,
    pub(crate) body_b: u32,
    /// Whether impulses move them.
    pub(crate) moves: [bool; 2],
    pub(crate) surface: Surface,
    pub(crate) points: u8,
    /// Whether it is one of balls, which have rows of their own.
    pub(crate) round: bool,
}

impl ActiveContact {
    /// Rows of the solver's state, from `first` on; that one, which stays zero, for a body that no impulse moves.
    pub(crate) fn state_rows(&self, first: u32) -> [u32; 2] {
        let row = |body: u32, moves: bool| if moves { body - first } else { 0 };
        [row(self.body_a, self.moves[0]), row(self.body_b, self.moves[1])]
    }

    /// Contacts of one class are solved side by side: those with as many points, and those of balls.
    fn class(&self) -> usize {
        if self.round { 0 } else { usize::from(self.points) }
    }
}

/// Contacts that are solved side by side; unused lanes hold [`Group::EMPTY`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    /// Indices of active contacts.
    pub(crate) contacts: [u32; WIDTH],
}

impl Group {
    pub(crate) const EMPTY: u32 = u32::MAX;
}

const COLOURS: usize = 64;

/// Contacts of a step up to which it matters how full the last group of a colour is.
const FEW: usize = 512;

/// Where a contact stands in the order of solving: by colour, then by class, most points first, so that few lanes idle.
#[derive(Clone, Copy, Debug)]
struct Place(u16);

impl Place {
    const CLASSES: usize = MAX_POINTS + 1;
    const COUNT: usize = (COLOURS + 1) * Self::CLASSES;

    /// Of colour [`COLOURS`] is what no colour holds.
    fn new(colour: usize, contact: &ActiveContact) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "below COUNT")]
        Self((colour * Self::CLASSES + MAX_POINTS - contact.class()) as u16)
    }

    fn colour(self) -> usize {
        usize::from(self.0) / Self::CLASSES
    }

    fn is_round(self) -> bool {
        usize::from(self.0) % Self::CLASSES == MAX_POINTS
    }
}

/// Buffers of the colouring, kept from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Colours {
    used: Vec<u64>,
    /// By contact.
    places: Vec<Place>,
    order: Vec<u32>,
    counting: Counting,
    /// Contacts that leave the last group of their colour half empty.
    rest: Vec<u32>,
    /// Groups in the order of solving.
    pub(crate) groups: Vec<Group>,
    /// After how many groups each colour ends. What no colour holds counts as one of its own.
    pub(crate) ends: Vec<usize>,
}

impl Colours {
    /// Groups the contacts of consecutive parts and cuts, some at the same time where there are threads. `contacts` are those of
    /// all, and `first` is the number of the first part.
    pub(crate) fn assign(
        colours: &mut [Self],
        first: usize,
        contacts: &[ActiveContact],
        division: &Division,
        pool: Option<&Pool>,
    ) {
        if let [colours] = colours {
            let range = division.contacts(first);
            colours.assign_part(&contacts[range.clone()], division.rows(first));
            return colours.pack(range.start);
        }
        let middle = colours.len() / 2;
        let (one, other) = colours.split_at_mut(middle);
        both(
            pool,
            || Self::assign(one, first, contacts, division, pool),
            || Self::assign(other, first + middle, contacts, division, pool),
        );
    }

    /// Chooses the places of contacts of bodies in these rows.
    fn assign_part(&mut self, contacts: &[ActiveContact], rows: Range<usize>) {
        self.used.clear();
        self.used.resize(rows.len(), 0);
        self.places.clear();
        self.places.extend(contacts.iter().map(|contact| Place::new(COLOURS, contact)));
        #[expect(clippy::cast_possible_truncation, reason = "bodies are counted in u32")]
        let first_row = rows.start as u32;
        let first_static = self.colour(contacts, true, 0, first_row);
        let first_static = self.join_rests(contacts, 0, first_static, first_row);
        let end = self.colour(contacts, false, first_static, first_row);
        self.join_rests(contacts, first_static, end, first_row);
        let places = &self.places;
        self.order.clear();
        #[expect(clippy::cast_possible_truncation, reason = "fewer contacts than fit into memory")]
        self.order.extend(0..contacts.len() as u32);
        self.counting.sort(&mut self.order, Place::COUNT, |contact| usize::from(places[contact as usize].0));
    }

    /// Colours the contacts whose bodies both move (`both` true) or only one does; returns the colour after the last.
    fn colour(&mut self, contacts: &[ActiveContact], both: bool, first: usize, first_row: u32) -> usize {
        let mut next = first;
        for (index, contact) in contacts.iter().enumerate() {
            let [a, b] = contact.moves;
            if (a && b) != both {
                continue;
            }
            let mut taken = (1_u64 << first) - 1;
            let [row_a, row_b] = contact.state_rows(first_row).map(|row| row as usize);
            if a {
                taken |= self.used[row_a];
            }
            if b {
                taken |= self.used[row_b];
            }
            let colour = taken.trailing_ones() as usize;
            if colour + 1 >= COLOURS {
                continue;
            }
            if a {
                self.used[row_a] |= 1 << colour;
            }
            if b {
                self.used[row_b] |= 1 << colour;
            }
            self.places[index] = Place::new(colour, contact);
            next = next.max(colour + 1);
        }
        next.min(COLOURS - 2)
    }

    /// Of each colour from `first` to before `end`, what does not fill a group is put into new colours after them, if that makes
    /// fewer groups: a half-empty one takes as long as a full one. Returns the colour after the last.
    fn join_rests(&mut self, contacts: &[ActiveContact], first: usize, end: usize, first_row: u32) -> usize {
        if contacts.len() > FEW || end < first + 2 || end + 2 >= COLOURS {
            return end;
        }
        let mut left = [0; COLOURS];
        for place in self.places.iter().filter(|place| (first..end).contains(&place.colour())) {
            left[place.colour()] += 1;
        }
        left.iter_mut().for_each(|count| *count %= WIDTH);
        let half_empty = left.iter().filter(|&&count| count > 0).count();
        // The last of one colour and the first of the next: neighbours seldom share a body.
        self.rest.clear();
        let mut take = |index: usize, colour: usize, even: bool| {
            if (first..end).contains(&colour) && colour.is_multiple_of(2) == even && left[colour] > 0 {
                left[colour] -= 1;
                #[expect(clippy::cast_possible_truncation, reason = "few")]
                self.rest.push(index as u32);
            }
        };
        let colours = self.places.iter().map(|place| place.colour()).enumerate();
        colours.clone().rev().for_each(|(index, colour)| take(index, colour, true));
        colours.for_each(|(index, colour)| take(index, colour, false));
        self.rest.sort_unstable();
        let mut counts = [0; COLOURS];
        let mut chosen = [COLOURS; COLOURS * WIDTH];
        for (&index, chosen) in self.rest.iter().zip(&mut chosen) {
            let rows = contacts[index as usize].state_rows(first_row).map(|row| row as usize);
            let taken = rows.iter().fold((1_u64 << end) - 1, |taken, &row| taken | self.used[row]);
            let colour = taken.trailing_ones() as usize;
            if colour + 1 < COLOURS {
                rows.iter().filter(|&&row| row != 0).for_each(|&row| self.used[row] |= 1 << colour);
                counts[colour] += 1;
                *chosen = colour;
            }
        }
        let joined: usize = counts.iter().map(|count: &usize| count.div_ceil(WIDTH)).sum();
        let all = !chosen[..self.rest.len()].contains(&COLOURS);
        if all && joined < half_empty {
            for (&index, colour) in self.rest.iter().zip(chosen) {
                self.places[index as usize] = Place::new(colour, &contacts[index as usize]);
            }
            return counts.iter().rposition(|&count| count > 0).map_or(end, |last| last + 1);
        }
        for &index in &self.rest {
            for row in contacts[index as usize].state_rows(first_row) {
                self.used[row as usize] &= (1 << end) - 1;
            }
        }
        end
    }

    /// Makes groups of the contacts in order; the first of them all is `first`.
    fn pack(&mut self, first: usize) {
        #[expect(clippy::cast_possible_truncation, reason = "fewer contacts than fit into memory")]
        let first = first as u32;
        self.groups.clear();
        self.ends.clear();
        let mut lane = WIDTH;
        let mut current = (COLOURS, false);
        for &contact in &self.order {
            let place = self.places[contact as usize];
            let kind = (place.colour(), place.is_round());
            if lane == WIDTH || kind != current || kind.0 == COLOURS {
                if !self.groups.is_empty() && (kind.0 != current.0 || kind.0 == COLOURS) {
                    self.ends.push(self.groups.len());
                }
                self.groups.push(Group { contacts: [Group::EMPTY; WIDTH] });
                lane = 0;
                current = kind;
            }
            if let Some(group) = self.groups.last_mut() {
                group.contacts[lane] = contact + first;
            }
            lane += 1;
        }
        if !self.groups.is_empty() {
            self.ends.push(self.groups.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(body_a: u32, body_b: u32) -> ActiveContact {
        let surface = Surface { bounces: false, resists: false };
        let moves = [body_a != 0, body_b != 0];
        ActiveContact { taken: 0, body_a, body_b, moves, surface, points: 4, round: false }
    }

    /// Groups, after checking that each contact is in one and that no colour touches a body twice.
    fn groups(contacts: &[ActiveContact], bodies: usize) -> usize {
        let mut colours = Colours::default();
        colours.assign_part(contacts, 0..bodies);
        colours.pack(0);
        let mut seen = vec![0; contacts.len()];
        let mut first = 0;
        for &end in &colours.ends {
            let mut touched = vec![false; bodies];
            let members = colours.groups[first..end].iter().flat_map(|group| group.contacts);
            for index in members.filter(|&index| index != Group::EMPTY) {
                seen[index as usize] += 1;
                for row in
                    contacts[index as usize].state_rows(0).map(|row| row as usize).into_iter().filter(|&row| row != 0)
                {
                    assert!(!touched[row], "body {row} twice in one colour");
                    touched[row] = true;
                }
            }
            first = end;
        }
        assert_eq!(seen, vec![1; contacts.len()]);
        colours.groups.len()
    }

    #[test]
    fn a_tower_takes_a_group_less_than_its_colours_would() {
        let tower: Vec<_> = (0..20).map(|body| contact(body, body + 1)).collect();
        assert_eq!(groups(&tower, 21), 4);
    }

    #[test]
    fn every_contact_is_solved_once_and_no_colour_touches_a_body_twice() {
        let mut state = 11_u64;
        let mut random = |below: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32 % below
        };
        for bodies in [2, 5, 30, 200] {
            for count in [1, 8, 40, 300, 700] {
                let contacts: Vec<_> = (0..count)
                    .map(|_| {
                        let a = 1 + random(bodies);
                        let b = random(bodies + 1);
                        contact(a, if a == b { 0 } else { b })
                    })
                    .collect();
                groups(&contacts, bodies as usize + 1);
            }
        }
    }
}
