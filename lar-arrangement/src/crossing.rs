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

use crate::beside::Corners;
use crate::boxes::Aabb;
use crate::kernel::{Along, Direction, Geometry, Side, Sign, Spot, Vertex, VertexDef, crossing_near};
use crate::soup::Soup;
use rustc_hash::FxHashMap;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// A vertex in the lists below: an input point, or (from `n_points` on) an entry of `Contacts::vertices` of the same chunk.
pub(crate) type VertexRef = u32;

/// A segment inside `facet`, common with the facet `other`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Segment {
    pub facet: u32,
    pub other: u32,
    pub ends: [VertexRef; 2],
}

/// What the pairs of facets of a chunk have in common.
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

    /// No more will come: what only finds vertices again is let go of.
    pub(crate) fn close(&mut self) {
        self.known = FxHashMap::default();
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
    fn corner(corner: &Spot, axis: usize, toggles: [bool; 2]) -> Self {
        let site = Site::Corner(corner.p);
        Self {
            site,
            at: corner.at[axis],
            error: corner.rounding,
            vertex: OnceCell::new(),
            toggles,
            gap: Gap::Outside,
        }
    }

    fn inside(site: Site, (at, error): (f64, f64)) -> Self {
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
        self.vertex.get_or_init(|| match def {
            VertexDef::Point(p) => geometry.point_vertex(p),
            _ => geometry.vertex_on_edge(def),
        })
    }

    /// Whether this one comes first along the axis beyond doubt.
    fn is_clearly_before(&self, other: &Self) -> bool {
        other.at - self.at > self.error + other.error
    }

    /// Order along `axis`, exactly.
    fn cmp(&self, other: &Self, soup: &Soup, axis: usize) -> Ordering {
        if self.is_clearly_before(other) {
            return Ordering::Less;
        }
        if other.is_clearly_before(self) {
            return Ordering::Greater;
        }
        let (a, b, geometry) = (self.definition(soup), other.definition(soup), &soup.geometry);
        geometry.cmp_coordinate_by_definition([&a, &b], axis).unwrap_or_else(|| {
            geometry.cmp_coordinate(self.vertex(geometry, a), other.vertex(geometry, b), axis)
        })
    }
}

/// A facet as it is read for a pair.
#[derive(Default)]
struct Outline {
    facet: u32,
    /// The tails of its directed edges.
    corners: Corners,
    /// Where each lies to the plane of the other facet.
    sides: Vec<Side>,
}

impl Outline {
    /// O(its edges), of which there are at most 64; nothing to do for the facet that is there.
    fn read(&mut self, soup: &Soup, facet: u32) {
        let geometry = &soup.geometry;
        if self.facet == facet && !self.corners.spots.is_empty() {
            return;
        }
        self.facet = facet;
        match &soup.facet_edges[facet as usize] {
            [_, _, _] => self.corners.read(geometry.base(facet).map(|p| geometry.spot(p))),
            edges => self.corners.read_all(edges.iter().map(|&edge| geometry.spot(soup.directed(edge)[0]))),
        }
    }

    /// Finds the sides of the corners to the plane of g. Most pairs end here.
    fn classify(&mut self, soup: &Soup, g: u32) -> Position {
        let (of_g, plane) = (soup.geometry.base(g), soup.geometry.seen_from(g));
        let (mut below, mut above, mut on, mut shares) = (false, false, false, false);
        self.sides.clear();
        self.sides.extend(self.corners.spots.iter().map(|corner| {
            let side = plane.side(corner);
            let is_shared = of_g.iter().fold(false, |is_shared, &p| is_shared | (p == corner.p));
            below |= side.sign == Sign::Negative;
            above |= side.sign == Sign::Positive;
            on |= (side.sign == Sign::Zero) & !is_shared;
            shares |= is_shared;
            side
        }));
        let are_triangles = || self.corners.spots.len() == 3 && soup.is_triangle(g);
        match (below, above) {
            (true, true) => Position::Across,
            (false, false) => Position::Coplanar,
            _ if on || (shares && !are_triangles()) => Position::Touching,
            _ => Position::Apart,
        }
    }

