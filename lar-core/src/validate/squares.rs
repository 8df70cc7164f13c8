//! The boundary of a boundary is zero: ∂p−1 · ∂p = 0.

use super::Violation;
use crate::ChainComplex;

pub(super) fn check(complex: &ChainComplex, found: &mut Vec<Violation>) {
    for p in 2..=complex.dim() {
        let below = complex.boundary(p - 1);
        for (column, cell) in (0..).zip(complex.boundary(p).outer_iterator()) {
            let mut terms: Vec<(u32, i64)> = Vec::new();
            for (face, &sign) in cell.iter() {
                let boundary = below.outer_view(face);
                let rows = boundary.iter().flat_map(|b| b.indices().iter().zip(b.data()));
                terms.extend(rows.map(|(&row, &entry)| (row, i64::from(sign) * i64::from(entry))));
            }
            terms.sort_unstable();
            for same in terms.chunk_by(|a, b| a.0 == b.0) {
                let value = same.iter().map(|term| term.1).sum();
                if value != 0 {
                    found.push(Violation::Square { p, row: same[0].0, column, value });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{bar, check, with_boundary, with_entry};
    use crate::complex::sign_columns;

    #[test]
    fn none_and_one() {
        check(super::check, &bar(), &[]);
        let open = sign_columns(20, std::iter::once([(0, 1)]));
        let short =
            with_boundary(&with_boundary(&bar(), 2, open), 3, sign_columns(1, std::iter::empty::<[_; 0]>()));
        check(super::check, &short, &["∂1·∂2 is -1 at (0, 0), not 0", "∂1·∂2 is 1 at (1, 0), not 0"]);
    }

    #[test]
    fn a_flipped_face_opens_its_cell() {
        let mut found = Vec::new();
        super::check(&with_entry(&bar(), 3, 0, 0), &mut found);
        assert_eq!(found.len(), 4);
    }
}
