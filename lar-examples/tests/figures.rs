//! The panels of Figure 6, compared with committed pictures, and the commands that draw.
#![cfg(feature = "viewer")]
#![expect(clippy::print_stderr, reason = "a test that cannot run for want of an adapter says so")]

mod support;

use lar_examples::figures::{self, Request};
use lar_examples::scenes;
use lar_viewer::{Image, OffscreenRenderer, ViewerError};
use std::path::{Path, PathBuf};
use support::{Place, differing, read_png};

const SIZE: [u32; 2] = [320, 200];

/// The renderer, or `None` with a message when this machine has no adapter. With `LAR_REQUIRE_GPU=1`, as in CI, a
/// missing adapter fails the test.
fn renderer() -> Option<OffscreenRenderer> {
    match OffscreenRenderer::new() {
        Ok(renderer) => Some(renderer),
        Err(ViewerError::NoAdapter { found }) if std::env::var_os("LAR_REQUIRE_GPU").is_none() => {
            eprintln!("NOT TESTED: no graphics adapter ({found}); LAR_REQUIRE_GPU=1 makes this an error");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

fn committed(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/pictures/{name}.png"))
}

/// Compares with the committed picture: at most one pixel in a thousand may differ by more than 8 of 255, which is
/// what other processors and drivers need. `LAR_UPDATE_PICTURES=1` writes the picture.
#[track_caller]
fn check_picture(name: &str, image: &Image) {
    let actual = std::env::temp_dir().join(format!("lar-examples-{name}-actual.png"));
    image.write_png(&actual).unwrap();
    check_file(name, &actual);
    std::fs::remove_file(&actual).unwrap();
}

/// The same for a PNG file.
#[track_caller]
fn check_file(name: &str, actual: &Path) {
    let path = committed(name);
    if std::env::var_os("LAR_UPDATE_PICTURES").is_some() {
        std::fs::copy(actual, &path).unwrap();
    }
    let (size, pixels) = read_png(actual);
    let (expected_size, expected) = read_png(&path);
    assert_eq!(size, expected_size, "size of {name}");
    let (differing, allowed) = (differing(&pixels, &expected), expected.len() / 4 / 1000);
    assert!(
        differing <= allowed,
        "{name}: {differing} pixels differ, {allowed} may; see {}",
        actual.display()
    );
}

#[test]
fn panels_of_the_three_cubes() {
    let Some(mut renderer) = renderer() else { return };
    let surfaces = scenes::surfaces(&scenes::three_cubes()).unwrap();
    let arrangement = lar_arrangement::arrange(&surfaces).unwrap();
    for figure in figures::panels(&arrangement, &surfaces, SIZE).unwrap() {
        let image = renderer.render(&figure.scene, &figure.view, SIZE[0], SIZE[1]).unwrap();
        check_picture(&figure.name, &image);
    }
}

/// Every figure of the collection that has no test of its own, small: names, and sizes in which each panel can still be
/// read.
const SMALL: [(&str, [u32; 2]); 10] = [
    ("figure1", [500, 400]),
    ("figure2", [480, 240]),
    ("figure3", [480, 240]),
    ("refectory", [360, 210]),
    ("cube_grids", [300, 240]),
    ("numbered_grid", [360, 252]),
    ("mapper", [300, 300]),
    ("simplicial_grids", [360, 240]),
    ("products", [360, 240]),
    // The rods have as many edges as pixels when they are smaller.
    ("rods", [450, 300]),
];

/// Largest file of a committed picture in bytes.
const LARGEST: u64 = 60_000;

#[test]
fn the_collection() {
    let tested_elsewhere = ["figure4", "figure5", "figure6", "floor_plan"];
    let names = || figures::COLLECTION.iter().map(|entry| entry.name);
    let small: Vec<&str> = SMALL.iter().map(|(name, _)| *name).collect();
    let rest: Vec<&str> = names().filter(|name| !tested_elsewhere.contains(name)).collect();
    assert_eq!(rest, small);
    let Some(mut renderer) = renderer() else { return };
    let mut numbers = String::new();
    for entry in figures::COLLECTION {
        let size = SMALL.iter().find(|(name, _)| *name == entry.name).map(|(_, size)| *size);
        let request = Request { size, small: true, ..Request::default() };
        let drawn = entry.draw(&request).unwrap();
        numbers.push_str(&format!("{}: {}\n{}\n", entry.name, entry.title, drawn.numbers));
        for figure in drawn.figures.iter().filter(|_| size.is_some()) {
            let image = renderer.render(&figure.scene, &figure.view, figure.size[0], figure.size[1]).unwrap();
            check_picture(&figure.name, &image);
        }
    }
    insta::assert_snapshot!(numbers);
    for file in std::fs::read_dir(committed("x").parent().unwrap()).unwrap() {
        let file = file.unwrap();
        assert!(file.metadata().unwrap().len() < LARGEST, "{}", file.path().display());
    }
}

/// Each figure has a page with its pictures, a short program, and the numbers that it prints.
#[test]
fn pages() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/figures");
    let index = std::fs::read_to_string(docs.join("README.md")).unwrap();
    for entry in figures::COLLECTION {
        let name = entry.name;
        let page = std::fs::read_to_string(docs.join(format!("{name}.md"))).unwrap();
        let drawn = entry.draw(&Request::default()).unwrap();
        assert!(page.contains(&format!("```text\n{}```\n", drawn.numbers)), "{name}: {}", drawn.numbers);
        let program =
            page.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap_or_default();
        assert!((10..=30).contains(&program.lines().count()), "{name} has a program of 10 to 30 lines");
        assert!(index.contains(&format!("({name}.md)")), "{name} in the index");
        for figure in drawn.figures {
            let file = format!("{}.png", figure.name);
            assert!(page.contains(&format!("({file})")) && docs.join(&file).exists(), "{file}");
        }
    }
}

#[test]
fn figures_writes_what_it_is_asked_for() {
    if renderer().is_none() {
        return;
    }
    let place = Place::new();
    let figures = env!("CARGO_BIN_EXE_figures");
    let args = [
        "--only",
        "figure5",
        "--only",
        "numbered_grid",
        "--small",
        "--out",
        "new/pictures",
        "--size",
        "200x200",
    ];
    let run = place.program(figures, &args);
    assert_eq!(run.code, 0, "{run:?}");
    let names: Vec<String> =
        place.files().iter().skip(2).map(|p| p.file_name().unwrap().to_string_lossy().into_owned()).collect();
    let panels = ["a", "b", "c"].map(|p| ["png", "svg"].map(|e| format!("figure5{p}.{e}"))).concat();
    assert_eq!(names, [panels, vec!["numbered_grid.png".to_owned()]].concat());
    check_file("figure5b", &place.path("new/pictures/figure5b.png"));
    let again = place.program(env!("CARGO_BIN_EXE_figure2"), &["--seed", "7"]);
    assert_eq!(again.code, 0, "{again:?}");
    let other = place.program(figures, &["--only", "figure2"]);
    assert_ne!(again.out, other.out, "another seed is another arrangement");
    let refused = place.program(figures, &["--only", "figure7"]);
    assert_eq!((refused.code, refused.out.as_str(), refused.err.lines().count()), (2, "", 1), "{refused:?}");
}

/// A program's panels on 200 × 200 pixels: the PNGs are the committed pictures, and the SVGs have a path for each face.
#[track_caller]
fn check_panels(program: &str, args: &[&str], names: &[&str]) {
    let has_adapter = renderer().is_some();
    let place = Place::new();
    let all = [args, &["--out", "new/pictures", "--size", "200x200"]].concat();
    let run = place.program(program, &all);
    assert_eq!(run.code, if has_adapter { 0 } else { 3 }, "{run:?}");
    for name in names {
        let svg = place.read(&format!("new/pictures/{name}.svg"));
        assert!(lar_core::parse_svg(&svg, name, 1.0).is_ok_and(|d| d.named.len() > 3), "{name}");
        if has_adapter {
            check_file(name, &place.path(&format!("new/pictures/{name}.png")));
        }
    }
}

#[test]
fn panels_of_the_planar_figures() {
    let few = ["--shapes", "7"];
    check_panels(env!("CARGO_BIN_EXE_figure4"), &few, &["figure4a", "figure4b", "figure4c", "figure4d"]);
    let some = ["--shapes", "20"];
    check_panels(env!("CARGO_BIN_EXE_figure5"), &some, &["figure5a", "figure5b", "figure5c"]);
    let plan = support::fixture("apartment.svg");
    check_panels(env!("CARGO_BIN_EXE_floor_plan"), &[plan.to_str().unwrap()], &["floor_plan"]);
}

#[test]
fn pictures_of_the_plane_have_the_colors_of_the_svg() {
    if renderer().is_none() {
        return;
    }
    let place = Place::new();
    place.write("a.seg", "0 0 8 0\n8 0 8 5\n8 5 0 5\n0 5 0 0\n4 0 4 5\n");
    for output in ["out.svg", "out.png"] {
        let run = place.lar(&["plane", "a.seg", "-o", output, "--size", "160x100"]);
        assert_eq!(run.code, 0, "{run:?}");
    }
    let ([width, height], pixels) = read_png(&place.path("out.png"));
    assert_eq!([width, height], [160, 100]);
    let svg = place.read("out.svg");
    for x in [40, 120] {
        let at = 4 * (50 * 160 + x);
        let [r, g, b] = [0, 1, 2].map(|k| pixels[at + k]);
        let color = format!("fill=\"#{r:02x}{g:02x}{b:02x}\"");
        assert!(svg.contains(&color), "{color} in {svg}");
    }
}

#[test]
fn three_cubes_writes_the_panels() {
    if renderer().is_none() {
        return;
    }
    let place = Place::new();
    let run = place.three_cubes(&["--out", "new/pictures", "--size", "320x200"]);
    assert_eq!(run.code, 0, "{run:?}");
    for panel in ["a", "b", "c", "d"] {
        let name = format!("figure6{panel}");
        let (size, pixels) = read_png(&place.path(&format!("new/pictures/{name}.png")));
        let (_, expected) = read_png(&committed(&name));
        assert_eq!(size, SIZE);
        assert!(differing(&pixels, &expected) <= expected.len() / 4 / 1000, "{name}");
    }
}

/// Draws the three cubes by the command, and returns the picture's size and pixels.
#[track_caller]
fn rendered(options: &str) -> ([u32; 2], Vec<u8>) {
    let place = Place::with_cubes();
    let line = format!("render a.obj b.obj c.obj -o out.png {options}");
    let run = place.lar(&line.split(' ').collect::<Vec<_>>());
    assert_eq!(run.code, 0, "{run:?}");
    read_png(&place.path("out.png"))
}

#[test]
fn render_has_options_that_matter() {
    if renderer().is_none() {
        return;
    }
    let options = ["", " --explode 2", " --explode 2,1,1", " --alpha 0.2", " --explode 2 --cells all"];
    let pictures = options.map(|o| rendered(&format!("--size 160x120{o}")));
    for (i, (size, a)) in pictures.iter().enumerate() {
        assert_eq!(*size, [160, 120]);
        for (j, (_, b)) in pictures.iter().enumerate().skip(i + 1) {
            let apart = differing(a, b);
            assert!(500 < apart, "{:?} and {:?} differ in {apart} pixels", options[i], options[j]);
        }
    }
    assert_eq!(rendered("--size 160x120"), pictures[0], "the same picture again");
    assert_eq!(rendered("--size 160x120 --cells all"), pictures[0], "all cells of the three cubes are solid");
}

/// A Vulkan and OpenGL loader that find no driver.
fn without_adapter(program: &str) -> std::process::Command {
    let mut command = std::process::Command::new(program);
    for (name, value) in [
        ("WGPU_BACKEND", "vulkan"),
        ("VK_ICD_FILENAMES", "/nonexistent"),
        ("VK_DRIVER_FILES", "/nonexistent"),
    ] {
        command.env(name, value);
    }
    command
}

#[test]
#[cfg(target_os = "linux")]
fn without_an_adapter_the_numbers_are_printed_all_the_same() {
    let place = Place::with_cubes();
    let run = place.run(without_adapter(env!("CARGO_BIN_EXE_three_cubes")).args(["--out", "pictures"]));
    assert_eq!(run.code, 3, "{run:?}");
    assert!(run.out.contains("49 vertices") && run.out.contains("2.484154"), "{}", run.out);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(run.err.contains("mesa-vulkan-drivers"), "{}", run.err);
    let run = place.run(without_adapter(env!("CARGO_BIN_EXE_figure5")).args(["--out", "pictures"]));
    assert_eq!((run.code, run.err.lines().count()), (3, 1), "{run:?}");
    let written =
        ["figure5a.svg", "figure5b.svg", "figure5c.svg"].map(|name| place.path("pictures").join(name));
    assert!(written.iter().all(|path| path.exists()), "{:?}", place.files());
    place.write("a.seg", "0 0 1 0\n1 0 0 1\n0 1 0 0\n");
    let before = place.files();
    let run =
        place.run(without_adapter(env!("CARGO_BIN_EXE_lar")).args(["render", "a.obj", "-o", "out.png"]));
    assert_eq!((run.code, run.out.as_str(), run.err.lines().count()), (3, "", 1), "{run:?}");
    let drawn = ["plane", "a.seg", "-o", "out.png", "--json", "out.json"];
    let run = place.run(without_adapter(env!("CARGO_BIN_EXE_lar")).args(drawn));
    assert_eq!((run.code, run.out.as_str(), run.err.lines().count()), (3, "", 1), "{run:?}");
    assert_eq!(place.files(), before);
}

#[test]
#[cfg(all(target_os = "linux", feature = "window"))]
fn without_a_display_no_window_opens() {
    let place = Place::with_cubes();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lar"));
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    let run = place.run(command.args(["view", "a.obj"]));
    assert_eq!((run.code, run.out.as_str()), (3, ""), "{run:?}");
    let message = "lar: no display to open a window on: neither ";
    assert!(run.err.starts_with(message) && run.err.lines().count() == 1, "{}", run.err);
}
