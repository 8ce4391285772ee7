//! The `d` attribute of `path`.
//!
//! `svgtypes` takes the text apart (implicit repeats, numbers run together, arc flags without separators); this file
//! gives each command its meaning: relative coordinates, reflected handles, the point after a close. Relative
//! commands add up in f64 as they stand, in the order of the document, as all programs do.

use svgtypes::{PathParser, PathSegment};

use super::arc::ArcShape;
use super::fault::Fault;
use super::outline::Outline;

/// The handle that a following smooth command reflects.
enum Handle {
    None,
    Cubic((f64, f64)),
    Quadratic((f64, f64)),
}

/// Draws path data with the pen; stops at the first error.
pub(super) fn trace(data: &str, pen: &mut Outline<'_>) -> Result<(), Fault> {
    // CSS knows the value `none`: no path.
    if data.trim() == "none" {
        return Ok(());
    }
    let mut handle = Handle::None;
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|error| Fault::from_svgtypes(error, data))?;
        handle = draw(segment, pen, &handle);
    }
    Ok(())
}

fn draw(segment: PathSegment, pen: &mut Outline<'_>, before: &Handle) -> Handle {
    let here = pen.here();
    let place = |abs: bool, x: f64, y: f64| if abs { (x, y) } else { (here.0 + x, here.1 + y) };
    let mirror = |(x, y): (f64, f64)| (2.0 * here.0 - x, 2.0 * here.1 - y);
    match segment {
        PathSegment::MoveTo { abs, x, y } => pen.move_to(place(abs, x, y)),
        PathSegment::LineTo { abs, x, y } => pen.line_to(place(abs, x, y)),
        PathSegment::HorizontalLineTo { abs, x } => pen.line_to((place(abs, x, 0.0).0, here.1)),
        PathSegment::VerticalLineTo { abs, y } => pen.line_to((here.0, place(abs, 0.0, y).1)),
        PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
            let second = place(abs, x2, y2);
            pen.cubic_to(place(abs, x1, y1), second, place(abs, x, y));
            return Handle::Cubic(second);
        }
        PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
            let first = if let Handle::Cubic(handle) = before { mirror(*handle) } else { here };
            let second = place(abs, x2, y2);
            pen.cubic_to(first, second, place(abs, x, y));
            return Handle::Cubic(second);
        }
        PathSegment::Quadratic { abs, x1, y1, x, y } => {
            let control = place(abs, x1, y1);
            pen.quadratic_to(control, place(abs, x, y));
            return Handle::Quadratic(control);
        }
        PathSegment::SmoothQuadratic { abs, x, y } => {
            let control = if let Handle::Quadratic(handle) = before { mirror(*handle) } else { here };
            pen.quadratic_to(control, place(abs, x, y));
            return Handle::Quadratic(control);
        }
        PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
            let shape = ArcShape { rx, ry, rotation: x_axis_rotation, large: large_arc, sweep };
            pen.arc_to(&shape, place(abs, x, y));
        }
        PathSegment::ClosePath { .. } => pen.close(),
    }
    Handle::None
}

#[cfg(test)]
mod tests {
    use feature_sampling::bezier::Cubic;
    use feature_sampling::geometry::Point;

    use super::super::outline::{PenError, Subpath};
    use super::super::transform::Affine;
    use super::*;

    fn subpaths(data: &str) -> Vec<Subpath> {
        let mut pen = Outline::new(&Affine::IDENTITY);
        trace(data, &mut pen).unwrap();
        pen.finish().unwrap()
    }

    fn fault(data: &str) -> (Option<usize>, String) {
        let fault = trace(data, &mut Outline::new(&Affine::IDENTITY)).unwrap_err();
        (fault.at, fault.cause)
    }

    /// End points in order, starts of subpaths first.
    fn corners(data: &str) -> Vec<Vec<(f64, f64)>> {
        let xy = |p: &Point<f64>| (p.x, p.y);
        subpaths(data)
            .iter()
            .map(|s| std::iter::once(xy(s.cubics[0].start())).chain(s.cubics.iter().map(|c| xy(c.end()))).collect())
            .collect()
    }

