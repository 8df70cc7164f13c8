//! docs/formats.md, the schemas of docs/schema, and what the command really writes are the same.

#[path = "support/schema.rs"]
mod schema;
mod support;

use lar_core::{Struct, cuboid_grid, r, t};
use schema::schema;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use support::{Place, fixture, words};

const DOCUMENT: &str = include_str!("../../docs/formats.md");

/// The fields of a report as its table lists them, with what it says of each.
fn documented(report: &str) -> BTreeMap<String, String> {
    let section = DOCUMENT.split("\n### ").find(|s| s.starts_with(&format!("`{report}`"))).expect(report);
    let rows =
        section.lines().filter_map(|line| line.strip_prefix("| `")?.strip_suffix(" |")?.split_once("` | "));
    rows.map(|(field, text)| (field.to_owned(), text.to_owned())).collect()
}

/// The fields of a report as it is written, those of all elements of lists together.
fn fields(path: &str, value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) if path != "seconds.stages" => {
            let below = |key: &String| if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            map.iter().for_each(|(key, value)| fields(&below(key), value, found));
        }
        Value::Array(list) if list.iter().any(Value::is_object) => {
            list.iter().for_each(|value| fields(&format!("{path}[]"), value, found));
        }
        _ => {
            found.insert(path.to_owned());
        }
    }
}

/// Runs a command with `--json -`; its report has the fields of the table, and its schema says of them what the table says.
#[track_caller]
fn check(place: &Place, line: &str, report: &str) {
    let run = place.lar(&[words(line), vec!["--json", "-"]].concat());
    let value: Value = serde_json::from_str(&run.out).unwrap_or_else(|e| panic!("{line}: {e}: {run:?}"));
    let mut found = BTreeSet::new();
    fields("", &value, &mut found);
    let header: [(&str, Value); 3] =
        [("format", "lar-report".into()), ("version", 1.into()), ("report", report.into())];
    for (field, expected) in header {
        assert_eq!(value[field], expected, "{field} of {line}");
        found.remove(field);
    }
    let documented = documented(report);
    assert_eq!(found, documented.keys().cloned().collect(), "{line}");
    let schema = schema(&format!("report-{report}"));
    schema::check(&schema, &value);
    let mut described = Vec::new();
    schema::descriptions("", &schema, &mut described);
    assert_eq!(described.into_iter().collect::<BTreeMap<_, _>>(), documented, "the schema of {report}");
}

#[test]
fn reports_have_the_documented_fields() {
    let place = Place::with_cubes();
    let cube = place.read("a.obj");
    place.write("open.obj", &cube[..cube.trim_end().rfind('\n').expect("lines")]);
    place.write("plan.svg", std::fs::read(fixture("apartment.svg")).expect("a fixture"));
    check(&place, "arrange a.obj b.obj --complex complex.json", "arrange");
    check(&place, "boolean A-B a.obj b.obj -o out.obj", "boolean");
    check(&place, "boolean A-B a.obj b.obj -o alone.obj --surface-only", "boolean-surface");
    check(&place, "boolean -e x=A-B -e y=A&B a.obj b.obj -o results", "boolean-batch");
    check(&place, "clean a.obj -o out.obj", "clean");
    check(&place, "measure a.obj b.obj", "measure");
    check(&place, "validate open.obj", "validate");
    check(&place, "convert a.obj out.stl", "convert");
    check(&place, "info open.obj", "info");
    check(&place, "info complex.json", "info-complex");
    check(&place, "plane plan.svg", "plane");
    check(&place, "plane --boolean walls-openings plan.svg", "plane-boolean");
    let reports = DOCUMENT.split("\n### ").skip(1).count();
    assert_eq!(reports, 12, "each report of the document is checked above");
}

/// Files of models, hierarchies, complexes are what their schemas say.
#[test]
fn models_are_what_their_schemas_say() {
    let check = |name: &str, text: &str| {
        schema::check(&schema(name), &serde_json::from_str(text).expect("JSON"));
    };
    let cube = cuboid_grid(&[1, 1, 1]);
    check("model-1", &cube.to_json().expect("a model"));
    let scene = Struct::new("inner").with(("A", cube.clone())).with(t(&[1.0, 0.0, 0.0])).with(cube);
    let scene = Struct::new("outer").with(r([0.1, 0.0, 0.0])).with(scene);
    check("struct-1", &scene.to_json().expect("a hierarchy"));
    let place = Place::with_cubes();
    for (version, options) in [("1", ""), ("2", "--exact")] {
        let run = place.lar(&words(format!("arrange a.obj b.obj --complex c.json {options}").trim_end()));
        assert_eq!(run.code, 0, "{run:?}");
        check(&format!("chain-complex-{version}"), &place.read("c.json"));
    }
}

/// A view as `lar export-html` puts it into a page.
#[cfg(feature = "viewer")]
#[test]
fn views_are_what_their_schema_says() {
    use lar_viewer::session::{Session, Settings};
    use lar_viewer::{Answers, Camera, CellData, SharedView};
    let grid = lar_core::ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).expect("a grid");
    let session = Session::new(CellData::new(grid).expect("cells"));
    let plain: Settings = session.settings();
    let changed = Settings {
        outline: Some(lar_viewer::Outlined::Solids),
        section: lar_viewer::session::Section {
            normal: lar_viewer::session::Normal::Free { azimuth: 1.0, elevation: 0.5 },
            ..plain.section
        },
        ..plain.clone()
    };
    for settings in [plain, changed] {
        let session = session.clone().with_settings(settings);
        let view = SharedView {
            title: "grid".into(),
            session,
            camera: Camera::default(),
            is_fitted: true,
            answers: Answers::default(),
        };
        schema::check(
            &schema("view-1"),
            &serde_json::from_str(&view.to_json().expect("a view")).expect("JSON"),
        );
    }
}

/// Every format of the first table is read and written as it says.
#[test]
fn formats_are_read_and_written_as_documented() {
    let place = Place::with_cubes();
    let table = DOCUMENT.lines().skip_while(|line| !line.starts_with("| extension")).skip(2);
    let mut rows = 0;
    for line in table.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        for extension in cells[1].split(", ").map(|e| e.trim_matches('`').trim_start_matches('.')) {
            let is_planar = matches!(extension, "svg" | "seg");
            let source = if is_planar { "square.seg" } else { "a.obj" };
            place.write("square.seg", "0 0 1 0\n1 0 1 1\n1 1 0 1\n0 1 0 0\n");
            let file = format!("file.{extension}");
            let written = place.lar(&["convert", source, &file]);
            assert_eq!(written.code, 0, "{line}: {written:?}");
            let back = if is_planar { "back.seg" } else { "back.obj" };
            let read = place.lar(&["convert", &file, back]);
            assert_eq!(read.code, if cells[2] == "no" { 2 } else { 0 }, "{line}: {read:?}");
            rows += 1;
        }
    }
    assert_eq!(rows, 9);
}
