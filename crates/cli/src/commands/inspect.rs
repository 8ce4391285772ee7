//! `fsample inspect`: what is in a drawing, before anything is computed.

use std::io::{self, Write};

use lineart::drawing::{Drawing, DrawingPath, Group};
use lineart::export::control_box;
use lineart::export::json::JsonText;
use lineart::export::number::{JsonNumber, Readable};
use lineart::stretch::{is_straight, length};

use crate::engine::{Door, Engine};
use crate::errors::Failure;
use crate::input;
use crate::options::{InspectArgs, InspectFormat, check_corner_angle};
use crate::output::to_stdout;
use crate::summary::count;

/// Tells what is in a drawing.
pub(crate) fn run(args: &InspectArgs) -> Result<(), Failure> {
    let corner_angle = check_corner_angle(args.corner_angle)?;
    // The report lists the warnings itself; standard error would say them twice.
    let drawing = input::drawing(&args.input.file, true)?;
    let door = Engine::inspect(&drawing, corner_angle)?;
    let report = Report::new(&drawing, &door);
    let written = to_stdout(|out| match args.format {
        InspectFormat::Text => report.text(out),
        InspectFormat::Json => report.json(out),
    });
    written.map_err(|error| Failure::output("-", &error))
}

/// The facts, gathered once for both forms.
struct Report<'a> {
    drawing: &'a Drawing,
    door: &'a Door,
    lengths: Vec<f64>,
    cubics: usize,
    straight: usize,
    closed: usize,
    /// min x, min y, max x, max y.
    bounds: [f64; 4],
    diagonal: f64,
}

impl<'a> Report<'a> {
    fn new(drawing: &'a Drawing, door: &'a Door) -> Self {
        let cubics = || drawing.paths.iter().flat_map(|path| &path.cubics);
        let bounds = control_box(drawing);
        Self {
            drawing,
            door,
            lengths: drawing.paths.iter().map(|path| path.cubics.iter().map(length).sum()).collect(),
            cubics: cubics().count(),
            straight: cubics().filter(|cubic| is_straight(cubic)).count(),
            closed: drawing.paths.iter().filter(|path| path.closed).count(),
            bounds: [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y],
            diagonal: Engine::diagonal(drawing),
        }
    }

