//! Colouring: shapes whose answer is known, under every gap, scale, rotation and order of hints; and outlines against a
//! raster flood fill that knows nothing of triangles.

#[path = "common/strokes.rs"]
#[expect(dead_code, reason = "the judge of noding stays unused here")]
mod strokes;

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::{Aabb, Point};
use lineart::colour::{
    Colour, ColourError, Hint, Labels, Options, Outline, Painting, Piece, Plane, Unlabelled, colour,
};
use lineart::drawing::DrawingPath;
use lineart::node::{Chain, Options as NodeOptions};

fn drawing(paths: &[String]) -> Vec<DrawingPath> {
    let paths: String = paths.iter().map(|d| format!("<path d=\"{d}\"/>")).collect();
    let text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{paths}</svg>");
    lineart::svg::read_str(&text, "test").expect("a drawing").paths
}

/// `per` equal steps on each cubic.
fn chains(paths: &[DrawingPath], per: usize) -> Vec<Chain> {
    let chain = |(path, stroke): (usize, &DrawingPath)| {
        let last = per * stroke.cubics.len();
        let at = (0..if stroke.closed { last } else { last + 1 }).map(|i| i as f64 / per as f64).collect();
        Chain { path, closed: stroke.closed, at }
    };
    paths.iter().enumerate().map(chain).collect()
}

fn pitch(paths: &[DrawingPath]) -> NodeOptions {
    let bounds = Aabb::around(paths.iter().flat_map(|path| &path.cubics).flat_map(|cubic| &cubic.points));
    NodeOptions::for_drawing(bounds.extent().norm(), None)
}

fn hint(x: f64, y: f64, colour: &str) -> Hint {
    format!("{x},{y},{colour}").parse().expect("a hint")
}

fn plane(paths: &[DrawingPath], per: usize) -> Plane<'_> {
    Plane::new(paths, &chains(paths, per), &pitch(paths)).expect("a plane")
}

fn at(plane: &Plane<'_>, labels: &Labels, x: f64, y: f64) -> Option<String> {
    labels.at(plane, &Point::new(x, y)).map(ToString::to_string)
}

const RED: &str = "#ff0000";
const BLUE: &str = "#0000ff";

/// An arc of a circle of radius r about the origin with an opening of the given chord, turned by an angle.
fn open_circle(r: f64, gap: f64, turned: f64) -> String {
    let half = (gap / 2.0 / r).asin();
    let place = |angle: f64| format!("{} {}", r * (turned + angle).cos(), r * (turned + angle).sin());
    let middle = std::f64::consts::PI;
    let (a, b, c) = (place(half), place(middle), place(-half));
    format!("M{a}A{r} {r} 0 0 1 {b}A{r} {r} 0 0 1 {c}")
}

#[test]
fn a_circle_keeps_its_colour_through_any_gap() {
    for gap in [0.1, 0.3, 0.6, 1.0, 1.4, 1.8] {
        for per in [4, 16] {
            let paths = drawing(&[open_circle(1.0, gap, 0.4)]);
            let plane = plane(&paths, per);
            let labels = plane.label(&[hint(0.0, 0.0, "red")], &Options::default());
            let (mut wrong, mut all) = (0, 0);
            // The lid is a chord: what lies between it and the circle is outside.
            let depth = (1.0 - gap * gap / 4.0).sqrt();
            for i in -60..=60 {
                for j in -60..=60 {
                    let (x, y) = (f64::from(i) / 40.0, f64::from(j) / 40.0);
                    let inside = x * x + y * y < 0.999 && x * 0.4_f64.cos() + y * 0.4_f64.sin() < depth - 1e-3;
                    let outside = x * x + y * y > 1.001;
                    if inside || outside {
                        all += 1;
                        wrong += usize::from(at(&plane, &labels, x, y).is_some() != inside);
                    }
                }
            }
            assert!(wrong * 1000 <= all, "gap {gap}, {per} samples a cubic: {wrong} of {all} wrong");
        }
    }
}

#[test]
fn nested_circles_have_three_colours() {
    let paths = drawing(&[open_circle(1.0, 0.3, 0.0), open_circle(0.5, 0.2, 3.0)]);
    let plane = plane(&paths, 8);
    let labels = plane.label(&[hint(0.0, 0.0, "red"), hint(0.75, 0.2, "blue")], &Options::default());
    for angle in 0..36 {
        let (sin, cos) = (f64::from(angle) * 10.0).to_radians().sin_cos();
        assert_eq!(at(&plane, &labels, 0.4 * cos, 0.4 * sin).as_deref(), Some(RED), "core at {angle}");
        assert_eq!(at(&plane, &labels, 0.7 * cos, 0.7 * sin).as_deref(), Some(BLUE), "ring at {angle}");
        assert_eq!(at(&plane, &labels, 1.2 * cos, 1.2 * sin), None, "outside at {angle}");
    }
}

