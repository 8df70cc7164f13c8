//! SVG drawings: every shape and command, tolerance, refusals, hostile text, and the way out.
#![cfg(feature = "svg")]

use lar_core::{
    ChainComplex, Drawing, Location, Points, cuboid_grid, locate_in_polygon, parse_svg, read_svg,
};
use proptest::prelude::*;
use std::path::PathBuf;

fn svg(content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n{content}\n</svg>"
    )
}

fn drawing(content: &str) -> Drawing {
    parse_svg(&svg(content), "a.svg", 0.01).unwrap()
}

/// Polylines as "x,y x,y …", ended by z when closed; y as in the file.
fn shown(drawing: &Drawing) -> Vec<String> {
    let point = |p: &[f64]| format!("{},{}", p[0], 0. - p[1]);
    let line = |points: &Points| points.iter().map(point).collect::<Vec<_>>().join(" ");
    drawing.polylines.iter().map(|p| line(&p.points) + if p.closed { " z" } else { "" }).collect()
}

#[track_caller]
fn check(content: &str, expected: &[&str]) {
    assert_eq!(shown(&drawing(content)), expected);
}

#[track_caller]
fn check_path(d: &str, expected: &[&str]) {
    check(&format!("<path d='{d}'/>"), expected);
}

#[test]
fn lines_of_paths() {
    check_path("M1 2L3 4", &["1,2 3,4"]);
    check_path("M1 2 3 4 5 6", &["1,2 3,4 5,6"]);
    check_path("m1 2 3 4 5 6z", &["1,2 4,6 9,12 z"]);
    check_path("M1,2H3h1V7v-1", &["1,2 3,2 4,2 4,7 4,6"]);
    check_path("M0 0 1 0 1 1 0 0z", &["0,0 1,0 1,1 z"]);
    check_path("M0 0h1v1z l0 5 1 5", &["0,0 1,0 1,1 z", "0,0 0,5 1,10"]);
    check_path("M2 3h1v1z m1 1 1 0 0 1z", &["2,3 3,3 3,4 z", "3,4 4,4 4,5 z"]);
    check_path("M1 1M2 2M3 3 4 4", &["3,3 4,4"]);
    check_path("M-.5.5-1e1+2", &["-0.5,0.5 -10,2"]);
    check_path("", &[]);
    check_path("M1 1z", &[]);
}

#[test]
fn shapes() {
    check("<rect x='1' y='2' width='3' height='4'/>", &["1,2 4,2 4,6 1,6 z"]);
    check("<rect width='3'/><circle cx='1'/><ellipse rx='0' ry='2'/>", &[]);
    check("<line x1='1' y1='2' x2='3' y2='4'/>", &["1,2 3,4"]);
    check("<polyline points='1,2 3,4, 5 6'/>", &["1,2 3,4 5,6"]);
    check("<polygon points='1 2 3 4 5 6'/>", &["1,2 3,4 5,6 z"]);
    check(
        "<line x2='1in' y2='2.54cm'/><line x2='25.4mm' y2='72pt'/><line x2='6pc' y2='96px'/>",
        &["0,0 96,96"; 3],
    );
    check("<text>M0 0</text><image href='x'/><defs><rect width='1' height='1'/></defs>", &[]);
    check(
        "<rect width='1' height='1' style='fill:red; display: none'/><g display='none'><line x2='1'/></g>",
        &[],
    );
    check("<line x2='1' display='none' style='display:inline'/>", &["0,0 1,0"]);
}

