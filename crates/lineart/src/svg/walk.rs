//! The walk over the tree: what is rendered, where, in which group.
//!
//! Depth first in document order, on a stack of its own rather than the program's: a document may be nested as deep
//! as [`MAX_DEPTH`], and instances multiply. Each entry of the stack carries the state its element inherits: the map
//! to root user units, the group, the style, the viewport, and the chain of `use` elements that led here. A `use`
//! whose target is already in that chain would show itself for ever; it is an error. Instances of instances can
//! still grow exponentially in the length of the file, so the elements visited are counted.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use roxmltree::{Document, Node, NodeId};

use super::css::{self, StyleSheet};
use super::error::{ElementName, SvgErrorKind};
use super::fault::Fault;
use super::outline::{Outline, PenError};
use super::style::{Declared, Inherited};
use super::transform::Affine;
use super::viewport::{self, Axis, RootSize, Viewport};
use super::{MAX_CUBICS, MAX_DEPTH, MAX_ELEMENTS, path_data, shapes};
use crate::drawing::{Drawing, DrawingPath, Group, Warning};
use crate::text_in::one_line;

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Warnings beyond this number are counted, not listed.
const MAX_WARNINGS: usize = 200;

/// Reads the document, whose root element may be anything.
pub(super) fn read(document: &Document<'_>, source: &str) -> Result<Drawing, SvgErrorKind> {
    let root = document.root_element();
    let name = root.tag_name();
    // Hand-written files forget the namespace; their intent is plain, so they are read.
    if name.name() != "svg" || name.namespace().is_some_and(|uri| uri != SVG) {
        return Err(SvgErrorKind::NotSvg(name.name().to_owned()));
    }
    let size = RootSize::of(root).map_err(|(attribute, fault)| malformed(root, attribute, fault))?;
    let sheets: Vec<(Node<'_, '_>, String)> = style_sheets(root).collect();
    let mut reader = Reader {
        drawing: Drawing {
            source: source.to_owned(),
            view_box: size.view_box,
            user_units_per_mm: size.user_units_per_mm,
            ..Drawing::default()
        },
        root,
        sheet: StyleSheet::default(),
        ids: HashMap::new(),
        warned: HashSet::new(),
        warnings_lost: 0,
        visited: 0,
        cubics: 0,
        stack: Vec::new(),
    };
    if let Some(message) = size.warning {
        reader.warn(root, message);
    }
    for (element, text) in &sheets {
        let mut unread = Vec::new();
        reader.sheet.add(text, |what| unread.push(what.to_owned()));
        if !unread.is_empty() {
            let list = unread.join("”, “");
            reader.warn(*element, format!("not read in the style sheet: “{list}”"));
        }
    }
    for element in root.descendants().filter(Node::is_element) {
        if let Some(id) = element.attribute("id") {
            reader.ids.entry(id).or_insert(element);
        }
        if reader.is_svg(element)
            && let Some(message) = effect(element.tag_name().name())
        {
            reader.warn(element, message);
        }
    }
    reader.walk(size.viewport)?;
    reader.finish()
}

/// Elements that change how others look, wherever they stand.
fn effect(tag: &str) -> Option<&'static str> {
    match tag {
        "clipPath" => Some("clipping is not applied: what it would cut off is kept"),
        "mask" => Some("masking is not applied: what it would hide is kept"),
        "pattern" => Some("the lines of a pattern are not drawn"),
        _ => None,
    }
}

/// The `<style>` elements and their texts without comments.
fn style_sheets<'a>(root: Node<'a, 'a>) -> impl Iterator<Item = (Node<'a, 'a>, String)> {
    root.descendants()
        .filter(|node| node.is_element() && node.tag_name().name() == "style")
        .filter(|node| node.attribute("type").is_none_or(|t| t.trim().is_empty() || t.trim() == "text/css"))
        .map(|node| {
            let text: String = node.children().filter_map(|child| child.text()).collect();
            (node, css::without_comments(&text))
        })
}

fn element_name(element: Node<'_, '_>) -> ElementName {
    let position = element.document().text_pos_at(element.range().start);
    ElementName {
        tag: element.tag_name().name().to_owned(),
        id: element.attribute("id").map(str::to_owned),
        line: position.row,
        column: position.col,
    }
}

