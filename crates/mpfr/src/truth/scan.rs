//! The public functions of the kernel, read from its source.
//!
//! A scanner of lines, not a parser: it relies on the layout that rustfmt gives. It knows modules by files, `impl` and
//! `pub trait` blocks at the margin, and stops at the tests at the end of a file.

use std::fs;
use std::io;
use std::path::Path;

/// Names of all `pub fn` and of the functions of public traits below a source folder, sorted: `module::Type::name`.
///
/// # Errors
/// A folder or file that cannot be read.
pub fn public_functions(source: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    folder(source, "", &mut names)?;
    names.sort();
    names.dedup();
    Ok(names)
}

fn folder(folder_path: &Path, module: &str, names: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(folder_path)? {
        let path = entry?.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let inner = match (stem.as_str(), module) {
            ("mod" | "lib", _) => module.to_owned(),
            (stem, "") => stem.to_owned(),
            (stem, module) => format!("{module}::{stem}"),
        };
        if path.is_dir() {
            folder(&path, &inner, names)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            file(&fs::read_to_string(&path)?, &inner, names);
        }
    }
    Ok(())
}

fn file(text: &str, module: &str, names: &mut Vec<String>) {
    // The type or trait whose block the line stands in, and whether all of its functions are public.
    let mut block: Option<(String, bool)> = None;
    for line in text.lines() {
        if line.starts_with("#[cfg(test)]") {
            break;
        }
        if line.starts_with('}') {
            block = None;
        } else if line.starts_with("impl") && !line.ends_with('}') {
            // `impl Trait for Type` has no `pub fn`; what it computes stands at the trait.
            block = (!line.contains(" for ")).then(|| (type_of(line), false));
        } else if let Some(rest) = line.strip_prefix("pub trait ") {
            block = Some((word(rest), true));
        }
        let code = line.trim_start();
        let indented = code.len() < line.len();
        let declared = ["pub fn ", "pub const fn "].iter().find_map(|start| code.strip_prefix(start));
        let declared = declared.or_else(|| match &block {
            Some((_, true)) if indented && line.starts_with("    fn ") => code.strip_prefix("fn "),
            _ => None,
        });
        if let Some(rest) = declared {
            let name = word(rest);
            names.push(match &block {
                Some((owner, _)) if indented => format!("{module}::{owner}::{name}"),
                _ => format!("{module}::{name}"),
            });
        }
    }
}

/// The identifier that a text starts with.
fn word(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// The type of an `impl` line: what follows the generic parameters.
fn type_of(line: &str) -> String {
    // The arrow of a function type closes nothing.
    let rest = &line.strip_prefix("impl").unwrap_or(line).replace("->", "  ");
    let mut depth = 0_usize;
    let mut start = 0;
    if rest.starts_with('<') {
        for (i, c) in rest.char_indices() {
            depth = match c {
                '<' => depth + 1,
                '>' => depth - 1,
                _ => depth,
            };
            if depth == 0 {
                start = i + 1;
                break;
            }
        }
    }
    word(rest[start..].trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_counts() {
        let text = "pub fn free<S: Scalar>(x: S) {}\nfn private() {}\npub(crate) fn inner() {}\n\
                    impl<S: Scalar, const N: usize> Type<S, N> {\n    pub const fn new() {}\n    fn hidden() {}\n}\n\
                    impl<'a, V: Fn(u32) -> S> Other<'a, V> {\n    #[inline]\n    pub fn get(&self) {}\n}\n\
                    pub trait Law: Clone {\n    fn law(&self);\n}\nimpl Law for Type {\n    fn law(&self) {}\n}\n\
                    #[cfg(test)]\nmod tests {\n    pub fn helper() {}\n}\n";
        let mut names = Vec::new();
        file(text, "m", &mut names);
        assert_eq!(names, ["m::free", "m::Type::new", "m::Other::get", "m::Law::law"]);
    }
}
