//! Frames to bytes and back.
//!
//! A number is stored as its distance from what the last two frames of its body let expect, counted in representable
//! numbers: where a body rests that is zero, where it flies or turns evenly some units of rounding. Positions are expected
//! to go on by the same difference, attitudes by the same rotation, R₁ R₂ᵀ R₁. The distances are sorted by bytes, highest
//! first, and by bodies within them, so that zeros come in long runs, and then packed. The expectation is plain IEEE 754
//! arithmetic in a fixed order: the same bits everywhere.
//!
//! Tried and dropped: second differences of positions (contacts and rounding make them longer on the whole), and no sorting
//! by bytes (twice as long).

use super::block::{Cursor, pack, unpack};
use super::{Frame, RecordingError, Result};

/// Most frames of a block: a second at the usual rate, which is what jumping to a moment has to unpack.
pub(super) const MAX_FRAMES: usize = 64;

/// Bytes of frames that make a block full, before packing.
pub(super) const FULL_BYTES: usize = 4 << 20;

/// The shape of all frames of a recording.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) dimension: usize,
    pub(super) bodies: usize,
}

impl Layout {
    /// Numbers of a frame.
    pub(super) fn numbers(self) -> usize {
        self.bodies * Frame::numbers(self.dimension)
    }

    /// Bytes of a frame before packing: step, time, flags, numbers.
    pub(super) fn frame_bytes(self) -> usize {
        16 + self.bodies + 8 * self.numbers()
    }

    /// Most bytes that the frames of a block have before packing: a block is full with the frame that passes the limit.
    pub(super) fn most_block_bytes(self) -> u64 {
        (MAX_FRAMES * self.frame_bytes()).min(FULL_BYTES + self.frame_bytes()) as u64
    }
}

/// What a block stores of frames; they have to fit the layout.
pub(super) fn encode(frames: &[Frame], layout: Layout) -> Vec<u8> {
    let mut raw = Vec::with_capacity(frames.len() * layout.frame_bytes());
    frames.iter().for_each(|frame| raw.extend(frame.step.to_le_bytes()));
    frames.iter().for_each(|frame| raw.extend(frame.time.to_le_bytes()));
    for body in 0..layout.bodies {
        raw.extend(frames.iter().map(|frame| frame.flags[body]));
    }
    let mut distances = vec![0_u64; frames.len() * layout.numbers()];
    let mut expected = vec![0.0; layout.numbers()];
    for (index, frame) in frames.iter().enumerate() {
        expect(&frames[..index], layout, &mut expected);
        for (place, (&number, &expected)) in frame.poses.iter().zip(&expected).enumerate() {
            distances[place * frames.len() + index] = distance(number, expected);
        }
    }
    for byte in (0..8).rev() {
        raw.extend(distances.iter().map(|distance| (distance >> (8 * byte)) as u8));
    }
    let mut payload = (frames.len() as u32).to_le_bytes().to_vec();
    payload.extend(pack(&raw));
    payload
}

/// The frames of a block that begins at byte `offset`.
pub(super) fn decode(payload: &[u8], layout: Layout, offset: u64) -> Result<Vec<Frame>> {
    let mut head = Cursor::new(payload, offset);
    let count = head.u32()? as usize;
    if !(1..=MAX_FRAMES).contains(&count) {
        let what = format!("a block holds {count} frames, where there are 1 to {MAX_FRAMES}");
        return Err(RecordingError::damaged(offset, what));
    }
    if (count - 1) * layout.frame_bytes() >= FULL_BYTES {
        // No writer makes such a block, and unpacking it could take any amount of memory.
        let what = format!("a block holds {count} frames, which are too many for bodies as numerous as these");
        return Err(RecordingError::damaged(offset, what));
    }
    let raw = unpack(head.rest(), count * layout.frame_bytes(), offset)?;
    let mut cursor = Cursor::new(&raw, offset);
    let mut frames = vec![Frame::default(); count];
    for frame in &mut frames {
        frame.step = cursor.u64()?;
    }
    for frame in &mut frames {
        frame.time = f64::from_bits(cursor.u64()?);
    }
    for _ in 0..layout.bodies {
        for (frame, &flags) in frames.iter_mut().zip(cursor.take(count)?) {
            frame.flags.push(flags);
        }
    }
    let mut distances = vec![0_u64; count * layout.numbers()];
    for _ in 0..8 {
        for (distance, &byte) in distances.iter_mut().zip(cursor.take(count * layout.numbers())?) {
            *distance = *distance << 8 | u64::from(byte);
        }
    }
    cursor.finish()?;
    let mut expected = vec![0.0; layout.numbers()];
    for index in 0..count {
        expect(&frames[..index], layout, &mut expected);
        let numbers = expected.iter().enumerate();
        frames[index].poses =
            numbers.map(|(place, &expected)| beyond(expected, distances[place * count + index])).collect();
    }
    Ok(frames)
}

