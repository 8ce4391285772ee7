//! Jobs whose checksum holds and whose curve is anything: repeated, degenerate, huge and tiny cubics, cusps, cuts anywhere. The
//! controller ends, with samples that are finite or with a fault, and draws the next job as ever.

use feature_sampling::sampling::Sample;
use fsample_job::{Encoder, JobError, JobOptions};
use fsample_planner::MotorStep;
use plotter::memory::{Memory, TableMemory};
use plotter::{Fault, Listener, TURNS, Work};

/// Counts samples; a sampler whose d_min is tiny is cut off at some number of calls.
#[derive(Default)]
struct Count {
    samples: u32,
    bad: u32,
    steps: u32,
}

impl Listener for Count {
    fn before(&mut self) {}
    fn after(&mut self, _: Work) {}
    fn sample(&mut self, s: &Sample<f32>) {
        self.samples += 1;
        self.bad += u32::from(!(s.point.x.is_finite() && s.point.y.is_finite()) || s.lfs.is_nan());
    }
    fn pen(&mut self, _: bool) {}
    fn motor(&mut self, _: MotorStep) {
        self.steps += 1;
    }
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// In [0, 1).
    fn unit(&mut self) -> f32 {
        self.below(1 << 24) as f32 / (1 << 24) as f32
    }
}

/// A coordinate: often one of a few, so that points coincide.
fn coordinate(random: &mut Random, scale: f32) -> f32 {
    match random.below(3) {
        0 => random.below(4) as f32 * scale / 4.0,
        _ => random.unit() * scale,
    }
}

fn job(random: &mut Random, own: bool) -> Result<Vec<u8>, JobError> {
    let scale = [1e-3, 1.0, 100.0, 9e4][random.below(4) as usize];
    let options = JobOptions {
        epsilon: 0.1 + 0.9 * random.unit(),
        eta: random.unit() * random.unit(),
        chord_error: if random.below(2) == 0 { 0.0 } else { scale * 0.01 },
        min_distance: scale * 0.02,
        max_distance: if random.below(2) == 0 { 0.0 } else { scale * 0.1 },
        feed: scale,
        corner_speed: scale * 0.1,
        acceleration: (scale * 10.0).min(9e4),
        steps_per_unit: (100.0 / scale).min(9e4),
        foot_points: u16::try_from(1 + random.below(12)).unwrap(),
    };
    let mut out = vec![0; 1 << 14];
    let mut encoder = Encoder::new(&mut out, &options)?;
    let mut cubics: Vec<[f32; 6]> = Vec::new();
    for _ in 0..1 + random.below(4) {
        let start = [coordinate(random, scale), coordinate(random, scale)];
        encoder.begin(start, random.below(2) == 0)?;
        let mut here = start;
        for _ in 0..1 + random.below(5) {
            let mut c: [f32; 6] = std::array::from_fn(|_| coordinate(random, scale));
            match random.below(6) {
                // Handles that are retracted, a point, a repetition.
                0 => c[..2].copy_from_slice(&here),
                1 => c = [here[0], here[1], here[0], here[1], here[0], here[1]],
                2 => c = cubics.get(random.below(cubics.len() as u64 + 1) as usize).copied().unwrap_or(c),
                _ => {}
            }
            if random.below(5) == 0 {
                encoder.line([c[4], c[5]])?;
            } else {
                encoder.cubic(c)?;
            }
            here = [c[4], c[5]];
            cubics.push(c);
            let corners = [random.below(2) == 0, random.below(2) == 0];
            let count = 2 + random.below(20);
            if own {
                encoder.places(corners, u16::try_from(count).unwrap())?;
                let mut t = 0.0;
                for _ in 0..random.below(6) {
                    t += (1.0 - t) * random.unit().max(1e-6);
                    if t < 1.0 {
                        encoder.cut(t)?;
                    }
                }
            } else {
                let values: Vec<f32> = (0..count).map(|_| random.unit() * scale).collect();
                encoder.table(corners, &values)?;
            }
        }
    }
    let len = encoder.end()?;
    out.truncate(len);
    Ok(out)
}

