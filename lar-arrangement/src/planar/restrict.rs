//! Restriction to a face σ: what a drawing looks like inside a polygon, as the 3D pipeline sees what crosses one
//! of its faces (Paoluzzi 2019, §3.3).
//!
//! The drawing is arranged together with the outline of σ; then the edges without a face of σ on either side are
//! removed, and the faces outside σ join. Faces of σ keep their loops, as all their edges stay.

use crate::boolean::FillRule;
use crate::error::ArrangementError;
use crate::expression::Expression;
use crate::merge::{self, Faces, Merged, Passed, Removal};
use crate::operators::{boundary_1, boundary_2};
use crate::planar::arranger::{Dangling, Isolated, PlanarArranger};
use crate::planar::edges::NO_EDGE;
use crate::planar::input::Drawing;
use crate::planar::result::PlanarArrangement;
use crate::union_find::UnionFind;
use lar_core::{ChainComplex, FaceId, Points, VertexId};
use std::sync::OnceLock;

const SIGMA: &str = "σ";

impl PlanarArranger<'_> {
    /// The arrangement of the part of a drawing inside a polygon σ, given by its loops (holes included, in any
    /// direction: its inside is found by parity). The outline of σ is part of the result. O(the arrangement of both).
    ///
    /// σ is the last region of the result, named "σ"; the faces inside it are those with an odd winding number for
    /// it. The exterior and the holes of σ are faces too, without anything inside. The other regions are cut to σ:
    /// outside it their winding numbers are zero. Edges of segments outside σ are left out of
    /// [`edges_of`](PlanarArrangement::edges_of).
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, PlanarArranger};
    /// let lines = Drawing::from_segments(&[[-1., 1., 5., 1.], [1., -1., 1., 5.], [7., 7., 8., 8.]]);
    /// let square = vec![[0., 0.], [2., 0.], [2., 2.], [0., 2.]];
    /// let inside = PlanarArranger::new().arrange_within(&lines, &[square])?;
    /// assert_eq!((inside.n_vertices(), inside.n_edges(), inside.n_faces()), (9, 12, 4));
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    ///
    /// # Errors
    /// As [`arrange`](Self::arrange), for the drawing and the points of the loops.
    pub fn arrange_within(
        &self,
        drawing: &Drawing,
        loops: &[Vec<[f64; 2]>],
    ) -> Result<PlanarArrangement, ArrangementError> {
        if drawing.points.dim() != 2 {
            return Err(ArrangementError::PlanarDimension { dim: drawing.points.dim() });
        }
        let mut all = drawing.clone();
        let sigma = all.push_polygon(SIGMA, loops);
        let whole = self.dangling(Dangling::Keep).isolated(Isolated::Drop).arrange(&all)?;
        let inside = whole
            .faces_where(&Expression::solid(sigma), FillRule::EvenOdd)
            .expect("loops are closed, so their parity tells inside from outside");
        let mut out = whole.restricted(&inside, self.dangling);
        if self.isolated == Isolated::Keep {
            let is_inside = |face, out: &PlanarArrangement| out.winding(face, sigma) % 2 != 0;
            let kept: Vec<bool> = (0..=out.n_faces() as u32).map(|f| is_inside(FaceId(f), &out)).collect();
            out.add_isolated(|face| kept[face.index()]);
        }
        Ok(out)
    }
}

impl PlanarArrangement {
    /// The arrangement with only the edges that have one of some faces beside them. The other faces join where
    /// nothing is left between them.
    fn restricted(mut self, faces: &[FaceId], dangling: Dangling) -> Self {
        let mut is_inside = vec![false; self.n_faces() + 1];
        faces.iter().for_each(|face| is_inside[face.index()] = true);
        let sides = self.faces_of_edges();
        let is_removed = |&[a, b]: &[u32; 2]| {
            let outside = !is_inside[a as usize] && !is_inside[b as usize];
            outside || (a == b && dangling == Dangling::Drop)
        };
        let removed: Vec<bool> = sides.iter().map(is_removed).collect();
        let mut sets = UnionFind::new(is_inside.len());
        for (&[a, b], _) in sides.iter().zip(&removed).filter(|(_, removed)| **removed) {
            sets.union(a, b);
        }
        let (new_face, n_new_faces) = sets.labels();
        let edges = self.edges();
        let merged = {
            let view = Faces { edges: &edges, loops: &self.loops, face_loops: &self.face_loops };
            let none = Passed::default();
            let n_new_faces = n_new_faces as usize;
            let removal = Removal { edges: &removed, new_face: &new_face, n_new_faces, vertices: &none };
            let points = self.complex.points();
            let at = |v: u32| [points.point(v as usize)[0], points.point(v as usize)[1], 0.0];
            merge::merge(&view, &removal, at)
        };
        let mut old_face = vec![None; n_new_faces as usize];
        for (&new, old) in new_face.iter().zip(0..).filter(|(_, old)| is_inside[*old]) {
            old_face[new as usize] = Some(old);
        }
        self.windings = self.windings.of_some(&old_face);
        self.rebuild(merged, &removed);
        self
    }

    /// The same arrangement with what is left of its vertices, edges and faces, in their order.
    fn rebuild(&mut self, merged: Merged, removed: &[bool]) {
        let mut points = Points::new(2);
        merged.vertices.iter().for_each(|&v| points.push(self.complex.points().point(v as usize)));
        self.sources = merged.vertices.iter().map(|&v| self.sources[v as usize]).collect();
        let mut new_edge = vec![NO_EDGE; removed.len()];
        (0..).zip(merged.old_half_edge.iter()).for_each(|(new, &h)| new_edge[(h / 2) as usize] = new);
        self.edge_at = self.edge_at.renumbered(&self.chains, &new_edge);
        self.carrier_of = merged.old_half_edge.iter().map(|&h| self.carrier_of[(h / 2) as usize]).collect();
        let boundaries = vec![
            boundary_1(points.len(), merged.edges.clone()),
            boundary_2(merged.edges.len(), &merged.loops, &merged.face_loops),
        ];
        self.complex = ChainComplex::new(points, boundaries);
        self.n_components = self.complex.connected_components().n;
        self.loops = merged.loops;
        self.face_loops = merged.face_loops;
        self.isolated = Vec::<(VertexId, FaceId)>::new();
        self.index = OnceLock::new();
    }
}
