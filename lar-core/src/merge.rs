//! Complexes with vertices merged: seams glued, sides collapsed, equal points welded.
//!
//! A cell of a glued complex is the set of the images of its vertices. A cell that becomes the same set as an
//! earlier cell of its dimension is dropped, and so is one that loses dimension: fewer than p + 1 vertices
//! are left of a p-cell, or its vertices have become those of a cell of lower dimension. Cyclic faces keep
//! their direction: consecutive equal vertices become one, and only equal cycles of equal direction count as
//! the same.

use crate::{Cells, Model, ModelError, Points};
use std::cmp::Ordering;

impl Model {
    /// The model with vertices of exactly equal coordinates merged into the first of them (0 and −0 are
    /// equal), vertices keeping their order. Cells that become equal are kept once, cells that lose dimension
    /// are dropped; opposite cyclic faces are both kept. No tolerance: points that differ in one bit stay
    /// apart. O(n log n).
    ///
    /// # Errors
    /// When the model is malformed.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, t};
    /// let cube = cuboid_grid(&[1, 1, 1]);
    /// let two = Struct::new("two").with(cube.clone()).with(t(&[1., 0., 0.])).with(cube).struct2lar()?;
    /// assert_eq!(two.f_vector(), [16, 24, 12, 2]);
    /// assert_eq!(two.welded()?.f_vector(), [12, 20, 11, 2]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias = "removeDups")]
    #[doc(alias = "simplifyCells")]
    pub fn welded(&self) -> Result<Self, ModelError> {
        self.check_well_formed()?;
        let first = first_of_equals(self.points());
        let (new_from_old, kept) = renumbered(&first);
        let mut coords = Vec::with_capacity(kept.len() * self.points().dim());
        for &old in &kept {
            coords.extend_from_slice(self.points().point(old as usize));
        }
        let points = Points::from_columns(self.points().dim(), coords);
        let cells: Vec<&Cells> = (0..self.f_vector().len()).map(|p| self.cells(p)).collect();
        Ok(Self::new(points, merged(&cells, &new_from_old)))
    }
}

/// Per point the first point with equal coordinates.
fn first_of_equals(points: &Points) -> Vec<u32> {
    let at = |i: u32| points.point(i as usize);
    let order = |a: u32, b: u32| {
        let differs = |(x, y): (&f64, &f64)| Some((x + 0.).total_cmp(&(y + 0.))).filter(|o| o.is_ne());
        at(a).iter().zip(at(b)).find_map(differs).unwrap_or(Ordering::Equal)
    };
    let mut sorted: Vec<u32> = (0..).take(points.len()).collect();
    sorted.sort_unstable_by(|&a, &b| order(a, b).then(a.cmp(&b)));
    let mut first = vec![0; points.len()];
    for equal in sorted.chunk_by(|&a, &b| order(a, b).is_eq()) {
        for &i in equal {
            first[i as usize] = equal[0];
        }
    }
    first
}

/// From the representative of each vertex (its own for a representative): the new number of each vertex, and
/// the representatives in the order of their new numbers, which is that of their old ones.
pub(crate) fn renumbered(representative: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let kept: Vec<u32> = (0..).zip(representative).filter(|r| r.0 == *r.1).map(|r| r.0).collect();
    let mut new_from_old = vec![0; representative.len()];
    for (new, &old) in (0..).zip(&kept) {
        new_from_old[old as usize] = new;
    }
    let new_from_old = representative.iter().map(|&r| new_from_old[r as usize]).collect();
    (new_from_old, kept)
}

/// The cells, by dimension, over the new vertices. Without 1-cells, 2-cells are cyclic. O(n log n).
pub(crate) fn merged(cells: &[&Cells], new_from_old: &[u32]) -> Vec<Cells> {
    let cyclic = cells.len() > 2 && cells[1].is_empty();
    let mut all: Vec<Cells> = Vec::with_capacity(cells.len());
    let mut lower: Vec<Keys> = Vec::new();
    for (p, cells) in cells.iter().enumerate() {
        let kind = if cyclic && p == 2 { Kind::Cycle } else { Kind::Set };
        let (images, shrunk) = images(cells, new_from_old, kind);
        let keys = Keys::new(&images, kind);
        let keep = |i: usize| {
            let vertices = &images[i];
            let whole = !shrunk[i] || !lower.iter().any(|k| k.contains(&keys.keys[i]));
            vertices.len() > p && whole && keys.first_with_key(i)
        };
        let kept: Cells = (0..images.len()).filter(|&i| keep(i)).map(|i| &images[i]).collect();
        if kind == Kind::Set {
            lower.push(if kept.len() == images.len() { keys } else { Keys::new(&kept, kind) });
        }
        all.push(kept);
    }
    all
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Set,
    Cycle,
}

/// Each cell over the new vertices without repetitions, and whether it lost vertices.
fn images(cells: &Cells, new_from_old: &[u32], kind: Kind) -> (Cells, Vec<bool>) {
    let mut images = Cells::with_capacity(cells.len(), cells.indices().len());
    let mut shrunk = Vec::with_capacity(cells.len());
    let mut image: Vec<u32> = Vec::new();
    for cell in cells.iter() {
        image.clear();
        for new in cell.iter().map(|&v| new_from_old[v as usize]) {
            let repeated = match kind {
                Kind::Set => image.contains(&new),
                Kind::Cycle => image.last() == Some(&new),
            };
            if !repeated {
                image.push(new);
            }
        }
        while kind == Kind::Cycle && image.len() > 1 && image.first() == image.last() {
            image.pop();
        }
        shrunk.push(image.len() < cell.len());
        images.push(&image);
    }
    (images, shrunk)
}

/// What tells cells apart: their vertices in rising order, or for cycles from the smallest on.
struct Keys {
    keys: Cells,
    /// The cells sorted by key, then by number.
    order: Vec<u32>,
    /// Per cell, whether it is the first with its key.
    first: Vec<bool>,
}

impl Keys {
    fn new(cells: &Cells, kind: Kind) -> Self {
        let mut keys = Cells::with_capacity(cells.len(), cells.indices().len());
        let mut key = Vec::new();
        for cell in cells.iter() {
            key.clear();
            key.extend_from_slice(cell);
            match kind {
                Kind::Set => key.sort_unstable(),
                Kind::Cycle => {
                    let smallest = (0..key.len()).min_by_key(|&i| key[i]).unwrap_or(0);
                    key.rotate_left(smallest);
                }
            }
            keys.push(&key);
        }
        let at = |i: u32| &keys[i as usize];
        let mut order: Vec<u32> = (0..).take(keys.len()).collect();
        order.sort_unstable_by(|&a, &b| at(a).cmp(at(b)).then(a.cmp(&b)));
        let mut first = vec![false; keys.len()];
        for equal in order.chunk_by(|&a, &b| at(a) == at(b)) {
            first[equal[0] as usize] = true;
        }
        Self { keys, order, first }
    }

    fn contains(&self, key: &[u32]) -> bool {
        self.order.binary_search_by(|&i| self.keys[i as usize].cmp(key)).is_ok()
    }

    fn first_with_key(&self, i: usize) -> bool {
        self.first[i]
    }
}
