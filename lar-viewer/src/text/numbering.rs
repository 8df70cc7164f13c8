//! Numbering: labels that say which cell is which, in a colour for each dimension.

use super::{Label, TextStyle};
use crate::{CellRef, Drawable, GroupId, Rgb, Scene, ViewerError};

/// Colours of the numbers of vertices, edges, faces, cells: green, yellow, cyan, orange.
pub const NUMBER_COLORS: [Rgb; 4] =
    [[0.20, 0.80, 0.30], [1.00, 0.88, 0.15], [0.15, 0.85, 0.95], [1.00, 0.60, 0.10]];

/// Adds numbers of cells as labels that face the camera: for each its cell, whose index is written whatever part of a
/// complex is shown, where it stands, and the group that it moves with. They are drawn over everything when `on_top`, else
/// hidden by what lies before them. Cells of a group should come one after the other: each run of them is one drawable.
/// O(cells).
///
/// ```
/// use lar_viewer::{CellRef, Scene, TextStyle, push_numbers};
/// let mut scene = Scene::new();
/// let vertices = [[0.; 3], [1., 0., 0.]].into_iter().zip([4, 7]).map(|(p, i)| (CellRef::new(0, i), p, None));
/// push_numbers(&mut scene, vertices, &TextStyle::default(), true)?;
/// assert_eq!(scene.drawables()[0].n_elements(), 2);
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
///
/// # Errors
/// Those of [`Scene::push`].
#[doc(alias("GLNumbering", "numbering", "VIEWCELLS"))]
pub fn push_numbers(
    scene: &mut Scene,
    cells: impl IntoIterator<Item = (CellRef, [f64; 3], Option<GroupId>)>,
    style: &TextStyle,
    on_top: bool,
) -> Result<(), ViewerError> {
    let cells: Vec<_> = cells.into_iter().collect();
    for run in cells.chunk_by(|a, b| (a.0.dim, a.2) == (b.0.dim, b.2)) {
        let (first, _, group) = run[0];
        let dim = usize::from(first.dim).min(NUMBER_COLORS.len() - 1);
        let labels = run.iter().map(|(cell, at, _)| Label::new(cell.index.to_string(), *at));
        let names = ["vertex numbers", "edge numbers", "face numbers", "cell numbers"];
        let mut numbers = Drawable::labels(names[dim], labels)
            .text_style(*style)
            .color(NUMBER_COLORS[dim])
            .element_cells(run.iter().map(|(cell, _, _)| *cell));
        numbers.group = group;
        scene.push(if on_top { numbers.on_top() } else { numbers })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_global_and_colours_tell_the_dimension() {
        let mut scene = Scene::new();
        let group = scene.push_group([0.0; 3]).unwrap();
        let cells = [(0, 5, None), (0, 9, None), (3, 2, Some(group)), (3, 4, Some(group)), (3, 1, None)];
        let cells = cells.map(|(dim, i, g)| (CellRef::new(dim, i), [f64::from(i); 3], g));
        push_numbers(&mut scene, cells, &TextStyle::default(), false).unwrap();
        let found: Vec<_> =
            scene.drawables().iter().map(|d| (d.n_elements(), d.appearance().color)).collect();
        assert_eq!(found, [(2, NUMBER_COLORS[0]), (2, NUMBER_COLORS[3]), (1, NUMBER_COLORS[3])]);
        assert_eq!(scene.drawables()[0].cell_of_element(1), Some(CellRef::new(0, 9)));
        assert_eq!(scene.drawables()[1].group_id(), Some(group));
    }
}
