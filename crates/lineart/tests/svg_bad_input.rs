//! Bad input: each kind is one line that names file, element and cause, and a typed error. Nothing panics, nothing
//! runs away.

use std::fs;
use std::path::Path;

use lineart::drawing;
use lineart::svg::{self, SvgError, SvgErrorKind};

fn document(content: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">\n{content}\n</svg>")
}

#[track_caller]
fn refused_text(text: &str) -> SvgError {
    let error = svg::read_str(text, "in.svg").expect_err("this must not be read");
    assert!(!error.to_string().contains('\n'), "one line: {error}");
    error
}

/// The message about a document with this content.
#[track_caller]
fn message(content: &str) -> String {
    refused_text(&document(content)).to_string()
}

#[test]
fn files_that_cannot_be_had() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let refused = |path: &Path| svg::read_file(path).unwrap_err().to_string();
    assert!(refused(&path("none.svg")).ends_with("none.svg: no such file"));
    assert!(refused(folder.path()).ends_with(": is a directory, not a file"));
    fs::write(path("latin.svg"), b"<svg>\xe9</svg>").unwrap();
    assert!(refused(&path("latin.svg")).ends_with("latin.svg: is not UTF-8 text (byte 5)"));
    fs::write(path("a.svgz"), b"\x1f\x8b\x08\x00\x00").unwrap();
    assert!(refused(&path("a.svgz")).contains("compressed with gzip"));
    fs::write(path("empty.svg"), b"").unwrap();
    assert!(refused(&path("empty.svg")).ends_with("empty.svg: not well-formed XML: the file is empty"));
}

#[test]
fn loading_picks_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let (svg, csv) = (document("<path d='M0 0H1'/>"), "0,0,0,0,1,0,2,0,3,0\n");
    assert_eq!(drawing::load(write("a.SVG", &svg)).unwrap().paths[0].element, "path");
    assert_eq!(drawing::load(write("a.csv", csv)).unwrap().paths[0].element, "csv");
    assert_eq!(drawing::load(write("svg", &svg)).unwrap().paths[0].element, "path");
    assert_eq!(drawing::load(write("b.txt", csv)).unwrap().paths[0].element, "csv");
    let wrong = drawing::load(write("c.svg", csv)).unwrap_err().to_string();
    assert!(wrong.contains("c.svg: not well-formed XML"), "{wrong}");
    let missing = drawing::load(folder.path().join("none")).unwrap_err().to_string();
    assert!(missing.ends_with("none: no such file"), "{missing}");
}

#[test]
fn documents_that_are_no_drawing() {
    assert_eq!(refused_text("<html/>").kind(), &SvgErrorKind::NotSvg("html".to_owned()));
    assert_eq!(refused_text("<svg xmlns='http://example.org'/>").kind(), &SvgErrorKind::NotSvg("svg".to_owned()));
    for text in
        ["", "  \n", "hello", "<svg", "<svg>", "<svg><path d='M0 0H1'/>", "<svg><path d='M0 0", "<svg></g></svg>"]
    {
        assert!(matches!(refused_text(text).kind(), SvgErrorKind::Xml(_)), "{text}");
    }
    assert_eq!(
        refused_text("<svg><path>").to_string(),
        "in.svg: not well-formed XML: the file ends before its elements are closed"
    );
}

#[test]
fn every_truncation_of_a_real_drawing_is_refused() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings/leaf_01.svg")).unwrap();
    let end = text.trim_end().len();
    for at in (0..end).step_by(37) {
        if text.is_char_boundary(at) {
            refused_text(&text[..at]);
        }
    }
}