    /// For a facet that touches the plane of another: whether its corners there lie where the other is not. A quick test: their
    /// box against that of the other; rounding is monotone.
    fn is_outside(&self, other: &Self) -> bool {
        let corners = self.corners.spots.iter().zip(&self.sides);
        let on_plane = corners.filter(|(_, side)| side.sign == Sign::Zero).map(|(corner, _)| corner.at);
        !Aabb::around(on_plane).meets(&other.corners.hull)
    }

    /// Where edge i, from one corner to another, passes through the plane of g.
    fn crossing(&self, edge: u32, [from, to]: [usize; 2], g: u32, axis: usize) -> Stop {
        let [p, q] = [from, to].map(|corner| &self.corners.spots[corner]);
        let sides = [from, to].map(|corner| &self.sides[corner]);
        Stop::inside(Site::Inside { edge, facet: g }, crossing_near([p, q], sides, axis))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Position {
    /// All corners on one side; for triangles, but for corners that they share: then they have nothing else in common but
    /// a shared edge.
    Apart,
    Coplanar,
    /// Some corners are on the plane, and all others on one side of it.
    Touching,
    /// There are corners on both sides.
    Across,
}

/// Buffers for the pairs of one chunk.
#[derive(Default)]
pub(crate) struct Scratch {
    outlines: [Outline; 2],
    traces: [Vec<Stop>; 2],
    on_line: Vec<(u32, [u32; 2])>,
}

/// Finds what facets f and g have in common.
pub(crate) fn meet(soup: &Soup, f: u32, g: u32, scratch: &mut Scratch, out: &mut Contacts) {
    // One facet after the other is in many pairs, first or second.
    if scratch.outlines[0].facet == g || scratch.outlines[1].facet == f {
        scratch.outlines.swap(0, 1);
    }
    let [of_f, of_g] = &mut scratch.outlines;
    of_f.read(soup, f);
    // Facets along two axes mostly belong to boxes, and these to grids, where most pairs lie side by side. Of others this is
    // not asked before it is known that they touch.
    let is_flat = of_f.corners.are_flat();
    if is_flat {
        of_g.read(soup, g);
        if of_f.corners.are_beside(&of_g.corners) {
            return;
        }
    }
    let position = of_f.classify(soup, g);
    if position == Position::Apart {
        return;
    }
    of_g.read(soup, g);
    if !is_flat && position != Position::Across && of_f.corners.are_beside(&of_g.corners) {
        return;
    }
    match position {
        Position::Coplanar => return out.coplanar.push([f, g]),
        Position::Touching if of_f.is_outside(of_g) => return,
        _ => {}
    }
    match of_g.classify(soup, f) {
        Position::Apart | Position::Coplanar => return,
        Position::Touching if of_g.is_outside(of_f) => return,
        Position::Touching | Position::Across => {}
    }
    let axis = soup.geometry.axis_of_line([f, g]);
    for (i, other) in [g, f].into_iter().enumerate() {
        let (outline, stops) = (&scratch.outlines[i], &mut scratch.traces[i]);
        match outline.corners.spots.len() {
            3 => trace_triangle(soup, outline, other, axis, stops),
            _ => trace(soup, outline, other, axis, &mut scratch.on_line, stops),
        }
    }
    let [a, b] = &scratch.traces;
    let precedes = |a: &[Stop], b: &[Stop]| match (a.last(), b.first()) {
        (Some(last), Some(first)) => last.is_clearly_before(first),
        _ => true,
    };
    if !precedes(a, b) && !precedes(b, a) {
        overlay(soup, [f, g], axis, &scratch.traces, out);
    }
}

/// The stops of a triangle on the plane of g, sorted along `axis`: one or two.
fn trace_triangle(soup: &Soup, outline: &Outline, g: u32, axis: usize, stops: &mut Vec<Stop>) {
    stops.clear();
    let mut gap = Gap::Inside;
    for (k, &code) in soup.facet_edges[outline.facet as usize].iter().enumerate() {
        let next = (k + 1) % 3;
        match [k, next].map(|corner| outline.sides[corner].sign) {
            [Sign::Zero, sign] => {
                stops.push(Stop::corner(&outline.corners.spots[k], axis, [false; 2]));
                if sign == Sign::Zero {
                    gap = Gap::Along(code / 2);
                }
            }
            [here, there] if here.times(there) == Sign::Negative => {
                stops.push(outline.crossing(code / 2, [k, next], g, axis));
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

/// The stops of a facet on the plane of g, sorted along `axis`.
fn trace(
    soup: &Soup,
    outline: &Outline,
    g: u32,
    axis: usize,
    on_line: &mut Vec<(u32, [u32; 2])>,
    stops: &mut Vec<Stop>,
) {
    stops.clear();
    on_line.clear();
    let edges = &soup.facet_edges[outline.facet as usize];
    for (i, &edge) in edges.iter().enumerate() {
        let next = soup.next_in_loop(edges, i);
        let [p, q] = [i, next].map(|corner| &outline.corners.spots[corner]);
        match [i, next].map(|corner| outline.sides[corner].sign) {
            [Sign::Zero, Sign::Zero] => {
                on_line.push((edge / 2, [p.p, q.p]));
                push_corner(stops, p, axis, [false, false]);
                push_corner(stops, q, axis, [false, false]);
            }
            [Sign::Zero, s] => push_corner(stops, p, axis, toggles(s)),
            [s, Sign::Zero] => push_corner(stops, q, axis, toggles(s)),
            [s, t] if s != t => stops.push(outline.crossing(edge / 2, [i, next], g, axis)),
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

fn push_corner(stops: &mut Vec<Stop>, corner: &Spot, axis: usize, toggles: [bool; 2]) {
    match stops.iter_mut().find(|s| s.site == Site::Corner(corner.p)) {
        Some(stop) => (0..2).for_each(|k| stop.toggles[k] ^= toggles[k]),
        None => stops.push(Stop::corner(corner, axis, toggles)),
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
    use crate::coplanar::{self, Overlay};
    use crate::soup::Placed;
    use lar_core::{Points, Surface, TriangleMesh};
    use proptest::prelude::*;

    fn soup(corners: &[[u8; 3]]) -> Soup {
        let mut mesh = TriangleMesh { points: Points::new(3), triangles: Vec::new() };
        for corner in corners {
            mesh.points.push(&corner.map(f64::from));
        }
        mesh.triangles = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        soup_of(Surface::from_triangles("triangles", &mesh))
    }

    /// Faces along the axes on a grid, in all places: parts of a square, and others with notches.
    fn flat_faces() -> Surface {
        const SHAPES: [&[[u8; 2]]; 5] = [
            &[[0, 0], [1, 0], [1, 1], [0, 1]],
            &[[0, 0], [1, 0], [1, 1]],
            &[[0, 0], [2, 1], [0, 1]],
            &[[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
            &[[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]],
        ];
        let mut surface = Surface::new("faces", Points::new(3));
        for (axis, place) in (0..3).flat_map(|axis| (0..16).map(move |place| (axis, place))) {
            for shape in SHAPES {
                let first = surface.points.len() as u32;
                for [u, v] in shape {
                    let mut at = [0.0; 3];
                    at[axis] = f64::from(1 + place % 2);
                    at[(axis + 1) % 3] = f64::from(u + place / 2 % 3);
                    at[(axis + 2) % 3] = f64::from(v + place / 6);
                    surface.points.push(&at);
                }
                let corners: Vec<u32> = (first..surface.points.len() as u32).collect();
                surface.push_face([&corners[..]], 1);
            }
        }
        surface
    }

    /// Whether two facets have more in common than shared corners and edges, without a look at whether they lie side by side.
    fn have_contact(soup: &Soup, [f, g]: [u32; 2]) -> bool {
        let [mut of_f, mut of_g] = [f, g].map(|facet| {
            let mut outline = Outline::default();
            outline.read(soup, facet);
            outline
        });
        let mut out = Contacts::default();
        match of_f.classify(soup, g) {
            Position::Apart => return false,
            Position::Coplanar => {
                let may_overlap = coplanar::meet(soup, [f, g], &mut Overlay::default(), &mut out);
                // Which is not known of facets with notches.
                let is_known = [&of_f, &of_g].iter().all(|outline| outline.corners.spots.len() <= 4);
                return (may_overlap && is_known) || !out.splits.is_empty();
            }
            Position::Touching | Position::Across => of_g.classify(soup, f),
        };
        let axis = soup.geometry.axis_of_line([f, g]);
        let traces = [(&of_f, g), (&of_g, f)].map(|(outline, other)| {
            let (mut stops, mut on_line) = (Vec::new(), Vec::new());
            trace(soup, outline, other, axis, &mut on_line, &mut stops);
            stops
        });
        overlay(soup, [f, g], axis, &traces, &mut out);
        out.crossing_pairs > 0
            || !(out.splits.is_empty() && out.segments.is_empty() && out.touches.is_empty())
    }

    /// Whether all pairs of facets that lie side by side have no contact, and how many there are of those whose boxes meet.
    fn pairs_beside(soup: &Soup) -> (usize, usize) {
        let n = soup.n_facets() as u32;
        let (mut n_beside, mut n_others) = (0, 0);
        for [f, g] in (0..n).flat_map(|f| (0..n).map(move |g| [f, g])).filter(|[f, g]| f != g) {
            let [mut of_f, mut of_g] = [Outline::default(), Outline::default()];
            of_f.read(soup, f);
            of_g.read(soup, g);
            let is_beside = of_f.corners.are_beside(&of_g.corners);
            let has_contact = have_contact(soup, [f, g]);
            assert!(!(is_beside && has_contact), "facets {f} and {g}");
            if of_f.corners.hull.meets(&of_g.corners.hull) && !has_contact {
                *if is_beside { &mut n_beside } else { &mut n_others } += 1;
            }
        }
        (n_beside, n_others)
    }

    fn soup_of(surface: Surface) -> Soup {
        let surfaces = [surface];
        Soup::new(&surfaces, Placed::snapped(&surfaces, |_, _| 0.0).expect("the points are finite"))
    }

    #[test]
    fn facets_that_lie_side_by_side_have_no_contact() {
        let (n_beside, n_others) = pairs_beside(&soup_of(flat_faces()));
        assert!(n_beside > 1000 && n_beside > 4 * n_others, "{n_beside} are found, {n_others} are not");
    }

    proptest! {
        /// Corners on few places: most pairs touch in some way.
        #[test]
        fn triangles_are_traced_as_polygons_are(corners in prop::collection::vec(prop::array::uniform3(0u8..4), 12)) {
            let soup = soup(&corners);
            let n = soup.n_facets() as u32;
            let (mut outline, mut on_line, mut found, mut expected) = (Outline::default(), vec![], vec![], vec![]);
            for (f, g) in (0..n).flat_map(|f| (0..n).map(move |g| (f, g))).filter(|(f, g)| f != g) {
                outline.read(&soup, f);
                if matches!(outline.classify(&soup, g), Position::Apart | Position::Coplanar) {
                    continue;
                }
                let axis = soup.geometry.axis_of_line([f, g]);
                trace(&soup, &outline, g, axis, &mut on_line, &mut expected);
                trace_triangle(&soup, &outline, g, axis, &mut found);
                let key = |stops: &[Stop]| stops.iter().map(|stop| (stop.site, stop.gap)).collect::<Vec<_>>();
                prop_assert_eq!(key(&found), key(&expected));
            }
        }

        #[test]
        fn triangles_that_lie_side_by_side_have_no_contact(
            corners in prop::collection::vec(prop::array::uniform3(0u8..4), 24)
        ) {
            pairs_beside(&soup(&corners));
        }
    }
}
