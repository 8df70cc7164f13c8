//! The column of an edge has −1 at its smaller vertex, +1 at its larger, and nothing else.

use super::Violation;
use crate::{ChainComplex, EdgeId, VertexId};

pub(super) fn check(complex: &ChainComplex, found: &mut Vec<Violation>) {
    if complex.dim() == 0 {
        return;
    }
    for (edge, column) in (0..).map(EdgeId).zip(complex.boundary(1).outer_iterator()) {
        if column.data() != [-1, 1] {
            let vertices = column.indices().iter().map(|&v| VertexId(v));
            let entries = vertices.zip(column.data().iter().copied()).collect();
            found.push(Violation::Edge { edge, entries });
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
        let law = "an edge has -1 at its smaller vertex and 1 at its larger";
        let expected = [&*format!("edge e0 has entries 1 at v0, 1 at v1; {law}")];
        check(super::check, &with_entry(&bar(), 1, 0, 1), &expected);
        let loose = sign_columns(12, [vec![], vec![(3, -1)]].into_iter());
        let expected =
            [&*format!("edge e0 has entries none; {law}"), &*format!("edge e1 has entries -1 at v3; {law}")];
        check(super::check, &with_boundary(&bar(), 1, loose), &expected);
    }
}
