//! `fsample roots` and `fsample nearest`.

mod common;

use common::{Place, shipped_drawings, table};
use feature_sampling::geometry::Point;

const ROOTS: &str = "line,root,lower,upper,kind";
const NEAREST: &str = "x,y,path,segment,t,px,py,distance";

fn roots(options: &[&str], input: &str) -> Vec<Vec<String>> {
    let mut arguments = vec!["roots"];
    arguments.extend(options);
    let ran = Place::new().run_with(&arguments, input);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "roots {options:?} < {input:?}");
    table(&ran.out, ROOTS)
}

fn value(field: &str) -> f64 {
    field.parse().unwrap_or_else(|_| panic!("“{field}” is a number"))
}

#[test]
fn kinds_of_roots_line_by_line() {
    let input = "# comments and blank lines count\n\n6 -29 16 16\n0x1p-2,-0x1p0,1\n-0.125 0.75 -1.5 1\n\
                 -0.03125,0.3125,-1.25,2.5,-2.5,1\n1 1\n0 0 0 1\n";
    let rows = roots(&[], input);
    let short: Vec<(&str, f64, &str)> = rows.iter().map(|r| (r[0].as_str(), value(&r[1]), r[4].as_str())).collect();
    let expected = [
        ("3", 0.25, "simple"),
        ("3", 0.75, "simple"),
        ("4", 0.5, "even"),
        ("5", 0.5, "odd"),
        ("6", 0.5, "cluster:5"),
        ("8", 0.0, "odd"),
    ];
    assert_eq!(short.len(), expected.len(), "{short:?}");
    for (found, expected) in short.iter().zip(expected) {
        assert_eq!((found.0, found.2), (expected.0, expected.2), "{short:?}");
        assert!((found.1 - expected.1).abs() < 1e-15, "{short:?}");
    }
    for row in &rows {
        assert!(value(&row[2]) <= value(&row[1]) && value(&row[1]) <= value(&row[3]), "{row:?}");
    }
}

#[test]
fn where_to_look() {
    // (x + 3)(x − ½)(x − 7)
    let input = "1 2\n10.5 -19 -4.5 1\n";
    let cubic = |options: &[&str], expected: &[f64]| {
        let rows = roots(options, input);
        let found: Vec<f64> = rows.iter().filter(|row| row[0] == "2").map(|row| value(&row[1])).collect();
        assert_eq!(found.len(), expected.len(), "{options:?}: {found:?}");
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{options:?}: {found:?}");
    };
    cubic(&[], &[0.5]);
    cubic(&["--all"], &[-3.0, 0.5, 7.0]);
    cubic(&["--interval", "-3,0.5"], &[-3.0, 0.5]);
    cubic(&["--interval=-0x1p0,0x1.fp2"], &[0.5, 7.0]);
    cubic(&["--interval", "1,2"], &[]);
}

#[test]
fn the_zero_polynomial_has_no_row_but_a_warning() {
    let place = Place::new();
    let ran = place.run_with(&["roots"], "0 0 0\n-1 2\n");
    assert_eq!(ran.code, 0);
    assert_eq!(table(&ran.out, ROOTS).len(), 1, "{}", ran.out);
    assert!(ran.err.contains("line 1") && ran.err.contains("every number is a root"), "{}", ran.err);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    let ran = place.run_with(&["roots", "--quiet"], "0\n");
    assert_eq!((ran.code, ran.err.as_str(), ran.out.trim()), (0, "", ROOTS));
}

#[test]
fn bad_polynomials() {
    let place = Place::new();
    for (text, words) in [
        ("1 2\n1 two 3\n", &["line 2", "“two”", "not a number"][..]),
        ("1 2\n\n1 nan\n", &["line 3", "nan", "finite"]),
        ("inf\n", &["line 1", "finite"]),
        ("1 1e999\n", &["line 1", "1e999", "finite"]),
        ("1 0x1p5000\n", &["line 1", "0x1p5000", "finite"]),
        ("1 0xq\n", &["line 1", "0xq"]),
        ("1;2\n", &["line 1", "1;2"]),
        ("1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17\n", &["line 1", "16"]),
    ] {
        place.put("bad.txt", text);
        let mut words = words.to_vec();
        words.push("bad.txt");
        place.fails("roots bad.txt -o out.csv", 3, &words);
    }
    place.fails("roots missing.txt", 3, &["missing.txt", "no such file"]);
    place.put("good.txt", "1 -2\n");
    place.fails("roots good.txt --all --interval 0,1", 2, &["--interval", "--all"]);
    place.fails("roots good.txt --interval 1,0", 2, &["--interval", "smaller"]);
    place.fails("roots good.txt --interval 0", 2, &["--interval", "A,B"]);
    place.fails("roots good.txt --interval 0,inf", 2, &["--interval", "finite"]);
    place.fails("roots good.txt -o out.svg", 2, &["svg", "csv"]);
    place.fails("roots good.txt -o no/folder/out.csv", 4, &["out.csv"]);
    place.ok("roots good.txt -o out.csv");
    assert!(place.get("out.csv").starts_with("line,root,lower,upper,kind\n1,0.5,0."), "written");
}

#[test]
fn hexadecimal_is_exact() {
    // 3x − 1 with 3 and 1 as C prints them; the answer reads back to the same bits as from decimal input
    let hex = roots(&[], "-0x1p+0 0x1.8p+1\n");
    let decimal = roots(&[], "-1 3\n");
    assert_eq!(hex, decimal);
    assert_eq!(value(&hex[0][1]), 1.0 / 3.0);
}