#[test]
fn groups_transforms_and_uses() {
    let group =
        |transform: &str| format!("<g transform='{transform}'><line x1='1' y1='2' x2='3' y2='4'/></g>");
    check(&group("translate(10) scale(2)"), &["12,4 16,8"]);
    check(&group("scale(2, 3)"), &["2,6 6,12"]);
    check(&group("matrix(0 1 -1 0 5 6)"), &["3,7 1,9"]);
    check(
        &group("rotate(180 1 1)").replace("rotate(180 1 1)", "translate(1 1) scale(-1) translate(-1 -1)"),
        &["1,0 -1,-2"],
    );
    check(
        "<g transform='translate(1 1)'><a><g transform='scale(2)'><line x2='1'/></g></a></g>",
        &["1,1 3,1"],
    );
    check(
        "<defs><line id='a' x2='1'/></defs><use href='#a' x='1' y='2'/><use xlink:href='#a'/>",
        &["1,2 2,2", "0,0 1,0"],
    );
    check("<symbol id='s'><line x2='1'/></symbol><use href='#s' transform='scale(2)' x='1'/>", &["2,0 4,0"]);
    check("<svg x='3' y='4'><line x2='1'/></svg>", &["3,4 4,4"]);
    let turned = drawing(&group("rotate(90)"));
    let p = turned.polylines[0].points.point(0);
    assert!((p[0] + 2.).abs() < 1e-15 && (p[1] + 1.).abs() < 1e-15);
}

#[test]
fn names() {
    let drawing = drawing("<g id='g'><line x2='1'/><path id='p' d='M0 0h1M0 1h1'/></g><line x2='1'/>");
    let named: Vec<_> = drawing.polylines.iter().map(|p| (p.id.as_deref(), p.shape)).collect();
    assert_eq!(named, [(Some("g"), 0), (Some("p"), 1), (Some("p"), 1), (None, 2)]);
}

#[test]
fn elements_with_a_name_and_their_shapes() {
    let drawing = drawing(
        "<g id='g'><line x2='1'/><g id='empty'><line id='point'/></g><g id='h'><line id='a' x2='1'/><line x2='2'/>\
         </g></g><line id='b' y2='1'/><use id='u' href='#h'/><defs id='d'><line x2='1'/></defs>",
    );
    let found: Vec<_> = drawing.named.iter().map(|n| (n.id.as_str(), n.shapes.clone())).collect();
    let expected = [("g", 0..4), ("empty", 1..2), ("point", 1..2), ("h", 2..4), ("a", 2..3), ("b", 4..5)];
    assert_eq!(found, [&expected[..], &[("u", 5..7), ("h", 5..7), ("a", 5..6)]].concat());
}

#[test]
fn fill_rules() {
    let drawing = drawing(
        "<g fill-rule='evenodd'><line x2='1'/><line x2='1' fill-rule='nonzero'/><rect width='1' height='1' \
         style='fill:red; fill-rule : nonzero' fill-rule='evenodd'/><g style='fill-rule:evenodd'><line y2='2'/>\
         </g></g><line x2='1' fill-rule='inherit'/>",
    );
    let found: Vec<bool> = drawing.polylines.iter().map(|p| p.even_odd).collect();
    assert_eq!(found, [true, false, false, true, false]);
}

/// All points of the polyline and all middles of its chords lie within `tolerance` of the curve f = 0, where
/// |f| is a distance.
#[track_caller]
fn check_near(content: &str, tolerance: f64, ends: [[f64; 2]; 2], distance: impl Fn(f64, f64) -> f64) {
    let drawing = parse_svg(&svg(content), "a.svg", tolerance).unwrap();
    let points: Vec<[f64; 2]> = drawing.polylines[0].points.iter().map(|p| [p[0], 0. - p[1]]).collect();
    assert_eq!([points[0], points[points.len() - 1]], ends);
    for w in points.windows(2) {
        let [x, y] = [0, 1].map(|k| (w[0][k] + w[1][k]) / 2.);
        assert!(distance(w[0][0], w[0][1]).abs() < 1e-9, "{:?}", w[0]);
        assert!(distance(x, y).abs() <= tolerance, "{w:?}");
    }
    let loose = parse_svg(&svg(content), "a.svg", 100. * tolerance).unwrap().polylines[0].points.len();
    assert!(loose < points.len() && points.len() < 30 * loose, "{} {loose}", points.len());
}

