//! Tables with notes, and their Markdown, CSV and JSON.

use std::fmt::Write;

use lineart::export::json::JsonText;
use lineart::export::number::{JsonNumber, Number};

use crate::bars::Bars;
use crate::plot::Plot;

/// What an experiment came to: tables and plots.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The experiment: `table1`; files are named after it.
    pub name: &'static str,
    /// Tables; the first is the one the experiment is named after.
    pub tables: Vec<Table>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// Bar charts.
    pub bars: Vec<Bars>,
    /// Other pictures: names of files, and what is in them.
    pub pictures: Vec<(String, String)>,
}

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// A word for file names and keys: `table1`.
    pub name: String,
    /// A heading.
    pub title: String,
    /// Names of the columns, as CSV has them.
    pub columns: Vec<String>,
    /// Rows with a cell for each column.
    pub rows: Vec<Vec<Cell>>,
    /// What a reader must know: rules, sources, explanations; a paragraph each.
    pub notes: Vec<String>,
}

/// A place in a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number; Markdown shows it with three significant digits, the other forms with all of them.
    Number(f64),
    /// A count; shown in full everywhere.
    Count(u64),
    /// Nothing was measured or printed here.
    Empty,
}

impl Cell {
    /// Words.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A count that a unit found; NaN is an empty cell.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts are small and not negative")]
    pub fn count(value: f64) -> Self {
        if value.is_nan() { Self::Empty } else { Self::Count(value as u64) }
    }

    /// A number; NaN is an empty cell.
    pub fn number(value: f64) -> Self {
        if value.is_nan() { Self::Empty } else { Self::Number(value) }
    }

    fn markdown(&self) -> String {
        match self {
            Self::Text(text) => text.replace('|', "\\|"),
            Self::Number(value) => three_digits(*value),
            Self::Count(count) => count.to_string(),
            Self::Empty => "–".to_owned(),
        }
    }

    fn csv(&self) -> String {
        match self {
            Self::Text(text) if text.contains([',', '"', '\n']) => format!("\"{}\"", text.replace('"', "\"\"")),
            Self::Text(text) => text.clone(),
            Self::Number(value) => Number(*value).to_string(),
            Self::Count(count) => count.to_string(),
            Self::Empty => String::new(),
        }
    }

    fn json(&self) -> String {
        match self {
            Self::Text(text) => JsonText(text).to_string(),
            Self::Number(value) => JsonNumber(*value).to_string(),
            Self::Count(count) => count.to_string(),
            Self::Empty => "null".to_owned(),
        }
    }
}

/// A number with three significant digits.
pub fn three_digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() {
        return Number(value).to_string();
    }
    match size {
        s if !(9.995e-4..99_950.0).contains(&s) => format!("{value:.2e}"),
        s if s >= 99.95 => format!("{value:.0}"),
        s if s >= 9.995 => format!("{value:.1}"),
        s if s >= 0.9995 => format!("{value:.2}"),
        s if s >= 0.099_95 => format!("{value:.3}"),
        s if s >= 0.009_995 => format!("{value:.4}"),
        _ => format!("{value:.5}"),
    }
}

impl Table {
    /// An empty table.
    pub fn new(name: impl Into<String>, title: impl Into<String>, columns: &[&str]) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            columns: columns.iter().map(|&column| column.to_owned()).collect(),
            rows: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Heading, table, notes.
    pub fn markdown(&self) -> String {
        let mut out = format!("## {}\n| {} |\n", self.title, self.columns.join(" | "));
        out.push_str(&"|---".repeat(self.columns.len()));
        out.push_str("|\n");
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(Cell::markdown).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(out, "| {} |", cells.join(" | "));
        }
        for note in &self.notes {
            let _ = write!(out, "\n{note}\n");
        }
        out
    }

    /// A header and rows; numbers in shortest round-trip form, empty fields where there is no value.
    pub fn csv(&self) -> String {
        let mut out = self.columns.join(",") + "\n";
        for row in &self.rows {
            out.push_str(&row.iter().map(Cell::csv).collect::<Vec<_>>().join(","));
            out.push('\n');
        }
        out
    }

    fn json(&self) -> String {
        let list = |items: Vec<String>| format!("[{}]", items.join(","));
        let texts = |texts: &[String]| list(texts.iter().map(|text| JsonText(text).to_string()).collect());
        let rows: Vec<String> = self.rows.iter().map(|row| list(row.iter().map(Cell::json).collect())).collect();
        format!(
            "{{\"name\":{},\"title\":{},\"columns\":{},\"rows\":[\n{}\n],\"notes\":{}}}",
            JsonText(&self.name),
            JsonText(&self.title),
            texts(&self.columns),
            rows.join(",\n"),
            texts(&self.notes)
        )
    }
}

impl Report {
    /// All tables.
    pub fn markdown(&self) -> String {
        self.tables.iter().map(Table::markdown).collect::<Vec<_>>().join("\n")
    }

    /// The first table, which is the one that the experiment is named after.
    pub fn csv(&self) -> String {
        self.tables.first().map(Table::csv).unwrap_or_default()
    }

    /// `{version, experiment, tables: [{name, title, columns, rows, notes}]}`.
    pub fn json(&self) -> String {
        let tables: Vec<String> = self.tables.iter().map(Table::json).collect();
        format!("{{\"version\":1,\"experiment\":{},\"tables\":[{}]}}\n", JsonText(self.name), tables.join(",\n"))
    }

    /// Every file of the report: name and content.
    pub fn files(&self) -> Vec<(String, String)> {
        let mut files =
            vec![(format!("{}.md", self.name), self.markdown()), (format!("{}.json", self.name), self.json())];
        files.extend(self.tables.iter().map(|table| (format!("{}.csv", table.name), table.csv())));
        files.extend(self.plots.iter().map(|plot| (format!("{}.svg", plot.name), plot.svg())));
        files.extend(self.bars.iter().map(|bars| (format!("{}.svg", bars.name), bars.svg())));
        files.extend(self.pictures.iter().cloned());
        files
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1234.0, "1234"),
            (12.345, "12.3"),
            (0.0499, "0.0499"),
            (0.999_9, "1.00"),
            (1.46e-6, "1.46e-6"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(three_digits(value), text, "{value}");
        }
    }

    #[test]
    fn all_forms_say_the_same() {
        let mut table = Table::new("t", "A, b", &["name", "value", "count"]);
        table.rows.push(vec![Cell::text("a,b|\"c\""), Cell::number(1.0 / 3.0), Cell::Count(7)]);
        table.rows.push(vec![Cell::text("d"), Cell::number(f64::NAN), Cell::number(f64::INFINITY)]);
        table.notes.push("A note.".into());
        assert_eq!(table.csv(), "name,value,count\n\"a,b|\"\"c\"\"\",0.3333333333333333,7\nd,,inf\n");
        assert_eq!(
            table.markdown(),
            "## A, b\n| name | value | count |\n|---|---|---|\n| a,b\\|\"c\" | 0.333 | 7 |\n| d | – | inf |\n\nA note.\n"
        );
        let report = Report { name: "t", tables: vec![table], plots: vec![], bars: vec![], pictures: vec![] };
        let json: serde_json::Value = serde_json::from_str(&report.json()).expect("JSON");
        assert_eq!(json["tables"][0]["rows"][0][1], 1.0 / 3.0, "all digits");
        assert!(json["tables"][0]["rows"][1][2].is_null(), "JSON knows no infinity");
    }
}
