//! All of space inside a box, cut into convex pieces by whole planes, in exact integers.
//!
//! Coordinates of the scenes are single digits, so homogeneous coordinates stay far below 2^127. Every plane cuts
//! every piece that it passes through, therefore neighbouring pieces share whole walls, and neighbouring walls
//! whole edges: the pieces, walls, edges and corners are the cells of the arrangement of the planes.

/// a, b, c, d of a·x + b·y + c·z + d, coprime.
pub(crate) type Plane = [i128; 4];
/// X, Y, Z, W of the point (X/W, Y/W, Z/W), coprime, 0 < W: equal points have equal numbers.
pub(crate) type Corner = [i128; 4];

/// A side of a piece: its corners counter-clockwise seen from outside of the piece.
#[derive(Clone, Debug)]
pub(crate) struct Wall {
    pub(crate) plane: usize,
    pub(crate) corners: Vec<Corner>,
}

/// A convex polyhedron as its walls.
pub(crate) type Piece = Vec<Wall>;

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn reduced(v: [i128; 4]) -> [i128; 4] {
    let g = v.iter().fold(0, |g, &x| gcd(g, x));
    v.map(|x| x / g.max(1))
}

pub(crate) fn corner(p: [i32; 3]) -> Corner {
    [p[0].into(), p[1].into(), p[2].into(), 1]
}

/// Positive, zero or negative as the corner lies on the plane's positive side, on it, or on the other.
pub(crate) fn side(plane: &Plane, corner: &Corner) -> i128 {
    (0..4).map(|k| plane[k] * corner[k]).sum()
}

/// The plane through three points, positive where they run counter-clockwise; `None` when they are collinear.
pub(crate) fn plane_through(p: [i32; 3], q: [i32; 3], r: [i32; 3]) -> Option<Plane> {
    let [u, v] = [q, r].map(|x| [0, 1, 2].map(|k| i128::from(x[k] - p[k])));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let offset: i128 = (0..3).map(|k| -normal[k] * i128::from(p[k])).sum();
    (normal != [0; 3]).then(|| reduced([normal[0], normal[1], normal[2], offset]))
}

/// Where the edge from p on the positive side to q on the negative side crosses the plane.
fn crossing(plane: &Plane, p: &Corner, q: &Corner) -> Corner {
    let (at_p, at_q) = (side(plane, p), side(plane, q));
    reduced([0, 1, 2, 3].map(|k| at_p * q[k] - at_q * p[k]))
}

/// The cube between −`reach` and `reach`, cut by all planes; walls of the cube itself have plane numbers from
/// `planes.len()`.
pub(crate) fn cut_cube(reach: i32, planes: &[Plane]) -> Vec<Piece> {
    let mut pieces = vec![cube(reach, planes.len())];
    for (number, plane) in planes.iter().enumerate() {
        pieces = pieces.into_iter().flat_map(|piece| cut(piece, number, plane)).collect();
    }
    pieces
}

fn cube(reach: i32, first_plane: usize) -> Piece {
    let at = |i: usize| corner([0, 1, 2].map(|k| if i >> k & 1 == 0 { -reach } else { reach }));
    let walls = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let wall = |(k, corners): (usize, [usize; 4])| Wall {
        plane: first_plane + k,
        corners: corners.map(at).to_vec(),
    };
    walls.into_iter().enumerate().map(wall).collect()
}

/// The piece, or its two parts.
fn cut(piece: Piece, number: usize, plane: &Plane) -> Vec<Piece> {
    let sides = || piece.iter().flat_map(|w| &w.corners).map(|c| side(plane, c));
    if sides().all(|s| s <= 0) || sides().all(|s| s >= 0) {
        return vec![piece];
    }
    let opposite: Plane = plane.map(|x| -x);
    [*plane, opposite].iter().map(|plane| half(&piece, number, plane)).collect()
}

/// The part of a piece on the positive side, closed by a wall in the plane.
fn half(piece: &Piece, number: usize, plane: &Plane) -> Piece {
    let mut out: Piece = piece.iter().filter_map(|wall| clipped(wall, plane)).collect();
    let mut rim: Vec<[Corner; 2]> = Vec::new();
    for wall in &out {
        let n = wall.corners.len();
        let edges = (0..n).map(|i| [wall.corners[i], wall.corners[(i + 1) % n]]);
        rim.extend(edges.filter(|e| e.iter().all(|c| side(plane, c) == 0)));
    }
    // The new wall runs along the rim the other way round than the walls that it closes.
    let mut corners = vec![rim[0][0]];
    while corners.len() < rim.len() {
        let last = corners[corners.len() - 1];
        corners.push(rim.iter().find(|e| e[1] == last).expect("the rim is closed")[0]);
    }
    out.push(Wall { plane: number, corners });
    out
}

/// The part of a wall on the positive side; `None` when that has no area.
fn clipped(wall: &Wall, plane: &Plane) -> Option<Wall> {
    let n = wall.corners.len();
    let mut corners = Vec::new();
    for i in 0..n {
        let (p, q) = (&wall.corners[i], &wall.corners[(i + 1) % n]);
        let (at_p, at_q) = (side(plane, p), side(plane, q));
        if at_p >= 0 {
            corners.push(*p);
        }
        match (at_p.signum(), at_q.signum()) {
            (1, -1) => corners.push(crossing(plane, p, q)),
            (-1, 1) => corners.push(crossing(plane, q, p)),
            _ => {}
        }
    }
    let has_area = corners.iter().any(|c| side(plane, c) > 0);
    has_area.then_some(Wall { plane: wall.plane, corners })
}

/// Volume, as a sum of tetrahedra over the first corner.
pub(crate) fn volume(piece: &Piece) -> f64 {
    let at = |c: &Corner| [0, 1, 2].map(|k| c[k] as f64 / c[3] as f64);
    let tip = at(&piece[0].corners[0]);
    let from_tip = |c: &Corner| {
        let p = at(c);
        [0, 1, 2].map(|k| p[k] - tip[k])
    };
    let mut six_volumes = 0.0;
    for wall in piece {
        let a = from_tip(&wall.corners[0]);
        for pair in wall.corners[1..].windows(2) {
            let [b, c] = [&pair[0], &pair[1]].map(from_tip);
            six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    six_volumes / 6.0
}
