//! `fsample mesh` and `fsample simulate`: files, exit codes, values.

mod common;

use common::Place;

/// Numbers of a line.
fn numbers(line: &str) -> Vec<f64> {
    line.split([' ', ',']).map(|field| field.parse().unwrap_or_else(|_| panic!("a number: {line}"))).collect()
}

/// Points and triangles of a legacy VTK file.
fn vtk(text: &str) -> (Vec<[f64; 2]>, Vec<[usize; 3]>) {
    let after = |key: &str| text.split_once(key).unwrap_or_else(|| panic!("{key}")).1.lines();
    let points = after(" double\n").map_while(|line| (!line.starts_with("CELLS")).then(|| numbers(line)));
    let points: Vec<_> = points.map(|p| [p[0], p[1]]).collect();
    let cells = after("\nCELLS ").skip(1).map_while(|line| (!line.starts_with("CELL_TYPES")).then(|| numbers(line)));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "indices")]
    let triangles = cells.filter(|cell| cell[0] == 3.0).map(|cell| [1, 2, 3].map(|i| cell[i] as usize)).collect();
    (points, triangles)
}

#[test]
fn a_mesh_in_every_format() {
    let place = Place::with_drawing();
    for format in ["stl", "ply", "obj", "msh", "vtk", "svg"] {
        let ran = place.run(&format!("mesh drawing.svg --max-edge 5% -o out.{format}"));
        assert_eq!(ran.code, 0, "{format}: {}", ran.err);
        assert!(ran.err.contains("triangles; angles from 2") && ran.err.contains("edges "), "{}", ran.err);
        assert!(ran.out.is_empty(), "nothing else");
    }
    let text = place.get("out.vtk");
    let (points, triangles) = vtk(&text);
    assert!(triangles.len() > 500, "{}", triangles.len());
    let mut area = 0.0;
    for [a, b, c] in triangles.iter().map(|t| t.map(|v| points[v])) {
        let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(double > 0.0, "counterclockwise");
        area += 0.5 * double;
        let longest =
            [(a, b), (b, c), (c, a)].iter().fold(0.0_f64, |l, (p, q)| l.max((p[0] - q[0]).hypot(p[1] - q[1])));
        assert!(longest <= 0.05 * 160.0_f64.hypot(80.0), "5 % of the diagonal of the control points");
    }
    // The curves span from 20 to 180 and from 27.5 to 72.5; a tenth on each side, but at least 3 % of that box's diagonal.
    let expected = 192.0 * (45.0 + 0.06 * 160.0_f64.hypot(45.0));
    assert!((area - expected).abs() < 1e-6, "{area}");
    assert_eq!(text, {
        place.ok("mesh drawing.svg --max-edge 5% -o again.vtk --threads 1");
        place.get("again.vtk")
    });

    let table = place.ok("mesh drawing.svg --quiet");
    assert!(table.starts_with("triangle,x0,y0,x1,y1,x2,y2\n0,"), "a table without -o");
}

