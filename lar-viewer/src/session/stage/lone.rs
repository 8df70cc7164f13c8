//! Edges in no face's boundary: lines of a drawing that enclose nothing.

use crate::scene::mean_curve_length;
use crate::{CellData, CellRef};
use std::collections::BTreeMap;

/// The lone edges in lists of those that hang together, by their first edges. O(size).
pub(super) fn lone_edges(data: &CellData) -> Vec<Vec<u32>> {
    let is_lone = |edge: u32| data.is_unit(CellRef { dim: 1, index: edge });
    let mut seen = vec![false; data.n_cells(1)];
    let mut lists = Vec::new();
    for first in (0..data.n_cells(1) as u32).filter(|&e| is_lone(e)) {
        if std::mem::replace(&mut seen[first as usize], true) {
            continue;
        }
        let (mut together, mut next) = (vec![first], 0);
        while let Some(&edge) = together.get(next) {
            next += 1;
            for beside in edges_beside(data, edge).filter(|&e| is_lone(e)) {
                if !std::mem::replace(&mut seen[beside as usize], true) {
                    together.push(beside);
                }
            }
        }
        lists.push(together);
    }
    lists
}

/// The edges at the ends of an edge, itself among them.
pub(super) fn edges_beside(data: &CellData, edge: u32) -> impl Iterator<Item = u32> {
    let ends = data.below(CellRef { dim: 1, index: edge });
    ends.into_iter().flat_map(|v| data.above(CellRef { dim: 0, index: v }))
}

/// For each lone edge the mean length of the curves that it and those it hangs together with make.
pub(super) fn curves(data: &CellData) -> BTreeMap<u32, f64> {
    let of_list = |edges: Vec<u32>| {
        let segments: Vec<_> = edges.iter().filter_map(|&e| data.segment(e)).collect();
        let length = mean_curve_length(&segments);
        edges.into_iter().map(move |edge| (edge, length))
    };
    lone_edges(data).into_iter().flat_map(of_list).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::{Cells, ChainComplex, Model, Points};

    /// Two strokes apart, one of two edges and one of three that meet.
    #[test]
    fn edges_that_hang_together_have_the_curves_of_all() {
        let points = Points::from_xyz(&[
            [0., 0., 0.],
            [1., 0., 0.],
            [3., 0., 0.],
            [0., 5., 0.],
            [4., 5., 0.],
            [0., 7., 0.],
            [0., 2., 0.],
        ]);
        let edges = [[0, 1], [1, 2], [3, 4], [3, 5], [3, 6]];
        let vertices = (0..7).map(|v| [v]);
        let model = Model::new(points, vec![Cells::from_iter(vertices), Cells::from_iter(edges)]);
        let data = CellData::new(ChainComplex::from_model(&model).unwrap()).unwrap();
        assert_eq!(lone_edges(&data), [vec![0, 1], vec![2, 3, 4]]);
        assert_eq!(curves(&data).into_values().collect::<Vec<_>>(), [3.0, 3.0, 3.0, 3.0, 3.0]);
    }
}
