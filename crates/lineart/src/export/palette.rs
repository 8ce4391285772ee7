//! Colours for lfs and for values on meshes.
//!
//! Local feature size spans decades, and small values are the interesting ones, so the scale is logarithmic. The colours
//! are those of viridis (van der Walt and Smith 2015, public domain): equal steps look equal, also in grey and to
//! colour-blind readers. Its last fifth runs into
//! yellow, which cannot be read on white paper: lines leave it out, areas do not.

/// Viridis in fifteen steps.
const VIRIDIS: [[u8; 3]; 16] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x1a, 0x6c],
    [0x47, 0x2f, 0x7d],
    [0x41, 0x44, 0x87],
    [0x39, 0x56, 0x8c],
    [0x31, 0x68, 0x8e],
    [0x2a, 0x78, 0x8e],
    [0x23, 0x88, 0x8e],
    [0x1f, 0x98, 0x8b],
    [0x22, 0xa8, 0x84],
    [0x35, 0xb7, 0x79],
    [0x54, 0xc5, 0x68],
    [0x7a, 0xd1, 0x51],
    [0xa5, 0xdb, 0x36],
    [0xd2, 0xe2, 0x1b],
    [0xfd, 0xe7, 0x25],
];

/// How many of them lines on white paper use.
const ON_PAPER: usize = 13;

/// The colour of an infinite lfs: it is not on the scale.
pub(super) const INFINITE: &str = "#9e9e9e";

/// The colour at a place in [0, 1] of the scale.
pub(super) fn colour(place: f64) -> String {
    hex(blend(&VIRIDIS[..ON_PAPER], place))
}

/// The colour at a place in [0, 1] of the whole of viridis, for areas.
pub(super) fn full(place: f64) -> String {
    hex(full_channels(place))
}

/// The same as red, green and blue.
pub(super) fn full_channels(place: f64) -> [u8; 3] {
    blend(&VIRIDIS, place)
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn blend(colours: &[[u8; 3]], place: f64) -> [u8; 3] {
    let steps = colours.len() - 1;
    let scaled = place.clamp(0.0, 1.0) * steps as f64;
    let (mut low, mut part) = (colours[0], scaled);
    let mut high = colours[0];
    for pair in colours.windows(2) {
        [low, high] = [pair[0], pair[1]];
        if part <= 1.0 {
            break;
        }
        part -= 1.0;
    }
    [0, 1, 2].map(|i| channel(f64::from(low[i]) + part * (f64::from(high[i]) - f64::from(low[i]))))
}

/// A channel value, rounded.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates at both ends of a byte"
)]
pub(super) fn channel(value: f64) -> u8 {
    value.round() as u8
}

/// A logarithmic scale over the finite lfs values of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// Everything at or below it has the first colour.
    pub(super) low: f64,
    /// Everything finite at or above it has the last colour.
    pub(super) high: f64,
    /// Some value lies below `low`.
    pub(super) cut: bool,
}

impl Scale {
    /// How many decades the scale spans at most: lfs falls to 0 at corners, and a logarithm needs a floor.
    const DECADES: i32 = 3;

    /// The scale that holds some values; `None` if no value is finite and positive.
    pub(super) fn over(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (mut smallest, mut low, mut high) = (f64::INFINITY, f64::INFINITY, 0.0_f64);
        for value in values.filter(|value| value.is_finite()) {
            smallest = smallest.min(value);
            high = high.max(value);
            if value > 0.0 {
                low = low.min(value);
            }
        }
        let floor = high * 0.1_f64.powi(Self::DECADES);
        let low = low.max(floor);
        (high > 0.0).then_some(Self { low, high, cut: smallest < low })
    }

    /// The colour of a stretch between two values, in one of a few dozen steps that the eye cannot tell from a blend.
    pub(super) fn colour_between(&self, a: f64, b: f64) -> String {
        const STEPS: f64 = 64.0;
        let place = match (a.is_finite(), b.is_finite()) {
            (true, true) => 0.5 * (self.place(a) + self.place(b)),
            (true, false) => self.place(a),
            (false, true) => self.place(b),
            (false, false) => return INFINITE.to_owned(),
        };
        colour((place.clamp(0.0, 1.0) * STEPS).round() / STEPS)
    }

    /// Where a finite value stands on the scale, in [0, 1].
    fn place(&self, lfs: f64) -> f64 {
        let span = (self.high / self.low).ln();
        if span > 0.0 { (lfs.max(self.low) / self.low).ln() / span } else { 0.0 }
    }

    /// The value at a place in [0, 1].
    pub(super) fn value(&self, place: f64) -> f64 {
        self.low * (self.high / self.low).powf(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle() {
        assert_eq!(colour(0.0), "#440154", "the dark end");
        assert_eq!(colour(1.0), "#7ad151", "the light end");
        assert_eq!(colour(0.5), "#2a788e", "the middle of what is used");
        let scale = Scale::over([0.0, 1.0, 100.0, f64::INFINITY].into_iter()).expect("a scale");
        assert_eq!(scale, Scale { low: 1.0, high: 100.0, cut: true }, "zero is below the scale");
        assert_eq!(scale.colour_between(1.0, 100.0), colour(0.5), "logarithmic");
        assert_eq!(scale.colour_between(f64::INFINITY, f64::INFINITY), INFINITE, "infinity is not on it");
        assert_eq!(Scale::over([f64::INFINITY].into_iter()), None, "nothing finite");
        assert_eq!(
            Scale::over([2.0].into_iter()).map(|s| s.colour_between(2.0, 2.0)),
            Some(colour(0.0)),
            "a single value"
        );
    }
}
