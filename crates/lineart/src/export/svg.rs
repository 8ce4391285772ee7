//! SVG: the drawing and what was found out about it, in layers.
//!
//! The picture has the `viewBox` and the physical size of the drawing, so it can be laid over it. Each part is an
//! Inkscape layer of its own, from the bottom up: *band* (capsules that hold the medial axis), *drawing* (with its groups, layers and
//! their ids as they were), *lfs* (the curve coloured by local feature size, with a legend), *medial* (medial polylines), *samples*. Widths and
//! radii are shares of the diagonal, so that a stamp and a poster look alike. All strokes are dark enough for white
//! paper.
//!
//! An id may occur once in a document. Those of the drawing come first and keep theirs; a shape repeated by `use` keeps
//! it once. Ids of our own start with `fsample-` and step aside if the drawing has them already.

use std::collections::HashSet;
use std::fmt;
use std::io::{self, Write};

use feature_sampling::bezier::Cubic;
use feature_sampling::geometry::Point;
use feature_sampling::medial::cell::Capsule;

use super::number::{Number, Readable, trimmed};
use super::palette::{self, Scale};
use super::{LfsRow, MedialRow, PathRows, SampleRow, control_box, frame};
use crate::drawing::Drawing;
use crate::stretch::{Location, pieces};

/// What goes into a picture. Rows are by path, as many as the drawing has.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// The drawing: frame, groups, curves.
    pub drawing: &'a Drawing,
    /// Show the curves themselves.
    pub show_drawing: bool,
    /// Colour the curve by these local feature sizes.
    pub lfs: Option<&'a [PathRows<LfsRow>]>,
    /// Show these medial points.
    pub medial: Option<&'a [PathRows<MedialRow>]>,
    /// Show these samples.
    pub samples: Option<&'a [PathRows<SampleRow>]>,
    /// Show this band around the medial axis.
    pub band: Option<&'a [Capsule<f64>]>,
}

