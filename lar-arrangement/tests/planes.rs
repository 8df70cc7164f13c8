//! Facets that were meant to be coplanar, after rotations, rounding and files: the counts of the unmoved scene.

mod common;

use common::{Random, arranged, counts, moved, sorted_volumes, surfaces};
use lar_arrangement::{Arranger, Checks, Merge, Planes};
use lar_core::{
    Affine, Model, Precision, Struct, Surface, TriangleMesh, cuboid_grid, r, read_surface, rotation, t,
    write_mesh,
};
use std::fmt::Write as _;
use std::path::Path;

fn cube() -> Model {
    cuboid_grid(&[1, 1, 1])
}

fn beside(by: [f64; 3]) -> Struct {
    Struct::new("pair").with(cube()).with(t(&by)).with(cube())
}

/// n³ unit cubes side by side, each a solid of its own.
fn blocks(n: usize) -> Struct {
    (0..n * n * n).fold(Struct::new("blocks"), |scene, i| {
        let at = [i % n, i / n % n, i / n / n].map(|x| x as f64);
        scene.with(Struct::new("block").with(t(&at)).with(cube()))
    })
}

/// Two such blocks of n³, the second moved, or turned about z, or both.
fn two_blocks(n: usize, by: [f64; 3], angle: f64) -> Struct {
    Struct::new("two blocks").with(blocks(n)).with(t(&by)).with(r([0.0, 0.0, angle])).with(blocks(n))
}

/// Scenes with coplanar faces and their counts of vertices, edges, faces and cells.
fn rows() -> Vec<(&'static str, Struct, [usize; 4])> {
    vec![
        ("sharing a face", beside([1.0, 0.0, 0.0]), [12, 20, 11, 3]),
        ("sharing half a face", beside([1.0, 0.5, 0.0]), [16, 26, 13, 3]),
        ("overlapping", beside([0.5, 0.0, 0.0]), [16, 28, 16, 4]),
        ("sharing an edge", beside([1.0, 1.0, 0.0]), [14, 23, 12, 3]),
        ("sharing a vertex", beside([1.0, 1.0, 1.0]), [15, 24, 12, 3]),
        ("grid of 8", Struct::new("grid").with(cuboid_grid(&[2, 2, 2])), [27, 54, 36, 9]),
        ("grid of 27", Struct::new("grid").with(cuboid_grid(&[3, 3, 3])), [64, 144, 108, 28]),
        ("27 blocks", blocks(3), [64, 144, 108, 28]),
        ("blocks on blocks", two_blocks(2, [0.5, 0.5, 2.0], 0.0), [62, 124, 79, 17]),
    ]
}

fn random_rotation(random: &mut Random) -> Affine {
    let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
    rotation(axis, random.between(0.1, 6.0)).expect("the axis is not zero")
}

#[track_caller]
fn check(name: &str, input: &[Surface], expected: [usize; 4]) {
    let a =
        Arranger::new().checks(Checks::EveryStage).arrange(input).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(counts(&a), expected, "{name}");
}

#[test]
fn unmoved() {
    for (name, scene, expected) in rows() {
        let a = arranged(&surfaces(&scene));
        assert_eq!(counts(&a), expected, "{name}");
        assert_eq!(a.stats().moved_points, 0, "{name}: an exact scene stays as it is");
    }
}

#[test]
fn hundred_rotations() {
    let random = &mut Random(7);
    for (name, scene, expected) in rows() {
        let input = surfaces(&scene);
        for i in 0..100 {
            let by = [0; 3].map(|_| random.between(-50.0, 50.0));
            let input = moved(&moved(&input, &random_rotation(random)), &t(&by));
            check(&format!("{name}, rotation {i}"), &input, expected);
        }
    }
}

/// Rounding adds up over a product of a thousand rotations by small angles.
#[test]
fn many_small_rotations() {
    let random = &mut Random(8);
    for (name, scene, expected) in rows() {
        for i in 0..3 {
            let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
            let step = rotation(axis, 0.001).expect("the axis is not zero");
            let input = (0..1000).fold(surfaces(&scene), |input, _| moved(&input, &step));
            check(&format!("{name}, {i}"), &input, expected);
        }
    }
}

/// Coordinates rounded as a file does, with the precision that its reader reports.
fn rounded(input: &[Surface], precision: Precision, round: impl Fn(f64) -> f64) -> Vec<Surface> {
    let with_precision = |s: &Surface| {
        let mut rounded = common::mapped(s, |p| p.map(&round));
        rounded.precision = precision;
        rounded
    };
    input.iter().map(with_precision).collect()
}

#[test]
fn six_digits_and_32_bits() {
    let random = &mut Random(9);
    let six = Precision::Decimal { significant: 6, last_place: -9 };
    for (name, scene, expected) in rows() {
        for i in 0..20 {
            let input = moved(&surfaces(&scene), &random_rotation(random));
            let printed = rounded(&input, six, |x| format!("{x:.5e}").parse().expect("a number"));
            check(&format!("{name}, six digits, {i}"), &printed, expected);
            let single = rounded(&input, Precision::F32, |x| f64::from(x as f32));
            check(&format!("{name}, 32 bits, {i}"), &single, expected);
        }
    }
}

