//! `lar` and `three_cubes` run as programs, on the three cubes and on pairs of spheres.

mod support;

use lar_core::{ChainComplex, ObjGrouping, TriangleMesh, read_obj};
use lar_examples::scenes;
use serde_json::Value;
use support::{Place, done, redacted, words};

#[test]
fn arrangement_of_the_three_cubes() {
    let place = Place::with_cubes();
    let run = done(&place, &words("arrange a.obj b.obj c.obj --json -"));
    insta::assert_snapshot!("arrange", redacted(&run.out));
    let printed = done(&place, &words("arrange a.obj b.obj c.obj --json report.json")).out;
    assert_eq!(redacted(&place.read("report.json")), redacted(&run.out));
    let text: Vec<&str> = printed.lines().filter(|l| !l.contains(" s to read")).collect();
    insta::assert_snapshot!("arrange_text", text.join("\n"));
}

#[test]
fn threads_change_nothing() {
    let place = Place::with_cubes();
    let mut results = Vec::new();
    for threads in ["1", "2", "7", "1000000"] {
        let line = "arrange a.obj b.obj c.obj --complex complex.json --json - --threads";
        let run = done(&place, &[words(line), vec![threads]].concat());
        let report: Value = serde_json::from_str(&run.out).unwrap();
        assert_eq!(report["threads"].to_string(), threads);
        results.push((place.read("complex.json"), redacted(&run.out)));
    }
    assert!(results.windows(2).all(|w| w[0] == w[1]), "the same bytes for any number of threads");
    let complex = ChainComplex::from_json(&results[0].0).unwrap();
    assert_eq!(complex.f_vector(), [49, 88, 47, 8]);
    assert_eq!(complex.validate_with_exterior(), []);
}

/// The stages of the table are those of the report, in the same order.
#[test]
fn what_it_cost() {
    let place = Place::with_cubes();
    let printed = done(&place, &words("arrange a.obj b.obj c.obj --stats --json report.json")).out;
    let table = printed.split_once(" s to arrange\n").expect("the table comes last").1;
    let names: Vec<&str> = table.lines().map(|line| line.split("  ").next().unwrap_or_default()).collect();
    let report: Value = serde_json::from_str(&place.read("report.json")).unwrap();
    let stages = report["seconds"]["stages"].as_object().expect("times by stage");
    let (of_stages, rest) = names.split_at(stages.len());
    assert!(of_stages.iter().all(|name| stages.contains_key(*name)), "{table}");
    assert_eq!(rest[..2], ["all stages", "facets"], "{table}");
    let tested = report["counters"]["pairs_tested"].to_string();
    assert!(
        table.lines().any(|l| l.starts_with("pairs of facets tested ") && l.ends_with(&tested)),
        "{table}"
    );
}

fn mesh(place: &Place, name: &str) -> TriangleMesh {
    let surface = read_obj(place.path(name), ObjGrouping::Whole).unwrap().remove(0);
    let triangle = |f| <[u32; 3]>::try_from(surface.face(f).next().unwrap()).expect("triangles");
    let triangles = (0..surface.n_faces()).map(triangle).collect();
    TriangleMesh { points: surface.points, triangles }
}

#[test]
fn cells_as_files() {
    let place = Place::with_cubes();
    std::fs::create_dir(place.path("cells")).unwrap();
    let run = done(&place, &words("arrange a.obj b.obj c.obj --json - --obj cells"));
    let report: Value = serde_json::from_str(&run.out).unwrap();
    let names: Vec<String> =
        place.files().iter().map(|p| p.file_name().unwrap().to_string_lossy().into_owned()).collect();
    let cells: Vec<String> = (1..8).map(|c| format!("cell_00{c}.obj")).collect();
    assert_eq!(names, [&["a.obj", "b.obj", "c.obj", "cells"].map(String::from), &cells[..]].concat());
    for (cell, name) in (1..).zip(&cells) {
        let mesh = mesh(&place, &format!("cells/{name}"));
        let volume = report["volumes"][cell].as_f64().unwrap();
        assert!(mesh.is_closed() && (mesh.signed_volume() - volume).abs() < 1e-12, "{name}");
    }
    let again = place.lar(&words("arrange a.obj b.obj c.obj --obj cells"));
    assert_eq!(
        (again.code, again.err.as_str()),
        (2, "lar: cannot write cells: the directory is not empty\n")
    );
}