#[test]
fn whatever_a_job_draws_the_controller_lives_on() {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let (mut memory, mut table) = (Box::new(Memory::new()), Box::new(TableMemory::new()));
    let (mut drawn, mut faults) = (0, 0);
    let good = job(&mut Random(7), true).unwrap();
    let mut first = Count::default();
    memory.run(good.iter().copied(), TURNS, &mut first).expect("a job");
    for n in 0..3000 {
        let own = n % 3 != 0;
        let bytes = job(&mut random, own).unwrap();
        let mut count = Count::default();
        let answer = if own {
            memory.run(bytes.into_iter(), TURNS, &mut count)
        } else {
            table.run(bytes.into_iter(), TURNS, &mut count)
        };
        assert_eq!(count.bad, 0, "job {n}");
        match answer {
            Ok(totals) => {
                drawn += 1;
                assert_eq!(totals.samples, count.samples);
            }
            // Cuts of a cubic that repeats another one, or two at the same place.
            Err(Fault::Job(error)) => {
                assert!(own && [JobError::Order, JobError::Range].contains(&error), "job {n}: {error}")
            }
            Err(_) => faults += 1,
        }
    }
    println!("{drawn} drawn, {faults} faults");
    assert!(drawn > 2000, "{drawn} drawn, {faults} faults");
    let mut again = Count::default();
    memory.run(good.iter().copied(), TURNS, &mut again).expect("a job");
    assert_eq!([first.samples, first.steps], [again.samples, again.steps]);
}

#[test]
fn what_is_no_curve_is_a_fault() {
    let options = |min_distance| JobOptions {
        epsilon: 0.5,
        eta: 0.0,
        chord_error: 0.0,
        min_distance,
        max_distance: 0.0,
        feed: 50.0,
        corner_speed: 5.0,
        acceleration: 1000.0,
        steps_per_unit: 80.0,
        foot_points: 4,
    };
    let mut memory = Box::new(Memory::new());
    let mut run = |commands: &dyn Fn(&mut Encoder<'_>) -> Result<(), JobError>| {
        let mut out = [0; 1 << 15];
        let mut encoder = Encoder::new(&mut out, &options(0.1)).unwrap();
        commands(&mut encoder).unwrap();
        let len = encoder.end().unwrap();
        memory.run(out[..len].iter().copied(), TURNS, &mut Count::default()).map(|totals| totals.samples)
    };
    assert_eq!(run(&|_| Ok(())), Err(Fault::Empty));
    assert_eq!(run(&|e| e.begin([1.0, 1.0], true)), Err(Fault::Empty));
    let point = |e: &mut Encoder<'_>| {
        e.begin([1.0, 1.0], false)?;
        e.line([1.0, 1.0])?;
        e.places([false; 2], 2)
    };
    assert_eq!(run(&point), Err(Fault::NoExtent));
    let untold = |e: &mut Encoder<'_>| {
        e.begin([1.0, 1.0], false)?;
        e.line([2.0, 1.0])
    };
    assert_eq!(run(&untold), Err(Fault::Job(JobError::Order)));
    let lines = |e: &mut Encoder<'_>, count: u16| {
        e.begin([0.0, 0.0], false)?;
        (1..=count).try_for_each(|k| {
            e.line([f32::from(k), f32::from(k % 2)])?;
            e.places([true; 2], 20)
        })
    };
    assert!(run(&|e| lines(e, 200)).is_ok_and(|samples| samples > 200));
    assert_eq!(run(&|e| lines(e, 201)), Err(Fault::Memory));
    let places = |e: &mut Encoder<'_>| {
        e.begin([0.0, 0.0], false)?;
        (1..=5_u8).try_for_each(|k| {
            e.line([f32::from(k), 0.0])?;
            e.places([false; 2], 1000)
        })
    };
    assert_eq!(run(&places), Err(Fault::Memory), "more places than there is room for");
}
