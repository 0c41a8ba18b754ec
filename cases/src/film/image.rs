//! A picture in memory.

use glam::DVec3;

/// A picture in linear RGB, row by row from the top, each row from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<DVec3>,
}

impl Image {
    /// Returns the picture whose pixel (i, j) is `colour(i, j)`; i counts from the left, j from the
    /// top. [rule 1]
    pub fn from_fn(width: u32, height: u32, mut colour: impl FnMut(u32, u32) -> DVec3) -> Self {
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for j in 0..height {
            pixels.extend((0..width).map(|i| colour(i, j)));
        }
        Self { width, height, pixels }
    }

    /// Returns the picture of these pixels, or `None` if their count is not width · height.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<DVec3>) -> Option<Self> {
        (pixels.len() as u64 == u64::from(width) * u64::from(height)).then_some(Self {
            width,
            height,
            pixels,
        })
    }

    /// Returns the number of pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns all pixels, row by row from the top.
    pub fn pixels(&self) -> &[DVec3] {
        &self.pixels
    }

    /// Returns the pixel in column `i` of row `j`.
    ///
    /// # Panics
    /// The pixel lies outside the picture.
    pub fn pixel(&self, i: u32, j: u32) -> DVec3 {
        assert!(
            i < self.width && j < self.height,
            "pixel ({i}, {j}) lies outside {}×{}",
            self.width,
            self.height
        );
        self.pixels[j as usize * self.width as usize + i as usize]
    }
}
