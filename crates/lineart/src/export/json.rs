//! JSON: one object, `{version, source, options, diagonal, paths: [{closed, samples: […]}]}`.
//!
//! `version` is the version of this layout and counts up when a reader would have to change. The rows have the columns
//! of the tables as keys. One row per line: large files stay readable and a difference shows where it is. JSON has no
//! infinity, so an infinite lfs is `null`.
//!
//! The layout is small and fixed, so it is written by hand, without a serialisation library.

use std::fmt;
use std::io::{self, Write};

use super::number::JsonNumber;
use super::{Header, LfsRow, MedialRow, OptionValue, PathRows, SampleRow};

/// The version of the layout.
pub const VERSION: u32 = 1;

/// A JSON string with its quotes.
#[derive(Clone, Copy, Debug)]
pub struct JsonText<'a>(pub &'a str);

impl fmt::Display for JsonText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"")?;
        for c in self.0.chars() {
            match c {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                '\n' => f.write_str("\\n")?,
                '\r' => f.write_str("\\r")?,
                '\t' => f.write_str("\\t")?,
                c if u32::from(c) < 0x20 => write!(f, "\\u{:04x}", u32::from(c))?,
                c => write!(f, "{c}")?,
            }
        }
        f.write_str("\"")
    }
}

/// Writes samples.
///
/// # Errors
/// Those of `out`.
pub fn samples(out: &mut dyn Write, header: &Header, paths: &[PathRows<SampleRow>]) -> io::Result<()> {
    document(out, header, "samples", paths, |out, row| {
        let [t, x, y, lfs] = [row.t, row.x, row.y, row.lfs].map(JsonNumber);
        let SampleRow { path, segment, bound, .. } = row;
        write!(out, r#"{{"path":{path},"segment":{segment},"t":{t},"x":{x},"y":{y},"lfs":{lfs},"bound":"{bound}"}}"#)
    })
}

/// Writes medial points; the rows stand under `medial`.
///
/// # Errors
/// Those of `out`.
pub fn medial(out: &mut dyn Write, header: &Header, paths: &[PathRows<MedialRow>]) -> io::Result<()> {
    document(out, header, "medial", paths, |out, row| {
        let [t, x, y, mx, my, radius] = [row.t, row.x, row.y, row.mx, row.my, row.radius].map(JsonNumber);
        let MedialRow { path, segment, side, polyline, .. } = row;
        write!(out, r#"{{"path":{path},"segment":{segment},"t":{t},"x":{x},"y":{y},"side":"{side}","#)?;
        write!(out, r#""mx":{mx},"my":{my},"radius":{radius},"polyline":{polyline}}}"#)
    })
}

/// Writes local feature sizes; the rows stand under `lfs`.
///
/// # Errors
/// Those of `out`.
pub fn lfs(out: &mut dyn Write, header: &Header, paths: &[PathRows<LfsRow>]) -> io::Result<()> {
    document(out, header, "lfs", paths, |out, row| {
        let [t, x, y, lfs] = [row.t, row.x, row.y, row.lfs].map(JsonNumber);
        let LfsRow { path, segment, .. } = row;
        write!(out, r#"{{"path":{path},"segment":{segment},"t":{t},"x":{x},"y":{y},"lfs":{lfs}"#)?;
        if let Some(bounds) = row.bounds {
            let [lower, upper] = bounds.map(JsonNumber);
            write!(out, r#","lower":{lower},"upper":{upper}"#)?;
        }
        write!(out, "}}")
    })
}

/// The object around the rows, which stand in an array under `key`.
fn document<R>(
    out: &mut dyn Write,
    header: &Header,
    key: &str,
    paths: &[PathRows<R>],
    write_row: impl Fn(&mut dyn Write, &R) -> io::Result<()>,
) -> io::Result<()> {
    writeln!(out, "{{\n\"version\":{VERSION},\n\"source\":{},", JsonText(&header.source))?;
    write!(out, "\"options\":{{")?;
    for (i, (name, value)) in header.options.iter().enumerate() {
        write!(out, "{}{}:", if i == 0 { "" } else { "," }, JsonText(name))?;
        match value {
            OptionValue::Number(number) => write!(out, "{}", JsonNumber(*number))?,
            OptionValue::Text(text) => write!(out, "{}", JsonText(text))?,
        }
    }
    write!(out, "}},\n\"diagonal\":{},\n\"paths\":[", JsonNumber(header.diagonal))?;
    for (i, path) in paths.iter().enumerate() {
        write!(out, "{}\n{{\"closed\":{},\"{key}\":[", if i == 0 { "" } else { "," }, path.closed)?;
        for (j, row) in path.rows.iter().enumerate() {
            write!(out, "{}", if j == 0 { "\n" } else { ",\n" })?;
            write_row(out, row)?;
        }
        write!(out, "]}}")?;
    }
    writeln!(out, "]\n}}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_and_keeps_infinity_apart() {
        let row = |lfs| SampleRow { path: 0, segment: 0, t: 0.25, x: 0.1, y: -2.0, lfs, bound: "start" };
        let header = Header {
            source: "a \"b\"\\\u{1}é.svg".to_owned(),
            options: vec![("epsilon", OptionValue::Number(0.5)), ("format", OptionValue::Text("json".to_owned()))],
            diagonal: 10.0,
        };
        let paths = [
            PathRows { closed: true, rows: vec![row(1.5), row(f64::INFINITY)] },
            PathRows { closed: false, rows: vec![] },
        ];
        let mut out = Vec::new();
        samples(&mut out, &header, &paths).expect("written");
        let value: serde_json::Value = serde_json::from_slice(&out).expect("valid JSON");
        assert_eq!(value["version"], 1, "layout version");
        assert_eq!(value["source"], header.source.as_str(), "escaped and back");
        assert_eq!(value["options"]["epsilon"], 0.5, "options by name");
        assert_eq!(value["paths"][0]["samples"][0]["lfs"], 1.5, "finite lfs");
        assert!(value["paths"][0]["samples"][1]["lfs"].is_null(), "infinite lfs");
        assert_eq!(value["paths"][1]["samples"].as_array().map(Vec::len), Some(0), "a path without samples");
    }
}
