//! Stage 2a: facet against facet. What each pair of facets has in common becomes points on input edges, segments
//! inside facets and touching points; coplanar pairs are passed on.
//!
//! Two facets whose planes differ meet on the line ℓ of the two planes. Each facet's *trace* on ℓ is a sorted list
//! of stops (corners on ℓ and crossings of its edges) with the state of the gap after each: outside, inside, or
//! along an edge. Laying one trace over the other gives the common points and segments:
//!
//! ```text
//!      F   ──●═══════●───────●═══●──      ═ inside, ● stop
//!      G   ──────●═══════════════●──
//!  F ∩ G   ──────●═══●───────●═══●──
//! ```

use crate::kernel::{Along, Direction, Geometry, Sign, Support, Vertex, VertexDef};
use crate::soup::Soup;
use std::cmp::Ordering;

/// A vertex in the lists below: an input point, or (from `n_points` on) an entry of `Contacts::vertices`.
pub(crate) type VertexRef = u32;

/// A segment inside `facet`, common with the facet `other`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    pub facet: u32,
    pub other: u32,
    pub ends: [VertexRef; 2],
}

/// What the pairs of facets have in common.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    pub vertices: Vec<Vertex>,
    /// Points inside edges.
    pub splits: Vec<(u32, VertexRef)>,
    pub segments: Vec<Segment>,
    /// Points inside a facet where another only touches it.
    pub touches: Vec<(u32, VertexRef)>,
    /// Pairs of facets in one plane.
    pub coplanar: Vec<[u32; 2]>,
    /// Pairs that have a point in common beyond shared corners and edges.
    pub crossing_pairs: u64,
}

impl Contacts {
    /// Appends the contacts of another chunk.
    pub(crate) fn append(&mut self, mut other: Contacts, n_points: u32) {
        let base = self.vertices.len() as u32;
        let moved = |v: VertexRef| if v < n_points { v } else { v + base };
        self.vertices.append(&mut other.vertices);
        self.splits.extend(other.splits.into_iter().map(|(e, v)| (e, moved(v))));
        self.segments.extend(other.segments.into_iter().map(|s| Segment { ends: s.ends.map(moved), ..s }));
        self.touches.extend(other.touches.into_iter().map(|(f, v)| (f, moved(v))));
        self.coplanar.append(&mut other.coplanar);
        self.crossing_pairs += other.crossing_pairs;
    }

    fn vertex_ref(&mut self, vertex: &Vertex, n_points: u32) -> VertexRef {
        match vertex.def {
            VertexDef::Point(p) => p,
            _ => {
                self.vertices.push(*vertex);
                n_points + self.vertices.len() as u32 - 1
            }
        }
    }

    /// A point strictly inside an edge.
    pub(crate) fn push_split(&mut self, edge: u32, vertex: &Vertex, n_points: u32) -> VertexRef {
        let v = self.vertex_ref(vertex, n_points);
        self.splits.push((edge, v));
        v
    }
}

const NO_EDGE: u32 = u32::MAX;

/// The state of a gap between two stops of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gap {
    Outside,
    Inside,
    Along(u32),
}

/// A point of a facet's boundary on ℓ: a corner (`edge` is `NO_EDGE`) or a point inside an edge.
#[derive(Clone, Copy, Debug)]
struct Stop {
    vertex: Vertex,
    edge: u32,
    /// Whether the boundary passes here from above to not above ℓ (in its facet), and from below to not below.
    toggles: [bool; 2],
    gap: Gap,
}

/// Buffers for the pairs of one chunk.
#[derive(Default)]
pub(crate) struct Scratch {
    signs: [Vec<Sign>; 2],
    traces: [Vec<Stop>; 2],
    on_line: Vec<(u32, [u32; 2])>,
}

/// Finds what facets f and g have in common.
pub(crate) fn meet(soup: &Soup, f: u32, g: u32, scratch: &mut Scratch, out: &mut Contacts) {
    if are_triangles_apart(soup, f, g) {
        return;
    }
    let [signs_f, signs_g] = &mut scratch.signs;
    match classify(soup, f, g, signs_f) {
        Position::Apart => return,
        Position::Coplanar => return out.coplanar.push([f, g]),
        Position::Across => {}
    }
    if classify(soup, g, f, signs_g) != Position::Across {
        return;
    }
    let geometry = &soup.geometry;
    let line = geometry.direction(Along::Facets([f, g]));
    let (axis, _) = geometry.axis_of(&line);
    for (i, (this, other)) in [(f, g), (g, f)].into_iter().enumerate() {
        trace(soup, this, other, axis, &scratch.signs[i], &mut scratch.on_line, &mut scratch.traces[i]);
    }
    overlay(geometry, [f, g], axis, &scratch.traces, out);
}

