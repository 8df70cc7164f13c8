//! What is told of the cells of a grid.

use super::*;
use lar_core::{Points, cuboid_grid};
use proptest::prelude::*;

fn grid() -> CellData {
    let grid = ChainComplex::from_model(&cuboid_grid(&[2, 2, 1])).unwrap();
    CellData::new(grid.with_exterior().unwrap()).unwrap().with_exterior()
}

fn cell(dim: u8, index: u32) -> CellRef {
    CellRef { dim, index }
}

#[test]
fn measures_and_exterior() {
    let data = grid();
    let exterior = data.measures(cell(3, 0)).unwrap().size;
    assert!((exterior - 4.0).abs() < 1e-12, "the exterior, counted positive: {exterior}");
    let first = data.measures(cell(3, 1)).unwrap();
    assert!((first.size - 1.0).abs() < 1e-12, "{first:?}");
    assert!(first.centroid.unwrap().iter().all(|x| (x - 0.5).abs() < 1e-12), "{first:?}");
    assert_eq!(data.measures(cell(3, 5)), None);
    assert!(data.is_exterior(cell(3, 0)) && !data.is_exterior(cell(2, 0)) && !data.is_exterior(cell(3, 1)));
}

#[test]
fn a_face_lies_between_two_cells_and_four_edges() {
    let data = grid();
    for f in 0..data.n_cells(2) as u32 {
        let up = data.coboundary(cell(2, f)).unwrap();
        let signs: Vec<i32> = up.entries().iter().map(|e| e.1).collect();
        assert_eq!((signs.len(), signs.iter().sum::<i32>()), (2, 0), "face {f}");
        assert_eq!(data.boundary(cell(2, f)).unwrap().entries().len(), 4);
    }
    assert!(data.coboundary(cell(3, 0)).unwrap().is_zero());
    assert!(data.boundary(cell(0, 0)).unwrap().is_zero());
    assert_eq!(data.boundary(cell(2, 99)), None);
}

proptest! {
    #[test]
    fn coboundaries_are_those_of_the_complex(terms in prop::collection::vec((0..33_u32, -3..4), 0..9), dim in 0..4_usize) {
        let data = grid();
        let n = data.complex().n_cells(dim) as u32;
        let chain = data.complex().chain(dim, terms.into_iter().map(|(c, x)| (c % n, x))).unwrap();
        let up = data.coboundary_of(&chain).unwrap();
        prop_assert_eq!(&up, &data.complex().coboundary_of(&chain).unwrap());
        prop_assert!(data.coboundary_of(&up).unwrap().is_zero());
    }
}

#[test]
fn closures_hold_all_faces() {
    let closure = grid().closure([cell(3, 1)]);
    assert_eq!(closure.iter().map(Vec::len).collect::<Vec<_>>(), [8, 12, 6, 1]);
    let mixed = grid().closure([cell(1, 0), cell(0, 17), cell(3, 77)]);
    assert_eq!(mixed.iter().map(Vec::len).collect::<Vec<_>>(), [3, 1, 0, 0]);
}

#[test]
fn units_are_cells_in_no_boundary() {
    let data = grid();
    assert_eq!(data.units(), (0..5).map(|i| cell(3, i)).collect::<Vec<_>>());
    assert_eq!(data.units_of(cell(3, 2)), [cell(3, 2)]);
    assert_eq!(data.units_of(cell(0, 0)), [cell(3, 0), cell(3, 1)], "a corner: the exterior and one cell");
    assert_eq!(data.units_of(cell(0, 99)), []);
    assert_eq!((data.cells_above(cell(0, 0), 2).len(), data.cells_above(cell(2, 5), 2)), (3, vec![5]));
    // A triangle without ∂2: three lone edges.
    let edges = lar_core::Cells::uniform(2, vec![0, 1, 1, 2, 0, 2]);
    let d1 = ChainComplex::operator_from_columns(3, edges, vec![-1, 1, -1, 1, -1, 1]);
    let points = Points::from_xyz(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
    let outline = CellData::new(ChainComplex::new(points, vec![d1])).unwrap();
    assert_eq!(outline.units(), [cell(1, 0), cell(1, 1), cell(1, 2)]);
    assert_eq!(outline.segment(1), Some([[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]));
    assert_eq!(outline.middle(cell(1, 2)), [0.0, 2.0, 0.0]);
}

#[test]
fn triangles_belong_to_faces() {
    let data = grid().with_triangles(vec![[0, 1, 2], [1, 2, 3], [4, 5, 6]], vec![0, 2, 3]).unwrap();
    assert_eq!(data.triangles(0), [[0, 1, 2], [1, 2, 3]]);
    assert_eq!(data.triangles(1), [[4, 5, 6]]);
    assert!(data.triangles(2).is_empty());
    let error = grid().with_triangles(vec![[0, 1, 18]], vec![0, 1]).unwrap_err().to_string();
    assert_eq!(error, "drawable \"complex\": triangle 0 names point 18, but there are 18 points");
}

#[test]
fn provenance_without_dangling_solids() {
    let provenance = Provenance {
        solids: vec!["A".into()],
        parents_of_face: vec![vec![
            FaceParent { solid: 0, face: 3, sign: -1 },
            FaceParent { solid: 1, face: 0, sign: 1 },
        ]],
        solids_of_cell: vec![vec![], vec![0], vec![0, 1]],
    };
    let data = grid().with_provenance(provenance);
    assert_eq!(data.cells_of_solid(0), [cell(3, 1), cell(3, 2)]);
    assert_eq!(data.solids_of(cell(3, 2)), [0]);
    assert_eq!(data.parents(cell(2, 0)), [FaceParent { solid: 0, face: 3, sign: -1 }]);
    assert_eq!((data.parents(cell(3, 0)), data.solids_of(cell(2, 1))), (&[][..], &[][..]));
}

#[track_caller]
fn check_find(text: &str, expected: Result<CellRef, &str>) {
    assert_eq!(grid().find(text, 3).map_err(|e| e.to_string()), expected.map_err(str::to_owned));
}

#[test]
fn cells_by_name() {
    check_find("v17", Ok(cell(0, 17)));
    check_find(" F 3 ", Ok(cell(2, 3)));
    check_find("2", Ok(cell(3, 2)));
    check_find("c5", Err("there is no c5; there are 5 of that dimension"));
    check_find("", Err("\"\" names no cell; cells are v0, e0, f0, c0 and so on"));
    check_find("é1", Err("\"é1\" names no cell; cells are v0, e0, f0, c0 and so on"));
    check_find("f-1", Err("\"f-1\" names no cell; cells are v0, e0, f0, c0 and so on"));
}

#[test]
fn vertices_that_are_not_numbers_are_named() {
    let points = Points::from_xyz(&[[0.0; 3], [0.0, f64::NAN, 0.0]]);
    let error = CellData::new(ChainComplex::new(points, vec![])).unwrap_err().to_string();
    assert_eq!(error, "drawable \"complex\": coordinate y of vertex 1 is NaN; it must lie within ±1e100");
    let edges = lar_core::Cells::uniform(2, vec![0, 5]);
    let open = ChainComplex::operator_from_columns(6, edges, vec![-1, 1]);
    let error = CellData::new(ChainComplex::new(Points::from_xyz(&[[0.0; 3]]), vec![open])).unwrap_err();
    assert!(error.to_string().starts_with("not a chain complex: "), "{error}");
}
