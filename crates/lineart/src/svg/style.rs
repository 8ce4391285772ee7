//! What an element's style says about drawing: shown or not, stroke, transform.
//!
//! The cascade in short: presentation attributes are weakest, then rules of style sheets, then the `style`
//! attribute; `!important` beats all that is not. Of the properties read here `display` acts on the whole subtree by
//! leaving it out; `visibility`, `fill`, `stroke`, `stroke-width` and `color` are inherited, so that a child may be visible
//! inside a hidden group.

use std::rc::Rc;

use roxmltree::Node;

use super::css::{self, ATTRIBUTES, PROPERTIES, StyleSheet};

/// The winning value of each property for one element.
#[derive(Debug, Default)]
pub(super) struct Declared {
    values: [Option<Value>; PROPERTIES.len()],
}

#[derive(Clone, Debug)]
struct Value {
    text: String,
    important: bool,
    /// Came from a presentation attribute, whose grammar is SVG's and not CSS's.
    is_attribute: bool,
}

impl Declared {
    pub(super) fn of(element: Node<'_, '_>, sheet: &StyleSheet<'_>) -> Self {
        let mut declared = Self::default();
        for (slot, name) in declared.values.iter_mut().zip(PROPERTIES).take(ATTRIBUTES) {
            *slot = element.attribute(name).map(|text| Value {
                text: text.trim().to_owned(),
                important: false,
                is_attribute: true,
            });
        }
        for declaration in sheet.matching(element) {
            declared.set(declaration);
        }
        if let Some(style) = element.attribute("style") {
            let style = css::without_comments(style);
            for declaration in css::declarations(&style) {
                declared.set(&declaration);
            }
        }
        declared
    }

    fn set(&mut self, declaration: &css::Declaration<'_>) {
        let slot = &mut self.values[declaration.property];
        if declaration.important || !slot.as_ref().is_some_and(|v| v.important) {
            *slot = Some(Value {
                text: declaration.value.to_owned(),
                important: declaration.important,
                is_attribute: false,
            });
        }
    }

    /// The value of a property; `inherit` and nothing both give none.
    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.value(name).map(|v| v.text.as_str())
    }

    /// The value of a property that a `style` attribute or a style sheet sets.
    pub(super) fn get_css(&self, name: &str) -> Option<&str> {
        self.value(name).filter(|v| !v.is_attribute).map(|v| v.text.as_str())
    }

    fn value(&self, name: &str) -> Option<&Value> {
        let index = PROPERTIES.iter().position(|p| *p == name)?;
        self.values[index].as_ref().filter(|v| !v.text.is_empty() && v.text != "inherit")
    }

    /// `display: none`.
    pub(super) fn is_left_out(&self) -> bool {
        self.get("display") == Some("none")
    }

    /// The first geometry property that a `style` attribute or a style sheet sets.
    pub(super) fn geometry(&self) -> Option<&'static str> {
        let set = self.values.iter().zip(PROPERTIES).skip(ATTRIBUTES).find(|(value, _)| value.is_some());
        set.map(|(_, name)| name)
    }

    /// One of the marker properties names a marker.
    pub(super) fn has_marker(&self) -> bool {
        ["marker", "marker-start", "marker-mid", "marker-end"].iter().any(|m| self.get(m).is_some_and(|v| v != "none"))
    }
}

/// Inherited properties.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Inherited {
    pub(super) visible: bool,
    /// The paint; `none` is None.
    pub(super) fill: Option<String>,
    /// Likewise.
    pub(super) stroke: Option<String>,
    /// In the element's own user units.
    pub(super) stroke_width: f64,
    color: Option<String>,
}

impl Default for Inherited {
    fn default() -> Self {
        Self { visible: true, fill: Some("black".to_owned()), stroke: None, stroke_width: 1.0, color: None }
    }
}

impl Inherited {
    /// These properties with an element's own on top. `width` resolves a stroke width to user units; a width that
    /// cannot be resolved, or is negative, counts as not given, as CSS has it.
    pub(super) fn under(self: &Rc<Self>, declared: &Declared, width: impl Fn(&str) -> Option<f64>) -> Rc<Self> {
        let names = ["visibility", "fill", "stroke", "stroke-width", "color"];
        if names.iter().all(|name| declared.get(name).is_none()) {
            return Rc::clone(self);
        }
        let mut own = Self::clone(self);
        if let Some(visibility) = declared.get("visibility") {
            own.visible = !matches!(visibility, "hidden" | "collapse");
        }
        if let Some(color) = declared.get("color") {
            own.color = Some(color.to_owned());
        }
        let paint = |paint: &str| match paint {
            "none" => None,
            "currentColor" | "currentcolor" => Some(own.color.clone().unwrap_or_else(|| "black".to_owned())),
            paint => Some(paint.to_owned()),
        };
        let (fill, stroke) = (declared.get("fill").map(paint), declared.get("stroke").map(paint));
        if let Some(fill) = fill {
            own.fill = fill;
        }
        if let Some(stroke) = stroke {
            own.stroke = stroke;
        }
        if let Some(value) = declared.get("stroke-width").and_then(width) {
            own.stroke_width = value;
        }
        Rc::new(own)
    }
}
