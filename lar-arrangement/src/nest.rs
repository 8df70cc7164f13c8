//! Stage 5a: which shells bound the same 3-cell.
//!
//! Shells of one component of faces (connected through edges) are told apart by gift wrapping, but a cell may be
//! bounded by shells of several components. One ray for each component finds out: from the middle of an edge of
//! it towards −x, over all faces hit in order. Between two hits the ray stays in one cell, so the shell that it
//! leaves and the one that it meets next bound the same cell; beyond the last hit it is in the exterior. As every
//! ray ends there, it does not matter that two components may hit each other.
//!
//! The middle of an edge never touches another component. Degenerate hits are excluded by moving the start by
//! (ε³, ε, ε²) for an infinitesimal ε, consistently in every predicate (simulation of simplicity).

use crate::boxes::{Aabb, BoxTree};
use crate::kernel::{Geometry, Midpoint, Sign};
use crate::progress::{Cancelled, Course};
use crate::skeleton::Skeleton;
use crate::union_find::UnionFind;
use crate::wrap;
use lar_core::Cells;
use std::cmp::Ordering;

/// Everything the rays need.
pub(crate) struct Nesting<'a> {
    pub skeleton: &'a Skeleton,
    pub geometry: &'a Geometry,
    pub rings: &'a Cells,
    pub shell_of_side: &'a [u32],
    pub n_shells: u32,
    /// The facets that the faces are pieces of.
    pub tree: &'a BoxTree,
}

impl Nesting<'_> {
    /// Cell of each shell; cell 0 is the exterior. Also the number of cells.
    pub(crate) fn cells(&self, course: &Course) -> Result<(Vec<u32>, u32), Cancelled> {
        let n = self.n_shells as usize;
        // Element n stands for the exterior.
        let mut sets = UnionFind::new(n + 1);
        for edge in self.first_edges() {
            course.go_on()?;
            let mut here = self.shell_of_side[self.sector(edge) as usize];
            for face in self.hits(edge) {
                sets.union(here, self.shell(face, false));
                here = self.shell(face, true);
            }
            sets.union(here, n as u32);
        }
        let (labels, n_cells) = sets.labels();
        let exterior = labels[n];
        let cell = |label: u32| match label.cmp(&exterior) {
            Ordering::Less => label + 1,
            Ordering::Equal => 0,
            Ordering::Greater => label,
        };
        Ok((labels[..n].iter().map(|&l| cell(l)).collect(), n_cells))
    }

    /// One edge of each component.
    fn first_edges(&self) -> Vec<u32> {
        let (component_of_shell, n_components) = wrap::components(self.shell_of_side, self.n_shells);
        let mut seen = vec![false; n_components as usize];
        let mut found = Vec::with_capacity(n_components as usize);
        for (face, &shell) in (0..).zip(self.shell_of_side.iter().step_by(2)) {
            let component = component_of_shell[shell as usize] as usize;
            if !std::mem::replace(&mut seen[component], true) {
                let h = self.skeleton.half_edges(face).next().expect("faces have edges");
                found.push(h / 2);
            }
        }
        found
    }

    /// The faces that the ray from the middle of an edge meets, in their order.
    fn hits(&self, edge: u32) -> Vec<u32> {
        let [a, b] = self.skeleton.edges[edge as usize].map(|v| &self.skeleton.vertices[v as usize]);
        let start = self.geometry.midpoint(a, b);
        // The rounded midpoint may be off by a fraction of a grid step.
        let beam = Aabb {
            lo: [f64::NEG_INFINITY, start.at[1] - 1.0, start.at[2] - 1.0],
            hi: start.at.map(|x| x + 1.0),
        };
        let mut hits = Vec::new();
        self.tree.query(&beam, |facet| hits.extend(self.skeleton.faces_of_facet[facet as usize].clone()));
        // Facets that overlap in one plane share their faces.
        hits.sort_unstable();
        hits.dedup();
        hits.retain(|&face| self.is_hit(face, &start));
        hits.sort_by(|&f, &g| {
            let facets = [f, g].map(|face| self.skeleton.facet(face));
            self.geometry.cmp_hits(&start, facets).then_with(|| f.cmp(&g))
        });
        hits
    }

    /// The shell on the side of a hit face that the ray leaves to, or comes from.
    fn shell(&self, face: u32, beyond: bool) -> u32 {
        let front_is_beyond = self.geometry.normal_sign(self.skeleton.facet(face), 0) == Sign::Negative;
        self.shell_of_side[(2 * face + u32::from(front_is_beyond != beyond)) as usize]
    }

    /// The side that bounds the sector around an edge into which its middle is moved: direction (ε², 1, ε).
    fn sector(&self, edge: u32) -> u32 {
        let ring = &self.rings[edge as usize];
        // Whether the direction lies within half a turn counter-clockwise of the face.
        let ahead = |entry: u32| {
            let facet = self.skeleton.facet(entry / 2);
            (self.first_sign(facet) == Sign::Positive) == entry.is_multiple_of(2)
        };
        let contains = |i: usize| {
            let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
            match wrap::turn(a, b, edge, self.skeleton, self.geometry) {
                Sign::Positive => ahead(a) && !ahead(b),
                Sign::Zero => ahead(a),
                Sign::Negative => ahead(a) || !ahead(b),
            }
        };
        match ring {
            [only] => *only,
            _ => ring[(0..ring.len()).find(|&i| contains(i)).expect("the sectors cover the full turn")],
        }
    }

    /// Whether the ray from `start` towards −x meets a face.
    fn is_hit(&self, face: u32, start: &Midpoint) -> bool {
        let facet = self.skeleton.facet(face);
        let across = self.geometry.normal_sign(facet, 0);
        if across == Sign::Zero || !self.projection_contains(face, start) {
            return false;
        }
        let moved = match self.geometry.side_of_midpoint(start, facet) {
            Sign::Zero => self.first_sign(facet),
            sign => sign,
        };
        moved == across
    }

    /// The side of a facet's plane to which a point on it is moved: direction (ε², 1, ε).
    fn first_sign(&self, facet: u32) -> Sign {
        [1, 2, 0]
            .map(|axis| self.geometry.normal_sign(facet, axis))
            .into_iter()
            .find(|&s| s != Sign::Zero)
            .expect("normals are not zero")
    }

    /// Whether the start, projected along x, lies in the projected face: crossings of the ray towards +y.
    fn projection_contains(&self, face: u32, start: &Midpoint) -> bool {
        let mut inside = false;
        for h in self.skeleton.half_edges(face) {
            let [p, q] = self.skeleton.ends(h).map(|v| &self.skeleton.vertices[v as usize]);
            let above = [p, q].map(|v| self.geometry.cmp_with_midpoint(v, start, 2).is_gt());
            if above[0] != above[1] {
                let (low, high) = if above[0] { (q, p) } else { (p, q) };
                inside ^= self.geometry.orientation(low, high, start, 1, 2) == Sign::Positive;
            }
        }
        inside
    }
}
