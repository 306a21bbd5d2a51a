//! Finished pictures.

use std::io::Write;

use crate::error::RenderError;

/// A picture of bytes in sRGB, three a pixel, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    bytes: Vec<u8>,
}

impl Image {
    pub(crate) fn new(width: u32, height: u32, bytes: Vec<u8>) -> Self {
        Self { width, height, bytes }
    }

    /// Pixels across.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Red, green and blue of every pixel, rows from the top.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Red, green and blue of a pixel, or `None` outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        let start = 3 * (y as usize * self.width as usize + x as usize);
        (x < self.width).then(|| self.bytes.get(start..start + 3)).flatten()?.try_into().ok()
    }

    /// Lays a colour over a pixel; outside, nothing happens.
    pub(crate) fn blend(&mut self, x: i64, y: i64, colour: [u8; 3], cover: f32) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) {
            return;
        }
        let start = 3 * (y as usize * self.width as usize + x as usize);
        for (byte, component) in self.bytes[start..start + 3].iter_mut().zip(colour) {
            let mixed = f32::from(*byte) + (f32::from(component) - f32::from(*byte)) * cover.clamp(0.0, 1.0);
            *byte = (mixed + 0.5) as u8;
        }
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// If the writer fails.
    pub fn write_png(&self, writer: impl Write) -> Result<(), RenderError> {
        let mut encoder = png::Encoder::new(writer, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.bytes)?;
        Ok(writer.finish()?)
    }
}
