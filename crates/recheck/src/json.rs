//! Certificates as JSON. Numbers are written in shortest round-trip form and read to the last bit.
//!
//! Cells are the bulk: in preorder, each is 0 (not divided) or 1 (its halves follow), or a list of that, the radius it claims, and
//! its upper bound: a segment and a parameter, or −1 for the radius of curvature.

use std::fmt::Write as _;
use std::io::{self, Write};

use serde_json::Value;

use crate::feet::Span;
use crate::{
    Certificate, Claimed, FootClaim, NeighbourhoodClaim, Node, PieceClaim, Place, SampleClaim, Step, Tree, Upper, Why,
    WitnessClaim,
};

const FORMAT: u64 = 1;

fn side(left: bool) -> &'static str {
    if left { "left" } else { "right" }
}

fn upper(upper: &Upper) -> String {
    match upper {
        Upper::Point(at) => format!("[{}, {:?}]", at.segment, at.t),
        Upper::Curvature => "[-1]".to_owned(),
    }
}

fn feet(span: &Span) -> String {
    match span {
        Span::Side { segment, left, from, to } => {
            format!("\"segment\": {segment}, \"side\": \"{}\", \"from\": {from:?}, \"to\": {to:?}", side(*left))
        }
        Span::Fan { end, other, left, from, to } => format!(
            "\"end\": {end}, \"other\": {other}, \"side\": \"{}\", \"from\": {from:?}, \"to\": {to:?}",
            side(*left)
        ),
    }
}

fn cells(nodes: &[Node]) -> String {
    let mut out = String::new();
    for (i, node) in nodes.iter().enumerate() {
        let comma = if i > 0 { "," } else { "" };
        let split = u8::from(node.split);
        // Writing to a string never fails.
        let _ = match &node.upper {
            None if node.lower == 0.0 => write!(out, "{comma}{split}"),
            None => write!(out, "{comma}[{split},{:?}]", node.lower),
            Some(Upper::Curvature) => write!(out, "{comma}[{split},{:?},-1]", node.lower),
            Some(Upper::Point(at)) => write!(out, "{comma}[{split},{:?},{},{:?}]", node.lower, at.segment, at.t),
        };
    }
    out
}

