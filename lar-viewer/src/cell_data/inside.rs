//! A point well inside of each cell, where a label stands: a face with a hole need not contain its centroid, nor a bent
//! solid.

mod polygon;
mod solid;

use super::CellData;
use crate::{Bounds, CellRef};
use glam::DVec3;

/// How far the number of the exterior stands from the box around the model, in parts of the box's diagonal.
const BESIDE: f64 = 0.04;

impl CellData {
    /// A point of the cell far from its boundary: the centroid where that is deep inside, else nearly the centre of the
    /// largest disc in a face; in a solid the middle of a chord with room around it, provided the triangles of its faces are
    /// known. For the exterior a point beside the corner of the model's box; the origin when there is no such cell.
    ///
    /// It is for labels: rounded, and no more than a good place. For a cell of n edges or triangles it takes O(n) where the
    /// centroid will do, otherwise O(n) for each of some hundred probes.
    ///
    /// ```
    /// use lar_core::{ChainComplex, cuboid_grid};
    /// use lar_viewer::{CellData, CellRef};
    /// let bar = CellData::new(ChainComplex::from_model(&cuboid_grid(&[2, 1, 1]))?)?;
    /// assert_eq!(bar.inside(CellRef::new(3, 1)), [1.5, 0.5, 0.5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn inside(&self, cell: CellRef) -> [f64; 3] {
        match cell.dim {
            _ if !self.contains(cell) => [0.0; 3],
            _ if self.is_exterior(cell) => self.beside(),
            2 => self.inside_face(cell),
            3 => solid::deep_point(&self.outward(cell), self.middle(cell).into()).to_array(),
            _ => self.middle(cell),
        }
    }

    /// A point beside the highest corner of the box around everything.
    fn beside(&self) -> [f64; 3] {
        let points = (0..self.n_cells(0) as u32).filter_map(|v| self.position(v));
        let Some(bounds) = Bounds::of(points) else { return [0.0; 3] };
        let away = 2.0 * BESIDE * bounds.radius();
        let flat = self.complex().points().dim() < 3;
        std::array::from_fn(|k| if flat && k == 2 { 0.0 } else { bounds.max[k] + away })
    }

    fn inside_face(&self, face: CellRef) -> [f64; 3] {
        let at = |&v: &u32| self.position(v).unwrap_or_default().into();
        let loops = self.complex().face_loops(face.index as usize);
        let loops: Vec<Vec<DVec3>> = loops.iter().map(|l| l.iter().map(at).collect()).collect();
        let middle = DVec3::from(self.middle(face));
        let Some(normal) = area_vector(&loops, middle).try_normalize() else { return middle.to_array() };
        let (u, v) = normal.any_orthonormal_pair();
        let flat = |p: &DVec3| [u.dot(*p - middle), v.dot(*p - middle)];
        let flat: Vec<Vec<[f64; 2]>> = loops.iter().map(|l| l.iter().map(flat).collect()).collect();
        let [x, y] = polygon::deep_point(&flat);
        (middle + x * u + y * v).to_array()
    }

    /// The triangles of the boundary of a cell of dimension 3, counter-clockwise from outside.
    fn outward(&self, cell: CellRef) -> Vec<[DVec3; 3]> {
        let boundary = self.boundary(cell);
        let faces = boundary.iter().flat_map(lar_core::Chain::entries);
        let corner = |v: u32| DVec3::from(self.position(v).unwrap_or_default());
        let triangles = faces.flat_map(|&(face, sign)| {
            self.triangles(face).iter().map(move |&[a, b, c]| if 0 < sign { [a, b, c] } else { [a, c, b] })
        });
        triangles.map(|t| t.map(corner)).collect()
    }
}

/// Twice the area of loops, along their normal; `near` is a point near them.
fn area_vector(loops: &[Vec<DVec3>], near: DVec3) -> DVec3 {
    let of_loop = |l: &Vec<DVec3>| -> DVec3 {
        let next = l.iter().cycle().skip(1);
        l.iter().zip(next).map(|(a, b)| (*a - near).cross(*b - near)).sum()
    };
    loops.iter().map(of_loop).sum()
}
