//! Whole complexes: faces, cells, meshes, boundary loops.

mod common;

use common::{Polygon, sieve, triangle_area};
use lar_core::{CellId, Cells, ChainComplex, FaceId, Operator, Points, TriangleMesh, VertexId, cuboid_grid};
use lar_triangle::{
    FaceLoops, TriangulateError, Triangulation, check_laws, triangulate, triangulate_cells, triangulate_face,
};

/// An operator from columns of (row, entry), in any order.
fn operator(rows: usize, columns: &[Vec<(u32, i8)>]) -> Operator {
    let sorted = columns.iter().map(|column| {
        let mut column = column.clone();
        column.sort_unstable();
        column
    });
    let sorted: Vec<Vec<(u32, i8)>> = sorted.collect();
    let cells: Cells = sorted.iter().map(|c| c.iter().map(|e| e.0).collect::<Vec<u32>>()).collect();
    ChainComplex::operator_from_columns(rows, cells, sorted.iter().flatten().map(|e| e.1).collect())
}

/// The complex of faces given by loops, and of cells given by signed faces.
fn complex(points: Points, faces: &[Vec<Vec<u32>>], cells: &[Vec<(u32, i8)>]) -> ChainComplex {
    let mut edges: Vec<(u32, u32)> = Vec::new();
    let mut columns = Vec::new();
    for face in faces {
        let mut column = Vec::new();
        for cycle in face {
            for (i, &from) in cycle.iter().enumerate() {
                let to = cycle[(i + 1) % cycle.len()];
                let edge = (from.min(to), from.max(to));
                let at = edges.iter().position(|&e| e == edge).unwrap_or_else(|| {
                    edges.push(edge);
                    edges.len() - 1
                });
                column.push((at as u32, if from < to { 1 } else { -1 }));
            }
        }
        columns.push(column);
    }
    let ends: Vec<Vec<(u32, i8)>> = edges.iter().map(|&(a, b)| vec![(a, -1), (b, 1)]).collect();
    let mut boundaries = vec![operator(points.len(), &ends), operator(edges.len(), &columns)];
    if !cells.is_empty() {
        boundaries.push(operator(faces.len(), cells));
    }
    ChainComplex::new(points, boundaries)
}

/// Two unit cubes on each other, the first rotated by `angle` about two axes with the second; cell 0 is the exterior.
fn two_cubes(angle: f64) -> ChainComplex {
    let (s, c) = angle.sin_cos();
    let place = |i: usize| {
        let (x, y, z) = ((i % 2) as f64, (i / 2 % 2) as f64, (i / 4) as f64);
        let (x, y) = (x * c - y * s, x * s + y * c);
        [x, y * c - z * s, y * s + z * c]
    };
    let points = Points::from_xyz(&(0..12).map(place).collect::<Vec<_>>());
    let mut faces = Vec::new();
    for level in [0, 4, 8] {
        faces.push(vec![vec![level, level + 1, level + 3, level + 2]]);
    }
    for base in [0, 4] {
        for [a, b] in [[0, 1], [1, 3], [3, 2], [2, 0]] {
            faces.push(vec![vec![base + a, base + b, base + b + 4, base + a + 4]]);
        }
    }
    let outer = |f: u32| if f == 0 { (f, 1) } else { (f, -1) };
    let exterior = [0, 2].into_iter().chain(3..11).map(outer).collect();
    let lower = [(0, -1), (1, 1), (3, 1), (4, 1), (5, 1), (6, 1)].to_vec();
    let upper = [(1, -1), (2, 1), (7, 1), (8, 1), (9, 1), (10, 1)].to_vec();
    complex(points, &faces, &[exterior, lower, upper])
}

fn volume(mesh: &TriangleMesh) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.points.xyz(i as usize));
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

