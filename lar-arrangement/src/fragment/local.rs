//! One group of overlapping facets cut into faces: a planar subdivision of its own.

use super::{Extent, FacetParent, Fragmenter, Fragments, way_of};
use crate::boxes::{Aabb, BoxTree};
use crate::crossing::segment_direction;
use crate::interner::Interner;
use crate::kernel::{Direction, Geometry, Sign, Support, Vertex};
use crate::progress::Cancelled;
use crate::subdivision::{self, Embedding, Subdivision};
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::mem::take;

/// Up to so many lines are tested pair by pair, more through a tree of boxes.
const FEW: usize = 16;

/// A segment that cuts the group, from the end that comes first along `axis`; or a point, when the ends are equal.
#[derive(Debug)]
struct CutLine {
    ends: [u32; 2],
    other: u32,
    direction: Direction,
    axis: usize,
    span: Aabb,
}

impl CutLine {
    fn is_point(&self) -> bool {
        self.ends[0] == self.ends[1]
    }
}

/// A piece with the approximation of its direction.
type Piece = super::Piece<Direction>;

/// A vertex inside a line.
type Split = (u32, u32);

/// A boundary piece's use by a member of the group: +1 when the member runs along it.
#[derive(Clone, Copy, Debug)]
struct Use {
    member: u32,
    sign: i8,
}

/// A boundary piece, by whom it is used, and the input edge that it is part of.
type Used = (Piece, Use, u32);

/// A member, and how often its boundary winds around a face.
type Count = (u32, i32);

/// How often the members wind around each face, without those that do not.
struct Windings {
    counts: Vec<Count>,
    /// Where the counts of each face begin and end; those of a face ascend.
    of_face: Vec<Option<(usize, usize)>>,
}

impl Windings {
    fn of(&self, face: usize) -> &[Count] {
        self.of_face[face].map_or(&[], |(begin, end)| &self.counts[begin..end])
    }
}

/// The lists of one group after the other, in the same memory.
#[derive(Debug, Default)]
pub(crate) struct Room {
    known: Vec<u32>,
    interner: Interner,
    pieces: Vec<Piece>,
    uses: Vec<Use>,
    use_ends: Vec<u32>,
    boundary: Vec<Used>,
    segments: Vec<([u32; 2], u32, u32)>,
    lines: Vec<CutLine>,
    splits: Vec<Split>,
    cuts: Vec<Piece>,
    edges: Vec<[u32; 2]>,
    subdivision: subdivision::Room,
}

/// One group with its own numbering of vertices.
pub(super) struct Local<'a> {
    from: &'a Fragmenter<'a>,
    group: &'a [u32],
    /// Axes of the projection, so that the normal of the group's first facet points at the viewer.
    uv: [usize; 2],
    /// Known vertices, ascending; local vertex i is `known[i]`, later ones are new.
    known: Vec<u32>,
    interner: Interner,
    pieces: Vec<Piece>,
    /// Uses of the first pieces, and where those of each end; cuts have none.
    uses: Vec<Use>,
    use_ends: Vec<u32>,
    /// Boxes of the pieces, built when a component has to be located.
    boxes: OnceCell<BoxTree>,
}

impl<'a> Local<'a> {
    pub(super) fn new(from: &'a Fragmenter<'a>, group: &'a [u32], room: &mut Room) -> Self {
        let (axis, up) = from.soup.geometry.dominant_axis(group[0]);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let uv = if up { [u, v] } else { [v, u] };
        let mut known = take(&mut room.known);
        for &facet in group {
            for &edge in &from.soup.facet_edges[facet as usize] {
                known.push(from.soup.directed(edge)[0]);
                known.extend_from_slice(from.cuts.inner.of(edge / 2));
            }
            known.extend(from.cuts.segments(facet).iter().flat_map(|s| s.ends));
            known.extend(from.cuts.touches(facet));
        }
        known.sort_unstable();
        known.dedup();
        let mut interner = take(&mut room.interner);
        for &v in &known {
            interner.push(from.vertices[v as usize]);
        }
        Self {
            from,
            group,
            uv,
            known,
            interner,
            pieces: take(&mut room.pieces),
            uses: take(&mut room.uses),
            use_ends: take(&mut room.use_ends),
            boxes: OnceCell::new(),
        }
    }