impl Certificate {
    /// Writes it as JSON. `about` are members for people, which no check looks at: names and values, as JSON.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write, about: &[(&str, String)]) -> io::Result<()> {
        writeln!(out, "{{\n  \"format\": {FORMAT},\n  \"scalar\": \"f64\",")?;
        writeln!(out, "  \"curve\": \"{:016x}\",", self.curve)?;
        for (name, value) in about {
            writeln!(out, "  \"{name}\": {value},")?;
        }
        writeln!(out, "  \"corner_angle\": {:?},", self.corner_angle)?;
        writeln!(out, "  \"epsilon\": {:?},", self.epsilon)?;
        writeln!(out, "  \"min_distance\": {},", self.min_distance.map_or("null".to_owned(), |v| format!("{v:?}")))?;
        let verdict = match &self.claimed {
            Claimed::Proved => "proved",
            Claimed::Refuted(_) => "refuted",
            Claimed::Unknown => "unknown",
        };
        writeln!(out, "  \"verdict\": \"{verdict}\",")?;
        if let Claimed::Refuted(w) = &self.claimed {
            writeln!(
                out,
                "  \"witness\": {{\"segment\": {}, \"t\": {:?}, \"distance_at_least\": {:?}, \"lfs_at_most\": {:?}, \
                 \"feet\": {{{}}}, \"lower\": {:?}, \"upper\": {}}},",
                w.at.segment,
                w.at.t,
                w.distance,
                w.lfs,
                feet(&w.feet),
                w.lower,
                upper(&w.upper)
            )?;
        }
        list(out, "samples", &self.samples, |s| {
            format!("{{\"segment\": {}, \"t\": {:?}, \"x\": {:?}, \"y\": {:?}}}", s.at.segment, s.at.t, s.x, s.y)
        })?;
        list(out, "pieces", &self.pieces, |p| {
            let why = match p.why {
                Why::Feature(lfs) => format!("\"feature\", \"lfs_at_least\": {lfs:?}"),
                Why::Floor => "\"floor\"".to_owned(),
                Why::Neighbourhood(n) => format!("\"neighbourhood\", \"neighbourhood\": {n}"),
                Why::Unknown => "\"unknown\"".to_owned(),
            };
            format!(
                "{{\"segment\": {}, \"from\": {:?}, \"to\": {:?}, \"sample\": {}, \"reason\": {why}}}",
                p.segment, p.from, p.to, p.sample
            )
        })?;
        list(out, "neighbourhoods", &self.neighbourhoods, |n| {
            let steps: Vec<String> = n
                .steps
                .iter()
                .map(|s| {
                    let foot = s.foot.as_ref().map(|FootClaim { at, left, upper: u }| {
                        format!(",{},{:?},\"{}\",{}", at.segment, at.t, side(*left), upper(u))
                    });
                    format!("[{},{:?},{:?}{}]", s.segment, s.from, s.to, foot.unwrap_or_default())
                })
                .collect();
            let FootClaim { at, left, upper: u } = &n.place;
            format!(
                "{{\"segment\": {}, \"t\": {:?}, \"side\": \"{}\", \"upper\": {}, \"steps\": [{}]}}",
                at.segment,
                at.t,
                side(*left),
                upper(u),
                steps.join(",")
            )
        })?;
        write!(out, "  \"feet\": [")?;
        for (i, tree) in self.trees.iter().enumerate() {
            let comma = if i > 0 { "," } else { "" };
            write!(out, "{comma}\n    {{{}, \"cells\": [{}]}}", feet(&tree.feet), cells(&tree.nodes))?;
        }
        writeln!(out, "\n  ]\n}}")
    }

    /// Reads one.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn read(text: &str) -> Result<Self, String> {
        let value: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let root = At { value: &value, place: "the certificate" };
        if root.get("format")?.value.as_u64() != Some(FORMAT) || root.get("scalar")?.value.as_str() != Some("f64") {
            return Err(format!("it is not a certificate of format {FORMAT} in f64"));
        }
        let curve = root.get("curve")?.value.as_str().and_then(|s| u64::from_str_radix(s, 16).ok());
        let claimed = match root.get("verdict")?.value.as_str() {
            Some("proved") => Claimed::Proved,
            Some("refuted") => Claimed::Refuted(root.get("witness")?.witness()?),
            Some("unknown") => Claimed::Unknown,
            _ => return Err("“verdict” is not proved, refuted or unknown".to_owned()),
        };
        Ok(Self {
            curve: curve.ok_or("“curve” is not a number of 16 hexadecimal digits")?,
            corner_angle: root.number("corner_angle")?,
            epsilon: root.number("epsilon")?,
            min_distance: match root.get("min_distance")?.value {
                Value::Null => None,
                _ => Some(root.number("min_distance")?),
            },
            claimed,
            samples: root.all("samples", |s| Ok(SampleClaim { at: s.at()?, x: s.number("x")?, y: s.number("y")? }))?,
            pieces: root.all("pieces", |p| {
                let why = match p.get("reason")?.value.as_str() {
                    Some("feature") => Why::Feature(p.number("lfs_at_least")?),
                    Some("floor") => Why::Floor,
                    Some("neighbourhood") => Why::Neighbourhood(p.index("neighbourhood")?),
                    Some("unknown") => Why::Unknown,
                    _ => return Err(p.wrong("reason")),
                };
                let (segment, sample) = (p.index("segment")?, p.index("sample")?);
                Ok(PieceClaim { segment, from: p.number("from")?, to: p.number("to")?, sample, why })
            })?,
            neighbourhoods: root.all("neighbourhoods", |n| {
                let place = FootClaim { at: n.at()?, left: n.left()?, upper: n.get("upper")?.upper()? };
                Ok(NeighbourhoodClaim { place, steps: n.all("steps", |s| s.step())? })
            })?,
            trees: root.all("feet", |t| Ok(Tree { feet: t.feet()?, nodes: t.all("cells", |c| c.node())? }))?,
        })
    }
}

fn list<T>(out: &mut dyn Write, name: &str, items: &[T], row: impl Fn(&T) -> String) -> io::Result<()> {
    write!(out, "  \"{name}\": [")?;
    for (i, item) in items.iter().enumerate() {
        write!(out, "{}\n    {}", if i > 0 { "," } else { "" }, row(item))?;
    }
    writeln!(out, "\n  ],")
}