/// Binary STL keeps triangles and 32 bits; the three cubes come back as they were.
#[test]
fn cubes_through_files_of_triangles() {
    let place = Place::with_cubes();
    for name in ["a", "b", "c"] {
        let [from, to] = ["obj", "stl"].map(|extension| format!("{name}.{extension}"));
        done(&place, &["boolean", "A", &from, "-o", &to]);
    }
    let args = words("arrange a.stl b.stl c.stl --merge-coplanar --json -");
    let report: Value = serde_json::from_str(&done(&place, &args).out).expect("a report in JSON");
    let counts = ["vertices", "edges", "faces", "cells"].map(|name| report[name].as_u64().unwrap());
    assert_eq!(counts, [49, 88, 47, 8]);
    assert_eq!(report["parents_ok"], true);
}

#[test]
fn boolean_of_the_three_cubes() {
    let place = Place::with_cubes();
    let line = "boolean A-B|C a.obj b.obj c.obj -o out.obj --json -";
    insta::assert_snapshot!("boolean", redacted(&done(&place, &words(line)).out));
    let fragments = done(&place, &[words(line), vec!["--keep-fragments"]].concat()).out;
    insta::assert_snapshot!("boolean_fragments", redacted(&fragments));
    let printed = done(&place, &words("boolean A-B|C a.obj b.obj c.obj -o out.json --json report.json")).out;
    let polygons = ChainComplex::read_json(place.path("out.json")).unwrap();
    let report: Value = serde_json::from_str(&place.read("report.json")).unwrap();
    assert_eq!(report["faces"], polygons.n_cells(2));
    assert!(printed.starts_with("A-B|C: "), "{printed}");
}