    /// Leaves its lists behind, empty.
    fn leave(self, room: &mut Room) {
        let Self { mut known, mut interner, mut pieces, mut uses, mut use_ends, .. } = self;
        known.clear();
        interner.clear();
        pieces.clear();
        uses.clear();
        use_ends.clear();
        (room.known, room.interner, room.pieces) = (known, interner, pieces);
        (room.uses, room.use_ends) = (uses, use_ends);
    }

    fn geometry(&self) -> &'a Geometry {
        &self.from.soup.geometry
    }

    fn vertex(&self, v: u32) -> &Vertex {
        &self.interner.vertices[v as usize]
    }

    fn local(&self, v: u32) -> u32 {
        self.known.binary_search(&v).expect("all vertices of the group were collected") as u32
    }

    pub(super) fn fragment(mut self, room: &mut Room, out: &mut Fragments) -> Result<(), Cancelled> {
        self.push_boundary(&mut room.boundary);
        self.find_lines(&mut room.segments, &mut room.lines);
        room.splits.clear();
        self.cross(&room.lines, &mut room.splits)?;
        self.push_cuts(&room.lines, &mut room.splits, &mut room.cuts);
        room.edges.clear();
        room.edges.extend(self.pieces.iter().map(|p| p.ends));
        let n_vertices = self.interner.vertices.len();
        let subdivision = Subdivision::new(n_vertices, &room.edges, &self, &mut room.subdivision);
        self.emit(&subdivision, out);
        room.subdivision.take_back(subdivision);
        self.leave(room);
        Ok(())
    }

    /// The boundary pieces of all members, each once, with who uses it.
    fn push_boundary(&mut self, all: &mut Vec<Used>) {
        all.clear();
        let from = self.from;
        for (&facet, member) in self.group.iter().zip(0..) {
            for &edge in &from.soup.facet_edges[facet as usize] {
                let direction = self.geometry().towards(way_of(edge, from.soup));
                for piece in from.pieces(edge, direction) {
                    let [a, b] = piece.ends.map(|v| self.local(v));
                    let (ends, direction, sign) = if a < b {
                        ([a, b], piece.direction, 1)
                    } else {
                        ([b, a], piece.direction.opposite(), -1)
                    };
                    all.push((Piece { ends, direction, ..piece }, Use { member, sign }, edge / 2));
                }
            }
        }
        if self.from.extent == Extent::NearResult && self.group.len() > 1 {
            *all = self.split_at_each_other(take(all));
        }
        all.sort_by_key(|(piece, used, _)| (piece.ends, used.member));
        for same in all.chunk_by(|a, b| a.0.ends == b.0.ends) {
            self.pieces.push(Piece { soft: same.iter().all(|(p, _, _)| p.soft), ..same[0].0 });
            self.uses.extend(same.iter().map(|(_, used, _)| *used));
            self.use_ends.push(self.uses.len() as u32);
        }
    }

    /// The pieces, split where an end of one lies inside of another.
    fn split_at_each_other(&self, all: Vec<Used>) -> Vec<Used> {
        let around = |ends: [u32; 2]| Aabb::around(ends.map(|v| self.vertex(v).at));
        let tree = BoxTree::new(&all.iter().map(|(piece, ..)| around(piece.ends)).collect::<Vec<_>>());
        let mut points: Vec<u32> = all.iter().flat_map(|(piece, ..)| piece.ends).collect();
        points.sort_unstable();
        points.dedup();
        let mut splits: Vec<(u32, u32)> = Vec::new();
        for p in points {
            tree.query(&around([p; 2]), |i| {
                if self.is_inside(p, &all[i as usize]) {
                    splits.push((i, p));
                }
            });
        }
        splits.sort_unstable();
        let mut rest = splits.as_slice();
        let mut out = Vec::with_capacity(all.len() + splits.len());
        for ((piece, used, edge), i) in all.into_iter().zip(0..) {
            let (here, after) = rest.split_at(rest.partition_point(|split| split.0 <= i));
            rest = after;
            let (axis, sign) = self.geometry().axis_of(&piece.direction);
            let mut stops: Vec<u32> = here.iter().map(|split| split.1).collect();
            stops.sort_by(|&a, &b| self.geometry().cmp_coordinate(self.vertex(a), self.vertex(b), axis));
            if sign == Sign::Negative {
                stops.reverse();
            }
            let mut tail = piece.ends[0];
            for head in stops.into_iter().chain([piece.ends[1]]) {
                let (ends, direction, sign) = if tail < head {
                    ([tail, head], piece.direction, used.sign)
                } else {
                    ([head, tail], piece.direction.opposite(), -used.sign)
                };
                out.push((Piece { ends, direction, ..piece }, Use { sign, ..used }, edge));
                tail = head;
            }
        }
        out
    }

    /// Whether a vertex lies inside of a boundary piece.
    fn is_inside(&self, p: u32, (piece, _, edge): &Used) -> bool {
        let geometry = self.geometry();
        let (axis, sign) = geometry.axis_of(&piece.direction);
        let [first, last] = if sign == Sign::Positive { piece.ends } else { [piece.ends[1], piece.ends[0]] };
        let (upright, _) = geometry.dominant_axis(self.group[0]);
        let ends = self.from.soup.edges[*edge as usize];
        let v = self.vertex(p);
        !piece.ends.contains(&p)
            && geometry.cmp_coordinate(self.vertex(first), v, axis).is_lt()
            && geometry.cmp_coordinate(v, self.vertex(last), axis).is_lt()
            && geometry.side(v, Support::Vertical { ends, axis: upright as u8 }) == Sign::Zero
    }

    /// The segments inside the members, each once, and the points that may lie on them.
    fn find_lines(&self, segments: &mut Vec<([u32; 2], u32, u32)>, lines: &mut Vec<CutLine>) {
        segments.clear();
        for &facet in self.group {
            for s in self.from.cuts.segments(facet) {
                let [a, b] = s.ends.map(|v| self.local(v));
                segments.push(([a.min(b), a.max(b)], facet, s.other));
            }
        }
        segments.sort_unstable();
        segments.dedup_by_key(|s| s.0);
        let span = |ends: [u32; 2]| Aabb::around(ends.map(|v| self.vertex(v).at));
        lines.clear();
        lines.extend(segments.iter().map(|&([a, b], facet, other)| {
            let (direction, axis) = segment_direction(self.geometry(), facet, other);
            let ascending = self.geometry().cmp_coordinate(self.vertex(a), self.vertex(b), axis).is_lt();
            let ends = if ascending { [a, b] } else { [b, a] };
            CutLine { ends, other, direction, axis, span: span(ends) }
        }));
        if let Some(&CutLine { other, direction, axis, .. }) = lines.first() {
            let point = |p| CutLine { ends: [p, p], other, direction, axis, span: span([p, p]) };
            lines.extend(self.loose_points().into_iter().map(point));
        }
    }

    /// Points inside the group that need not be ends of segments: where another facet only touches, and, with
    /// several members, the vertices of each member's boundary, which may lie on a segment inside another.
    fn loose_points(&self) -> Vec<u32> {
        let mut points: Vec<u32> =
            self.group.iter().flat_map(|&f| self.from.cuts.touches(f)).map(|&v| self.local(v)).collect();
        if self.group.len() > 1 {
            points.extend(self.pieces.iter().flat_map(|p| p.ends));
        }
        points.sort_unstable();
        points.dedup();
        points
    }

    /// Finds where the lines meet. Few lines are tested pair by pair (at most 120 pairs), more through a tree of boxes.
    fn cross(&mut self, lines: &[CutLine], splits: &mut Vec<Split>) -> Result<(), Cancelled> {
        if lines.len() <= FEW {
            for j in 1..lines.len() {
                for i in 0..j {
                    if lines[i].span.meets(&lines[j].span) {
                        self.cross_pair(lines, [i, j], splits);
                    }
                }
            }
            return Ok(());
        }
        let boxes: Vec<Aabb> = lines.iter().map(|l| l.span).collect();
        for pair in BoxTree::new(&boxes).pairs(&self.from.course, |_, _| true, |_, _| false)? {
            self.from.course.go_on()?;
            self.cross_pair(lines, pair.map(|i| i as usize), splits);
        }
        Ok(())
    }

    /// Finds where two lines with boxes that meet split each other.
    fn cross_pair(&mut self, lines: &[CutLine], [i, j]: [usize; 2], splits: &mut Vec<Split>) {
        let (s, t) = (&lines[i], &lines[j]);
        match (s.is_point(), t.is_point()) {
            (true, true) => return,
            (true, false) => return self.split_at_points(lines, j, &s.ends[..1], splits),
            (false, true) => return self.split_at_points(lines, i, &t.ends[..1], splits),
            (false, false) => {}
        }
        if self.go_apart(s, t) {
            return;
        }
        let of_s = self.sides(s, t);
        if of_s[0].times(of_s[1]) == Sign::Positive {
            return;
        }
        if of_s == [Sign::Zero; 2] {
            self.split_at_points(lines, i, &t.ends, splits);
            self.split_at_points(lines, j, &s.ends, splits);
            return;
        }
        let of_t = self.sides(t, s);
        let proper = |signs: [Sign; 2]| signs[0].times(signs[1]) == Sign::Negative;
        if proper(of_s) && proper(of_t) {
            let vertex = self.geometry().facets_vertex([self.group[0], s.other, t.other]);
            let v = self.interner.intern(vertex, self.geometry());
            splits.extend([i, j].map(|line| (line as u32, v)));
            return;
        }
        for (k, signs, other, others) in [(i, of_s, t, of_t), (j, of_t, s, of_s)] {
            if proper(signs) {
                let on_line = (0..2).filter(|&e| others[e] == Sign::Zero);
                splits.extend(on_line.map(|e| (k as u32, other.ends[e])));
            }
        }
    }

    /// Whether two lines lead from a common end to different sides along an axis: then they have nothing else in common.
    /// Rounding is monotone, so that what is smaller when rounded is smaller exactly.
    fn go_apart(&self, s: &CutLine, t: &CutLine) -> bool {
        let ([a, b], [c, d]) = (s.ends, t.ends);
        let (common, ends) = match () {
            () if a == c => (a, [b, d]),
            () if a == d => (a, [b, c]),
            () if b == c => (b, [a, d]),
            () if b == d => (b, [a, c]),
            () => return false,
        };
        let (p, [q, r]) = (self.vertex(common).at, ends.map(|v| self.vertex(v).at));
        (0..3).any(|k| (q[k] < p[k] && p[k] < r[k]) || (r[k] < p[k] && p[k] < q[k]))
    }

    /// Sides of the ends of s against the plane that t comes from.
    fn sides(&self, s: &CutLine, t: &CutLine) -> [Sign; 2] {
        s.ends.map(|v| {
            if t.ends.contains(&v) {
                Sign::Zero
            } else {
                self.geometry().side(self.vertex(v), Support::Facet(t.other))
            }
        })
    }

    /// Splits line i at those of the points that lie inside it.
    fn split_at_points(&self, lines: &[CutLine], i: usize, points: &[u32], splits: &mut Vec<Split>) {
        let line = &lines[i];
        let ends = line.ends;
        let inside = |p: &&u32| {
            let v = self.vertex(**p);
            !ends.contains(p)
                && self.geometry().cmp_coordinate(self.vertex(ends[0]), v, line.axis).is_lt()
                && self.geometry().cmp_coordinate(v, self.vertex(ends[1]), line.axis).is_lt()
                && self.geometry().side(v, Support::Facet(line.other)) == Sign::Zero
        };
        splits.extend(points.iter().filter(inside).map(|&p| (i as u32, p)));
    }

    /// Adds the pieces of the lines that are not boundary pieces, each once.
    fn push_cuts(&mut self, lines: &[CutLine], splits: &mut Vec<Split>, cuts: &mut Vec<Piece>) {
        splits.sort_unstable();
        splits.dedup();
        let mut rest = &mut splits[..];
        cuts.clear();
        for (line, i) in lines.iter().zip(0..) {
            let here = rest.partition_point(|split| split.0 <= i);
            let (stops, after) = rest.split_at_mut(here);
            rest = after;
            if line.is_point() {
                continue;
            }
            let along = |v: u32| self.vertex(v);
            stops.sort_by(|a, b| self.geometry().cmp_coordinate(along(a.1), along(b.1), line.axis));
            let mut tail = line.ends[0];
            for head in stops.iter().map(|stop| stop.1).chain([line.ends[1]]) {
                let (ends, direction) = if tail < head {
                    ([tail, head], line.direction)
                } else {
                    ([head, tail], line.direction.opposite())
                };
                cuts.push(Piece { ends, direction, soft: false });
                tail = head;
            }
        }
        cuts.sort_by_key(|piece| piece.ends);
        cuts.dedup_by_key(|piece| piece.ends);
        let n_boundary = self.pieces.len();
        for cut in cuts {
            match self.pieces[..n_boundary].binary_search_by_key(&cut.ends, |p| p.ends) {
                // A facet ends on this piece: it is there for more than its own polygon's sake.
                Ok(at) => self.pieces[at].soft = false,
                Err(_) => self.pieces.push(*cut),
            }
        }
    }

    /// For each face the members that contain it, by walking from the outside across the boundary pieces.
    fn windings(&self, subdivision: &Subdivision) -> Windings {
        let mut out = Windings { counts: Vec::new(), of_face: vec![None; subdivision.n_faces()] };
        out.of_face[0] = Some((0, 0));
        let mut stack = vec![0u32];
        while let Some(face) = stack.pop() {
            let here = out.of_face[face as usize].expect("faces are counted before they are stacked");
            let cycles = subdivision.cycles_of_face[face as usize].iter();
            for &h in cycles.flat_map(|&cycle| subdivision.cycle(cycle)) {
                let beyond = subdivision.face(h ^ 1);
                if out.of_face[beyond as usize].is_none() {
                    out.of_face[beyond as usize] = Some(self.across(&mut out.counts, here, h ^ 1));
                    stack.push(beyond);
                }
            }
        }
        out
    }

    fn is_one_triangle(&self) -> bool {
        matches!(self.group, &[facet] if self.from.soup.is_triangle(facet))
    }

    fn uses_of(&self, piece: u32) -> &[Use] {
        let piece = piece as usize;
        match self.use_ends.get(piece) {
            Some(&end) => {
                let start = piece.checked_sub(1).map_or(0, |before| self.use_ends[before]);
                &self.uses[start as usize..end as usize]
            }
            None => &[],
        }
    }

    /// Adds the counts on the left of half-edge h, from those on its right; returns where they are.
    fn across(&self, counts: &mut Vec<Count>, right: (usize, usize), h: u32) -> (usize, usize) {
        let begin = counts.len();
        counts.extend_from_within(right.0..right.1);
        let along = if h.is_multiple_of(2) { 1 } else { -1 };
        for used in self.uses_of(h / 2) {
            let same_way = self.geometry().same_way(self.group[0], self.group[used.member as usize]);
            let change = i32::from(used.sign) * along * if same_way { 1 } else { -1 };
            match counts[begin..].binary_search_by_key(&used.member, |c| c.0) {
                Ok(at) if counts[begin + at].1 + change == 0 => {
                    counts.remove(begin + at);
                }
                Ok(at) => counts[begin + at].1 += change,
                Err(at) => counts.insert(begin + at, (used.member, change)),
            }
        }
        (begin, counts.len())
    }

    /// Writes the faces inside at least one member.
    fn emit(&self, subdivision: &Subdivision, out: &mut Fragments) {
        // One triangle has all faces but the outer one.
        let windings = (!self.is_one_triangle()).then(|| self.windings(subdivision));
        let n_base = self.from.vertices.len() as u32;
        let new_from = n_base + out.vertices.len() as u32;
        out.vertices.extend_from_slice(&self.interner.vertices[self.known.len()..]);
        let global = |v: u32| match self.known.get(v as usize) {
            Some(&known) => known,
            None => new_from + v - self.known.len() as u32,
        };
        let first_piece = out.pieces.len() as u32;
        out.pieces.extend(self.pieces.iter().map(|p| super::Piece {
            ends: p.ends.map(global),
            direction: p.direction.way(),
            soft: p.soft,
        }));
        for face in 1..subdivision.n_faces() {
            let members = windings.as_ref().map_or(&[(0, 1)][..], |windings| windings.of(face));
            let Some(&(first, _)) = members.first() else { continue };
            let first = self.group[first as usize];
            let turned = !self.geometry().same_way(self.group[0], first);
            for &cycle in &subdivision.cycles_of_face[face] {
                let half_edges = subdivision.cycles.list[cycle as usize].iter().map(|&h| h + 2 * first_piece);
                if turned {
                    out.half_edges.extend(half_edges.rev().map(|h| h ^ 1));
                } else {
                    out.half_edges.extend(half_edges);
                }
                out.close_loop();
            }
            out.close_face(members.iter().map(|&(m, _)| {
                let facet = self.group[m as usize];
                FacetParent { facet, same_way: self.geometry().same_way(first, facet) }
            }));
        }
    }
}

