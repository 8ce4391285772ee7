//! The tree: groups, instances, viewports, style, and what is left out. Grammars of single attributes are tested
//! beside their code.

use lineart::drawing::Drawing;
use lineart::svg;

/// A document with this content in a root of 100 by 100 user units.
fn read(content: &str) -> Drawing {
    read_root(r#"viewBox="0 0 100 100""#, content)
}

fn read_root(attributes: &str, content: &str) -> Drawing {
    let text = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
            xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" {attributes}>{content}</svg>"#
    );
    svg::read_str(&text, "test.svg").unwrap_or_else(|error| panic!("{error}"))
}

/// First and last point of each path.
fn ends(drawing: &Drawing) -> Vec<[f64; 4]> {
    let of = |p: &lineart::drawing::DrawingPath| {
        let (a, b) = (p.cubics[0].points[0], p.cubics[p.cubics.len() - 1].points[3]);
        [a.x, a.y, b.x, b.y]
    };
    drawing.paths.iter().map(of).collect()
}

fn ids(drawing: &Drawing) -> Vec<&str> {
    drawing.paths.iter().map(|p| p.id.as_deref().unwrap_or("-")).collect()
}

#[track_caller]
fn near(found: &[[f64; 4]], expected: &[[f64; 4]]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (f, e) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((f - e).abs() < 1e-12, "{found:?} instead of {expected:?}");
    }
}

#[test]
fn shapes_come_in_document_order_with_their_names() {
    let drawing = read(
        r##"<rect id="a" width="4" height="3"/><circle id="b" r="2"/><ellipse id="c" rx="2" ry="1"/>
           <line id="d" x1="1" y1="2" x2="3" y2="4"/><polyline id="e" points="0,0 1,1 2,0"/>
           <polygon id="f" points="0,0 1,1 2,0"/><path id="g" d="M0 0h1M5 5h1v1z"/><rect id="h" width="0" height="1"/>"##,
    );
    let found: Vec<_> = drawing
        .paths
        .iter()
        .map(|p| (p.id.as_deref().unwrap_or("-"), p.element.as_str(), p.subpath, p.closed, p.cubics.len()))
        .collect();
    let expected = [
        ("a", "rect", 0, true, 4),
        ("b", "circle", 0, true, 4),
        ("c", "ellipse", 0, true, 4),
        ("d", "line", 0, false, 1),
        ("e", "polyline", 0, false, 2),
        ("f", "polygon", 0, true, 3),
        ("g", "path", 0, false, 1),
        ("g", "path", 1, true, 3),
    ];
    assert_eq!(found, expected);
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
}

#[test]
fn shapes_use_their_lengths() {
    let drawing = read_root(
        r#"viewBox="0 0 300 400""#,
        r#"<line x1="10%" y1="10%" x2="1in" y2="12pt"/><circle cx="50%" cy="0" r="10%"/><ellipse rx="3" ry="auto"/>
           <rect x="1" y="2" width="10" height="6" ry="1"/>"#,
    );
    let r = 10.0_f64.hypot(0.0) / 100.0 * 300.0_f64.hypot(400.0) / 2.0_f64.sqrt() * 10.0;
    near(
        &ends(&drawing),
        &[
            [30.0, 40.0, 96.0, 16.0],
            [150.0 + r / 10.0, 0.0, 150.0 + r / 10.0, 0.0],
            [3.0, 0.0, 3.0, 0.0],
            [2.0, 2.0, 2.0, 2.0],
        ],
    );
    assert_eq!(drawing.paths[3].cubics.len(), 8, "a missing rx follows ry");
}