    fn cubic(x: [f64; 8]) -> Cubic<f64> {
        Cubic::new(Point::new(x[0], x[1]), Point::new(x[2], x[3]), Point::new(x[4], x[5]), Point::new(x[6], x[7]))
    }

    #[test]
    fn lines_in_all_spellings() {
        let expected = vec![vec![(1.0, 2.0), (4.0, 6.0), (9.0, 6.0), (9.0, 1.0)]];
        assert_eq!(corners("M 1 2 L 4 6 H 9 V 1"), expected);
        assert_eq!(corners("m 1 2 l 3 4 h 5 v -5"), expected);
        assert_eq!(corners("M1,2 4,6 9,6 9,1"), expected);
        assert_eq!(corners("m1 2 3 4 5 0 0-5"), expected);
        assert_eq!(corners("M1 2L4 6H3 9V8 1").first().map(Vec::len), Some(6), "repeats of H and V");
        assert_eq!(corners("M+1e0 .2e1L40e-1 6.H9V1."), expected);
    }

    #[test]
    fn a_line_is_raised_in_thirds() {
        assert_eq!(subpaths("M0 0L3 6")[0].cubics, [cubic([0.0, 0.0, 1.0, 2.0, 2.0, 4.0, 3.0, 6.0])]);
    }

    #[test]
    fn cubics_and_their_smooth_kin() {
        let first = cubic([0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let second = cubic([5.0, 6.0, 7.0, 8.0, 9.0, 9.0, 10.0, 10.0]);
        for data in ["M0 0C1 2 3 4 5 6S9 9 10 10", "m0 0c1 2 3 4 5 6s4 3 5 4", "M0 0C1 2 3 4 5 6 7 8 9 9 10 10"] {
            assert_eq!(subpaths(data)[0].cubics, [first, second], "{data}");
        }
        // Nothing to reflect after a line or a quadratic.
        assert_eq!(subpaths("M0 0H3S9 9 10 10")[0].cubics[1].points[1], Point::new(3.0, 0.0));
        assert_eq!(subpaths("M0 0Q1 2 3 0S9 9 10 10")[0].cubics[1].points[1], Point::new(3.0, 0.0));
    }

    #[test]
    fn quadratics_and_their_smooth_kin() {
        let q = |a: (f64, f64), c: (f64, f64), b: (f64, f64)| {
            Cubic::quadratic(Point::new(a.0, a.1), &Point::new(c.0, c.1), Point::new(b.0, b.1))
        };
        let expected = [
            q((0.0, 0.0), (3.0, 3.0), (6.0, 0.0)),
            q((6.0, 0.0), (9.0, -3.0), (12.0, 0.0)),
            q((12.0, 0.0), (15.0, 3.0), (18.0, 0.0)),
        ];
        for data in ["M0 0Q3 3 6 0T12 0 18 0", "m0 0q3 3 6 0t6 0 6 0", "M0 0Q3 3 6 0 9-3 12 0 15 3 18 0"] {
            assert_eq!(subpaths(data)[0].cubics, expected, "{data}");
        }
        // With no quadratic before, T draws a line: its control is the point itself.
        assert_eq!(subpaths("M1 1T4 1")[0].cubics, [q((1.0, 1.0), (1.0, 1.0), (4.0, 1.0))]);
    }

    #[test]
    fn arcs_with_flags_run_together() {
        let spaced = subpaths("M0 0A 1 1 0 0 1 2 0 A 1 1 0 1 0 4 0");
        assert_eq!(spaced[0].cubics.len(), 4);
        assert_eq!(subpaths("M0 0A1 1 0 012 0A1,1,0,1,0,4,0"), spaced);
        assert_eq!(subpaths("m0 0a1 1 0 012 0 1 1 0 102 0"), spaced);
        let top = spaced[0].cubics[0].end();
        assert!((top.x - 1.0).abs() < 1e-15 && (top.y + 1.0).abs() < 1e-15, "{top:?}");
        // By definition: a line where a radius is 0, nothing where the arc ends at its start.
        assert_eq!(subpaths("M0 0A0 1 0 0 1 3 6"), subpaths("M0 0L3 6"));
        assert_eq!(subpaths("M0 0A1 1 0 0 1 0 0"), []);
    }

    #[test]
    fn closing_and_going_on() {
        let paths = subpaths("M1 1h2v2zl5 5zm1 1h1");
        assert_eq!(paths.iter().map(|s| s.closed).collect::<Vec<_>>(), [true, true, false]);
        assert_eq!(
            corners("M1 1h2v2zl5 5zm1 1h1"),
            [
                vec![(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 1.0)],
                vec![(1.0, 1.0), (6.0, 6.0), (1.0, 1.0)],
                vec![(2.0, 2.0), (3.0, 2.0)],
            ]
        );
    }

    #[test]
    fn the_closing_line_is_kept_however_short() {
        assert_eq!(subpaths("M0 0H1V1L0 0Z")[0].cubics.len(), 3, "no line where the end is the start");
        assert_eq!(subpaths("M0 0H1V1L1e-16 0Z")[0].cubics.len(), 4);
        let sum = subpaths("m.1.1h.2h-.2z");
        assert_eq!(sum[0].cubics.last().map(|c| *c.end()), Some(Point::new(0.1, 0.1)));
    }

    #[test]
    fn subpaths_that_draw_nothing_leave_no_trace() {
        assert_eq!(subpaths(""), []);
        assert_eq!(subpaths("none"), []);
        assert_eq!(subpaths("M1 1"), []);
        assert_eq!(subpaths("M1 1z"), []);
        assert_eq!(subpaths("M1 1M2 2m3 3h1").len(), 1);
        assert_eq!(corners("M1 1zh1"), [vec![(1.0, 1.0), (2.0, 1.0)]]);
    }

    #[test]
    fn malformed_data_say_where() {
        assert_eq!(fault("L 1 1"), (Some(0), "unexpected “L 1 1”".to_owned()));
        assert_eq!(fault("M 0 0 L 1 x"), (Some(10), "not a finite number: “x”".to_owned()));
        assert_eq!(fault("M 0 0 L NaN 1").0, Some(8));
        assert_eq!(fault("M 0 0 L inf 1").0, Some(8));
        assert_eq!(fault("M 0 0 L 1e999 1"), (Some(8), "not a finite number: “1e999 1”".to_owned()));
        assert_eq!(fault("M 0 0 C 1 2 3 4 5"), (Some(17), "ends in the middle".to_owned()));
        assert_eq!(fault("M 0 0 L 1").1, "ends in the middle");
        assert_eq!(fault("M 0 0 A 1 1 0 2 1 3 3").0, Some(14), "a flag is 0 or 1");
        assert_eq!(fault("M 0 0 z 1 1").0, Some(8));
        assert_eq!(fault("M 0 0 é 1").0, Some(6));
        assert_eq!(fault("ééé"), (Some(0), "unexpected “ééé”".to_owned()));
    }

    #[test]
    fn coordinates_beyond_the_range_name_their_segment() {
        let out = |data: &str| {
            let mut pen = Outline::new(&Affine::IDENTITY);
            trace(data, &mut pen).unwrap();
            match pen.finish() {
                Err(PenError::OutOfRange(segment)) => segment,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(out("M0 0H1e300"), 1);
        assert_eq!(out("M0 0H1h1e308h1e308"), 2);
        assert_eq!(out("M1e300 0H0"), 1);
        assert_eq!(out("M0 0H1A1e300 1e300 0 1 1 5 5H9"), 2);
        assert_eq!(out("M0 0Q1e300 1e300 1 1"), 1);
    }
}
