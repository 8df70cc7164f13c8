//! Stage 5a: which shells bound the same 3-cell.
//!
//! Shells of one component of faces (connected through edges) are told apart by gift wrapping, but a cell may be
//! bounded by shells of several components. One ray for each component finds out: from the middle of an edge of
//! it towards −x, over all faces hit in order. Between two hits the ray stays in one cell, so the shell that it
//! leaves and the one that it meets next bound the same cell; beyond the last hit it is in the exterior. As every
//! ray ends there, it does not matter that two components may hit each other.

use crate::beams::TARGETS_A_PASS;
use crate::kernel::Midpoint;
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::rays::Rays;
use crate::union_find::UnionFind;
use crate::wrap;
use std::cmp::Ordering;

/// The shells, and rays between them.
pub(crate) struct Nesting<'a> {
    pub rays: Rays<'a>,
    pub shell_of_side: &'a [u32],
    pub n_shells: u32,
}

impl Nesting<'_> {
    /// Cell of each shell; cell 0 is the exterior. Also the number of cells.
    pub(crate) fn cells(&self, course: &Course) -> Result<(Vec<u32>, u32), Cancelled> {
        let n = self.n_shells as usize;
        // Element n stands for the exterior.
        let mut sets = UnionFind::new(n + 1);
        let edges = self.first_edges();
        self.rays.boxes.prepare(edges.len());
        for edges in edges.chunks(TARGETS_A_PASS) {
            course.go_on()?;
            let starts: Vec<Midpoint> = edges.iter().map(|&edge| self.rays.start(edge)).collect();
            let candidates = self.rays.candidates(&starts);
            // From shell to shell, up to the exterior.
            let ways = parallel::map(edges.len(), |i| {
                let hits = self.hits(&starts[i], &candidates[i]);
                let mut way = vec![self.shell_of_side[self.rays.sector(edges[i]) as usize]];
                way.extend(
                    hits.into_iter().flat_map(|face| [false, true].map(|beyond| self.shell(face, beyond))),
                );
                way.push(n as u32);
                way
            });
            for &[here, next] in ways.iter().flat_map(|way| way.as_chunks().0) {
                sets.union(here, next);
            }
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
        let sides = self.shell_of_side.as_chunks::<2>().0;
        // A face between the same shells as the one before tells nothing new.
        let telling = parallel::select(sides.len(), |f| f == 0 || sides[f as usize] != sides[f as usize - 1]);
        let telling = || telling.iter().map(|&face| (face, sides[face as usize]));
        let (component_of_shell, n) = wrap::components(telling().map(|(_, sides)| sides), self.n_shells);
        let mut seen = vec![false; n as usize];
        let mut found = Vec::with_capacity(n as usize);
        for (face, [front, _]) in telling() {
            let component = component_of_shell[front as usize] as usize;
            if !std::mem::replace(&mut seen[component], true) {
                let h = self.rays.skeleton.half_edges(face).next().expect("faces have edges");
                found.push(h / 2);
            }
        }
        found
    }

    /// The faces in some facets that a ray meets, in their order.
    fn hits(&self, start: &Midpoint, facets: &[u32]) -> Vec<u32> {
        let Rays { skeleton, geometry, .. } = self.rays;
        let mut hits: Vec<u32> =
            facets.iter().flat_map(|&facet| skeleton.faces_of_facets.of(facet)).collect();
        // Facets that overlap in one plane share their faces.
        hits.sort_unstable();
        hits.dedup();
        hits.retain(|&face| {
            let ends = |h: u32| skeleton.ends(h).map(|v| skeleton.vertices[v as usize]);
            self.rays.is_hit(skeleton.facet(face), skeleton.half_edges(face).map(ends), start)
        });
        hits.sort_by(|&f, &g| {
            let facets = [f, g].map(|face| skeleton.facet(face));
            geometry.cmp_hits(start, facets).then_with(|| f.cmp(&g))
        });
        hits
    }

    /// The shell on the side of a hit face that the ray leaves to, or comes from.
    fn shell(&self, face: u32, beyond: bool) -> u32 {
        let front_is_beyond = self.rays.leaves_in_front(self.rays.skeleton.facet(face));
        self.shell_of_side[(2 * face + u32::from(front_is_beyond != beyond)) as usize]
    }
}