/// For two triangles: whether one of them shows at once that they have nothing in common but shared corners and a
/// shared edge. Most pairs end here.
fn are_triangles_apart(soup: &Soup, f: u32, g: u32) -> bool {
    if soup.facet_edges[f as usize].len() != 3 || soup.facet_edges[g as usize].len() != 3 {
        return false;
    }
    let geometry = &soup.geometry;
    let (a, b) = (geometry.base(f), geometry.base(g));
    is_on_one_side(geometry, a, b, g) || is_on_one_side(geometry, b, a, f)
}

/// Whether the corners that are not shared lie strictly on one side of the other triangle's plane.
fn is_on_one_side(geometry: &Geometry, corners: [u32; 3], others: [u32; 3], other: u32) -> bool {
    let mut side = Sign::Zero;
    for p in corners.into_iter().filter(|p| !others.contains(p)) {
        let sign = geometry.side_of_point(p, other);
        if sign == Sign::Zero || sign.times(side) == Sign::Negative {
            return false;
        }
        side = sign;
    }
    side != Sign::Zero
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Position {
    /// All corners on one side.
    Apart,
    Coplanar,
    /// The facet reaches the other's plane.
    Across,
}

/// Signs of f's corners (tails of its directed edges) against the plane of g. Triangles that have only shared corners
/// on it do not come here.
fn classify(soup: &Soup, f: u32, g: u32, signs: &mut Vec<Sign>) -> Position {
    signs.clear();
    let edges = &soup.facet_edges[f as usize];
    let mut any = [false; 3];
    for &edge in edges {
        let [p, _] = soup.directed(edge);
        let is_on_plane = soup.geometry.lies_on(p, g);
        let sign = if is_on_plane { Sign::Zero } else { soup.geometry.side_of_point(p, g) };
        any[(sign as i8 + 1) as usize] = true;
        signs.push(sign);
    }
    match any {
        [false, _, false] => Position::Coplanar,
        [true, false, false] | [false, false, true] => Position::Apart,
        _ => Position::Across,
    }
}

/// The stops of facet f on the plane of g, sorted along `axis`.
fn trace(
    soup: &Soup,
    f: u32,
    g: u32,
    axis: usize,
    signs: &[Sign],
    on_line: &mut Vec<(u32, [u32; 2])>,
    stops: &mut Vec<Stop>,
) {
    let geometry = &soup.geometry;
    stops.clear();
    on_line.clear();
    let edges = &soup.facet_edges[f as usize];
    let sign_at = |p: u32| {
        // Loops close within the facet's list: the corner's sign stands at the edge that starts there.
        let at = edges.iter().position(|&e| soup.directed(e)[0] == p).expect("loops are closed");
        signs[at]
    };
    for (i, &edge) in edges.iter().enumerate() {
        let [p, q] = soup.directed(edge);
        let next = edges
            .get(i + 1)
            .filter(|&&e| soup.directed(e)[0] == q)
            .map_or_else(|| sign_at(q), |_| signs[i + 1]);
        match (signs[i], next) {
            (Sign::Zero, Sign::Zero) => {
                on_line.push((edge / 2, [p, q]));
                push_corner(geometry, stops, p, [false, false]);
                push_corner(geometry, stops, q, [false, false]);
            }
            (Sign::Zero, s) => push_corner(geometry, stops, p, toggles(s)),
            (s, Sign::Zero) => push_corner(geometry, stops, q, toggles(s)),
            (s, t) if s != t => stops.push(Stop {
                vertex: geometry.edge_vertex(soup.edges[(edge / 2) as usize], Support::Facet(g)),
                edge: edge / 2,
                toggles: [true, true],
                gap: Gap::Outside,
            }),
            _ => {}
        }
    }
    stops.sort_by(|a, b| geometry.cmp_coordinate(&a.vertex, &b.vertex, axis));
    let mut above_below = [false; 2];
    for i in 0..stops.len() {
        for (state, toggle) in above_below.iter_mut().zip(stops[i].toggles) {
            *state ^= toggle;
        }
        stops[i].gap = match above_below {
            [true, true] => Gap::Inside,
            _ => edge_over_gap(geometry, stops, i, on_line, axis).map_or(Gap::Outside, Gap::Along),
        };
    }
}

/// An edge with one end on ℓ and the other above it toggles what is inside just above ℓ; likewise below.
fn toggles(sign: Sign) -> [bool; 2] {
    [sign == Sign::Positive, sign == Sign::Negative]
}

fn push_corner(geometry: &Geometry, stops: &mut Vec<Stop>, p: u32, toggles: [bool; 2]) {
    let def = VertexDef::Point(p);
    match stops.iter_mut().find(|s| s.vertex.def == def) {
        Some(stop) => (0..2).for_each(|k| stop.toggles[k] ^= toggles[k]),
        None => {
            stops.push(Stop { vertex: geometry.point_vertex(p), edge: NO_EDGE, toggles, gap: Gap::Outside });
        }
    }
}

/// The edge on ℓ that covers the gap after stop i.
fn edge_over_gap(
    geometry: &Geometry,
    stops: &[Stop],
    i: usize,
    on_line: &[(u32, [u32; 2])],
    axis: usize,
) -> Option<u32> {
    let (before, after) = (&stops[i].vertex, &stops.get(i + 1)?.vertex);
    on_line.iter().find_map(|&(edge, ends)| {
        let [p, q] = ends.map(|p| geometry.point_vertex(p));
        let (lo, hi) = if geometry.cmp_coordinate(&p, &q, axis).is_lt() { (p, q) } else { (q, p) };
        let covers = geometry.cmp_coordinate(&lo, before, axis).is_le()
            && geometry.cmp_coordinate(after, &hi, axis).is_le();
        covers.then_some(edge)
    })
}

/// Where a point of ℓ lies in a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Outside,
    Corner,
    OnEdge(u32),
    Inside,
}