#[test]
fn limits_and_wrong_options() {
    let place = Place::with_drawing();
    for (arguments, code, word) in [
        ("mesh drawing.svg --max-edge 0.5 --max-vertices 100 -o out.vtk", 5, "--max-vertices"),
        ("mesh drawing.svg --max-edge -1 -o out.vtk", 2, "max-edge"),
        ("mesh drawing.svg --min-angle 50 -o out.vtk", 2, "min-angle"),
        ("mesh drawing.svg -o out.gcode", 2, "gcode"),
        ("simulate drawing.svg --value none --frame-value none -o out.csv", 2, "--frame-value"),
        ("simulate drawing.svg --path-value nobody=1 -o out.csv", 2, "nobody"),
        ("simulate drawing.svg --source inf -o out.csv", 2, "source"),
    ] {
        let ran = place.run(arguments);
        assert_eq!(ran.code, code, "{arguments}: {}", ran.err);
        assert!(ran.err.contains(word), "{arguments}: {}", ran.err);
    }
    assert_eq!(place.files(), ["drawing.svg"], "nothing was written");
    place.put("empty.svg", r#"<svg xmlns="http://www.w3.org/2000/svg"/>"#);
    assert_eq!(place.run("mesh empty.svg -o out.vtk").code, 3, "nothing to mesh");
}

#[test]
fn values_along_paths() {
    let place = Place::new();
    place.put(
        "rods.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><g data-value="-1"><path id="cold" d="M2 2V8"/></g>
        <path id="hot" d="M8 2V8" data-value="3"/><path id="plain" d="M5 4V6"/></svg>"#,
    );
    let values = |arguments: &str| -> Vec<[f64; 3]> {
        let ran = place.ok(&format!("simulate rods.svg --source 0 --max-edge 10% {arguments}"));
        ran.lines().skip(1).map(numbers).map(|row| [row[1], row[2], row[3]]).collect()
    };
    let at = |values: &[[f64; 3]], x: f64| {
        values.iter().filter(|row| row[0] == x && row[1] >= 4.0 && row[1] <= 6.0).map(|row| row[2]).collect::<Vec<_>>()
    };
    let found = values("--value 0.5 --frame-value none");
    for (x, value) in [(2.0, -1.0), (8.0, 3.0), (5.0, 0.5)] {
        let there = at(&found, x);
        assert!(there.len() > 1 && there.iter().all(|u| *u == value), "at {x}: {there:?}");
    }
    assert!(found.iter().all(|row| (-1.0..=3.0).contains(&row[2])), "the maximum principle");
    let found = values("--value none --path-value hot=7 --path-value 0=none");
    assert!(at(&found, 8.0).iter().all(|u| *u == 7.0), "by id");
    assert!(at(&found, 2.0).iter().all(|u| *u > 0.0 && *u < 7.0), "by index: it holds nothing");

    let ran = place.run("simulate rods.svg --max-edge 5% -o load.svg");
    assert!(ran.code == 0 && ran.err.contains("; energy ") && ran.err.contains("residual "), "{}", ran.err);
    assert!(place.get("load.svg").contains("</svg>"), "a picture");
    place.ok("simulate rods.svg --max-edge 5% -o load.png");
    assert!(std::fs::read(place.path("load.png")).is_ok_and(|bytes| bytes.starts_with(b"\x89PNG\r\n")), "a PNG");
    place.ok("simulate rods.svg --max-edge 5% -o load.vtk");
    assert!(place.get("load.vtk").contains("POINT_DATA"), "values");
}

#[test]
fn tables_and_figures_of_meshes() {
    let place = Place::with_drawing();
    let curves = "--curve drawing.svg --quick --quiet";
    place.ok(&format!("reproduce table4 figure10 figure12 {curves} -o out"));
    let table = place.get("out/table4.csv");
    assert!(table.contains("printed,uniform,0.01,24536,,,6.784,,\n"), "what the paper prints");
    let row = |mode: &str| {
        let row =
            table.lines().find(|row| row.starts_with(&format!("average,{mode},0.03,"))).expect("the row").to_owned();
        numbers(&row.split(',').skip(3).collect::<Vec<_>>().join(","))
    };
    assert!(row("uniform")[0] > row("nonuniform")[0], "more triangles");
    // The average is mostly the detailed drawings that ship, where few triangles are there for their size alone.
    let drawings = place.get("out/table4-drawings.csv");
    let triangles = |mode: &str| -> f64 {
        let row = drawings.lines().find_map(|row| row.strip_prefix(&format!("drawing,{mode},0.03,")));
        row.and_then(|row| row.split(',').next()).and_then(|n| n.parse().ok()).expect("a count")
    };
    assert!(triangles("uniform") > 2.0 * triangles("nonuniform"), "far more on a plain drawing");
    assert!(row("uniform")[4] < row("nonuniform")[4], "and a larger error");
    for file in ["figure10-drawing.svg", "figure10-error.svg", "figure12.svg", "table4-drawings.csv"] {
        assert!(!place.get(&format!("out/{file}")).is_empty(), "{file}");
    }
}
