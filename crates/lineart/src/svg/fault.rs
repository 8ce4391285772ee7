//! What is wrong with one attribute's value, before anyone knows whose attribute it is.

/// A cause and where in the value it lies; the tree walk adds element and attribute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// Byte offset in the value.
    pub(super) at: Option<usize>,
    /// In plain words.
    pub(super) cause: String,
}

/// How much of the text after the place of error a message repeats.
const EXCERPT: usize = 16;

impl Fault {
    pub(super) fn new(cause: impl Into<String>) -> Self {
        Self { at: None, cause: cause.into() }
    }

    /// A parser's error about `text`, with the offset in bytes and what stands there.
    pub(super) fn from_svgtypes(error: svgtypes::Error, text: &str) -> Self {
        use svgtypes::Error as E;
        // The parser counts characters from 1.
        let (position, what) = match error {
            E::UnexpectedEndOfStream => (None, "ends in the middle"),
            E::UnexpectedData(at) | E::InvalidChar(_, at) | E::InvalidString(_, at) => (Some(at), "unexpected"),
            E::InvalidNumber(at) => (Some(at), "not a finite number:"),
            E::InvalidValue | E::InvalidIdent => return Self::new(format!("not understood: “{}”", excerpt(text, 0))),
        };
        let at = position
            .and_then(|p| text.char_indices().nth(p.saturating_sub(1)))
            .map_or(text.len(), |(offset, _)| offset);
        if text[at..].trim().is_empty() {
            return Self { at: Some(at), cause: "ends in the middle".to_owned() };
        }
        Self { at: Some(at), cause: format!("{what} “{}”", excerpt(text, at)) }
    }
}

/// The first few characters of `text` from byte `at` on.
fn excerpt(text: &str, at: usize) -> String {
    let tail = text.get(at..).unwrap_or_default();
    let mut shown: String = tail.chars().take(EXCERPT).collect();
    if shown.len() < tail.len() {
        shown.push('…');
    }
    shown
}