impl Place {
    fn at_stop(stop: &Stop) -> Self {
        if stop.edge == NO_EDGE { Place::Corner } else { Place::OnEdge(stop.edge) }
    }

    fn in_gap(gap: Gap) -> Self {
        match gap {
            Gap::Outside => Place::Outside,
            Gap::Inside => Place::Inside,
            Gap::Along(edge) => Place::OnEdge(edge),
        }
    }
}

/// Lays two traces over each other and records the common points and segments.
fn overlay(geometry: &Geometry, facets: [u32; 2], axis: usize, traces: &[Vec<Stop>; 2], out: &mut Contacts) {
    let n_points = geometry.n_points() as u32;
    let [mut i, mut j] = [0, 0];
    let mut gaps = [Gap::Outside; 2];
    let mut previous: Option<VertexRef> = None;
    let mut any = false;
    while i < traces[0].len() || j < traces[1].len() {
        let (a, b) = (traces[0].get(i), traces[1].get(j));
        let order = match (a, b) {
            (Some(a), Some(b)) => geometry.cmp_coordinate(&a.vertex, &b.vertex, axis),
            (Some(_), None) => Ordering::Less,
            _ => Ordering::Greater,
        };
        let stops = [a.filter(|_| order.is_le()), b.filter(|_| order.is_ge())];
        let places: [Place; 2] =
            std::array::from_fn(|k| stops[k].map_or_else(|| Place::in_gap(gaps[k]), Place::at_stop));
        let before = gaps;
        for k in 0..2 {
            if let Some(stop) = stops[k] {
                gaps[k] = stop.gap;
            }
        }
        i += usize::from(stops[0].is_some());
        j += usize::from(stops[1].is_some());
        let here = places.iter().all(|&p| p != Place::Outside).then(|| {
            any |= places != [Place::Corner; 2];
            record_point(stops, places, [before, gaps], facets, n_points, out)
        });
        if let (Some(from), Some(to)) = (previous, here)
            && before.iter().all(|&gap| gap != Gap::Outside)
        {
            record_segment(before, facets, [from, to], out);
        }
        previous = here;
    }
    out.crossing_pairs += u64::from(any);
}

fn record_point(
    stops: [Option<&Stop>; 2],
    places: [Place; 2],
    gaps: [[Gap; 2]; 2],
    facets: [u32; 2],
    n_points: u32,
    out: &mut Contacts,
) -> VertexRef {
    let is_point = |s: &&Stop| matches!(s.vertex.def, VertexDef::Point(_));
    let stop = stops
        .iter()
        .flatten()
        .copied()
        .find(is_point)
        .or_else(|| stops.into_iter().flatten().next())
        .expect("every point of the overlay is a stop of one trace");
    let v = out.vertex_ref(&stop.vertex, n_points);
    for k in 0..2 {
        match places[k] {
            Place::OnEdge(edge) => out.splits.push((edge, v)),
            // Inside this facet with nothing of the other one on either side along ℓ: they only touch.
            Place::Inside if gaps.iter().all(|g| g[1 - k] == Gap::Outside) => {
                out.touches.push((facets[k], v));
            }
            _ => {}
        }
    }
    v
}

fn record_segment(gaps: [Gap; 2], facets: [u32; 2], ends: [VertexRef; 2], out: &mut Contacts) {
    for k in 0..2 {
        if gaps[k] == Gap::Inside {
            out.segments.push(Segment { facet: facets[k], other: facets[1 - k], ends });
        }
    }
}

/// The direction of a segment, from the end that comes first along `axis` to the other.
pub(crate) fn segment_direction(geometry: &Geometry, facet: u32, other: u32) -> (Direction, usize) {
    let direction = geometry.direction(Along::Facets([facet, other]));
    let (axis, sign) = geometry.axis_of(&direction);
    (if sign == Sign::Negative { direction.opposite() } else { direction }, axis)
}