#[test]
fn certified_brackets_are_theorems() {
    // x² − 2; (x − ½)³(3x − 1); a near miss of a double root, which has none; a double root
    let input = "-2 0 1\n0.125 -1.125 3.75 -5.5 3\n0x1.0000000000001p-2 -1 1\n0.25 -1 1\n";
    let rows = roots(&["--certified", "--interval", "0,2"], input);
    let short: Vec<(&str, &str)> = rows.iter().map(|r| (r[0].as_str(), r[4].as_str())).collect();
    assert_eq!(short, [("1", "simple"), ("2", "simple"), ("2", "odd"), ("4", "even")]);
    let (lower, upper) = (value(&rows[0][2]), value(&rows[0][3]));
    assert_eq!((lower, upper), (std::f64::consts::SQRT_2.next_down(), std::f64::consts::SQRT_2), "√2 is between them");
    assert_eq!((value(&rows[2][2]), value(&rows[2][3])), (0.5, 0.5), "exactly");
    assert_eq!(roots(&["--certified", "--all"], "-2 0 1\n").len(), 2);
}

#[test]
fn closest_points_of_a_drawing() {
    let place = Place::with_drawing();
    let ran = place
        .run_with(&["nearest", "drawing.svg", "110,50", "-5,50", "-", "180,50", "--quiet"], "# list\n20,50\n200 50\n");
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let rows = table(&ran.out, NEAREST);
    let near = |row: &[String]| (row[2].clone(), row[3].clone(), value(&row[4]), value(&row[7]));
    let path = |p: &str, s: &str, t: f64, d: f64| (p.to_owned(), s.to_owned(), t, d);
    let found: Vec<_> = rows.iter().map(|row| near(row)).collect();
    assert_eq!(found[0], path("1", "0", 0.0, 0.0));
    assert_eq!(found[1], path("0", "0", 0.0, 25.0));
    assert_eq!(found[2], path("0", "0", 0.0, 0.0));
    assert_eq!(found[3], path("1", "0", 1.0, 20.0));
    assert_eq!(found[4], path("1", "0", 1.0, 0.0));
    assert_eq!((rows[1][0].as_str(), rows[1][1].as_str()), ("-5", "50"), "the query is repeated");
}

#[test]
fn closest_points_of_shipped_drawings_against_a_fine_grid() {
    let place = Place::new();
    for file in shipped_drawings() {
        let drawing = lineart::drawing::load(&file).expect("a drawing");
        let cubics: Vec<_> = drawing.paths.iter().flat_map(|path| &path.cubics).collect();
        let mut bounds = feature_sampling::geometry::Aabb::empty();
        cubics.iter().for_each(|cubic| bounds.merge(&cubic.control_box()));
        let extent = bounds.extent();
        let queries: Vec<Point<f64>> = (0..30)
            .map(|i| {
                let (u, v) = (f64::from(i * 7 % 30) / 29.0, f64::from(i * 11 % 31) / 30.0);
                Point::new(bounds.min.x + (1.2 * u - 0.1) * extent.x, bounds.min.y + (1.2 * v - 0.1) * extent.y)
            })
            .collect();
        let list: String = queries.iter().map(|q| format!("{} {}\n", q.x, q.y)).collect();
        let name = file.to_str().expect("a name in UTF-8");
        let ran = place.run_with(&["nearest", name, "-", "--quiet"], &list);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let rows = table(&ran.out, NEAREST);
        assert_eq!(rows.len(), queries.len());
        for (row, q) in rows.iter().zip(&queries) {
            let field = |i: usize| value(&row[i]);
            assert_eq!((field(0), field(1)), (q.x, q.y), "{name}: the order of the queries");
            let (path, segment) =
                (row[2].parse::<usize>().expect("a path"), row[3].parse::<usize>().expect("a segment"));
            let p = drawing.paths[path].cubics[segment].eval(&field(4));
            let off = p.distance_sq(&Point::new(field(5), field(6))).sqrt();
            assert!(off < 1e-12 * extent.norm(), "{name}: {row:?} is where it says, but for {off}");
            assert!((p.distance_sq(q).sqrt() - field(7)).abs() < 1e-12 * extent.norm(), "{name}: {row:?}");
            let grid = cubics.iter().flat_map(|cubic| (0..=200).map(|i| cubic.eval(&(f64::from(i) / 200.0))));
            let least = grid.map(|p| p.distance_sq(q)).fold(f64::INFINITY, f64::min).sqrt();
            assert!(field(7) <= least * (1.0 + 1e-12) + 1e-12 * extent.norm(), "{name}: {row:?}, {least} is nearer");
        }
    }
}

#[test]
fn bad_queries() {
    let place = Place::with_drawing();
    place.fails("nearest drawing.svg", 2, &["X,Y"]);
    place.fails("nearest drawing.svg 1;2", 2, &["1;2", "X,Y"]);
    place.fails("nearest drawing.svg 1,inf", 2, &["1,inf", "finite"]);
    place.fails("nearest drawing.svg 1,2,3", 2, &["1,2,3"]);
    place.fails("nearest - -", 2, &["standard input"]);
    place.fails("nearest drawing.svg - -", 2, &["standard input"]);
    place.fails("nearest missing.svg 1,2", 3, &["missing.svg", "no such file"]);
    place.fails("nearest drawing.svg 1e300,2", 3, &["drawing.svg", "too far"]);
    let ran = place.run_with(&["nearest", "drawing.svg", "-"], "1 2\nthree four\n");
    assert_eq!((ran.code, ran.out.as_str()), (3, ""));
    assert!(ran.err.contains("line 2"), "{}", ran.err);
}
