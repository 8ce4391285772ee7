//! The motion that comes out, recovered from steps and times: it ends where it should, and no limit is exceeded.

use fsample_planner::{LINES, Limits, MotorStep, PlanError, Planner};

const LIMITS: Limits =
    Limits { feed: 50.0, corner_speed: 5.0, acceleration: 1000.0, steps_per_unit: 80.0, clock: 84_000_000.0 };

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// In [0, 1).
    fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / 16_777_216.0
    }
}

/// The lines that the planner makes of points, each with its steps; those that are shorter than a step are left out.
fn run(points: &[[f32; 2]], limits: Limits) -> (Vec<[i32; 2]>, Vec<Vec<MotorStep>>) {
    let mut planner = Planner::new(limits).unwrap();
    let (mut ends, mut steps) = (Vec::new(), Vec::new());
    for &p in points {
        let before = planner.position();
        while planner.is_full() {
            steps.push(planner.step().expect("a full queue moves"));
        }
        planner.line(p).unwrap();
        if planner.position() != before {
            ends.push(planner.position());
        }
    }
    planner.flush();
    while let Some(step) = planner.step() {
        steps.push(step);
    }
    assert!(planner.is_idle());
    let mut all = steps.into_iter();
    let mut at = [0, 0];
    let mut lines = Vec::new();
    for end in &ends {
        let count = (end[0] - at[0]).abs().max((end[1] - at[1]).abs());
        let line: Vec<MotorStep> = all.by_ref().take(usize::try_from(count).unwrap()).collect();
        let sum = line.iter().fold([0, 0], |s, m| [s[0] + i32::from(m.x), s[1] + i32::from(m.y)]);
        assert_eq!(sum, [end[0] - at[0], end[1] - at[1]], "the steps of a line lead to its end");
        // Bresenham: never more than half a step from the straight line.
        let (dx, dy) = (f64::from(sum[0]), f64::from(sum[1]));
        let mut p = [0.0, 0.0];
        for m in &line {
            p = [p[0] + f64::from(m.x), p[1] + f64::from(m.y)];
            assert!((p[0] * dy - p[1] * dx).abs() <= 0.5 * dx.abs().max(dy.abs()) + 1e-9, "off the line");
        }
        lines.push(line);
        at = *end;
    }
    assert_eq!(all.next(), None, "no step too many");
    (ends, lines)
}

/// Checks speeds and accelerations of the motion, recovered in f64.
///
/// The only unknown is where inside a step the speed changes. A step of length h and time t has mean speed h/t. With
/// |acceleration| ≤ a the mean speeds of two neighbouring steps differ by at most a·(t₁ + t₂)/2; at a joint the speed itself
/// is at most the smallest end speed that two steps allow, h/t + a·t/2 each.
fn check(ends: &[[i32; 2]], lines: &[Vec<MotorStep>], limits: Limits) -> f64 {
    let [feed, corner, a, per, clock] =
        [limits.feed, limits.corner_speed, limits.acceleration, limits.steps_per_unit, limits.clock].map(f64::from);
    let mut at = [0, 0];
    let mut before: Option<([f64; 2], f64, f64)> = None;
    let mut fastest = 0.0_f64;
    for (end, line) in ends.iter().zip(lines) {
        let d = [f64::from(end[0] - at[0]), f64::from(end[1] - at[1])];
        let n = d[0].hypot(d[1]);
        let u = [d[0] / n, d[1] / n];
        let h = n / per / f64::from(u32::try_from(line.len()).unwrap());
        for (k, m) in line.iter().enumerate() {
            let t = f64::from(m.after) / clock;
            let speed = h / t;
            fastest = fastest.max(speed);
            assert!(speed <= feed * 1.0001, "{speed} is above the feed");
            // At the start the pen rests: half of a·t² is all it can do, or a quarter up and down again.
            let (last_u, last, last_t) = before.unwrap_or((u, 0.0, 0.0));
            // Times are whole ticks, rounded up; f32 adds a few roundoffs of the speed.
            let rounding = (speed / t + last / last_t.max(t)) / clock + 1e-6 * speed;
            let allowed = a * (last_t + t) / 2.0 * 1.0001 + rounding;
            if k > 0 || before.is_none() {
                assert!((speed - last).abs() <= allowed, "{last} to {speed} in {} s", (last_t + t) / 2.0);
            } else {
                // The speed v at the joint: |v − last| ≤ a·last_t/2 and |v − speed| ≤ a·t/2, and v·|u − last_u| ≤ corner.
                let low = (last - a * last_t / 2.0).max(speed - a * t / 2.0).max(0.0);
                let high = (last + a * last_t / 2.0).min(speed + a * t / 2.0);
                assert!(low <= high + rounding, "{last} to {speed} across a joint");
                let turn = (u[0] - last_u[0]).hypot(u[1] - last_u[1]);
                assert!(low * turn <= corner + 2.0 * rounding, "{low} with a turn of {turn}: above {corner}");
            }
            before = Some((u, speed, t));
        }
        at = *end;
    }
    // At the end the pen rests.
    if let Some((_, speed, t)) = before {
        assert!(speed <= a * t / 2.0 * 1.001 + 1e-6, "stops from {speed}");
    }
    fastest
}

