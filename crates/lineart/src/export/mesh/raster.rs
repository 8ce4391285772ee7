//! Values on a mesh as PNG: a pixel has the colour of the value at its middle, darker on lines of equal value and black on
//! the drawing.

use std::io::{self, Write};

use feature_sampling::geometry::Point;

use super::MeshRows;
use super::picture::frame_of;
use crate::export::palette;

/// The longer side of the picture, in pixels.
pub const SIDE: u32 = 1200;

/// Rows of pixels, three bytes each.
struct Image {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Image {
    /// Pixels whose middles lie in a box, as ranges.
    fn covered(&self, low: Point<f64>, high: Point<f64>) -> [std::ops::Range<usize>; 2] {
        let range = |low: f64, high: f64, count: usize| {
            let from = pixel(low - 0.5, count);
            from..pixel(high + 1.5, count).max(from)
        };
        [range(low.x, high.x, self.width), range(low.y, high.y, self.height)]
    }

    /// A line of a thickness, in pixels.
    fn line(&mut self, a: Point<f64>, b: Point<f64>, thickness: f64, colour: [u8; 3], share: f64) {
        let half = thickness / 2.0;
        let low = Point::new(a.x.min(b.x) - half - 1.0, a.y.min(b.y) - half - 1.0);
        let high = Point::new(a.x.max(b.x) + half + 1.0, a.y.max(b.y) + half + 1.0);
        let along = b.minus(&a);
        let length_sq = along.norm_sq();
        let [xs, ys] = self.covered(low, high);
        for y in ys {
            for x in xs.clone() {
                let p = Point::new(x as f64 + 0.5, y as f64 + 0.5);
                let t = if length_sq > 0.0 { (p.minus(&a).dot(&along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
                let away = a.plus_scaled(&t, &along).distance(&p);
                let cover = (half + 0.5 - away).clamp(0.0, 1.0) * share;
                if let Some(old) = self.pixels.get_mut(y * self.width + x) {
                    for (channel, new) in old.iter_mut().zip(colour) {
                        *channel =
                            palette::channel(f64::from(*channel) + cover * (f64::from(new) - f64::from(*channel)));
                    }
                }
            }
        }
    }
}

/// A pixel's number, between 0 and the count.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cut to the picture")]
fn pixel(at: f64, count: usize) -> usize {
    at.clamp(0.0, count as f64) as usize
}

/// Writes the picture; `lines_of` is the number of lines of equal value.
///
/// # Errors
/// Those of `out`.
pub fn write(out: &mut dyn Write, rows: &MeshRows<'_>, lines_of: usize) -> io::Result<()> {
    let mesh = rows.mesh;
    let nothing = vec![0.0; mesh.points.len()];
    let values = rows.values.unwrap_or(&nothing);
    let frame = frame_of(rows);
    let extent = frame.extent();
    let scale = f64::from(SIDE) / extent.x.max(extent.y);
    let side = |length: f64| pixel((length * scale).round().max(1.0), SIDE as usize);
    let (width, height) = (side(extent.x), side(extent.y));
    let mut image = Image { width, height, pixels: vec![[0xff; 3]; width * height] };
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let span = values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least;
    let place = |v: u32| {
        let p = mesh.points[v as usize];
        Point::new((p.x - frame.min.x) * scale, (p.y - frame.min.y) * scale)
    };
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(place);
        let value = triangle.map(|v| if span > 0.0 { (values[v as usize] - least) / span } else { 0.0 });
        let low = Point::new(a.x.min(b.x).min(c.x), a.y.min(b.y).min(c.y));
        let high = Point::new(a.x.max(b.x).max(c.x), a.y.max(b.y).max(c.y));
        let double = b.minus(&a).cross(&c.minus(&a));
        let [xs, ys] = image.covered(low, high);
        for y in ys {
            for x in xs.clone() {
                let p = Point::new(x as f64 + 0.5, y as f64 + 0.5);
                let shares = [(b, c), (c, a), (a, b)].map(|(from, to)| to.minus(&from).cross(&p.minus(&from)) / double);
                // On an edge both triangles agree on the value.
                if shares.iter().all(|share| *share >= -1e-9) {
                    let here = shares.iter().zip(value).map(|(share, value)| share * value).sum();
                    image.pixels[y * width + x] = palette::full_channels(here);
                }
            }
        }
    }
    for level in crate::simulate::contour::levels(least, least + span, lines_of) {
        for line in crate::simulate::contour::contour(mesh, values, level).lines {
            for pair in line.windows(2) {
                let [p, q] =
                    [pair[0], pair[1]].map(|p| Point::new((p.x - frame.min.x) * scale, (p.y - frame.min.y) * scale));
                image.line(p, q, 1.0, [0xff; 3], 0.6);
            }
        }
    }
    for border in mesh.borders.iter().filter(|border| border.line.is_some()) {
        let [a, b] = border.ends.map(place);
        image.line(a, b, 2.5, [0; 3], 1.0);
    }
    let [width, height] = [width, height].map(|count| u32::try_from(count).unwrap_or(SIDE));
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let failed = |error: png::EncodingError| match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    };
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(image.pixels.as_flattened()).map_err(failed)?;
    writer.finish().map_err(failed)
}
