//! Colours into the document they belong to.
//!
//! The document stays as it is, byte for byte: a group `fills` is put into its text before everything that is drawn (after
//! a background, if the document starts with one), so that it lies under the strokes and in the same user units. The layer
//! of the hints is taken out. Paints are given as `style`, which wins over style sheets and over what the root says.

use std::fmt::Write;

use roxmltree::{Document, Node, ParsingOptions};

use super::{Outline, Painting, Piece};
use crate::export::number::Number;

/// What is put into the document.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Layers<'a> {
    /// Width of a stroke in its own colour around each region, in user units; 0 for none.
    pub bleed: f64,
    /// Triangulation and gaps, on top of everything, with lines of this width.
    pub debug: Option<f64>,
    /// Id or Inkscape label of groups that are taken out.
    pub hint_layer: Option<&'a str>,
    /// The first shape of the document is a background: colours go on top of it.
    pub background: bool,
}

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// The document with the colours in it; `None` if it cannot be parsed, which a reader that made a drawing of it excludes.
pub fn insert(text: &str, painting: &Painting, layers: &Layers<'_>) -> Option<String> {
    let (mark, body) = text.strip_prefix('\u{feff}').map_or(("", text), |body| ("\u{feff}", body));
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(body, options).ok()?;
    let root = document.root_element();
    let name = body.get(root.range().start + 1..)?;
    let name = name.split(|c: char| c.is_whitespace() || c == '>' || c == '/').next()?;
    let prefix = name.strip_suffix("svg").unwrap_or_default();

    // Cuts and insertions, by place.
    let mut edits: Vec<(std::ops::Range<usize>, String)> = Vec::new();
    for element in root.descendants().filter(|node| node.has_tag_name_of("g")) {
        let names = [element.attribute("id"), element.attribute((INKSCAPE, "label"))];
        let is_hints = layers.hint_layer.is_some() && names.contains(&layers.hint_layer);
        if is_hints && !edits.iter().any(|(cut, _)| cut.contains(&element.range().start)) {
            edits.push((element.range(), String::new()));
        }
    }
    let fills = fills(painting, layers, prefix);
    let debug = layers.debug.map_or_else(String::new, |width| debug(painting, width, prefix));
    match place(&root, layers.background) {
        Some(place) => {
            edits.push((place..place, fills));
            let end = body.get(..root.range().end)?.rfind("</")?;
            edits.push((end..end, debug));
        }
        None => {
            // <svg …/> has no content; nothing is drawn in it, so nothing is coloured.
            return Some(text.to_owned());
        }
    }
    edits.sort_by_key(|(range, _)| (range.start, range.end));
    let mut out = String::with_capacity(text.len() + 4096);
    out.push_str(mark);
    let mut from = 0;
    for (range, new) in edits {
        out.push_str(body.get(from..range.start)?);
        out.push_str(&new);
        from = range.end;
    }
    out.push_str(body.get(from..)?);
    Some(out)
}

trait TagName {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl TagName for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

/// Where the first thing that is drawn starts.
fn place(root: &Node<'_, '_>, background: bool) -> Option<usize> {
    let first = root.children().next()?;
    let mut place = first.range().start;
    let mut background = background;
    for child in root.children().filter(Node::is_element) {
        let tag = child.tag_name();
        let leads = matches!(tag.name(), "defs" | "style" | "title" | "desc" | "metadata" | "namedview")
            || tag.namespace() != root.tag_name().namespace();
        let is_background = background && tag.name() == "rect";
        if !(leads || is_background) {
            break;
        }
        background &= !is_background;
        place = child.range().end;
    }
    Some(place)
}

fn fills(painting: &Painting, layers: &Layers<'_>, prefix: &str) -> String {
    let mut out = format!("\n<{prefix}g id=\"fills\">\n");
    for region in &painting.regions {
        let Some(colour) = &region.colour else { continue };
        let stroke = if layers.bleed > 0.0 {
            format!("stroke:{colour};stroke-width:{};stroke-linejoin:round;stroke-dasharray:none", Number(layers.bleed))
        } else {
            "stroke:none".to_owned()
        };
        let d = path_data(&region.outlines);
        // Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "<{prefix}path style=\"fill:{colour};fill-opacity:1;fill-rule:evenodd;{stroke}\" d=\"{d}\"/>"
        );
    }
    let _ = writeln!(out, "</{prefix}g>");
    out
}

/// Outlines as the `d` attribute of one path.
fn path_data(outlines: &[Outline]) -> String {
    let mut d = String::new();
    for outline in outlines {
        let _ = write!(d, "M{} {}", Number(outline.start.x), Number(outline.start.y));
        for piece in &outline.pieces {
            let _ = match piece {
                Piece::Line(p) => write!(d, "L{} {}", Number(p.x), Number(p.y)),
                Piece::Cubic(cubic) => {
                    let [_, a, b, c] = &cubic.points;
                    let [a, b, c] = [a, b, c].map(|p| format!("{} {}", Number(p.x), Number(p.y)));
                    write!(d, "C{a} {b} {c}")
                }
            };
        }
        d.push('Z');
    }
    d
}

fn debug(painting: &Painting, width: f64, prefix: &str) -> String {
    let line = |width: f64, colour: &str| {
        format!("fill:none;stroke:{colour};stroke-width:{};stroke-dasharray:none", Number(width))
    };
    let mut out = format!("\n<{prefix}g id=\"triangulation\">\n");
    let mut d = String::new();
    for [a, b, c] in &painting.triangles {
        let [a, b, c] = [a, b, c].map(|p| format!("{} {}", Number(p.x), Number(p.y)));
        let _ = write!(d, "M{a}L{b}L{c}Z");
    }
    let _ = writeln!(out, "<{prefix}path style=\"{}\" d=\"{d}\"/>", line(0.5 * width, "#8899aa"));
    let mut d = String::new();
    for gap in painting.regions.iter().flat_map(|region| &region.gaps) {
        let [a, b] = gap.ends.map(|p| format!("{} {}", Number(p.x), Number(p.y)));
        let _ = write!(d, "M{a}L{b}");
    }
    let _ = writeln!(out, "<{prefix}path id=\"gaps\" style=\"{}\" d=\"{d}\"/>", line(2.0 * width, "#d00000"));
    let _ = writeln!(out, "</{prefix}g>");
    out
}