/// Writes what the frames so far let expect of the next.
fn expect(past: &[Frame], layout: Layout, out: &mut [f64]) {
    let (last, before) = match past {
        [] => return out.fill(0.0),
        [only] => return out.copy_from_slice(&only.poses),
        [.., before, last] => (&last.poses, &before.poses),
    };
    let n = layout.dimension;
    let bodies = out.chunks_exact_mut(Frame::numbers(n));
    let past = last.chunks_exact(Frame::numbers(n)).zip(before.chunks_exact(Frame::numbers(n)));
    for (out, (last, before)) in bodies.zip(past) {
        let (position, attitude) = out.split_at_mut(n);
        for (axis, position) in position.iter_mut().enumerate() {
            *position = last[axis] + (last[axis] - before[axis]);
        }
        if last[n..] == before[n..] {
            attitude.copy_from_slice(&last[n..]);
        } else {
            turn_on(&last[n..], &before[n..], n, attitude);
        }
    }
}

/// R₁ R₂ᵀ R₁, by rows: the rotation from the one before to the last, once more.
fn turn_on(last: &[f64], before: &[f64], n: usize, out: &mut [f64]) {
    let mut step = [0.0; 36];
    for row in 0..n {
        for column in 0..n {
            step[row * n + column] = (0..n).fold(0.0, |sum, k| sum + last[row * n + k] * before[column * n + k]);
        }
    }
    for row in 0..n {
        for column in 0..n {
            out[row * n + column] = (0..n).fold(0.0, |sum, k| sum + step[row * n + k] * last[k * n + column]);
        }
    }
}

/// Numbers in order: neighbours among the representable numbers are one apart.
fn rank(number: f64) -> i64 {
    let bits = number.to_bits() as i64;
    // The order of negative numbers is reversed; below zero comes minus zero, so that every bit pattern has a rank.
    if bits < 0 { !(bits & i64::MAX) } else { bits }
}

fn number_of(rank: i64) -> f64 {
    let bits = if rank < 0 { !rank | i64::MIN } else { rank };
    f64::from_bits(bits as u64)
}

/// How far a number lies from the expected one, small in both directions: 0, −1, 1, −2, 2 … are 0, 1, 2, 3, 4.
fn distance(number: f64, expected: f64) -> u64 {
    let difference = rank(number).wrapping_sub(rank(expected));
    (difference << 1 ^ difference >> 63) as u64
}

fn beyond(expected: f64, distance: u64) -> f64 {
    let difference = (distance >> 1) as i64 ^ -((distance & 1) as i64);
    number_of(rank(expected).wrapping_add(difference))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_to_the_bit_whatever_was_expected() {
        let numbers = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f64::MIN_POSITIVE,
            5e-324,
            -5e-324,
            f64::MAX,
            f64::MIN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
            0.1,
            -9.81,
        ];
        for number in numbers {
            for expected in numbers {
                let back = beyond(expected, distance(number, expected));
                assert_eq!(back.to_bits(), number.to_bits(), "{number} where {expected} was expected");
            }
        }
        assert_eq!(distance(1.0, 1.0 - f64::EPSILON / 2.0), 2, "neighbours are one apart");
        assert_eq!(distance(-0.0, 0.0), 1);
    }
}