fn malformed(element: Node<'_, '_>, attribute: &str, fault: Fault) -> SvgErrorKind {
    SvgErrorKind::Malformed {
        element: element_name(element),
        attribute: attribute.to_owned(),
        at: fault.at,
        cause: fault.cause,
    }
}

/// The chain of targets of `use` around an element.
#[derive(Debug)]
struct UseLink {
    target: NodeId,
    outer: Option<Rc<Self>>,
}

/// What an element inherits.
#[derive(Clone, Debug)]
struct Context<'a> {
    to_root: Affine,
    group: Option<usize>,
    style: Rc<Inherited>,
    viewport: Viewport,
    uses: Option<Rc<UseLink>>,
    depth: usize,
    /// The `use` element whose direct target this element is.
    instance_of: Option<Node<'a, 'a>>,
}

struct Reader<'a, 's> {
    drawing: Drawing,
    root: Node<'a, 'a>,
    sheet: StyleSheet<'s>,
    ids: HashMap<&'a str, Node<'a, 'a>>,
    /// Elements that have been named in a warning: instances do not repeat it.
    warned: HashSet<NodeId>,
    warnings_lost: usize,
    visited: usize,
    cubics: usize,
    /// What is still to be visited, last first.
    stack: Vec<(Node<'a, 'a>, Context<'a>)>,
}

impl<'a> Reader<'a, '_> {
    fn is_svg(&self, element: Node<'_, '_>) -> bool {
        element.tag_name().namespace() == self.root.tag_name().namespace()
    }

    fn warn(&mut self, element: Node<'_, '_>, message: impl Into<String>) {
        if !self.warned.insert(element.id()) {
            return;
        }
        // Finding the line means reading the file from its start: quadratic if there were no end to warnings.
        if self.drawing.warnings.len() == MAX_WARNINGS {
            self.warnings_lost += 1;
            return;
        }
        let element = element_name(element).to_string();
        // What is quoted may hold line breaks; a warning is one line.
        self.drawing.warnings.push(Warning { element, message: one_line(&message.into()) });
    }

    fn finish(mut self) -> Result<Drawing, SvgErrorKind> {
        if self.drawing.paths.is_empty() {
            let what = match self.drawing.warnings.first() {
                None => "the document draws nothing".to_owned(),
                Some(first) => format!("what there is was left out ({}: {})", first.element, first.message),
            };
            return Err(SvgErrorKind::NoCurve(what));
        }
        if self.warnings_lost > 0 {
            let message = format!("{} more warnings of this kind are not listed", self.warnings_lost);
            self.drawing.warnings.push(Warning { element: element_name(self.root).to_string(), message });
        }
        Ok(self.drawing)
    }

    fn walk(&mut self, viewport: Viewport) -> Result<(), SvgErrorKind> {
        let context = Context {
            to_root: Affine::IDENTITY,
            group: None,
            style: Rc::default(),
            viewport,
            uses: None,
            depth: 0,
            instance_of: None,
        };
        self.stack.push((self.root, context));
        while let Some((element, context)) = self.stack.pop() {
            self.visited += 1;
            if self.visited > MAX_ELEMENTS {
                let limit = format!("more than {MAX_ELEMENTS} elements, counting each use");
                return Err(SvgErrorKind::Limit(element_name(element), limit));
            }
            if context.depth > MAX_DEPTH {
                let limit = format!("nested more than {MAX_DEPTH} deep");
                return Err(SvgErrorKind::Limit(element_name(element), limit));
            }
            self.visit(element, context)?;
        }
        Ok(())
    }

