//! Basic shapes: rect, circle, ellipse, line, polyline, polygon.
//!
//! Each is drawn as its equivalent path in chapter 10 of SVG 2, from the same starting point in the same direction,
//! with one difference that no eye can see: quarter ellipses are written with the exact quadrant points and the
//! handle constant of [`super::arc`] instead of going through the arc command's centre and angles.

use svgtypes::NumberListParser;

use super::arc::QUARTER_HANDLE;
use super::fault::Fault;
use super::outline::Outline;

/// A full ellipse from its rightmost point, first towards larger y.
pub(super) fn ellipse(pen: &mut Outline<'_>, (cx, cy): (f64, f64), (rx, ry): (f64, f64)) {
    let (hx, hy) = (rx * QUARTER_HANDLE, ry * QUARTER_HANDLE);
    let (right, bottom, left, top) = ((cx + rx, cy), (cx, cy + ry), (cx - rx, cy), (cx, cy - ry));
    pen.move_to(right);
    pen.cubic_to((right.0, cy + hy), (cx + hx, bottom.1), bottom);
    pen.cubic_to((cx - hx, bottom.1), (left.0, cy + hy), left);
    pen.cubic_to((left.0, cy - hy), (cx - hx, top.1), top);
    pen.cubic_to((cx + hx, top.1), (right.0, cy - hy), right);
    pen.close();
}

/// A rectangle, its corners rounded with quarter ellipses where both radii are positive. Radii are at most half the
/// sides; sides that rounding uses up leave no line.
pub(super) fn rect(pen: &mut Outline<'_>, (x, y): (f64, f64), (w, h): (f64, f64), (rx, ry): (f64, f64)) {
    let (right, bottom) = (x + w, y + h);
    if rx == 0.0 || ry == 0.0 {
        pen.move_to((x, y));
        pen.line_to((right, y));
        pen.line_to((right, bottom));
        pen.line_to((x, bottom));
        pen.close();
        return;
    }
    let (kx, ky) = (rx * (1.0 - QUARTER_HANDLE), ry * (1.0 - QUARTER_HANDLE));
    let side = |pen: &mut Outline<'_>, to: (f64, f64), remains: bool| {
        if remains {
            pen.line_to(to);
        }
    };
    let (wide, high) = (w > 2.0 * rx, h > 2.0 * ry);
    // Where nothing remains of a side its two ends must be the same point to the bit.
    let (x1, x2) = if wide { (x + rx, right - rx) } else { (x + w / 2.0, x + w / 2.0) };
    let (y1, y2) = if high { (y + ry, bottom - ry) } else { (y + h / 2.0, y + h / 2.0) };
    pen.move_to((x1, y));
    side(pen, (x2, y), wide);
    pen.cubic_to((right - kx, y), (right, y + ky), (right, y1));
    side(pen, (right, y2), high);
    pen.cubic_to((right, bottom - ky), (right - kx, bottom), (x2, bottom));
    side(pen, (x1, bottom), wide);
    pen.cubic_to((x + kx, bottom), (x, bottom - ky), (x, y2));
    side(pen, (x, y1), high);
    pen.cubic_to((x, y + ky), (x + kx, y), (x1, y));
    pen.close();
}

