//! The laws that every triangulation of a face obeys, whatever the positions of its corners.
//!
//! They are statements about 1-chains: the boundary of the sum of the triangles is the sum of the loops. With
//! them, and when all triangles have positive area, the areas of the triangles add up to the face's identically
//! (both are the same sum over the loops), so that area needs no tolerance and no law of its own.

use lar_core::VertexId;

/// A law that a list of triangles breaks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BrokenLaw {
    /// The number of triangles is not corners + 2 × holes − 2.
    #[error("{found} triangles, expected {expected}")]
    Count {
        /// Triangles that there are.
        found: usize,
        /// Triangles that there must be.
        expected: usize,
    },
    /// A loop edge is not used exactly once in its direction, or another edge is not used once in each.
    #[error(
        "edge {from} to {to} is on {triangles} triangles and its reverse on {reverse}; loops have it {loops} times"
    )]
    EdgeUse {
        /// First vertex.
        from: VertexId,
        /// Second vertex.
        to: VertexId,
        /// Triangles that have it in this direction.
        triangles: usize,
        /// Triangles that have it in the other direction.
        reverse: usize,
        /// Times that the loops have it in this direction.
        loops: usize,
    },
}

/// Checks the combinatorial laws of a triangulated face.
///
/// 1. There are n + 2h − 2 triangles for n corners and h holes; loops that share a vertex count as one loop.
/// 2. Every loop edge is on one triangle, in its direction.
/// 3. Every other edge is on two triangles, once in each direction.
///
/// An edge that the loops walk in both directions (a slit) is on two triangles.
///
/// # Errors
/// The first law that is broken, with the edge.
///
/// Time O(n log n).
///
/// ```
/// use lar_triangle::check_laws;
/// let square: &[u32] = &[0, 1, 2, 3];
/// assert!(check_laws([square], &[[0, 1, 2], [0, 2, 3]]).is_ok());
/// assert!(check_laws([square], &[[0, 1, 2], [0, 3, 2]]).is_err());
/// ```
pub fn check_laws<'a, L>(loops: L, triangles: &[[u32; 3]]) -> Result<(), BrokenLaw>
where
    L: IntoIterator<Item = &'a [u32]> + Clone,
{
    let expected = expected_triangles(loops.clone());
    if triangles.len() != expected {
        return Err(BrokenLaw::Count { found: triangles.len(), expected });
    }
    let mut uses = edge_uses(loops.into_iter());
    for triangle in triangles {
        push_cycle(triangle, false, &mut uses);
    }
    uses.sort_unstable();
    uses.chunk_by(|a, b| a.0 == b.0).try_for_each(check_edge)
}

/// A directed edge's end points, small one first, then whether it runs from the large to the small one, then
/// whether a loop (rather than a triangle) has it.
type Use = ((u32, u32), bool, bool);

fn push_cycle(cycle: &[u32], of_loop: bool, uses: &mut Vec<Use>) {
    for (i, &from) in cycle.iter().enumerate() {
        let to = cycle[if i + 1 < cycle.len() { i + 1 } else { 0 }];
        uses.push(((from.min(to), from.max(to)), from > to, of_loop));
    }
}

fn edge_uses<'a>(loops: impl Iterator<Item = &'a [u32]>) -> Vec<Use> {
    let mut uses = Vec::new();
    for cycle in loops {
        push_cycle(cycle, true, &mut uses);
    }
    uses
}

fn check_edge(uses: &[Use]) -> Result<(), BrokenLaw> {
    let count = |down, of_loop| uses.iter().filter(|u| u.1 == down && u.2 == of_loop).count();
    let ((low, high), ..) = uses[0];
    for (down, from, to) in [(false, low, high), (true, high, low)] {
        let (triangles, reverse) = (count(down, false), count(!down, false));
        let (loops, loops_reverse) = (count(down, true), count(!down, true));
        if triangles > 1 || triangles < loops || triangles + loops_reverse != reverse + loops || from == to {
            let (from, to) = (VertexId(from), VertexId(to));
            return Err(BrokenLaw::EdgeUse { from, to, triangles, reverse, loops });
        }
    }
    Ok(())
}

/// n + 2 (groups of touching loops − 1) − 2; 0 without loops.
fn expected_triangles<'a>(loops: impl IntoIterator<Item = &'a [u32]>) -> usize {
    let mut of_vertex: Vec<(u32, usize)> = Vec::new();
    let mut parent: Vec<usize> = Vec::new();
    for (l, cycle) in loops.into_iter().enumerate() {
        parent.push(l);
        of_vertex.extend(cycle.iter().map(|&v| (v, l)));
    }
    if parent.is_empty() {
        return 0;
    }
    of_vertex.sort_unstable();
    let mut groups = parent.len();
    for pair in of_vertex.windows(2).filter(|w| w[0].0 == w[1].0) {
        let (a, b) = (root(&mut parent, pair[0].1), root(&mut parent, pair[1].1));
        if a != b {
            parent[a.max(b)] = a.min(b);
            groups -= 1;
        }
    }
    (of_vertex.len() + 2 * groups).saturating_sub(4)
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