    fn visit(&mut self, element: Node<'a, 'a>, mut context: Context<'a>) -> Result<(), SvgErrorKind> {
        if !self.is_svg(element) {
            return Ok(());
        }
        let tag = element.tag_name().name();
        let is_shape = matches!(tag, "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon");
        let is_container =
            matches!(tag, "svg" | "g" | "a" | "switch" | "use") || (tag == "symbol" && context.instance_of.is_some());
        let is_foreign = matches!(tag, "text" | "image" | "foreignObject");
        if !(is_shape || is_container || is_foreign) {
            return Ok(());
        }
        let declared = Declared::of(element, &self.sheet);
        if declared.is_left_out() || !passes(element) {
            return Ok(());
        }
        let viewport = context.viewport;
        context.style = context
            .style
            .under(&declared, |text| viewport.resolve(text, Axis::Both).ok().filter(|w| w.is_finite() && *w >= 0.0));
        if is_foreign {
            if context.style.visible {
                self.warn(element, "has no outline that this program can draw; left out");
            }
            return Ok(());
        }
        // The root is never an instance: it is around every `use`, so that would be a cycle.
        if element != self.root {
            let own = self.own_transform(element, &declared)?;
            if own.is_singular() {
                self.warn(element, "its transform flattens everything to a line or point; left out");
                return Ok(());
            }
            context.to_root = context.to_root.after(&own);
        } else if declared.get("transform").is_some() {
            self.warn(element, "a transform of the root places the drawing on the page and is not applied");
        }
        if is_shape {
            return self.shape(element, tag, &declared, &context);
        }
        self.container(element, tag, context)
    }

    /// The element's own transform: the CSS property where there is one that can be read, else the attribute.
    fn own_transform(&mut self, element: Node<'a, 'a>, declared: &Declared) -> Result<Affine, SvgErrorKind> {
        let Some(text) = declared.get("transform") else { return Ok(Affine::IDENTITY) };
        let map = if declared.get_css("transform").is_some() {
            Affine::parse_css(text)
        } else {
            Some(Affine::parse(text).map_err(|fault| malformed(element, "transform", fault))?)
        };
        let Some(map) = map else {
            self.warn(element, format!("its CSS transform “{text}” is not understood and not applied"));
            return Ok(Affine::IDENTITY);
        };
        let Some(origin) = declared.get("transform-origin") else { return Ok(map) };
        match origin_point(origin) {
            Some((x, y)) => Ok(Affine::translation(x, y).after(&map).after(&Affine::translation(-x, -y))),
            None => {
                self.warn(element, format!("its transform-origin “{origin}” is not understood and taken as 0 0"));
                Ok(map)
            }
        }
    }

    fn container(&mut self, element: Node<'a, 'a>, tag: &str, mut context: Context<'a>) -> Result<(), SvgErrorKind> {
        let instance_of = context.instance_of.take();
        context.depth += 1;
        let is_root = element == self.root;
        if !is_root {
            self.drawing.groups.push(Group {
                parent: context.group,
                id: element.attribute("id").map(str::to_owned),
                label: element.attribute((INKSCAPE, "label")).map(str::to_owned),
                is_layer: element.attribute((INKSCAPE, "groupmode")) == Some("layer"),
            });
            context.group = Some(self.drawing.groups.len() - 1);
        }
        match tag {
            "use" => return self.instance(element, context),
            "switch" => {
                if let Some(child) = element.children().find(|child| self.is_svg(*child) && passes(*child)) {
                    self.stack.push((child, context));
                }
                return Ok(());
            }
            _ => {}
        }
        if matches!(tag, "svg" | "symbol")
            && !is_root
            && !self.enter_viewport(element, tag, instance_of, &mut context)?
        {
            return Ok(());
        }
        let from = self.stack.len();
        self.stack.extend(element.children().filter(Node::is_element).map(|child| (child, context.clone())));
        self.stack[from..].reverse();
        Ok(())
    }

