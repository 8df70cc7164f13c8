//! `lar plane` run as a program: counts, areas, Booleans of regions, files, and what is refused.

mod support;

use lar_core::{ChainComplex, parse_svg};
use serde_json::Value;
use support::{Place, done, fixture, redacted, words};

/// Two squares of side 4 that overlap in one of side 2.
const TWO_SQUARES: &str = "0 0 4 0\n4 0 4 4\n4 4 0 4\n0 4 0 0\n2 2 6 2\n6 2 6 6\n6 6 2 6\n2 6 2 2\n";

/// Squares around each other, and lines that lead nowhere.
const SHAPES: &str = r#"<svg xmlns="http://www.w3.org/2000/svg">
<g id="frames"><rect id="big" width="10" height="10"/><rect id="path-2" x="20" width="4" height="4"/></g>
<rect id="hole" x="2" y="2" width="3" height="3"/>
<path id="twice" d="M0 0h4v4h-4zM1 1h2v2h-2z"/>
<path id="odd" fill-rule="evenodd" d="M0 0h4v4h-4zM1 1h2v2h-2z"/>
<path id="door" d="M0 0h4v4"/><path id="lid" d="M0 0h4v4L0 0"/>
<circle r="1" cx="50"/>
</svg>"#;

fn place() -> Place {
    let place = Place::new();
    place.write("squares.seg", TWO_SQUARES);
    place.write("shapes.svg", SHAPES);
    place.write("plan.svg", std::fs::read(fixture("plan.svg")).expect("a fixture"));
    place
}

fn report(place: &Place, line: &str) -> Value {
    serde_json::from_str(&done(place, &words(&format!("plane {line} --json -"))).out).expect("valid JSON")
}

/// Vertices, edges, bounded faces, components, loops and area of segments.
#[track_caller]
fn check(segments: &str, options: &str, expected: [usize; 5], area: f64) {
    let place = Place::new();
    place.write("a.seg", segments);
    let report = report(&place, &format!("a.seg{options}"));
    let counts = ["vertices", "edges", "faces", "components", "loops"];
    assert_eq!(counts.map(|key| report[key].as_u64().unwrap() as usize), expected, "{segments}{options}");
    assert_eq!(report["area"], area, "{segments}{options}");
    assert_eq!((&report["boundary_squared_zero"], &report["euler_ok"]), (&true.into(), &true.into()));
}

#[test]
fn known_partitions() {
    check(TWO_SQUARES, "", [10, 12, 3, 1, 3], 28.0);
    // A square with two others in it.
    let small = |x: f64| format!("{x} 1 {0} 1\n{0} 1 {0} 2\n{0} 2 {x} 2\n{x} 2 {x} 1\n", x + 1.0);
    let big = "0 0 8 0\n8 0 8 8\n8 8 0 8\n0 8 0 0\n";
    check(&format!("{big}{}{}", small(1.0), small(4.0)), "", [12, 12, 3, 3, 5], 64.0);
    // A square crossed by two lines, with a free square in one of the parts.
    let lines = "-1 4 9 4\n4 -1 4 9\n";
    check(&format!("{big}{lines}{}", small(1.0)), "", [13, 16, 5, 2, 6], 64.0);
    check(&format!("{big}{lines}{}", small(1.0)), " --keep-dangling", [17, 20, 5, 2, 6], 64.0);
    check("0 0 1 1\n0 1 1 0\n", "", [0, 0, 0, 0, 0], 0.0);
    check("0 0 1 1\n0 1 1 0 # a cross\n", " --keep-dangling", [5, 4, 0, 1, 0], 0.0);
}

#[test]
fn reports() {
    let place = place();
    let run = done(&place, &words("plane plan.svg squares.seg --keep-dangling --json -"));
    insta::assert_snapshot!("partition", redacted(&run.out));
    let printed = done(&place, &words("plane plan.svg squares.seg --keep-dangling --json report.json")).out;
    assert_eq!(redacted(&place.read("report.json")), redacted(&run.out));
    let boolean = done(&place, &words("plane --boolean walls-table plan.svg --json -"));
    insta::assert_snapshot!("boolean", redacted(&boolean.out));
    let printed_boolean = done(&place, &words("plane --boolean walls-table plan.svg")).out;
    let both = printed + &printed_boolean;
    let text: Vec<&str> = both.lines().filter(|l| !l.contains(" s to read")).collect();
    insta::assert_snapshot!("text", text.join("\n"));
}

