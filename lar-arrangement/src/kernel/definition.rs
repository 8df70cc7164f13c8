//! Definitions of vertices. Where planes are shared, the same point is found in many ways: it then gets, as far as that
//! can be told cheaply, one definition, by three of these planes, and needs no arithmetic to be known as one.

use super::geometry::{Geometry, Support, Vertex, VertexDef};
use super::point::Plane;

/// Of so many shared planes at most it is tried which three define a vertex.
const MOST_PLANES: usize = 6;

impl Geometry {
    /// The definition of the point where an edge meets the plane of a facet. Its ends must lie strictly on either side.
    pub(crate) fn edge_definition(&self, ends: [u32; 2], facet: u32) -> VertexDef {
        let of_facet = self.shared_plane(facet).map(|(plane, _)| plane).into_iter();
        self.on_three_planes(ends, of_facet).unwrap_or_else(|| {
            let support = Support::Facet(self.first_in_plane(facet));
            VertexDef::EdgePlane { ends, support }
        })
    }

    /// The definition of the point where two edges in the plane of a facet, which is not parallel to the axis, cross.
    pub(crate) fn crossing_definition(&self, edges: [[u32; 2]; 2], facet: u32, axis: usize) -> VertexDef {
        let [e, h] = edges;
        if let Some(def) = self.on_three_planes(e, self.planes_of_edge(h)) {
            return def;
        }
        // As where one of them meets another shared plane that holds the other.
        let beside = |edge: [u32; 2]| {
            let mut others = self.planes_of_edge(edge).filter_map(|plane| self.first_on_plane(plane));
            others.find(|&other| self.is_across(other, facet))
        };
        let on_plane = |ends: [u32; 2], other: [u32; 2]| {
            beside(other).map(|f| VertexDef::EdgePlane { ends, support: Support::Facet(f) })
        };
        on_plane(e, h).or_else(|| on_plane(h, e)).unwrap_or_else(|| {
            let support = Support::Vertical { ends: h, axis: axis as u8 };
            VertexDef::EdgePlane { ends: e, support }
        })
    }

    /// The vertex on an edge by its definition.
    pub(crate) fn vertex_on_edge(&self, def: VertexDef) -> Vertex {
        Vertex { at: self.rounded(&def), def, is_on_edge: true }
    }

    /// The vertex on three facet planes that are known to meet in one point.
    pub(crate) fn facets_vertex(&self, facets: [u32; 3]) -> Vertex {
        let mut facets = facets.map(|f| self.first_in_plane(f));
        facets.sort_unstable();
        let def = VertexDef::Facets(facets);
        Vertex { at: self.rounded(&def), def, is_on_edge: false }
    }

    /// The first facet on the shared plane of a facet; itself, when it shares none.
    pub(crate) fn first_in_plane(&self, facet: u32) -> u32 {
        self.shared_plane(facet).and_then(|(plane, _)| self.first_on_plane(plane)).unwrap_or(facet)
    }

    /// A coordinate of a vertex, numerator and positive denominator, where a plane at right angles to the axis holds the
    /// vertex by its definition, or it is on an edge of the grid and a plane at right angles to another axis: of at most 83 and
    /// 42 bits.
    pub(super) fn coordinate(&self, def: &VertexDef, axis: usize) -> Option<[i128; 2]> {
        match *def {
            VertexDef::Point(p) => self.coordinate_of_point(p, axis),
            VertexDef::EdgePlane { ends, support } => {
                let on_plane = match support {
                    Support::Facet(f) => self.coordinate_of_facet(f, axis),
                    Support::Vertical { axis: along, .. } if usize::from(along) == axis => None,
                    Support::Vertical { ends, .. } => self.coordinate_of_edge(ends, axis),
                };
                on_plane.or_else(|| self.coordinate_of_edge(ends, axis)).or_else(|| match support {
                    Support::Facet(f) => self.coordinate_of_crossing(ends, f, axis),
                    Support::Vertical { .. } => None,
                })
            }
            VertexDef::Facets(facets) => facets.into_iter().find_map(|f| self.coordinate_of_facet(f, axis)),
        }
    }

    fn coordinate_of_point(&self, p: u32, axis: usize) -> Option<[i128; 2]> {
        if let Some(point) = self.grid_point(p) {
            return Some([point[axis].into(), 1]);
        }
        let mut planes = self.planes_of_point(p).iter().filter_map(|&plane| self.canonical_plane(plane));
        planes.find_map(|plane| coordinate_of_plane(plane, axis))
    }

