//! Stage 5b: soft edges and what only they caused disappear.
//!
//! A nearly planar polygon was cut into triangles by soft edges. Where a soft edge still has only two faces around
//! it, both pieces of the same polygons, the two faces become one. A vertex that is not a corner of the input and
//! is left with two edges, between the same faces, was the crossing of a soft edge with something: its edges become
//! one.
//!
//! With `Merge::Coplanar` the edges between facets side by side in one plane are soft too. A piece of one disappears
//! where the two faces at it are in one plane and the same solids cross them in the same way; and a corner of the input
//! disappears in the middle of the line of two planes.

use crate::fragment::FacetParent;
use crate::kernel::VertexDef;
use crate::merge::{self, Faces, Merged, Removal};
use crate::skeleton::Skeleton;
use crate::soup::Soup;
use crate::tiles::Merge;
use crate::union_find::UnionFind;
use lar_core::Cells;

/// The skeleton without soft edges.
#[derive(Debug)]
pub(crate) struct Dissolved {
    pub edges: Vec<[u32; 2]>,
    pub loops: Cells,
    pub face_loops: Vec<u32>,
    /// The faces around each edge.
    pub rings: Cells,
    /// What became of the old vertices and faces; nothing when all are what they were.
    pub origins: Option<Origins>,
}

/// The old vertices and faces that the new ones were.
#[derive(Debug)]
pub(crate) struct Origins {
    /// The old vertex of each new one.
    pub vertices: Vec<u32>,
    /// The first of the old faces that make up each new one.
    pub old_face: Vec<u32>,
    /// The others, each after its new face, ascending.
    pub others: Vec<(u32, u32)>,
}

impl Dissolved {
    pub(crate) fn n_faces(&self) -> usize {
        self.face_loops.len() - 1
    }

    /// The first of the old faces that make up a new one.
    pub(crate) fn old_face(&self, face: u32) -> u32 {
        self.origins.as_ref().map_or(face, |origins| origins.old_face[face as usize])
    }

    /// The others of them, each after its new face, ascending.
    pub(crate) fn others(&self) -> &[(u32, u32)] {
        self.origins.as_ref().map_or(&[], |origins| &origins.others)
    }
}

/// The skeleton as it is, its loops and edges taken out of it.
pub(crate) fn unchanged(skeleton: &mut Skeleton, rings: Cells) -> Dissolved {
    Dissolved {
        edges: std::mem::take(&mut skeleton.edges),
        loops: std::mem::take(&mut skeleton.loops),
        face_loops: std::mem::replace(&mut skeleton.face_loops, vec![0]),
        rings,
        origins: None,
    }
}

/// Dissolves.
pub(crate) fn dissolve(skeleton: &Skeleton, rings: &Cells, soup: &Soup, merge: Merge) -> Dissolved {
    let mut removed: Vec<bool> =
        (0..skeleton.edges.len()).map(|e| is_dissolvable(e, skeleton, rings, soup, merge)).collect();
    let faces = Faces { edges: &skeleton.edges, loops: &skeleton.loops, face_loops: &skeleton.face_loops };
    let (mut new_face, mut n_faces) = merged_faces(&removed, rings, skeleton.n_faces());
    if merge::keep_folds(&faces, &mut removed, &new_face, n_faces as usize) {
        (new_face, n_faces) = merged_faces(&removed, rings, skeleton.n_faces());
    }
    let mut old_face = vec![u32::MAX; n_faces as usize];
    for (&new, old) in new_face.iter().zip(0..) {
        let first = &mut old_face[new as usize];
        *first = (*first).min(old);
    }
    let is_corner = |v: u32| matches!(skeleton.vertices[v as usize].def, VertexDef::Point(_));
    let mut is_candidate = vec![false; skeleton.vertices.len()];
    for (ends, _) in skeleton.edges.iter().zip(&removed).filter(|(_, removed)| **removed) {
        ends.iter().for_each(|&v| is_candidate[v as usize] = merge == Merge::Coplanar || !is_corner(v));
    }
    let mut vertices =
        merge::with_two_edges(is_candidate.len(), &skeleton.edges, &removed, |v| is_candidate[v as usize]);
    // Where a segment lies in a polygon up to a soft edge and leaves it there, it ends inside of the new face.
    let around = |edge: u32| {
        let mut faces: Vec<u32> = rings[edge as usize].iter().map(|s| new_face[(s / 2) as usize]).collect();
        faces.sort_unstable();
        faces
    };
    let facet = |new: u32| skeleton.facet(old_face[new as usize]);
    let is_bent = match merge {
        Merge::Nothing => Vec::new(),
        Merge::Coplanar => bent_faces(skeleton, soup, &new_face, &old_face),
    };
    // Two planes meet in a line; faces that are bent have no plane.
    let is_straight = |faces: &[u32]| {
        let bent = faces.iter().any(|&f| is_bent[f as usize]);
        !bent && faces.iter().any(|&f| !soup.geometry.is_coplanar(facet(faces[0]), facet(f)))
    };
    vertices.retain(|v, [e, f]| {
        let faces = around(e);
        faces == around(f) && (!is_corner(v) || is_straight(&faces))
    });
    let removal =
        Removal { edges: &removed, new_face: &new_face, n_new_faces: n_faces as usize, vertices: &vertices };
    let merged = merge::merge(&faces, &removal, |v| skeleton.vertices[v as usize].at);
    let rings = new_rings(rings, &merged, &new_face);
    let others = new_face.iter().copied().zip(0..).filter(|&(new, old)| old_face[new as usize] != old);
    let mut others: Vec<(u32, u32)> = others.collect();
    others.sort_unstable();
    let Merged { vertices, edges, loops, face_loops, .. } = merged;
    Dissolved { edges, loops, face_loops, rings, origins: Some(Origins { vertices, old_face, others }) }
}