/// A square with a divider that ends short of the wall, moved about the plane.
fn divided(short: f64, map: impl Fn(f64, f64) -> (f64, f64)) -> Vec<String> {
    let p = |x: f64, y: f64| {
        let (x, y) = map(x, y);
        format!("{x} {y}")
    };
    let wall = format!("M{}L{}L{}L{}Z", p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0));
    vec![wall, format!("M{}L{}", p(1.0, 0.0), p(1.0, 2.0 - short))]
}

#[test]
fn a_divider_parts_its_square_wherever_and_whatever_the_order() {
    type Map = (&'static str, fn(f64, f64) -> (f64, f64));
    let maps: [Map; 6] = [
        ("as it is", |x, y| (x, y)),
        ("small", |x, y| (1e-3 * x, 1e-3 * y)),
        ("large", |x, y| (1e6 * x, 1e6 * y)),
        ("turned by 17°", |x, y| {
            let (s, c) = 17.0_f64.to_radians().sin_cos();
            (c * x - s * y, s * x + c * y)
        }),
        ("mirrored", |x, y| (-x, y)),
        ("far away", |x, y| (x + 1e4, y - 1e4)),
    ];
    for short in [0.0, 0.05, 0.2, 0.4, 1e-9, -1e-9] {
        for (name, map) in maps {
            let paths = drawing(&divided(short, map));
            let plane = plane(&paths, 8);
            let place = |x, y, colour| {
                let (x, y) = map(x, y);
                hint(x, y, colour)
            };
            let mut hints = vec![place(0.5, 1.0, "red"), place(1.5, 1.0, "blue"), place(-1.0, 1.0, "none")];
            for turn in 0..3 {
                let labels = plane.label(&hints, &Options::default());
                for (x, y) in [(0.1, 0.1), (0.9, 0.9), (0.5, 1.9), (0.05, 1.95)] {
                    let ((a, b), (c, d)) = (map(x, y), map(2.0 - x, y));
                    assert_eq!(at(&plane, &labels, a, b).as_deref(), Some(RED), "{name}, {short}, order {turn}: left");
                    assert_eq!(
                        at(&plane, &labels, c, d).as_deref(),
                        Some(BLUE),
                        "{name}, {short}, order {turn}: right"
                    );
                }
                let (a, b) = map(1.0, 2.5);
                assert_eq!(at(&plane, &labels, a, b), None, "{name}, {short}, order {turn}: outside");
                hints.rotate_left(1);
            }
        }
    }
}

#[test]
fn crossings_and_loops() {
    let cross = drawing(&["M-2 -2L2 2".into(), "M-2 2L2 -2".into(), "M-3 -3H3V3H-3Z".into()]);
    let cross_plane = plane(&cross, 8);
    let hints = [hint(-2.0, 0.0, "red"), hint(2.0, 0.0, "blue"), hint(0.0, -2.0, "#111"), hint(0.0, 2.0, "#222")];
    let labels = cross_plane.label(&hints, &Options::default());
    let sectors = [(-0.1, 0.0, RED), (0.1, 0.0, BLUE), (0.0, -0.1, "#111111"), (0.0, 0.1, "#222222")];
    for (x, y, colour) in sectors {
        assert_eq!(at(&cross_plane, &labels, x, y).as_deref(), Some(colour), "a sector near the crossing");
    }
    let eight = drawing(&["M0 0C4 4 4 -4 0 0C-4 4 -4 -4 0 0Z".into()]);
    let eight_plane = plane(&eight, 8);
    let labels = eight_plane.label(&[hint(1.5, 0.0, "red"), hint(-1.5, 0.0, "blue")], &Options::default());
    assert_eq!(at(&eight_plane, &labels, 0.1, 0.0).as_deref(), Some(RED), "one loop");
    assert_eq!(at(&eight_plane, &labels, -0.1, 0.0).as_deref(), Some(BLUE), "the other");
    assert_eq!(at(&eight_plane, &labels, 0.0, 1.0), None, "neither");
}

#[test]
fn a_dangling_stroke_makes_no_hole() {
    let paths = drawing(&["M0 0H4V4H0Z".into(), "M1 2H3".into(), "M4 1H3.5".into()]);
    let painting = paint(&paths, 8, &[hint(0.5, 0.5, "red")], &Options::default());
    let red: Vec<_> = painting.regions.iter().filter(|region| region.colour.is_some()).collect();
    assert_eq!(red.len(), 1, "one region");
    assert_eq!(red[0].outlines.len(), 1, "without a hole");
    assert!((red[0].area - 16.0).abs() < 1e-4, "of the whole square");
}

#[test]
fn without_outside_a_sealed_shape_still_keeps_its_colour() {
    let paths = drawing(&["M0 0H4V4H0Z".into(), "M9 0H13V4H9Z".into()]);
    for per in [1, 2, 16] {
        let plane = plane(&paths, per);
        let labels = plane.label(&[hint(1.0, 1.0, "red")], &Options { outside: false, ..Options::default() });
        assert_eq!(at(&plane, &labels, 3.0, 3.0).as_deref(), Some(RED), "inside");
        assert_eq!(at(&plane, &labels, 6.0, 2.0), None, "no leak");
        assert_eq!(at(&plane, &labels, 10.0, 2.0), None, "not into the other");
    }
}

#[test]
fn scribbles_none_and_conflicts() {
    let paths = drawing(&["M0 0H4V4H0Z".into(), "M2 0V4".into()]);
    let plane = plane(&paths, 8);
    let scribble = Hint { points: vec![Point::new(1.0, 1.0), Point::new(3.0, 2.0)], colour: Colour::named("red") };
    let labels = plane.label(std::slice::from_ref(&scribble), &Options::default());
    assert_eq!(at(&plane, &labels, 0.5, 3.5).as_deref(), Some(RED), "one side");
    assert_eq!(at(&plane, &labels, 3.5, 3.5).as_deref(), Some(RED), "and the other");
    let both = [hint(1.0, 1.0, "red"), hint(1.0, 1.0, "blue")];
    let labels = plane.label(&both, &Options::default());
    assert_eq!(at(&plane, &labels, 0.5, 3.5).as_deref(), Some(BLUE), "the later one holds");
    assert_eq!(plane.finish(&labels, &both).warnings.len(), 1, "and the user is told");
    let labels = plane.label(&[hint(1.0, 1.0, "red"), hint(3.0, 1.0, "none")], &Options::default());
    assert_eq!(at(&plane, &labels, 3.5, 3.5), None, "kept empty");
    let on_stroke = [hint(2.0, 1.0, "red")];
    let painting = plane.finish(&plane.label(&on_stroke, &Options::default()), &on_stroke);
    assert!(painting.warnings.iter().any(|w| w.contains("on a stroke")), "a hint on a stroke is named");
}

#[test]
fn rooms_without_hints() {
    // Two rooms with a door of 0.5 between them and a sealed third.
    let rooms = ["M0 0H4V4H0Z".to_owned(), "M2 0V1.75".into(), "M2 4V2.25".into(), "M5 0H7V4H5Z".into()];
    let paths = drawing(&rooms);
    let plane = plane(&paths, 16);
    let one = [hint(1.0, 1.0, "red")];
    let labels = plane.label(&one, &Options::default());
    assert_eq!(at(&plane, &labels, 3.0, 1.0).as_deref(), Some(RED), "through the door, nobody else wants it");
    assert_eq!(at(&plane, &labels, 6.0, 1.0), None, "not into the sealed room");
    let labels = plane.label(&one, &Options { max_gap: 0.6, ..Options::default() });
    assert_eq!(at(&plane, &labels, 3.0, 1.0), None, "the door is taken for closed");
    assert_eq!(at(&plane, &labels, 1.9, 3.9).as_deref(), Some(RED), "corners of the own room are not");
    let labels = plane.label(&one, &Options { unlabelled: Unlabelled::Auto, ..Options::default() });
    assert!(at(&plane, &labels, 6.0, 1.0).is_some(), "found without a hint");
    let labels = plane.label(&[], &Options::default());
    let found = [(1.0, 1.0), (3.0, 1.0), (6.0, 1.0), (-1.0, 1.0)].map(|(x, y)| at(&plane, &labels, x, y));
    assert!(found[..3].iter().all(Option::is_some), "three rooms: {found:?}");
    assert_ne!(found[0], found[1], "neighbours differ");
    assert_eq!(found[3], None, "and outside");
}

#[test]
fn nothing_to_colour() {
    let paths = drawing(&["M0 0H1".into()]);
    let none = colour(&paths, &[], &pitch(&paths), &[], &Options::default());
    assert_eq!(none, Err(ColourError::Empty), "no chain");
}

fn paint(paths: &[DrawingPath], per: usize, hints: &[Hint], options: &Options) -> Painting {
    colour(paths, &chains(paths, per), &pitch(paths), hints, options).expect("coloured")
}

/// Outlines as polygons, 64 chords to a cubic.
fn polygons(outlines: &[Outline]) -> Vec<Vec<Point<f64>>> {
    let polygon = |outline: &Outline| {
        let mut points = vec![outline.start];
        for piece in &outline.pieces {
            match piece {
                Piece::Line(p) => points.push(*p),
                Piece::Cubic(cubic) => points.extend((1..=64).map(|i| cubic.eval(&(f64::from(i) / 64.0)))),
            }
        }
        points
    };
    outlines.iter().map(polygon).collect()
}

fn fills(polygons: &[Vec<Point<f64>>], x: f64, y: f64) -> bool {
    let crosses =
        |a: &Point<f64>, b: &Point<f64>| (a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    let count = |polygon: &Vec<Point<f64>>| {
        polygon.iter().zip(polygon.iter().cycle().skip(1)).filter(|(a, b)| crosses(a, b)).count()
    };
    polygons.iter().map(count).sum::<usize>() % 2 == 1
}

/// Fills a closed shape by flooding pixels from a seed; walls are the pixels that the curves pass through.
fn flooded(
    paths: &[DrawingPath],
    size: usize,
    seed: (usize, usize),
    to_pixel: impl Fn(&Point<f64>) -> (usize, usize),
) -> Vec<u8> {
    let mut pixels = vec![0_u8; size * size];
    for cubic in paths.iter().flat_map(|path| &path.cubics) {
        for i in 0..=4000 {
            let (x, y) = to_pixel(&cubic.eval(&(f64::from(i) / 4000.0)));
            pixels[y * size + x] = 2;
        }
    }
    let mut stack = vec![seed];
    while let Some((x, y)) = stack.pop() {
        if pixels[y * size + x] != 0 {
            continue;
        }
        pixels[y * size + x] = 1;
        stack.extend(
            [(x + 1, y), (x.wrapping_sub(1), y), (x, y + 1), (x, y.wrapping_sub(1))]
                .into_iter()
                .filter(|(x, y)| *x < size && *y < size),
        );
    }
    pixels
}

#[test]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pixels of a small picture")]
fn outlines_agree_with_a_flood_of_pixels() {
    // A closed curvy shape, and two overlapping strokes that make a lens: 800 pixels for 100 units.
    let shapes = [
        (vec!["M50 10C90 10 95 60 70 80C50 95 30 70 20 60C0 40 20 10 50 10Z".to_owned()], (50.0, 40.0)),
        (vec!["M10 50C30 10 70 10 90 50".into(), "M10 30C30 80 70 80 90 30".into()], (50.0, 40.0)),
        (vec!["M20 20H80V80H20Z".into(), "M35 50A15 15 0 1 1 65 50A15 15 0 1 1 35 50Z".into()], (25.0, 25.0)),
    ];
    const SIZE: usize = 800;
    for (paths, (x, y)) in shapes {
        let paths = drawing(&paths);
        let to_pixel = |p: &Point<f64>| ((p.x * 8.0) as usize, (p.y * 8.0) as usize);
        let pixels = flooded(&paths, SIZE, to_pixel(&Point::new(x, y)), to_pixel);
        let painting = paint(&paths, 4, &[hint(x, y, "red")], &Options::default());
        let red: Vec<_> = painting.regions.iter().filter(|region| region.colour.is_some()).collect();
        assert_eq!(red.len(), 1, "one region");
        let polygons = polygons(&red[0].outlines);
        let (mut both, mut either) = (0, 0);
        for j in 0..SIZE {
            for i in 0..SIZE {
                // Pixels under the line belong to neither side.
                let pixel = pixels[j * SIZE + i];
                if pixel == 2 {
                    continue;
                }
                let filled = fills(&polygons, (i as f64 + 0.5) / 8.0, (j as f64 + 0.5) / 8.0);
                both += usize::from(filled && pixel == 1);
                either += usize::from(filled || pixel == 1);
            }
        }
        let share = f64::from(u32::try_from(both).expect("small")) / f64::from(u32::try_from(either).expect("small"));
        assert!(share > 0.999, "intersection over union {share}");
        assert!(either > 10_000, "something was filled");
    }
}

/// Every point lies in the outlines of one region and no more, wherever strokes cross, end on each other or lie on each
/// other.
#[test]
fn outlines_part_the_plane() {
    let mut asked = 0;
    for kind in 0..strokes::KINDS.len() {
        for seed in 0..8 {
            let (paths, chains) = strokes::strokes(kind, seed);
            let options = Options { unlabelled: Unlabelled::Auto, ..Options::default() };
            let painting = colour(&paths, &chains, &pitch(&paths), &[], &options).expect("coloured");
            let regions: Vec<_> = painting.regions.iter().map(|region| polygons(&region.outlines)).collect();
            let curves: Vec<Point<f64>> = paths
                .iter()
                .flat_map(|path| &path.cubics)
                .flat_map(|cubic| (0..=500).map(|i| cubic.eval(&(f64::from(i) / 500.0))))
                .collect();
            let mut random = strokes::Random(seed);
            for _ in 0..400 {
                let p = Point::new(1.5 * random.unit() - 0.25, 1.5 * random.unit() - 0.25);
                // Chords stand for curves here.
                if curves.iter().any(|q| p.distance(q) < 0.004) {
                    continue;
                }
                let around = regions.iter().filter(|polygons| fills(polygons, p.x, p.y)).count();
                assert_eq!(around, 1, "{}, seed {seed}: regions at {p:?}", strokes::KINDS[kind]);
                asked += 1;
            }
        }
    }
    assert!(asked > 8000, "{asked} points");
}

/// A straight closing is cut through by a far stroke that bulges beyond its chord: that stroke is sampled more densely.
#[test]
fn a_closing_stays_clear_of_bulges_from_afar() {
    // Two walls with a door between them, and a long arc with two samples only whose middle stands in the door.
    let paths = drawing(&["M0 0H10V4".into(), "M10 6V10H0Z".into(), "M4 -20C14 -20 14 30 4 30".into()]);
    for per in [1, 2, 3] {
        let painting = paint(&paths, per, &[hint(5.0, 5.0, "red"), hint(30.0, 5.0, "blue")], &Options::default());
        let polygons: Vec<_> = painting.regions.iter().map(|region| polygons(&region.outlines)).collect();
        for i in 0..60 {
            for j in 0..60 {
                let (x, y) = (f64::from(i) * 0.37 - 1.3, f64::from(j) * 0.83 - 19.7);
                let on_curve = (0..=400)
                    .any(|k| paths[2].cubics[0].eval(&(f64::from(k) / 400.0)).distance(&Point::new(x, y)) < 0.1);
                if !on_curve {
                    let around = polygons.iter().filter(|polygons| fills(polygons, x, y)).count();
                    assert_eq!(around, 1, "{per} pieces: regions at {x} {y}");
                }
            }
        }
    }
}

/// Outlines are pieces of the drawing's cubics, and regions that meet share their corners to the bit.
#[test]
fn outlines_are_the_cubics_of_the_drawing() {
    let paths = drawing(&["M10 50C30 10 70 10 90 50C95 60 5 60 10 50Z".into(), "M50 0L50 90".into()]);
    let painting = paint(&paths, 8, &[hint(30.0, 45.0, "red"), hint(70.0, 45.0, "blue")], &Options::default());
    let corners = |colour: &str| -> Vec<Point<f64>> {
        let region = painting.regions.iter().find(|r| r.colour.as_ref().is_some_and(|c| c.to_string() == colour));
        let region = region.expect("a region");
        assert_eq!(region.outlines.len(), 1, "one loop");
        let mut ends = Vec::new();
        for piece in &region.outlines[0].pieces {
            match piece {
                Piece::Line(p) => ends.push(*p),
                Piece::Cubic(cubic) => {
                    on_curve(&paths[0].cubics, cubic);
                    ends.push(*cubic.end());
                }
            }
        }
        assert!(
            region.outlines[0].pieces.len() <= 4,
            "whole cubics, not chords: {:?}",
            region.outlines[0].pieces.len()
        );
        ends.into_iter().filter(|p| (p.x - 50.0).abs() < 1e-3).collect()
    };
    let (mut left, mut right) = (corners(RED), corners(BLUE));
    let by = |a: &Point<f64>, b: &Point<f64>| a.y.total_cmp(&b.y);
    left.sort_by(by);
    right.sort_by(by);
    assert_eq!(left.len(), 2, "two corners on the divider");
    assert_eq!(left, right, "shared to the bit");
}

/// Every point of a cubic lies on one of the given ones.
fn on_curve(cubics: &[Cubic<f64>], part: &Cubic<f64>) {
    for i in 0..=10 {
        let p = part.eval(&(f64::from(i) / 10.0));
        let near = |cubic: &Cubic<f64>| {
            (0..=20_000).map(|j| cubic.eval(&(f64::from(j) / 20_000.0)).distance(&p)).fold(f64::INFINITY, f64::min)
        };
        assert!(cubics.iter().map(near).fold(f64::INFINITY, f64::min) < 5e-3, "{p:?} is off the drawing");
    }
}
