//! Stage 1d, by option: the edges between facets that lie side by side in one plane become soft, so that stage 5 joins
//! their pieces again. A triangulated square is one face then, as it was before it went through a file of triangles.
//!
//! Soft is only what may disappear. Whether a piece of such an edge does is decided in stage 5 by what is there then: two
//! faces of one plane that the same solids cross in the same way.

use crate::soup::Soup;

/// What becomes of faces of one surface that lie side by side in one plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Merge {
    /// They stay faces of their own.
    #[default]
    Nothing,
    /// They become one face, and a vertex that is left in the middle of a straight edge disappears. Such a face has the
    /// parents of all its pieces.
    Coplanar,
}

/// Makes edges soft all of whose facets lie in one plane, on both sides of them, or were meant to. O(n log n) for n edges
/// of facets.
pub(crate) fn soften(soup: &mut Soup) {
    let mut uses: Vec<(u32, u32)> = soup
        .facet_edges
        .iter()
        .zip(0..)
        .flat_map(|(edges, facet)| edges.iter().map(move |&e| (e / 2, facet)))
        .collect();
    uses.sort_unstable();
    for same in uses.chunk_by(|a, b| a.0 == b.0) {
        let [(edge, first), others @ ..] = same else { continue };
        if !others.is_empty() && others.iter().all(|&(_, other)| soup.is_meant_coplanar(*first, other)) {
            soup.soften(*edge);
            let bends = others.iter().map(|&(_, other)| height(soup, *first, other));
            soup.bend = bends.fold(soup.bend, f64::max);
        }
    }
}

/// How far the corners of a facet lie from the plane of another, in grid steps.
fn height(soup: &Soup, facet: u32, other: u32) -> f64 {
    let geometry = &soup.geometry;
    let normal = geometry.normal(facet);
    let length = normal.iter().fold(0.0, |length: f64, x| length.hypot(*x));
    let origin = geometry.position(geometry.base(facet)[0]);
    let above = |p: u32| {
        let at = geometry.position(p);
        (0..3).map(|k| normal[k] / length * (at[k] - origin[k])).sum::<f64>().abs()
    };
    geometry.base(other).map(above).into_iter().fold(0.0, f64::max)
}
