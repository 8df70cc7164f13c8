//! Entries of boundary operators are −1, 0 or +1.

use super::Violation;
use crate::ChainComplex;

pub(super) fn check(complex: &ChainComplex, found: &mut Vec<Violation>) {
    for p in 1..=complex.dim() {
        for (column, cell) in (0..).zip(complex.boundary(p).outer_iterator()) {
            for (&row, &value) in cell.indices().iter().zip(cell.data()) {
                if !(-1..=1).contains(&value) {
                    found.push(Violation::Entry { p, row, column, value });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{bar, check, with_entry};

    #[test]
    fn none_and_one() {
        check(super::check, &bar(), &[]);
        let expected = ["entry (0, 0) of ∂3 is -2; entries are -1, 0 or 1"];
        check(super::check, &with_entry(&bar(), 3, 0, -2), &expected);
    }
}