#[test]
fn threads_change_nothing() {
    let place = Place::new();
    // Segments between points of a small lattice: crossings, overlaps and common ends in plenty.
    let mut state = 7_u64;
    let mut coordinate = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % 40
    };
    let mut line = || [(); 4].map(|()| coordinate().to_string()).join(" ") + "\n";
    place.write("a.seg", (0..400).map(|_| line()).collect::<String>());
    let mut results = Vec::new();
    for threads in ["1", "2", "7"] {
        let line = "plane a.seg -o out.svg --complex complex.json --explode 1.5 --json - --threads";
        let run = done(&place, &[words(line), vec![threads]].concat());
        results.push((place.read("out.svg"), place.read("complex.json"), redacted(&run.out)));
    }
    assert!(results.windows(2).all(|w| w[0] == w[1]), "the same bytes for 1, 2 and 7 threads");
    let complex = ChainComplex::from_json(&results[0].1).unwrap();
    let report: Value = serde_json::from_str(&results[0].2).unwrap();
    assert_eq!(report["faces"], complex.n_cells(2) - 1);
    assert_eq!(complex.validate_with_exterior(), []);
    assert!(complex.n_cells(2) > 1000, "many faces");
}

/// Polygons, holes and area of an expression, and that the SVG written has this area too.
#[track_caller]
fn check_boolean(expression: &str, line: &str, expected: [usize; 2], area: f64) {
    let place = place();
    let args = [vec!["plane", "--boolean", expression, "-o", "out.svg", "--json", "-"], words(line)].concat();
    let report: Value = serde_json::from_str(&done(&place, &args).out).unwrap();
    let counts = ["polygons", "holes"].map(|key| report[key].as_u64().unwrap() as usize);
    assert_eq!((counts, report["area"].as_f64()), (expected, Some(area)), "{expression} {line}");
    let drawing = parse_svg(&place.read("out.svg"), "out.svg", 1.0).unwrap();
    let doubled = |cycle: &Vec<[f64; 2]>| {
        let next = cycle.iter().skip(1).chain(cycle.first());
        cycle.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>()
    };
    assert_eq!(drawing.loops().iter().map(doubled).sum::<f64>() / 2.0, area, "{expression} {line}");
}

#[test]
fn booleans_of_elements() {
    check_boolean("big - hole", "shapes.svg", [1, 1], 91.0);
    check_boolean("frames - hole", "shapes.svg", [2, 1], 107.0);
    check_boolean("'path-2' | \"hole\"", "shapes.svg", [2, 0], 25.0);
    check_boolean("twice", "shapes.svg", [1, 0], 16.0);
    check_boolean("odd", "shapes.svg", [1, 1], 12.0);
    check_boolean("twice", "shapes.svg --fill even-odd", [1, 1], 12.0);
    check_boolean("odd", "shapes.svg --fill nonzero", [1, 0], 16.0);
    check_boolean("lid - lid", "shapes.svg", [0, 0], 0.0);
    check_boolean("lid", "shapes.svg", [1, 0], 8.0);
    check_boolean("big & !(hole | twice)", "shapes.svg", [1, 0], 100.0 - 25.0 + 4.0);
    check_boolean("walls", "plan.svg", [1, 2], 24000.0 - 17000.0);
}

#[test]
fn booleans_of_drawings() {
    check_boolean("A", "squares.seg", [2, 0], 24.0);
    check_boolean("A", "squares.seg --fill nonzero", [1, 0], 28.0);
    check_boolean("A", "A=squares.seg shapes.svg --fill even-odd", [2, 0], 24.0);
    check_boolean("A - B.hole", "squares.seg shapes.svg", [2, 0], 24.0);
    check_boolean("plan.walls ^ s", "s=squares.seg plan=plan.svg", [3, 2], 7000.0 + 24.0);
}