    fn text(&self, out: &mut dyn Write) -> io::Result<()> {
        let drawing = self.drawing;
        let mut line = |name: &str, value: &str| writeln!(out, "{name:<13}{value}");
        line("drawing", &drawing.source)?;
        match drawing.view_box {
            Some(view_box) => line("viewBox", &view_box.map(|v| Readable(v).to_string()).join(" "))?,
            None => line("viewBox", "none")?,
        }
        match drawing.user_units_per_mm {
            Some(per_mm) => {
                let size = match drawing.view_box {
                    Some([.., width, height]) => {
                        format!("{} mm × {} mm, ", Readable(width / per_mm), Readable(height / per_mm))
                    }
                    None => String::new(),
                };
                line("size", &format!("{size}1 mm = {} user units", Readable(per_mm)))?;
            }
            None => line("size", "no physical size: lengths in mm cannot be used")?,
        }
        let open = drawing.paths.len() - self.closed;
        line("paths", &format!("{}: {} closed, {open} open", drawing.paths.len(), self.closed))?;
        line("cubics", &format!("{}, of them {} straight", self.cubics, self.straight))?;
        line("length", &Readable(self.lengths.iter().sum()).to_string())?;
        let [x0, y0, x1, y1] = self.bounds.map(Readable);
        line("bounding box", &format!("x {x0} to {x1}, y {y0} to {y1} (of the control points)"))?;
        line("diagonal", &Readable(self.diagonal).to_string())?;
        let Door { smooth_joints, corners, open_ends, .. } = self.door;
        let corners = count(*corners as usize, "corner");
        line("joints", &format!("{smooth_joints} smooth, {corners}, {}", count(*open_ends as usize, "open end")))?;
        let changes = self.door.changes();
        line("changes", &if changes.is_empty() { "none".to_owned() } else { changes.join(", ") })?;
        if !drawing.groups.is_empty() {
            writeln!(out, "groups")?;
            for (index, group) in drawing.groups.iter().enumerate() {
                let inside = drawing.paths.iter().filter(|path| path.group == Some(index)).count();
                let indent = "  ".repeat(depth(drawing, group));
                writeln!(out, "  {indent}{}: {}", group_name(group), count(inside, "path"))?;
            }
        }
        writeln!(out, "path  closed  cubics  length      element")?;
        for (index, (path, length)) in drawing.paths.iter().zip(&self.lengths).enumerate() {
            let closed = if path.closed { "yes" } else { "no" };
            let length = Readable(*length).to_string();
            writeln!(out, "{index:<6}{closed:<8}{:<8}{length:<12}{}", path.cubics.len(), path_name(path))?;
        }
        for warning in &drawing.warnings {
            writeln!(out, "warning: {}: {}", warning.element, warning.message)?;
        }
        Ok(())
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        let drawing = self.drawing;
        writeln!(out, "{{\n\"version\":1,\n\"source\":{},", JsonText(&drawing.source))?;
        match drawing.view_box.map(|view_box| view_box.map(JsonNumber)) {
            Some([x, y, width, height]) => writeln!(out, "\"view_box\":[{x},{y},{width},{height}],")?,
            None => writeln!(out, "\"view_box\":null,")?,
        }
        let per_mm = JsonNumber(drawing.user_units_per_mm.unwrap_or(f64::NAN));
        let [x0, y0, x1, y1] = self.bounds.map(JsonNumber);
        writeln!(out, "\"user_units_per_mm\":{per_mm},")?;
        writeln!(out, "\"bounding_box\":[{x0},{y0},{x1},{y1}],\n\"diagonal\":{},", JsonNumber(self.diagonal))?;
        writeln!(out, "\"cubics\":{},\n\"straight\":{},", self.cubics, self.straight)?;
        writeln!(out, "\"length\":{},", JsonNumber(self.lengths.iter().sum()))?;
        let Door { smooth_joints, corners, open_ends, .. } = self.door;
        writeln!(
            out,
            "\"joints\":{{\"smooth\":{smooth_joints},\"corner\":{corners},\"open\":{open_ends}}},\n\"changes\":{{"
        )?;
        let facts = self.door.facts();
        list(out, &facts, |out, (name, value)| write!(out, "\"{name}\":{}", JsonNumber(*value)))?;
        write!(out, "}},\n\"groups\":[")?;
        list(out, &drawing.groups, |out, group| {
            let Group { parent, id, label, is_layer } = group;
            let parent = parent.map_or("null".to_owned(), |parent| parent.to_string());
            let (id, label) = (text_or_null(id.as_deref()), text_or_null(label.as_deref()));
            write!(out, "{{\"parent\":{parent},\"id\":{id},\"label\":{label},\"layer\":{is_layer}}}")
        })?;
        write!(out, "],\n\"paths\":[")?;
        let paths: Vec<_> = drawing.paths.iter().zip(&self.lengths).collect();
        list(out, &paths, |out, (path, length)| {
            let group = path.group.map_or("null".to_owned(), |group| group.to_string());
            let (id, element) = (text_or_null(path.id.as_deref()), JsonText(&path.element));
            write!(out, "{{\"id\":{id},\"element\":{element},\"subpath\":{},\"group\":{group},", path.subpath)?;
            let length = JsonNumber(**length);
            write!(out, "\"closed\":{},\"cubics\":{},\"length\":{length}}}", path.closed, path.cubics.len())
        })?;
        write!(out, "],\n\"warnings\":[")?;
        list(out, &drawing.warnings, |out, warning| {
            let (element, message) = (JsonText(&warning.element), JsonText(&warning.message));
            write!(out, "{{\"element\":{element},\"message\":{message}}}")
        })?;
        writeln!(out, "]\n}}")
    }
}

/// Items with commas between them, one per line.
fn list<T>(
    out: &mut dyn Write,
    items: &[T],
    write_item: impl Fn(&mut dyn Write, &T) -> io::Result<()>,
) -> io::Result<()> {
    for (i, item) in items.iter().enumerate() {
        write!(out, "{}", if i == 0 { "\n" } else { ",\n" })?;
        write_item(out, item)?;
    }
    Ok(())
}

fn text_or_null(text: Option<&str>) -> String {
    text.map_or("null".to_owned(), |text| JsonText(text).to_string())
}

/// How many groups are around a group.
fn depth(drawing: &Drawing, group: &Group) -> usize {
    std::iter::successors(group.parent, |&index| drawing.groups.get(index).and_then(|group| group.parent)).count()
}

fn group_name(group: &Group) -> String {
    let kind = if group.is_layer { "layer" } else { "group" };
    match (&group.label, &group.id) {
        (Some(label), Some(id)) => format!("{kind} {label} ({id})"),
        (Some(name), None) | (None, Some(name)) => format!("{kind} {name}"),
        (None, None) => kind.to_owned(),
    }
}

fn path_name(path: &DrawingPath) -> String {
    let id = path.id.as_ref().map_or(String::new(), |id| format!(" {id}"));
    let subpath = if path.subpath > 0 { format!(", subpath {}", path.subpath) } else { String::new() };
    format!("{}{id}{subpath}", path.element)
}
