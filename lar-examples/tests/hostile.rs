//! Models and files that nobody makes on purpose, given to everything public that takes models and files: errors with
//! messages, never a panic. What each says is in the snapshots; what is not listed there went well.

mod support;

use lar_arrangement::planar::{Drawing, planar_arrangement};
use lar_arrangement::{Expression, arrange};
use lar_core::{
    Affine, Cells, ChainComplex, Graph, Model, Points, SolidLocator, Struct, Surface, TriangleMesh,
    cuboid_grid, extrude_simplicial, grid_1d, parse_obj, parse_surface, parse_svg, product, product_all,
    quads_to_triangles, r, rotation, s, simplex_facets, simplex_grid, simplicial_complex, t, write_mesh,
};
use lar_triangle::{delaunay, triangulate, triangulate_cells, triangulate2d};
use std::fmt::{Display, Write as _};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::Command;
use support::Place;

/// What operations said.
#[derive(Default)]
struct Said {
    text: String,
    subject: String,
}

impl Said {
    /// Notes the error of an operation; a panic fails the test with the names of both.
    #[track_caller]
    fn try_to<T, E: Display>(&mut self, what: &str, operation: impl FnOnce() -> Result<T, E>) -> Option<T> {
        match catch_unwind(AssertUnwindSafe(operation)) {
            Ok(Ok(value)) => Some(value),
            Ok(Err(error)) => {
                let message: String = error.to_string().chars().take(150).collect();
                assert!(
                    !message.is_empty() && !message.contains('\n'),
                    "{}, {what}: {message}",
                    self.subject
                );
                writeln!(self.text, "  {what}: {message}").unwrap();
                None
            }
            Err(_) => panic!("{}, {what}: panics", self.subject),
        }
    }

    /// The same for what has no error.
    #[track_caller]
    fn must<T>(&mut self, what: &str, operation: impl FnOnce() -> T) {
        self.try_to(what, || Ok::<T, String>(operation()));
    }

    fn about(&mut self, subject: &str) {
        subject.clone_into(&mut self.subject);
        writeln!(self.text, "{subject}").unwrap();
    }
}

fn scaled(by: f64) -> Model {
    let cube = cuboid_grid(&[1, 1, 1]);
    let points = cube.points().coords().iter().map(|x| if *x == 0.0 { 0.0 } else { x * by }).collect();
    Model::new(Points::from_columns(3, points), cube.into_parts().1)
}

fn models() -> Vec<(&'static str, Model)> {
    let corners = |n: usize, dim: usize| Points::from_columns(dim, vec![0.5; n * dim]);
    let cells = |list: &[&[u32]]| list.iter().map(|c| c.to_vec()).collect::<Cells>();
    let levels = |list: &[&[&[u32]]]| list.iter().map(|l| cells(l)).collect::<Vec<_>>();
    vec![
        ("nothing at all", Model::new(Points::new(0), Vec::new())),
        ("nothing in space", Model::new(Points::new(3), levels(&[&[], &[], &[], &[]]))),
        ("points without cells", Model::new(corners(4, 3), Vec::new())),
        ("a grid of no cells", cuboid_grid(&[0, 2, 2])),
        ("a point", cuboid_grid(&[])),
        ("a segment", cuboid_grid(&[1])),
        ("a square in the plane", cuboid_grid(&[1, 1])),
        ("a cube of four dimensions", cuboid_grid(&[1, 1, 1, 1])),
        ("a cube of no size", scaled(0.0)),
        ("a cube with NaN", scaled(f64::NAN)),
        ("an infinite cube", scaled(f64::INFINITY)),
        ("a cube of 1e308", scaled(1e308)),
        ("a cube of 1e-320", scaled(1e-320)),
        (
            "cells of missing vertices",
            Model::new(
                corners(3, 3),
                levels(&[&[&[0], &[7]], &[&[0, 9]], &[&[0, 1, u32::MAX]], &[&[0, 1, 2, 3]]]),
            ),
        ),
        ("empty cells", Model::new(corners(3, 3), levels(&[&[&[]], &[&[], &[]], &[&[], &[0]], &[&[]]]))),
        (
            "cells that repeat",
            Model::new(
                corners(3, 3),
                levels(&[&[&[0, 0]], &[&[1, 1], &[1, 1]], &[&[0, 1, 2], &[2, 1, 0], &[0, 0, 0]]]),
            ),
        ),
    ]
}