/// With and without the cells the same file, and the same numbers of it.
#[track_caller]
fn check_alone(place: &Place, line: &str) {
    let [cells, alone] = ["cells", "alone"].map(|name| {
        let more = format!("-o {name}.obj --json -{}", if name == "alone" { " --surface-only" } else { "" });
        let report = done(place, &[words(line), words(&more)].concat()).out;
        (serde_json::from_str::<Value>(&report).unwrap(), place.read(&format!("{name}.obj")))
    });
    let number = |report: &Value, name: &str| report[name].as_f64();
    for name in ["volume", "area"] {
        let [a, b] = [&cells.0, &alone.0].map(|report| number(report, name));
        assert_eq!(a.is_some(), b.is_some(), "{line}: {name}");
        assert!((a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs() < 1e-9, "{line}: {name} {a:?} {b:?}");
    }
    for name in
        ["vertices", "edges", "faces", "triangles", "components", "loops", "closed", "bounded", "euler"]
    {
        assert_eq!(cells.0[name], alone.0[name], "{line}: {name}");
    }
    assert_eq!(cells.1, alone.1, "{line}");
}

#[test]
fn surfaces_without_cells() {
    let place = Place::with_cubes();
    for line in
        ["A-B|C a.obj b.obj c.obj", "!A&!B a.obj b.obj", "A-A a.obj", "A^B a.obj b.obj --keep-fragments"]
    {
        check_alone(&place, &format!("boolean {line}"));
    }
    let printed = done(&place, &words("boolean A|B a.obj b.obj -o out.stl --surface-only")).out;
    assert!(printed.starts_with("A|B: "), "{printed}");
    let line = "boolean -e x=A a.obj -o results --surface-only";
    let both = place.lar(&words(line));
    assert_eq!(both.code, 2);
    assert!(both.err.contains("cannot be used with"), "{}", both.err);
    // What is refused is refused in the same words.
    let cube = place.read("a.obj");
    place.write("open.obj", &cube[..cube.trim_end().rfind('\n').expect("lines")]);
    let refused = ["", " --surface-only"].map(|more| {
        let run = place.lar(&words(&format!("boolean A|B open.obj a.obj -o no.obj{more}")));
        (run.code, run.err)
    });
    assert_eq!(refused[0], refused[1]);
    assert_eq!(refused[0].0, 2);
    assert!(!place.path("no.obj").exists());
}

/// Volume of an expression over the three cubes, as the command computes it.
#[track_caller]
fn check_volume(expression: &str, fill: &str, expected: Option<f64>) {
    let place = Place::with_cubes();
    let line = format!("boolean EXPR a.obj hole=b.obj c.obj -o out.obj --json - --fill {fill}");
    let args: Vec<&str> = line.split(' ').map(|a| if a == "EXPR" { expression } else { a }).collect();
    let report: Value = serde_json::from_str(&done(&place, &args).out).unwrap();
    assert_eq!((&report["closed"], &report["bounded"]), (&true.into(), &expected.is_some().into()));
    match expected {
        None => assert!(report["volume"].is_null()),
        Some(expected) => {
            let volume = report["volume"].as_f64().unwrap();
            assert!((volume - expected).abs() < 1e-6, "{expression}: {volume}, not {expected}");
            match report["triangles"].as_u64() {
                Some(0) => assert!(!place.read("out.obj").contains('f'), "{expression} is empty"),
                _ => assert!((mesh(&place, "out.obj").signed_volume() - volume).abs() < 1e-9, "{expression}"),
            }
        }
    }
}

#[test]
fn expressions_and_fill_rules() {
    check_volume("A | hole | C", "nonzero", Some(2.484_154));
    check_volume("A & hole & C", "even-odd", Some(0.059_034));
    check_volume("A - hole - C", "positive", Some(0.597_214));
    check_volume("A - (hole | C)", "nonzero", Some(0.597_214));
    check_volume("A & !hole & !C", "nonzero", Some(0.597_214));
    check_volume("A ^ hole ^ C", "nonzero", Some(0.597_214 + 0.590_061 + 0.840_067 + 0.059_034));
    check_volume("A - A", "nonzero", Some(0.0));
    check_volume("!A", "nonzero", None);
}

/// Two spheres of 20,480 triangles each, in general position.
fn spheres() -> Place {
    let place = Place::new();
    let sphere = lar_core::icosphere(5);
    sphere.write_obj(place.path("a.obj")).unwrap();
    let surfaces = scenes::two_spheres(5, 0.7).unwrap();
    TriangleMesh { points: surfaces[1].points.clone(), ..sphere }.write_obj(place.path("b.obj")).unwrap();
    place
}

#[test]
fn booleans_of_spheres() {
    let place = spheres();
    let names = ["A|B", "A&B", "A-B", "A^B"];
    let [union, intersection, difference, symmetric] = names.map(|expression| {
        let line = ["boolean", expression, "a.obj", "b.obj", "-o", "out.obj", "--json", "-"];
        let report: Value = serde_json::from_str(&done(&place, &line).out).unwrap();
        assert_eq!(report["closed"], true, "{expression}");
        let volume = report["volume"].as_f64().unwrap();
        let mesh = mesh(&place, "out.obj");
        assert!(mesh.is_closed(), "{expression}");
        assert_eq!(report["triangles"], mesh.triangles.len());
        assert!((mesh.signed_volume() / volume - 1.0).abs() < 1e-9, "{expression}");
        volume
    });
    let [a, b] = ["a.obj", "b.obj"].map(|name| mesh(&place, name).signed_volume());
    let check = |left: f64, right: f64, law: &str| {
        assert!((left - right).abs() < 1e-9 * (a + b), "{law}: {left} is not {right}");
    };
    check(union + intersection, a + b, "|A∪B| + |A∩B| = |A| + |B|");
    check(difference + intersection, a, "|A−B| + |A∩B| = |A|");
    check(symmetric + 2.0 * intersection, a + b, "|A△B| + 2|A∩B| = |A| + |B|");
    assert!(0.1 * a < intersection && intersection < 0.9 * a, "the spheres cross");
}

#[test]
fn facts() {
    let place = Place::with_cubes();
    let open = place.read("a.obj");
    place.write("open.obj", &open[..open.trim_end().rfind('\n').unwrap()]);
    let arranged = done(&place, &words("arrange a.obj open.obj --complex complex.json")).out;
    let warning = "B (open.obj) is open, it has 4 boundary edges: no cell is inside it";
    assert!(arranged.lines().any(|line| line == warning), "{arranged}");
    let said: Vec<String> =
        ["a.obj", "open.obj", "complex.json"].iter().map(|f| done(&place, &["info", f]).out).collect();
    insta::assert_snapshot!(said.join("\n"));
}

/// Commands that draw have fewer options in a build without graphics.
#[test]
#[cfg(feature = "window")]
fn help_and_version() {
    let place = Place::new();
    assert_eq!(done(&place, &["--version"]).out, format!("lar {}\n", env!("CARGO_PKG_VERSION")));
    let pages = [
        "",
        "arrange",
        "boolean",
        "render",
        "view",
        "info",
        "measure",
        "validate",
        "clean",
        "convert",
        "plane",
        "completions",
        "man",
    ]
    .map(|command| {
        let args: Vec<&str> = [command, "--help"].into_iter().filter(|a| !a.is_empty()).collect();
        done(&place, &args).out
    });
    insta::assert_snapshot!(pages.join("\n----\n"));
}

#[test]
fn three_cubes_prints_the_numbers() {
    let run = Place::new().three_cubes(&[]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    insta::assert_snapshot!(run.out);
}

/// A box with corners (x, y, z) for x in 0 and 1, the heights of its bottom at both ends, and of its top.
fn slab(text: &mut String, x: [f64; 2], y: [f64; 2], bottom: [f64; 2], top: f64) {
    use std::fmt::Write as _;
    let first = text.matches("v ").count();
    for z in [bottom, [top; 2]] {
        for (i, j) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            writeln!(text, "v {:e} {} {:e}", x[i], y[j], z[i]).expect("a string");
        }
    }
    for face in [[4, 3, 2, 1], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]] {
        let [a, b, c, d] = face.map(|v| first + v);
        writeln!(text, "f {a} {b} {c} {d}").expect("a string");
    }
}

