//! Few colours for many: the palettes of GIF pictures.
//!
//! The colours are counted in cells of four levels a side. Boxes of cells are split, worst first, where that takes away
//! most of the squared error (X. Wu, 1991, there on a fixed grid), and the middles of the boxes are then moved a few times
//! to the middles of what is nearest to them (S. Lloyd, 1982). Rare colours weigh more than their number: a small body in
//! a colour of its own would otherwise be drawn in that of another.
//!
//! Tried and dropped: a neural net that learns the colours from every tenth pixel, as GIF encoders have (A. Dekker, 1994);
//! it left speckles on small bodies, whose colours it had hardly met.

/// Most colours of a palette.
pub(crate) const MAX_COLOURS: usize = 255;

/// Bits of a colour component that tell cells apart.
const BITS: u32 = 6;

/// Turns of moving the colours to the middles of what is nearest to them.
const TURNS: usize = 4;

/// What differences of red, green and blue weigh to the eye.
const WEIGHTS: [f32; 3] = [2.0, 4.0, 3.0];

/// A colour with three components, 0..=255.
type Colour = [f32; 3];

/// Colours for pixels.
pub(crate) struct Palette {
    /// Red, green and blue of each, [`MAX_COLOURS`] at most.
    pub(crate) colours: Vec<[u8; 3]>,
    /// The nearest colour to each cell that is taken.
    nearest: Vec<u8>,
}

/// Pixels of nearly one colour.
#[derive(Clone, Copy)]
struct Cell {
    number: u32,
    middle: Colour,
    weight: f32,
}

fn cell_of(pixel: [u8; 3]) -> usize {
    pixel.iter().fold(0, |number, &part| number << BITS | usize::from(part >> (8 - BITS)))
}

/// The squared distance of two colours, as the eye weighs it.
pub(crate) fn distance_sq(a: Colour, b: Colour) -> f32 {
    (0..3).map(|part| WEIGHTS[part] * (a[part] - b[part]) * (a[part] - b[part])).sum()
}

impl Palette {
    /// Colours for these pixels.
    pub(crate) fn of(pixels: &[[u8; 3]]) -> Self {
        let cells = count(pixels);
        let mut colours = split(cells.clone());
        for _ in 0..TURNS {
            colours = settle(&cells, colours);
        }
        let rounded: Vec<[u8; 3]> = colours.iter().map(|colour| colour.map(|part| (part + 0.5) as u8)).collect();
        let mut nearest = vec![0; 1 << (3 * BITS)];
        for cell in &cells {
            nearest[cell.number as usize] = nearest_to(cell.middle, &colours) as u8;
        }
        Self { colours: rounded, nearest }
    }

    /// The number of the colour for a pixel, which has to be one of those that the palette is for.
    pub(crate) fn index(&self, pixel: [u8; 3]) -> u8 {
        self.nearest[cell_of(pixel)]
    }
}

/// The cells that are taken.
fn count(pixels: &[[u8; 3]]) -> Vec<Cell> {
    let mut sums = vec![[0_u64; 4]; 1 << (3 * BITS)];
    for pixel in pixels {
        let sum = &mut sums[cell_of(*pixel)];
        for part in 0..3 {
            sum[part] += u64::from(pixel[part]);
        }
        sum[3] += 1;
    }
    let taken = sums.iter().enumerate().filter(|(_, sum)| sum[3] > 0);
    taken
        .map(|(number, sum)| {
            let count = sum[3] as f32;
            let middle = [sum[0], sum[1], sum[2]].map(|part| part as f32 / count);
            Cell { number: number as u32, middle, weight: count.sqrt() }
        })
        .collect()
}

/// Weight, sum and sum of squares of colours.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f32,
    sum: Colour,
    squares: f32,
}

impl Sums {
    fn add(&mut self, cell: &Cell) {
        self.weight += cell.weight;
        for part in 0..3 {
            self.sum[part] += cell.weight * cell.middle[part];
            self.squares += cell.weight * WEIGHTS[part] * cell.middle[part] * cell.middle[part];
        }
    }

    fn of(cells: &[Cell]) -> Self {
        cells.iter().fold(Self::default(), |mut sums, cell| {
            sums.add(cell);
            sums
        })
    }

    fn without(&self, other: &Self) -> Self {
        let sum = [0, 1, 2].map(|part| self.sum[part] - other.sum[part]);
        Self { weight: self.weight - other.weight, sum, squares: self.squares - other.squares }
    }

    fn middle(&self) -> Colour {
        self.sum.map(|part| part / self.weight.max(f32::MIN_POSITIVE))
    }