#[test]
fn curves_stay_within_the_tolerance() {
    let circle = |x: f64, y: f64| x.hypot(y) - 10.;
    for tolerance in [1e-1, 1e-3, 1e-5] {
        let path = |d: &str| format!("<path d='{d}'/>");
        let ends = [[10., 0.], [0., 10.]];
        check_near(&path("M10 0A10 10 0 0 1 0 10"), tolerance, ends, circle);
        check_near(&path("M10 0A10 10 45 1 0 0 10"), tolerance, ends, circle);
        check_near(&path("M10 0a1 1 0 0 1 -20 0"), tolerance, [[10., 0.], [-10., 0.]], circle);
        check_near(&path("M0 0Q10 0 20 20"), tolerance, [[0., 0.], [20., 20.]], |x, y| {
            (y - x * x / 20.) / 3.
        });
        check_near(
            &path("M0 0C0 0 20 0 20 0 Q30 0 40 20").replace(" Q30 0 40 20", "S40 0 40 0"),
            tolerance,
            [[0., 0.], [40., 0.]],
            |_, y| y,
        );
    }
}

#[test]
fn circles() {
    let drawing = drawing("<circle cx='5' cy='5' r='4'/><ellipse rx='2' ry='1' transform='scale(1 3)'/>");
    for (polyline, vertices) in drawing
        .polylines
        .iter()
        .zip([[[9., -5.], [5., -9.], [1., -5.], [5., -1.]], [[2., 0.], [0., -3.], [-2., 0.], [0., 3.]]])
    {
        let points: Vec<&[f64]> = polyline.points.iter().collect();
        assert!(polyline.closed && points.len().is_multiple_of(4));
        for (k, vertex) in vertices.iter().enumerate() {
            assert_eq!(points[k * points.len() / 4], vertex);
        }
    }
}

#[test]
fn rounded_rectangles() {
    let rounded = drawing("<rect width='10' height='6' rx='2'/>");
    let area = doubled_area(&rounded.polylines[0].points) / 2.;
    let exact = 60. - (4. - std::f64::consts::PI) * 4.;
    assert!(area < exact && area > exact - 0.2, "{area} {exact}");
    let capsule = drawing("<rect width='10' height='6' rx='99' ry='3'/>");
    assert!((doubled_area(&capsule.polylines[0].points) / 2. - std::f64::consts::PI * 15.).abs() < 0.2);
}

fn doubled_area(points: &Points) -> f64 {
    let p: Vec<&[f64]> = points.iter().collect();
    (0..p.len())
        .map(|i| (p[i], p[(i + 1) % p.len()]))
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum::<f64>()
        .abs()
}

#[test]
fn smooth_commands() {
    let smooth = |d: &str| shown(&drawing(&format!("<path d='{d}'/>")));
    assert_eq!(smooth("M0 0C0 5 5 5 5 0S10 -5 10 0"), smooth("M0 0C0 5 5 5 5 0C5 -5 10 -5 10 0"));
    assert_eq!(smooth("M0 0Q2 5 5 0t5 0 5 0"), smooth("M0 0Q2 5 5 0Q8 -5 10 0Q12 5 15 0"));
    assert_eq!(smooth("M0 0s5 5 5 0"), smooth("M0 0C0 0 5 5 5 0"));
    assert_eq!(smooth("M0 0T5 0"), smooth("M0 0Q0 0 5 0"));
    assert_eq!(smooth("M1 1c1 2 3 4 5 6q1 2 3 -4"), smooth("M1 1C2 3 4 5 6 7Q7 9 9 3"));
    assert_eq!(smooth("M0 0A0 5 0 0 1 3 4A5 5 0 0 1 3 4"), ["0,0 3,4 3,4"]);
}

