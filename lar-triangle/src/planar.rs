//! Triangulations of points and of closed drawings in the plane.

use crate::TriangulateError;
use crate::cdt::Cdt;
use crate::face::smallest_first;
use crate::flat::{flush, small, unit_scale};
use crate::flips::Flips;
use crate::predicates::Xy;
use lar_core::{EdgeId, Points, VertexId};

/// Delaunay triangulation of points in the plane (2 × n).
///
/// The triangles are counter-clockwise, begin with their smallest index and are sorted. Where several points lie on one
/// circle the one with the smallest index is joined to the others, so that the result is unique. Of coincident
/// points the one with the smallest index is used. Points on one line have no triangles.
///
/// Time O(n log n) expected.
///
/// # Errors
/// [`TriangulateError::Dimension`] for points that are not planar, [`TriangulateError::NotFinite`] for one that is
/// infinite or not a number.
///
/// ```
/// use lar_core::Points;
/// let points = Points::from_columns(2, vec![0., 0., 2., 0., 2., 2., 0., 2., 1., 1.]);
/// assert_eq!(lar_triangle::delaunay(&points)?, [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 3, 4]]);
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
#[doc(alias = "triangulate2D")]
#[doc(alias = "delaunay_triangulation")]
pub fn delaunay(points: &Points) -> Result<Vec<[u32; 3]>, TriangulateError> {
    let (xy, kept) = positions(points)?;
    let Some(cdt) = Cdt::new(&xy, distinct(&kept)) else { return Ok(Vec::new()) };
    Ok(finish(cdt.triangles().collect(), &xy, &[]))
}

/// Constrained Delaunay triangulation of the region that closed edges bound in the plane (points 2 × n).
/// O(n log n) for n points, as a rule.
///
/// The region is what an odd number of edges separates from the outside: the edges may form any number of loops, in any
/// direction, nested or touching at vertices. Edges given twice cancel as a boundary and stay as edges. Edges
/// between coincident points count for nothing. Points off the edges become vertices too. Result and cost as
/// [`delaunay`].
///
/// # Errors
/// Those of [`delaunay`]; [`TriangulateError::NoSuchVertex`] when an edge names no point;
/// [`TriangulateError::OpenBoundary`] when some point has an odd number of edges; [`TriangulateError::CrossingEdge`]
/// when an edge crosses another or passes through a point (arrange the edges first).
///
/// ```
/// use lar_core::Points;
/// // A square with a triangular hole.
/// let points = Points::from_columns(2, vec![0., 0., 4., 0., 4., 4., 0., 4., 1., 1., 2., 1., 1., 2.]);
/// let edges = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
/// assert_eq!(lar_triangle::triangulate2d(&points, &edges)?.len(), 7);
/// # Ok::<(), lar_triangle::TriangulateError>(())
/// ```
#[doc(alias = "triangulate2D")]
#[doc(alias = "constrained_triangulation")]
pub fn triangulate2d(points: &Points, edges: &[[u32; 2]]) -> Result<Vec<[u32; 3]>, TriangulateError> {
    let (xy, kept) = positions(points)?;
    check_edges(edges, &kept)?;
    let Some(mut cdt) = Cdt::new(&xy, distinct(&kept)) else { return Ok(Vec::new()) };
    let mut fixed = Vec::with_capacity(edges.len());
    for (e, &[from, to]) in (0u32..).zip(edges) {
        let [a, b] = [from, to].map(|i| kept[i as usize]);
        if a != b {
            cdt.add_wall(a, b).ok_or(TriangulateError::CrossingEdge {
                edge: EdgeId(e),
                from: VertexId(from),
                to: VertexId(to),
            })?;
            fixed.push((a.min(b), a.max(b)));
        }
    }
    fixed.sort_unstable();
    Ok(finish(cdt.inner_triangles().collect(), &xy, &fixed))
}

/// Scaled positions, and for each point the first one at its position.
fn positions(points: &Points) -> Result<(Vec<Xy>, Vec<u32>), TriangulateError> {
    if points.dim() != 2 {
        return Err(TriangulateError::Dimension { found: points.dim(), expected: "2" });
    }
    small(points.len())?;
    if let Some(at) = points.coords().iter().position(|x| !x.is_finite()) {
        return Err(TriangulateError::NotFinite {
            vertex: VertexId(at as u32 / 2),
            value: points.coords()[at],
        });
    }
    let scale = unit_scale(points.coords().iter().fold(0.0, |m, x| m.max(x.abs())));
    // Adding 0 makes −0 and 0 the same.
    let xy: Vec<Xy> = points.iter().map(|p| [0, 1].map(|k| flush(p[k] * scale) + 0.0)).collect();
    let mut order: Vec<u32> = (0u32..).take(xy.len()).collect();
    let at = |i: u32| xy[i as usize];
    order.sort_unstable_by(|&i, &j| {
        at(i)[0].total_cmp(&at(j)[0]).then(at(i)[1].total_cmp(&at(j)[1])).then(i.cmp(&j))
    });
    let mut kept = vec![0; xy.len()];
    for same in order.chunk_by(|&i, &j| at(i) == at(j)) {
        for &i in same {
            kept[i as usize] = same[0];
        }
    }
    Ok((xy, kept))
}

fn distinct(kept: &[u32]) -> Vec<u32> {
    (0u32..).zip(kept).filter(|&(i, &first)| i == first).map(|(i, _)| i).collect()
}

/// Checks that the edges name points and that each point has an even number of them.
fn check_edges(edges: &[[u32; 2]], kept: &[u32]) -> Result<(), TriangulateError> {
    let mut degrees = vec![0usize; kept.len()];
    for &v in edges.as_flattened() {
        let first = kept.get(v as usize);
        let &first =
            first.ok_or(TriangulateError::NoSuchVertex { vertex: VertexId(v), points: kept.len() })?;
        degrees[first as usize] += 1;
    }
    match (0u32..).zip(&degrees).find(|&(_, &degree)| !degree.is_multiple_of(2)) {
        Some((v, &degree)) => Err(TriangulateError::OpenBoundary { vertex: VertexId(v), degree }),
        None => Ok(()),
    }
}

/// The unique Delaunay triangles, in standard order.
fn finish(mut triangles: Vec<[u32; 3]>, xy: &[Xy], fixed: &[(u32, u32)]) -> Vec<[u32; 3]> {
    let ids: Vec<u32> = (0u32..).take(xy.len()).collect();
    Flips::default().legalize(&mut triangles, xy, &ids, fixed);
    for triangle in &mut triangles {
        *triangle = smallest_first(*triangle);
    }
    triangles.sort_unstable();
    triangles
}
