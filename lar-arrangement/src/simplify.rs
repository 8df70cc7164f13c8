//! The surface of a solid as a 2-complex of its own, in fragments or simplified: faces of one plane with the same
//! sides become one, and vertices in the middle of straight edges disappear.
//!
//! Nothing is measured: two faces are in one plane when they are pieces of one planar polygon or when their exact
//! planes are equal; a vertex lies on a straight edge when its two edges lie on the same two planes.

use crate::arrangement::Arrangement;
use crate::boolean::Solid;
use crate::evaluator::Evaluator;
use crate::loops::LoopsOfFaces;
use crate::merge::{self, Faces, Merged, Passed, Removal};
use crate::operators::{Columns, boundary_1};
use crate::parallel;
use crate::progress::{Cancelled, Course, Plan};
use crate::solid_complex::SolidComplex;
use crate::soup::{Parent, Parents};
use crate::stats::Stats;
use crate::union_find::UnionFind;
use crate::wrap;
use lar_core::{Cells, ChainComplex, FaceId, Points};
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// The stages of a surface, and their usual shares in the time.
pub(crate) const PLAN: &Plan =
    &[("surface", 40), ("coplanar faces", 20), ("straight edges", 15), ("loops", 15), ("complex", 10)];

/// Blocks of edges that all threads look at between reports, which come from the caller's, and edges a block has at least.
const BLOCKS: usize = 32;
const LEAST_BLOCK: usize = 1 << 12;

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
    let faces = solid.boundary_faces();
    let surface = OutwardFaces::new(solid, &faces, course)?;
    course.begin("coplanar faces", stats)?;
    let joined = match detail {
        Detail::Fragments => surface.all_faces(),
        Detail::Simplified => surface.merged_faces(solid, &faces, course)?,
    };
    course.begin("straight edges", stats)?;
    let straight = || match detail {
        Detail::Fragments => Passed::default(),
        Detail::Simplified => surface.straight_vertices(&joined),
    };
    // One thread looks for these, the others for where faces come from.
    let (straight, origins) = parallel::join(straight, || Origins::new(solid.arrangement, faces, &joined));
    course.begin("loops", stats)?;
    let points = solid.arrangement.complex().points();
    let (merged, vertices) = if joined.is_any_removed() || !straight.is_empty() {
        let Joined { removed, n: n_new_faces, .. } = joined;
        let new_face = joined.new_face.unwrap_or_else(|| parallel::map_light(n_new_faces, |f| f as u32));
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
    let Merged { edges, loops: cycles, face_loops, .. } = merged;
    let n_edges = edges.len();
    let faces = Columns::of_faces(&cycles, &face_loops);
    let others = || {
        let coords = parallel::map_light(vertices.len(), |v| points.xyz(vertices[v] as usize));
        // Half-edges become the vertices that they begin at.
        let (offsets, mut loops) = cycles.into_parts();
        parallel::each_chunk(&mut loops, |_, chunk| {
            chunk.iter_mut().for_each(|h| *h = edges[(*h / 2) as usize][(*h % 2) as usize]);
        });
        let loops = Cells::from_parts(offsets, loops);
        (Points::from_columns(3, coords.into_flattened()), loops, boundary_1(vertices.len(), edges))
    };
    // One thread checks ∂2, the others have these to do beside it.
    let (boundary_2, (points, loops, boundary_1)) = parallel::join(|| faces.into_operator(n_edges), others);
    SolidComplex {
        complex: ChainComplex::new(points, vec![boundary_1, boundary_2]),
        loops,
        face_loops,
        parents: origins.parents,
        normals: origins.normals,
        pieces: origins.pieces,
    }
}

/// Where the faces of a surface come from.
struct Origins {
    parents: Parents,
    /// The first face of the arrangement that is part of each.
    pieces: Vec<(FaceId, i8)>,
    /// The normals of these.
    normals: Vec<[f64; 3]>,
}