#[test]
fn malformed_attributes_name_element_place_and_cause() {
    assert_eq!(
        message(r#"  <path id="p1" d="M 0 0 L 10 x"/>"#),
        "in.svg: path #p1 at 2:3: d, byte 11: not a finite number: “x”"
    );
    assert_eq!(message(r#"<path d="M 0 0 L NaN 1"/>"#), "in.svg: path at 2:1: d, byte 8: not a finite number: “NaN 1”");
    assert_eq!(message(r#"<path d="M 0 0 C 1 2"/>"#), "in.svg: path at 2:1: d, byte 11: ends in the middle");
    assert_eq!(message(r#"<rect width="-1" height="1"/>"#), "in.svg: rect at 2:1: width: -1 is negative");
    assert_eq!(message(r#"<circle r="1e999"/>"#), "in.svg: circle at 2:1: r, byte 0: not a finite number: “1e999”");
    assert_eq!(message(r#"<circle r="inf"/>"#), "in.svg: circle at 2:1: r, byte 0: not a finite number: “inf”");
    assert_eq!(message(r#"<circle r="2em"/>"#), "in.svg: circle at 2:1: r: “2em” depends on a font; use another unit");
    assert_eq!(message(r#"<polygon points="0 0 1"/>"#), "in.svg: polygon at 2:1: points: an odd number of coordinates");
    assert_eq!(
        message(r#"<g transform="spin(3)"><path d="M0 0H1"/></g>"#),
        "in.svg: g at 2:1: transform, byte 0: unexpected “spin(3)”"
    );
    assert_eq!(
        refused_text("<svg viewBox='0 0 0 5'><path d='M0 0H1'/></svg>").to_string(),
        "in.svg: svg at 1:1: viewBox: “0 0 0 5” has no area"
    );
    assert_eq!(
        refused_text("<svg><line x2='5%'/></svg>").to_string(),
        "in.svg: line at 1:6: x2: “5%” of a viewport whose size the document does not give"
    );
}

#[test]
fn control_characters_do_not_break_the_line() {
    let error = svg::read_str("<svg><path id='a&#10;b' d='M&#10;x'/></svg>", "a\nb.svg").unwrap_err().to_string();
    assert_eq!(error, "a\\nb.svg: path #a\\nb at 1:6: d, byte 2: not a finite number: “x”");
}

#[test]
fn coordinates_out_of_range() {
    let beyond = "has a coordinate that is not finite or beyond 1e100";
    assert_eq!(message(r#"<path id="p" d="M0 0H5V1e300"/>"#), format!("in.svg: path #p at 2:1: segment 2 {beyond}"));
    for content in [
        r#"<path d="M1e300 0H5"/>"#,
        r#"<path d="M0 0h1e308h1e308"/>"#,
        r#"<g transform="scale(1e60)"><g transform="scale(1e60)"><path d="M0 0H5"/></g></g>"#,
        r#"<g transform="scale(1e200)"><g transform="scale(1e200)"><path d="M0 0H5"/></g></g>"#,
        r#"<circle r="1e101"/>"#,
        r#"<path d="M0 0A1e300 1e-300 45 0 1 5 1e200"/>"#,
    ] {
        let error = refused_text(&document(content));
        assert!(matches!(error.kind(), SvgErrorKind::OutOfRange { .. }), "{error}");
    }
    assert_eq!(svg::read_str(&document(r#"<path d="M0 0H1e100"/>"#), "-").unwrap().paths.len(), 1);
}

#[test]
fn documents_without_a_curve() {
    assert_eq!(message(""), "in.svg: no curve to be seen: the document draws nothing");
    assert_eq!(message(r#"<path d="M1 1"/><rect/>"#), "in.svg: no curve to be seen: the document draws nothing");
    let text = message(r#"<text id="t">x</text>"#);
    assert!(text.starts_with("in.svg: no curve to be seen: what there is was left out (text #t at 2:1: "), "{text}");
}

#[test]
fn instances_that_show_themselves() {
    for content in [
        r##"<g id="a"><use href="#a"/></g>"##,
        r##"<use id="u" href="#u"/>"##,
        r##"<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>"##,
        r##"<symbol id="s"><use href="#s"/></symbol><use href="#s"/>"##,
    ] {
        let error = refused_text(&document(content));
        assert!(matches!(error.kind(), SvgErrorKind::Cycle(_)), "{error}");
    }
    let root = "<svg id='r'><use href='#r'/><path d='M0 0H1'/></svg>";
    assert_eq!(refused_text(root).to_string(), "in.svg: use at 1:13: refers to itself");
}

#[test]
fn nesting_and_multiplication_are_bounded() {
    let deep = |n: usize| format!("<svg>{}<path d='M0 0H1'/>{}</svg>", "<g>".repeat(n), "</g>".repeat(n));
    assert_eq!(svg::read_str(&deep(1000), "-").unwrap().groups.len(), 1000);
    for n in [1100, 300_000] {
        let error = refused_text(&deep(n));
        assert!(error.to_string().ends_with("nested more than 1024 deep"), "{error}");
    }
    // Ten instances of ten instances of …: 10¹⁰ in all.
    let mut bomb = String::from("<path id='l0' d='M0 0H1'/><defs>");
    for level in 1..=10 {
        let uses = format!("<use href='#l{}'/>", level - 1).repeat(10);
        bomb.push_str(&format!("<g id='l{level}'>{uses}</g>"));
    }
    bomb.push_str("</defs><use href='#l10'/>");
    let error = refused_text(&document(&bomb));
    assert!(matches!(error.kind(), SvgErrorKind::Limit(..)), "{error}");
    // One path with more lines than a drawing may have.
    let long = format!("<path d='M0 0{}'/>", "h1".repeat(svg::MAX_CUBICS + 1));
    let error = refused_text(&document(&long));
    assert!(error.to_string().contains("path at 2:1: more than 4000000 cubics"), "{error}");
    // The same with entities.
    let mut laughs = String::from("<!DOCTYPE svg [<!ENTITY e0 '<path/>'>");
    for level in 1..=12 {
        laughs.push_str(&format!("<!ENTITY e{level} '{}'>", format!("&e{};", level - 1).repeat(10)));
    }
    laughs.push_str("]><svg>&e12;</svg>");
    assert!(matches!(refused_text(&laughs).kind(), SvgErrorKind::Xml(_)));
}

#[test]
fn all_points_equal_is_not_the_readers_business() {
    let drawing = svg::read_str(&document(r#"<path d="M1 1L1 1 1 1Z"/>"#), "-").unwrap();
    assert_eq!(drawing.paths[0].cubics.len(), 2);
}
