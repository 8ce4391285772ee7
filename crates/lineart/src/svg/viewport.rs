//! Lengths, viewports and the physical size of a drawing.
//!
//! Coordinates of the reader are user units of the root `viewBox`, so the root's own viewBox-to-viewport map is never
//! applied; it only tells how large a user unit is on paper. Inside, absolute units are CSS's (1 in = 96 user units
//! of the space they stand in) and percentages refer to the nearest viewport, whose size in user units is that of its
//! `viewBox` where it has one.

use roxmltree::Node;
use svgtypes::{Align, AspectRatio, LengthUnit, ViewBox, ViewBoxError};

use super::fault::Fault;
use super::transform::Affine;
use crate::units::Unit;

/// 96 px are an inch of 25.4 mm.
const PX_PER_MM: f64 = 96.0 / 25.4;

/// Size of the nearest viewport in the user units inside it, as far as the document tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Viewport {
    pub(super) width: Option<f64>,
    pub(super) height: Option<f64>,
}

/// What a percentage refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    Horizontal,
    Vertical,
    /// Radii and stroke widths: the diagonal over √2.
    Both,
}

impl Viewport {
    fn extent(&self, axis: Axis) -> Option<f64> {
        match axis {
            Axis::Horizontal => self.width,
            Axis::Vertical => self.height,
            Axis::Both => Some(self.width?.hypot(self.height?) / std::f64::consts::SQRT_2),
        }
    }

    /// A length as written, in user units.
    pub(super) fn resolve(&self, text: &str, axis: Axis) -> Result<f64, Fault> {
        let length = parse(text)?;
        if length.unit == LengthUnit::Percent {
            let extent = self.extent(axis).ok_or_else(|| {
                Fault::new(format!("“{}” of a viewport whose size the document does not give", text.trim()))
            })?;
            return Ok(length.number / 100.0 * extent);
        }
        Ok(length.number * px(length.unit).ok_or_else(|| font_relative(text))?)
    }
}

fn font_relative(text: &str) -> Fault {
    Fault::new(format!("“{}” depends on a font; use another unit", text.trim()))
}

fn parse(text: &str) -> Result<svgtypes::Length, Fault> {
    let text = text.trim().to_ascii_lowercase();
    text.parse().map_err(|error| Fault::from_svgtypes(error, &text))
}

/// The unit in px; none for units that depend on a font or a viewport.
fn px(unit: LengthUnit) -> Option<f64> {
    match unit {
        LengthUnit::None | LengthUnit::Px => Some(1.0),
        _ => Some(mm(unit)? * PX_PER_MM),
    }
}

/// The unit in millimetres; none for units that depend on a font or a viewport.
fn mm(unit: LengthUnit) -> Option<f64> {
    let unit = match unit {
        LengthUnit::Mm => Unit::Mm,
        LengthUnit::Cm => Unit::Cm,
        LengthUnit::In => Unit::In,
        LengthUnit::None | LengthUnit::Px => Unit::Px,
        LengthUnit::Pt => Unit::Pt,
        LengthUnit::Pc => return Unit::Pt.in_mm().map(|pt| 12.0 * pt),
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    };
    unit.in_mm()
}

/// The `viewBox` of an element, none where it has none.
pub(super) fn view_box(element: Node<'_, '_>) -> Result<Option<[f64; 4]>, Fault> {
    let Some(text) = element.attribute("viewBox") else { return Ok(None) };
    match text.parse::<ViewBox>() {
        Ok(b) if [b.x, b.y, b.w, b.h].iter().all(|v| v.abs() <= super::MAX_COORDINATE) => {
            Ok(Some([b.x, b.y, b.w, b.h]))
        }
        Ok(_) => Err(Fault::new(format!("“{text}” is out of range"))),
        Err(ViewBoxError::InvalidSize) => Err(Fault::new(format!("“{text}” has no area"))),
        Err(ViewBoxError::InvalidNumber) => Err(Fault::new(format!("“{text}” is not four numbers"))),
    }
}

/// The `preserveAspectRatio` of an element, or its default where it is missing or not understood.
fn aspect_ratio(element: Node<'_, '_>) -> AspectRatio {
    element.attribute("preserveAspectRatio").and_then(|text| text.parse().ok()).unwrap_or_default()
}