    /// Applies the viewport of a nested `svg` or of a `symbol`; false where it has no area.
    fn enter_viewport(
        &mut self,
        element: Node<'a, 'a>,
        tag: &str,
        instance_of: Option<Node<'a, 'a>>,
        context: &mut Context<'a>,
    ) -> Result<bool, SvgErrorKind> {
        // The size on a `use` replaces that of its target.
        let outer = context.viewport;
        let side = |name: &'static str, axis: Axis| -> Result<Option<f64>, SvgErrorKind> {
            let given = instance_of.filter(|u| u.attribute(name).is_some()).unwrap_or(element);
            match given.attribute(name).map(str::trim).filter(|text| !text.is_empty() && *text != "auto") {
                Some(text) => outer.resolve(text, axis).map(Some).map_err(|fault| malformed(given, name, fault)),
                None => Ok(if axis == Axis::Horizontal { outer.width } else { outer.height }),
            }
        };
        let size = Viewport { width: side("width", Axis::Horizontal)?, height: side("height", Axis::Vertical)? };
        let place = (
            length(element, "x", Axis::Horizontal, outer)?.unwrap_or(0.0),
            length(element, "y", Axis::Vertical, outer)?.unwrap_or(0.0),
        );
        if size.width.is_some_and(|w| w <= 0.0) || size.height.is_some_and(|h| h <= 0.0) {
            self.warn(element, format!("a {tag} without width or height shows nothing; left out"));
            return Ok(false);
        }
        let view_box = viewport::view_box(element).map_err(|fault| malformed(element, "viewBox", fault))?;
        let Some((map, inner)) = viewport::nested(element, view_box, place, size) else {
            let fault = Fault::new("needs a viewport whose size the document does not give");
            return Err(malformed(element, "viewBox", fault));
        };
        context.to_root = context.to_root.after(&map);
        context.viewport = inner;
        Ok(true)
    }

    /// Puts the target of a `use` on the stack.
    fn instance(&mut self, element: Node<'a, 'a>, mut context: Context<'a>) -> Result<(), SvgErrorKind> {
        let href = element.attribute("href").or_else(|| element.attribute((XLINK, "href"))).map(str::trim);
        let Some(href) = href.filter(|href| !href.is_empty()) else {
            self.warn(element, "refers to nothing; left out");
            return Ok(());
        };
        let target = href.strip_prefix('#').and_then(|id| self.ids.get(id).copied());
        let Some(target) = target else {
            let why = if href.starts_with('#') { "which does not exist" } else { "which is outside this file" };
            self.warn(element, format!("refers to “{href}”, {why}; left out"));
            return Ok(());
        };
        let chain = std::iter::successors(context.uses.as_deref(), |link| link.outer.as_deref());
        if chain.map(|link| link.target).any(|seen| seen == target.id()) || element.ancestors().any(|a| a == target) {
            return Err(SvgErrorKind::Cycle(element_name(element)));
        }
        let x = length(element, "x", Axis::Horizontal, context.viewport)?.unwrap_or(0.0);
        let y = length(element, "y", Axis::Vertical, context.viewport)?.unwrap_or(0.0);
        context.to_root = context.to_root.after(&Affine::translation(x, y));
        context.uses = Some(Rc::new(UseLink { target: target.id(), outer: context.uses.take() }));
        context.instance_of = Some(element);
        self.stack.push((target, context));
        Ok(())
    }

    fn shape(
        &mut self,
        element: Node<'a, 'a>,
        tag: &str,
        declared: &Declared,
        context: &Context<'a>,
    ) -> Result<(), SvgErrorKind> {
        if !context.style.visible {
            return Ok(());
        }
        if let Some(property) = declared.geometry() {
            self.warn(element, format!("the CSS property “{property}” is not read; the attributes hold"));
        } else if declared.has_marker() {
            self.warn(element, "its markers are not drawn");
        }
        let mut pen = Outline::new(&context.to_root);
        draw(element, tag, context.viewport, &mut pen)?;
        let too_many = || {
            let limit = format!("more than {MAX_CUBICS} cubics, counting each use");
            SvgErrorKind::Limit(element_name(element), limit)
        };
        let subpaths = pen.finish().map_err(|error| match error {
            PenError::OutOfRange(segment) => SvgErrorKind::OutOfRange { element: element_name(element), segment },
            PenError::TooMany => too_many(),
        })?;
        let stroke = &context.style.stroke;
        let width = context.style.stroke_width * context.to_root.mean_scale();
        let value = self.given_value(element);
        for (index, subpath) in subpaths.into_iter().enumerate() {
            self.cubics += subpath.cubics.len();
            if self.cubics > MAX_CUBICS {
                return Err(too_many());
            }
            self.drawing.paths.push(DrawingPath {
                id: element.attribute("id").map(str::to_owned),
                group: context.group,
                element: tag.to_owned(),
                subpath: index,
                closed: subpath.closed,
                cubics: subpath.cubics,
                fill: context.style.fill.clone(),
                stroke: stroke.clone(),
                stroke_width: stroke.is_some().then_some(width).filter(|w| w.is_finite()),
                value,
            });
        }
        Ok(())
    }

    /// The number in the attribute `data-value` of an element, or of the nearest one around it that has it.
    fn given_value(&mut self, element: Node<'a, 'a>) -> Option<f64> {
        let text = element.ancestors().find_map(|node| node.attribute("data-value"))?;
        let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
        if value.is_none() {
            self.warn(element, format!("data-value is “{text}”, which is no finite number"));
        }
        value
    }
}