#[track_caller]
fn check_faces(complex: &ChainComplex) -> Triangulation {
    let loops = FaceLoops::new(complex).expect("a complex");
    let all = triangulate(complex).expect("a complex");
    assert_eq!(all.n_faces(), complex.n_cells(2));
    assert_eq!(all.face_offsets.last().map(|&n| n as usize), Some(all.triangles.len()));
    for f in (0u32..).map(FaceId).take(all.n_faces()) {
        assert_eq!(check_laws(loops.face(f), all.face_triangles(f)), Ok(()));
        let mut smallest_first: Vec<Vec<u32>> = loops.face(f).map(<[u32]>::to_vec).collect();
        for cycle in &mut smallest_first {
            let least = (0..cycle.len()).min_by_key(|&i| cycle[i]).unwrap_or(0);
            cycle.rotate_left(least);
        }
        smallest_first.sort_unstable();
        assert_eq!(smallest_first, complex.face_loops(f.index()));
        let alone = triangulate_face(complex.points(), &loops.face(f).collect::<Vec<_>>());
        assert_eq!(alone.as_deref(), Ok(all.face_triangles(f)));
    }
    all
}

#[test]
fn cubes_in_any_position() {
    for angle in [0.0, 0.1, 1.0, 2.5, 100.0] {
        let cubes = two_cubes(angle);
        let all = check_faces(&cubes);
        assert_eq!((all.triangles.len(), all.fallbacks), (22, 0));
        for (c, expected, used) in [(0, -2.0, 12), (1, 1.0, 8), (2, 1.0, 8)] {
            let mesh = all.cell_mesh(&cubes, CellId(c)).expect("a cell");
            assert_eq!(mesh.points.len(), used);
            assert!((volume(&mesh) - expected).abs() < 1e-12, "cell {c}: {}", volume(&mesh));
        }
        let both = [0, 2].into_iter().chain(3..11).map(|f| (FaceId(f), if f == 0 { -1 } else { 1 }));
        let mesh = all.mesh_of_faces(cubes.points(), both).expect("faces");
        assert!((volume(&mesh) - 2.0).abs() < 1e-12);
    }
}

#[test]
fn triangles_by_cell_and_by_face() {
    let cubes = two_cubes(0.3);
    let by_cell = triangulate_cells(&cubes).expect("a 3D complex");
    assert_eq!(by_cell.n_cells(), 3);
    for c in (0..3).map(CellId) {
        let points = cubes.points().clone();
        let whole = TriangleMesh { points, triangles: by_cell.cell(c).to_vec() };
        let mesh = by_cell.faces.cell_mesh(&cubes, c).expect("a cell");
        assert!((volume(&whole) - volume(&mesh)).abs() < 1e-12);
        assert_eq!(whole.triangles.len(), mesh.triangles.len());
    }
    assert_eq!(by_cell.cell(CellId(3)), [[0; 3]; 0]);
    let edges: Vec<[u32; 2]> = by_cell.loops.face_edges(FaceId(0)).collect();
    assert_eq!(edges, [[0, 1], [1, 3], [3, 2], [2, 0]]);
}

#[test]
fn planar_faces_with_holes() {
    let plate = sieve(3);
    let mut faces = vec![plate.loops.clone()];
    faces.extend(plate.loops[1..].iter().map(|hole| vec![hole.iter().rev().copied().collect()]));
    let plate_complex = complex(plate.points(), &faces, &[]);
    let all = check_faces(&plate_complex);
    let area = |f: u32| -> f64 {
        all.face_triangles(FaceId(f)).iter().map(|&t| triangle_area(plate_complex.points(), t)).sum()
    };
    assert!((area(0) - 40.0).abs() < 1e-9);
    assert!((1..10).all(|f| (area(f) - 1.0).abs() < 1e-12));
    let mesh = all.mesh_of_faces(plate_complex.points(), [(FaceId(4), 1)]).expect("a face");
    assert_eq!((mesh.points.dim(), mesh.points.len(), mesh.triangles.len()), (3, 4, 2));
}

/// ```text
///        +---5
///        |  /
///  2-----3-4      Square and triangle touch in vertex 3.
///  |     |
///  0-----1
/// ```
#[test]
fn a_boundary_that_visits_a_vertex_twice_is_cut_there() {
    let polygon = Polygon {
        xy: vec![[0., 0.], [2., 0.], [0., 2.], [2., 2.], [3., 1.], [3., 3.]],
        loops: vec![vec![0, 1, 3, 4, 5, 3, 2]],
    };
    let complex = complex(polygon.points(), std::slice::from_ref(&polygon.loops), &[]);
    let loops = FaceLoops::new(&complex).expect("a complex");
    let found: Vec<&[u32]> = loops.face(FaceId(0)).collect();
    assert_eq!(found, [&[0, 1, 3, 2][..], &[3, 4, 5]]);
    assert_eq!(loops.face(FaceId(1)).len(), 0);
}

