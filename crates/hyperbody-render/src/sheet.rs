//! Sheets: pictures of one size beside each other.

use crate::error::RenderError;
use crate::image::Image;

/// A sheet in the making: empty places, from the upper left, row by row, with a thin gap between them.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Of each picture, in pixels.
    size: (u32, u32),
    count: u32,
    columns: u32,
    width: u32,
    bytes: Vec<u8>,
}

/// Pixels between the pictures.
const GAP: u32 = 4;

/// Largest sheet, in bytes of its pixels.
pub const MAX_SHEET_BYTES: u64 = 300_000_000;

impl Sheet {
    /// An empty sheet for `count` pictures of `size` (pixels across and down), `columns` in a row.
    ///
    /// # Errors
    /// If `count` or a side is 0, or the whole would be larger than [`MAX_SHEET_BYTES`].
    pub fn new(size: (u32, u32), count: u32, columns: u32) -> Result<Self, RenderError> {
        if count == 0 || size.0 == 0 || size.1 == 0 {
            let message = format!("{count} pictures of {} × {} pixels make no sheet; take one or more", size.0, size.1);
            return Err(RenderError::new(message));
        }
        let columns = columns.clamp(1, count);
        let rows = count.div_ceil(columns);
        let sum = |number: u32, side: u32| {
            u64::from(number).saturating_mul(u64::from(side) + u64::from(GAP)) - u64::from(GAP)
        };
        let (width, height) = (sum(columns, size.0), sum(rows, size.1));
        let bytes = width.saturating_mul(height).saturating_mul(3);
        if bytes > MAX_SHEET_BYTES {
            return Err(RenderError::new(format!(
                "{count} pictures of {} × {} pixels, {columns} in a row, make a sheet of {width} × {height} pixels, {} MB; \
                 {} MB are the most, so make the pictures smaller or fewer",
                size.0,
                size.1,
                bytes / 1_000_000,
                MAX_SHEET_BYTES / 1_000_000
            )));
        }
        // Both fit: their product does.
        Ok(Self { size, count, columns, width: width as u32, bytes: vec![255; bytes as usize] })
    }

    /// Puts a picture in its place, counted from 0.
    ///
    /// # Errors
    /// If there is no such place, or the picture has another size.
    pub fn place(&mut self, number: u32, image: &Image) -> Result<(), RenderError> {
        if number >= self.count {
            let message = format!("there is no place {number} on a sheet of {}; the first is 0", self.count);
            return Err(RenderError::new(message));
        }
        if (image.width(), image.height()) != self.size {
            return Err(RenderError::new(format!(
                "a sheet holds pictures of {} × {} pixels, and this one has {} × {}; draw it in that size",
                self.size.0,
                self.size.1,
                image.width(),
                image.height()
            )));
        }
        let left = (number % self.columns * (self.size.0 + GAP)) as usize;
        let top = (number / self.columns * (self.size.1 + GAP)) as usize;
        for (row, line) in image.bytes().chunks_exact(3 * self.size.0 as usize).enumerate() {
            let start = 3 * ((top + row) * self.width as usize + left);
            self.bytes[start..start + line.len()].copy_from_slice(line);
        }
        Ok(())
    }

    /// The finished sheet; empty places are white.
    #[must_use]
    pub fn into_image(self) -> Image {
        let height = self.bytes.len() / 3 / self.width as usize;
        Image::new(self.width, height as u32, self.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(value: u8) -> Image {
        Image::new(20, 16, vec![value; 3 * 20 * 16])
    }

    #[test]
    fn pictures_stand_in_their_places() {
        let mut sheet = Sheet::new((20, 16), 3, 2).unwrap();
        for number in 0..3 {
            sheet.place(number, &plain(10 * number as u8)).unwrap();
        }
        assert!(sheet.place(3, &plain(0)).is_err(), "there is no fourth place");
        assert!(sheet.place(0, &Image::new(16, 20, vec![0; 3 * 20 * 16])).is_err(), "nor one for another size");
        let image = sheet.into_image();
        assert_eq!((image.width(), image.height()), (44, 36));
        let grey = |x, y| image.pixel(x, y).unwrap();
        assert_eq!([grey(0, 0), grey(24, 0), grey(0, 20), grey(19, 35)], [[0; 3], [10; 3], [20; 3], [20; 3]]);
        assert_eq!([grey(20, 0), grey(0, 16), grey(43, 35)], [[255; 3]; 3], "gaps and empty places");
    }

    #[test]
    fn sheets_that_are_too_large_are_refused_with_their_size() {
        let error = Sheet::new((8192, 8192), 64, 8).unwrap_err().to_string();
        assert!(error.contains("65564 × 65564") && error.contains("300 MB are the most"), "{error}");
        assert!(Sheet::new((u32::MAX, u32::MAX), u32::MAX, u32::MAX).is_err());
        assert!(Sheet::new((100, 100), 0, 1).is_err() && Sheet::new((0, 100), 1, 1).is_err());
    }
}