/// A length attribute in user units, none where it is missing or `auto`.
fn length(element: Node<'_, '_>, name: &str, axis: Axis, viewport: Viewport) -> Result<Option<f64>, SvgErrorKind> {
    match element.attribute(name).map(str::trim) {
        None | Some("auto") => Ok(None),
        Some(text) => viewport.resolve(text, axis).map(Some).map_err(|fault| malformed(element, name, fault)),
    }
}

/// Two lengths in px or plain numbers.
fn origin_point(text: &str) -> Option<(f64, f64)> {
    let mut parts = text.split([' ', ',']).filter(|part| !part.is_empty());
    let mut number = || parts.next()?.trim_end_matches("px").parse::<f64>().ok().filter(|v| v.is_finite());
    let point = (number()?, number()?);
    parts.next().is_none().then_some(point)
}

/// Whether an element's conditions hold (a `switch` shows its first child of which this is true): no extensions
/// asked for, and a language that this program, whose messages are English, can claim to speak.
fn passes(child: Node<'_, '_>) -> bool {
    let speaks = |list: &str| {
        list.split(',')
            .map(str::trim)
            .any(|tag| tag.eq_ignore_ascii_case("en") || tag.to_ascii_lowercase().starts_with("en-"))
    };
    child.is_element()
        && child.attribute("requiredExtensions").is_none_or(|list| list.trim().is_empty())
        && child.attribute("systemLanguage").is_none_or(speaks)
}

/// Draws one shape in its own user units.
fn draw(element: Node<'_, '_>, tag: &str, viewport: Viewport, pen: &mut Outline<'_>) -> Result<(), SvgErrorKind> {
    use Axis::{Both, Horizontal, Vertical};
    let get = |name: &str, axis: Axis| length(element, name, axis, viewport);
    let or_zero = |name: &str, axis: Axis| get(name, axis).map(|value| value.unwrap_or(0.0));
    // Lengths of a side or radius; below zero they are an error, at zero they draw nothing.
    let size = |name: &'static str, axis: Axis| match get(name, axis)? {
        Some(value) if value < 0.0 => Err(malformed(element, name, Fault::new(format!("{value} is negative")))),
        value => Ok(value),
    };
    let radii = || -> Result<(f64, f64), SvgErrorKind> {
        let (rx, ry) = (size("rx", Horizontal)?, size("ry", Vertical)?);
        Ok((rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)))
    };
    match tag {
        "path" => {
            let data = element.attribute("d").unwrap_or_default();
            path_data::trace(data, pen).map_err(|fault| malformed(element, "d", fault))?;
        }
        "rect" => {
            let corner = (or_zero("x", Horizontal)?, or_zero("y", Vertical)?);
            let (w, h) = (size("width", Horizontal)?.unwrap_or(0.0), size("height", Vertical)?.unwrap_or(0.0));
            let (rx, ry) = radii()?;
            if w > 0.0 && h > 0.0 {
                shapes::rect(pen, corner, (w, h), (rx.min(w / 2.0), ry.min(h / 2.0)));
            }
        }
        "circle" => {
            let centre = (or_zero("cx", Horizontal)?, or_zero("cy", Vertical)?);
            let r = size("r", Both)?.unwrap_or(0.0);
            if r > 0.0 {
                shapes::ellipse(pen, centre, (r, r));
            }
        }
        "ellipse" => {
            let centre = (or_zero("cx", Horizontal)?, or_zero("cy", Vertical)?);
            let (rx, ry) = radii()?;
            if rx > 0.0 && ry > 0.0 {
                shapes::ellipse(pen, centre, (rx, ry));
            }
        }
        "line" => {
            let (x1, y1) = (or_zero("x1", Horizontal)?, or_zero("y1", Vertical)?);
            let (x2, y2) = (or_zero("x2", Horizontal)?, or_zero("y2", Vertical)?);
            pen.move_to((x1, y1));
            pen.line_to((x2, y2));
        }
        _ => {
            let points = element.attribute("points").unwrap_or_default();
            shapes::poly(pen, points, tag == "polygon").map_err(|fault| malformed(element, "points", fault))?;
        }
    }
    Ok(())
}
