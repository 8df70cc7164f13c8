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

use crate::boxes::Aabb;
use crate::kernel::{Along, Direction, Geometry, Sign, Vertex, VertexDef};
use crate::meeting::box_of;
use crate::soup::Soup;
use rustc_hash::FxHashMap;
use std::cell::OnceCell;
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
    /// The vertices on edges by their definitions: those of an edge come with both its facets.
    known: FxHashMap<VertexDef, VertexRef>,
}

impl Contacts {
    /// None, with room for those of some chunks.
    pub(crate) fn with_room_for(parts: &[Self]) -> Self {
        let sum = |n: fn(&Self) -> usize| parts.iter().map(n).sum();
        Self {
            vertices: Vec::with_capacity(sum(|part| part.vertices.len())),
            splits: Vec::with_capacity(sum(|part| part.splits.len())),
            segments: Vec::with_capacity(sum(|part| part.segments.len())),
            touches: Vec::with_capacity(sum(|part| part.touches.len())),
            coplanar: Vec::with_capacity(sum(|part| part.coplanar.len())),
            ..Self::default()
        }
    }

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

    /// A vertex on an edge by its definition, and how it is made when it is new.
    pub(crate) fn edge_vertex(
        &mut self,
        geometry: &Geometry,
        def: VertexDef,
        vertex: impl FnOnce(VertexDef) -> Vertex,
    ) -> VertexRef {
        let next = (geometry.n_points() + self.vertices.len()) as u32;
        *self.known.entry(def).or_insert_with(|| {
            self.vertices.push(vertex(def));
            next
        })
    }
}

/// The state of a gap between two stops of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gap {
    Outside,
    Inside,
    Along(u32),
}

/// What a stop is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Site {
    Corner(u32),
    /// Where an edge passes through the plane of the other facet.
    Inside {
        edge: u32,
        facet: u32,
    },
}

/// A point of a facet's boundary on ℓ.
#[derive(Clone, Debug)]
struct Stop {
    site: Site,
    /// Its coordinate along ℓ's axis, within `error`.
    at: f64,
    error: f64,
    /// Found only when the coordinate leaves a doubt, or when the stop is part of the result.
    vertex: OnceCell<Vertex>,
    /// Whether the boundary passes here from above to not above ℓ (in its facet), and from below to not below.
    toggles: [bool; 2],
    gap: Gap,
}

impl Stop {
    fn corner(geometry: &Geometry, p: u32, axis: usize, toggles: [bool; 2]) -> Self {
        let vertex = geometry.point_vertex(p);
        let (at, error) = (vertex.at[axis], geometry.rounding_of(p));
        Self { site: Site::Corner(p), at, error, vertex: vertex.into(), toggles, gap: Gap::Outside }
    }

    fn inside(soup: &Soup, edge: u32, facet: u32, axis: usize) -> Self {
        let (at, error) = soup.geometry.crossing_near(soup.edges[edge as usize], facet, axis);
        let site = Site::Inside { edge, facet };
        Self { site, at, error, vertex: OnceCell::new(), toggles: [true, true], gap: Gap::Outside }
    }

    fn definition(&self, soup: &Soup) -> VertexDef {
        match self.site {
            Site::Corner(p) => VertexDef::Point(p),
            Site::Inside { edge, facet } => soup.geometry.edge_definition(soup.edges[edge as usize], facet),
        }
    }

    /// The vertex, from the definition.
    fn vertex(&self, geometry: &Geometry, def: VertexDef) -> &Vertex {
        self.vertex.get_or_init(|| geometry.vertex_on_edge(def))
    }

    /// Order along `axis`, exactly.
    fn cmp(&self, other: &Self, soup: &Soup, axis: usize) -> Ordering {
        if (self.at - other.at).abs() > self.error + other.error {
            return self.at.total_cmp(&other.at);
        }
        let (a, b, geometry) = (self.definition(soup), other.definition(soup), &soup.geometry);
        if a == b {
            return Ordering::Equal;
        }
        geometry.cmp_coordinate(self.vertex(geometry, a), other.vertex(geometry, b), axis)
    }
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
    let [signs_f, signs_g] = &mut scratch.signs;
    match classify(soup, f, g, signs_f) {
        Position::Apart => return,
        Position::Coplanar => return out.coplanar.push([f, g]),
        Position::Across => {}
    }
    if is_touched_outside(soup, f, g, signs_f) || classify(soup, g, f, signs_g) != Position::Across {
        return;
    }
    if is_touched_outside(soup, g, f, signs_g) {
        return;
    }
    let geometry = &soup.geometry;
    let axis = geometry.axis_of_line([f, g]);
    for (i, (this, other)) in [(f, g), (g, f)].into_iter().enumerate() {
        let (signs, stops) = (&scratch.signs[i], &mut scratch.traces[i]);
        match signs[..] {
            [a, b, c] => trace_triangle(soup, this, other, axis, [a, b, c], stops),
            _ => trace(soup, this, other, axis, signs, &mut scratch.on_line, stops),
        }
    }
    overlay(soup, [f, g], axis, &scratch.traces, out);
}