#[test]
fn fixture() {
    let plan =
        read_svg(PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures/plan.svg")), 0.5).unwrap();
    let model = plan.to_model();
    assert_eq!(model.validate(), []);
    assert_eq!(
        (plan.polylines.len(), model.f_vector()),
        (7, vec![model.points().len(), model.cells(1).len()])
    );
    let room = |x: f64, y: f64| locate_in_polygon([x, -y], plan.loops());
    assert_eq!(room(15., 100.), Location::Inside);
    assert_eq!(room(30., 60.), Location::Outside);
    assert_eq!(room(50., 70.), Location::Inside);
    assert_eq!(room(10., 50.), Location::Boundary);
}

#[test]
fn models() {
    let model = drawing("<polygon points='0 0 2 0 2 0 2 2'/><line x2='2' y2='2'/>").to_model();
    assert_eq!(model.f_vector(), [3, 4]);
    assert_eq!(model.points().coords(), [0., 0., 2., 0., 2., -2.]);
}

#[track_caller]
fn check_refused(content: &str, expected: &str) {
    assert_eq!(parse_svg(&svg(content), "a.svg", 0.01).unwrap_err().to_string(), expected);
}

#[test]
fn refusals() {
    let attribute =
        |content: &str, expected: &str| check_refused(content, &format!("a.svg:2: attribute {expected}"));
    attribute("<path d='M0 0L1'/>", "d of path: \"M0 0L1\" where path data is needed");
    attribute("<path d='L1 1'/>", "d of path: \"L1 1\" where path data is needed");
    attribute("<g transform='skew(1)'/>", "transform of g: \"skew(1)\" where a list of transforms is needed");
    attribute(
        "<polygon points='1 2 3'/>",
        "points of polygon: \"1 2 3\" where a list of pairs of numbers is needed",
    );
    attribute(
        "<polygon points='1 2 x'/>",
        "points of polygon: \"1 2 x\" where a list of pairs of numbers is needed",
    );
    attribute(
        "<rect width='50%' height='1'/>",
        "width of rect: \"50%\" where a length in px, in, cm, mm, pt or pc is needed",
    );
    attribute("<circle r='-1'/>", "r of circle: \"-1\" where a length that is not negative is needed");
    check_refused(
        "<use href='#x'/>",
        "a.svg:2: a reference to what is not in the file is not supported: \"#x\"",
    );
    check_refused(
        "<g id='g'>\n<use href='#g'/></g>",
        "a.svg:3: nesting of references deeper than 32 is not supported: \"#g\"",
    );
    check_refused(
        "<svg viewBox='0 0 1 1'/>",
        "a.svg:2: viewBox of a nested element is not supported: \"0 0 1 1\"",
    );
    check_refused(
        "<g transform='scale(1e300)'><line x2='1e300'/></g>",
        "a.svg:2: line has a point at (inf, 0)",
    );
    let limit = 1_000_000 + 100 * svg("<circle r='1e15'/>").len();
    check_refused("<circle r='1e15'/>", &format!("a.svg:2: more than {limit} points at a tolerance of 0.01"));
    check_refused("<g>", "a.svg:3: expected 'g' tag, not 'svg' at 3:1");
    let refused = |text: &str, tolerance| parse_svg(text, "a.svg", tolerance).unwrap_err().to_string();
    assert_eq!(refused("<html/>", 1.), "a.svg: the outermost element is \"html\", not \"svg\"");
    assert_eq!(refused("<svg/>", 0.), "a tolerance of 0 where a positive number is needed");
    assert_eq!(refused("<svg/>", f64::NAN), "a tolerance of NaN where a positive number is needed");
    assert!(read_svg("/nonexistent.svg", 1.).unwrap_err().to_string().starts_with("cannot read"));
}

/// Each level uses the one below twice: 2^30 lines from 30.
#[test]
fn uses_that_copy_in_powers_are_refused() {
    let levels: String =
        (1..31).map(|i| format!("<g id='g{i}'><use href='#g{0}'/><use href='#g{0}'/></g>", i - 1)).collect();
    let content = format!("<defs><line id='g0' x2='1'/>{levels}</defs><use href='#g30'/>");
    let refused = parse_svg(&svg(&content), "a.svg", 1.).unwrap_err().to_string();
    assert!(
        refused.contains("elements at a tolerance of 1") || refused.contains("points at a tolerance"),
        "{refused}"
    );
}

#[test]
fn entities() {
    let document = |n: usize| {
        format!("<!DOCTYPE svg [<!ENTITY a \"{}\">]><svg>{}</svg>", "x".repeat(1000), "&a;".repeat(n))
    };
    assert!(parse_svg(&document(10), "a.svg", 1.).is_ok());
    let refused = parse_svg(&document(1000), "a.svg", 1.).unwrap_err().to_string();
    assert!(
        refused.starts_with("a.svg:1: so much use of entities is not supported: \"1000 references"),
        "{refused}"
    );
}

#[test]
fn deep_nesting_is_read() {
    let content = format!("{}<line x2='1'/>{}", "<g>".repeat(20_000), "</g>".repeat(20_000));
    check(&content, &["0,0 1,0"]);
}

#[test]
fn complexes_out() {
    let grid = ChainComplex::from_model(&cuboid_grid(&[2, 2])).unwrap();
    let text = grid.to_svg().unwrap();
    insta::assert_snapshot!(text);
    let back = parse_svg(&text, "a.svg", 1.).unwrap();
    let edges = Drawing {
        polylines: back.polylines.into_iter().filter(|p| p.id.as_deref() == Some("edges")).collect(),
        named: Vec::new(),
    };
    let model = edges.to_model();
    assert_eq!(model.f_vector(), [9, 12]);
    assert_eq!(model.points().bounds(), grid.points().bounds());
    let dir = tempfile::tempdir().unwrap();
    grid.write_svg(dir.path().join("a.svg")).unwrap();
    assert_eq!(std::fs::read_to_string(dir.path().join("a.svg")).unwrap(), text);
    let line = ChainComplex::from_model(&cuboid_grid(&[2])).unwrap();
    let message = "a complex of dimension 1 with points of 1 coordinates where 1 or 2 and 2 are needed";
    assert_eq!(line.to_svg().unwrap_err().to_string(), message);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_path_panics(d in "([MmLlHhVvCcSsQqTtAaZz]|-?[0-9]{1,3}(\\.[0-9]{1,2})?(e-?[0-9]{1,3})?|[ ,]|[01]){0,40}") {
        if let Ok(drawing) = parse_svg(&svg(&format!("<path d='M0 0{d}'/>")), "a.svg", 1.) {
            prop_assert!(drawing.polylines.iter().all(|p| p.points.non_finite().count() == 0));
        }
    }

    #[test]
    fn no_document_panics(content in "(<|/>|>|</|g|path|rect|use|svg| d=| id='a'| href='#a'| width='1'|'|\"|&|;|é|-->|<!--|\n){0,60}") {
        let _ = parse_svg(&svg(&content), "a.svg", 1.);
        let _ = parse_svg(&content, "a.svg", 1.);
    }

    #[test]
    fn mutated_files_do_not_panic(at in any::<prop::sample::Index>(), c in any::<char>(), cut in any::<prop::sample::Index>()) {
        let text = include_str!("../../fixtures/plan.svg");
        let mut chars: Vec<char> = text.chars().collect();
        let at = at.index(chars.len());
        chars[at] = c;
        let _ = parse_svg(&chars.iter().collect::<String>(), "a.svg", 1.);
        // Without its last line break the file is still whole.
        let cut: String = chars.iter().take(cut.index(text.trim_end().chars().count())).collect();
        prop_assert!(parse_svg(&cut, "a.svg", 1.).is_err());
    }
}