    /// Of an edge at right angles to the axis.
    pub(super) fn coordinate_of_edge(&self, ends: [u32; 2], axis: usize) -> Option<[i128; 2]> {
        let [p, q] = ends.map(|p| self.coordinate_of_point(p, axis));
        p.filter(|_| p == q)
    }

    /// Of the point where an edge of the grid passes through a facet of the grid at right angles to another axis.
    fn coordinate_of_crossing(&self, ends: [u32; 2], facet: u32, axis: usize) -> Option<[i128; 2]> {
        let [p, q] = ends.map(|p| self.grid_point(p));
        let (p, q) = (p?, q?);
        let across = (1..3).map(|k| (axis + k) % 3).find(|&k| p[k] != q[k])?;
        let [at, 1] = self.coordinate_of_facet(facet, across)? else { return None };
        let step = |k: usize| i128::from(q[k] - p[k]);
        let (whole, part) = (step(across), at - i128::from(p[across]));
        // Coordinates are at most 2^40 and their differences 2^41, so the numerator is below 2^83.
        let numerator = i128::from(p[axis]) * whole + step(axis) * part;
        Some(if whole > 0 { [numerator, whole] } else { [-numerator, -whole] })
    }

    /// Of a facet at right angles to the axis.
    fn coordinate_of_facet(&self, facet: u32, axis: usize) -> Option<[i128; 2]> {
        let normal = self.normal(facet);
        if normal[(axis + 1) % 3] != 0.0 || normal[(axis + 2) % 3] != 0.0 {
            return None;
        }
        match self.shared_plane(facet) {
            Some((plane, _)) => coordinate_of_plane(self.canonical_plane(plane)?, axis),
            None => self.coordinate_of_point(self.base(facet)[0], axis),
        }
    }

    /// The shared planes that both ends of an edge lie on by definition, ascending.
    pub(super) fn planes_of_edge(&self, ends: [u32; 2]) -> impl Iterator<Item = u32> + '_ {
        let [few, many] = {
            let [a, b] = ends.map(|p| self.planes_of_point(p));
            if a.len() <= b.len() { [a, b] } else { [b, a] }
        };
        few.iter().copied().filter(|plane| many.binary_search(plane).is_ok())
    }

    /// A point of an edge, and on some shared planes, by three canonical planes that meet in no other point: the first such
    /// among these planes and those that hold the edge.
    fn on_three_planes(&self, ends: [u32; 2], others: impl Iterator<Item = u32>) -> Option<VertexDef> {
        let (mut planes, mut n) = ([0; MOST_PLANES], 0);
        let (of_edge, others) =
            (self.planes_of_edge(ends).take(MOST_PLANES / 2), others.take(MOST_PLANES / 2));
        for plane in of_edge.chain(others) {
            planes[n] = plane;
            n += 1;
        }
        let planes = &mut planes[..n];
        planes.sort_unstable();
        let on = |plane: &u32| self.first_on_plane(*plane).filter(|_| self.canonical_plane(*plane).is_some());
        let mut facets = planes.iter().filter_map(on);
        let a = facets.next()?;
        let b = facets.find(|&b| self.is_across(a, b))?;
        let c = facets.find(|&c| self.meet_in_one_point([a, b, c]))?;
        let mut facets = [a, b, c];
        facets.sort_unstable();
        Some(VertexDef::Facets(facets))
    }

    /// Whether the planes of three facets meet in one point beyond doubt.
    fn meet_in_one_point(&self, [a, b, c]: [u32; 3]) -> bool {
        let ((line, error), n) = (self.cross_product([a, b]), self.normal(c));
        let terms: [f64; 3] = std::array::from_fn(|k| n[k] * line[k]);
        let magnitude: f64 = terms.iter().map(|x| x.abs()).sum();
        let of_line: f64 = n.iter().map(|x| x.abs() * error).sum();
        // The components of n are off by 2^-52, and there are four roundings of 2^-53 in a term.
        (terms[0] + terms[1] + terms[2]).abs() > 2.0 * of_line + magnitude * 2f64.powi(-50)
    }
}

/// Of a plane at right angles to the axis.
fn coordinate_of_plane(plane: &Plane, axis: usize) -> Option<[i128; 2]> {
    let is_upright = plane.n[(axis + 1) % 3] == 0 && plane.n[(axis + 2) % 3] == 0;
    is_upright.then(|| if plane.n[axis] > 0 { [plane.d, plane.n[axis]] } else { [-plane.d, -plane.n[axis]] })
}