/// A value that is read, and the list or member that it is part of.
#[derive(Clone, Copy)]
struct At<'v> {
    value: &'v Value,
    place: &'v str,
}

impl<'v> At<'v> {
    fn wrong(&self, name: &str) -> String {
        format!("“{name}” in {} is missing or makes no sense", self.place)
    }

    fn get(&self, name: &'v str) -> Result<Self, String> {
        self.value.get(name).map(|value| Self { value, place: name }).ok_or_else(|| self.wrong(name))
    }

    fn number(&self, name: &str) -> Result<f64, String> {
        self.value.get(name).and_then(Value::as_f64).filter(|v| v.is_finite()).ok_or_else(|| self.wrong(name))
    }

    fn index(&self, name: &str) -> Result<u32, String> {
        self.value.get(name).and_then(small).ok_or_else(|| self.wrong(name))
    }

    fn all<T>(&self, name: &'v str, each: impl Fn(Self) -> Result<T, String>) -> Result<Vec<T>, String> {
        let items = self.value.get(name).and_then(Value::as_array).ok_or_else(|| self.wrong(name))?;
        items.iter().map(|value| each(Self { value, place: name })).collect()
    }

    fn at(&self) -> Result<Place, String> {
        Ok(Place { segment: self.index("segment")?, t: self.number("t")? })
    }

    fn left(&self) -> Result<bool, String> {
        self.value.get("side").and_then(is_left).ok_or_else(|| self.wrong("side"))
    }

    fn upper(&self) -> Result<Upper, String> {
        self.value.as_array().and_then(|list| bound(list)).ok_or_else(|| self.wrong("upper"))
    }

    fn feet(&self) -> Result<Span, String> {
        let (left, from, to) = (self.left()?, self.number("from")?, self.number("to")?);
        if self.value.get("end").is_some() {
            return Ok(Span::Fan { end: self.index("end")?, other: self.index("other")?, left, from, to });
        }
        Ok(Span::Side { segment: self.index("segment")?, left, from, to })
    }

    fn step(&self) -> Result<Step, String> {
        let step = || {
            let list = self.value.as_array()?;
            let [segment, from, to, foot @ ..] = list.as_slice() else { return None };
            let foot = match foot {
                [] => None,
                [segment, t, left, upper] => Some(FootClaim {
                    at: Place { segment: small(segment)?, t: t.as_f64()? },
                    left: is_left(left)?,
                    upper: bound(upper.as_array()?)?,
                }),
                _ => return None,
            };
            Some(Step { segment: small(segment)?, from: from.as_f64()?, to: to.as_f64()?, foot })
        };
        step().ok_or_else(|| self.wrong("step"))
    }

    fn node(&self) -> Result<Node, String> {
        let is_split = |v: &Value| v.as_u64().filter(|s| *s < 2).map(|s| s == 1);
        let node = || match self.value {
            Value::Array(list) => {
                let [split, lower, upper @ ..] = list.as_slice() else { return None };
                let upper = if upper.is_empty() { None } else { Some(bound(upper)?) };
                Some(Node { split: is_split(split)?, lower: lower.as_f64()?, upper })
            }
            value => Some(Node { split: is_split(value)?, lower: 0.0, upper: None }),
        };
        node().ok_or_else(|| self.wrong("cell"))
    }

    fn witness(&self) -> Result<WitnessClaim, String> {
        Ok(WitnessClaim {
            at: self.at()?,
            distance: self.number("distance_at_least")?,
            lfs: self.number("lfs_at_most")?,
            feet: self.get("feet")?.feet()?,
            lower: self.number("lower")?,
            upper: self.get("upper")?.upper()?,
        })
    }
}

fn small(value: &Value) -> Option<u32> {
    value.as_u64().and_then(|v| u32::try_from(v).ok())
}

fn is_left(value: &Value) -> Option<bool> {
    match value.as_str() {
        Some("left") => Some(true),
        Some("right") => Some(false),
        _ => None,
    }
}

fn bound(list: &[Value]) -> Option<Upper> {
    match list {
        [curvature] if curvature.as_i64() == Some(-1) => Some(Upper::Curvature),
        [segment, t] => Some(Upper::Point(Place { segment: small(segment)?, t: t.as_f64()? })),
        _ => None,
    }
}
