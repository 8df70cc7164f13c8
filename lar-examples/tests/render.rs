//! `lar render`: every option changes the picture, the same options give the same bytes.
#![cfg(feature = "viewer")]
mod support;

use support::{Place, differing, read_png};

/// Draws the three cubes; the file's bytes.
#[track_caller]
fn drawn(place: &Place, inputs: &str, output: &str, options: &str) -> Vec<u8> {
    let line = format!("render {inputs} -o {output} --size 160x120 {options}");
    let run = place.lar(&line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(run.code, 0, "{options}: {run:?}");
    std::fs::read(place.path(output)).unwrap()
}

const CUBES: &str = "a.obj b.obj c.obj";

fn has_adapter() -> bool {
    let found = lar_viewer::OffscreenRenderer::new().is_ok();
    assert!(found || std::env::var_os("LAR_REQUIRE_GPU").is_none(), "no adapter");
    found
}

/// Options and how many pixels they change at least, against the picture without them.
const OPTIONS: [(&str, usize); 32] = [
    ("--view top", 1000),
    ("--azimuth 30 --elevation 10", 1000),
    ("--eye 5,4,3 --target 0,0,0.5 --up 0,1,0", 1000),
    ("--eye 5,4,3 --target 0.5,0.5,0", 1000),
    ("--ortho", 200),
    ("--ortho=9", 1000),
    ("--fov 70", 200),
    ("--explode 1.5,1,1", 500),
    ("--explode 1.5 --by solids", 500),
    ("--explode 1.5 --by faces", 500),
    ("--levels 1,1,1,1.5", 500),
    ("--explode 1.5 --about origin", 500),
    ("--draw vertices,edges,cells", 50),
    ("--draw cells", 100),
    ("--numbers cells,vertices", 100),
    ("--color class", 500),
    ("--color size", 500),
    ("--exterior translucent", 300),
    ("--outline cells", 100),
    ("--clip z=0.5", 500),
    ("--clip 1,1,0,0.5 --whole-cells", 500),
    ("--background #102030", 5000),
    ("--hide c7,c1", 500),
    ("--alpha-of A=0.2,C=0", 500),
    ("--only c3", 1000),
    ("--only f5,e2", 1000),
    ("--select c1", 500),
    ("--boundary c3", 500),
    ("--coboundary e7", 500),
    ("--where A&!B", 500),
    ("--wrapping c3", 500),
    ("--measure v0,v5,v9", 50),
];

#[test]
fn every_option_changes_the_picture() {
    if !has_adapter() {
        return;
    }
    let place = Place::with_cubes();
    let plain = drawn(&place, CUBES, "plain.png", "");
    let (_, expected) = read_png(&place.path("plain.png"));
    for (options, least) in OPTIONS {
        drawn(&place, CUBES, "out.png", options);
        let (size, pixels) = read_png(&place.path("out.png"));
        assert_eq!(size, [160, 120]);
        let changed = differing(&pixels, &expected);
        assert!(least <= changed, "{options}: {changed} pixels differ");
    }
    assert!(drawn(&place, CUBES, "again.png", "") == plain, "the same bytes again");
    let options = "--explode 2 --color size --numbers cells --alpha 0.4 --background transparent";
    let first = drawn(&place, CUBES, "first.png", options);
    assert!(drawn(&place, CUBES, "second.png", options) == first, "and with all that is transparent");
    let (_, pixels) = read_png(&place.path("first.png"));
    assert_eq!(pixels[..4], [0; 4], "transparent corner");
}

/// Lines of an SVG that are seen: all without faces, fewer behind opaque ones.
#[test]
fn svg_needs_no_adapter_and_hides_lines() {
    let place = Place::with_cubes();
    let count = |options: &str| {
        let bytes = drawn(&place, CUBES, "out.svg", options);
        String::from_utf8(bytes).unwrap().matches('M').count()
    };
    let [through, seen] = ["--alpha 0.2 --explode 1.5 --lines", "--alpha 1 --explode 1.5 --lines"].map(count);
    assert!(30 < seen && seen < through, "{seen} of {through}");
    let filled = drawn(&place, CUBES, "filled.svg", "--explode 1.5 --alpha 0.5 --color size --outline cells");
    let filled = String::from_utf8(filled).unwrap();
    let faces = filled.matches("opacity=\"0.5\" d=\"M").count();
    assert_eq!(faces, 75, "the faces of seven cells apart, those between two of them twice");
    let without =
        String::from_utf8(drawn(&place, CUBES, "plain.svg", "--explode 1.5 --alpha 0.5 --outline cells"))
            .unwrap();
    let paths = |text: &str| text.matches("<path").count();
    assert!(64 <= paths(&filled) - paths(&without), "the legend has 64 colours");
    assert!(filled.contains("stroke-width=\"4\""), "outlines");
    let bytes = drawn(&place, CUBES, "a.svg", "--explode 1.5");
    assert!(drawn(&place, CUBES, "b.svg", "--explode 1.5") == bytes);
}

#[test]
fn drawings_of_the_plane_are_rendered_too() {
    let place = Place::with_cubes();
    std::fs::write(place.path("cross.seg"), "0 0 2 0\n2 0 2 2\n2 2 0 2\n0 2 0 0\n1 -1 1 3\n").unwrap();
    let svg = String::from_utf8(drawn(&place, "cross.seg", "out.svg", "--view top --ortho --lines")).unwrap();
    assert_eq!(svg.matches('M').count(), 10, "one is the background, nine are edges: {svg}");
    if has_adapter() {
        drawn(&place, "cross.seg", "out.png", "--view top --ortho --alpha 1 --numbers faces");
        let (_, pixels) = read_png(&place.path("out.png"));
        let red = pixels.chunks_exact(4).filter(|p| 200 < p[0] && p[1] < 120).count();
        assert!(1000 < red, "the first face is red: {red} pixels");
    }
}

/// The pictures of a replay differ, the last is the default; what is measured is told.
#[test]
fn what_stands_out_in_the_window_does_in_a_picture() {
    let place = Place::with_cubes();
    let wrapped = |picture: &str| drawn(&place, CUBES, "out.svg", &format!("--wrapping c3{picture}"));
    let pictures = [":0", ":1", ":2", ""].map(wrapped);
    assert!((0..4).all(|i| (0..i).all(|k| pictures[i] != pictures[k])), "four pictures");
    assert!(wrapped(":99") == pictures[3], "the last one");
    let line = "render a.obj -o out.svg --measure v0,v1,v3";
    let run = place.lar(&line.split(' ').collect::<Vec<_>>());
    let told: Vec<&str> = run.out.lines().skip(1).filter_map(|line| line.split(' ').next()).collect();
    assert_eq!((run.code, told), (0, vec!["distance", "distance", "angle"]), "{run:?}");
}

#[test]
fn what_is_no_camera_or_plane_is_refused() {
    let place = Place::with_cubes();
    for (options, said) in [
        ("--view above", "a view is front, back"),
        ("--eye 1,2 --target 0,0,0", "three numbers"),
        ("--target 0,0,0", "--eye"),
        ("--view top --azimuth 3", "cannot be used with"),
        ("--eye 0,0,1 --target 0,0,0", "parallel to the line of sight"),
        ("--eye 1,1,1 --target 1,1,1", "distance from eye to target is 0"),
        ("--ortho=-2", "camera distance"),
        ("--clip w=3", "a clip plane is"),
        ("--whole-cells", "--clip"),
        ("--background mauve", "a background is"),
        ("--levels 1,2", "solids, cells, faces, edges"),
        ("--numbers corners", "vertices, edges, faces, cells"),
        ("--alpha-of Z=0.5", "no input is named Z"),
        ("--alpha-of A", "an input and its opacity"),
        ("--only c9", "there is no c9; there are 2 of that dimension"),
        ("--boundary x1", "names no cell"),
        ("--where A+B", "expected an operator"),
        ("--wrapping f1", "f1 is no cell of space"),
        ("--wrapping c1:x", "no number of a picture"),
        ("--measure c1,v1", "c1 is no vertex"),
        ("--measure v1", "two or three vertices are measured, not 1"),
        ("--boundary c1 --wrapping c1", "cannot be used with"),
    ] {
        let line = format!("render a.obj -o out.svg {options}");
        let run = place.lar(&line.split_whitespace().collect::<Vec<_>>());
        assert_eq!((run.code, run.err.lines().count()), (2, 1), "{options}: {run:?}");
        assert!(run.err.contains(said), "{options}: {}", run.err);
    }
    let run = place.lar(&["render", "a.obj", "-o", "out.gif"]);
    assert_eq!(run.err, "lar: out.gif: pictures are .svg or .png files\n");
}
