//! Polygonal surfaces: faces as oriented loops of vertices, with holes; the input of an arrangement.

use crate::{Affine, AffineError, Cells, Points, Precision, TriangleMesh};

/// Polygonal faces in 3-space. A face is one outer loop and any number of hole loops, each a cyclic list of
/// vertices; seen from the tip of its normal the outer loop turns counter-clockwise, holes clockwise.
/// Faces may cross each other, repeat, touch, leave the surface open. A face stands for the sum of its loops: one that is
/// no hole of the first (it crosses it, lies outside, turns the same way) counts where it turns counter-clockwise as one
/// more layer, clockwise as one less.
///
/// `loops[l]` lists the vertices of loop l; `face_loops[f]..face_loops[f + 1]` are the loops of face f, the
/// outer one first. `coefficients[f]` is the face's coefficient (−1, 0, +1, …) in the boundary of the solid
/// that the surface bounds: 0 for an inner wall, which divides space but bounds nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name, for messages and expressions.
    pub name: String,
    /// 3 × n.
    pub points: Points,
    /// How coarsely the coordinates were rounded where they come from: what tells which faces were meant to be
    /// coplanar. Readers of files set it; moving the surface keeps it.
    pub precision: Precision,
    loops: Cells,
    face_loops: Vec<u32>,
    coefficients: Vec<i8>,
    /// Whether each face is one loop of three vertices.
    are_triangles: bool,
}

impl Surface {
    /// A surface without faces.
    #[must_use]
    pub fn new(name: impl Into<String>, points: Points) -> Self {
        Self {
            name: name.into(),
            points,
            precision: Precision::F64,
            loops: Cells::new(),
            face_loops: vec![0],
            coefficients: Vec::new(),
            are_triangles: true,
        }
    }

    /// Appends a face: its outer loop first, then its holes. Returns its index.
    pub fn push_face<'a>(&mut self, loops: impl IntoIterator<Item = &'a [u32]>, coefficient: i8) -> usize {
        let first = self.loops.len();
        for cycle in loops {
            self.loops.push(cycle);
        }
        self.are_triangles &= self.loops.len() == first + 1 && self.loops[first].len() == 3;
        self.face_loops.push(u32::try_from(self.loops.len()).expect("fewer than 2^32 loops"));
        self.coefficients.push(coefficient);
        self.coefficients.len() - 1
    }

    /// Number of faces.
    #[must_use]
    pub fn n_faces(&self) -> usize {
        self.coefficients.len()
    }

    /// The loops of face `f`, the outer one first.
    pub fn face(&self, f: usize) -> impl ExactSizeIterator<Item = &[u32]> + Clone + '_ {
        (self.face_loops[f]..self.face_loops[f + 1]).map(|l| &self.loops[l as usize])
    }

    /// The vertices of the faces, three for each, when all faces are triangles without holes.
    ///
    /// ```
    /// use lar_core::{Cells, Surface, cuboid_grid, icosphere};
    /// let ball = Surface::from_triangles("ball", &icosphere(0));
    /// assert_eq!(ball.triangles().map(<[u32]>::len), Some(60));
    /// assert_eq!(cuboid_grid(&[1, 1, 1]).to_surface("cube")?.triangles(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn triangles(&self) -> Option<&[u32]> {
        self.are_triangles.then(|| self.loops.indices())
    }

    /// The coefficient of face `f` in the boundary of the solid.
    #[must_use]
    #[inline]
    pub fn coefficient(&self, f: usize) -> i8 {
        self.coefficients[f]
    }

    /// Faces of one loop each, all of coefficient +1. O(n); the arrays are taken over as they are.
    ///
    /// ```
    /// use lar_core::{Cells, Points, Surface};
    /// let points = Points::from_xyz(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    /// let surface = Surface::from_polygons("square", points, Cells::uniform(4, vec![0, 1, 2, 3]));
    /// assert_eq!((surface.n_faces(), surface.coefficient(0)), (1, 1));
    /// ```
    #[must_use]
    pub fn from_polygons(name: impl Into<String>, points: Points, polygons: Cells) -> Self {
        let n_faces = polygons.len();
        let face_loops = (0..=u32::try_from(n_faces).expect("fewer than 2^32 loops")).collect();
        let are_triangles = polygons.iter().all(|polygon| polygon.len() == 3);
        Self {
            name: name.into(),
            points,
            precision: Precision::F64,
            loops: polygons,
            face_loops,
            coefficients: vec![1; n_faces],
            are_triangles,
        }
    }

    /// The vertices of a triangle mesh and its triangles as faces of coefficient +1.
    #[must_use]
    pub fn from_triangles(name: impl Into<String>, mesh: &TriangleMesh) -> Self {
        let mut surface = Self::new(name, mesh.points.clone());
        for triangle in &mesh.triangles {
            surface.push_face([&triangle[..]], 1);
        }
        surface
    }

    /// The surface moved by an affine map; all loops are reversed when the map mirrors, so that outward faces
    /// stay outward. O(size).
    ///
    /// # Errors
    /// When the map is not of 3-space.
    pub fn transformed(&self, map: &Affine) -> Result<Self, AffineError> {
        let mut moved = Self { points: map.apply(&self.points)?, ..self.clone() };
        if map.is_mirror() {
            moved.loops = self.loops.iter().map(|l| l.iter().rev().copied().collect::<Vec<_>>()).collect();
        }
        Ok(moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_known_however_faces_come() {
        let (outer, hole, quad) = ([0, 1, 2], [3, 4, 5], [0, 1, 2, 3]);
        let mut surface = Surface::new("faces", Points::from_xyz(&[[0.0; 3]; 6]));
        assert_eq!(surface.triangles(), Some(&[][..]));
        surface.push_face([&outer[..]], 1);
        surface.push_face([&hole[..]], 1);
        assert_eq!(surface.triangles(), Some(&[0, 1, 2, 3, 4, 5][..]));
        for odd in [vec![&outer[..], &hole], vec![&quad[..]], vec![]] {
            let mut mixed = surface.clone();
            mixed.push_face(odd, 1);
            mixed.push_face([&outer[..]], 1);
            assert_eq!(mixed.triangles(), None);
        }
        let polygons = |lists: &[&[u32]]| {
            let cells = lists.iter().map(|l| l.to_vec()).collect();
            Surface::from_polygons("polygons", surface.points.clone(), cells).triangles().map(<[u32]>::len)
        };
        assert_eq!(polygons(&[&outer, &hole]), Some(6));
        assert_eq!(polygons(&[&outer, &quad]), None);
    }
}