fn surfaces() -> Vec<(&'static str, Surface)> {
    let mut out: Vec<(&str, Surface)> = Vec::new();
    let named = |points: Points, faces: &[&[&[u32]]]| {
        let mut surface = Surface::new("S", points);
        faces.iter().for_each(|loops| {
            surface.push_face(loops.iter().copied(), 1);
        });
        surface
    };
    let square = || Points::from_xyz(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    out.push(("no points", named(Points::new(3), &[])));
    out.push(("points of no dimension", named(Points::new(0), &[&[&[0, 1, 2]]])));
    out.push(("points of the plane", named(Points::from_columns(2, vec![0.0; 8]), &[&[&[0, 1, 2]]])));
    out.push(("no loops", named(square(), &[&[], &[&[]], &[&[0], &[1]]])));
    out.push(("loops of missing points", named(square(), &[&[&[0, 1, 2]], &[&[0, 1, 4]]])));
    out.push(("one point only", named(Points::from_xyz(&[[3.0; 3]]), &[&[&[0, 0, 0]]])));
    out.push(("a line", named(square(), &[&[&[0, 1, 0, 1]], &[&[0, 1, 1]]])));
    out.push((
        "infinite",
        named(Points::from_xyz(&[[0.0; 3], [1.0; 3], [0.0, f64::INFINITY, 1.0]]), &[&[&[0, 1, 2]]]),
    ));
    let wide = [[f64::MAX; 3], [f64::MIN, 0.0, 0.0], [0.0, f64::MIN, f64::MAX], [5e-324; 3]];
    out.push(("as wide as numbers are", named(Points::from_xyz(&wide), &[&[&[0, 1, 2]], &[&[0, 1, 3]]])));
    let mut heavy = named(square(), &[]);
    heavy.push_face([&[0u32, 1, 2, 3][..], &[3, 2, 1, 0]], i8::MIN);
    out.push(("a hole as large as its face, -128 times", heavy));
    out
}

#[test]
fn models_that_are_none() {
    let mut said = Said::default();
    for (name, model) in models() {
        said.about(name);
        said.must("validate", || (model.validate(), model.f_vector(), format!("{model:?}")));
        said.try_to("to_surface", || model.to_surface("S"));
        said.try_to("to_triangle_mesh", || model.to_triangle_mesh());
        said.try_to("welded", || model.welded());
        said.try_to("boundary", || model.boundary());
        said.try_to("unsigned_boundary", || model.unsigned_boundary(1));
        said.try_to("unsigned_coboundary", || model.unsigned_coboundary(9));
        said.try_to("coboundary_1", || model.coboundary_1());
        said.try_to("transformed", || model.transformed(&t(&[1.0, 2.0, 3.0])));
        said.try_to("embedded", || model.embedded(5));
        said.try_to("product", || product(&model, &model));
        said.try_to("extrude_simplicial", || extrude_simplicial(&model, &[1.0, f64::NAN]));
        let top = model.cells(model.dim()).clone();
        said.try_to("simplicial_complex", || simplicial_complex(model.points().clone(), top.clone()));
        said.try_to("simplex_facets", || simplex_facets(&top));
        said.try_to("quads_to_triangles", || quads_to_triangles(&top));
        said.try_to("json", || Model::from_json(&model.to_json()?));
        said.try_to("struct2lar", || Struct::new("s").with(t(&[1.0])).with(model.clone()).struct2lar());
        said.try_to("eval_struct", || Struct::new("s").with(model.clone()).with(model.clone()).eval_struct());
        said.try_to("delaunay", || delaunay(model.points()));
        said.try_to("triangulate2d", || triangulate2d(model.points(), &[[0, 1], [1, 5]]));
        if let Some(complex) = said.try_to("from_model", || ChainComplex::from_model(&model)) {
            complex_operations(&mut said, &complex);
        }
    }
    insta::assert_snapshot!(said.text);
}

fn complex_operations(said: &mut Said, complex: &ChainComplex) {
    said.must("f_vector", || (complex.validate(), complex.f_vector(), complex.euler_characteristic()));
    said.must("components", || (complex.connected_components().n, complex.cell_components()));
    said.try_to("betti_numbers", || complex.betti_numbers());
    said.try_to("betti_numbers_modulo", || complex.betti_numbers_modulo(6));
    said.try_to("cell_measures", || complex.cell_measures(complex.dim()));
    said.try_to("cell_measures of dimension 7", || complex.cell_measures(7));
    said.try_to("cell_integrals", || complex.cell_integrals(2, [u32::MAX, 0, 0]));
    said.try_to("mass_properties", || complex.mass_properties(3));
    said.try_to("with_exterior", || complex.with_exterior());
    said.try_to("graph", || Graph::of_complex(complex));
    said.try_to("to_svg", || complex.to_svg());
    said.try_to("complex json", || ChainComplex::from_json(&complex.to_json()?));
    said.try_to("triangulate", || triangulate(complex));
    said.try_to("triangulate_cells", || triangulate_cells(complex));
    said.must("to_model", || complex.to_model());
}

#[test]
fn surfaces_that_are_none() {
    let mut said = Said::default();
    for (name, surface) in surfaces() {
        said.about(name);
        said.must("validate", || {
            (surface.validate(), surface.boundary_edges(), surface.odd_boundary_edges())
        });
        said.try_to("from_surface", || ChainComplex::from_surface(&surface));
        said.try_to("transformed", || surface.transformed(&r([0.0, 0.0, f64::NAN])));
        said.try_to("locator", || SolidLocator::new(&surface).map(|l| l.locate([0.1, f64::NAN, 0.3])));
        let cube = cuboid_grid(&[1, 1, 1]).to_surface("cube").expect("a cube");
        if let Some(a) = said.try_to("arrange", || arrange(&[surface.clone(), cube])) {
            said.must("volumes", || (a.volumes(), a.euler(), a.provenance(0)));
            said.try_to("boolean", || {
                a.boolean(&Expression::solid(0), Default::default()).map(|s| s.volume())
            });
            said.try_to("boolean of a missing solid", || {
                a.boolean(&Expression::solid(9), Default::default()).map(drop)
            });
            said.try_to("triangulate", || triangulate(a.complex()));
        }
        said.try_to("arrange it alone", || arrange(&[surface.clone(), surface.clone()]));
    }
    said.about("nothing");
    said.try_to("arrange", || arrange(&[]));
    insta::assert_snapshot!(said.text);
}

#[test]
fn numbers_that_are_none() {
    let mut said = Said::default();
    for (name, x) in
        [("0", 0.0), ("NaN", f64::NAN), ("inf", f64::INFINITY), ("1e308", 1e308), ("5e-324", 5e-324)]
    {
        said.about(name);
        let square = || cuboid_grid(&[1, 1]);
        said.try_to("t", || square().transformed(&t(&[x, x])));
        said.try_to("s", || square().transformed(&s(&[x, x])).and_then(|_| s(&[x, x]).inverse()));
        said.try_to("r", || square().transformed(&r(x)));
        said.try_to("rotation", || rotation([x, 0.0, 0.0], 1.0));
        said.try_to("rotation by", || rotation([0.0, 0.0, 1.0], x));
        said.try_to("grid_1d", || grid_1d(&[x, -x, x]));
        said.try_to("composed", || t(&[x]).compose(&t(&[x, x])));
        let segments = [[x, 0.0, 1.0, 1.0], [0.0, x, 1.0, 0.0], [x, x, x, x]];
        said.try_to("planar_arrangement", || planar_arrangement(&Drawing::from_segments(&segments)));
        said.try_to("svg", || parse_svg(&format!("<svg><path d='M0 0L{x} 3z'/></svg>"), "a.svg", x));
        said.try_to("obj", || {
            parse_obj(&format!("v {x} 0 0\nv 1 {x} 0\nv 0 1 0\nf 1 2 3\n"), "a.obj", Default::default())
        });
    }
    said.about("shapes");
    said.try_to("grid_1d of nothing", || grid_1d(&[]));
    said.try_to("product_all of nothing", || product_all([]));
    said.try_to("simplex_grid of nothing", || simplex_grid(&[]));
    said.try_to("simplex_grid of no cells", || simplex_grid(&[0]));
    said.try_to("simplex_grid too large", || simplex_grid(&[usize::MAX, 2]));
    said.try_to("simplex_grid of many dimensions", || simplex_grid(&[1; 40]));
    said.try_to("from_matrix", || Affine::from_matrix(Default::default()));
    said.try_to("graph", || Graph::new(2, &[[0, 5]]));
    insta::assert_snapshot!(said.text);
}

/// Every format on text and bytes of all sorts.
#[test]
fn files_that_are_none() {
    let mut said = Said::default();
    let deep = "(".repeat(100_000);
    let groups = format!("<svg>{}{}</svg>", "<g>".repeat(200_000), "</g>".repeat(200_000));
    let json = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let uses = "<svg><g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g><use href='#a'/></svg>";
    let own = "<svg><use id='u' href='#u'/></svg>";
    let doubling: String =
        (0..40).map(|i| format!("<g id='g{}'><use href='#g{i}'/><use href='#g{i}'/></g>", i + 1)).collect();
    let doubling = format!("<svg><rect id='g0' width='1' height='1'/>{doubling}</svg>");
    let entities = "<!DOCTYPE svg [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;'>]><svg>&b;</svg>";
    for (name, text) in [
        ("a reference in a circle", uses),
        ("a reference to itself", own),
        ("doubled 40 times", &doubling),
        ("entities", entities),
        ("200000 groups deep", &groups),
        ("no text", ""),
    ] {
        said.about(name);
        said.try_to("svg", || parse_svg(text, "a.svg", 0.1));
    }
    said.about("100000 brackets");
    said.try_to("expression", || Expression::parse(&deep, &["A"]));
    said.try_to("model", || Model::from_json(&json));
    said.try_to("complex", || ChainComplex::from_json(&json));
    said.try_to("struct", || Struct::from_json(&json));
    let nested = format!("{}A{}", "!(".repeat(100_000), ")".repeat(100_000));
    let parsed = said.try_to("balanced expression", || Expression::parse(&nested, &["A"]));
    let cube = cuboid_grid(&[1, 1, 1]).to_surface("A").expect("a cube");
    let arrangement = arrange(&[cube]).expect("a cube");
    let parsed = parsed.expect("balanced");
    said.try_to("its cells", || arrangement.boolean(&parsed, Default::default()).map(|s| s.volume()));
    said.must("its copy", || format!("{:?}", parsed.clone()).len());
    let names = ["a.obj", "a.stl", "a.ply", "a.off", "a.xyz", "a", "", "/", "..", "ä😀.stl"];
    let bytes: [(&str, &[u8]); 6] = [
        ("no bytes", b""),
        ("zeros", &[0; 300]),
        ("solid", b"solid "),
        ("billions of vertices", b"ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"),
        ("billions of faces", b"OFF\n3 18446744073709551615 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        ("a list of billions", b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n000000000000\xff\xff\xff\xff0000"),
    ];
    for (name, bytes) in bytes {
        said.about(name);
        for file in names {
            said.try_to(&format!("{file:?}"), || parse_surface(bytes, file));
        }
    }
    insta::assert_snapshot!(said.text);
}

/// A mesh whose triangles name vertices that are not there cannot be written in any format; places that cannot be written
/// are named.
#[test]
fn meshes_and_places_that_are_none() {
    let mut said = Said::default();
    let place = Place::new();
    std::fs::create_dir(place.path("directory.stl")).unwrap();
    let triangle = |index: u32, x: f64| TriangleMesh {
        points: Points::from_xyz(&[[0.0; 3], [1.0, 0.0, x], [0.0, 1.0, 0.0]]),
        triangles: vec![[0, 1, index]],
    };
    let meshes = [
        ("vertex 3 of 3", triangle(3, 0.0)),
        ("NaN", triangle(2, f64::NAN)),
        ("1e308", triangle(2, 1e308)),
        ("none", TriangleMesh { points: Points::new(3), triangles: Vec::new() }),
    ];
    for (name, mesh) in meshes {
        said.about(name);
        if name != "vertex 3 of 3" {
            // Documented: these have no error to return.
            said.must("measures", || (mesh.signed_volume(), mesh.area(), mesh.bounds(), mesh.is_closed()));
        }
        for format in ["out.obj", "out.stl", "out.ply", "out.off", "out.glb", "out.gltf", "out.xyz"] {
            said.try_to(format, || {
                write_mesh(place.path(format), &mesh)
                    .map_err(|e| e.to_string().replace(&*place.path("").to_string_lossy(), ""))
            });
        }
    }
    said.about("places");
    let good = triangle(2, 0.0);
    for file in ["directory.stl", "no/such.stl", "", "out.obj/a.stl"] {
        said.try_to(file, || {
            write_mesh(place.path("").join(file), &good)
                .map_err(|e| e.to_string().replace(&*place.path("").to_string_lossy(), ""))
        });
    }
    assert!(place.files().iter().all(|p| !p.to_string_lossy().ends_with(".tmp")));
    insta::assert_snapshot!(said.text);
}

/// Odd names, odd places, and files whose announced content does not fit the memory.
#[cfg(target_os = "linux")]
#[test]
fn commands() {
    let place = Place::new();
    let solid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    for name in [
        "solid.obj",
        "with space.obj",
        "ä→😀.obj",
        "-dash.obj",
        "quote'\".obj",
        "new\nline.obj",
        "=.obj",
        "a=b.obj",
        "%s%n.obj",
    ] {
        place.write(name, solid);
        let path = format!("./{name}");
        let run = place.lar(&["arrange", &path, "--json", &format!("{path}.json")]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{name}");
        assert!(place.path(&format!("{name}.json")).is_file(), "{name}");
    }
    let mut said = String::new();
    let mut refused = |line: &str, run: support::Run| {
        assert_eq!((run.code, run.out.as_str(), run.err.lines().count()), (2, "", 1), "{line}: {run:?}");
        write!(said, "$ {line}\n{}", run.err).unwrap();
    };
    for line in [
        "boolean A solid.obj -o /dev/full",
        "boolean A solid.obj -o /dev/full/x",
        "boolean A solid.obj -o out.obj --json /dev/full",
        "boolean A solid.obj -o /proc/nowhere.obj",
        "arrange /dev/null",
        "arrange solid.obj /",
        "info /dev/null",
        "plane /dev/null",
        "plane solid.obj",
        "info solid.obj/x",
    ] {
        refused(line, place.lar(&line.split(' ').collect::<Vec<_>>()));
    }
    place.write("empty.stl", "");
    place.write("empty.ply", "");
    place.write("empty.off", "");
    place.write("empty.svg", "");
    place.write("empty.seg", "");
    place.write("empty.json", "");
    for line in [
        "info empty.stl",
        "info empty.ply",
        "info empty.off",
        "plane empty.svg",
        "plane empty.seg",
        "info empty.json",
    ] {
        refused(line, place.lar(&line.split(' ').collect::<Vec<_>>()));
    }
    // Holes take no room on the disk. The process may have 1 GB.
    let sparse = |name: &str, head: &[u8], len: u64| {
        place.write(name, head);
        std::fs::OpenOptions::new().write(true).open(place.path(name)).unwrap().set_len(len).unwrap();
    };
    let facets = u64::from(u32::MAX);
    sparse("sparse.stl", &[&[0; 80][..], &[255; 4]].concat(), 84 + 50 * facets);
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    sparse("sparse.ply", header.as_bytes(), header.len() as u64 + 12 * facets + 13);
    sparse("sparse.obj", b"v 0 0 0\n", 1 << 36);
    for name in ["sparse.off", "sparse.json", "sparse.svg", "sparse.seg"] {
        sparse(name, b"OFF\n1 1 1\n", 1 << 36);
    }
    for line in [
        "info sparse.stl",
        "info sparse.ply",
        "info sparse.obj",
        "info sparse.off",
        "info sparse.json",
        "plane sparse.svg",
        "plane sparse.seg",
    ] {
        let limited = format!("ulimit -v 1000000; exec '{}' {line}", env!("CARGO_BIN_EXE_lar"));
        refused(line, place.run(Command::new("sh").args(["-c", &limited])));
    }
    assert!(place.files().iter().all(|p| !p.to_string_lossy().ends_with(".tmp")));
    insta::assert_snapshot!(said);
    // A pipe as input is read to its end.
    let lar = env!("CARGO_BIN_EXE_lar");
    let piped = format!("mkfifo p.obj; cat solid.obj > p.obj & '{lar}' info p.obj");
    let run = place.run(Command::new("sh").args(["-c", &piped]));
    assert_eq!((run.code, run.err.as_str()), (0, ""));
}
