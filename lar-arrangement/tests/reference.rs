//! The table of 3D arrangements with known counts, and the three cubes of the 2019 paper in full.

mod common;

use common::{
    all_counts, arranged, assert_close, counts, exact_motions, moved, relabelled, sorted_volumes, surfaces,
    three_cubes,
};
use lar_arrangement::{Arrangement, Arranger, Checks};
use lar_core::{
    Affine, CellId, FaceId, Model, Points, Struct, cuboid_grid, r, rotation, s, simplex, t, triangular_prism,
};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// A scene and what is known of its arrangement. `skew` tells scenes in general position, whose counts do not hang
/// on equal coordinates.
struct Row {
    name: &'static str,
    scene: Struct,
    counts: [usize; 4],
    shells: Option<usize>,
    nonzeros: Option<[usize; 3]>,
    volumes: Option<Vec<f64>>,
    skew: bool,
}

impl Row {
    fn new(name: &'static str, scene: Struct, counts: [usize; 4]) -> Self {
        Self { name, scene, counts, shells: None, nonzeros: None, volumes: None, skew: false }
    }

    fn shells(self, shells: usize) -> Self {
        Self { shells: Some(shells), ..self }
    }

    fn nonzeros(self, nonzeros: [usize; 3]) -> Self {
        Self { nonzeros: Some(nonzeros), ..self }
    }

    fn volumes(self, volumes: &[f64]) -> Self {
        Self { volumes: Some(volumes.to_vec()), ..self }
    }

    fn skew(self) -> Self {
        Self { skew: true, ..self }
    }
}

fn cube() -> Model {
    cuboid_grid(&[1, 1, 1])
}

/// Two models, the second behind some transformations.
fn pair(first: Model, maps: &[Affine], second: Model) -> Struct {
    let scene = Struct::new("pair").with(first);
    maps.iter().cloned().fold(scene, Struct::with).with(second)
}

/// Height 2, over an equilateral triangle of radius 1 with its first corner at angle 0.
fn equilateral_prism() -> Model {
    let (_, cells) = triangular_prism().into_parts();
    let corner = |i: usize| {
        let angle = TAU * (i % 3) as f64 / 3.0;
        [angle.cos(), angle.sin(), if i < 3 { 0.0 } else { 2.0 }]
    };
    Model::new(Points::from_xyz(&(0..6).map(corner).collect::<Vec<_>>()), cells)
}

/// A tetrahedron inside the unit simplex, with the origin as their only common point.
fn inner_tetrahedron() -> Model {
    let (_, cells) = simplex(3).into_parts();
    let points = [[0.0; 3], [0.5, 0.125, 0.125], [0.125, 0.5, 0.125], [0.125, 0.125, 0.5]];
    Model::new(Points::from_xyz(&points), cells)
}

fn three_prisms() -> Struct {
    Struct::new("prisms")
        .with(equilateral_prism())
        .with(r([PI / 2.0, 0.0, 0.0]))
        .with(equilateral_prism())
        .with(r([0.0, PI / 2.0, 0.0]))
        .with(equilateral_prism())
}

fn rows() -> Vec<Row> {
    let turned = [t(&[0.0, 0.0, 0.5]), r([0.0, 0.0, PI / 3.0])];
    let skew = [t(&[0.3, 0.4, 0.5]), r([PI / 5.0, 0.0, 0.0]), r([0.0, 0.0, PI / 12.0])];
    let beside = |by: [f64; 3]| pair(cube(), &[t(&by)], cube());
    let grid = |n: usize| Struct::new("grid").with(cuboid_grid(&[n, n, n]));
    vec![
        Row::new("three cubes", three_cubes(), [49, 88, 47, 8]).skew(),
        Row::new("one turned", pair(cube(), &turned, cube()), [20, 34, 18, 4])
            .nonzeros([68, 80, 36])
            .volumes(&[0.133975, 0.866025, 0.866025]),
        Row::new("corner in corner", beside([0.5; 3]), [22, 36, 18, 4])
            .volumes(&[0.125, 0.875, 0.875])
            .skew(),
        Row::new("simplices", pair(simplex(3), &[t(&[0.25; 3])], simplex(3)), [11, 18, 12, 4])
            .volumes(&[0.002604, 0.164062, 0.164062])
            .skew(),
        Row::new("two cubes", pair(cube(), &skew, cube()), [22, 36, 18, 4]).skew(),
        Row::new("nested", pair(cube(), &[t(&[0.25; 3]), s(&[0.5; 3])], cube()), [16, 24, 12, 3])
            .shells(4)
            .skew(),
        Row::new("sharing a vertex", pair(simplex(3), &[], inner_tetrahedron()), [7, 12, 8, 3])
            .shells(4)
            .skew(),
        Row::new("sharing a corner", pair(simplex(3), &[s(&[0.25; 3])], simplex(3)), [7, 12, 8, 3]).shells(3),
        Row::new("sharing a face", beside([1.0, 0.0, 0.0]), [12, 20, 11, 3]),
        Row::new("sharing half a face", beside([1.0, 0.5, 0.0]), [16, 26, 13, 3]),
        Row::new("overlapping", beside([0.5, 0.0, 0.0]), [16, 28, 16, 4]),
        Row::new("grid of 1", grid(1), [8, 12, 6, 2]).skew(),
        Row::new("grid of 8", grid(2), [27, 54, 36, 9]),
        Row::new("grid of 27", grid(3), [64, 144, 108, 28]),
        Row::new("prisms", three_prisms(), [32, 63, 39, 8]),
    ]
}

