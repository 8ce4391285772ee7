//! What is written is read back; what is mutated is refused with a typed error or is a valid job; nothing panics.

use fsample_job::{Command, Decoder, Encoder, JobError, JobOptions, VALUES, expand, reduce};

fn options() -> JobOptions {
    JobOptions {
        epsilon: 0.5,
        eta: 0.05,
        chord_error: 0.1,
        min_distance: 0.05,
        max_distance: 0.0,
        feed: 50.0,
        corner_speed: 5.0,
        acceleration: 1000.0,
        steps_per_unit: 80.0,
        foot_points: 32,
    }
}

fn job() -> Vec<u8> {
    let mut bytes = vec![0; 256];
    let mut encoder = Encoder::new(&mut bytes, &options()).unwrap();
    encoder.begin([0.0, 1.0], true).unwrap();
    encoder.cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]).unwrap();
    encoder.line([-7.0, 8.0]).unwrap();
    let len = encoder.end().unwrap();
    bytes.truncate(len);
    bytes
}

/// The same with lfs along both curves: 18 values take two commands.
fn with_lfs() -> Vec<u8> {
    let mut bytes = vec![0; 512];
    let mut encoder = Encoder::new(&mut bytes, &options()).unwrap();
    encoder.begin([0.0, 1.0], true).unwrap();
    encoder.cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]).unwrap();
    encoder.table([true, false], &[0.75; 18]).unwrap();
    encoder.line([-7.0, 8.0]).unwrap();
    encoder.table([false, true], &[1.0, f32::INFINITY]).unwrap();
    let len = encoder.end().unwrap();
    bytes.truncate(len);
    bytes
}

/// The same for a controller that computes lfs: the cubic has three arcs.
fn with_places() -> Vec<u8> {
    let mut bytes = vec![0; 512];
    let mut encoder = Encoder::new(&mut bytes, &options()).unwrap();
    encoder.begin([0.0, 1.0], true).unwrap();
    encoder.cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]).unwrap();
    encoder.places([true, false], 300).unwrap();
    encoder.cut(0.25).unwrap();
    encoder.cut(0.75).unwrap();
    encoder.line([-7.0, 8.0]).unwrap();
    encoder.places([false, true], 2).unwrap();
    let len = encoder.end().unwrap();
    bytes.truncate(len);
    bytes
}

fn read(bytes: &[u8]) -> Result<Vec<Command>, JobError> {
    let mut decoder = Decoder::new();
    let mut commands = Vec::new();
    for &byte in bytes {
        commands.extend(decoder.push(byte)?);
    }
    decoder.finish().map(|()| commands)
}

#[test]
fn what_is_written_is_read() {
    let expected = vec![
        Command::Options(options()),
        Command::Begin { at: [0.0, 1.0], closed: true },
        Command::Cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]),
        Command::Line([-7.0, 8.0]),
        Command::End,
    ];
    assert_eq!(read(&job()), Ok(expected));
    // The checksum is that of zip: known for its check string.
    let mut small = [0; 60];
    assert_eq!(Encoder::new(&mut small[..20], &options()).err(), Some(JobError::Full));
    let mut encoder = Encoder::new(&mut small, &options()).unwrap();
    assert_eq!(encoder.line([f32::NAN, 0.0]), Err(JobError::Range));
}

#[test]
fn lfs_is_read_as_written_and_never_larger() {
    let full = [reduce(0.75); VALUES];
    let (mut rest, mut two) = ([0; VALUES], [0; VALUES]);
    rest[..2].fill(reduce(0.75));
    two[..2].copy_from_slice(&[reduce(1.0), reduce(f32::INFINITY)]);
    let expected = vec![
        Command::Options(options()),
        Command::Begin { at: [0.0, 1.0], closed: true },
        Command::Cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]),
        Command::Table { values: 18, corners: [true, false] },
        Command::Values(full),
        Command::Values(rest),
        Command::Line([-7.0, 8.0]),
        Command::Table { values: 2, corners: [false, true] },
        Command::Values(two),
        Command::End,
    ];
    assert_eq!(read(&with_lfs()), Ok(expected));
    for v in [0.0, 1e-30, 0.1, 0.75, 1.0, 1.992_187_5, 1.999, 12_345.678, f32::MAX] {
        let kept = expand(reduce(v));
        assert!(kept <= v && kept >= v * (127.0 / 128.0), "{kept} for {v}");
    }
    assert_eq!(expand(reduce(f32::INFINITY)).to_bits(), f32::INFINITY.to_bits());
    assert_eq!([-1.0, f32::NAN].map(reduce), [0, 0]);
}

#[test]
fn places_and_cuts_are_read_as_written() {
    let expected = vec![
        Command::Options(options()),
        Command::Begin { at: [0.0, 1.0], closed: true },
        Command::Cubic([1.0, 2.0, 3.0, 4.0, 5.0, 6.5]),
        Command::Places { places: 300, corners: [true, false] },
        Command::Cut(0.25),
        Command::Cut(0.75),
        Command::Line([-7.0, 8.0]),
        Command::Places { places: 2, corners: [false, true] },
        Command::End,
    ];
    assert_eq!(read(&with_places()), Ok(expected));
}