/// A chain of straight lines; `points` as in `polyline` and `polygon`.
pub(super) fn poly(pen: &mut Outline<'_>, points: &str, closed: bool) -> Result<(), Fault> {
    let mut numbers = NumberListParser::from(points);
    let mut first = true;
    while let Some(x) = numbers.next() {
        let x = x.map_err(|error| Fault::from_svgtypes(error, points))?;
        let y = numbers.next().ok_or_else(|| Fault::new("an odd number of coordinates"))?;
        let y = y.map_err(|error| Fault::from_svgtypes(error, points))?;
        if first {
            pen.move_to((x, y));
        } else {
            pen.line_to((x, y));
        }
        first = false;
    }
    if closed {
        pen.close();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use feature_sampling::geometry::Point;

    use super::super::outline::Subpath;
    use super::super::transform::Affine;
    use super::*;

    fn drawn(draw: impl FnOnce(&mut Outline<'_>)) -> Subpath {
        let mut pen = Outline::new(&Affine::IDENTITY);
        draw(&mut pen);
        let mut subpaths = pen.finish().unwrap();
        assert_eq!(subpaths.len(), 1);
        let subpath = subpaths.remove(0);
        for pair in subpath.cubics.windows(2) {
            assert_eq!(pair[0].end(), pair[1].start());
        }
        if subpath.closed {
            assert_eq!(subpath.cubics.last().map(|c| c.end()), subpath.cubics.first().map(|c| c.start()));
        }
        subpath
    }

    #[test]
    fn an_ellipse_is_four_cubics() {
        let e = drawn(|pen| ellipse(pen, (1.0, 2.0), (3.0, 4.0)));
        assert!(e.closed);
        let starts: Vec<_> = e.cubics.iter().map(|c| (c.start().x, c.start().y)).collect();
        assert_eq!(starts, [(4.0, 2.0), (1.0, 6.0), (-2.0, 2.0), (1.0, -2.0)]);
        assert_eq!(e.cubics[0].points[1], Point::new(4.0, 2.0 + 4.0 * QUARTER_HANDLE));
        assert_eq!(e.cubics[0].points[2], Point::new(1.0 + 3.0 * QUARTER_HANDLE, 6.0));
        // The middle of each quarter lies on the ellipse.
        for c in &e.cubics {
            let p = c.eval(&0.5);
            let on = ((p.x - 1.0) / 3.0).powi(2) + ((p.y - 2.0) / 4.0).powi(2);
            assert!((on - 1.0).abs() < 1e-14, "{on}");
        }
    }

    #[test]
    fn a_plain_rectangle_is_four_lines() {
        let r = drawn(|pen| rect(pen, (1.0, 2.0), (3.0, 4.0), (0.0, 1.0)));
        assert!(r.closed);
        let starts: Vec<_> = r.cubics.iter().map(|c| (c.start().x, c.start().y)).collect();
        assert_eq!(starts, [(1.0, 2.0), (4.0, 2.0), (4.0, 6.0), (1.0, 6.0)]);
    }

    #[test]
    fn a_rounded_rectangle_is_lines_and_quarters() {
        let r = drawn(|pen| rect(pen, (0.0, 0.0), (10.0, 6.0), (2.0, 1.0)));
        let starts: Vec<_> = r.cubics.iter().map(|c| (c.start().x, c.start().y)).collect();
        let expected =
            [(2.0, 0.0), (8.0, 0.0), (10.0, 1.0), (10.0, 5.0), (8.0, 6.0), (2.0, 6.0), (0.0, 5.0), (0.0, 1.0)];
        assert_eq!(starts, expected);
        let corner = r.cubics[1].eval(&0.5);
        let on = ((corner.x - 8.0) / 2.0).powi(2) + (corner.y - 1.0).powi(2);
        assert!((on - 1.0).abs() < 1e-14, "{on}");
    }

    #[test]
    fn rounding_that_uses_up_the_sides_leaves_no_line() {
        assert_eq!(drawn(|pen| rect(pen, (0.1, 0.2), (0.3, 0.7), (0.15, 0.35))).cubics.len(), 4);
        assert_eq!(drawn(|pen| rect(pen, (0.1, 0.2), (0.3, 0.7), (0.15, 0.1))).cubics.len(), 6);
    }

    #[test]
    fn chains_of_points() {
        assert_eq!(drawn(|pen| poly(pen, "0,0 1,0 1-1", false).unwrap()).cubics.len(), 2);
        assert_eq!(drawn(|pen| poly(pen, " 0 0\n1 0\t1 1 ", true).unwrap()).cubics.len(), 3);
        assert_eq!(drawn(|pen| poly(pen, "0 0 1 0 1 1 0 0", true).unwrap()).cubics.len(), 3);
        let mut pen = Outline::new(&Affine::IDENTITY);
        assert_eq!(poly(&mut pen, "0 0 1", false), Err(Fault::new("an odd number of coordinates")));
        assert_eq!(poly(&mut pen, "0 0 1 x", false).unwrap_err().at, Some(6));
    }
}
