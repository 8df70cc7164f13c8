//! Heights of the faces of a partition of the plane when it is pulled apart along z.

use super::lone::{edges_beside, lone_edges};
use crate::{Bounds, CellData, CellRef};
use std::collections::VecDeque;

/// Height of the highest faces when the factor is 2, in parts of the diagonal of the box around everything.
const HIGHEST: f64 = 0.35;

/// How far each unit is lifted: a face in proportion to the number of edges between it and the exterior, a lone edge like
/// the highest face at the ends of the lone edges that it hangs together with. All 0 where there is no plane with an
/// exterior. O(size).
pub(super) fn lifts(data: &CellData, units: &[CellRef]) -> Vec<f64> {
    if data.complex().points().dim() != 2 || data.dim() != 2 || !data.has_exterior() {
        return vec![0.0; units.len()];
    }
    let depths = depths(data);
    let highest = depths.iter().copied().max().unwrap_or(0).max(1);
    let points = (0..data.n_cells(0) as u32).filter_map(|v| data.position(v));
    let diagonal = Bounds::of(points).map_or(0.0, |b| 2.0 * b.radius());
    let height = |depth: u32| HIGHEST * diagonal * f64::from(depth) / f64::from(highest);
    let of_edge = depths_of_lone_edges(data, &depths);
    let of_unit = |unit: &CellRef| match unit.dim {
        2 => height(depths[unit.index as usize]),
        1 => height(of_edge[unit.index as usize]),
        _ => 0.0,
    };
    units.iter().map(of_unit).collect()
}

/// For each face the number of edges between it and face 0, the exterior.
fn depths(data: &CellData) -> Vec<u32> {
    let mut depths = vec![u32::MAX; data.n_cells(2)];
    let mut queue = VecDeque::new();
    if let Some(exterior) = depths.first_mut() {
        *exterior = 0;
        queue.push_back(0);
    }
    while let Some(face) = queue.pop_front() {
        for edge in data.below(CellRef { dim: 2, index: face }) {
            for beside in data.above(CellRef { dim: 1, index: edge }) {
                if depths[beside as usize] == u32::MAX {
                    depths[beside as usize] = depths[face as usize] + 1;
                    queue.push_back(beside);
                }
            }
        }
    }
    // Faces that no path of edges leads to stay on the ground.
    depths.into_iter().map(|d| if d == u32::MAX { 0 } else { d }).collect()
}

/// For each edge in no face's boundary the depth of the deepest face at those that it hangs together with.
fn depths_of_lone_edges(data: &CellData, depths: &[u32]) -> Vec<u32> {
    let mut found = vec![0; data.n_cells(1)];
    for together in lone_edges(data) {
        let beside = together.iter().flat_map(|&edge| edges_beside(data, edge));
        let faces = beside.flat_map(|edge| data.above(CellRef { dim: 1, index: edge }));
        let deepest = faces.map(|f| depths[f as usize]).max().unwrap_or(0);
        together.into_iter().for_each(|edge| found[edge as usize] = deepest);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::{ChainComplex, cuboid_grid};

    /// Three by three squares: the one in the middle is two edges away from the exterior.
    #[test]
    fn faces_rise_with_their_distance_from_the_exterior() {
        let grid = ChainComplex::from_model(&cuboid_grid(&[3, 3])).unwrap().with_exterior().unwrap();
        let data = CellData::new(grid).unwrap().with_exterior();
        let units = data.units();
        let lifts = lifts(&data, &units);
        let of = |index: u32| lifts[units.iter().position(|u| *u == CellRef::new(2, index)).unwrap()];
        let unit = HIGHEST * 18.0_f64.sqrt() / 2.0;
        let expected = [0.0, unit, unit, unit, unit, 2.0 * unit, unit, unit, unit, unit];
        assert!((0..10).all(|f| (of(f) - expected[f as usize]).abs() < 1e-12), "{lifts:?}");
        let space = CellData::new(ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap()).unwrap();
        assert_eq!(super::lifts(&space, &space.units()), [0.0; 2]);
    }
}
