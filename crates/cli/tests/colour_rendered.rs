//! Coloured drawings as a renderer that is not ours shows them.
//!
//! The outlines of a drawing are drawn as thin strokes and rendered by `resvg`. Every white area of that picture is a room,
//! closed or as good as closed; each gets a hint of its own colour at its deepest pixel. Then the picture of what `fsample
//! colour` makes of drawing and hints must show each room in its colour, and no colour elsewhere.

mod common;

use std::fmt::Write;
use std::path::Path;

use common::Place;
use lineart::drawing::Drawing;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg;

/// Pixels along the longer side: eight times 256.
const SIZE: f64 = 8.0 * 256.0;
/// Rooms of fewer pixels get no hint.
const SMALL: usize = 400;

/// A picture on white.
fn render(svg: &str) -> Pixmap {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).expect("an SVG document");
    let mut picture = Pixmap::new(tree.size().to_int_size().width(), tree.size().to_int_size().height()).expect("room");
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::identity(), &mut picture.as_mut());
    picture
}

/// A drawing's curves as strokes five pixels wide, in a picture of `SIZE`.
fn strokes(drawing: &Drawing) -> String {
    let [mut min, mut max] = [[f64::INFINITY; 2], [-f64::INFINITY; 2]];
    for p in drawing.paths.iter().flat_map(|path| &path.cubics).flat_map(|cubic| &cubic.points) {
        (min, max) = ([min[0].min(p.x), min[1].min(p.y)], [max[0].max(p.x), max[1].max(p.y)]);
    }
    let extent = (max[0] - min[0]).max(max[1] - min[1]);
    let border = 0.05 * extent;
    let [width, height] = [0, 1].map(|i| max[i] - min[i] + 2.0 * border);
    let scale = SIZE / width.max(height);
    let mut text = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{:.0}" height="{:.0}" viewBox="{} {} {width} {height}">
<g fill="none" stroke="black" stroke-width="{}">
"#,
        width * scale,
        height * scale,
        min[0] - border,
        min[1] - border,
        5.0 / scale
    );
    for path in &drawing.paths {
        let start = path.cubics[0].start();
        let _ = write!(text, r#"<path d="M{} {}"#, start.x, start.y);
        for cubic in &path.cubics {
            let [_, a, b, c] = &cubic.points;
            let _ = write!(text, "C{} {} {} {} {} {}", a.x, a.y, b.x, b.y, c.x, c.y);
        }
        let _ = writeln!(text, r#"{}"/>"#, if path.closed { "Z" } else { "" });
    }
    text + "</g>\n</svg>\n"
}

/// White areas: the room of each pixel (from 1; 0 for strokes), and the deepest pixel of each room with its size.
fn rooms(picture: &Pixmap) -> (Vec<usize>, Vec<(usize, usize)>) {
    let (width, pixels) = (picture.width() as usize, picture.pixels());
    let is_white = |i: usize| [pixels[i].red(), pixels[i].green(), pixels[i].blue()] == [255; 3];
    let around = |i: usize| {
        let (x, y) = (i % width, i / width);
        let inside = [x > 0, x + 1 < width, y > 0, i + width < pixels.len()];
        [i.wrapping_sub(1), i + 1, i.wrapping_sub(width), i + width]
            .into_iter()
            .zip(inside)
            .filter_map(|(j, ok)| ok.then_some(j))
            .collect::<Vec<_>>()
    };
    // Steps to the nearest stroke, by a wave from all strokes at once.
    let mut depth: Vec<usize> = (0..pixels.len()).map(|i| if is_white(i) { usize::MAX } else { 0 }).collect();
    let mut wave: Vec<usize> = (0..pixels.len()).filter(|&i| !is_white(i)).collect();
    let mut at = 0;
    while let Some(&i) = wave.get(at) {
        for j in around(i) {
            if depth[j] == usize::MAX {
                depth[j] = depth[i] + 1;
                wave.push(j);
            }
        }
        at += 1;
    }
    let mut room = vec![0; pixels.len()];
    let mut found = Vec::new();
    for start in 0..pixels.len() {
        if room[start] != 0 || !is_white(start) {
            continue;
        }
        let number = found.len() + 1;
        room[start] = number;
        let mut stack = vec![start];
        let (mut deepest, mut count) = (start, 0);
        while let Some(i) = stack.pop() {
            count += 1;
            if depth[i] > depth[deepest] {
                deepest = i;
            }
            for j in around(i) {
                if room[j] == 0 && is_white(j) {
                    room[j] = number;
                    stack.push(j);
                }
            }
        }
        found.push((deepest, count));
    }
    (room, found)
}

/// A colour for a number below 250·250, none of them white. All are as blue as can be, so that none of them is another one
/// with a little of a black stroke over it.
fn colour(number: usize) -> [u8; 3] {
    let byte = |n: usize| u8::try_from(n).expect("below 256");
    [byte(number * 83 % 251), byte(number / 251), 255]
}

/// A room with a hint.
#[derive(Debug)]
struct Filled {
    /// Intersection over union of its pixels with those of its colour.
    share: f64,
    /// Curves alone bound it. Otherwise its strokes leave a gap that their width has closed in the picture.
    closed: bool,
}

/// Every room of a drawing that is large enough for a hint.
fn filled(drawing: &Drawing) -> Vec<Filled> {
    let art = strokes(drawing);
    let picture = render(&art);
    let (room, found) = rooms(&picture);
    let view: Vec<f64> = art
        .split("viewBox=\"")
        .nth(1)
        .and_then(|rest| rest.split('"').next())
        .map(|numbers| numbers.split(' ').map(|n| n.parse().expect("a number")).collect())
        .expect("a view box");
    let width = picture.width() as usize;
    let unit = view[2] / f64::from(picture.width());
    let mut hints = String::from("x,y,colour\n");
    for (number, (pixel, count)) in found.iter().enumerate() {
        if *count >= SMALL {
            let [r, g, b] = colour(number + 1);
            let place = |i: usize, from: f64| from + (i as f64 + 0.5) * unit;
            let (x, y) = (place(pixel % width, view[0]), place(pixel / width, view[1]));
            let _ = writeln!(hints, "{x},{y},#{r:02x}{g:02x}{b:02x}");
        }
    }
    let place = Place::new();
    place.put("art.svg", &art);
    place.put("hints.csv", &hints);
    let run = place.run("colour art.svg --hints hints.csv --no-outside --quiet -o out.svg --report out.json");
    assert_eq!(run.code, 0, "{}", run.err);
    let coloured = render(&place.get("out.svg"));
    let is_large = |number: usize| number > 0 && found[number - 1].1 >= SMALL;
    let (mut both, mut either) = (vec![0_u32; found.len() + 1], vec![0_u32; found.len() + 1]);
    let by_colour: std::collections::HashMap<[u8; 3], usize> = (1..=found.len()).map(|n| (colour(n), n)).collect();
    for (pixel, &room) in coloured.pixels().iter().zip(&room) {
        // What is too small for a hint takes any colour, or none.
        if room > 0 && !is_large(room) {
            continue;
        }
        let shown = by_colour.get(&[pixel.red(), pixel.green(), pixel.blue()]).copied().unwrap_or(0);
        if shown == room {
            both[room] += 1;
            either[room] += 1;
        } else {
            either[room] += 1;
            either[shown] += 1;
        }
    }
    let report: serde_json::Value = serde_json::from_str(&place.get("out.json")).expect("JSON");
    let open: Vec<&str> = report["regions"]
        .as_array()
        .expect("regions")
        .iter()
        .filter(|region| region["gaps"].as_array().is_some_and(|gaps| !gaps.is_empty()))
        .filter_map(|region| region["colour"].as_str())
        .collect();
    let name = |n: usize| colour(n).iter().fold(String::from("#"), |text, byte| text + &format!("{byte:02x}"));
    (1..=found.len())
        .filter(|n| is_large(*n))
        .map(|n| Filled { share: f64::from(both[n]) / f64::from(either[n]), closed: !open.contains(&name(n).as_str()) })
        .collect()
}

/// At least so many closed rooms, and the same filled.
#[track_caller]
fn every_room_is_filled(name: &str, least: usize) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings").join(name);
    let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let filled = filled(&lineart::svg::read_str(&text, name).expect("a drawing"));
    let closed = filled.iter().filter(|room| room.closed).count();
    assert!(closed >= least, "{name}: {closed} closed rooms of {}", filled.len());
    for room in filled {
        // Where a gap is narrower than the strokes, the picture does not show on which side of it colours meet.
        assert!(room.share > if room.closed { 0.999 } else { 0.95 }, "{name}: {room:?}");
    }
}

#[test]
fn bee() {
    every_room_is_filled("bee.svg", 20);
}

#[test]
fn triskell() {
    every_room_is_filled("celtic_triskell_01.svg", 5);
}

#[test]
fn elephant() {
    every_room_is_filled("elephant_outline_matthe_r.svg", 2);
}

#[test]
fn hand() {
    every_room_is_filled("hand_dennis_rutjes_01.svg", 2);
}

#[test]
fn seal() {
    every_room_is_filled("seal_sek_.svg", 4);
}

#[test]
fn cat() {
    every_room_is_filled("sleeping_cat_ron_golan_01.svg", 3);
}
