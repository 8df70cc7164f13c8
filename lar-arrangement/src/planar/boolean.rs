//! Regions of a planar arrangement: winding numbers of all regions in all faces, and Boolean expressions whose
//! results are polygons with holes.

use crate::boolean::{BooleanError, FillRule};
use crate::expression::Expression;
use crate::merge::{self, Faces, Removal};
use crate::planar::input::Drawing;
use crate::planar::result::PlanarArrangement;
use crate::union_find::UnionFind;
use crate::winding::{Closure, Walls, Windings};
use lar_core::{FaceId, Points};

/// Polygons with holes in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygons {
    /// 2 × n, the vertices of the loops.
    pub points: Points,
    /// For each polygon its loops of points: the outer one, counter-clockwise, then its holes, clockwise.
    pub polygons: Vec<Vec<Vec<u32>>>,
}

impl Polygons {
    /// Sum of the areas. O(points of the loops).
    #[must_use]
    pub fn area(&self) -> f64 {
        let at = |v: u32| self.points.point(v as usize);
        let twice = |cycle: &Vec<u32>| {
            let o = at(cycle[0]);
            (0..cycle.len())
                .map(|i| {
                    let (p, q) = (at(cycle[i]), at(cycle[(i + 1) % cycle.len()]));
                    (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])
                })
                .sum::<f64>()
        };
        // The sum of nothing is minus zero.
        self.polygons.iter().flatten().map(twice).sum::<f64>() / 2.0 + 0.0
    }
}

impl PlanarArrangement {
    /// Winding numbers of the drawing's regions, from the jumps at the edges.
    pub(super) fn wind(&mut self, drawing: &Drawing) {
        self.windings = match drawing.regions.len() {
            0 => Windings::default(),
            n => Windings::new(self.n_faces() + 1, n, &self.walls(drawing)),
        };
        self.regions.clone_from(&drawing.regions);
    }

    /// The faces on the right and on the left of each edge.
    pub(super) fn faces_of_edges(&self) -> Vec<[u32; 2]> {
        let mut faces = vec![[0; 2]; self.n_edges()];
        for face in 0..=self.n_faces() as u32 {
            for h in self.half_edges(FaceId(face)) {
                faces[(h / 2) as usize][usize::from(h.is_multiple_of(2))] = face;
            }
        }
        faces
    }

    /// The edges with the regions that they bound.
    fn walls(&self, drawing: &Drawing) -> Walls {
        let mut bounds: Vec<Vec<(u32, i32)>> = vec![Vec::new(); self.n_edges()];
        for &(segment, region) in &drawing.outlines {
            for (edge, sign) in self.edges_of(segment as usize) {
                bounds[edge.index()].push((region, i32::from(sign)));
            }
        }
        let mut walls = Walls::new();
        for (faces, list) in self.faces_of_edges().into_iter().zip(bounds) {
            walls.push_face(faces, list.into_iter());
        }
        walls
    }

    /// The winding number of a region in a face (its parity where its outline is not oriented consistently).
    #[must_use]
    pub fn winding(&self, face: FaceId, region: usize) -> i32 {
        let row = self.windings.of_cell(face.index());
        row.binary_search_by_key(&(region as u32), |e| e.0).map_or(0, |i| row[i].1)
    }

