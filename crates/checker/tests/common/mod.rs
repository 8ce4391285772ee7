//! Reads the `d` attributes of plain SVG files, so that the judge needs no reader that it would have to trust.
use fsample_checker::RawPath;

fn numbers(d: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut current = String::new();
    let flush = |current: &mut String, out: &mut Vec<String>| {
        if !current.is_empty() {
            out.push(std::mem::take(current));
        }
    };
    for ch in d.chars() {
        match ch {
            'e' | 'E' if !current.is_empty() => current.push('e'),
            'a'..='z' | 'A'..='Z' => {
                flush(&mut current, &mut out);
                out.push(ch.to_string());
            }
            '-' | '+' if !current.ends_with('e') => {
                flush(&mut current, &mut out);
                current.push(ch);
            }
            '.' if current.contains('.') && !current.contains('e') => {
                flush(&mut current, &mut out);
                current.push(ch);
            }
            '0'..='9' | '.' | '-' | '+' => current.push(ch),
            _ => flush(&mut current, &mut out),
        }
    }
    flush(&mut current, &mut out);
    out
}

fn line(a: [f64; 2], b: [f64; 2]) -> [[f64; 2]; 4] {
    let at = |k: f64| [a[0] + (b[0] - a[0]) * k, a[1] + (b[1] - a[1]) * k];
    [a, at(1.0 / 3.0), at(2.0 / 3.0), b]
}

/// Paths of one `d` attribute: M L H V C S Q Z in both cases.
pub(crate) fn path_data(d: &str) -> Vec<RawPath> {
    let tokens = numbers(d);
    let mut out: Vec<RawPath> = Vec::new();
    let (mut i, mut command, mut at, mut start, mut handle) = (0, ' ', [0.0; 2], [0.0; 2], [0.0; 2]);
    while i < tokens.len() {
        if tokens[i].chars().all(char::is_alphabetic) {
            command = tokens[i].chars().next().unwrap();
            i += 1;
            if command.eq_ignore_ascii_case(&'z') {
                out.last_mut().unwrap().closed = true;
                at = start;
                handle = at;
                continue;
            }
        }
        let count = match command.to_ascii_lowercase() {
            'm' | 'l' => 2,
            'h' | 'v' => 1,
            'c' => 6,
            's' | 'q' => 4,
            other => panic!("path command {other}"),
        };
        let v: Vec<f64> = tokens[i..i + count].iter().map(|t| t.parse().unwrap()).collect();
        i += count;
        let base = if command.is_lowercase() { at } else { [0.0; 2] };
        let p = |k: usize| [base[0] + v[2 * k], base[1] + v[2 * k + 1]];
        let lower = command.to_ascii_lowercase();
        if lower == 'm' {
            at = p(0);
            (start, handle) = (at, at);
            out.push(RawPath::default());
            command = if command == 'm' { 'l' } else { 'L' };
            continue;
        }
        if out.last().is_some_and(|p| p.closed) {
            out.push(RawPath::default());
        }
        let cubic = match lower {
            'l' => line(at, p(0)),
            'h' => line(at, [base[0] + v[0], at[1]]),
            'v' => line(at, [at[0], base[1] + v[0]]),
            'c' => [at, p(0), p(1), p(2)],
            's' => [at, [2.0 * at[0] - handle[0], 2.0 * at[1] - handle[1]], p(0), p(1)],
            _ => {
                let (q, b) = (p(0), p(1));
                let toward = |a: [f64; 2]| [a[0] + (q[0] - a[0]) * 2.0 / 3.0, a[1] + (q[1] - a[1]) * 2.0 / 3.0];
                [at, toward(at), toward(b), b]
            }
        };
        at = cubic[3];
        handle = if "cs".contains(lower) { cubic[2] } else { at };
        out.last_mut().unwrap().cubics.push(cubic);
    }
    out.retain(|p| !p.cubics.is_empty());
    out
}

/// All paths of an SVG file whose transforms, if any, are absent.
#[allow(dead_code, reason = "not every test program reads files")]
pub(crate) fn svg(text: &str) -> Vec<RawPath> {
    assert!(!text.contains("transform="), "this reader does not know transforms");
    let mut out = Vec::new();
    let mut rest = text;
    while let Some(i) = rest.find("<path") {
        rest = &rest[i + 5..];
        let tag = &rest[..rest.find('>').unwrap()];
        let begin = tag.match_indices("d=\"").find(|(i, _)| tag[..*i].ends_with(char::is_whitespace)).unwrap().0 + 3;
        let d = &tag[begin..];
        out.extend(path_data(&d[..d.find('"').unwrap()]));
    }
    out
}
