//! Growth rates as colours.

use plotters::element::Rectangle;
use plotters::prelude::Color;
use plotters::style::RGBColor;

use super::axis::ticks;
use super::{Area, Drawn};

/// From little to much growth, evenly in brightness for every kind of colour vision (J. Nuñez, C. Anderton and R. Renslow,
/// 2018), the pale end first.
const RAMP: [[u8; 3]; 9] = [
    [0xFF, 0xEA, 0x46],
    [0xE4, 0xCF, 0x5B],
    [0xC4, 0xB5, 0x6C],
    [0xA6, 0x9D, 0x75],
    [0x8A, 0x87, 0x79],
    [0x70, 0x71, 0x73],
    [0x57, 0x5C, 0x6D],
    [0x39, 0x48, 0x6B],
    [0x00, 0x20, 0x4D],
];

/// Steps of colour: enough to see a slope, few enough that whole areas are one shape.
const LEVELS: usize = 24;

/// Colours for rates from zero to a round number.
pub(super) struct Scale {
    /// The least rate that counts as growth.
    pub(super) least: f64,
    pub(super) top: f64,
}

impl Scale {
    /// The scale that holds rates up to `largest`.
    pub(super) fn new(least: f64, largest: f64) -> Self {
        let largest = largest.max(2.0 * least).max(1e-300);
        let step = ticks(0.0, largest, 4).get(1).copied().unwrap_or(largest);
        Self { least, top: (largest / step * (1.0 - 1e-9)).ceil() * step }
    }

    /// Zero for no growth, then from one to [`LEVELS`].
    fn level(&self, rate: f64) -> usize {
        if rate <= self.least {
            return 0;
        }
        1 + ((rate / self.top * LEVELS as f64) as usize).min(LEVELS - 1)
    }

    fn colour_of_level(level: usize) -> RGBColor {
        if level == 0 {
            return RGBColor(0xFF, 0xFF, 0xFF);
        }
        let position = (level - 1) as f64 / (LEVELS - 1) as f64 * (RAMP.len() - 1) as f64;
        let (index, rest) = ((position as usize).min(RAMP.len() - 2), position - position.floor());
        let rest = if position as usize > RAMP.len() - 2 { 1.0 } else { rest };
        let mix =
            |c: usize| (f64::from(RAMP[index][c]) * (1.0 - rest) + f64::from(RAMP[index + 1][c]) * rest).round() as u8;
        RGBColor(mix(0), mix(1), mix(2))
    }

    /// Draws a bar from no growth at the bottom to the top of the scale, in units.
    pub(super) fn draw_bar(&self, area: &Area<'_>, x: (i32, i32), y: (i32, i32)) -> Drawn {
        let edge = |level: usize| y.1 - (f64::from(y.1 - y.0) * level as f64 / LEVELS as f64).round() as i32;
        for level in 1..=LEVELS {
            let corners = [(x.0, edge(level)), (x.1, edge(level - 1))];
            area.draw(&Rectangle::new(corners, Self::colour_of_level(level).filled()))?;
        }
        Ok(())
    }

    /// Draws rows of rates, the first at the bottom, over a rectangle in units: equal neighbours as one rectangle.
    pub(super) fn draw_cells(&self, area: &Area<'_>, rates: &[Vec<f64>], x: (i32, i32), y: (i32, i32)) -> Drawn {
        let columns = rates.first().map_or(0, Vec::len);
        let across = |column: usize| x.0 + (f64::from(x.1 - x.0) * column as f64 / columns as f64).round() as i32;
        let up = |row: usize| y.1 - (f64::from(y.1 - y.0) * row as f64 / rates.len() as f64).round() as i32;
        for block in blocks(rates.iter().map(|row| row.iter().map(|&rate| self.level(rate)).collect())) {
            let corners = [(across(block.columns.0), up(block.rows.1)), (across(block.columns.1), up(block.rows.0))];
            area.draw(&Rectangle::new(corners, Self::colour_of_level(block.level).filled()))?;
        }
        Ok(())
    }
}

/// Cells of one level, from the first to before the second of columns and rows.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Block {
    columns: (usize, usize),
    rows: (usize, usize),
    level: usize,
}

/// Runs of equal cells in a row, joined with the same run in the rows below; level zero is left out.
fn blocks(rows: impl Iterator<Item = Vec<usize>>) -> Vec<Block> {
    let (mut done, mut open): (Vec<Block>, Vec<Block>) = (Vec::new(), Vec::new());
    for (index, row) in rows.enumerate() {
        let mut next = Vec::new();
        let mut start = 0;
        for end in 1..=row.len() {
            if end < row.len() && row[end] == row[start] {
                continue;
            }
            let block = Block { columns: (start, end), rows: (index, index + 1), level: row[start] };
            let below = open.iter().position(|open| open.columns == block.columns && open.level == block.level);
            next.push(
                below.map_or(block, |below| Block { rows: (open.swap_remove(below).rows.0, index + 1), ..block }),
            );
            start = end;
        }
        done.append(&mut open);
        open = next;
    }
    done.append(&mut open);
    done.retain(|block| block.level > 0);
    done.sort_by_key(|block| (block.rows, block.columns));
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_every_cell_once() {
        let rows = vec![vec![1, 1, 0, 2], vec![1, 1, 3, 2], vec![1, 2, 2, 2]];
        let blocks = blocks(rows.clone().into_iter());
        assert_eq!(blocks[0], Block { columns: (0, 2), rows: (0, 2), level: 1 });
        for (row, levels) in rows.iter().enumerate() {
            for (column, &level) in levels.iter().enumerate() {
                let holds = |block: &&Block| {
                    (block.columns.0..block.columns.1).contains(&column) && (block.rows.0..block.rows.1).contains(&row)
                };
                let covering: Vec<&Block> = blocks.iter().filter(holds).collect();
                assert_eq!(covering.len(), usize::from(level > 0), "cell {column}, {row}");
                assert!(covering.iter().all(|block| block.level == level));
            }
        }
    }

    #[test]
    fn scales_end_on_round_numbers_and_keep_their_ends() {
        let scale = Scale::new(1e-3, 0.4743);
        assert!((scale.top - 0.6).abs() < 1e-12 || (scale.top - 0.5).abs() < 1e-12, "{}", scale.top);
        assert_eq!(scale.level(0.0), 0);
        assert_eq!(scale.level(2e-3), 1);
        assert_eq!(scale.level(scale.top), LEVELS);
        assert_eq!(Scale::colour_of_level(1), RGBColor(0xFF, 0xEA, 0x46));
        assert_eq!(Scale::colour_of_level(LEVELS), RGBColor(0x00, 0x20, 0x4D));
    }
}
