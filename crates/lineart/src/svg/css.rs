//! As much of CSS as line art needs: `<style>` elements with simple selectors, and `style` attributes.
//!
//! Drawing programs write style sheets of one form: type, class and id selectors, alone or run together
//! (`path.cut#outline`), in lists with commas. These are read, with CSS's specificity and `!important`. Selectors
//! with combinators, attributes or pseudo-classes and all at-rules are not; each that sets a property which matters
//! here is reported, so that nothing is hidden or shown against the author's will unnoticed.
//!
//! Why not a CSS crate: the small one (`simplecss`) drops what it does not know with a message to a logger only,
//! gives up a `style` attribute at its first malformed declaration, and matches descendant selectors by unbounded
//! backtracking; the large ones bring forty crates.

use roxmltree::Node;

/// The properties that the reader asks for; a rule that sets none of them is of no interest. The first
/// [`ATTRIBUTES`] are presentation attributes too; the rest is geometry, which CSS may set but the reader takes from
/// attributes only.
pub(super) const PROPERTIES: [&str; 20] = [
    "display",
    "visibility",
    "fill",
    "stroke",
    "stroke-width",
    "color",
    "transform",
    "transform-origin",
    "marker",
    "marker-start",
    "marker-mid",
    "marker-end",
    "d",
    "x",
    "y",
    "cx",
    "cy",
    "r",
    "rx",
    "ry",
];

/// How many of [`PROPERTIES`] are presentation attributes.
pub(super) const ATTRIBUTES: usize = 12;

/// `name: value`, with or without `!important`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Declaration<'a> {
    /// Index in [`PROPERTIES`].
    pub(super) property: usize,
    pub(super) value: &'a str,
    pub(super) important: bool,
}

/// The declarations of a `style` attribute or of a rule's block that concern [`PROPERTIES`], in order.
pub(super) fn declarations(block: &str) -> impl Iterator<Item = Declaration<'_>> {
    split_outside_quotes(block, ';').filter_map(|text| {
        let (name, value) = text.split_once(':')?;
        let name = name.trim();
        let property = PROPERTIES.iter().position(|p| p.eq_ignore_ascii_case(name))?;
        let value = value.trim();
        let plain = value.rsplit_once('!').filter(|(_, word)| word.trim().eq_ignore_ascii_case("important"));
        let (value, important) = plain.map_or((value, false), |(value, _)| (value.trim_end(), true));
        Some(Declaration { property, value, important })
    })
}

/// `type.class.class#id`; no type stands for any.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Selector<'a> {
    tag: Option<&'a str>,
    id: Option<&'a str>,
    classes: Vec<&'a str>,
}

impl<'a> Selector<'a> {
    fn parse(text: &'a str) -> Option<Self> {
        let mut selector = Self { tag: None, id: None, classes: Vec::new() };
        let mut rest = text.trim();
        if rest.is_empty() {
            return None;
        }
        if let Some(after) = rest.strip_prefix('*') {
            rest = after;
        } else if !rest.starts_with(['.', '#']) {
            let (tag, after) = identifier(rest)?;
            selector.tag = Some(tag);
            rest = after;
        }
        while !rest.is_empty() {
            let (name, after) = identifier(rest.get(1..)?)?;
            match rest.as_bytes().first()? {
                b'.' => selector.classes.push(name),
                b'#' if selector.id.is_none() => selector.id = Some(name),
                _ => return None,
            }
            rest = after;
        }
        Some(selector)
    }

    fn specificity(&self) -> (usize, usize, usize) {
        (usize::from(self.id.is_some()), self.classes.len(), usize::from(self.tag.is_some()))
    }

    fn matches(&self, element: Node<'_, '_>) -> bool {
        let has_class = |class: &str| {
            element.attribute("class").is_some_and(|list| list.split_ascii_whitespace().any(|c| c == class))
        };
        self.tag.is_none_or(|tag| element.tag_name().name() == tag)
            && self.id.is_none_or(|id| element.attribute("id") == Some(id))
            && self.classes.iter().all(|class| has_class(class))
    }
}

/// A CSS identifier at the start of `text`, and what follows it.
fn identifier(text: &str) -> Option<(&str, &str)> {
    let end =
        text.find(|c: char| !(c.is_alphanumeric() || c == '-' || c == '_' || !c.is_ascii())).unwrap_or(text.len());
    if end == 0 { None } else { Some(text.split_at(end)) }
}

/// The rules of a document's `<style>` elements, weakest first.
#[derive(Clone, Debug, Default)]
pub(super) struct StyleSheet<'a> {
    rules: Vec<(Selector<'a>, Vec<Declaration<'a>>)>,
}

impl<'a> StyleSheet<'a> {
    /// Adds the rules of one style sheet, without comments (see [`without_comments`]); hands the text of every
    /// selector or at-rule that is not understood to `unread`.
    pub(super) fn add(&mut self, text: &'a str, mut unread: impl FnMut(&str)) {
        let mut rest = text.trim_start_matches(is_filler);
        while !rest.is_empty() {
            let Some(open) = rest.find(['{', ';']) else { break };
            let prelude = rest[..open].trim();
            if rest.as_bytes()[open] == b';' {
                // An at-rule without a block, @import say; or a stray semicolon.
                if prelude.starts_with('@') && !prelude.starts_with("@charset") {
                    unread(prelude);
                }
                rest = rest[open + 1..].trim_start_matches(is_filler);
                continue;
            }
            let body = &rest[open + 1..];
            let close = block_end(body);
            let block = &body[..close];
            if prelude.starts_with('@') {
                if !prelude.starts_with("@font-face") {
                    unread(prelude);
                }
            } else {
                self.add_rule(prelude, block, &mut unread);
            }
            rest = body.get(close + 1..).unwrap_or_default().trim_start_matches(is_filler);
        }
        // Stable: later rules of the same specificity win.
        self.rules.sort_by_key(|(selector, _)| selector.specificity());
    }

