//! Rays from the middles of edges towards −x.
//!
//! Degenerate hits are excluded by moving the start by (ε³, ε, ε²) for an infinitesimal ε, consistently in every
//! predicate (simulation of simplicity). The middle of an edge touches only facets that lie in the faces around it.

use crate::boxes::Aabb;
use crate::kernel::{Geometry, Midpoint, Sign, Vertex};
use crate::meeting::Boxes;
use crate::skeleton::Skeleton;
use crate::wrap;
use lar_core::Cells;

/// Everything the rays need.
#[derive(Clone, Copy)]
pub(crate) struct Rays<'a> {
    pub skeleton: &'a Skeleton,
    pub geometry: &'a Geometry,
    pub rings: &'a Cells,
    /// The facets that the faces are pieces of.
    pub boxes: Boxes<'a>,
}

impl Rays<'_> {
    /// Where the ray of an edge starts.
    pub(crate) fn start(&self, edge: u32) -> Midpoint {
        let [a, b] = self.skeleton.edges[edge as usize].map(|v| &self.skeleton.vertices[v as usize]);
        self.geometry.midpoint(a, b)
    }

    /// For each ray the facets that it may hit, and others.
    pub(crate) fn candidates(&self, starts: &[Midpoint]) -> Vec<Vec<u32>> {
        // The rounded midpoint may be off by a fraction of a grid step.
        let beam = |start: &Midpoint| Aabb {
            lo: [f64::NEG_INFINITY, start.at[1] - 1.0, start.at[2] - 1.0],
            hi: start.at.map(|x| x + 1.0),
        };
        self.boxes.meeting(&starts.iter().map(beam).collect::<Vec<_>>())
    }

    /// The side that bounds the sector around an edge into which its middle is moved: direction (ε², 1, ε).
    pub(crate) fn sector(&self, edge: u32) -> u32 {
        let ring = &self.rings[edge as usize];
        // Whether the direction lies within half a turn counter-clockwise of the face.
        let ahead = |entry: u32| {
            let facet = self.skeleton.facet(entry / 2);
            (self.first_sign(facet) == Sign::Positive) == entry.is_multiple_of(2)
        };
        let along = self.skeleton.direction(edge, self.geometry);
        let contains = |i: usize| {
            let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
            match wrap::turn(a, b, &along, self.skeleton, self.geometry) {
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

    /// Whether the ray meets a facet, or a piece of it with the given boundary.
    pub(crate) fn is_hit(
        &self,
        facet: u32,
        boundary: impl Iterator<Item = [Vertex; 2]>,
        start: &Midpoint,
    ) -> bool {
        let across = self.geometry.normal_sign(facet, 0);
        if across == Sign::Zero || !self.projection_contains(boundary, start) {
            return false;
        }
        let moved = match self.geometry.side_of_midpoint(start, facet) {
            Sign::Zero => self.first_sign(facet),
            sign => sign,
        };
        moved == across
    }

    /// Whether a ray that passes through a facet comes out in front of it.
    pub(crate) fn leaves_in_front(&self, facet: u32) -> bool {
        self.geometry.normal_sign(facet, 0) == Sign::Negative
    }

    /// The side of a facet's plane to which a point on it is moved: direction (ε², 1, ε).
    fn first_sign(&self, facet: u32) -> Sign {
        [1, 2, 0]
            .map(|axis| self.geometry.normal_sign(facet, axis))
            .into_iter()
            .find(|&s| s != Sign::Zero)
            .expect("normals are not zero")
    }

    /// Whether the start, projected along x, lies in the projected polygon: crossings of the ray towards +y.
    fn projection_contains(&self, boundary: impl Iterator<Item = [Vertex; 2]>, start: &Midpoint) -> bool {
        let mut inside = false;
        for [p, q] in boundary {
            let above = [&p, &q].map(|v| self.geometry.cmp_with_midpoint(v, start, 2).is_gt());
            if above[0] != above[1] {
                let (low, high) = if above[0] { (&q, &p) } else { (&p, &q) };
                inside ^= self.geometry.orientation(low, high, start, 1, 2) == Sign::Positive;
            }
        }
        inside
    }
}
