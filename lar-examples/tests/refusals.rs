//! What `lar` and `three_cubes` refuse: exit code 2, one line on the error stream, nothing written.
#![cfg(feature = "window")]

mod support;

use support::Place;

/// A tetrahedron, outward.
const SOLID: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Files that all runs find in their directory.
fn place() -> Place {
    let place = Place::new();
    place.write("solid.obj", SOLID);
    place.write("other.obj", SOLID.replace("v 0 0 0", "v 0.1 0.2 0.3"));
    place.write("empty.obj", "");
    place.write("cut.obj", &SOLID[..SOLID.len() - 30]);
    place.write("cut_vertex.obj", "v 0 0 0\nv 1 0 0\nv 0 1");
    place.write("range.obj", SOLID.replace("f 2 3 4", "f 2 3 5"));
    place.write("zero.obj", SOLID.replace("f 2 3 4", "f 0 3 4"));
    place.write("nan.obj", SOLID.replace("v 0 1 0", "v 0 NaN 0"));
    place.write("huge.obj", SOLID.replace("v 0 1 0", "v 0 1e999 0"));
    place.write("word.obj", SOLID.replace("v 0 1 0", "v 0 one 0"));
    place.write("two.obj", SOLID.replace("f 2 3 4", "f 2 3"));
    place.write("open.obj", SOLID.replace("f 2 3 4\n", ""));
    place.write("turned.obj", SOLID.replace("f 2 3 4", "f 2 4 3"));
    place.write("binary.obj", b"v 0 0 0\n\xff\xfe\n");
    place.write("complex.json", "{\"format\": \"lar-chain-complex\", \"version\": 9}");
    std::fs::create_dir_all(place.path("full/inner")).unwrap();
    place
}

/// One line: the arguments, then what the program says.
fn refused(place: &Place, line: &str) -> String {
    let args: Vec<&str> = line.split('\u{20}').map(|a| if a == "\"\"" { "" } else { a }).collect();
    let run = place.lar(&args);
    assert_eq!(run.code, 2, "{line}: {run:?}");
    assert_eq!(run.err.lines().count(), 1, "{line}: {run:?}");
    assert!(run.err.starts_with("lar: ") && run.err.ends_with('\n'), "{line}: {run:?}");
    assert_eq!(run.out, "", "{line}");
    format!("$ lar {line}\n{}", run.err)
}

/// All lines are refused, and nothing is written.
#[track_caller]
fn check(lines: &[&str]) -> String {
    let place = place();
    let before = place.files();
    let said: Vec<String> = lines.iter().map(|line| refused(&place, line)).collect();
    assert_eq!(place.files(), before, "nothing is written");
    said.concat()
}

#[test]
fn malformed_files() {
    let names = [
        "missing",
        "empty",
        "cut",
        "cut_vertex",
        "range",
        "zero",
        "nan",
        "huge",
        "word",
        "two",
        "binary",
        "full",
    ];
    let mut said = String::new();
    for name in names {
        let file = if name == "full" { name.to_owned() } else { format!("{name}.obj") };
        let arrange = format!("arrange {file} --json out.json --obj out --complex out.complex");
        let commands = [
            format!("info {file}"),
            arrange,
            format!("boolean A|B {file} solid.obj -o out.obj --json out.json"),
            format!("render solid.obj {file} -o out.png"),
            format!("view {file}"),
        ];
        let lines: Vec<&str> = commands.iter().map(String::as_str).collect();
        let messages = check(&lines);
        let errors: Vec<&str> = messages.lines().filter(|l| l.starts_with("lar: ")).collect();
        assert!(errors.iter().all(|e| *e == errors[0]), "each command says the same: {messages}");
        said.push_str(&format!("{file}\n  {}\n", errors[0]));
    }
    insta::assert_snapshot!(said);
}

#[test]
fn operands() {
    insta::assert_snapshot!(check(&[
        "boolean A-B solid.obj open.obj -o out.obj",
        "boolean !cup cup=open.obj -o out.obj",
        "boolean A-B solid.obj open.obj -o out.obj --fill even-odd",
        "boolean A|B turned.obj solid.obj -o out.obj",
        "boolean A|B solid.obj complex.json -o out.obj",
        "boolean x|x x=solid.obj x=other.obj -o out.obj",
        "arrange B=solid.obj other.obj",
        "info complex.json",
        "info missing.json",
    ]));
}