/// What the root element says about sizes.
pub(super) struct RootSize {
    pub(super) view_box: Option<[f64; 4]>,
    pub(super) viewport: Viewport,
    pub(super) user_units_per_mm: Option<f64>,
    /// Something not honoured, in words.
    pub(super) warning: Option<String>,
}

impl RootSize {
    pub(super) fn of(root: Node<'_, '_>) -> Result<Self, (&'static str, Fault)> {
        let view_box = view_box(root).map_err(|fault| ("viewBox", fault))?;
        let mut warning = None;
        let mut side = |name: &'static str| -> Result<Option<svgtypes::Length>, (&'static str, Fault)> {
            let Some(text) = root.attribute(name).filter(|t| !t.trim().is_empty() && t.trim() != "auto") else {
                return Ok(None);
            };
            let length = parse(text).map_err(|fault| (name, fault))?;
            if length.unit == LengthUnit::Percent {
                return Ok(None);
            }
            if mm(length.unit).is_none() || length.number <= 0.0 {
                warning = Some(format!("{name} “{text}” gives no physical size"));
                return Ok(None);
            }
            Ok(Some(length))
        };
        let (width, height) = (side("width")?, side("height")?);
        let in_mm = |l: svgtypes::Length| mm(l.unit).map(|unit| l.number * unit);
        let in_px = |l: svgtypes::Length| px(l.unit).map(|unit| l.number * unit);
        let Some([_, _, w, h]) = view_box else {
            return Ok(Self {
                view_box,
                viewport: Viewport { width: width.and_then(in_px), height: height.and_then(in_px) },
                user_units_per_mm: Some(PX_PER_MM),
                warning,
            });
        };
        // User units per mm along each axis; the aspect ratio says which holds.
        let along_x = width.and_then(in_mm).map(|mm| w / mm);
        let along_y = height.and_then(in_mm).map(|mm| h / mm);
        let ratio = aspect_ratio(root);
        let user_units_per_mm = match (along_x, along_y) {
            (Some(x), Some(y)) if ratio.align == Align::None => {
                if (x / y - 1.0).abs() > 1e-3 {
                    warning = Some(
                        "preserveAspectRatio=\"none\" stretches the drawing; physical lengths use the mean scale"
                            .to_owned(),
                    );
                }
                Some((x * y).sqrt())
            }
            (Some(x), Some(y)) => Some(if ratio.slice { x.min(y) } else { x.max(y) }),
            (x, y) => x.or(y),
        };
        let user_units_per_mm = user_units_per_mm.filter(|s| s.is_finite() && *s > 0.0);
        Ok(Self { view_box, viewport: Viewport { width: Some(w), height: Some(h) }, user_units_per_mm, warning })
    }
}

