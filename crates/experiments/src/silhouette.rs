//! Outlines of shapes: boundary pixels of a mask in order, and closed paths of drawings at equal steps.
//!
//! Figure 6 tests reconstruction on real-world curves. A curve here is the boundary of a shape with its points in order, of
//! which every k-th is taken (the *stride*). From an image it is the outer boundary of the largest connected part, followed
//! by Moore's neighbour tracing (clockwise, 8-connected, until its first step would be repeated); points are pixel centres,
//! so equal distances and right angles abound. From a drawing it is a closed path, walked in steps of equal length, where a
//! "pixel" is 1/512 of the drawing's diagonal.

use feature_sampling::geometry::Point;

use crate::ExperimentError;
use crate::source::{Source, fnv, table_name};
use crate::study::PointSet;

/// Pixels on the diagonal of a drawing.
const PIXELS: f64 = 512.0;

/// Pieces in which a cubic's length is measured.
const PIECES: u32 = 256;

/// Points of an outline have to be at least so many for its shape to be worth asking for.
pub const FEWEST: usize = 8;

/// A closed curve of which every k-th point can be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// The file, and the path in it.
    pub name: String,
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// Boundary pixels in order.
    Pixels(Vec<Point<f64>>),
    /// A polyline that closes, fine enough to stand for a curve, and the length of a pixel.
    Path(Vec<Point<f64>>, f64),
}

impl Outline {
    /// The closed paths of a drawing.
    pub fn of_drawing(drawing: &Source) -> Vec<Self> {
        let points = drawing.paths.iter().flat_map(|(_, cubics)| cubics).flat_map(|cubic| &cubic.points);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in points {
            low = [low[0].min(p.x), low[1].min(p.y)];
            high = [high[0].max(p.x), high[1].max(p.y)];
        }
        let pixel = (high[0] - low[0]).hypot(high[1] - low[1]) / PIXELS;
        let closed = drawing.paths.iter().enumerate().filter(|(_, (closed, _))| *closed);
        let outlines = closed.map(|(number, (_, cubics))| {
            let along = |k: u32| f64::from(k) / f64::from(PIECES);
            let points = cubics.iter().flat_map(|cubic| (0..PIECES).map(move |k| cubic.eval(&along(k))));
            let line = points.chain(cubics.last().map(|cubic| *cubic.end())).collect();
            Self { name: format!("{}:{number}", drawing.name), shape: Shape::Path(line, pixel) }
        });
        outlines.collect()
    }

    /// The boundary of the largest part of a PNG image.
    ///
    /// The brighter half of the range of grey is the shape, unless most pixels of the image's rim belong to it: then the
    /// darker one. Transparent pixels are background.
    ///
    /// # Errors
    /// Not a PNG image, or one of a single shade; `name` is the file.
    pub fn of_png(bytes: &[u8], name: &str) -> Result<Self, ExperimentError> {
        let bad = |cause: &str| ExperimentError::new(format!("{name}: {cause}"));
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().map_err(|error| bad(&error.to_string()))?;
        let size = reader.output_buffer_size().filter(|size| *size <= 1 << 30);
        let mut data = vec![0; size.ok_or_else(|| bad("the image is larger than a gigabyte"))?];
        let info = reader.next_frame(&mut data).map_err(|error| bad(&error.to_string()))?;
        let [width, height] = [info.width, info.height].map(|v| v as usize);
        let samples = info.color_type.samples();
        let shades = data.chunks_exact(samples).take(width * height).map(|pixel| match pixel {
            [grey, alpha] => (*grey, *alpha),
            [r, g, b, alpha] => {
                (u8::try_from((u32::from(*r) + u32::from(*g) + u32::from(*b)) / 3).unwrap_or(255), *alpha)
            }
            _ => (pixel.first().copied().unwrap_or(0), 255),
        });
        let shades: Vec<(u8, u8)> = shades.collect();
        let visible = || shades.iter().filter(|(_, alpha)| *alpha >= 128).map(|(grey, _)| *grey);
        let (Some(darkest), Some(brightest)) = (visible().min(), visible().max()) else {
            return Err(bad("there is nothing to see in it"));
        };
        let some_hidden = shades.iter().any(|(_, alpha)| *alpha < 128);
        if darkest == brightest && !some_hidden {
            return Err(bad("the image is of a single shade"));
        }
        let middle = (u16::from(darkest) + u16::from(brightest)).div_ceil(2);
        let bright = |(grey, alpha): &(u8, u8)| *alpha >= 128 && u16::from(*grey) >= middle;
        let mut filled: Vec<bool> = shades.iter().map(bright).collect();
        let rim = |i: &usize| {
            let (x, y) = (i % width, i / width);
            x == 0 || y == 0 || x + 1 == width || y + 1 == height
        };
        let on_rim: Vec<usize> = (0..filled.len()).filter(rim).collect();
        if 2 * on_rim.iter().filter(|&&i| filled[i]).count() > on_rim.len() {
            filled = shades.iter().map(|shade| shade.1 >= 128 && !bright(shade)).collect();
        }
        let boundary = Mask { width, filled }.boundary();
        Ok(Self { name: table_name(name), shape: Shape::Pixels(boundary) })
    }