fn is_dissolvable(edge: usize, skeleton: &Skeleton, rings: &Cells, soup: &Soup, merge: Merge) -> bool {
    let &[a, b] = &rings[edge] else { return false };
    if !skeleton.is_soft(edge) || (a ^ b) % 2 != 1 {
        return false;
    }
    let polygons = |face: u32| {
        let mut all: Vec<(u32, bool)> = skeleton
            .face_parents(face)
            .iter()
            .map(|p| (soup.facet_polygon[p.facet as usize], p.same_way))
            .collect();
        all.sort_unstable();
        all
    };
    polygons(a / 2) == polygons(b / 2)
        || (merge == Merge::Coplanar
            && soup.is_meant_coplanar(skeleton.facet(a / 2), skeleton.facet(b / 2))
            && crossed(a / 2, skeleton, soup) == crossed(b / 2, skeleton, soup))
}

/// The solids that have a face as part of their surface, by what a path across it does to their winding numbers.
pub(crate) fn crossed(face: u32, skeleton: &Skeleton, soup: &Soup) -> Vec<(u32, i32)> {
    let of_facet = |p: &FacetParent| {
        let turn = if p.same_way { 1 } else { -1 };
        soup.parents(p.facet).iter().map(move |p| (p.solid, turn * soup.jump(p)))
    };
    let mut all: Vec<(u32, i32)> = skeleton.face_parents(face).iter().flat_map(of_facet).collect();
    all.sort_unstable();
    all
}

/// Which new faces are made of old ones in several planes.
fn bent_faces(skeleton: &Skeleton, soup: &Soup, new_face: &[u32], old_face: &[u32]) -> Vec<bool> {
    let mut bent = vec![false; old_face.len()];
    for (&new, old) in new_face.iter().zip(0..) {
        let first = old_face[new as usize];
        bent[new as usize] |=
            first != old && !soup.geometry.is_coplanar(skeleton.facet(first), skeleton.facet(old));
    }
    bent
}

fn merged_faces(removed: &[bool], rings: &Cells, n_faces: usize) -> (Vec<u32>, u32) {
    let mut sets = UnionFind::new(n_faces);
    for (ring, _) in rings.iter().zip(removed).filter(|(_, removed)| **removed) {
        sets.union(ring[0] / 2, ring[1] / 2);
    }
    sets.labels()
}

/// The rings of the remaining edges in terms of the new faces.
fn new_rings(rings: &Cells, merged: &Merged, new_face: &[u32]) -> Cells {
    let mut out = Cells::with_capacity(merged.edges.len(), rings.indices().len());
    let mut ring = Vec::new();
    for &h in &merged.old_half_edge {
        ring.clear();
        let against = h % 2;
        let entry = |&old: &u32| 2 * new_face[(old / 2) as usize] + ((old % 2) ^ against);
        if against == 0 {
            ring.extend(rings[(h / 2) as usize].iter().map(entry));
        } else {
            ring.extend(rings[(h / 2) as usize].iter().rev().map(entry));
        }
        out.push(&ring);
    }
    out
}
