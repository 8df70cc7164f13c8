//! The arrangement of a few segments by definition, in quadratic time and exact fractions.

use crate::fraction::{Fraction, Point, cross, minus, plus, point, times, turn};
use std::collections::{BTreeMap, BTreeSet};

/// A segment x1, y1, x2, y2.
pub(crate) type Segment = [i64; 4];

/// An edge with a direction.
pub(crate) type Directed = [Point; 2];

#[derive(Debug)]
pub(crate) struct Oracle {
    pub vertices: BTreeSet<Point>,
    /// Each with its smaller end first.
    pub edges: BTreeSet<Directed>,
    /// The edges that each segment covers, in its direction.
    pub pieces: Vec<Vec<Directed>>,
    /// Directed edges with the face on their left, and the area; the exterior face is not among them.
    pub faces: Vec<(BTreeSet<Directed>, f64)>,
    pub exterior: BTreeSet<Directed>,
    pub n_components: usize,
    /// Loops of bounded faces.
    pub n_loops: usize,
}

pub(crate) fn ends(s: &Segment) -> Directed {
    [point(s[0], s[1]), point(s[2], s[3])]
}

fn sorted([a, b]: Directed) -> Directed {
    if a <= b { [a, b] } else { [b, a] }
}

/// Whether p lies on the segment, ends included.
pub(crate) fn is_on(p: Point, [a, b]: Directed) -> bool {
    turn(a, b, p) == 0 && (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

impl Oracle {
    pub(crate) fn new(segments: &[Segment], keep_dangling: bool) -> Self {
        Self::of_some(segments, keep_dangling, |_| true)
    }

    /// The arrangement of only those edges that are wanted.
    pub(crate) fn of_some(
        segments: &[Segment],
        keep_dangling: bool,
        is_wanted: impl Fn(Directed) -> bool,
    ) -> Self {
        let mut pieces: Vec<Vec<Directed>> = segments.iter().map(|s| pieces(s, segments)).collect();
        pieces.iter_mut().for_each(|p| p.retain(|&e| is_wanted(e)));
        let mut edges: BTreeSet<Directed> = pieces.iter().flatten().map(|&e| sorted(e)).collect();
        if !keep_dangling {
            let bridges = bridges(&edges);
            edges.retain(|e| !bridges.contains(e));
            pieces.iter_mut().for_each(|p| p.retain(|&e| !bridges.contains(&sorted(e))));
        }
        let vertices = edges.iter().flatten().copied().collect();
        let mut out = Self {
            vertices,
            edges,
            pieces,
            faces: Vec::new(),
            exterior: BTreeSet::new(),
            n_components: 0,
            n_loops: 0,
        };
        out.find_faces();
        out
    }

    /// Every cycle goes around a face from inside, but for one of each component, which goes around the component.
    fn find_faces(&mut self) {
        let component_of = components(&self.edges);
        let (outside, around): (Vec<Vec<Directed>>, Vec<Vec<Directed>>) =
            cycles(&self.edges).into_iter().partition(|cycle| is_outside(cycle));
        self.n_components = outside.len();
        self.n_loops = around.len();
        let mut sets: Vec<(BTreeSet<Directed>, f64)> =
            around.iter().map(|cycle| (cycle.iter().copied().collect(), area(cycle))).collect();
        let areas: Vec<f64> = sets.iter().map(|s| s.1).collect();
        for cycle in outside {
            let p = cycle[0][0];
            let least = (0..around.len())
                .filter(|&f| {
                    component_of[&around[f][0][0]] != component_of[&p] && winding(&around[f], p) != 0
                })
                .min_by(|&f, &g| areas[f].total_cmp(&areas[g]));
            match least {
                None => self.exterior.extend(cycle),
                Some(f) => {
                    self.n_loops += 1;
                    sets[f].1 += area(&cycle);
                    sets[f].0.extend(cycle);
                }
            }
        }
        self.faces = sets;
    }

    /// A point inside a face, given by its directed edges: from the middle of an edge half of the way to what its
    /// normal meets next.
    pub(crate) fn inside(&self, face: &BTreeSet<Directed>) -> Point {
        let &[a, b] = face.first().expect("faces have edges");
        let [dx, dy] = minus(b, a);
        let normal = [Fraction::ZERO - dy, dx];
        let middle = [(a[0] + b[0]).half(), (a[1] + b[1]).half()];
        let far = plus(middle, normal);
        let hits = self.edges.iter().filter(|&&e| e != sorted([a, b])).flat_map(|&[p, q]| {
            let side = [p, q].map(|x| cross(normal, minus(x, middle)));
            let along = |x: Point| {
                let d = minus(x, middle);
                (d[0] * normal[0] + d[1] * normal[1]) / (normal[0] * normal[0] + normal[1] * normal[1])
            };
            match (side[0].sign(), side[1].sign()) {
                (0, 0) => vec![along(p), along(q)],
                (s, t) if s * t <= 0 => {
                    let u = side[0] / (side[0] - side[1]);
                    vec![along(plus(p, times(minus(q, p), u)))]
                }
                _ => Vec::new(),
            }
        });
        let t = hits.filter(|t| t.sign() > 0).min();
        assert_ne!(turn(a, b, far), -1, "the normal points to the left");
        plus(middle, times(normal, t.unwrap_or(1.into()).half()))
    }
}

/// Signed area, rounded; negative for what goes around a component.
fn area(cycle: &[Directed]) -> f64 {
    let o = cycle[0][0];
    cycle.iter().map(|&[p, q]| cross(minus(p, o), minus(q, o)).value()).sum::<f64>() / 2.0
}

/// Whether the direction to the left of the cycle's first vertex (by x, then y) is on its left-hand side: there
/// all edges lead to the right, or straight up.
fn is_outside(cycle: &[Directed]) -> bool {
    let first = cycle.iter().map(|e| e[0]).min().expect("cycles have edges");
    let corners = (0..cycle.len()).map(|i| (cycle[i], cycle[(i + 1) % cycle.len()]));
    corners
        .filter(|(from, _)| from[1] == first)
        .any(|([before, at], [_, after])| turn(at, after, before) <= 0)
}

/// How often directed edges go around a point that is on none of them.
pub(crate) fn winding<'a>(cycle: impl IntoIterator<Item = &'a Directed>, p: Point) -> i32 {
    cycle
        .into_iter()
        .map(|&[a, b]| match (a[1] <= p[1], b[1] <= p[1]) {
            (true, false) if turn(a, b, p) > 0 => 1,
            (false, true) if turn(a, b, p) < 0 => -1,
            _ => 0,
        })
        .sum()
}

/// A segment cut at every point that it has in common with another, or where another one begins or ends on it.
fn pieces(s: &Segment, segments: &[Segment]) -> Vec<Directed> {
    let [a, b] = ends(s);
    if a == b {
        return Vec::new();
    }
    let mut points: BTreeSet<Point> = [a, b].into();
    for other in segments {
        let [c, d] = ends(other);
        if c == d {
            continue;
        }
        points.extend([c, d].into_iter().filter(|&p| is_on(p, [a, b])));
        let (u, v) = (minus(b, a), minus(d, c));
        let denominator = cross(u, v);
        if denominator.sign() != 0 {
            let p = plus(a, times(u, cross(minus(c, a), v) / denominator));
            if is_on(p, [a, b]) && is_on(p, [c, d]) {
                points.insert(p);
            }
        }
    }
    let mut along: Vec<Point> = points.into_iter().collect();
    if b < a {
        along.reverse();
    }
    along.windows(2).map(|w| [w[0], w[1]]).collect()
}

/// The smallest vertex of the component of each vertex.
fn components(edges: &BTreeSet<Directed>) -> BTreeMap<Point, Point> {
    let mut root: BTreeMap<Point, Point> = edges.iter().flatten().map(|&p| (p, p)).collect();
    loop {
        let mut changed = false;
        for [a, b] in edges {
            let smaller = root[a].min(root[b]);
            for p in [a, b] {
                changed |= root.insert(*p, smaller) != Some(smaller);
            }
        }
        if !changed {
            return root;
        }
    }
}

/// The edges on no cycle: without such an edge its ends are no longer connected.
pub(crate) fn bridges(edges: &BTreeSet<Directed>) -> BTreeSet<Directed> {
    let mut neighbours: BTreeMap<Point, Vec<Point>> = BTreeMap::new();
    for &[a, b] in edges {
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    let is_bridge = |&&[a, b]: &&Directed| {
        let (mut seen, mut stack) = (BTreeSet::from([a]), vec![a]);
        while let Some(p) = stack.pop() {
            for &q in neighbours[&p].iter().filter(|&&q| sorted([p, q]) != [a, b]) {
                if seen.insert(q) {
                    stack.push(q);
                }
            }
        }
        !seen.contains(&b)
    };
    edges.iter().filter(is_bridge).copied().collect()
}

/// The cycles of directed edges that keep one face on their left.
fn cycles(edges: &BTreeSet<Directed>) -> Vec<Vec<Directed>> {
    let mut around: BTreeMap<Point, Vec<Point>> = BTreeMap::new();
    for &[a, b] in edges {
        around.entry(a).or_default().push(b);
        around.entry(b).or_default().push(a);
    }
    for (&centre, ends) in &mut around {
        ends.sort_by(|&p, &q| {
            let (u, v) = (minus(p, centre), minus(q, centre));
            let lower = |d: Point| d[1].sign() < 0 || (d[1].sign() == 0 && d[0].sign() < 0);
            lower(u).cmp(&lower(v)).then_with(|| 0.cmp(&cross(u, v).sign()))
        });
    }
    let next = |[a, b]: Directed| {
        let star = &around[&b];
        let at = star.iter().position(|&p| p == a).expect("edges have two ends");
        [b, star[(at + star.len() - 1) % star.len()]]
    };
    let mut unused: BTreeSet<Directed> = edges.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
    let mut out = Vec::new();
    while let Some(start) = unused.pop_first() {
        let mut cycle = vec![start];
        let mut e = next(start);
        while e != start {
            unused.remove(&e);
            cycle.push(e);
            e = next(e);
        }
        out.push(cycle);
    }
    out
}