    /// Every k-th point; `None` if fewer than [`FEWEST`] are left.
    pub fn points(&self, stride: u32) -> Option<PointSet> {
        let points = match &self.shape {
            Shape::Pixels(points) => points.iter().copied().step_by(stride.max(1) as usize).collect(),
            Shape::Path(points, pixel) => equal_steps(points, pixel * f64::from(stride.max(1))),
        };
        (points.len() >= FEWEST).then(|| PointSet { paths: vec![(true, points)] })
    }

    pub(crate) fn fingerprint(&self) -> u64 {
        let (Shape::Pixels(points) | Shape::Path(points, _)) = &self.shape;
        fnv(points.iter().flat_map(|p| [p.x, p.y]).flat_map(|v| v.to_bits().to_le_bytes()))
    }
}

/// Points on a closed polyline at equal steps of about the given length.
fn equal_steps(line: &[Point<f64>], step: f64) -> Vec<Point<f64>> {
    let next = |i: usize| &line[(i + 1) % line.len()];
    let length: f64 = (0..line.len()).map(|i| line[i].distance(next(i))).sum();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is bounded")]
    let count = ((length / step).round() as usize).min(1_000_000);
    let step = length / count.max(1) as f64;
    let (mut points, mut walked) = (Vec::with_capacity(count), 0.0);
    for (i, from) in line.iter().enumerate() {
        let piece = from.distance(next(i));
        while points.len() < count && points.len() as f64 * step < walked + piece {
            let share = (points.len() as f64 * step - walked) / piece;
            points.push(from.plus_scaled(&share.max(0.0), &next(i).minus(from)));
        }
        walked += piece;
    }
    points
}

