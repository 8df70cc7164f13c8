//! Tables for the terminal: the operator ∂3 by cells, and the truth table of the input solids.

use lar_arrangement::Arrangement;
use lar_core::CellId;
use std::fmt::Write;

/// ∂3 transposed: a row for each cell, the exterior first, and a column for each face; `+` where the normal of the
/// face points out of the cell, `-` where it points in, `.` elsewhere. Columns stand in groups of ten.
///
/// ```
/// use lar_examples::{scenes, tables};
/// let arrangement = lar_arrangement::arrange(&scenes::surfaces(&scenes::nested_cubes())?)?;
/// let table = tables::boundary_3(&arrangement);
/// assert_eq!(table.lines().next(), Some("c0  ------.... .."));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn boundary_3(arrangement: &Arrangement) -> String {
    let mut text = String::new();
    let width = label(arrangement.n_cells().saturating_sub(1)).len();
    for (cell, column) in arrangement.complex().boundary(3).outer_iterator().enumerate() {
        let mut row = vec!['.'; arrangement.n_faces()];
        for (face, &sign) in column.iter() {
            row[face] = if sign > 0 { '+' } else { '-' };
        }
        let groups: Vec<String> = row.chunks(10).map(|group| group.iter().collect()).collect();
        push(&mut text, format_args!("{:<width$}  {}\n", label(cell), groups.join(" ")));
    }
    text
}

/// A row for each of the first `limit` cells: whether it lies inside each solid (its winding number is not zero),
/// the number of its faces, its volume. The exterior's volume is minus the sum of the others.
#[must_use]
pub fn truth_table(arrangement: &Arrangement, limit: usize) -> String {
    let names: Vec<&str> = (0..arrangement.n_solids()).map(|s| arrangement.solid_name(s)).collect();
    let mut text = String::new();
    push(&mut text, format_args!("{:<6}{}  {:>5}  {:>14}\n", "cell", names.join(" "), "faces", "volume"));
    let volumes = arrangement.volumes();
    for (cell, (column, volume)) in
        arrangement.complex().boundary(3).outer_iterator().zip(&volumes).take(limit).enumerate()
    {
        let bits: Vec<String> = inside(arrangement, cell)
            .zip(&names)
            .map(|(bit, name)| format!("{bit:<width$}", width = name.chars().count()))
            .collect();
        let row = format_args!("{:<6}{}  {:>5}  {volume:>14.6}\n", label(cell), bits.join(" "), column.nnz());
        push(&mut text, row);
    }
    if limit < volumes.len() {
        push(&mut text, format_args!("… and {} more cells\n", volumes.len() - limit));
    }
    text
}

/// 1 for each solid in which the cell lies by the rule that a winding number other than zero is inside, else 0.
pub fn inside(arrangement: &Arrangement, cell: usize) -> impl Iterator<Item = u8> + '_ {
    let cell = CellId(u32::try_from(cell).unwrap_or(u32::MAX));
    (0..arrangement.n_solids()).map(move |solid| u8::from(arrangement.winding(cell, solid) != 0))
}

fn label(cell: usize) -> String {
    format!("c{cell}")
}

fn push(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    text.write_fmt(arguments).expect("a string takes all text");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes;
    use lar_arrangement::arrange;

    #[test]
    fn tables_of_the_three_cubes() {
        let arrangement = arrange(&scenes::surfaces(&scenes::three_cubes()).unwrap()).unwrap();
        let text = format!("{}\n{}", boundary_3(&arrangement), truth_table(&arrangement, usize::MAX));
        insta::assert_snapshot!(text);
        assert!(truth_table(&arrangement, 3).ends_with("… and 5 more cells\n"));
    }
}