#[test]
fn the_smallest_curvature_radius_of_a_circle_of_four_cubics() {
    let drawing = read(r#"<circle r="10"/>"#);
    let mut smallest = f64::INFINITY;
    for i in 0..=100_000 {
        let t = f64::from(i) / 100_000.0;
        let power = drawing.paths[0].cubics[0].power_basis();
        let (d, dd) = (power.derivative(&t), power.second_derivative(&t));
        smallest = smallest.min(d.x.hypot(d.y).powi(3) / (d.x * dd.y - d.y * dd.x).abs());
    }
    assert!((smallest / 10.0 - 0.9921).abs() < 5e-5, "{smallest}");
}

#[test]
fn transforms_nest() {
    let drawing = read(
        r#"<g transform="translate(10 20)"><g transform="scale(2)"><path transform="rotate(90)" d="M1 0H3"/></g>
           <path d="M0 0H1"/></g><path transform="matrix(0 1 1 0 0 0)" d="M1 2L3 4"/>"#,
    );
    near(&ends(&drawing), &[[10.0, 22.0, 10.0, 26.0], [10.0, 20.0, 11.0, 20.0], [2.0, 1.0, 4.0, 3.0]]);
}

#[test]
fn transforms_in_css_and_about_an_origin() {
    let drawing = read(
        r#"<path style="transform: translate(5px, 6px)" transform="scale(9)" d="M0 0H1"/>
           <path transform="rotate(90)" transform-origin="1 1" d="M1 0H2"/>
           <path style="transform: translateX(3em)" d="M0 0H1"/>"#,
    );
    near(&ends(&drawing), &[[5.0, 6.0, 6.0, 6.0], [2.0, 1.0, 2.0, 2.0], [0.0, 0.0, 1.0, 0.0]]);
    assert_eq!(drawing.warnings.len(), 1);
    assert!(drawing.warnings[0].message.contains("translateX(3em)"), "{:?}", drawing.warnings);
}

#[test]
fn the_root_view_box_scales_nothing_but_physical_lengths() {
    let drawing = read_root(
        r#"width="50mm" height="50mm" viewBox="10 10 100 100" transform="scale(3)""#,
        r#"<path d="M10 10H20"/>"#,
    );
    near(&ends(&drawing), &[[10.0, 10.0, 20.0, 10.0]]);
    assert_eq!(drawing.view_box, Some([10.0, 10.0, 100.0, 100.0]));
    assert_eq!(drawing.user_units_per_mm, Some(2.0));
    assert_eq!(drawing.warnings.len(), 1, "the root's transform is named");
}

#[test]
fn groups_and_layers_keep_ids_and_nesting() {
    let drawing = read(
        r##"<g id="layer1" inkscape:label="Cut" inkscape:groupmode="layer"><g><path id="p" d="M0 0H1"/></g>
           <a id="link" href="#p"><path id="q" d="M0 0H1"/></a></g><path id="r" d="M0 0H1"/>"##,
    );
    let groups: Vec<_> =
        drawing.groups.iter().map(|g| (g.parent, g.id.as_deref(), g.label.as_deref(), g.is_layer)).collect();
    assert_eq!(
        groups,
        [(None, Some("layer1"), Some("Cut"), true), (Some(0), None, None, false), (Some(0), Some("link"), None, false)]
    );
    let inside: Vec<_> = drawing.paths.iter().map(|p| p.group).collect();
    assert_eq!(inside, [Some(1), Some(2), None]);
}

#[test]
fn what_is_not_displayed_is_left_out() {
    let drawing = read(
        r##"<style>.off{display:none} #ghost{visibility:hidden} rect{display:none}</style>
           <g display="none"><path id="a" d="M0 0H1" display="inline"/></g>
           <g style="fill:none; display : none !important"><path id="b" d="M0 0H1"/></g>
           <path id="c" class="x off" d="M0 0H1"/><path id="ghost" d="M0 0H1"/><rect id="d" width="1" height="1"/>
           <rect id="e" style="display:inline" width="1" height="1"/>
           <g visibility="hidden"><path id="f" d="M0 0H1"/><path id="g" visibility="visible" d="M0 0H1"/></g>
           <defs><path id="h" d="M0 0H1"/></defs><symbol id="i"><path id="j" d="M0 0H1"/></symbol>
           <use href="#a"/><use href="#c"/>"##,
    );
    assert_eq!(ids(&drawing), ["e", "g", "a"], "display:none of a group around the target does not reach an instance");
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
}

#[test]
fn style_sheets_that_are_not_understood_are_named() {
    let drawing = read(
        "<style><![CDATA[ g > path {display:none} @media print {a{stroke:red}} ]]></style><g><path d='M0 0H1'/></g>",
    );
    assert_eq!(drawing.warnings.len(), 1);
    let warning = &drawing.warnings[0];
    assert!(warning.element.starts_with("style at 2:"), "{warning:?}");
    assert!(warning.message.contains("“g > path”, “@media print”"), "{warning:?}");
}

#[test]
fn strokes_are_inherited_and_scaled() {
    let drawing = read(
        r##"<style>.thin{stroke-width:0.5} path.blue{stroke:blue}</style>
           <g stroke="#f00" stroke-width="2" color="teal"><path d="M0 0H1"/><path class="thin blue" d="M0 0H1"/>
           <path stroke="none" d="M0 0H1"/><path style="stroke:currentColor" transform="scale(2 8)" d="M0 0H1"/>
           <path stroke="inherit" stroke-width="-3" d="M0 0H1"/></g><path d="M0 0H1"/>"##,
    );
    let found: Vec<_> = drawing.paths.iter().map(|p| (p.stroke.as_deref(), p.stroke_width)).collect();
    let expected = [
        (Some("#f00"), Some(2.0)),
        (Some("blue"), Some(0.5)),
        (None, None),
        (Some("teal"), Some(8.0)),
        (Some("#f00"), Some(2.0)),
        (None, None),
    ];
    assert_eq!(found, expected);
}

#[test]
fn instances_are_placed_and_nested() {
    let drawing = read(
        r##"<defs><g id="pair" transform="scale(2)"><path id="p" d="M1 1H2"/></g>
           <use id="again" xlink:href="#pair" x="10"/></defs>
           <use id="u" href="#pair" x="5" y="6" transform="translate(100 0)"/><g stroke="red"><use href="#again" y="1"/></g>"##,
    );
    near(&ends(&drawing), &[[107.0, 8.0, 109.0, 8.0], [12.0, 3.0, 14.0, 3.0]]);
    assert_eq!(ids(&drawing), ["p", "p"]);
    assert_eq!(drawing.paths[1].stroke.as_deref(), Some("red"), "style comes from the place of use");
    let chain: Vec<_> = drawing.groups.iter().map(|g| (g.parent, g.id.as_deref())).collect();
    let expected = [
        (None, Some("u")),
        (Some(0), Some("pair")),
        (None, None),
        (Some(2), None),
        (Some(3), Some("again")),
        (Some(4), Some("pair")),
    ];
    assert_eq!(chain, expected);
}

#[test]
fn symbols_and_nested_documents_have_viewports() {
    let drawing = read(
        r##"<symbol id="s" viewBox="0 0 10 10"><path d="M0 0L10 10"/><line x2="50%"/></symbol>
           <use href="#s" x="20" y="30" width="40" height="20"/><use href="#s"/>
           <svg x="10" y="10" width="50%" height="50" viewBox="0 0 5 10" preserveAspectRatio="none"><path d="M0 0L5 10"/></svg>
           <svg x="10" y="10"><path d="M0 0L1 1"/></svg>"##,
    );
    near(
        &ends(&drawing),
        &[
            [30.0, 30.0, 50.0, 50.0],
            [30.0, 30.0, 40.0, 30.0],
            [0.0, 0.0, 100.0, 100.0],
            [0.0, 0.0, 50.0, 0.0],
            [10.0, 10.0, 60.0, 60.0],
            [10.0, 10.0, 11.0, 11.0],
        ],
    );
}

#[test]
fn references_that_lead_nowhere_are_named() {
    let drawing = read(r##"<use id="u" href="#gone"/><use href="other.svg#x"/><use/><path d="M0 0H1"/>"##);
    let found: Vec<_> = drawing.warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        found,
        [
            "refers to “#gone”, which does not exist; left out",
            "refers to “other.svg#x”, which is outside this file; left out",
            "refers to nothing; left out",
        ]
    );
    assert!(drawing.warnings[0].element.starts_with("use #u at 2:"), "{:?}", drawing.warnings[0]);
}

#[test]
fn a_switch_shows_its_first_child_that_passes() {
    let drawing = read(
        r#"<switch><foreignObject requiredExtensions="http://example.org/x"/><path id="de" systemLanguage="de" d="M0 0H1"/>
           <path id="en" systemLanguage="fr, en-GB" d="M0 0H1"/><path id="any" d="M0 0H1"/></switch>
           <switch><path id="de2" systemLanguage="de" d="M0 0H1"/><path id="any2" d="M0 0H1"/></switch>
           <path id="outside" systemLanguage="de" d="M0 0H1"/>"#,
    );
    assert_eq!(ids(&drawing), ["en", "any2"]);
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
}

#[test]
fn what_cannot_be_drawn_is_named_once_with_its_id() {
    let drawing = read(
        r##"<defs><clipPath id="c"><rect width="1" height="1"/></clipPath><mask id="m"/><pattern id="w"/></defs>
           <g id="twice"><text id="t">abc</text></g><use href="#twice"/><image id="i" href="x.png"/><foreignObject id="f"/>
           <g display="none"><text id="hidden">abc</text></g><path id="k" marker-end="url(#x)" d="M0 0H1"/>
           <path id="z" transform="scale(0 1)" d="M0 0H1"/><path clip-path="url(#c)" d="M0 0H1"/>
           <path id="css" style="d:path('M0 0')" d="M0 0H1"/>"##,
    );
    let names: Vec<_> = drawing.warnings.iter().map(|w| w.element.split(" at ").next().unwrap_or_default()).collect();
    assert_eq!(
        names,
        [
            "clipPath #c",
            "mask #m",
            "pattern #w",
            "text #t",
            "image #i",
            "foreignObject #f",
            "path #k",
            "path #z",
            "path #css"
        ]
    );
    assert_eq!(ids(&drawing), ["k", "-", "css"]);
}

#[test]
fn many_warnings_are_counted_not_listed() {
    let drawing = read(&format!("{}<path d='M0 0H1'/>", "<text/>".repeat(1000)));
    assert_eq!(drawing.warnings.len(), 201);
    assert!(drawing.warnings[200].message.starts_with("800 more"), "{:?}", drawing.warnings[200]);
}

#[test]
fn entities_foreign_elements_and_missing_namespaces() {
    let text = r#"<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg"><!ENTITY d "M0 0H1">]>
        <svg xmlns="&ns;" xmlns:x="http://example.org/x"><x:g><path d="&d;"/></x:g><x:path d="M9 9H8"/><path d="&d;"/></svg>"#;
    assert_eq!(ends(&svg::read_str(text, "-").unwrap()), [[0.0, 0.0, 1.0, 0.0]]);
    let bare = "\u{feff}<svg><path d='M0 0H1'/></svg>";
    assert_eq!(svg::read_str(bare, "-").unwrap().paths.len(), 1);
    let prefixed = "<s:svg xmlns:s='http://www.w3.org/2000/svg'><s:path d='M0 0H1'/><path d='M0 0H1'/></s:svg>";
    assert_eq!(svg::read_str(prefixed, "-").unwrap().paths.len(), 1);
}

#[test]
fn coordinates_keep_all_digits_of_f64() {
    let drawing = read(r#"<path d="M 0.1234567890123456 1234567.890123456 L 1e-20 33333333.33333333"/>"#);
    let cubic = &drawing.paths[0].cubics[0];
    assert_eq!((cubic.points[0].x, cubic.points[0].y), (0.1234567890123456, 1234567.890123456));
    assert_eq!((cubic.points[3].x, cubic.points[3].y), (1e-20, 33333333.33333333));
}