impl Origins {
    /// Of faces of an arrangement with their signs, some of which become one.
    fn new(a: &Arrangement, faces: Vec<(FaceId, i8)>, joined: &Joined) -> Self {
        let normal = |(face, sign): (FaceId, i8)| {
            a.geometry.normal(a.facet_of_face[face.index()]).map(|x| x * f64::from(sign))
        };
        if !joined.is_any_removed() && a.parents.all.are_single() {
            let parent = |i: usize| a.parents(faces[i].0)[0].turned(faces[i].1);
            return Self {
                parents: Parents::single(parallel::map_light(faces.len(), parent)),
                normals: parallel::map_light(faces.len(), |i| normal(faces[i])),
                pieces: faces,
            };
        }
        let mut parents: Vec<(u32, Parent)> = Vec::with_capacity(faces.len());
        // New faces are numbered as their first pieces come.
        let mut pieces = Vec::with_capacity(joined.n);
        for (&(face, sign), f) in faces.iter().zip(0..) {
            let new = joined.new_face(f);
            if pieces.len() == new as usize {
                pieces.push((face, sign));
            }
            parents.extend(a.parents(face).iter().map(|p| (new, p.turned(sign))));
        }
        Self {
            parents: Parents::sorted(joined.n, parents),
            normals: pieces.iter().map(|&piece| normal(piece)).collect(),
            pieces,
        }
    }
}

/// What becomes of the faces of a surface.
struct Joined {
    /// Edges that disappear between faces that become one.
    removed: Vec<bool>,
    /// The new number of each face; none when each keeps its own, as no edge disappears.
    new_face: Option<Vec<u32>>,
    /// New faces.
    n: usize,
}

impl Joined {
    fn is_any_removed(&self) -> bool {
        self.new_face.is_some()
    }

    fn new_face(&self, face: u32) -> u32 {
        self.new_face.as_ref().map_or(face, |new| new[face as usize])
    }
}

/// Whether two faces with signs lie in one plane and look the same way.
fn in_one_plane(a: &Arrangement, [(f, f_sign), (g, g_sign)]: [(FaceId, i8); 2]) -> bool {
    if a.plane_of_face[f.index()] == a.plane_of_face[g.index()] {
        return f_sign == g_sign;
    }
    let [f, g] = [f, g].map(|i| a.facet_of_face[i.index()]);
    let same_way = a.geometry.same_way(f, g) == (f_sign == g_sign);
    same_way && a.geometry.is_coplanar(f, g)
}

/// The boundary faces of a solid with vertices and edges numbered anew, all turned outwards.
struct OutwardFaces {
    /// The points that are its vertices.
    vertices: Vec<u32>,
    edges: Vec<[u32; 2]>,
    loops: LoopsOfFaces,
    /// The faces at each edge, by their numbers here.
    around: Cells,
}

impl OutwardFaces {
    /// Those of a solid, with the signs that they have in its boundary.
    fn new(solid: &Solid<'_>, faces: &[(FaceId, i8)], course: &Course) -> Result<Self, Cancelled> {
        let a = solid.arrangement;
        let half_edges = |face: FaceId| a.loop_range(face).flat_map(|l| &a.loops[l]).copied();
        let old_edges = Compacted::new(a.n_edges(), faces.len(), |i| half_edges(faces[i].0).map(|h| h / 2));
        course.go_on()?;
        let ends = |i: usize| [0, 1].map(|end| a.tail(2 * old_edges.list[i] + end));
        let vertices = Compacted::new(a.n_vertices(), old_edges.list.len(), |i| ends(i).into_iter());
        let edges = parallel::map_light(old_edges.list.len(), |i| ends(i).map(|v| vertices.place(v)));
        course.go_on()?;
        let of_part = |part: usize| {
            let range = parallel::part_of(faces.len(), part);
            // The first part gets room for the others.
            let room = if part == 0 { faces.len() } else { range.len() };
            let mut loops = LoopsOfFaces::with_room(room, room, 3 * room);
            let mut renamed: Vec<u32> = Vec::new();
            for &(old, sign) in &faces[range] {
                for l in a.loop_range(old) {
                    let new = a.loops[l].iter().map(|h| 2 * old_edges.place(h / 2) + h % 2);
                    renamed.clear();
                    if sign > 0 {
                        renamed.extend(new);
                    } else {
                        renamed.extend(new.rev().map(|h| h ^ 1));
                    }
                    loops.push(&renamed);
                }
                loops.close();
            }
            loops
        };
        let loops = LoopsOfFaces::joined(parallel::map(parallel::n_threads(), of_part));
        course.go_on()?;
        let (offsets, mut around) = wrap::faces_at_edges(edges.len(), &loops.loops, &loops.face_loops);
        parallel::each_chunk(&mut around, |_, chunk| chunk.iter_mut().for_each(|entry| *entry /= 2));
        let around = Cells::from_parts(offsets, around);
        Ok(Self { vertices: vertices.list, edges, loops, around })
    }