/// Clockwise on the screen, from the right.
const AROUND: [[isize; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

struct Mask {
    width: usize,
    filled: Vec<bool>,
}

impl Mask {
    fn neighbour(&self, pixel: usize, direction: usize) -> Option<usize> {
        let [dx, dy] = AROUND[direction % 8];
        let x = (pixel % self.width).checked_add_signed(dx).filter(|x| *x < self.width)?;
        let y = (pixel / self.width).checked_add_signed(dy)?;
        Some(y * self.width + x).filter(|p| *p < self.filled.len())
    }

    /// A mask of the largest 8-connected part alone; the first of several.
    fn largest(&self) -> Self {
        let mut part = vec![0_u32; self.filled.len()];
        let (mut best, mut best_size, mut parts) = (0, 0, 0);
        for seed in 0..self.filled.len() {
            if !self.filled[seed] || part[seed] != 0 {
                continue;
            }
            parts += 1;
            let (mut pending, mut size) = (vec![seed], 0);
            part[seed] = parts;
            while let Some(pixel) = pending.pop() {
                size += 1;
                for next in (0..8).filter_map(|direction| self.neighbour(pixel, direction)) {
                    if self.filled[next] && part[next] == 0 {
                        part[next] = parts;
                        pending.push(next);
                    }
                }
            }
            if size > best_size {
                (best, best_size) = (parts, size);
            }
        }
        Self { width: self.width, filled: part.iter().map(|p| best > 0 && *p == best).collect() }
    }

    /// The outer boundary of the largest part.
    fn boundary(&self) -> Vec<Point<f64>> {
        let part = self.largest();
        let Some(start) = part.filled.iter().position(|filled| *filled) else { return Vec::new() };
        let is_filled = |pixel: Option<usize>| pixel.is_some_and(|p| part.filled[p]);
        // What lies to the left of the first pixel is background.
        let (mut at, mut back) = (start, 4);
        let (mut pixels, mut first_step) = (Vec::new(), None);
        // Each pixel is entered from each side at most once.
        for _ in 0..8 * part.filled.len() {
            let Some(direction) = (1..=8).map(|k| (back + k) % 8).find(|d| is_filled(part.neighbour(at, *d))) else {
                // A lone pixel.
                pixels.push(at);
                break;
            };
            if at == start && first_step == Some(direction) {
                break;
            }
            first_step = first_step.or(Some(direction));
            pixels.push(at);
            // The background pixel looked at before, as seen from the new place.
            let (before, step) = (AROUND[(direction + 7) % 8], AROUND[direction]);
            let seen = [before[0] - step[0], before[1] - step[1]];
            back = AROUND.iter().position(|a| *a == seen).unwrap_or(0);
            at = part.neighbour(at, direction).unwrap_or(at);
        }
        pixels.iter().map(|p| Point::new((p % self.width) as f64, (p / self.width) as f64)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boundary(rows: &[&str]) -> Vec<[f64; 2]> {
        let filled = rows.iter().flat_map(|row| row.bytes().map(|b| b == b'#')).collect();
        Mask { width: rows[0].len(), filled }.boundary().iter().map(|p| [p.x, p.y]).collect()
    }

    #[test]
    fn boundaries_in_order() {
        let square = boundary(&["....", ".##.", ".##.", "...#"]);
        assert_eq!(square, [[1., 1.], [2., 1.], [2., 2.], [3., 3.], [2., 2.], [1., 2.]], "with a tail, there and back");
        assert_eq!(boundary(&["###", "#.#", "###"]).len(), 8, "the hole does not count");
        assert_eq!(boundary(&["#..", "...", ".##"]), [[1., 2.], [2., 2.]], "the largest part, up to the rim");
        assert_eq!(boundary(&["...", ".#."]), [[1., 1.]], "a lone pixel");
        assert!(boundary(&["..", ".."]).is_empty(), "nothing");
    }

    #[test]
    fn images() {
        let png = |shades: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
            encoder.set_color(png::ColorType::Grayscale);
            encoder.write_header().and_then(|mut w| w.write_image_data(shades)).expect("written");
            bytes
        };
        let mut dark = [9; 16];
        let mut light = [200; 16];
        for i in [5, 6, 9, 10] {
            dark[i] = 180;
            light[i] = 0;
        }
        for shades in [dark, light] {
            let outline = Outline::of_png(&png(&shades), "a/b.png").expect("an outline");
            assert_eq!(outline.name, "b");
            let Shape::Pixels(points) = outline.shape else { panic!("pixels") };
            assert_eq!(points.len(), 4, "the square, whichever shade it has");
        }
        assert!(Outline::of_png(&png(&[3; 16]), "x").is_err(), "one shade");
        assert!(Outline::of_png(b"GIF", "x").is_err(), "no PNG");
    }

    #[test]
    fn steps_of_equal_length() {
        let square = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]].map(|[x, y]| Point::new(x, y));
        let points = equal_steps(&square, 1.02);
        assert_eq!(points.len(), 12, "rounded to a whole number");
        assert!(points[5].distance(&Point::new(3.0, 2.0)) < 1e-12, "{:?}", points[5]);
    }
}