    /// The regions with a winding number other than zero in a face, and these numbers, by region.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// let mut drawing = Drawing::new(lar_core::Points::new(2));
    /// drawing.push_polygon("A", &[vec![[0., 0.], [0., 1.], [1., 1.]]]);
    /// let a = planar_arrangement(&drawing)?;
    /// assert_eq!(a.windings(lar_core::FaceId(1)).collect::<Vec<_>>(), [(0, -1)]);
    /// # Ok::<(), lar_arrangement::ArrangementError>(())
    /// ```
    pub fn windings(&self, face: FaceId) -> impl ExactSizeIterator<Item = (usize, i32)> + '_ {
        self.windings.of_cell(face.index()).iter().map(|&(region, winding)| (region as usize, winding))
    }

    /// What the outline of a region bounds.
    #[must_use]
    pub fn closure(&self, region: usize) -> Closure {
        self.windings.closure[region]
    }

    /// The faces where an expression over the regions holds. Face 0 is the exterior.
    /// O(faces · length of the expression).
    ///
    /// # Errors
    /// A region of the expression whose outline is open, or not oriented with a rule that needs it, or that does
    /// not exist.
    pub fn faces_where(&self, expression: &Expression, rule: FillRule) -> Result<Vec<FaceId>, BooleanError> {
        for region in expression.operands() {
            let Some(name) = self.regions.get(region) else {
                return Err(BooleanError::NoSuchSolid { solid: region, n_solids: self.regions.len() });
            };
            match self.windings.closure[region] {
                Closure::Closed => {}
                Closure::Unoriented if rule == FillRule::EvenOdd => {}
                Closure::Unoriented => return Err(BooleanError::Unoriented { solid: name.clone() }),
                Closure::Open => return Err(BooleanError::OpenOutline { region: name.clone() }),
            }
        }
        let holds = |face: &FaceId| expression.evaluate(|region| rule.is_inside(self.winding(*face, region)));
        Ok((0..=self.n_faces() as u32).map(FaceId).filter(holds).collect())
    }

    /// The bounded faces where an expression over the regions holds, joined to polygons with holes: faces side by
    /// side become one, straight edges are in one piece.
    ///
    /// ```
    /// use lar_arrangement::planar::{Drawing, planar_arrangement};
    /// use lar_arrangement::{Expression, FillRule};
    /// use lar_core::Points;
    /// let square = |x: f64, y: f64| vec![[x, y], [x + 2., y], [x + 2., y + 2.], [x, y + 2.]];
    /// let mut drawing = Drawing::new(Points::new(2));
    /// drawing.push_polygon("A", &[square(0., 0.)]);
    /// drawing.push_polygon("B", &[square(1., 1.)]);
    /// let a = planar_arrangement(&drawing)?;
    /// let both = a.boolean(&Expression::parse("A | B", &["A", "B"])?, FillRule::NonZero)?;
    /// assert_eq!((both.area(), both.polygons[0][0].len()), (7.0, 8));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`faces_where`](Self::faces_where).
    #[doc(alias = "bool2d")]
    pub fn boolean(&self, expression: &Expression, rule: FillRule) -> Result<Polygons, BooleanError> {
        Ok(self.polygons_of(&self.faces_where(expression, rule)?))
    }

    /// The union of some faces as polygons with holes: faces side by side become one, straight edges are in one
    /// piece. The exterior is left out. O(size of the arrangement).
    ///
    /// # Panics
    /// When there is no such face.
    #[must_use]
    pub fn polygons_of(&self, faces: &[FaceId]) -> Polygons {
        let faces: Vec<FaceId> = faces.iter().copied().filter(|face| face.0 != 0).collect();
        let mut number = vec![u32::MAX; self.n_faces() + 1];
        faces.iter().zip(0..).for_each(|(face, i)| number[face.index()] = i);
        let (mut loops, mut face_loops) = (lar_core::Cells::new(), vec![0]);
        for &face in &faces {
            self.loops_of(face).for_each(|cycle| loops.push(cycle));
            face_loops.push(loops.len() as u32);
        }
        let mut sets = UnionFind::new(faces.len());
        let mut unused = vec![true; self.n_edges()];
        loops.indices().iter().for_each(|h| unused[(h / 2) as usize] = false);
        let removed: Vec<bool> = self
            .faces_of_edges()
            .iter()
            .map(|sides| {
                let [a, b] = sides.map(|face| number[face as usize]);
                let between = a != u32::MAX && b != u32::MAX;
                if between {
                    sets.union(a, b);
                }
                between
            })
            .zip(&unused)
            .map(|(between, unused)| between || *unused)
            .collect();
        let (new_face, n_new_faces) = sets.labels();
        let edges = self.edges();
        let mut straight = merge::with_two_edges(self.n_vertices(), &edges, &removed, |_| true);
        straight.retain(|_, [e, f]| self.carrier_of[e as usize] == self.carrier_of[f as usize]);
        let view = Faces { edges: &edges, loops: &loops, face_loops: &face_loops };
        let removal = Removal {
            edges: &removed,
            new_face: &new_face,
            n_new_faces: n_new_faces as usize,
            vertices: &straight,
        };
        let points = self.complex().points();
        let at = |v: u32| [points.point(v as usize)[0], points.point(v as usize)[1], 0.0];
        let merged = merge::merge(&view, &removal, at);
        let mut out = Polygons { points: Points::new(2), polygons: Vec::new() };
        merged.vertices.iter().for_each(|&v| out.points.push(points.point(v as usize)));
        let tail = |&h: &u32| merged.edges[(h / 2) as usize][(h % 2) as usize];
        for range in merged.face_loops.windows(2) {
            let cycle = |l: u32| merged.loops[l as usize].iter().map(tail).collect();
            out.polygons.push((range[0]..range[1]).map(cycle).collect());
        }
        out
    }
}
