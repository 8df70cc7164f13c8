//! What the colours of cells mean.

use crate::{CellData, CellRef, ColorMap, Coloring, Rgb};
use serde::{Deserialize, Serialize};

/// What the colours of cells mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColorBy {
    /// Each cell its own colour, in turn.
    #[default]
    Cell,
    /// The first solid that contains the cell.
    Solid,
    /// The set of solids that contain the cell: its Boolean class.
    Class,
    /// Length, area or volume, from the least to the greatest of its dimension.
    Size,
    /// One colour for all.
    Plain,
}

/// Colour where a cell has none of the meaning's values, and of all cells when plain.
const PLAIN: Rgb = [0.80, 0.82, 0.85];

impl ColorBy {
    /// All meanings.
    pub const ALL: [Self; 5] = [Self::Cell, Self::Solid, Self::Class, Self::Size, Self::Plain];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cell => "cell",
            Self::Solid => "solid",
            Self::Class => "Boolean class",
            Self::Size => "size",
            Self::Plain => "plain",
        }
    }
}

/// The colours of all cells of a dimension.
pub(crate) fn colors(by: ColorBy, data: &CellData, dim: u8) -> Vec<Rgb> {
    let cells = (0..data.n_cells(dim) as u32).map(|index| CellRef { dim, index });
    match by {
        // The exterior takes no colour of the turn, so that cell 1 has the first.
        ColorBy::Cell => {
            let skipped = usize::from(data.has_exterior() && dim == data.dim());
            cells.map(|c| Coloring::Cyclic.color((c.index as usize).saturating_sub(skipped))).collect()
        }
        ColorBy::Solid => {
            let solid = |c: CellRef| {
                let of_face = data.parents(c).first().map(|p| p.solid);
                data.solids_of(c).first().copied().or(of_face)
            };
            cells.map(|c| solid(c).map_or(PLAIN, |s| Coloring::Cyclic.color(s as usize))).collect()
        }
        ColorBy::Class => {
            let mut classes: Vec<&[u32]> = cells.clone().map(|c| data.solids_of(c)).collect();
            classes.sort_unstable_by_key(|class| (class.len(), *class));
            classes.dedup();
            let first = usize::from(classes.first().is_some_and(|c| c.is_empty()));
            let class = |c: CellRef| {
                let of = data.solids_of(c);
                let at = classes.binary_search_by_key(&(of.len(), of), |class| (class.len(), *class));
                at.ok().and_then(|i| i.checked_sub(first))
            };
            cells.map(|c| class(c).map_or(PLAIN, |i| Coloring::Cyclic.color(i))).collect()
        }
        ColorBy::Size => {
            let sizes: Vec<f64> = cells.map(|c| data.measures(c).map_or(0.0, |m| m.size)).collect();
            let [low, high] = size_range(data, dim).unwrap_or([0.0, 1.0]);
            let scaled = |size: f64| if low < high { (size - low) / (high - low) } else { 0.5 };
            sizes.into_iter().map(|size| scale_color(scaled(size))).collect()
        }
        ColorBy::Plain => cells.map(|_| PLAIN).collect(),
    }
}

/// Least and greatest size of the cells of a dimension, the exterior aside; `None` without cells.
#[must_use]
pub fn size_range(data: &CellData, dim: u8) -> Option<[f64; 2]> {
    let cells = (0..data.n_cells(dim) as u32).map(|index| CellRef { dim, index });
    let sizes = cells.filter(|&c| !data.is_exterior(c)).filter_map(|c| Some(data.measures(c)?.size));
    sizes.map(|s| [s, s]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// The colour of a number from 0 to 1 on the sequential scale; numbers beyond count as the ends, NaN as 0.
///
/// ```
/// use lar_viewer::session::scale_color;
/// assert!(scale_color(1.0)[0] > scale_color(0.0)[0]);
/// ```
#[must_use]
pub fn scale_color(value: f64) -> Rgb {
    ColorMap::Sequential.color(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PALETTE, Provenance};
    use lar_core::{ChainComplex, cuboid_grid};

    fn bar() -> CellData {
        let bar = ChainComplex::from_model(&cuboid_grid(&[3, 1, 1])).unwrap().with_exterior().unwrap();
        let provenance = Provenance {
            solids: vec!["A".into(), "B".into()],
            parents_of_face: vec![],
            solids_of_cell: vec![vec![], vec![0], vec![0, 1], vec![1]],
        };
        CellData::new(bar).unwrap().with_exterior().with_provenance(provenance)
    }

    #[test]
    fn colors_mean_what_they_say() {
        let data = bar();
        let of = |by| colors(by, &data, 3);
        assert_eq!(of(ColorBy::Cell)[1..], PALETTE[1..4]);
        assert_eq!(of(ColorBy::Solid), [PLAIN, PALETTE[1], PALETTE[1], PALETTE[2]]);
        assert_eq!(of(ColorBy::Class), [PLAIN, PALETTE[1], PALETTE[3], PALETTE[2]]);
        assert_eq!(of(ColorBy::Size)[1..], [scale_color(0.5); 3]);
        assert_eq!(of(ColorBy::Plain), [PLAIN; 4]);
        assert_eq!(size_range(&data, 3), Some([1.0, 1.0]));
    }
}
