//! Plots on logarithmic or linear axes, as SVG.

use std::fmt::Write;

use lineart::export::number::trimmed;

/// Size of a picture, and its margins: left, right, top, bottom.
const SIZE: [f64; 2] = [640.0, 420.0];
const MARGINS: [f64; 4] = [70.0, 190.0, 34.0, 50.0];

/// Colours that stay apart for colour-blind readers (Okabe and Ito 2008), and two more.
const COLOURS: [&str; 10] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#999999", "#882255", "#b8a000"];

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, with the unit.
    pub label: String,
    /// Decades at equal distances; values at or below 0 are left out.
    pub logarithmic: bool,
}

/// A line with marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// x and y; points that the axes cannot show (not finite, or not positive on a logarithmic axis) interrupt the line.
    pub points: Vec<[f64; 2]>,
    /// A broken line: printed numbers beside computed ones.
    pub dashed: bool,
}

/// A picture with two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// A word for the name of the file.
    pub name: String,
    /// A heading.
    pub title: String,
    /// The axis to the right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// Lines, in the order of the legend.
    pub series: Vec<Series>,
}

/// The part of an axis that is shown, on its own scale.
struct Range {
    logarithmic: bool,
    low: f64,
    high: f64,
}

impl Range {
    /// Whole decades, or a twentieth more than the values take.
    fn around(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let logarithmic = axis.logarithmic;
        let scaled = values.filter_map(|v| scale(logarithmic, v));
        let (low, high) = scaled.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            return Self { logarithmic, low: 0.0, high: 1.0 };
        }
        let (low, high) = if logarithmic {
            (low.floor(), high.ceil())
        } else {
            let margin = (high - low) * 0.05;
            (if low >= 0.0 && low < high - low { 0.0 } else { low - margin }, high + margin)
        };
        Self { logarithmic, low, high: if high > low { high } else { low + 1.0 } }
    }

    /// The place of a value in [0, 1].
    fn place(&self, value: f64) -> Option<f64> {
        scale(self.logarithmic, value).map(|v| (v - self.low) / (self.high - self.low))
    }

    /// Ticks: place and label.
    fn ticks(&self) -> Vec<(f64, String)> {
        let span = self.high - self.low;
        let step = if self.logarithmic {
            (span / 8.0).ceil().max(1.0)
        } else {
            let rough = span / 6.0;
            let power = 10_f64.powf(rough.log10().floor());
            [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|s| *s >= rough).unwrap_or(rough)
        };
        let first = (self.low / step).ceil() * step;
        let mut ticks = Vec::new();
        for i in 0..20 {
            let value = first + f64::from(i) * step;
            if value > self.high + 1e-9 * span {
                break;
            }
            let label = match self.logarithmic {
                true if (-3.0..=5.0).contains(&value) => trimmed(10_f64.powf(value), 3),
                true => format!("1e{value:.0}"),
                false => trimmed(value, 6),
            };
            ticks.push(((value - self.low) / span, label));
        }
        ticks
    }
}

fn scale(logarithmic: bool, value: f64) -> Option<f64> {
    let scaled = if logarithmic { value.log10() } else { value };
    scaled.is_finite().then_some(scaled)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Plot {
    /// The picture.
    pub fn svg(&self) -> String {
        let [width, height] = SIZE;
        let [left, right, top, bottom] = MARGINS;
        let (w, h) = (width - left - right, height - top - bottom);
        let values = |i: usize| self.series.iter().flat_map(move |s| s.points.iter().map(move |p| p[i]));
        let (x, y) = (Range::around(&self.x, values(0)), Range::around(&self.y, values(1)));
        let (px, py) = (|place: f64| left + place * w, |place: f64| top + (1.0 - place) * h);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
             <text x=\"{left}\" y=\"20\" font-size=\"14\">{}</text>\n",
            escaped(&self.title)
        );
        // Writing to a string cannot fail.
        for (place, label) in x.ticks() {
            let at = trimmed(px(place), 2);
            let _ = writeln!(
                out,
                "<path d=\"M{at} {top}V{}\" stroke=\"#ddd\"/><text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
                top + h,
                top + h + 16.0
            );
        }
        for (place, label) in y.ticks() {
            let at = trimmed(py(place), 2);
            let _ = writeln!(
                out,
                "<path d=\"M{left} {at}H{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{at}\" dy=\"4\" text-anchor=\"end\">{label}</text>",
                left + w,
                left - 6.0
            );
        }
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{w}\" height=\"{h}\" fill=\"none\" stroke=\"#333\"/>\n\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            left + w / 2.0,
            height - 12.0,
            escaped(&self.x.label),
            top + h / 2.0,
            escaped(&self.y.label)
        );
        for (i, series) in self.series.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let dash = if series.dashed { " stroke-dasharray=\"5 4\"" } else { "" };
            let (mut line, mut marks, mut pen) = (String::new(), String::new(), 'M');
            for [u, v] in &series.points {
                let (Some(u), Some(v)) = (x.place(*u), y.place(*v)) else {
                    pen = 'M';
                    continue;
                };
                let (u, v) = (trimmed(px(u), 2), trimmed(py(v), 2));
                let _ = write!(line, "{pen}{u} {v}");
                let _ = write!(marks, "<circle cx=\"{u}\" cy=\"{v}\" r=\"3\" fill=\"{colour}\"/>");
                pen = 'L';
            }
            let _ = writeln!(
                out,
                "<path d=\"{line}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"{dash}/>{marks}"
            );
            let (lx, ly) = (left + w + 12.0, top + 10.0 + 18.0 * i as f64);
            let _ = writeln!(
                out,
                "<path d=\"M{lx} {ly}h18\" stroke=\"{colour}\" stroke-width=\"1.5\"{dash}/><text x=\"{}\" y=\"{ly}\" dy=\"4\">{}</text>",
                lx + 24.0,
                escaped(&series.label)
            );
        }
        out.push_str("</svg>\n");
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(points: &[[f64; 2]]) -> String {
        let axis = |label: &str| Axis { label: label.into(), logarithmic: true };
        let series = Series { label: "a<b".into(), points: points.to_vec(), dashed: false };
        let plot = Plot { name: "p".into(), title: "P".into(), x: axis("x"), y: axis("y"), series: vec![series] };
        plot.svg()
    }

    #[test]
    fn decades_are_equally_far_apart() {
        let svg = plot(&[[10.0, 1e-2], [100.0, 1e-4], [1000.0, 1e-6]]);
        assert!(svg.contains("<path d=\"M70 34L260 202L450 370\""), "a straight line from corner to corner: {svg}");
        assert!(svg.contains("a&lt;b"), "escaped");
    }

    #[test]
    fn what_cannot_be_shown_interrupts() {
        let svg = plot(&[[10.0, 1e-2], [100.0, 0.0], [1000.0, f64::NAN], [1000.0, 1e-6]]);
        assert!(svg.contains("M70 34M450 370"), "two pieces: {svg}");
        assert!(!plot(&[]).contains("NaN"), "nothing to show");
    }
}
