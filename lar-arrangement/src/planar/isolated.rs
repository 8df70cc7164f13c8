//! Isolated vertices: points of the drawing with no segment, kept on demand.

use crate::operators::boundary_1;
use crate::planar::location::Location;
use crate::planar::result::PlanarArrangement;
use lar_core::{ChainComplex, FaceId, VertexId};
use std::sync::OnceLock;

impl PlanarArrangement {
    /// Vertices without edges, each with the face that it lies in; they have the highest numbers. Each is a connected
    /// component. There are none unless they are asked for ([`Isolated::Keep`](super::Isolated::Keep)).
    #[must_use]
    pub fn isolated_vertices(&self) -> &[(VertexId, FaceId)] {
        &self.isolated
    }

    /// Makes vertices of the grid points in which no segment with length ends, where they lie inside a face that
    /// `is_kept`. A point on an edge or a vertex is that edge's or vertex's, and splits nothing.
    pub(super) fn add_isolated(&mut self, is_kept: impl Fn(FaceId) -> bool) {
        let mut is_end = vec![false; self.carriers.points.len()];
        for member in &self.carriers.members {
            member.ends.iter().for_each(|&p| is_end[p as usize] = true);
        }
        let locator = self.locator();
        let mut found: Vec<(u32, FaceId, [f64; 2])> = Vec::new();
        for (point, _) in (0..).zip(&is_end).filter(|(_, is_end)| !**is_end) {
            let position = self.carriers.points[point as usize];
            match locator.locate_on_grid(position) {
                Location::Face(face) if is_kept(face) => {
                    found.push((point, face, locator.rounded(position)));
                }
                _ => {}
            }
        }
        let mut points = self.complex().points().clone();
        for (point, face, position) in found {
            self.isolated.push((VertexId(points.len() as u32), face));
            self.sources.push([point; 2]);
            points.push(&position);
        }
        self.n_components += self.isolated.len();
        let boundaries = vec![boundary_1(points.len(), self.edges()), self.complex().boundary(2).clone()];
        self.complex = ChainComplex::new(points, boundaries);
        self.index = OnceLock::new();
    }

    /// Ends of all edges, the smaller vertex first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        self.complex().boundary(1).indices().chunks_exact(2).map(|ends| [ends[0], ends[1]]).collect()
    }
}