impl Local<'_> {
    fn half_edge_direction(&self, h: u32) -> Direction {
        let direction = self.pieces[(h / 2) as usize].direction;
        if h.is_multiple_of(2) { direction } else { direction.opposite() }
    }

    /// Quarter of the turn from −u (excluded) counter-clockwise to −u (included): below, +u, above, −u.
    fn quarter(&self, d: &Direction) -> u8 {
        let [u, v] = self.uv;
        match self.geometry().component(d, v) {
            Sign::Negative => 0,
            Sign::Positive => 2,
            Sign::Zero if self.geometry().component(d, u) == Sign::Positive => 1,
            Sign::Zero => 3,
        }
    }
}

impl Embedding for Local<'_> {
    fn angular_order(&self, a: u32, b: u32) -> Ordering {
        let (a, b) = (self.half_edge_direction(a), self.half_edge_direction(b));
        let [u, v] = self.uv;
        self.quarter(&a).cmp(&self.quarter(&b)).then_with(|| match self.geometry().turn(&a, &b, u, v) {
            Sign::Positive => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Negative => Ordering::Greater,
        })
    }

    fn sweep_order(&self, a: u32, b: u32) -> Ordering {
        let (a, b) = (self.vertex(a), self.vertex(b));
        let [u, v] = self.uv;
        self.geometry().cmp_coordinate(a, b, u).then_with(|| self.geometry().cmp_coordinate(a, b, v))
    }

    fn locate(&self, vertex: u32, component: u32, component_of: &[u32]) -> Option<u32> {
        let [u, v] = self.uv;
        let geometry = self.geometry();
        let at = self.vertex(vertex);
        let start = geometry.midpoint(at, at);
        let boxes = self.boxes.get_or_init(|| {
            let ends = |p: &Piece| p.ends.map(|v| self.vertex(v).at);
            BoxTree::new(&self.pieces.iter().map(|p| Aabb::around(ends(p))).collect::<Vec<_>>())
        });
        let mut beam = Aabb { lo: [f64::NEG_INFINITY; 3], hi: [f64::INFINITY; 3] };
        beam.hi[u] = at.at[u];
        (beam.lo[v], beam.hi[v]) = (at.at[v], at.at[v]);
        let mut nearest: Option<u32> = None;
        boxes.query(&beam, |id| {
            let piece = &self.pieces[id as usize];
            if component_of[piece.ends[0] as usize] == component {
                return;
            }
            let below = piece.ends.map(|p| geometry.cmp_coordinate(self.vertex(p), at, v).is_le());
            if below[0] == below[1] {
                return;
            }
            // The half-edge that leads down has the vertex on its left when the vertex is to its right.
            let down = 2 * id + u32::from(below[0]);
            let [top, bottom] = self.half_edge_ends(down).map(|p| self.vertex(p));
            if geometry.orientation(top, bottom, &start, u, v) == Sign::Positive
                && nearest.is_none_or(|n| self.is_right_of(down, n))
            {
                nearest = Some(down);
            }
        });
        nearest
    }
}

impl Local<'_> {
    fn half_edge_ends(&self, h: u32) -> [u32; 2] {
        let [a, b] = self.pieces[(h / 2) as usize].ends;
        if h.is_multiple_of(2) { [a, b] } else { [b, a] }
    }

    /// For two half-edges that lead down across the same horizontal line without crossing: whether a is to the
    /// right of b there.
    fn is_right_of(&self, a: u32, b: u32) -> bool {
        let geometry = self.geometry();
        let [u, v] = self.uv;
        let side = |p: u32, h: u32| {
            let [top, bottom] = self.half_edge_ends(h).map(|p| self.vertex(p));
            let point = geometry.midpoint(self.vertex(p), self.vertex(p));
            geometry.orientation(top, bottom, &point, u, v)
        };
        // Left of a half-edge that leads down is right on the page.
        let of_a = self.half_edge_ends(a).map(|p| side(p, b));
        if of_a.iter().all(|&s| s != Sign::Negative) {
            return true;
        }
        if of_a.iter().all(|&s| s != Sign::Positive) {
            return false;
        }
        self.half_edge_ends(b).iter().all(|&p| side(p, a) != Sign::Positive)
    }
}