/// What the encoder says of commands in a path, and the decoder of what came of them.
fn write(commands: impl Fn(&mut Encoder<'_>) -> Result<(), JobError>) -> (Result<(), JobError>, Option<JobError>) {
    let mut room = [0; 512];
    let mut encoder = Encoder::new(&mut room, &options()).unwrap();
    encoder.begin([0.0, 0.0], false).unwrap();
    let refused = commands(&mut encoder);
    let len = encoder.end().unwrap();
    (refused, read(&room[..len]).err())
}

#[test]
fn places_and_cuts_out_of_place_are_refused() {
    let order = (Ok(()), Some(JobError::Order));
    assert_eq!(write(|e| e.places([false; 2], 3)), order, "no curve before it");
    let line = |e: &mut Encoder<'_>| e.line([1.0, 1.0]);
    assert_eq!(write(|e| line(e).and(e.places([false; 2], 3)).and(e.places([false; 2], 3))), order, "twice");
    assert_eq!(write(|e| line(e).and(e.cut(0.5))), order, "a cut of what has no arc");
    assert_eq!(write(|e| line(e).and(e.table([false; 2], &[1.0; 3])).and(e.cut(0.5))), order, "lfs came along");
    let cuts = |e: &mut Encoder<'_>, last: f32| {
        line(e)?;
        e.places([false; 2], 3)?;
        e.cut(0.5)?;
        e.cut(last)
    };
    assert_eq!(write(|e| cuts(e, 0.75)), (Ok(()), None));
    assert_eq!(write(|e| cuts(e, 0.5)), (Ok(()), Some(JobError::Range)), "not ascending");
    assert_eq!(write(|e| cuts(e, 1.0)), (Err(JobError::Range), None));
    assert_eq!(write(|e| cuts(e, f32::NAN)), (Err(JobError::Range), None));
    for count in [0, 1, 1026] {
        assert_eq!(write(|e| line(e).and(e.places([false; 2], count))), (Err(JobError::Range), None));
    }
    // A cut beyond the cubic, and one that is no number, where the stream says so.
    let whole = with_places();
    let at = whole.windows(5).position(|w| w == [8, 0, 0, 128, 62]).unwrap();
    for bad in [1.0_f32, 0.0, -0.5, f32::NAN] {
        let mut bytes = whole.clone();
        bytes[at + 1..at + 5].copy_from_slice(&bad.to_le_bytes());
        assert_eq!(read(&bytes).err(), Some(JobError::Range), "{bad}");
    }
}

#[test]
fn tables_out_of_place_are_refused() {
    assert_eq!(write(|e| e.table([false; 2], &[1.0; 3])), (Ok(()), Some(JobError::Order)), "no curve before it");
    let twice = write(|e| e.line([1.0, 1.0]).and(e.table([false; 2], &[1.0; 3])).and(e.table([false; 2], &[1.0; 3])));
    assert_eq!(twice, (Ok(()), Some(JobError::Order)));
    assert_eq!(write(|e| e.line([1.0, 1.0]).and(e.table([false; 2], &[1.0]))), (Err(JobError::Range), None));
    // One command of values too few: a line comes where a command 6 has to.
    let whole = with_lfs();
    let first = whole.windows(2).position(|w| w == [6, 64]).unwrap();
    let mut cut = whole.clone();
    cut.drain(first..first + 33);
    assert_eq!(read(&cut).err(), Some(JobError::Order));
    let mut more = whole.clone();
    more[first + 33 + 5] = 1;
    assert_eq!(read(&more).err(), Some(JobError::Range), "what is beyond the number must be 0");
    // A value that is negative, and one that is no number.
    for bad in [0x8000_u16, 0x7F81] {
        let mut bytes = whole.clone();
        bytes[first + 1..first + 3].copy_from_slice(&bad.to_le_bytes());
        assert_eq!(read(&bytes).err(), Some(JobError::Range));
    }
}

#[test]
fn every_truncation_and_every_flipped_bit_is_refused() {
    for whole in [job(), with_lfs(), with_places()] {
        refused(whole);
    }
}

fn refused(whole: Vec<u8>) {
    for n in 0..whole.len() {
        assert_eq!(read(&whole[..n]), Err(JobError::Truncated), "{n} bytes");
    }
    for bit in 0..whole.len() * 8 {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(read(&bytes).is_err(), "bit {bit}");
    }
    let mut longer = whole;
    longer.push(2);
    assert_eq!(read(&longer), Err(JobError::AfterEnd));
}

#[test]
fn a_million_random_and_mutated_streams() {
    let jobs = [job(), with_lfs(), with_places()];
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let mut seen = std::collections::BTreeMap::<String, u32>::new();
    let mut bytes = Vec::new();
    for n in 0..1_000_000_u32 {
        bytes.clear();
        if n % 4 == 0 {
            bytes.extend((0..random() % 64).map(|_| random().to_le_bytes()[0]));
        } else {
            bytes.extend_from_slice(&jobs[(n % 3) as usize]);
            for _ in 0..=random() % 3 {
                let at = usize::try_from(random() % (bytes.len() as u64 + 1)).unwrap();
                match random() % 4 {
                    0 => bytes.truncate(at),
                    1 => bytes.insert(at, random().to_le_bytes()[0]),
                    _ => bytes.get_mut(at).into_iter().for_each(|b| *b = random().to_le_bytes()[0]),
                }
            }
        }
        let answer = match read(&bytes) {
            Ok(_) => "whole".to_owned(),
            Err(error) => format!("{error:?}").split('(').next().unwrap_or_default().to_owned(),
        };
        *seen.entry(answer).or_default() += 1;
    }
    for error in ["Magic", "Unknown", "Range", "Order", "Checksum", "Truncated", "AfterEnd"] {
        assert!(seen.contains_key(error), "{error} never came up: {seen:?}");
    }
    // A mutation may write the byte that was there.
    assert!(seen.get("whole").is_none_or(|n| *n < 5000), "{seen:?}");
}
