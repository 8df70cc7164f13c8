//! The boundary of a model by counting: the facets that one highest cell alone has.

use crate::incidence::contained_cells;
use crate::product::skeletons;
use crate::{Cells, Model, ModelError};

impl Model {
    /// The (d − 1)-cells whose vertices all belong to exactly one d-cell, d being [`dim`](Self::dim): the
    /// boundary of a cuboidal, simplicial or other convex-celled complex of any dimension, in rising order.
    /// For cyclic faces the numbers are those of their sides in first-seen order, the edges of a
    /// [`ChainComplex::from_model`](crate::ChainComplex::from_model). Points bound nothing. O(n log n).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// let grid = lar_core::cuboid_grid(&[2, 1]);
    /// assert_eq!(grid.boundary_cells()?, [0, 2, 3, 4, 5, 6]);
    /// # Ok::<(), lar_core::ModelError>(())
    /// ```
    #[doc(alias = "boundary")]
    pub fn boundary_cells(&self) -> Result<Vec<u32>, ModelError> {
        self.check_well_formed()?;
        let skeletons = skeletons(self);
        let [.., facets, cells] = &skeletons[..] else { return Ok(Vec::new()) };
        let mut uses = vec![0_u32; facets.len()];
        for &facet in contained_cells(facets, cells, self.points().len()).indices() {
            uses[facet as usize] += 1;
        }
        Ok((0..).zip(uses).filter(|facet| facet.1 == 1).map(|facet| facet.0).collect())
    }

    /// The complex of the [boundary cells](Self::boundary_cells) and of all the model's cells that lie in
    /// them, each dimension in its old order. Points and their numbers stay; `cells(0)` keeps those in use.
    /// O(n log n).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// let shell = lar_core::cuboid_grid(&[3, 3, 3]).boundary()?;
    /// assert_eq!(shell.f_vector(), [56, 108, 54]);
    /// assert_eq!(shell.boundary()?.f_vector(), [0, 0]);
    /// # Ok::<(), lar_core::ModelError>(())
    /// ```
    pub fn boundary(&self) -> Result<Self, ModelError> {
        let ids = self.boundary_cells()?;
        let skeletons = skeletons(self);
        let [below @ .., facets, _] = &skeletons[..] else {
            return Ok(Self::new(self.points().clone(), Vec::new()));
        };
        let mut kept = vec![selected(facets, ids)];
        for cells in below.iter().rev() {
            let mut ids = contained_cells(cells, &kept[kept.len() - 1], self.points().len()).into_parts().1;
            ids.sort_unstable();
            ids.dedup();
            kept.push(selected(cells, ids));
        }
        kept.reverse();
        Ok(Self::new(self.points().clone(), kept))
    }
}

fn selected(cells: &Cells, ids: Vec<u32>) -> Cells {
    ids.into_iter().map(|i| &cells[i as usize]).collect()
}