#[test]
fn random_lines_keep_every_limit_and_end_where_they_should() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for round in 0..400_u32 {
        let size = [0.02, 0.3, 3.0, 30.0][(round % 4) as usize];
        let mut p = [0.0_f32, 0.0];
        let points: Vec<[f32; 2]> = (0..40)
            .map(|_| {
                // Runs of smooth points, sharp turns, and points that repeat.
                let step = size * random.unit() * if random.next().is_multiple_of(5) { 0.0 } else { 1.0 };
                let angle = 6.3 * random.unit() * if round % 3 == 0 { 0.05 } else { 1.0 };
                p = [p[0] + step * angle.cos(), p[1] + step * angle.sin()];
                p
            })
            .collect();
        let limits =
            Limits { corner_speed: 0.1 + 40.0 * random.unit(), acceleration: 50.0 + 5000.0 * random.unit(), ..LIMITS };
        let (ends, lines) = run(&points, limits);
        check(&ends, &lines, limits);
        let last = points.last().unwrap();
        if let Some(end) = ends.last() {
            for (n, v) in end.iter().zip(last) {
                let off = f64::from(*n) - f64::from(*v) * 80.0;
                assert!(off.abs() <= 0.5 + 1e-3, "{off} steps off the last point");
            }
        }
    }
}

#[test]
fn a_straight_run_of_short_lines_reaches_the_feed() {
    // 50²/(2·1000) = 1.25 units to the feed: look-ahead over 16 lines of 0.25 units is enough, over one it is not.
    let points: Vec<[f32; 2]> = (1..=100_u16).map(|k| [f32::from(k) * 0.25, 0.0]).collect();
    let (ends, lines) = run(&points, LIMITS);
    let fastest = check(&ends, &lines, LIMITS);
    assert!(fastest >= 49.9, "only {fastest}");
    // Nowhere slower than the profile of one long line by more than rounding.
    let (one_end, one_line) = run(&[[25.0, 0.0]], LIMITS);
    check(&one_end, &one_line, LIMITS);
    let time = |lines: &[Vec<MotorStep>]| lines.iter().flatten().map(|m| u64::from(m.after)).sum::<u64>();
    let (short, long) = (time(&lines), time(&one_line));
    assert!(short <= long + long / 1000, "{short} ticks, {long} in one line");
}

#[test]
fn turning_back_is_slow_and_a_gentle_bend_is_not() {
    let (ends, lines) = run(&[[20.0, 0.0], [0.0, 0.0]], LIMITS);
    check(&ends, &lines, LIMITS);
    let joint = |lines: &[Vec<MotorStep>]| {
        let m = lines.first().and_then(|l| l.last()).unwrap();
        1.0 / 80.0 / (f64::from(m.after) / 84e6)
    };
    assert!(joint(&lines) < 6.0, "{}", joint(&lines));
    let (ends, lines) = run(&[[20.0, 0.0], [40.0, 1.0]], LIMITS);
    check(&ends, &lines, LIMITS);
    assert!(joint(&lines) > 49.0, "{}", joint(&lines));
}

#[test]
fn refuses_what_it_cannot_do_and_goes_on() {
    assert_eq!(Planner::new(Limits { feed: 0.0, ..LIMITS }).err(), Some(PlanError::Limits));
    assert_eq!(Planner::new(Limits { acceleration: f32::NAN, ..LIMITS }).err(), Some(PlanError::Limits));
    let mut planner = Planner::new(LIMITS).unwrap();
    assert_eq!(planner.line([f32::NAN, 0.0]), Err(PlanError::Range));
    assert_eq!(planner.line([0.0, 1e9]), Err(PlanError::Range));
    for k in 1..=LINES {
        planner.line([k as f32, 0.0]).unwrap();
    }
    assert_eq!(planner.line([99.0, 0.0]), Err(PlanError::Full));
    let mut steps = 0;
    planner.flush();
    while let Some(step) = planner.step() {
        assert_eq!((step.x, step.y), (1, 0));
        steps += 1;
    }
    assert_eq!(steps, 80 * LINES);
    assert!(planner.is_idle());
    assert_eq!(planner.step(), None);
}

#[test]
fn single_steps_from_rest_to_rest_take_a_finite_time() {
    let (ends, lines) = run(&[[0.0125, 0.0]], LIMITS);
    check(&ends, &lines, LIMITS);
    // Up to the middle and down again: 2·√(h/a).
    let expected = 2.0 * (0.0125_f64 / 1000.0).sqrt() * 84e6;
    let after = f64::from(lines[0][0].after);
    assert!((after - expected).abs() <= expected * 1e-5 + 1.0, "{after} for {expected}");
}
