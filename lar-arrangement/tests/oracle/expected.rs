//! What the arrangement of convex faces with convex holes must be, counted on the convex pieces that their planes
//! make of space.
//!
//! The planes are those of the faces and, for each edge of a face, one more through the edge: so each wall lies in a
//! face or outside of it. Cells are the pieces joined across walls in no face. An edge of a wall belongs to the
//! skeleton when it lies on an edge of a face or walls of two planes that lie in faces meet there; a corner is a
//! vertex when edges of the skeleton leave it in two directions or more that are not opposite; faces are the walls
//! in faces, joined across all other edges.

use super::pieces::{Corner, Piece, Plane, corner, cut_cube, plane_through, side, volume};
use std::collections::{BTreeMap, BTreeSet};

/// A convex loop, and one or none in it that is its hole.
pub(crate) type Face = Vec<Vec<[i32; 3]>>;

/// Larger than any coordinate of a scene.
const REACH: i32 = 16;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Expected {
    /// Vertices, edges, faces, cells with the exterior.
    pub(crate) counts: [usize; 4],
    /// Volume and membership in the convex solids of the bounded cells.
    pub(crate) cells: Vec<(f64, Vec<bool>)>,
}

/// A face's plane, and for the outline and the hole the planes through their edges, positive inside.
struct Facet {
    plane: usize,
    loops: Vec<Vec<Plane>>,
}

impl Facet {
    fn in_loop(&self, number: usize, points: &[Corner]) -> bool {
        let inside = |p: &Corner| self.loops[number].iter().all(|e| side(e, p) >= 0);
        self.loops.len() > number && points.iter().all(inside)
    }

    fn contains(&self, planes: &[Plane], points: &[Corner]) -> bool {
        let in_plane = points.iter().all(|p| side(&planes[self.plane], p) == 0);
        in_plane && self.in_loop(0, points) && !self.in_loop(1, points)
    }

    fn has_on_edge(&self, planes: &[Plane], points: &[Corner]) -> bool {
        let in_plane = points.iter().all(|p| side(&planes[self.plane], p) == 0);
        let on = |number: usize| {
            let on_one = |e: &Plane| points.iter().all(|p| side(e, p) == 0);
            self.in_loop(number, points) && self.loops[number].iter().any(on_one)
        };
        in_plane && (0..self.loops.len()).any(on)
    }
}

/// Planes without repetition, whatever their sign.
#[derive(Default)]
struct Planes {
    list: Vec<Plane>,
}

impl Planes {
    fn number(&mut self, plane: Plane) -> usize {
        let opposite = plane.map(|x| -x);
        self.list.iter().position(|p| *p == plane || *p == opposite).unwrap_or_else(|| {
            self.list.push(plane);
            self.list.len() - 1
        })
    }

    /// `None` when the face has no area.
    fn facet(&mut self, face: &Face) -> Option<Facet> {
        let own = plane_of(&face[0])?;
        let plane = self.number(own);
        let loops = face.iter().map(|corners| self.around(corners, plane, &own)).collect();
        Some(Facet { plane, loops })
    }

    /// Planes through the edges of a loop; those of other faces where they fit.
    fn around(&mut self, corners: &[[i32; 3]], plane: usize, own: &Plane) -> Vec<Plane> {
        let edge = |k: usize| {
            let [p, q] = [corners[k], corners[(k + 1) % corners.len()]];
            let holds = |number: usize| {
                number != plane && [p, q].iter().all(|&x| side(&self.list[number], &corner(x)) == 0)
            };
            let number = (0..self.list.len()).find(|&n| holds(n)).unwrap_or_else(|| {
                let beside = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter();
                let tip = beside.map(|d| [0, 1, 2].map(|i| p[i] + d[i]));
                let mut off = tip.filter(|&t| side(own, &corner(t)) != 0);
                let tip = off.next().expect("one axis leaves the plane");
                self.number(plane_through(p, q, tip).expect("the tip is off the edge"))
            });
            let across = self.list[number];
            let inward = corners.iter().any(|&c| side(&across, &corner(c)) > 0);
            if inward { across } else { across.map(|x| -x) }
        };
        (0..corners.len()).map(edge).collect()
    }
}

/// The plane of a convex loop; `None` when it has no area.
pub(crate) fn plane_of(corners: &[[i32; 3]]) -> Option<Plane> {
    plane_through(corners[0], corners[1], corners[2])
}

/// The arrangement of faces; `solids` are convex, given by the inner sides of planes.
pub(crate) fn expected(faces: &[Face], solids: &[Vec<Plane>]) -> Expected {
    let mut planes = Planes::default();
    faces.iter().filter_map(|f| plane_of(&f[0])).for_each(|p| {
        planes.number(p);
    });
    let facets: Vec<Facet> = faces.iter().filter_map(|f| planes.facet(f)).collect();
    let pieces = cut_cube(REACH, &planes.list);
    let walls = Walls::new(&pieces, &facets, &planes.list);
    let cells = walls.cells(&pieces, solids, planes.list.len());
    let skeleton = walls.skeleton(&facets, &planes.list);
    let counts = [n_vertices(&skeleton), n_edges(&skeleton), walls.n_faces(&skeleton), cells.len() + 1];
    Expected { counts, cells }
}

