//! The nasty set and the closest points, a few of each; the examples `nasty` and `closest` of this crate ask for millions.

use fsample_oracle::{nasty, queries, survey};

#[test]
fn nothing_nasty_is_missed_or_invented() {
    let mut ends = 0;
    for class in nasty::Class::ALL {
        let s = survey::roots(class, 60, 2024);
        assert!(s.is_clean(), "{class}: {s:?}");
        assert!(s.roots > 200, "{class}: {s:?}");
        ends += s.at_ends;
    }
    assert!(ends > 100, "{ends} roots at ends");
}

#[test]
fn no_closest_point_is_wrong() {
    for class in queries::Class::ALL {
        let s = survey::closest(class, 4000, 2024);
        assert_eq!((s.wrong, s.faults), (0, 0), "{class:?}: {s:?}");
        assert!(s.checked >= 4, "{class:?}: {s:?}");
    }
}
