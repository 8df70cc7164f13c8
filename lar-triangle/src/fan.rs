//! A triangulation of a face with holes that looks at no position at all.
//!
//! Ear clipping over bridges can, on hopeless positions, cut the same diagonal on both sides of a bridge. Then this
//! one is used: each hole c is sewn to one edge of the ring, and what remains is a ring of distinct points, fanned
//! from a corner that no sewing touched.
//!
//! ```text
//!   z ------- a1        two triangles, z a1 c0 and z c0 c1, turn the ring  … z a1 …
//!    \ \    /           into  … z c1 c2 … c0 a1 …  : each point once, so the next hole
//!     \  c0             is sewn to c0 a1, and the fan from a2 meets no edge of the
//!      c1               sewing twice, since none of them ends in a2.
//! ```

use crate::flat::Flat;

/// n + 2h − 2 triangles (of corners) of a face whose points are all distinct; O(n).
pub(crate) fn fan(flat: &Flat, triangles: &mut Vec<[u32; 3]>) {
    let mut loops = flat.loops();
    let Some(outer) = loops.next() else { return };
    let (apex, a1) = (outer.start + 2, outer.start + 1);
    let mut ring: Vec<u32> = (apex + 1..outer.end).collect();
    let mut z = outer.start;
    ring.push(z);
    for hole in loops {
        triangles.push([z, a1, hole.start]);
        triangles.push([z, hole.start, hole.start + 1]);
        ring.extend(hole.start + 1..hole.end);
        ring.push(hole.start);
        z = hole.start;
    }
    ring.push(a1);
    triangles.extend(ring.windows(2).map(|pair| [apex, pair[0], pair[1]]));
}