/// The walls between two pieces, by their corners.
struct Walls {
    /// Plane, pieces on both sides, whether in a face.
    of_corners: BTreeMap<Vec<Corner>, (usize, Vec<usize>, bool)>,
    /// For each edge the walls in faces at it.
    at_edge: BTreeMap<[Corner; 2], Vec<Vec<Corner>>>,
}

impl Walls {
    fn new(pieces: &[Piece], facets: &[Facet], planes: &[Plane]) -> Self {
        let mut out = Self { of_corners: BTreeMap::new(), at_edge: BTreeMap::new() };
        for (number, piece) in pieces.iter().enumerate() {
            for wall in piece {
                let mut key = wall.corners.clone();
                key.sort_unstable();
                if let Some((_, sides, _)) = out.of_corners.get_mut(&key) {
                    sides.push(number);
                    continue;
                }
                let covered = facets.iter().any(|f| f.contains(planes, &wall.corners));
                if covered {
                    for (i, &a) in wall.corners.iter().enumerate() {
                        let b = wall.corners[(i + 1) % wall.corners.len()];
                        out.at_edge.entry([a.min(b), a.max(b)]).or_default().push(key.clone());
                    }
                }
                out.of_corners.insert(key, (wall.plane, vec![number], covered));
            }
        }
        out
    }

    /// Volumes and memberships of the bounded cells.
    fn cells(&self, pieces: &[Piece], solids: &[Vec<Plane>], n_planes: usize) -> Vec<(f64, Vec<bool>)> {
        let mut sets = Sets::new(pieces.len() + 1);
        for (plane, sides, covered) in self.of_corners.values() {
            match sides[..] {
                [a, b] if !covered => sets.join(a, b),
                [a] if *plane >= n_planes => sets.join(a, pieces.len()),
                _ => {}
            }
        }
        let mut cells: BTreeMap<usize, (f64, Vec<bool>)> = BTreeMap::new();
        for (number, piece) in pieces.iter().enumerate() {
            let root = sets.root(number);
            if root == sets.root(pieces.len()) {
                continue;
            }
            let holds = |solid: &Vec<Plane>| {
                piece.iter().flat_map(|w| &w.corners).all(|c| solid.iter().all(|p| side(p, c) >= 0))
            };
            let inside: Vec<bool> = solids.iter().map(holds).collect();
            let cell = cells.entry(root).or_insert_with(|| (0.0, inside.clone()));
            assert_eq!(cell.1, inside, "pieces of one cell lie in the same solids");
            cell.0 += volume(piece);
        }
        cells.into_values().collect()
    }

    /// The edges of the skeleton.
    fn skeleton(&self, facets: &[Facet], planes: &[Plane]) -> BTreeSet<[Corner; 2]> {
        let kept = |edge: &[Corner; 2], walls: &[Vec<Corner>]| {
            let plane = |w: &Vec<Corner>| self.of_corners[w].0;
            let crossed = walls.iter().any(|w| plane(w) != plane(&walls[0]));
            crossed || facets.iter().any(|f| f.has_on_edge(planes, edge))
        };
        self.at_edge.iter().filter(|(edge, walls)| kept(edge, walls)).map(|(edge, _)| *edge).collect()
    }

    fn n_faces(&self, skeleton: &BTreeSet<[Corner; 2]>) -> usize {
        let covered = self.of_corners.iter().filter(|(_, w)| w.2).map(|(key, _)| key);
        let ids: BTreeMap<&Vec<Corner>, usize> = covered.zip(0..).collect();
        let mut sets = Sets::new(ids.len());
        for (_, walls) in self.at_edge.iter().filter(|(edge, _)| !skeleton.contains(*edge)) {
            walls.iter().for_each(|w| sets.join(ids[w], ids[&walls[0]]));
        }
        (0..ids.len()).filter(|&i| sets.root(i) == i).count()
    }
}

/// Points where edges of the skeleton end in other than two opposite directions.
fn vertices(skeleton: &BTreeSet<[Corner; 2]>) -> (BTreeSet<Corner>, usize) {
    let mut ends: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
    for &[a, b] in skeleton {
        ends.entry(a).or_default().push(b);
        ends.entry(b).or_default().push(a);
    }
    let straight = |at: &Corner, far: &[Corner]| matches!(far, [a, b] if collinear(a, at, b));
    let passed = ends.iter().filter(|(at, far)| straight(at, far)).count();
    let kept = ends.iter().filter(|(at, far)| !straight(at, far)).map(|(at, _)| *at).collect();
    (kept, passed)
}

fn collinear(a: &Corner, b: &Corner, c: &Corner) -> bool {
    let to = |p: &Corner| [0, 1, 2].map(|k| p[k] * b[3] - b[k] * p[3]);
    let (u, v) = (to(a), to(c));
    (0..3).all(|k| u[k] * v[(k + 1) % 3] == u[(k + 1) % 3] * v[k])
}

fn n_vertices(skeleton: &BTreeSet<[Corner; 2]>) -> usize {
    vertices(skeleton).0.len()
}

/// Each point that the skeleton passes straight joins two edges.
fn n_edges(skeleton: &BTreeSet<[Corner; 2]>) -> usize {
    skeleton.len() - vertices(skeleton).1
}

/// Disjoint sets of 0..n.
struct Sets(Vec<usize>);

impl Sets {
    fn new(n: usize) -> Self {
        Self((0..n).collect())
    }

    fn root(&self, mut i: usize) -> usize {
        while self.0[i] != i {
            i = self.0[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}