#[track_caller]
fn check(row: &Row) {
    let (input, name) = (surfaces(&row.scene), row.name);
    let a = arranged(&input);
    assert_eq!(counts(&a), row.counts, "{name}");
    let nonzeros = [1, 2, 3].map(|p| a.complex().boundary(p).nnz());
    assert_eq!(nonzeros[0], 2 * a.n_edges(), "{name}");
    assert_eq!(nonzeros[2], 2 * a.n_faces(), "{name}");
    assert_eq!(nonzeros, row.nonzeros.unwrap_or(nonzeros), "{name}");
    assert_eq!(a.n_shells(), row.shells.unwrap_or(a.n_shells()), "{name}");
    let volumes = sorted_volumes(&a);
    if let Some(expected) = &row.volumes {
        assert_close(&volumes, expected, 1e-6, name);
    }
    let mut variants = exact_motions(&input);
    variants.extend(relabelled(&input, 3));
    for (what, by) in [("translated", [1e3, -2e3, 5e2]), ("translated far", [3e5, 7e4, -1e5])] {
        variants.push((what, moved(&input, &t(&by))));
    }
    for (what, variant) in variants {
        let other = arranged(&variant);
        assert_eq!(all_counts(&other), all_counts(&a), "{name}, {what}");
        assert_close(&sorted_volumes(&other), &volumes, 1e-8, &format!("{name}, {what}"));
    }
    for factor in [1e-6, 1e6] {
        let other = arranged(&moved(&input, &s(&[factor; 3])));
        assert_eq!(all_counts(&other), all_counts(&a), "{name}, scaled by {factor}");
        let back: Vec<f64> = sorted_volumes(&other).iter().map(|v| v / factor.powi(3)).collect();
        assert_close(&back, &volumes, 1e-9, name);
    }
}

#[test]
fn every_row_moved_scaled_and_relabelled() {
    rows().iter().for_each(check);
}

/// Rotations about axes that are parallel to no plane of the scenes.
fn rotations() -> [Affine; 5] {
    [
        ([1.0, 2.0, 3.0], 0.7),
        ([-0.3, 0.9, 0.1], 2.1),
        ([0.5, -0.4, 1.3], -1.2),
        ([2.0, 0.1, -0.7], 0.05),
        ([-1.0, -1.1, 0.9], 3.0),
    ]
    .map(|(axis, angle)| rotation(axis, angle).expect("the axes are not zero"))
}

fn counts_rotated(row: &Row, by: &Affine) -> Option<[usize; 4]> {
    let input = moved(&surfaces(&row.scene), by);
    Arranger::new().checks(Checks::EveryStage).arrange(&input).ok().as_ref().map(counts)
}

/// Those rows that do not hang on equal coordinates hold under any common rotation.
#[test]
fn rows_in_general_position_rotated() {
    for row in rows().iter().filter(|row| row.skew) {
        for (i, by) in rotations().iter().enumerate() {
            assert_eq!(counts_rotated(row, by), Some(row.counts), "{}, rotation {i}", row.name);
        }
    }
}

/// The rows with coplanar faces hold as well. In the two that are left out edges of different solids lie on one line,
/// and more than three planes through a line cannot all be rounded to small coefficients.
#[test]
fn rows_with_coplanar_faces_rotated() {
    let on_lines = ["one turned", "prisms"];
    for row in rows().iter().filter(|row| !row.skew && !on_lines.contains(&row.name)) {
        for (i, by) in rotations().iter().enumerate() {
            assert_eq!(counts_rotated(row, by), Some(row.counts), "{}, rotation {i}", row.name);
        }
    }
}

fn histogram(values: impl IntoIterator<Item = usize>) -> Vec<(usize, usize)> {
    let mut out: BTreeMap<usize, usize> = BTreeMap::new();
    values.into_iter().for_each(|v| *out.entry(v).or_default() += 1);
    out.into_iter().collect()
}

/// Inside which cubes, number of faces, volume; the exterior first, in the order of the printed table.
const THREE_CUBES: [([i32; 3], usize, f64); 8] = [
    ([0, 0, 0], 21, -2.484154),
    ([0, 0, 1], 11, 0.840067),
    ([1, 1, 0], 11, 0.296879),
    ([1, 1, 1], 7, 0.059034),
    ([1, 0, 0], 14, 0.597214),
    ([0, 1, 0], 15, 0.590061),
    ([1, 0, 1], 7, 0.046873),
    ([0, 1, 1], 8, 0.054026),
];