/// Three bottoms cross a wall in a triangle of height 2^-56 at z = 1, where numbers are 2^-52 apart: of its exact corners
/// rounding leaves three on one line.
#[test]
fn rounding_is_counted() {
    let (e, d) = (2f64.powi(-30), 2f64.powi(-27));
    let mut text = String::new();
    slab(&mut text, [-1.5, 1.5], [-1.0, 1.0], [1.0; 2], 3.0);
    slab(&mut text, [-1.0, 1.0], [-1.0, 1.0], [1.0 - e, 1.0 + e], 3.0);
    slab(&mut text, [d - 1.0, d + 1.0], [-1.0, 1.0], [1.0 - 2.0 * e, 1.0 + 2.0 * e], 3.0);
    slab(&mut text, [-2.0, 2.0], [0.0, 1.0], [0.0; 2], 2.5);
    let place = Place::with_cubes();
    place.write("thin.obj", text);
    for command in ["arrange", "boolean A", "clean"] {
        let rounding = |input: &str| -> Value {
            let output = if command == "arrange" { "" } else { " -o out.obj" };
            let run = done(&place, &words(&format!("{command} {input}{output} --as-given --json -")));
            let report: Value = serde_json::from_str(&run.out).unwrap();
            report["rounding"].clone()
        };
        let counts =
            |value: Value| -> u64 { value.as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum() };
        assert_eq!(counts(rounding("a.obj")), 0, "{command}");
        let found = rounding("thin.obj");
        let expects_some = command == "arrange";
        assert_eq!(0 < found["degenerate_triangles"].as_u64().unwrap(), expects_some, "{command}: {found}");
    }
    let line = words("boolean A thin.obj --fill even-odd --as-given -o out.obj");
    let printed = done(&place, &line).out;
    let said =
        printed.lines().find_map(|line| line.strip_prefix("after rounding: ")).expect("a line about it");
    assert!(!said.contains(" 0 degenerate triangles"), "{said}");
}

