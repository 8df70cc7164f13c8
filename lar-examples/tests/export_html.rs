//! `lar export-html`: what is put into a page, and that nothing is missing from it. That browsers show it is tried by
//! `lar-viewer/web/browser/test.sh`.
#![cfg(feature = "viewer")]

mod support;

use base64::{Engine, prelude::BASE64_STANDARD};
use lar_core::ChainComplex;
use lar_viewer::session::{ColorBy, Normal};
use lar_viewer::{Projection, SharedView, StandardView};
use std::io::Read;
use support::{Place, fixture, viewer_page};

/// The three cubes, and a viewer.
fn place() -> Place {
    let place = Place::with_cubes();
    place.write("viewer.html", viewer_page());
    place
}

fn exported(place: &Place, arguments: &str) -> String {
    let line = format!("export-html {arguments} -o page.html --viewer viewer.html");
    let run = place.lar(&line.split(' ').collect::<Vec<_>>());
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{line}");
    assert_eq!(run.out, "page.html: a page of 0.0 MB\n", "{line}");
    place.read("page.html")
}

/// The view within a page, found as browsers find it.
fn view(page: &str) -> SharedView {
    let (_, rest) = page.split_once("<script id=\"lar-view\" type=\"application/octet-stream\">").unwrap();
    let (packed, _) = rest.split_once("</script>").unwrap();
    let mut text = String::new();
    let bytes = BASE64_STANDARD.decode(packed).unwrap();
    flate2::read::GzDecoder::new(&bytes[..]).read_to_string(&mut text).unwrap();
    SharedView::from_json(&text).unwrap()
}

#[test]
fn the_page_holds_the_arrangement() {
    let place = place();
    let page = exported(&place, "a.obj hole=b.obj c.obj");
    let shared = view(&page);
    let data = shared.session.data();
    assert_eq!(data.solids(), ["A", "hole", "C"]);
    let run = place.lar(&["arrange", "a.obj", "hole=b.obj", "c.obj", "--complex", "complex.json"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert_eq!(*data.complex(), ChainComplex::read_json(place.path("complex.json")).unwrap());
    assert!((0..data.n_cells(2) as u32).all(|face| !data.triangles(face).is_empty()));
    assert!(shared.answers.wrapping(data, 3).unwrap().last().unwrap().boundary.is_zero());
    assert_eq!(page, exported(&place, "a.obj hole=b.obj c.obj"), "the same bytes each time");
}

#[test]
fn the_page_opens_as_the_options_say() {
    let options = "a.obj b.obj c.obj --explode 2,1,1 --clip -y=0.5 --whole-cells --color class --alpha 0.5 --numbers cells \
                   --draw edges,faces --exterior shell --background #102030 --view top --ortho --title A<B&C";
    let page = exported(&place(), options);
    assert!(page.contains("<title>A&lt;B&amp;C</title>"), "{}", &page[..900]);
    let shared = view(&page);
    let settings = shared.session.settings();
    assert_eq!((settings.explode.factors, settings.numbers), ([2.0, 1.0, 1.0], [false, false, false, true]));
    assert_eq!((settings.coloring, settings.opacity), (ColorBy::Class, 0.5));
    assert_eq!(settings.visibility.layers, [false, true, true, false]);
    let section = settings.section;
    assert_eq!((section.on, section.flipped, section.whole_cells), (true, true, true));
    assert_eq!(section.normal, Normal::Axis(1));
    assert_eq!(settings.background.map(|c| (255.0 * c).round()), [16.0, 32.0, 48.0]);
    let [found, top] = [shared.camera.orientation, StandardView::Top.orientation()].map(|o| o.axes()[2]);
    assert!((0..3).all(|k| (found[k] - top[k]).abs() < 1e-9), "{found:?}");
    assert_eq!((shared.camera.projection, shared.is_fitted), (Projection::Orthographic, true));
    let placed = view(&exported(&place(), "a.obj --eye 4,-3,2 --target 0,0,0.5 --fov 30"));
    assert!(!placed.is_fitted && (placed.camera.fov_y.to_degrees() - 30.0).abs() < 1e-9);
    assert!((placed.camera.eye()[0] - 4.0).abs() < 1e-9, "{:?}", placed.camera);
}

#[test]
fn drawings_of_the_plane_become_pages() {
    let place = place();
    let plan = std::fs::read(fixture("plan.svg")).unwrap();
    place.write("plan.svg", plan);
    let shared = view(&exported(&place, "plan.svg --explode 1.2"));
    assert_eq!(shared.session.data().dim(), 2);
    let none = shared.answers.wrapping(shared.session.data(), 1).unwrap_err();
    assert_eq!(none, "this complex was not made by gift wrapping");
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let page = exported(&place(), "a.obj b.obj");
    for reference in ["http:", "https:", "//cdn", "src=", "import(", "@import", "url(", "<link", "fetch("] {
        assert!(!page.contains(reference), "{reference}");
    }
    let policy =
        "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'";
    assert!(page.contains(policy), "browsers are told to load nothing");
    assert!(!page.contains("<!--lar:"), "no place is left empty");
}

/// The program in a directory of its own, with nothing beside it.
fn installed(place: &Place) -> String {
    let [from, to] = [env!("CARGO_BIN_EXE_lar").into(), place.path("bin/lar")];
    std::fs::create_dir(place.path("bin")).unwrap();
    std::fs::hard_link(&from, &to).or_else(|_| std::fs::copy(&from, &to).map(|_| ())).unwrap();
    to.to_str().unwrap().to_owned()
}

#[test]
fn without_the_viewer_nothing_is_written() {
    let place = place();
    let program = installed(&place);
    place.write("other.html", "<html></html>");
    place.write("unfilled.html", include_str!("../../lar-viewer/web/page.html"));
    let before = place.files();
    let mut said = String::new();
    for options in ["", " --viewer other.html", " --viewer unfilled.html", " --viewer missing.html"] {
        let line = format!("export-html a.obj -o page.html{options}");
        let run = place.program(&program, &line.split(' ').collect::<Vec<_>>());
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{run:?}");
        said += &format!("$ lar {line}\n{}", run.err);
    }
    assert_eq!(place.files(), before);
    insta::assert_snapshot!(said);
}

#[test]
fn the_viewer_is_found_near_the_program() {
    let place = place();
    let program = installed(&place);
    std::fs::create_dir_all(place.path("share/lar")).unwrap();
    for found in ["bin/lar-viewer.html", "lar-viewer.html", "share/lar/lar-viewer.html"] {
        place.write(found, viewer_page());
        let run = place.program(&program, &["export-html", "a.obj", "-o", "page.html"]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{found}");
        std::fs::remove_file(place.path(found)).unwrap();
    }
    let mut command = std::process::Command::new(&program);
    let run = place
        .run(command.args(["export-html", "a.obj", "-o", "page.html"]).env("LAR_VIEWER_PAGE", "viewer.html"));
    assert_eq!((run.code, run.err.as_str()), (0, ""));
}
