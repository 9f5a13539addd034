//! Draws text into pixels.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use tiny_skia::{Pixmap, PremultipliedColorU8};

#[derive(Clone, Copy)]
pub(super) enum Size {
    Small,
    Large,
}

impl Size {
    const fn raster(self) -> RasterHeight {
        match self {
            Self::Small => RasterHeight::Size24,
            Self::Large => RasterHeight::Size32,
        }
    }
}

/// Returns the width of a text, in pixels.
pub(super) fn width(text: &str, size: Size) -> u32 {
    (get_raster_width(FontWeight::Regular, size.raster()) * text.chars().count()) as u32
}

/// Writes a line of text in black on white, its top left corner at (`left`, `top`).
///
/// The font has the characters of ASCII; others become question marks. Text that does not fit into the picture is cut off.
pub(super) fn write(picture: &mut Pixmap, left: u32, top: u32, text: &str, size: Size) {
    let (picture_width, picture_height) = (picture.width() as usize, picture.height() as usize);
    let letters = text.chars().filter_map(|letter| {
        let raster = |letter| get_raster(letter, FontWeight::Regular, size.raster());
        raster(letter).or_else(|| raster('?'))
    });
    let mut x = left as usize;
    for letter in letters {
        for (row, coverages) in letter.rows().enumerate() {
            for (column, &coverage) in coverages.iter().enumerate() {
                let (x, y) = (x + column, top as usize + row);
                if x < picture_width && y < picture_height {
                    darken(&mut picture.pixels_mut()[y * picture_width + x], coverage);
                }
            }
        }
        x += letter.width();
    }
}

/// Puts black ink over part of an opaque pixel.
fn darken(pixel: &mut PremultipliedColorU8, coverage: u8) {
    let rest = 255 - u16::from(coverage);
    let channel = |value: u8| (u16::from(value) * rest / 255) as u8;
    let [red, green, blue] = [pixel.red(), pixel.green(), pixel.blue()].map(channel);
    if let Some(darker) = PremultipliedColorU8::from_rgba(red, green, blue, pixel.alpha()) {
        *pixel = darker;
    }
}
