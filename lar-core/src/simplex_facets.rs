//! Facets, coherent orientation and boundary of sets of simplices, all of one dimension, in any dimension.
//!
//! The facet of (v0 … vd) opposite to vk has the sign (−1)^k. Two simplices are oriented coherently when a
//! facet that only they share gets opposite signs from them.

use crate::complex::sign_columns;
use crate::simplicial::simplex_size;
use crate::{Cells, Operator, Points, SimplexError};
use nalgebra::DMatrix;
use std::collections::VecDeque;

/// One use of a facet by a simplex: the facet's vertices in rising order are stored apart.
#[derive(Clone, Copy)]
struct FacetUse {
    simplex: u32,
    /// Which vertex the facet lies opposite to.
    opposite: u32,
    /// The sign of the facet, its vertices in rising order, in the boundary of the simplex.
    sign: i8,
}

/// All facets of all simplices, grouped by equal vertices in lexicographic order.
struct FacetUses {
    /// `facet_size` vertices a use, in rising order, parallel to `uses`.
    vertices: Vec<u32>,
    facet_size: usize,
    uses: Vec<FacetUse>,
    /// The uses sorted by vertices, then by simplex.
    order: Vec<u32>,
}

impl FacetUses {
    fn new(simplices: &Cells) -> Result<Self, SimplexError> {
        let size = simplex_size(simplices)?;
        let facet_size = size.saturating_sub(1);
        let mut all = Self { vertices: Vec::new(), facet_size, uses: Vec::new(), order: Vec::new() };
        if facet_size == 0 {
            return Ok(all);
        }
        let entries = simplices.len() as u64 * size as u64 * facet_size as u64;
        if u32::try_from(entries).is_err() {
            return Err(SimplexError::TooLarge { size: entries });
        }
        for (simplex, vertices) in (0..).zip(simplices.iter()) {
            all.push_facets(simplex, vertices);
        }
        let mut order: Vec<u32> = (0..).take(all.uses.len()).collect();
        order.sort_unstable_by(|&a, &b| all.facet(a).cmp(all.facet(b)).then(a.cmp(&b)));
        all.order = order;
        Ok(all)
    }

    fn push_facets(&mut self, simplex: u32, vertices: &[u32]) {
        let mut sorted: Vec<u32> = vertices.to_vec();
        let whole = sort_sign(&mut sorted);
        for (k, &v) in sorted.iter().enumerate() {
            self.vertices.extend(sorted.iter().filter(|&&w| w != v));
            let opposite = (0..).zip(vertices).find(|e| *e.1 == v).map_or(0, |e| e.0);
            let sign = if k % 2 == 0 { whole } else { -whole };
            self.uses.push(FacetUse { simplex, opposite, sign });
        }
    }

    fn facet(&self, i: u32) -> &[u32] {
        &self.vertices[i as usize * self.facet_size..][..self.facet_size]
    }

    /// The uses of one facet after the other: positions in `uses`.
    fn groups(&self) -> impl Iterator<Item = &[u32]> {
        self.order.chunk_by(|&a, &b| self.facet(a) == self.facet(b))
    }

    fn at(&self, i: u32) -> FacetUse {
        self.uses[i as usize]
    }
}

/// Sorts distinct numbers; +1 when that takes an even number of exchanges, −1 when odd.
fn sort_sign(numbers: &mut [u32]) -> i8 {
    let mut sign = 1;
    for i in 1..numbers.len() {
        let mut k = i;
        while k > 0 && numbers[k - 1] > numbers[k] {
            numbers.swap(k - 1, k);
            sign = -sign;
            k -= 1;
        }
    }
    sign
}

