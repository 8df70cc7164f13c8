//! ∂p has one row for each (p−1)-cell and is stored by columns.

use super::Violation;
use crate::ChainComplex;

pub(super) fn check(complex: &ChainComplex, found: &mut Vec<Violation>) {
    for p in 1..=complex.dim() {
        let operator = complex.boundary(p);
        if !operator.is_csc() {
            found.push(Violation::Storage { p });
        }
        let (rows, cells) = (operator.rows(), complex.n_cells(p - 1));
        if rows != cells {
            found.push(Violation::Shape { p, rows, cells });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{bar, check, with_boundary, with_points};
    use crate::Points;

    #[test]
    fn none_and_one_of_each() {
        check(super::check, &bar(), &[]);
        let few = with_points(&bar(), Points::new(3));
        check(super::check, &few, &["∂1 has 12 rows, but there are 0 0-cells"]);
        let by_rows = bar().boundary(2).to_csr();
        let expected = ["∂2 is stored by rows; boundary operators are stored by columns"];
        check(super::check, &with_boundary(&bar(), 2, by_rows), &expected);
    }
}
