//! The surface of a solid as a 2-complex of its own, in fragments or simplified: faces of one plane with the same
//! sides become one, and vertices in the middle of straight edges disappear.
//!
//! Nothing is measured: two faces are in one plane when they are pieces of one planar polygon or when their exact
//! planes are equal; a vertex lies on a straight edge when its two edges lie on the same two planes.

use crate::boolean::Solid;
use crate::evaluator::Evaluator;
use crate::merge::{self, Faces, Merged, Removal};
use crate::operators::{boundary_1, boundary_2};
use crate::progress::{Cancelled, Course, Plan};
use crate::solid_complex::SolidComplex;
use crate::soup::Parent;
use crate::split::offsets;
use crate::stats::Stats;
use crate::union_find::UnionFind;
use crate::wrap;
use lar_core::{Cells, ChainComplex, FaceId, Points};

/// The stages of a surface, and their usual shares in the time.
pub(crate) const PLAN: &Plan =
    &[("surface", 40), ("coplanar faces", 20), ("straight edges", 15), ("loops", 15), ("complex", 10)];

/// Faces or edges a chunk of work.
const CHUNK: usize = 4096;

/// How much of the arrangement the surface of a solid shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// All faces of the arrangement.
    Fragments,
    /// Faces of one plane merged, straight edges in one piece.
    #[default]
    Simplified,
}

impl Solid<'_> {
    /// Its surface as a 2-complex. O(size of the surface) expected, with O(size of the arrangement) memory.
    #[must_use]
    pub fn to_complex(&self, detail: Detail) -> SolidComplex {
        Evaluator::new().detail(detail).surface(self).expect("nobody can ask it to stop")
    }
}

/// The surface of a solid as a 2-complex.
pub(crate) fn surface(
    solid: &Solid<'_>,
    detail: Detail,
    course: &Course,
    stats: &mut Stats,
) -> Result<SolidComplex, Cancelled> {
    course.begin("surface", stats)?;
    let surface = OutwardFaces::new(solid, course)?;
    course.begin("coplanar faces", stats)?;
    let (removed, new_face, n_new_faces) = match detail {
        Detail::Fragments => surface.all_faces(),
        Detail::Simplified => surface.merged_faces(course)?,
    };
    course.begin("straight edges", stats)?;
    let straight = match detail {
        Detail::Fragments => Default::default(),
        Detail::Simplified => surface.straight_vertices(&removed, &new_face),
    };
    course.begin("loops", stats)?;
    let points = solid.arrangement.complex().points();
    let origins = Origins::new(&surface, &new_face, n_new_faces);
    let (merged, vertices) = if removed.contains(&true) || !straight.is_empty() {
        let removal = Removal { edges: &removed, new_face: &new_face, n_new_faces, vertices: &straight };
        let position = |v: u32| points.xyz(surface.vertices[v as usize] as usize);
        let mut merged = merge::merge(&surface.loops_of_faces(), &removal, position);
        let kept = std::mem::take(&mut merged.vertices);
        (merged, kept.into_iter().map(|v| surface.vertices[v as usize]).collect())
    } else {
        surface.unchanged()
    };
    course.begin("complex", stats)?;
    Ok(finished(merged, origins, points, &vertices))
}

/// A surface whose vertices are some of the points.
fn finished(merged: Merged, origins: Origins, points: &Points, vertices: &[u32]) -> SolidComplex {
    let dim = points.dim();
    let mut coords = Vec::with_capacity(dim * vertices.len());
    vertices.iter().for_each(|&v| coords.extend_from_slice(points.point(v as usize)));
    let tail = |&h: &u32| merged.edges[(h / 2) as usize][(h % 2) as usize];
    let tails = merged.loops.indices().iter().map(tail).collect();
    let loops = Cells::from_parts(merged.loops.offsets().to_vec(), tails);
    let boundary_2 = boundary_2(merged.edges.len(), &merged.loops, &merged.face_loops);
    let boundary_1 = boundary_1(vertices.len(), merged.edges);
    SolidComplex {
        complex: ChainComplex::new(Points::from_columns(dim, coords), vec![boundary_1, boundary_2]),
        loops,
        face_loops: merged.face_loops,
        parents: origins.parents,
        parent_offsets: origins.parent_offsets,
        normals: origins.normals,
        pieces: origins.pieces,
    }
}