/// The map from inside a nested viewport (placed at x, y with the given size) to outside, and the viewport inside.
/// None where the `viewBox` needs a size that the document does not give.
pub(super) fn nested(
    element: Node<'_, '_>,
    view_box: Option<[f64; 4]>,
    (x, y): (f64, f64),
    outer: Viewport,
) -> Option<(Affine, Viewport)> {
    let Some([bx, by, bw, bh]) = view_box else {
        return Some((Affine::translation(x, y), outer));
    };
    let (width, height) = (outer.width?, outer.height?);
    let ratio = aspect_ratio(element);
    let (mut sx, mut sy) = (width / bw, height / bh);
    if ratio.align != Align::None {
        let s = if ratio.slice { sx.max(sy) } else { sx.min(sy) };
        (sx, sy) = (s, s);
    }
    let (fx, fy) = match ratio.align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    let place = Affine::translation(x + fx * (width - bw * sx), y + fy * (height - bh * sy));
    let map = place.after(&Affine::scaling(sx, sy)).after(&Affine::translation(-bx, -by));
    Some((map, Viewport { width: Some(bw), height: Some(bh) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(attributes: &str) -> RootSize {
        let text = format!("<svg {attributes}/>");
        let document = roxmltree::Document::parse(&text).unwrap();
        RootSize::of(document.root_element()).map_err(|(name, fault)| format!("{name} {fault:?}")).unwrap()
    }

    #[test]
    fn physical_size_goes_through_the_view_box() {
        let per_mm = |attributes| size(attributes).user_units_per_mm;
        assert_eq!(per_mm(r#"width="210mm" height="297mm" viewBox="0 0 210 297""#), Some(1.0));
        assert_eq!(per_mm(r#"width="10cm" viewBox="0 0 400 100""#), Some(4.0));
        assert_eq!(per_mm(r#"height="1in" viewBox="0 0 400 25.4""#), Some(1.0));
        let px = 96.0 / 25.4;
        assert!((per_mm(r#"width="100" height="100""#).unwrap() / px - 1.0).abs() < 1e-15);
        assert!((per_mm("").unwrap() / px - 1.0).abs() < 1e-15);
        assert!((per_mm(r#"width="50px" viewBox="0 0 100 100""#).unwrap() / (2.0 * px) - 1.0).abs() < 1e-15);
        assert!((per_mm(r#"width="6pc" viewBox="0 0 25.4 1""#).unwrap() - 1.0).abs() < 1e-15);
        assert_eq!(per_mm(r#"viewBox="0 0 100 100""#), None);
        assert_eq!(per_mm(r#"width="100%" height="auto" viewBox="0 0 100 100""#), None);
    }

    #[test]
    fn the_aspect_ratio_decides_between_two_scales() {
        let per_mm = |ratio: &str| {
            size(&format!(r#"width="10mm" height="10mm" viewBox="0 0 100 400" preserveAspectRatio="{ratio}""#))
        };
        assert_eq!(per_mm("xMidYMid").user_units_per_mm, Some(40.0));
        assert_eq!(per_mm("xMinYMax slice").user_units_per_mm, Some(10.0));
        let none = per_mm("none");
        assert_eq!(none.user_units_per_mm, Some(20.0));
        assert!(none.warning.is_some());
    }

    #[test]
    fn sizes_that_say_nothing_are_warned_about() {
        let odd = size(r#"width="10em" viewBox="0 0 1 1""#);
        assert_eq!(odd.user_units_per_mm, None);
        assert!(odd.warning.is_some());
        assert!(size(r#"width="0" viewBox="0 0 1 1""#).warning.is_some());
    }

    #[test]
    fn view_boxes_without_area_are_refused() {
        for text in ["0 0 0 1", "0 0 1 -1", "0 0 1", "0 0 nan 1", "", "0 0 1e200 1"] {
            let xml = format!(r#"<svg viewBox="{text}"/>"#);
            let document = roxmltree::Document::parse(&xml).unwrap();
            assert!(view_box(document.root_element()).is_err(), "{text}");
        }
    }

    #[test]
    fn lengths_in_the_document() {
        let viewport = Viewport { width: Some(30.0), height: Some(40.0) };
        let len = |text| viewport.resolve(text, Axis::Both);
        assert_eq!(len("3"), Ok(3.0));
        assert_eq!(len(" 3PX "), Ok(3.0));
        assert!((len("1in").unwrap() - 96.0).abs() < 1e-12);
        assert!((len("25.4mm").unwrap() - 96.0).abs() < 1e-12);
        assert!((len("3pt").unwrap() - 4.0).abs() < 1e-12);
        assert!((len("50%").unwrap() - 25.0 / 2.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(viewport.resolve("50%", Axis::Horizontal), Ok(15.0));
        assert_eq!(viewport.resolve("50%", Axis::Vertical), Ok(20.0));
        for text in ["", "x", "1em", "1 2", "nan", "1e999"] {
            assert!(len(text).is_err(), "{text}");
        }
        assert!(Viewport { width: None, height: None }.resolve("1%", Axis::Both).is_err());
    }

    #[test]
    fn a_nested_viewport_fits_its_view_box() {
        let document = roxmltree::Document::parse(r#"<svg/>"#).unwrap();
        let outer = Viewport { width: Some(100.0), height: Some(50.0) };
        let (map, inner) = nested(document.root_element(), Some([10.0, 10.0, 10.0, 10.0]), (1.0, 2.0), outer).unwrap();
        // Scale 5, 50 wide of 100: 25 to the left.
        assert_eq!(map.apply(10.0, 10.0), (26.0, 2.0));
        assert_eq!(map.apply(20.0, 20.0), (76.0, 52.0));
        assert_eq!(inner, Viewport { width: Some(10.0), height: Some(10.0) });
    }
}