/// The distinct facets of d-simplices, d ≥ 1: (d − 1)-simplices, each with its vertices in rising order, in
/// lexicographic order. None for points. O(n d² log n).
///
/// # Errors
/// When the simplices are not all of one size or one names a vertex twice.
///
/// ```
/// use lar_core::{Cells, simplex_facets};
/// let edges = simplex_facets(&Cells::uniform(3, vec![0, 1, 2, 3, 2, 1]))?;
/// assert_eq!(edges.indices(), [0, 1, 0, 2, 1, 2, 1, 3, 2, 3]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
#[doc(alias = "simplexFacets")]
#[doc(alias = "larSimplexFacets")]
pub fn simplex_facets(simplices: &Cells) -> Result<Cells, SimplexError> {
    let all = FacetUses::new(simplices)?;
    Ok(all.groups().map(|group| all.facet(group[0])).collect())
}

/// The facets of d-simplices and ∂d over them: rows facets (in the order of [`simplex_facets`], each oriented
/// by its rising vertices), columns simplices, entry (−1)^k times the sign of the sorting for the facet
/// opposite to vertex k. The facets given to this function in their turn yield ∂d−1, with ∂d−1 ∂d = 0. O(n d²
/// log n).
///
/// # Errors
/// As [`simplex_facets`].
///
/// ```
/// use lar_core::{Cells, simplicial_boundary};
/// let (edges, d2) = simplicial_boundary(&Cells::uniform(3, vec![0, 1, 2]))?;
/// assert_eq!(edges.indices(), [0, 1, 0, 2, 1, 2]);
/// assert_eq!(d2.data(), [1, -1, 1]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
pub fn simplicial_boundary(simplices: &Cells) -> Result<(Cells, Operator), SimplexError> {
    let all = FacetUses::new(simplices)?;
    let mut columns = vec![Vec::new(); simplices.len()];
    let mut facets = Cells::new();
    for (row, group) in (0..).zip(all.groups()) {
        facets.push(all.facet(group[0]));
        for facet_use in group.iter().map(|&i| all.at(i)) {
            columns[facet_use.simplex as usize].push((row, facet_use.sign));
        }
    }
    let operator = sign_columns(facets.len(), columns.into_iter());
    Ok((facets, operator))
}

/// The facets that exactly one simplex has, oriented as that simplex induces (for d ≥ 2: its vertices without
/// the one opposite, the last two exchanged when the sign is −1), in the order of the simplices. Of
/// coherently oriented simplices this is the boundary of their sum: of counter-clockwise triangles a
/// counter-clockwise outline, of positive tetrahedra the outward triangles. O(n d² log n).
///
/// # Errors
/// As [`simplex_facets`].
///
/// ```
/// use lar_core::{orient_simplices, simplex_boundary, simplex_grid};
/// let grid = simplex_grid(&[2, 2, 2])?;
/// let tetrahedra = orient_simplices(grid.points(), grid.cells(3))?;
/// assert_eq!(simplex_boundary(&tetrahedra)?.len(), 48);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
#[doc(alias = "simplexBoundary")]
#[doc(alias = "simplexBoundary_3")]
pub fn simplex_boundary(simplices: &Cells) -> Result<Cells, SimplexError> {
    let all = FacetUses::new(simplices)?;
    let mut once: Vec<FacetUse> =
        all.groups().filter(|group| group.len() == 1).map(|group| all.at(group[0])).collect();
    once.sort_unstable_by_key(|u| (u.simplex, u.opposite));
    let induced = |u: &FacetUse| {
        let mut facet = simplices[u.simplex as usize].to_vec();
        facet.remove(u.opposite as usize);
        if u.opposite % 2 == 1 {
            exchange_last(&mut facet);
        }
        facet
    };
    Ok(once.iter().map(induced).collect())
}

fn exchange_last(simplex: &mut [u32]) {
    if let [.., a, b] = simplex {
        std::mem::swap(a, b);
    }
}