impl Picture<'_> {
    /// Writes the picture.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let drawing = self.drawing;
        let groups = drawing.groups.iter().filter_map(|group| group.id.as_deref());
        let taken = groups.chain(drawing.paths.iter().filter_map(|path| path.id.as_deref())).map(str::to_owned);
        let mut page = Page {
            out,
            drawing,
            frame: frame(drawing),
            diagonal: control_box(drawing).extent().norm(),
            taken: taken.collect(),
        };

        let [x, y, width, height] = page.frame.map(Number);
        writeln!(page.out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        write!(page.out, r#"<svg xmlns="http://www.w3.org/2000/svg""#)?;
        write!(page.out, r#" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape""#)?;
        if let Some(per_mm) = drawing.user_units_per_mm {
            write!(page.out, r#" width="{}mm" height="{}mm""#, Number(width.0 / per_mm), Number(height.0 / per_mm))?;
        }
        writeln!(page.out, r#" viewBox="{x} {y} {width} {height}">"#)?;
        if let Some(band) = self.band {
            page.band_layer(band)?;
        }
        if self.show_drawing {
            page.drawing_layer()?;
        }
        if let Some(rows) = self.lfs {
            page.lfs_layer(rows)?;
        }
        if let Some(rows) = self.medial {
            page.medial_layer(rows)?;
        }
        if let Some(rows) = self.samples {
            page.samples_layer(rows)?;
        }
        writeln!(page.out, "</svg>")
    }
}

/// A picture being written.
struct Page<'a> {
    out: &'a mut dyn Write,
    drawing: &'a Drawing,
    /// x, y, width, height.
    frame: [f64; 4],
    diagonal: f64,
    /// Ids that are taken, first of all by the drawing.
    taken: HashSet<String>,
}

impl Page<'_> {
    /// An id of our own that nothing else has.
    fn own_id(&mut self, name: &str) -> String {
        let mut id = format!("fsample-{name}");
        let mut count = 1;
        while !self.taken.insert(id.clone()) {
            count += 1;
            id = format!("fsample-{name}-{count}");
        }
        id
    }

    /// Opens a layer; `style` goes into the tag as it is.
    fn open_layer(&mut self, name: &str, style: &str) -> io::Result<()> {
        let id = self.own_id(name);
        writeln!(self.out, r#"<g inkscape:groupmode="layer" id="{id}" inkscape:label="{name}" {style}>"#)
    }

    /// Opens the group that holds what belongs to one path of the drawing, named after it.
    fn open_path_group(&mut self, layer: &str, path: usize) -> io::Result<()> {
        let id = self.own_id(&format!("{layer}-{path}"));
        let label = self.drawing.paths.get(path).and_then(|path| path.id.clone());
        let label = label.unwrap_or_else(|| format!("path {path}"));
        writeln!(self.out, r#"<g id="{id}" inkscape:label="{}">"#, Escaped(&label))
    }

    fn close(&mut self) -> io::Result<()> {
        writeln!(self.out, "</g>")
    }

    /// The curves, in their groups.
    fn drawing_layer(&mut self) -> io::Result<()> {
        let width = Number(0.0015 * self.diagonal);
        self.open_layer("drawing", &format!(r##"fill="none" stroke="#555555" stroke-width="{width}""##))?;
        let drawing = self.drawing;
        // What a `use` repeats comes with the same ids again: only the first keeps them.
        let mut seen = HashSet::new();
        let mut open: Vec<usize> = Vec::new();
        let mut paths = drawing.paths.iter().peekable();
        while let Some(path) = paths.next() {
            let chain = group_chain(drawing, path.group);
            let shared = open.iter().zip(&chain).take_while(|(a, b)| a == b).count();
            for _ in shared..open.len() {
                self.close()?;
            }
            for group in chain.iter().skip(shared).filter_map(|&index| drawing.groups.get(index)) {
                let mode = if group.is_layer { r#" inkscape:groupmode="layer""# } else { "" };
                write!(self.out, "<g{mode}")?;
                if let Some(id) = group.id.as_deref().filter(|id| seen.insert(*id)) {
                    write!(self.out, r#" id="{}""#, Escaped(id))?;
                }
                if let Some(label) = &group.label {
                    write!(self.out, r#" inkscape:label="{}""#, Escaped(label))?;
                }
                writeln!(self.out, ">")?;
            }
            open = chain;
            write!(self.out, "<path")?;
            if let Some(id) = path.id.as_deref().filter(|id| seen.insert(*id)) {
                write!(self.out, r#" id="{}""#, Escaped(id))?;
            }
            write!(self.out, r#" d=""#)?;
            self.curve(&path.cubics, path.closed)?;
            // Further subpaths of one element belong into one `path` again.
            let mut last = path;
            while let Some(next) =
                paths.next_if(|next| next.subpath == last.subpath + 1 && next.id == last.id && next.group == last.group)
            {
                write!(self.out, " ")?;
                self.curve(&next.cubics, next.closed)?;
                last = next;
            }
            writeln!(self.out, r#""/>"#)?;
        }
        for _ in open {
            self.close()?;
        }
        self.close()
    }

    /// Path data of a chain of cubics.
    fn curve(&mut self, cubics: &[Cubic<f64>], closed: bool) -> io::Result<()> {
        let Some(first) = cubics.first() else { return Ok(()) };
        write!(self.out, "M{}", Pair(*first.start()))?;
        for cubic in cubics {
            let [_, a, b, c] = cubic.points.map(Pair);
            write!(self.out, " C{a} {b} {c}")?;
        }
        if closed { write!(self.out, " Z") } else { Ok(()) }
    }

    /// The band around the medial axis: strokes with round ends. Those too thin to be seen are made as wide as a hairline, and
    /// rounded numbers are made up for by their width.
    fn band_layer(&mut self, band: &[Capsule<f64>]) -> io::Result<()> {
        let (hairline, grain) = (0.0004 * self.diagonal, 1e-5 * self.diagonal);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to what a number has")]
        let decimals = (-grain.log10()).ceil().clamp(0.0, 15.0) as usize;
        self.open_layer("band", r##"fill="none" stroke="#9ecae1" stroke-linecap="round""##)?;
        for Capsule { axis, spread } in band {
            let [from, to] = axis.map(|p| format!("{} {}", trimmed(p.x, decimals), trimmed(p.y, decimals)));
            let width = trimmed((2.0 * (spread + grain)).max(hairline), decimals);
            writeln!(self.out, r#"<path stroke-width="{width}" d="M{from} L{to}"/>"#)?;
        }
        self.close()
    }

    /// The curve in colours. Neighbouring stretches of one colour are one element: a picture of a thousand foot points
    /// per cubic would otherwise be too heavy for its viewers.
    fn lfs_layer(&mut self, paths: &[PathRows<LfsRow>]) -> io::Result<()> {
        let width = Number(0.003 * self.diagonal);
        let style = format!(r#"fill="none" stroke-width="{width}" stroke-linecap="round""#);
        self.open_layer("lfs", &style)?;
        let drawing = self.drawing;
        let scale = Scale::over(paths.iter().flat_map(|path| &path.rows).map(|row| row.lfs));
        for (index, (path, source)) in paths.iter().zip(&drawing.paths).enumerate() {
            self.open_path_group("lfs", index)?;
            let mut run: Option<(String, Location, Location)> = None;
            for (a, b) in path.edges() {
                let colour = match scale {
                    Some(scale) => scale.colour_between(a.lfs, b.lfs),
                    None => palette::INFINITE.to_owned(),
                };
                let (from, to) = (location(a), location(b));
                run = match run {
                    // A run must not come full circle, or it would have no extent.
                    Some((same, start, _)) if same == colour && from < to => Some((same, start, to)),
                    ended => {
                        self.stroke(&source.cubics, ended)?;
                        Some((colour, from, to))
                    }
                };
            }
            self.stroke(&source.cubics, run)?;
            self.close()?;
        }
        self.legend(scale)?;
        self.close()
    }

    /// A stretch of a path in one colour.
    fn stroke(&mut self, cubics: &[Cubic<f64>], run: Option<(String, Location, Location)>) -> io::Result<()> {
        let Some((colour, from, to)) = run else { return Ok(()) };
        write!(self.out, r#"<path stroke="{colour}" d=""#)?;
        self.curve(&pieces(cubics, from, to), false)?;
        writeln!(self.out, r#""/>"#)
    }

    /// The scale of the colours, in the lower left corner of the frame.
    fn legend(&mut self, scale: Option<Scale>) -> io::Result<()> {
        const BLOCKS: u32 = 48;
        const LABELS: u32 = 3;
        let [x, y, width, height] = self.frame;
        let unit = 0.01 * width.min(height);
        let (length, left, bottom) = ((40.0 * unit).min(0.9 * width), x + 3.0 * unit, y + height - 3.0 * unit);
        let id = self.own_id("legend");
        let size = trimmed(2.2 * unit, 6);
        write!(self.out, r#"<g id="{id}" inkscape:label="legend" stroke="none" font-family="sans-serif""#)?;
        writeln!(self.out, r##" font-size="{size}" fill="#222222">"##)?;
        let [paper_x, paper_y, paper_width, paper_height] =
            [left - 1.5 * unit, bottom - 7.5 * unit, length + 5.0 * unit, 9.0 * unit].map(|v| trimmed(v, 6));
        write!(self.out, r##"<rect x="{paper_x}" y="{paper_y}" width="{paper_width}" height="{paper_height}""##)?;
        writeln!(self.out, r##" fill="#ffffff" fill-opacity="0.85"/>"##)?;
        let title_y = trimmed(bottom - 5.0 * unit, 6);
        let text_x = trimmed(left, 6);
        let Some(scale) = scale else {
            let title = "local feature size: infinite, no medial axis";
            writeln!(self.out, r#"<text x="{text_x}" y="{title_y}">{title}</text>"#)?;
            return self.close();
        };
        writeln!(self.out, r#"<text x="{text_x}" y="{title_y}">local feature size (user units, log scale)</text>"#)?;
        let block = length / f64::from(BLOCKS);
        for i in 0..BLOCKS {
            let colour = palette::colour((f64::from(i) + 0.5) / f64::from(BLOCKS));
            let x = trimmed(left + f64::from(i) * block, 6);
            // A little wider than its share, or a seam of background shows between blocks.
            let [y, wide, high] = [bottom - 4.2 * unit, 1.1 * block, 1.6 * unit].map(|v| trimmed(v, 6));
            writeln!(self.out, r#"<rect x="{x}" y="{y}" width="{wide}" height="{high}" fill="{colour}"/>"#)?;
        }
        for i in 0..=LABELS {
            let place = f64::from(i) / f64::from(LABELS);
            let [x, y] = [left + place * length, bottom].map(|v| trimmed(v, 6));
            let below = if i == 0 && scale.cut { "≤ " } else { "" };
            let anchor = match i {
                0 => "start",
                LABELS => "end",
                _ => "middle",
            };
            let value = two_digits(scale.value(place));
            writeln!(self.out, r#"<text x="{x}" y="{y}" text-anchor="{anchor}">{below}{value}</text>"#)?;
        }
        self.close()
    }

    /// Medial polylines, one element each, cut where they leave the surroundings of the frame: outer branches run off
    /// to radii without bound.
    fn medial_layer(&mut self, paths: &[PathRows<MedialRow>]) -> io::Result<()> {
        let width = Number(0.0008 * self.diagonal);
        let style = format!(r##"fill="none" stroke="#1f77b4" stroke-width="{width}" stroke-linejoin="round""##);
        self.open_layer("medial", &style)?;
        let [x, y, width, height] = self.frame;
        let margin = 0.5 * width.max(height);
        let near = |row: &MedialRow| {
            (x - margin..=x + width + margin).contains(&row.mx) && (y - margin..=y + height + margin).contains(&row.my)
        };
        // Points nearer to the last one drawn than half the width of the line cannot be seen.
        let step = 0.0004 * self.diagonal;
        for (index, path) in paths.iter().enumerate() {
            self.open_path_group("medial", index)?;
            for polyline in path.rows.chunk_by(|a, b| a.polyline == b.polyline && near(a) == near(b)) {
                if !polyline.first().is_some_and(near) {
                    continue;
                }
                let mut shown: Vec<Point<f64>> = Vec::new();
                for (i, row) in polyline.iter().enumerate() {
                    let point = Point::new(row.mx, row.my);
                    if i + 1 == polyline.len() || shown.last().is_none_or(|last| last.distance(&point) >= step) {
                        shown.push(point);
                    }
                }
                write!(self.out, r#"<polyline points=""#)?;
                for (i, point) in shown.into_iter().enumerate() {
                    write!(self.out, "{}{}", if i == 0 { "" } else { " " }, Pair(point))?;
                }
                writeln!(self.out, r#""/>"#)?;
            }
            self.close()?;
        }
        self.close()
    }

    /// Samples as dots; ends and corners, which no bound can move, in a second colour.
    fn samples_layer(&mut self, paths: &[PathRows<SampleRow>]) -> io::Result<()> {
        let radius = Number(dot_radius(paths, self.diagonal));
        self.open_layer("samples", r##"fill="#d62728" stroke="none""##)?;
        for (index, path) in paths.iter().enumerate() {
            self.open_path_group("samples", index)?;
            for row in &path.rows {
                let fixed = if matches!(row.bound, "end" | "corner") { r##" fill="#7b1fa2""## } else { "" };
                let [x, y] = [row.x, row.y].map(Number);
                writeln!(self.out, r#"<circle cx="{x}" cy="{y}" r="{radius}"{fixed}/>"#)?;
            }
            self.close()?;
        }
        self.close()
    }
}

/// How large dots may be without hiding the curve between them: a share of the middle gap, in bounds.
fn dot_radius(paths: &[PathRows<SampleRow>], diagonal: f64) -> f64 {
    let gap = |(a, b): (&SampleRow, &SampleRow)| Point::new(a.x, a.y).distance(&Point::new(b.x, b.y));
    let mut gaps: Vec<f64> = paths.iter().flat_map(PathRows::edges).map(gap).collect();
    gaps.sort_by(f64::total_cmp);
    let middle = gaps.get(gaps.len() / 2).copied().unwrap_or(f64::INFINITY);
    (0.3 * middle).clamp(0.002 * diagonal, 0.003 * diagonal)
}

/// A label of a scale needs no more.
fn two_digits(value: f64) -> Readable {
    Readable(format!("{value:.1e}").parse().unwrap_or(value))
}

/// The groups around something, outermost first.
fn group_chain(drawing: &Drawing, innermost: Option<usize>) -> Vec<usize> {
    let parent = |&index: &usize| drawing.groups.get(index).and_then(|group| group.parent);
    let mut chain: Vec<usize> = std::iter::successors(innermost, parent).collect();
    chain.reverse();
    chain
}

fn location(row: &LfsRow) -> Location {
    Location::new(row.segment as usize, row.t)
}

/// `x,y`.
struct Pair(Point<f64>);

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", Number(self.0.x), Number(self.0.y))
    }
}

/// Text inside an attribute.
struct Escaped<'a>(&'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                // White space in attributes would be read back as blanks.
                '\t' | '\n' | '\r' => write!(f, "&#{};", u32::from(c))?,
                c => write!(f, "{c}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{DrawingPath, Group};

    fn drawing() -> Drawing {
        let line = |x: f64| Cubic::line(Point::new(x, 0.0), Point::new(x, 10.0));
        let path = |id: &str, group, subpath, x| DrawingPath {
            id: Some(id.to_owned()),
            group,
            subpath,
            cubics: vec![line(x)],
            ..DrawingPath::default()
        };
        Drawing {
            view_box: Some([0.0, 0.0, 20.0, 10.0]),
            user_units_per_mm: Some(2.0),
            groups: vec![
                Group { id: Some("outer".into()), label: Some("a <b>".into()), is_layer: true, ..Group::default() },
                Group { parent: Some(0), id: Some("fsample-samples".into()), ..Group::default() },
            ],
            paths: vec![
                path("p", Some(1), 0, 1.0),
                path("p", Some(1), 1, 2.0),
                path("q", Some(0), 0, 3.0),
                path("p", None, 0, 4.0),
            ],
            ..Drawing::default()
        }
    }

    fn written(picture: &Picture<'_>) -> String {
        let mut out = Vec::new();
        picture.write(&mut out).expect("written");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn frame_groups_and_ids_are_kept() {
        let drawing = drawing();
        let text = written(&Picture {
            drawing: &drawing,
            show_drawing: true,
            lfs: None,
            medial: None,
            samples: Some(&[]),
            band: None,
        });
        assert!(text.contains(r#"width="10mm" height="5mm" viewBox="0 0 20 10""#), "frame: {text}");
        assert!(
            text.contains(r#"<g inkscape:groupmode="layer" id="outer" inkscape:label="a &lt;b&gt;">"#),
            "layer: {text}"
        );
        assert_eq!(text.matches(r#"id="p""#).count(), 1, "an id occurs once: {text}");
        assert_eq!(text.matches("<path").count(), 3, "subpaths of one element stay together: {text}");
        assert_eq!(text.matches("<g").count(), text.matches("</g>").count(), "groups are balanced: {text}");
        assert!(text.contains(r#"id="fsample-samples-2" inkscape:label="samples""#), "ours step aside: {text}");
    }

    #[test]
    fn colours_and_legend() {
        let drawing = drawing();
        let row = |t, lfs| LfsRow { path: 0, segment: 0, t, x: 1.0, y: 10.0 * t, lfs, bounds: None };
        let rows =
            [PathRows { closed: false, rows: vec![row(0.0, 1.0), row(0.5, 1.0), row(0.75, 100.0), row(1.0, 100.0)] }];
        let text = written(&Picture {
            drawing: &drawing,
            show_drawing: false,
            lfs: Some(&rows),
            medial: None,
            samples: None,
            band: None,
        });
        assert_eq!(text.matches("<path").count(), 3, "one colour, one between, one colour: {text}");
        assert!(text.contains("<text") && text.contains(">100</text>"), "a legend: {text}");
        let none = [PathRows { closed: false, rows: vec![row(0.0, f64::INFINITY), row(1.0, f64::INFINITY)] }];
        let text = written(&Picture {
            drawing: &drawing,
            show_drawing: false,
            lfs: Some(&none),
            medial: None,
            samples: None,
            band: None,
        });
        assert!(text.contains("no medial axis"), "says so: {text}");
    }
}