/// Whether facet f has corners on the plane of g but does not cross it, and these lie where g is not. A quick test: their
/// box against that of g; rounding is monotone.
fn is_touched_outside(soup: &Soup, f: u32, g: u32, signs: &[Sign]) -> bool {
    if signs.contains(&Sign::Positive) && signs.contains(&Sign::Negative) {
        return false;
    }
    let corners = soup.facet_edges[f as usize].iter().zip(signs).filter(|(_, sign)| **sign == Sign::Zero);
    let on_plane = Aabb::around(corners.map(|(&edge, _)| soup.geometry.position(soup.directed(edge)[0])));
    !on_plane.meets(&box_of(soup, g))
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Position {
    /// All corners on one side; for triangles, but for corners that they share: then they have nothing else in common but
    /// a shared edge.
    Apart,
    Coplanar,
    /// The facet reaches the other's plane.
    Across,
}

/// Signs of f's corners (tails of its directed edges) against the plane of g. Most pairs end here.
fn classify(soup: &Soup, f: u32, g: u32, signs: &mut Vec<Sign>) -> Position {
    signs.clear();
    let geometry = &soup.geometry;
    let edges = &soup.facet_edges[f as usize];
    let of_g = geometry.base(g);
    let plane = geometry.seen_from(g);
    let are_triangles = edges.len() == 3 && soup.facet_edges[g as usize].len() == 3;
    let mut any = [false; 3];
    let mut push = |p: u32| {
        let is_shared = of_g.contains(&p);
        let sign = if is_shared { Sign::Zero } else { plane.side_of_point(p) };
        any[(sign as i8 + 1) as usize] |= !(are_triangles && is_shared);
        signs.push(sign);
    };
    match edges {
        [_, _, _] => geometry.base(f).into_iter().for_each(push),
        edges => edges.iter().for_each(|&edge| push(soup.directed(edge)[0])),
    }
    match any {
        [false, _, false] => Position::Coplanar,
        [true, false, false] | [false, false, true] => Position::Apart,
        _ => Position::Across,
    }
}

/// The stops of a triangle on the plane of g, sorted along `axis`: one or two. Its corners are those of its base.
fn trace_triangle(soup: &Soup, f: u32, g: u32, axis: usize, signs: [Sign; 3], stops: &mut Vec<Stop>) {
    let geometry = &soup.geometry;
    stops.clear();
    let mut gap = Gap::Inside;
    for (k, &code) in soup.facet_edges[f as usize].iter().enumerate() {
        match (signs[k], signs[(k + 1) % 3]) {
            (Sign::Zero, next) => {
                stops.push(Stop::corner(geometry, geometry.base(f)[k], axis, [false; 2]));
                if next == Sign::Zero {
                    gap = Gap::Along(code / 2);
                }
            }
            (here, next) if here.times(next) == Sign::Negative => {
                stops.push(Stop::inside(soup, code / 2, g, axis));
            }
            _ => {}
        }
    }
    if let [a, b] = &mut stops[..] {
        if b.cmp(a, soup, axis).is_lt() {
            std::mem::swap(a, b);
        }
        a.gap = gap;
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
    for (i, &edge) in edges.iter().enumerate() {
        let [p, q] = soup.directed(edge);
        match (signs[i], signs[soup.next_in_loop(edges, i)]) {
            (Sign::Zero, Sign::Zero) => {
                on_line.push((edge / 2, [p, q]));
                push_corner(geometry, stops, p, axis, [false, false]);
                push_corner(geometry, stops, q, axis, [false, false]);
            }
            (Sign::Zero, s) => push_corner(geometry, stops, p, axis, toggles(s)),
            (s, Sign::Zero) => push_corner(geometry, stops, q, axis, toggles(s)),
            (s, t) if s != t => stops.push(Stop::inside(soup, edge / 2, g, axis)),
            _ => {}
        }
    }
    stops.sort_by(|a, b| a.cmp(b, soup, axis));
    let mut above_below = [false; 2];
    for i in 0..stops.len() {
        for (state, toggle) in above_below.iter_mut().zip(stops[i].toggles) {
            *state ^= toggle;
        }
        stops[i].gap = match above_below {
            [true, true] => Gap::Inside,
            _ => edge_over_gap(soup, stops, i, on_line, axis).map_or(Gap::Outside, Gap::Along),
        };
    }
}

/// An edge with one end on ℓ and the other above it toggles what is inside just above ℓ; likewise below.
fn toggles(sign: Sign) -> [bool; 2] {
    [sign == Sign::Positive, sign == Sign::Negative]
}

fn push_corner(geometry: &Geometry, stops: &mut Vec<Stop>, p: u32, axis: usize, toggles: [bool; 2]) {
    match stops.iter_mut().find(|s| s.site == Site::Corner(p)) {
        Some(stop) => (0..2).for_each(|k| stop.toggles[k] ^= toggles[k]),
        None => stops.push(Stop::corner(geometry, p, axis, toggles)),
    }
}

/// The edge on ℓ that covers the gap after stop i.
fn edge_over_gap(
    soup: &Soup,
    stops: &[Stop],
    i: usize,
    on_line: &[(u32, [u32; 2])],
    axis: usize,
) -> Option<u32> {
    if on_line.is_empty() {
        return None;
    }
    let geometry = &soup.geometry;
    let [before, after] = [&stops[i], stops.get(i + 1)?].map(|s| s.vertex(geometry, s.definition(soup)));
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
        match stop.site {
            Site::Corner(_) => Place::Corner,
            Site::Inside { edge, .. } => Place::OnEdge(edge),
        }
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
fn overlay(soup: &Soup, facets: [u32; 2], axis: usize, traces: &[Vec<Stop>; 2], out: &mut Contacts) {
    let [mut i, mut j] = [0, 0];
    let mut gaps = [Gap::Outside; 2];
    let mut previous: Option<VertexRef> = None;
    let mut any = false;
    while i < traces[0].len() || j < traces[1].len() {
        let (a, b) = (traces[0].get(i), traces[1].get(j));
        let order = match (a, b) {
            (Some(a), Some(b)) => a.cmp(b, soup, axis),
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
            let v = vertex_at(soup, stops, out);
            record_contact(v, places, [before, gaps], facets, out);
            v
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

/// The vertex of one or two stops in the same place; a corner, if one of them is.
fn vertex_at(soup: &Soup, stops: [Option<&Stop>; 2], out: &mut Contacts) -> VertexRef {
    let corner = stops.iter().flatten().find(|stop| matches!(stop.site, Site::Corner(_)));
    let stop = corner
        .or_else(|| stops.iter().flatten().next())
        .expect("every point of the overlay is a stop of one trace");
    match stop.definition(soup) {
        VertexDef::Point(p) => p,
        def => out.edge_vertex(&soup.geometry, def, |def| *stop.vertex(&soup.geometry, def)),
    }
}

/// Records a point that both facets have.
fn record_contact(
    v: VertexRef,
    places: [Place; 2],
    gaps: [[Gap; 2]; 2],
    facets: [u32; 2],
    out: &mut Contacts,
) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soup::Placed;
    use lar_core::{Points, Surface, TriangleMesh};
    use proptest::prelude::*;

    fn soup(corners: &[[u8; 3]]) -> Soup {
        let mut mesh = TriangleMesh { points: Points::new(3), triangles: Vec::new() };
        for corner in corners {
            mesh.points.push(&corner.map(f64::from));
        }
        mesh.triangles = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let surfaces = [Surface::from_triangles("triangles", &mesh)];
        Soup::new(&surfaces, Placed::snapped(&surfaces, |_, _| 0.0).expect("the points are finite"))
    }

    proptest! {
        /// Corners on few places: most pairs touch in some way.
        #[test]
        fn triangles_are_traced_as_polygons_are(corners in prop::collection::vec(prop::array::uniform3(0u8..4), 12)) {
            let soup = soup(&corners);
            let n = soup.n_facets() as u32;
            let (mut signs, mut on_line, mut found, mut expected) = Default::default();
            for (f, g) in (0..n).flat_map(|f| (0..n).map(move |g| (f, g))).filter(|(f, g)| f != g) {
                if classify(&soup, f, g, &mut signs) != Position::Across {
                    continue;
                }
                let axis = soup.geometry.axis_of_line([f, g]);
                trace(&soup, f, g, axis, &signs, &mut on_line, &mut expected);
                let [a, b, c] = signs[..] else { panic!("triangles have three corners") };
                trace_triangle(&soup, f, g, axis, [a, b, c], &mut found);
                let key = |stops: &[Stop]| stops.iter().map(|stop| (stop.site, stop.gap)).collect::<Vec<_>>();
                prop_assert_eq!(key(&found), key(&expected));
            }
        }
    }
}