    fn n_faces(&self) -> usize {
        self.loops.face_loops.len() - 1
    }

    /// No edge disappears, each face keeps its number.
    fn all_faces(&self) -> Joined {
        self.unjoined(vec![false; self.edges.len()])
    }

    /// Each face keeps its number, as none of the edges is removed.
    fn unjoined(&self, removed: Vec<bool>) -> Joined {
        Joined { removed, new_face: None, n: self.n_faces() }
    }

    /// Edges disappear between faces of one plane.
    fn merged_faces(
        &self,
        solid: &Solid<'_>,
        faces: &[(FaceId, i8)],
        course: &Course,
    ) -> Result<Joined, Cancelled> {
        let n = self.edges.len();
        let mut removed = Vec::with_capacity(n);
        let are_one = |f: u32, g: u32| in_one_plane(solid.arrangement, [f, g].map(|i| faces[i as usize]));
        let is_removed = |edge: usize| matches!(self.around[edge][..], [f, g] if are_one(f, g));
        let (n_blocks, range) = parallel::chunks(n, n.div_ceil(BLOCKS).max(LEAST_BLOCK));
        course.walk(n_blocks, 1, |block| {
            let edges = range(block);
            parallel::extend_light(&mut removed, edges.len(), |i| is_removed(edges.start + i));
        })?;
        let mut joined = self.joined(removed);
        if let Some(new_face) = &joined.new_face
            && merge::keep_folds(&self.loops_of_faces(), &mut joined.removed, new_face, joined.n)
        {
            joined = self.joined(joined.removed);
        }
        Ok(joined)
    }

    fn joined(&self, removed: Vec<bool>) -> Joined {
        if parallel::all(removed.len(), |edge| !removed[edge]) {
            return self.unjoined(removed);
        }
        let pairs = |edges: Range<usize>| {
            edges.filter(|&edge| removed[edge]).map(|edge| (self.around[edge][0], self.around[edge][1]))
        };
        let (new_face, n) = UnionFind::of_pairs(self.n_faces(), removed.len(), pairs).labels();
        Joined { removed, new_face: Some(new_face), n: n as usize }
    }

    fn loops_of_faces(&self) -> Faces<'_> {
        Faces { edges: &self.edges, loops: &self.loops.loops, face_loops: &self.loops.face_loops }
    }

    /// Vertices with two remaining edges that have the same two faces of different planes on both sides.
    fn straight_vertices(&self, joined: &Joined) -> Passed {
        let sides = |edge: u32| {
            let mut faces: Vec<u32> =
                self.around[edge as usize].iter().map(|&f| joined.new_face(f)).collect();
            faces.sort_unstable();
            faces
        };
        let mut candidates =
            merge::with_two_edges(self.vertices.len(), &self.edges, &joined.removed, |_| true);
        candidates.retain(|_, [e, f]| {
            let (a, b) = (sides(e), sides(f));
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
            loops: self.loops.loops,
            face_loops: self.loops.face_loops,
        };
        (merged, self.vertices)
    }
}

/// Distinct numbers in ascending order, and the place of each in that list.
struct Compacted {
    list: Vec<u32>,
    places: Vec<AtomicU32>,
}

impl Compacted {
    /// Those below n that some users use. O(n + uses).
    fn new<I: Iterator<Item = u32>>(
        n: usize,
        n_users: usize,
        used: impl Fn(usize) -> I + Sync + Send,
    ) -> Self {
        // Marks at first, the same whoever sets them; then places.
        let places = parallel::atomic_zeros(n);
        parallel::for_each(n_users, |user| used(user).for_each(|x| places[x as usize].store(1, Relaxed)));
        let list = parallel::select(n, |x| places[x as usize].load(Relaxed) != 0);
        parallel::for_each(list.len(), |i| places[list[i] as usize].store(i as u32, Relaxed));
        Self { list, places }
    }

    /// The place of a number that is used.
    fn place(&self, x: u32) -> u32 {
        self.places[x as usize].load(Relaxed)
    }
}