/// The simplices oriented coherently across facets that two of them share, by exchanging the last two
/// vertices of those that are turned over; points and single vertices stay as they are.
///
/// When the simplices are of the dimension of the space, each connected part of negative total volume is
/// turned over as a whole, so that parts of a complex without folds consist of positive simplices. Otherwise
/// the first simplex of each part keeps its orientation. Facets of more than two simplices do not connect.
/// O(n d² log n + n d³).
///
/// # Errors
/// When the simplices have no coherent orientation, are not of one size, or name a vertex twice or one that
/// does not exist.
///
/// ```
/// use lar_core::{orient_simplices, simplex_grid};
/// let square = simplex_grid(&[1, 1])?;
/// let triangles = orient_simplices(square.points(), square.cells(2))?;
/// assert_eq!(triangles.indices(), [0, 1, 2, 1, 3, 2]);
/// # Ok::<(), lar_core::SimplexError>(())
/// ```
pub fn orient_simplices(points: &Points, simplices: &Cells) -> Result<Cells, SimplexError> {
    let n_vertices = points.len();
    for (cell, vertices) in simplices.iter().enumerate() {
        if let Some(&v) = vertices.iter().find(|&&v| v as usize >= n_vertices) {
            return Err(SimplexError::VertexOutOfRange { cell, vertex: crate::VertexId(v), n_vertices });
        }
    }
    let all = FacetUses::new(simplices)?;
    if all.facet_size == 0 {
        return Ok(simplices.clone());
    }
    let links = links(&all, simplices.len());
    let (mut signs, part, n_parts) = spread(&links)?;
    if all.facet_size == points.dim() {
        let mut volume = vec![0.; n_parts];
        for (i, simplex) in simplices.iter().enumerate() {
            volume[part[i]] += f64::from(signs[i]) * scaled_volume(points, simplex);
        }
        for (sign, &part) in signs.iter_mut().zip(&part) {
            *sign *= if volume[part] < 0. { -1 } else { 1 };
        }
    }
    let turned = |(simplex, &sign): (&[u32], &i8)| {
        let mut simplex = simplex.to_vec();
        if sign < 0 {
            exchange_last(&mut simplex);
        }
        simplex
    };
    Ok(simplices.iter().zip(&signs).map(turned).collect())
}

/// Per simplex: the simplices it shares a facet with, facets of two only, and their relative signs.
fn links(all: &FacetUses, n: usize) -> Vec<Vec<(u32, i8)>> {
    let mut links = vec![Vec::new(); n];
    for group in all.groups() {
        if let &[a, b] = group {
            let (a, b) = (all.at(a), all.at(b));
            links[a.simplex as usize].push((b.simplex, -a.sign * b.sign));
            links[b.simplex as usize].push((a.simplex, -a.sign * b.sign));
        }
    }
    links
}

/// A sign and a part for each simplex, and the number of parts, breadth-first over the links.
fn spread(links: &[Vec<(u32, i8)>]) -> Result<(Vec<i8>, Vec<usize>, usize), SimplexError> {
    let (mut signs, mut part) = (vec![0_i8; links.len()], vec![0; links.len()]);
    let mut n_parts = 0;
    let mut queue = VecDeque::new();
    for start in 0..links.len() {
        if signs[start] != 0 {
            continue;
        }
        (signs[start], part[start]) = (1, n_parts);
        queue.push_back(start);
        while let Some(here) = queue.pop_front() {
            for &(there, relative) in &links[here] {
                let (there, sign) = (there as usize, signs[here] * relative);
                if signs[there] == 0 {
                    (signs[there], part[there]) = (sign, n_parts);
                    queue.push_back(there);
                } else if signs[there] != sign {
                    return Err(SimplexError::NotOrientable { cells: [here.min(there), here.max(there)] });
                }
            }
        }
        n_parts += 1;
    }
    Ok((signs, part, n_parts))
}

/// d! times the signed volume of a d-simplex in d-space.
fn scaled_volume(points: &Points, simplex: &[u32]) -> f64 {
    let d = points.dim();
    let origin = points.point(simplex[0] as usize);
    DMatrix::from_fn(d, d, |i, j| points.point(simplex[j + 1] as usize)[i] - origin[i]).determinant()
}
