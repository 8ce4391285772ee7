//! What is written is read back; what is mutated is refused with a typed error or is a valid job; nothing panics.

use fsample_job::{Command, Decoder, Encoder, JobError, JobOptions};

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
fn every_truncation_and_every_flipped_bit_is_refused() {
    let whole = job();
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
    let whole = job();
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
            bytes.extend_from_slice(&whole);
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
