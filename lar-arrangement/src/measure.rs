//! Measures of the cells: areas, volumes, the Euler characteristic, connected components.

use crate::arrangement::Arrangement;
use crate::union_find::UnionFind;
use lar_core::FaceId;

type Vec3 = [f64; 3];

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Arrangement {
    fn position(&self, v: u32) -> Vec3 {
        self.complex.points().xyz(v as usize)
    }

    /// The vector area of a face: its normal times its area. O(edges of the face).
    #[must_use]
    pub fn vector_area(&self, face: FaceId) -> Vec3 {
        let mut sum = [0.0; 3];
        let mut origin = None;
        for cycle in self.face_vertices(face) {
            let origin = *origin.get_or_insert_with(|| self.position(cycle[0]));
            for (i, &v) in cycle.iter().enumerate() {
                let a = sub(self.position(v), origin);
                let b = sub(self.position(cycle[(i + 1) % cycle.len()]), origin);
                let c = cross(a, b);
                (0..3).for_each(|k| sum[k] += c[k] / 2.0);
            }
        }
        sum
    }

    /// Area of the triangles between a corner of each loop of a face and its edges, whichever way they turn.
    pub(crate) fn fan_area(&self, face: FaceId) -> f64 {
        let mut sum = 0.0;
        for cycle in self.face_vertices(face) {
            for w in cycle.windows(2) {
                let [a, b] = [w[0], w[1]].map(|v| sub(self.position(v), self.position(cycle[0])));
                let c = cross(a, b);
                sum += dot(c, c).sqrt() / 2.0;
            }
        }
        sum
    }

    /// Area of a face.
    #[must_use]
    pub fn area(&self, face: FaceId) -> f64 {
        let a = self.vector_area(face);
        dot(a, a).sqrt()
    }

    /// Volumes of all 3-cells by the divergence theorem; that of the exterior is minus the sum of the others.
    /// O(size of the complex).
    #[must_use]
    pub fn volumes(&self) -> Vec<f64> {
        let n = self.n_cells();
        let mut volumes = vec![0.0; n];
        // Each cell is measured from one of its own vertices, so that small cells far from the origin keep digits.
        let mut origins: Vec<Option<Vec3>> = vec![None; n];
        for (face, cells) in (0..).map(FaceId).zip(&self.cells_of_face) {
            let [front, back] = *cells;
            if front == back {
                continue;
            }
            let (l, area) = (self.face_loops[face.index()] as usize, self.vector_area(face));
            let at = self.position(self.tail(self.loops[l][0]));
            for (cell, sign) in [(front, -1.0), (back, 1.0)] {
                let origin = *origins[cell as usize].get_or_insert(at);
                volumes[cell as usize] += sign * dot(sub(at, origin), area) / 3.0;
            }
        }
        volumes
    }

    /// V − E + Σ over faces of (2 − loops) − Σ over cells of χ(boundary) / 2, which is 0 for every partition of
    /// space. O(n log n).
    ///
    /// The boundary of a cell is taken as that of the cell shrunk a little: where the cell is pinched at a vertex,
    /// the corners of its shells there are counted by the regions of the vertex's link, the small sphere around
    /// the vertex that the faces cut. So a wrong angular order around any edge shows up as a non-zero result.
    #[must_use]
    pub fn euler(&self) -> i64 {
        let sides: i64 = self.face_loops.windows(2).map(|w| 2 - i64::from(w[1] - w[0])).sum();
        let corners = self.loops.indices().len() as i64;
        let (orbits, link_components, isolated) = self.link_counts();
        let vertices_of_cells = orbits - 2 * (link_components - (self.n_vertices() as i64 - isolated));
        let chi = vertices_of_cells - corners + 2 * sides;
        let twice = 2 * (self.n_vertices() as i64 - self.n_edges() as i64 + sides) - chi;
        if twice % 2 == 0 { twice / 2 } else { twice }
    }

    /// Over all vertices: cycles of corner sides around them, components of their links, and vertices without any.
    fn link_counts(&self) -> (i64, i64, i64) {
        let half_edges = self.loops.indices();
        // A corner is named by the position of the half-edge that enters it.
        let mut before = vec![0u32; half_edges.len()];
        for w in self.loops.offsets().windows(2) {
            for i in w[0]..w[1] {
                before[i as usize] = if i == w[0] { w[1] - 1 } else { i - 1 };
            }
        }
        let position_of = self.positions_by_ring();
        let mut sides = UnionFind::new(2 * half_edges.len());
        let mut corners = UnionFind::new(half_edges.len());
        for (ring, edge) in self.rings.iter().zip(0..) {
            for end in 0..2u32 {
                let corner = |i: usize| {
                    let position = position_of[edge][i % ring.len()];
                    // Running towards this end, the half-edge enters the corner; otherwise it leaves it.
                    if ring[i % ring.len()] % 2 == 1 - end { position } else { before[position as usize] }
                };
                for (i, &entry) in ring.iter().enumerate() {
                    let next = ring[(i + 1) % ring.len()];
                    sides.union(2 * corner(i) + entry % 2, 2 * corner(i + 1) + (next ^ 1) % 2);
                    corners.union(corner(i), corner(i + 1));
                }
            }
        }
        let mut used = vec![false; self.n_vertices()];
        half_edges.iter().for_each(|&h| used[self.tail(h) as usize] = true);
        let isolated = used.iter().filter(|u| !**u).count();
        (i64::from(sides.labels().1), i64::from(corners.labels().1), isolated as i64)
    }

    /// For each edge and each entry of its ring, the position of that half-edge in the loops.
    fn positions_by_ring(&self) -> Vec<Vec<u32>> {
        let mut found: Vec<Vec<(u32, u32)>> = vec![Vec::new(); self.n_edges()];
        for face in 0..self.n_faces() as u32 {
            let range = self.face_loops[face as usize] as usize..self.face_loops[face as usize + 1] as usize;
            for l in range {
                let begin = self.loops.offsets()[l];
                for (&h, position) in self.loops[l].iter().zip(begin..) {
                    found[(h / 2) as usize].push((2 * face + h % 2, position));
                }
            }
        }
        found
            .into_iter()
            .zip(self.rings.iter())
            .map(|(mut found, ring)| {
                found.sort_unstable();
                let position = |entry: &u32| {
                    let at = found
                        .binary_search_by_key(entry, |f| f.0)
                        .expect("rings and loops hold the same sides");
                    found[at].1
                };
                ring.iter().map(position).collect()
            })
            .collect()
    }

    /// Number of connected components of the union of all faces. O(n α(n)).
    #[must_use]
    pub fn n_components(&self) -> usize {
        let n = self.n_vertices();
        let mut sets = UnionFind::new(n + self.n_faces());
        for face in 0..self.n_faces() as u32 {
            for cycle in self.face_vertices(FaceId(face)) {
                cycle.iter().for_each(|&v| {
                    sets.union(v, n as u32 + face);
                });
            }
        }
        sets.labels().1 as usize
    }
}