#[test]
fn malformed_complexes() {
    let points = || Points::from_xyz(&[[0.; 3], [1., 0., 0.], [0., 1., 0.]]);
    let edges = || operator(3, &[vec![(0, -1), (1, 1)], vec![(1, -1), (2, 1)], vec![(0, -1), (2, 1)]]);
    let refused = |boundaries| triangulate(&ChainComplex::new(points(), boundaries)).expect_err("malformed");
    assert_eq!(refused(vec![edges()]), TriangulateError::ComplexDimension { dim: 1, needed: 2 });
    let shape = refused(vec![edges(), operator(2, &[])]);
    assert_eq!(shape, TriangulateError::Shape { p: 2, rows: 2, cells: 3 });
    let open = refused(vec![edges(), operator(3, &[vec![(0, 1), (1, 1)]])]);
    let expected =
        TriangulateError::OpenFace { face: FaceId(0), vertex: VertexId(0), entering: 0, leaving: 1 };
    assert_eq!(open, expected);
    let bad_edge = refused(vec![operator(3, &[vec![(0, 1), (1, 1)]]), operator(1, &[])]);
    assert_eq!(
        bad_edge.to_string(),
        "e0: its column of boundary 1 has the entries [(0, 1), (1, 1)], not one -1 and one +1"
    );

    let triangle = ChainComplex::new(points(), vec![edges(), operator(3, &[vec![(0, 1), (1, 1), (2, -1)]])]);
    let all = triangulate(&triangle).expect("one triangle");
    assert_eq!(all.triangles, [[0, 1, 2]]);
    assert_eq!(
        all.cell_mesh(&triangle, CellId(0)).expect_err("2D"),
        TriangulateError::ComplexDimension { dim: 2, needed: 3 }
    );
    let face = FaceId(1);
    let error = all.mesh_of_faces(triangle.points(), [(face, 1)]).expect_err("no such face");
    assert_eq!(error, TriangulateError::NoSuchFace { face, faces: 1 });
    let cubes = two_cubes(0.0);
    let error = triangulate(&cubes).expect("cubes").cell_mesh(&cubes, CellId(3)).expect_err("no such cell");
    assert_eq!(error, TriangulateError::NoSuchCell { cell: CellId(3), cells: 3 });
}

/// What a closure returns on one thread, which it returns on two and three, too.
#[cfg(feature = "rayon")]
fn on_any_number_of_threads<R: PartialEq + std::fmt::Debug + Send>(f: impl Fn() -> R + Sync) -> R {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("there are threads");
        pool.install(&f)
    };
    let one = on(1);
    (2..=3).for_each(|threads| assert_eq!(on(threads), one, "{threads} threads"));
    one
}

#[cfg(feature = "rayon")]
#[test]
fn threads_change_nothing() {
    let grid = ChainComplex::from_model(&cuboid_grid(&[11, 12, 13])).expect("a grid is a complex");
    let cells = on_any_number_of_threads(|| triangulate_cells(&grid)).expect("its faces are squares");
    assert_eq!((cells.n_cells(), cells.faces.n_faces()), (1716, 5579));
    assert!((0..1716).all(|c| cells.cell(CellId(c)).len() == 12));
    // Of two faces that do not close the first one is named.
    let mut faces = grid.boundary(2).clone();
    for face in [3000, 700] {
        faces.data_mut()[4 * face] *= -1;
    }
    let broken = ChainComplex::new(grid.points().clone(), vec![grid.boundary(1).clone(), faces]);
    let error = on_any_number_of_threads(|| triangulate(&broken)).expect_err("two faces are open");
    assert!(matches!(error, TriangulateError::OpenFace { face: FaceId(700), .. }), "{error}");
}
