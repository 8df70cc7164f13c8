//! Sides: a (d−1)-cell of a complex in d-space has at most one d-cell on each side, and exactly one where the
//! exterior is a cell, unless the same cell lies on both sides (the row is then empty).

use super::Violation;
use crate::ChainComplex;

/// At most one entry of each sign in a row of ∂d. Only for d-cells in d-space: a surface in 3-space may have
/// edges of many faces.
pub(super) fn check_sides(complex: &ChainComplex, found: &mut Vec<Violation>) {
    let p = complex.dim();
    if p < 2 || p != complex.points().dim() {
        return;
    }
    for (row, entries) in rows(complex, p) {
        let count = |sign: i8| entries.iter().filter(|e| e.1.signum() == sign).count();
        if count(1) > 1 || count(-1) > 1 {
            found.push(Violation::Sides { p, row, entries });
        }
    }
}

/// Each row of ∂d sums to zero.
pub(super) fn check_sums(complex: &ChainComplex, found: &mut Vec<Violation>) {
    let p = complex.dim();
    if p < 2 {
        return;
    }
    for (row, entries) in rows(complex, p) {
        if entries.iter().map(|e| i64::from(e.1)).sum::<i64>() != 0 {
            found.push(Violation::OneSided { p, row, entries });
        }
    }
}

/// The rows of ∂p that have entries other than zero.
fn rows(complex: &ChainComplex, p: usize) -> Vec<(u32, Vec<(u32, i8)>)> {
    let by_rows = complex.boundary(p).to_csr();
    let nonzero = |row: sprs::CsVecViewI<'_, i8, u32>| -> Vec<(u32, i8)> {
        row.indices().iter().copied().zip(row.data().iter().copied()).filter(|e| e.1 != 0).collect()
    };
    (0..).zip(by_rows.outer_iterator().map(nonzero)).filter(|(_, entries)| !entries.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{bar, check, with_boundary, with_entry};
    use crate::{ChainComplex, cuboid_grid};

    #[test]
    fn none_and_one() {
        check(super::check_sides, &bar(), &[]);
        check(super::check_sums, &bar(), &[]);
        let one_side = with_entry(&bar(), 3, 0, 0);
        check(super::check_sides, &one_side, &[]);
        let row = "row 0 of ∂3 has entries 1 at 1";
        check(super::check_sums, &one_side, &[&*format!("{row}; with an exterior cell a row sums to 0")]);
        let same_side = with_entry(&bar(), 3, 0, 1);
        let row = "row 0 of ∂3 has entries 1 at 0, 1 at 1";
        check(
            super::check_sides,
            &same_side,
            &[&*format!("{row}; a cell has at most one cell on each side")],
        );
        check(super::check_sums, &same_side, &[&*format!("{row}; with an exterior cell a row sums to 0")]);
    }

    #[test]
    fn dangling_faces_have_empty_rows() {
        let sheet = with_boundary(&bar(), 3, bar().boundary(3).map(|_| 0));
        check(super::check_sides, &sheet, &[]);
        check(super::check_sums, &sheet, &[]);
    }

    #[test]
    fn surfaces_in_space_may_branch() {
        let bar = ChainComplex::from_model(&cuboid_grid(&[2, 1, 1])).unwrap();
        let shell =
            ChainComplex::new(bar.points().clone(), vec![bar.boundary(1).clone(), bar.boundary(2).clone()]);
        check(super::check_sides, &shell, &[]);
    }
}