/// The cell of each row of the table.
fn cells_by_membership(a: &Arrangement) -> [CellId; 8] {
    THREE_CUBES.map(|(inside, ..)| {
        let mut found = (0..a.n_cells() as u32)
            .map(CellId)
            .filter(|&c| [0, 1, 2].map(|solid| a.winding(c, solid)) == inside);
        let cell = found.next().expect("every membership occurs");
        assert_eq!(found.next(), None, "{inside:?} occurs once");
        cell
    })
}

fn three_cubes_arranged() -> Arrangement {
    arranged(&surfaces(&three_cubes()))
}

#[test]
fn three_cubes_faces_and_vertices() {
    let a = three_cubes_arranged();
    let faces = || (0..a.n_faces() as u32).map(FaceId);
    assert!(faces().all(|f| a.face_loops(f).len() == 1), "no face has a hole");
    let sizes = histogram(faces().map(|f| a.face_vertices(f).map(|l| l.len()).sum()));
    assert_eq!(sizes, [(3, 8), (4, 12), (5, 10), (6, 8), (7, 8), (8, 1)]);
    let mut degrees = vec![0; a.n_vertices()];
    a.complex().boundary(1).indices().iter().for_each(|&v| degrees[v as usize] += 1);
    assert_eq!(histogram(degrees), [(3, 24), (4, 23), (6, 2)]);
}

#[test]
fn three_cubes_cells() {
    let a = three_cubes_arranged();
    let volumes = a.volumes();
    for (cell, (inside, n_faces, volume)) in cells_by_membership(&a).into_iter().zip(THREE_CUBES) {
        let column = a.complex().boundary(3).outer_view(cell.index()).expect("a column for each cell");
        assert_eq!(column.nnz(), n_faces, "{inside:?}");
        assert_close(&[volumes[cell.index()]], &[volume], 1e-6, &format!("{inside:?}"));
    }
}

#[test]
fn three_cubes_adjacency() {
    let a = three_cubes_arranged();
    let cells = cells_by_membership(&a);
    let row = |c: CellId| cells.iter().position(|&x| x == c).expect("every cell has a row") + 1;
    let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for f in (0..a.n_faces() as u32).map(FaceId) {
        let [i, j] = a.cells_of_face(f).map(row);
        *shared.entry((i.min(j), i.max(j))).or_default() += 1;
    }
    let text: Vec<String> = shared.iter().map(|((i, j), n)| format!("{i}-{j}:{n}")).collect();
    assert_eq!(text.join(" "), "1-2:6 1-5:8 1-6:7 2-7:3 2-8:2 3-4:3 3-5:3 3-6:5 4-7:1 4-8:3 5-7:3 6-8:3");
}

#[test]
fn three_cubes_fragments_of_input_faces() {
    let a = three_cubes_arranged();
    let mut fragments = [[0; 6]; 3];
    for f in (0..a.n_faces() as u32).map(FaceId) {
        let [parent] = a.parents(f) else { panic!("face {f} has {} parents", a.parents(f).len()) };
        fragments[parent.solid as usize][parent.face as usize] += 1;
    }
    assert_eq!(fragments, [[2, 4, 2, 6, 1, 4], [2, 1, 2, 2, 5, 1], [4, 1, 4, 1, 2, 3]]);
    for (solid, fragments) in fragments.iter().enumerate() {
        let rows = a.provenance(solid).to_csr();
        let nonzeros: Vec<usize> = rows.outer_iterator().map(|row| row.nnz()).collect();
        assert_eq!(nonzeros, fragments, "cube {solid}");
    }
}

/// Rows of [`THREE_CUBES`] whose union has that many boundary faces and that volume.
#[test]
fn three_cubes_booleans_by_membership() {
    let a = three_cubes_arranged();
    let volumes = a.volumes();
    let check = |select: fn([bool; 3]) -> bool, n_faces: usize, volume: f64| {
        let chosen = |c: CellId| select([0, 1, 2].map(|s| a.winding(c, s) != 0));
        let boundary = (0..a.n_faces() as u32)
            .filter(|&f| {
                let [front, back] = a.cells_of_face(FaceId(f)).map(chosen);
                front != back
            })
            .count();
        let total: f64 =
            (0..a.n_cells() as u32).map(CellId).filter(|&c| chosen(c)).map(|c| volumes[c.index()]).sum();
        assert_eq!(boundary, n_faces);
        assert_close(&[total], &[volume], 1e-6, "volume");
    };
    check(|[a, b, c]| a | b | c, 21, 2.484154);
    check(|[a, b, c]| a & b & c, 7, 0.059034);
    check(|[a, b, c]| a & !b & !c, 14, 0.597214);
}

/// The face of the first simplex that the second one's corner leaves through.
#[test]
fn simplices_have_one_triangular_hole() {
    let a = arranged(&surfaces(&pair(simplex(3), &[t(&[0.25; 3])], simplex(3))));
    let holed: Vec<Vec<usize>> = (0..a.n_faces() as u32)
        .map(|f| a.face_vertices(FaceId(f)).map(|l| l.len()).collect::<Vec<_>>())
        .filter(|sizes| sizes.len() > 1)
        .collect();
    assert_eq!(holed, [[3, 3]]);
}