/// Results of one Boolean are operands of the next, in every format that surfaces are read from.
#[test]
fn results_in_other_formats() {
    let place = Place::with_cubes();
    for extension in ["stl", "ply", "off"] {
        let union = format!("union.{extension}");
        done(&place, &["boolean", "A|B", "a.obj", "b.obj", "-o", &union]);
        let run = done(&place, &["boolean", "A-B", &union, "c.obj", "-o", "rest.obj", "--json", "-"]);
        let report: Value = serde_json::from_str(&run.out).expect("valid JSON");
        let volume = report["volume"].as_f64().expect("a bounded result");
        // Cells 110, 100 and 010 of the three cubes; STL rounds to 32 bits.
        assert!((volume - (0.296879 + 0.597214 + 0.590061)).abs() < 2e-6, "{extension}: {volume}");
        assert_eq!(report["closed"], true, "{extension}");
    }
    done(&place, &words("boolean A|B a.obj b.obj -o union.glb"));
    assert!(place.path("union.glb").metadata().is_ok_and(|m| m.len() > 1000));
}

#[test]
fn several_expressions_in_one_arrangement() {
    let place = Place::with_cubes();
    let line = "boolean -e both=A&B&C -e rest=A-B-C a.obj b.obj c.obj -o results --format ply --json -";
    let report: Value = serde_json::from_str(&done(&place, &words(line)).out).unwrap();
    let volumes: Vec<f64> =
        report["results"].as_array().unwrap().iter().map(|r| r["volume"].as_f64().unwrap()).collect();
    assert!((volumes[0] - 0.059_034).abs() < 1e-6 && (volumes[1] - 0.597_214).abs() < 1e-6, "{volumes:?}");
    for (name, volume) in ["both", "rest"].iter().zip(volumes) {
        let surface = lar_core::read_surface(place.path(&format!("results/{name}.ply"))).unwrap().surface;
        let found = surface.volume_integral([0; 3]).unwrap();
        assert!((found - volume).abs() < 1e-9, "{name}: {found} and {volume}");
    }
    let twice = place.lar(&words("boolean -e x=A -e x=B a.obj b.obj -o other"));
    assert_eq!((twice.code, twice.err.as_str()), (2, "lar: two expressions are named x\n"));
}

/// Two overlapping cubes in one file, the faces of the second turned when `inverted`.
fn overlapping(place: &Place, inverted: bool) {
    let [a, b] = ["a.obj", "b.obj"].map(|name| place.read(name));
    let vertices = |text: &str| text.lines().filter(|l| l.starts_with("v ")).collect::<Vec<_>>().join("\n");
    let face = |line: &str| {
        let mut corners: Vec<String> = line
            .split(' ')
            .skip(1)
            .map(|v| (v.parse::<usize>().expect("a number") + 8).to_string())
            .collect();
        if inverted {
            corners.reverse();
        }
        format!("f {}\n", corners.join(" "))
    };
    let faces: String = b.lines().filter(|l| l.starts_with("f ")).map(face).collect();
    let first: Vec<&str> = a.lines().filter(|l| l.starts_with("f ")).collect();
    place.write("two.obj", format!("{}\n{}\n{}\n{faces}", vertices(&a), vertices(&b), first.join("\n")));
}

#[test]
fn cleaning() {
    let place = Place::with_cubes();
    let volume = |options: &str| {
        let line = format!("clean two.obj -o out.obj --json -{options}");
        let report: Value = serde_json::from_str(&done(&place, &words(&line)).out).expect("valid JSON");
        assert!(mesh(&place, "out.obj").is_closed() && report["closed"] == true);
        report["volume"].as_f64().expect("a bounded result")
    };
    let common = 0.355_914;
    overlapping(&place, false);
    let rules =
        [("", 2.0 - common), (" --rule nonzero", 2.0 - common), (" --rule even-odd", 2.0 - 2.0 * common)];
    for (rule, expected) in rules {
        assert!((volume(rule) - expected).abs() < 1e-6, "{rule}");
    }
    overlapping(&place, true);
    // Inside out: the second cube takes away from the first, by the rule `positive`.
    for (rule, expected) in [("", 2.0 - common), (" --rule positive", 1.0 - common)] {
        assert!((volume(rule) - expected).abs() < 1e-6, "{rule}, inverted");
    }
}