#[test]
fn expressions() {
    insta::assert_snapshot!(check(&[
        "boolean A|C solid.obj other.obj -o out.obj",
        "boolean a solid.obj -o out.obj",
        "boolean \"\" solid.obj -o out.obj",
        "boolean A| solid.obj -o out.obj",
        "boolean (A solid.obj -o out.obj",
        "boolean A) solid.obj -o out.obj",
        "boolean A+A solid.obj -o out.obj",
        "boolean |A solid.obj -o out.obj",
        "boolean AA solid.obj -o out.obj",
    ]));
}

#[test]
fn outputs() {
    insta::assert_snapshot!(check(&[
        "arrange solid.obj --json no/such/out.json",
        "arrange solid.obj --json full",
        "arrange solid.obj --json solid.obj/out.json",
        "arrange solid.obj --complex no/out.json --json out.json",
        "arrange solid.obj --obj full",
        "arrange solid.obj --obj solid.obj",
        "arrange solid.obj --obj no/such --json out.json",
        "boolean A solid.obj -o no/out.obj --json out.json",
        "boolean A solid.obj -o out.obj --json no/out.json",
        "boolean A solid.obj -o full",
        "boolean A solid.obj -o out.obj --json ./out.obj",
        "arrange solid.obj --json out --obj out",
        "render solid.obj -o no/out.png",
        "render solid.obj -o full",
        "render solid.obj -o \"\"",
    ]));
}

#[test]
fn options() {
    insta::assert_snapshot!(check(&[
        "\"\"",
        "cut solid.obj",
        "arrange",
        "arrange solid.obj --threads 0",
        "arrange solid.obj --threads many",
        "arrange solid.obj --threads -1",
        "arrange solid.obj --colour red",
        "boolean A solid.obj",
        "boolean A -o out.obj",
        "boolean A solid.obj -o out.obj --fill odd",
        "render solid.obj",
        "render solid.obj -o out.png --size 0x5",
        "render solid.obj -o out.png --size 640",
        "render solid.obj -o out.png --explode NaN",
        "render solid.obj -o out.png --explode 1,2",
        "render solid.obj -o out.png --alpha 1.5",
        "render solid.obj -o out.png --alpha -0.5",
        "render solid.obj -o out.png --cells some",
        "info",
        "info solid.obj other.obj",
    ]));
}

/// The commands that came later.
#[test]
fn newer_commands() {
    insta::assert_snapshot!(check(&[
        "measure",
        "measure open.obj --density 0",
        "measure solid.obj --density B=2",
        "measure cut.obj",
        "validate missing.obj",
        "validate complex.json",
        "clean open.obj -o out.obj",
        "clean open.obj -o out.obj --rule nonzero",
        "clean turned.obj -o out.obj --rule positive",
        "clean solid.obj -o full",
        "clean solid.obj -o out.obj --rule best",
        "convert solid.obj",
        "convert solid.obj out.step",
        "convert solid.obj out.svg",
        "convert solid.obj no/out.stl",
        "convert solid.obj solid.obj/out.stl",
        "convert missing.json out.obj",
        "convert complex.json out.obj",
        "convert solid.glb out.obj",
        "boolean -e A solid.obj -o out",
        "boolean -e ../x=A solid.obj -o out",
        "boolean -e x=A+ solid.obj -o out",
        "boolean -e x=A solid.obj -o full",
        "boolean A solid.obj -o out.obj --format stl",
        "completions tcsh",
        "man --out full",
    ]));
}

#[test]
fn line_breaks_in_names_stay_in_one_line() {
    let run = place().lar(&["info", "no\nsuch\r.obj"]);
    assert_eq!((run.code, run.err.lines().count()), (2, 1), "{run:?}");
}

#[test]
fn three_cubes() {
    let place = place();
    let before = place.files();
    let said: Vec<String> = ["--size 5", "--out", "--frames 3", "now"]
        .iter()
        .map(|line| {
            let run = place.three_cubes(&line.split(' ').collect::<Vec<_>>());
            assert_eq!((run.code, run.err.lines().count(), run.out.as_str()), (2, 1, ""), "{run:?}");
            format!("$ three_cubes {line}\n{}", run.err)
        })
        .collect();
    assert_eq!(place.files(), before);
    insta::assert_snapshot!(said.concat());
}
