//! Whatever the reader is fed, it answers with a drawing or an error: no panic, no endless loop, and a drawing keeps
//! its promises.

use std::fs;
use std::path::Path;
use std::sync::OnceLock;

use lineart::drawing::Drawing;
use lineart::{csv_in, svg, text_in, units};
use proptest::prelude::*;

/// What every drawing promises: finite coordinates, chains without gaps, closed paths that close to the bit, groups
/// after their parents.
fn promises(drawing: &Drawing) -> Result<(), TestCaseError> {
    prop_assert!(!drawing.paths.is_empty());
    for (index, group) in drawing.groups.iter().enumerate() {
        prop_assert!(group.parent.is_none_or(|parent| parent < index));
    }
    for path in &drawing.paths {
        prop_assert!(path.group.is_none_or(|group| group < drawing.groups.len()));
        prop_assert!(!path.cubics.is_empty());
        for point in path.cubics.iter().flat_map(|c| &c.points) {
            prop_assert!(point.x.abs() <= svg::MAX_COORDINATE && point.y.abs() <= svg::MAX_COORDINATE);
        }
        for pair in path.cubics.windows(2) {
            prop_assert_eq!(pair[0].end(), pair[1].start());
        }
        if path.closed {
            prop_assert_eq!(path.cubics.last().map(|c| c.end()), path.cubics.first().map(|c| c.start()));
        }
    }
    Ok(())
}

fn feed(text: &str) -> Result<(), TestCaseError> {
    match svg::read_str(text, "fuzz.svg") {
        Ok(drawing) => promises(&drawing),
        Err(error) => {
            let line = error.to_string();
            prop_assert!(line.starts_with("fuzz.svg: ") && !line.contains('\n'), "{}", line);
            Ok(())
        }
    }
}

/// The drawings that ship.
fn drawings() -> &'static [Vec<u8>] {
    static DRAWINGS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    DRAWINGS.get_or_init(|| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings");
        ["leaf_01", "celtic_triskell_01", "seal_sek_"]
            .map(|name| fs::read(folder.join(name).with_extension("svg")).expect("the drawing ships"))
            .into()
    })
}

/// Pieces that a document may be made of, whole and broken.
const PIECES: [&str; 40] = [
    "<g>",
    "</g>",
    "<g transform='",
    "scale(0)",
    "rotate(45 1 1)",
    "'>",
    "<path d='",
    "M0 0",
    "h1e99",
    "c1 2 3 4 5 6",
    "a1 1 0 011 1",
    "z",
    "'/>",
    "<use href='#a'/>",
    "<use href='#b' x='1%'/>",
    "<g id='a'>",
    "<symbol id='b'>",
    "</symbol>",
    "<svg viewBox='0 0 1 1' width='5'>",
    "</svg>",
    "<style>",
    "g{display:none}",
    "path,#a.x{stroke:red}",
    "@media{",
    "}",
    "</style>",
    "<switch>",
    "</switch>",
    "<rect width='1' height='2' rx='1'/>",
    "<circle r='1e50'/>",
    "<ellipse ry='1%'/>",
    "<polygon points='0 0 1 1 2 0'/>",
    "<text/>",
    "<clipPath id='a'/>",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "&amp;",
    "&#x0;",
];

fn path_text() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        any::<f64>().prop_map(|v| v.to_string()),
        (-1e3..1e3).prop_map(|v: f64| format!("{v:.3}")),
        (-5..5).prop_map(|v: i32| v.to_string()),
        Just("1e400".to_owned()),
        Just("-.5e-3".to_owned()),
        Just("0".to_owned()),
    ];
    let command = prop::sample::select("MmLlHhVvCcSsQqTtAaZz".chars().collect::<Vec<_>>());
    let part = (command, prop::collection::vec(number, 0..9), prop::sample::select(vec![" ", ",", "\n", ""]));
    prop::collection::vec(part, 0..12).prop_map(|parts| {
        let text: String =
            parts.iter().map(|(command, numbers, gap)| format!("{command}{}{gap}", numbers.join(" "))).collect();
        format!("M0 0{text}")
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        if let Ok(text) = text_in::read(&bytes[..]) {
            feed(&text)?;
            let _ = csv_in::read_str(&text, "fuzz.csv");
        }
    }

    #[test]
    fn random_text(text in ".{0,60}") {
        feed(&format!("<svg viewBox='0 0 9 9'><path d='M0 0H1'/><g transform='{text}'/></svg>"))?;
        feed(&format!("<svg viewBox='0 0 9 9'><path d='M0 0H1' style='{text}'/><circle r='{text}'/></svg>"))?;
        feed(&format!("<svg viewBox='{text}' width='{text}' preserveAspectRatio='{text}'><path d='M0 0H1'/></svg>"))?;
        feed(&format!("<svg><style>{text}</style><polyline points='{text}'/><path d='M0 0H1'/></svg>"))?;
        if let Ok(length) = text.parse::<units::Length>() {
            prop_assert!(length.value() >= 0.0 && length.value().is_finite());
        }
    }

    #[test]
    fn random_style_sheets(parts in prop::collection::vec("[a-c.#*{};:, @'\"()/!-]{0,6}|display:none|stroke:|/\\*|\\*/", 0..30)) {
        let text = parts.concat();
        feed(&format!("<svg><style><![CDATA[{text}]]></style><path class='a b' id='c' d='M0 0H1'/></svg>"))?;
    }

    #[test]
    fn random_paths(data in path_text(), transform in "(|scale\\([-0-9.e]{1,6}\\)|skewX\\(9[0-9]\\))") {
        feed(&format!("<svg><path transform='{transform}' d='{data}'/></svg>"))?;
    }

    #[test]
    fn random_documents(parts in prop::collection::vec(prop::sample::select(PIECES.to_vec()), 0..40)) {
        feed(&format!("<svg>{}</svg>", parts.concat()))?;
    }

    #[test]
    fn random_rows(text in "([01],[01](,-?[0-9.e]{0,4}){8}\n){0,6}") {
        if let Ok(drawing) = csv_in::read_str(&text, "fuzz.csv") {
            promises(&drawing)?;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_drawings(
        which in 0..3_usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3), 1..8),
    ) {
        let mut bytes = drawings()[which].clone();
        for (index, byte, kind) in edits {
            let at = index.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte % 96 + 32),
                _ => { bytes.remove(at); }
            }
        }
        if let Ok(text) = text_in::read(&bytes[..]) {
            feed(&text)?;
        }
    }
}