#[test]
fn validation() {
    let place = Place::with_cubes();
    let cube = place.read("a.obj");
    place.write("open.obj", &cube[..cube.trim_end().rfind('\n').expect("lines")]);
    overlapping(&place, true);
    done(&place, &words("arrange a.obj b.obj --complex complex.json"));
    let sign = place.read("complex.json").replacen("-1", "1", 1);
    place.write("broken.json", sign);
    let said = ["a.obj", "open.obj", "two.obj", "complex.json", "broken.json"].map(|file| {
        let run = place.lar(&["validate", file]);
        format!("$ lar validate {file}\n{}{}exit code {}\n", run.out, run.err, run.code)
    });
    insta::assert_snapshot!(said.concat());
}

#[test]
fn measures() {
    let place = Place::with_cubes();
    let line = "measure a.obj b.obj c.obj --density 2 --density B=7";
    insta::assert_snapshot!(done(&place, &words(line)).out);
    let report: Value =
        serde_json::from_str(&done(&place, &[words(line), vec!["--json", "-"]].concat()).out).unwrap();
    let mass = |value: &Value| value["mass"].as_f64().unwrap();
    let cells: f64 = report["cells"].as_array().unwrap().iter().map(mass).sum();
    assert!((mass(&report["total"]) - cells).abs() < 1e-12);
    assert!((mass(&report["inputs"][1]) - 7.0).abs() < 1e-9, "all of B has its own density");
}

/// A file of each kind becomes one of each other kind of the same dimension.
#[test]
fn conversions() {
    let place = Place::with_cubes();
    done(&place, &words("boolean A-B a.obj b.obj -o solid.json"));
    done(&place, &words("arrange a.obj b.obj --complex cells.json"));
    lar_core::cuboid_grid(&[2, 1, 1]).write_json(place.path("model.json")).unwrap();
    let hierarchy =
        lar_core::Struct::new("row").with(lar_core::cuboid_grid(&[1, 1, 1])).with(lar_core::t(&[3., 0., 0.]));
    hierarchy.with(lar_core::cuboid_grid(&[1, 1, 1])).write_json(place.path("struct.json")).unwrap();
    let volumes = [
        ("a.obj", 1.0),
        ("solid.json", 0.644_086),
        ("cells.json", 1.644_086),
        ("model.json", 2.0),
        ("struct.json", 2.0),
    ];
    for (input, volume) in volumes {
        for output in ["out.obj", "out.stl", "out.ply", "out.off"] {
            done(&place, &["convert", input, output]);
            let surface = lar_core::read_surface(place.path(output)).unwrap().surface;
            let found = surface.volume_integral([0; 3]).unwrap();
            assert!((found - volume).abs() < 1e-5, "{input} as {output}: {found}");
        }
    }
    place.write("plan.svg", std::fs::read(support::fixture("plan.svg")).unwrap());
    let area = |file: &str| -> Value {
        let run = done(&place, &["plane", file, "--json", "-"]);
        serde_json::from_str::<Value>(&run.out).unwrap()["area"].clone()
    };
    done(&place, &words("convert plan.svg plan.seg"));
    done(&place, &words("convert plan.seg plan.json"));
    done(&place, &words("convert plan.json again.seg"));
    let [first, second, third] = ["plan.svg", "plan.seg", "again.seg"].map(|f| area(f).as_f64().unwrap());
    assert!((first - second).abs() < 1e-6 * first && (first - third).abs() < 1e-6 * first);
}

#[test]
fn completions_and_manual_pages() {
    let place = Place::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = done(&place, &["completions", shell]).out;
        assert!(["measure", "validate", "tolerance"].iter().all(|word| script.contains(word)), "{shell}");
    }
    assert!(done(&place, &["man"]).out.contains(".TH lar 1"));
    done(&place, &["man", "--out", "pages"]);
    let names: Vec<String> =
        place.files().iter().skip(1).map(|p| p.file_name().unwrap().to_string_lossy().into_owned()).collect();
    assert_eq!(names.len(), 14, "lar and thirteen subcommands: {names:?}");
    assert!(place.read("pages/lar-boolean.1").contains("difference"));
}