    /// The sum of squared distances from the middle.
    fn error(&self) -> f32 {
        let middle = self.middle();
        self.squares - (0..3).map(|part| WEIGHTS[part] * middle[part] * self.sum[part]).sum::<f32>()
    }
}

/// Some of the cells, next to each other in the list, and how well they would split.
struct Region {
    start: usize,
    end: usize,
    /// What the best split takes away, along which component, and how many cells it leaves in front.
    gain: f32,
    part: usize,
    front: usize,
}

/// The middles of boxes of cells.
fn split(mut cells: Vec<Cell>) -> Vec<Colour> {
    let mut boxes = Vec::with_capacity(MAX_COLOURS);
    let count = cells.len();
    boxes.push(best_split(&mut cells, 0, count));
    while boxes.len() < MAX_COLOURS {
        let worst = (0..boxes.len()).max_by(|&a, &b| boxes[a].gain.total_cmp(&boxes[b].gain).then(b.cmp(&a)));
        let Some(worst) = worst.filter(|&worst| boxes[worst].gain > 0.0) else { break };
        let Region { start, end, part, front, .. } = boxes.swap_remove(worst);
        sort(&mut cells[start..end], part);
        boxes.push(best_split(&mut cells, start, start + front));
        boxes.push(best_split(&mut cells, start + front, end));
    }
    boxes.iter().map(|part| Sums::of(&cells[part.start..part.end]).middle()).collect()
}

/// By one component, and by number where that is the same.
fn sort(cells: &mut [Cell], part: usize) {
    cells.sort_unstable_by(|a, b| a.middle[part].total_cmp(&b.middle[part]).then(a.number.cmp(&b.number)));
}

fn best_split(cells: &mut [Cell], start: usize, end: usize) -> Region {
    let cells = &mut cells[start..end];
    let all = Sums::of(cells);
    let mut best = Region { start, end, gain: 0.0, part: 0, front: 0 };
    for part in 0..3 {
        sort(cells, part);
        let mut front = Sums::default();
        for (index, cell) in cells.iter().enumerate().take(cells.len().saturating_sub(1)) {
            front.add(cell);
            let gain = all.error() - front.error() - all.without(&front).error();
            if gain > best.gain {
                best = Region { gain, part, front: index + 1, ..best };
            }
        }
    }
    best
}

/// The middles of the cells that are nearest to each colour; a colour that is nearest to none stays.
fn settle(cells: &[Cell], colours: Vec<Colour>) -> Vec<Colour> {
    let mut sums = vec![Sums::default(); colours.len()];
    for cell in cells {
        sums[nearest_to(cell.middle, &colours)].add(cell);
    }
    let moved = |(sums, colour): (&Sums, Colour)| if sums.weight > 0.0 { sums.middle() } else { colour };
    sums.iter().zip(colours).map(moved).collect()
}

fn nearest_to(colour: Colour, colours: &[Colour]) -> usize {
    let mut best = (f32::INFINITY, 0);
    for (index, &other) in colours.iter().enumerate() {
        let away = distance_sq(colour, other);
        if away < best.0 {
            best = (away, index);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let pixels: Vec<[u8; 3]> = (0..200_u8).map(|i| [i, 255 - i, i.wrapping_mul(37)]).collect();
        let palette = Palette::of(&pixels);
        for pixel in &pixels {
            assert_eq!(palette.colours[usize::from(palette.index(*pixel))], *pixel);
        }
        assert!(Palette::of(&[]).colours.len() <= 1, "no pixels need no colours");
    }

    /// The largest picture has so many pixels of one colour that their sum is beyond 32 bits.
    #[test]
    fn large_pictures_keep_their_colours() {
        let pixels = vec![[255; 3]; (u32::MAX / 255) as usize + 10];
        let palette = Palette::of(&pixels);
        assert_eq!(palette.colours[usize::from(palette.index([255; 3]))], [255; 3]);
    }

    /// A smooth ramp of all greys, and ten pixels of a colour of its own.
    #[test]
    fn ramps_are_even_and_rare_colours_are_not_lost() {
        let mut pixels: Vec<[u8; 3]> = (0..60_000_u32).map(|i| [(i % 256) as u8; 3]).collect();
        pixels.extend([[200, 30, 40]; 10]);
        let palette = Palette::of(&pixels);
        assert!(palette.colours.len() <= MAX_COLOURS);
        for pixel in &pixels {
            let drawn = palette.colours[usize::from(palette.index(*pixel))];
            let off = (0..3).map(|part| pixel[part].abs_diff(drawn[part])).max().unwrap();
            assert!(off <= 2, "{pixel:?} is drawn as {drawn:?}");
        }
    }
}