/// Where the faces of a surface come from.
struct Origins {
    parents: Vec<Parent>,
    parent_offsets: Vec<u32>,
    /// The first face of the arrangement that is part of each.
    pieces: Vec<(FaceId, i8)>,
    /// The normals of these.
    normals: Vec<[f64; 3]>,
}

impl Origins {
    fn new(surface: &OutwardFaces<'_>, new_face: &[u32], n_new_faces: usize) -> Self {
        let mut parents: Vec<(u32, Parent)> = Vec::with_capacity(surface.faces.len());
        // New faces are numbered as their first pieces come.
        let a = surface.solid.arrangement;
        let mut normals = Vec::with_capacity(n_new_faces);
        let mut pieces = Vec::with_capacity(n_new_faces);
        for (&(face, sign), &new) in surface.faces.iter().zip(new_face) {
            if normals.len() == new as usize {
                let normal = a.geometry.normal(a.facet_of_face[face.index()]);
                normals.push(normal.map(|x| x * f64::from(sign)));
                pieces.push((face, sign));
            }
            let signed = |p: &Parent| (new, Parent { sign: p.sign * sign, ..*p });
            parents.extend(a.parents(face).iter().map(signed));
        }
        parents.sort_unstable();
        parents.dedup();
        Self {
            parent_offsets: offsets(n_new_faces, parents.iter().map(|p| p.0)),
            parents: parents.into_iter().map(|p| p.1).collect(),
            pieces,
            normals,
        }
    }
}

/// The boundary faces of a solid with vertices and edges numbered anew, all turned outwards.
struct OutwardFaces<'a> {
    solid: &'a Solid<'a>,
    faces: Vec<(FaceId, i8)>,
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    loops: Cells,
    face_loops: Vec<u32>,
    /// The faces at each edge, by their numbers here.
    around: Cells,
}

impl<'a> OutwardFaces<'a> {
    fn new(solid: &'a Solid<'a>, course: &Course) -> Result<Self, Cancelled> {
        let a = solid.arrangement;
        let faces: Vec<(FaceId, i8)> = solid.boundary().collect();
        let half_edges = || faces.iter().flat_map(|&(face, _)| a.loop_range(face)).flat_map(|l| &a.loops[l]);
        let old_edges = compacted(half_edges().map(|h| h / 2), a.n_edges());
        course.go_on()?;
        let ends = |e: u32| [a.tail(2 * e), a.tail(2 * e + 1)];
        let vertices = compacted(old_edges.list.iter().flat_map(|&e| ends(e)), a.n_vertices());
        let edges: Vec<[u32; 2]> =
            old_edges.list.iter().map(|&e| ends(e).map(|v| vertices.new[v as usize])).collect();
        let mut loops = Cells::with_capacity(faces.len(), 3 * faces.len());
        let mut face_loops = Vec::with_capacity(faces.len() + 1);
        face_loops.push(0);
        let mut renamed: Vec<u32> = Vec::new();
        course.walk(faces.len(), CHUNK, |face| {
            let (old, sign) = faces[face];
            for l in a.loop_range(old) {
                let new = a.loops[l].iter().map(|h| 2 * old_edges.new[(h / 2) as usize] + h % 2);
                renamed.clear();
                if sign > 0 {
                    renamed.extend(new);
                } else {
                    renamed.extend(new.rev().map(|h| h ^ 1));
                }
                loops.push(&renamed);
            }
            face_loops.push(loops.len() as u32);
        })?;
        let (offsets, mut around) = wrap::faces_at_edges(edges.len(), &loops, &face_loops);
        around.iter_mut().for_each(|entry| *entry /= 2);
        let around = Cells::from_parts(offsets, around);
        Ok(Self { solid, faces, vertices: vertices.list, edges, loops, face_loops, around })
    }

