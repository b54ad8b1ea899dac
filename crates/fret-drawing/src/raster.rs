//! Fields as images: PNG in a `data:` address, so that a page or an SVG holds them itself.

use base64::prelude::{BASE64_STANDARD, Engine};
use png::EncodingError;

/// Colours from low to high: matplotlib's viridis at 16 places, straight in between. Even in lightness, also for the colour-blind.
const VIRIDIS: [[u8; 3]; 16] = [
    [68, 1, 84],
    [72, 26, 108],
    [71, 47, 125],
    [65, 68, 135],
    [57, 86, 140],
    [49, 104, 142],
    [42, 120, 142],
    [35, 136, 142],
    [31, 152, 139],
    [34, 168, 132],
    [53, 183, 121],
    [84, 197, 104],
    [122, 209, 81],
    [165, 219, 54],
    [210, 226, 27],
    [253, 231, 37],
];
/// Colours of a scale; the last one of the palette is for what has no value, and is clear.
const LEVELS: usize = 255;
const CLEAR: u8 = 255;
/// Colours of stick and of slip, those of `palette.css`; where there is no contact the ground shows.
const STICK: [u8; 3] = [0x00, 0x72, 0xb2];
const SLIP: [u8; 3] = [0xe6, 0x9f, 0x00];
/// Pixels along a side, at most: what a map of a page can show.
const FINEST: usize = 160;

/// An image of colours by number, rows from the top.
#[derive(Debug)]
pub struct Raster {
    size: [usize; 2],
    pixels: Vec<u8>,
    palette: Vec<u8>,
    /// How much each colour covers.
    cover: Vec<u8>,
}

impl Raster {
    /// How many pixels along each side show so many cells.
    pub fn pixels_for(cells: [usize; 2]) -> [usize; 2] {
        cells.map(|cells| cells.min(FINEST))
    }

    /// Values between `low` and `high` in colours of the scale; what is no number stays clear.
    pub fn of_values(size: [usize; 2], [low, high]: [f64; 2], value: impl Fn(usize, usize) -> f64) -> Self {
        let level = |value: f64| {
            let part = if high > low { (value - low) / (high - low) } else { 0.0 };
            if value.is_finite() { (part.clamp(0.0, 1.0) * (LEVELS - 1) as f64).round() as u8 } else { CLEAR }
        };
        let palette =
            (0..LEVELS).flat_map(|level| colour(level as f64 / (LEVELS - 1) as f64)).chain([0; 3]).collect();
        let mut cover = vec![u8::MAX; LEVELS];
        cover.push(0);
        Self { size, pixels: pixels(size, |column, row| level(value(column, row))), palette, cover }
    }

    /// Zones: 0 open and clear, 1 stick, 2 slip.
    pub fn of_zones(size: [usize; 2], zone: impl Fn(usize, usize) -> f64) -> Self {
        let palette = [[0; 3], STICK, SLIP].concat();
        Self {
            size,
            pixels: pixels(size, |column, row| (zone(column, row) as u8).min(2)),
            palette,
            cover: vec![0, 255, 255],
        }
    }

    /// The scale itself, low at the bottom.
    pub fn of_scale() -> Self {
        let top = LEVELS - 1;
        Self::of_values([1, LEVELS], [0.0, top as f64], |_, row| (top - row) as f64)
    }

    /// The image as an address that holds it.
    ///
    /// # Errors
    /// When it has no pixels.
    pub fn address(&self) -> Result<String, EncodingError> {
        Ok(format!("data:image/png;base64,{}", BASE64_STANDARD.encode(self.png()?)))
    }

    fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let mut file = Vec::new();
        let [width, height] = self.size;
        let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(self.palette.as_slice());
        encoder.set_trns(self.cover.as_slice());
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.pixels)?;
        Ok(file)
    }
}

fn pixels([width, height]: [usize; 2], pixel: impl Fn(usize, usize) -> u8) -> Vec<u8> {
    (0..height)
        .flat_map(|row| (0..width).map(move |column| [column, row]))
        .map(|[column, row]| pixel(column, row))
        .collect()
}

/// The colour at a part of the scale, from 0 to 1.
fn colour(part: f64) -> [u8; 3] {
    let place = part * (VIRIDIS.len() - 1) as f64;
    let first = (place as usize).min(VIRIDIS.len() - 2);
    let further = place - first as f64;
    [0, 1, 2].map(|part| {
        let [from, to] = [VIRIDIS[first][part], VIRIDIS[first + 1][part]].map(f64::from);
        (from + further * (to - from)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Read back by the decoder of the library: what was drawn is what is seen.
    fn seen(raster: &Raster) -> Vec<[u8; 4]> {
        let png = raster.png().unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        bytes.as_chunks::<4>().0.to_vec()
    }

    #[test]
    fn the_ends_of_the_scale_are_those_of_viridis_and_no_number_is_clear() {
        let raster = Raster::of_values([3, 1], [1.0, 5.0], |column, _| [1.0, 5.0, f64::NAN][column]);
        let seen = seen(&raster);
        // matplotlib.colormaps["viridis"](0.0), (1.0)
        assert_eq!(seen[0], [68, 1, 84, 255]);
        assert_eq!(seen[1], [253, 231, 37, 255]);
        assert_eq!(seen[2][3], 0);
    }

    #[test]
    fn zones_have_their_colours_and_no_contact_is_clear() {
        let raster = Raster::of_zones([2, 2], |column, row| [[0.0, 1.0], [2.0, 0.0]][row][column]);
        let seen = seen(&raster);
        assert_eq!((seen[0][3], seen[3][3]), (0, 0));
        let shown = seen[1..3].iter().map(|[r, g, b, cover]| (format!("#{r:02x}{g:02x}{b:02x}"), *cover));
        for ((colour, cover), name) in shown.zip(["--stick", "--slip"]) {
            assert!(crate::Drawing::STYLE.contains(&format!("{name}: {colour};")), "{name}: {colour}");
            assert_eq!(cover, 255);
        }
    }
}