    fn add_rule(&mut self, prelude: &'a str, block: &'a str, unread: &mut impl FnMut(&str)) {
        let declarations: Vec<_> = declarations(block).collect();
        if declarations.is_empty() {
            return;
        }
        for text in prelude.split(',') {
            match Selector::parse(text) {
                Some(selector) => self.rules.push((selector, declarations.clone())),
                None => unread(text.trim()),
            }
        }
    }

    /// The declarations of all rules that match, weakest first.
    pub(super) fn matching<'s>(&'s self, element: Node<'s, 's>) -> impl Iterator<Item = &'s Declaration<'a>> + 's {
        self.rules.iter().filter(move |(selector, _)| selector.matches(element)).flat_map(|(_, block)| block)
    }
}

/// What may stand between rules: white space, and braces too many.
fn is_filler(c: char) -> bool {
    c.is_whitespace() || c == '}'
}

/// The text without `/* … */` and without HTML's comment marks, inside which old files hide their rules.
pub(super) fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        out.push_str(before);
        out.push(' ');
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    out.push_str(rest);
    out.replace("<!--", "").replace("-->", "")
}

/// Offset of the brace that closes a block, or the end.
fn block_end(body: &str) -> usize {
    let mut depth = 0_usize;
    let mut quote = None;
    for (at, c) in body.char_indices() {
        match (quote, c) {
            (Some(q), _) if q == c => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '{') => depth += 1,
            (None, '}') if depth == 0 => return at,
            (None, '}') => depth -= 1,
            _ => {}
        }
    }
    body.len()
}

/// The pieces of `text` between separators that stand outside quotes and parentheses (data URLs hold semicolons).
fn split_outside_quotes(text: &str, separator: char) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let current = rest?;
        let mut depth = 0_usize;
        let mut quote = None;
        let cut = current.char_indices().find(|&(_, c)| {
            match (quote, c) {
                (Some(q), _) if q == c => quote = None,
                (Some(_), _) => {}
                (None, '"' | '\'') => quote = Some(c),
                (None, '(') => depth += 1,
                (None, ')') => depth = depth.saturating_sub(1),
                (None, c) => return c == separator && depth == 0,
            }
            false
        });
        match cut {
            Some((at, c)) => {
                rest = Some(&current[at + c.len_utf8()..]);
                Some(&current[..at])
            }
            None => rest.take(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(block: &str) -> Vec<(&str, &str, bool)> {
        declarations(block).map(|d| (PROPERTIES[d.property], d.value, d.important)).collect()
    }

    #[test]
    fn declarations_are_taken_apart() {
        assert_eq!(
            pairs("fill:none; STROKE : #f00 ;stroke-width:2px;; display:none ! important"),
            [
                ("fill", "none", false),
                ("stroke", "#f00", false),
                ("stroke-width", "2px", false),
                ("display", "none", true)
            ]
        );
        assert_eq!(
            pairs("nonsense; =; fill:url(data:x;display:none); display:inline"),
            [("fill", "url(data:x;display:none)", false), ("display", "inline", false)]
        );
        assert_eq!(pairs("font-family:'a;display:none';stroke:red"), [("stroke", "red", false)]);
        assert_eq!(pairs(""), []);
    }

    fn displays(sheet: &str, element: &str) -> (Option<String>, Vec<String>) {
        let document = roxmltree::Document::parse(element).unwrap();
        let text = without_comments(sheet);
        let mut unread = Vec::new();
        let mut style = StyleSheet::default();
        style.add(&text, |s| unread.push(s.to_owned()));
        let display = style.matching(document.root_element()).last().map(|d| d.value.to_owned());
        (display, unread)
    }

    #[test]
    fn simple_selectors_match_by_specificity() {
        let element = r#"<path id="p" class="a b"/>"#;
        let of = |sheet| displays(sheet, element).0;
        assert_eq!(of("path{display:none}").as_deref(), Some("none"));
        assert_eq!(of("*{display:none}").as_deref(), Some("none"));
        assert_eq!(of(".a{display:none} /* .a{display:inline} */ path { display: block }").as_deref(), Some("none"));
        assert_eq!(of("#p{display:none} .a.b{display:x}").as_deref(), Some("none"));
        assert_eq!(of("rect, path.b#p {display:none}").as_deref(), Some("none"));
        assert_eq!(of("path{display:x} path{display:y}").as_deref(), Some("y"));
        assert_eq!(of("rect{display:none} .c{display:none} #q{display:none} path.c{display:none}"), None);
        assert_eq!(of("<!-- path{display:none} -->").as_deref(), Some("none"));
    }

    #[test]
    fn what_is_not_read_is_reported_where_it_matters() {
        let (display, unread) = displays(
            "g > path {display:none} a:hover{fill:red} @media print {path{display:none}} @import 'x'; path[d]{stroke:red}\
             @font-face{src:url(x)} path{display:x}",
            "<path/>",
        );
        assert_eq!(display.as_deref(), Some("x"));
        assert_eq!(unread, ["g > path", "a:hover", "@media print", "@import 'x'", "path[d]"]);
    }

    #[test]
    fn broken_sheets_end_quietly() {
        for sheet in
            ["{", "}", "path{", "path{display:none", "@", "@;", "/*", "a{b}}}c{display:none}", ",{display:none}"]
        {
            let _ = displays(sheet, "<path/>");
        }
        assert_eq!(displays("}} path{display:none", "<path/>").0.as_deref(), Some("none"));
    }
}