/// Faces apart by more than the tolerance stay apart; the option closes the gap, or keeps every other.
#[test]
fn the_tolerance_decides() {
    let turn = rotation([1.0, 2.0, 3.0], 0.7).expect("the axis is not zero");
    let input = moved(&surfaces(&beside([1.0 + 1e-6, 0.0, 0.0])), &turn);
    let cells = |planes| {
        let a = Arranger::new().planes(planes).arrange(&input).expect("a valid scene");
        (a.n_cells(), a.n_faces(), a.stats().farthest_move)
    };
    let (n_cells, n_faces, farthest) = cells(Planes::Canonical);
    assert_eq!((n_cells, n_faces), (3, 12));
    assert!(farthest < 1e-11, "moved by {farthest}");
    let (n_cells, n_faces, farthest) = cells(Planes::Within(1e-6));
    assert_eq!((n_cells, n_faces), (3, 11));
    assert!((1e-7..1e-5).contains(&farthest), "moved by {farthest}");
    assert_eq!(cells(Planes::AsGiven), (3, 12, 0.0));
}

/// The volumes of a canonical scene are those of the scene as it was meant.
#[test]
fn volumes_survive() {
    let random = &mut Random(10);
    for (name, scene, _) in rows() {
        let input = surfaces(&scene);
        let expected = sorted_volumes(&arranged(&input));
        let turned = arranged(&moved(&input, &random_rotation(random)));
        common::assert_close(&sorted_volumes(&turned), &expected, 1e-10, name);
    }
}

/// Nothing moves farther than eight errors of a coordinate; numbers of five digits are taken as they are.
#[test]
fn moves_are_bounded() {
    let random = &mut Random(11);
    for (digits, error) in [(5, 0.0), (6, 5e-6), (9, 5e-9)] {
        for (name, scene, _) in rows() {
            let input = moved(&surfaces(&scene), &random_rotation(random));
            let precision = Precision::Decimal { significant: digits as u32, last_place: -12 };
            let printed =
                rounded(&input, precision, |x| format!("{x:.*e}", digits - 1).parse().expect("a number"));
            let a = Arranger::new().arrange(&printed).expect("a valid scene");
            // Coordinates are below 10; half a grid step is the least error.
            let bound = 8.0 * f64::max(error, a.stats().grid_step / 2.0);
            let farthest = a.stats().farthest_move;
            assert!(farthest <= bound, "{name}, {digits} digits: moved by {farthest:e}, not {bound:e}");
        }
    }
}

/// Every surface written as triangles and read again, each through a file of its own.
fn reread(input: &[Surface], name: &str, write: impl Fn(&Path, &TriangleMesh)) -> Vec<Surface> {
    let name = format!("lar-planes-{}-{name}", std::process::id());
    let path = std::env::temp_dir().join(name);
    let triangles = |s: &Surface| {
        write(&path, &common::triangle_mesh(s));
        read_surface(&path).expect("the file is well formed").surface
    };
    let surfaces = input.iter().map(triangles).collect();
    std::fs::remove_file(&path).expect("the file is there");
    surfaces
}

fn six_digits(path: &Path, mesh: &TriangleMesh) {
    let mut text = String::new();
    for p in mesh.points.iter() {
        writeln!(text, "v {:.5e} {:.5e} {:.5e}", p[0], p[1], p[2]).expect("memory");
    }
    for t in &mesh.triangles {
        writeln!(text, "f {} {} {}", t[0] + 1, t[1] + 1, t[2] + 1).expect("memory");
    }
    std::fs::write(path, text).expect("a writable directory");
}

#[track_caller]
fn check_merged(name: &str, input: &[Surface], expected: [usize; 4]) {
    let a = Arranger::new().checks(Checks::EveryStage).merge(Merge::Coplanar).arrange(input);
    let a = a.unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(counts(&a), expected, "{name}");
}

/// Files of triangles have no squares: what lies side by side in one plane is merged.
#[test]
fn triangles_through_files() {
    let random = &mut Random(12);
    for (name, scene, expected) in rows() {
        for i in 0..6 {
            let turn = if i == 0 { t(&[0.0; 3]) } else { random_rotation(random) };
            let input = moved(&surfaces(&scene), &turn);
            let stl = reread(&input, "a.stl", |path, mesh| write_mesh(path, mesh).expect("a writable place"));
            check_merged(&format!("{name}, STL, {i}"), &stl, expected);
            check_merged(&format!("{name}, OBJ, {i}"), &reread(&input, "a.obj", six_digits), expected);
        }
    }
}

/// Corners inside of merged faces and in the middle of their straight edges disappear; those where a face ends stay.
#[test]
fn fine_triangles_merge() {
    let fine = cuboid_grid(&[3, 4, 2]).boundary().expect("a grid").to_surface("fine").expect("it has faces");
    let fine = Surface::from_triangles("fine", &common::triangle_mesh(&fine));
    let cut = common::cuboid([1.0, 1.0, 1.0], [5.0, 2.0, 5.0]);
    let turn = rotation([1.0, 2.0, 3.0], 0.7).expect("the axis is not zero");
    for input in [vec![fine.clone(), cut.clone()], moved(&[fine, cut], &turn)] {
        check_merged("alone", &input[..1], [8, 12, 6, 2]);
        check_merged("cut", &input, [22, 36, 18, 4]);
        let a = Arranger::new().merge(Merge::Coplanar).arrange(&input).expect("a valid scene");
        let all = (0..a.n_faces() as u32).map(lar_core::FaceId);
        let of_fine = |f: &lar_core::FaceId| a.parents(*f).iter().filter(|p| p.solid == 0).count();
        assert_eq!(all.clone().map(|f| of_fine(&f)).max(), Some(24), "two triangles a square of 3 × 4");
        assert!(all.clone().all(|f| a.crossed(f).len() <= 2), "a face of each solid at most");
        assert_eq!(a.open_edges(0), []);
        assert_eq!((0..4).map(|c| a.winding(lar_core::CellId(c), 0)).sum::<i32>(), 2);
    }
}