    /// Whether two faces lie in one plane and look the same way.
    fn in_one_plane(&self, f: u32, g: u32) -> bool {
        let a = self.solid.arrangement;
        let [(f, f_sign), (g, g_sign)] = [f, g].map(|i| self.faces[i as usize]);
        if a.plane_of_face[f.index()] == a.plane_of_face[g.index()] {
            return f_sign == g_sign;
        }
        let [f, g] = [f, g].map(|i| a.facet_of_face[i.index()]);
        let same_way = a.geometry.same_way(f, g) == (f_sign == g_sign);
        same_way && a.geometry.is_coplanar(f, g)
    }

    /// No edge disappears, each face keeps its number.
    fn all_faces(&self) -> (Vec<bool>, Vec<u32>, usize) {
        let n = self.faces.len();
        (vec![false; self.edges.len()], (0..n as u32).collect(), n)
    }

    /// Which edges disappear between faces of one plane, and the new number of each face.
    fn merged_faces(&self, course: &Course) -> Result<(Vec<bool>, Vec<u32>, usize), Cancelled> {
        let mut removed = Vec::with_capacity(self.edges.len());
        course.walk(self.edges.len(), CHUNK, |edge| {
            removed.push(matches!(self.around[edge][..], [f, g] if self.in_one_plane(f, g)));
        })?;
        let (new_face, n) = self.joined(&removed);
        if merge::keep_folds(&self.loops_of_faces(), &mut removed, &new_face, n) {
            let (new_face, n) = self.joined(&removed);
            return Ok((removed, new_face, n));
        }
        Ok((removed, new_face, n))
    }

    fn joined(&self, removed: &[bool]) -> (Vec<u32>, usize) {
        let mut sets = UnionFind::new(self.faces.len());
        for (around, _) in self.around.iter().zip(removed).filter(|(_, removed)| **removed) {
            sets.union(around[0], around[1]);
        }
        let (labels, n) = sets.labels();
        (labels, n as usize)
    }

    fn loops_of_faces(&self) -> Faces<'_> {
        Faces { edges: &self.edges, loops: &self.loops, face_loops: &self.face_loops }
    }

    /// Vertices with two remaining edges that have the same two faces of different planes on both sides.
    fn straight_vertices(&self, removed: &[bool], new_face: &[u32]) -> rustc_hash::FxHashMap<u32, [u32; 2]> {
        let sides = |edge: u32| {
            let mut faces: Vec<u32> =
                self.around[edge as usize].iter().map(|&f| new_face[f as usize]).collect();
            faces.sort_unstable();
            faces
        };
        let mut candidates = merge::with_two_edges(self.vertices.len(), &self.edges, removed, |_| true);
        candidates.retain(|_, [e, f]| {
            let (a, b) = (sides(*e), sides(*f));
            a == b && a.len() >= 2 && a[0] != a[a.len() - 1]
        });
        candidates
    }

    /// The surface as it is, and the points that its vertices are.
    fn unchanged(self) -> (Merged, Vec<u32>) {
        let merged = Merged {
            vertices: Vec::new(),
            edges: self.edges,
            old_half_edge: Vec::new(),
            loops: self.loops,
            face_loops: self.face_loops,
        };
        (merged, self.vertices)
    }
}

/// Distinct numbers in ascending order, and the place of each in that list.
struct Compacted {
    list: Vec<u32>,
    new: Vec<u32>,
}

fn compacted(used: impl Iterator<Item = u32>, n: usize) -> Compacted {
    let mut is_used = vec![false; n];
    used.for_each(|x| is_used[x as usize] = true);
    let mut new = vec![0; n];
    let mut list = Vec::new();
    for x in (0..n).filter(|&x| is_used[x]) {
        new[x] = list.len() as u32;
        list.push(x as u32);
    }
    Compacted { list, new }
}