/// A line that is refused: exit code 2, one line on the error stream, nothing written.
fn refused(place: &Place, line: &str) -> String {
    let run = place.lar(&words(&format!("plane {line}")));
    assert_eq!((run.code, run.err.lines().count(), run.out.as_str()), (2, 1, ""), "{line}: {run:?}");
    format!("$ lar plane {line}\n{}", run.err)
}

#[test]
fn refusals() {
    let place = place();
    place.write("number.seg", "0 0 1 1\n# fine\n0 zero 1 1\n");
    place.write("odd.seg", "0 0 1\n");
    place.write("nan.seg", "0 0 1 NaN\n");
    place.write("empty.seg", "# nothing\n");
    place.write("binary.seg", b"\xff\xfe\n");
    place.write("empty.svg", "<svg/>");
    place.write("torn.svg", "<svg><rect");
    place.write("other.txt", "0 0 1 1\n");
    place.write("turned.seg", "0 0 1 0\n1 0 0 1\n0 0 0 1\n");
    place.write("clash.svg", "<svg><rect width='1' height='1'/><rect id='A' width='2' height='2'/></svg>");
    let before = place.files();
    let lines = [
        "",
        "missing.seg --json out.json -o out.svg --complex out.complex",
        "number.seg --json out.json -o out.svg --complex out.complex",
        "squares.seg odd.seg -o out.svg",
        "nan.seg",
        "empty.seg",
        "binary.seg",
        "empty.svg",
        "torn.svg",
        "other.txt",
        "squares.seg -o out.gif",
        "squares.seg -o no/out.svg",
        "squares.seg -o out.svg --json out.svg",
        "squares.seg --explode far",
        "squares.seg --threads 0",
        "shapes.svg --tolerance -1",
        "squares.seg --fill nonzero",
        "--boolean A squares.seg --keep-dangling",
        "--boolean A squares.seg --complex out.json",
        "--boolean B squares.seg -o out.svg --json out.json",
        "--boolean A& squares.seg",
        "--boolean !A squares.seg -o out.svg",
        "--boolean A turned.seg --fill nonzero",
        "--boolean door shapes.svg -o out.svg --json out.json",
        "--boolean frames|door shapes.svg -o out.svg",
        "--boolean A.door-B A=shapes.svg squares.seg",
        "--boolean A clash.svg",
        "--boolean A A=squares.seg A=shapes.svg",
    ];
    let said: String = lines.iter().map(|line| refused(&place, line)).collect();
    insta::assert_snapshot!(said);
    assert_eq!(place.files(), before, "nothing is written");
}

#[test]
fn floor_plans() {
    let place = place();
    let plan = |args: &[&str]| {
        let run = place.program(env!("CARGO_BIN_EXE_floor_plan"), args);
        format!("{}{}", run.out, run.err)
    };
    let apartment = fixture("apartment.svg");
    place.write("no_walls.svg", "<svg><rect id='house' width='1' height='1'/></svg>");
    let said = [
        plan(&[apartment.to_str().expect("a path of UTF-8")]),
        plan(&["plan.svg", "--unit", "0.1"]),
        plan(&["no_walls.svg"]),
        plan(&["missing.svg"]),
    ];
    insta::assert_snapshot!(said.join("\n"));
}

#[test]
fn figures_print_the_numbers() {
    let place = Place::new();
    let programs = [env!("CARGO_BIN_EXE_figure4"), env!("CARGO_BIN_EXE_figure5")];
    let said: Vec<String> = programs
        .iter()
        .flat_map(|program| {
            [&[][..], &["--seed", "1", "--shapes", "9"]].map(|args| {
                let run = place.program(program, args);
                assert_eq!((run.code, run.err.as_str()), (0, ""));
                run.out
            })
        })
        .collect();
    insta::assert_snapshot!(said.join("\n"));
}
