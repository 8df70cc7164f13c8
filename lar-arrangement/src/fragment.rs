//! Stage 2d: each facet, or group of overlapping coplanar facets, is cut into faces by what lies inside it,
//! independently of all others.
//!
//! Holds afterwards: the faces tile the facets; a face knows every facet that it is a piece of; its loops keep it
//! on their left seen from the tip of the normal of its first parent.

use crate::boxes::{Aabb, BoxTree};
use crate::crossing::segment_direction;
use crate::half_edges::MANY;
use crate::interner::Interner;
use crate::kernel::{Along, Direction, Geometry, Sign, Support, Vertex};
use crate::parallel;
use crate::progress::{Cancelled, Course};
use crate::soup::Soup;
use crate::split::Cuts;
use crate::subdivision::{Embedding, Subdivision};
use crate::union_find::UnionFind;
use lar_core::Cells;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// A piece of an edge, from `ends[0]` to `ends[1]`; vertices from `n_base` on are new ones of the same chunk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub ends: [u32; 2],
    pub direction: Direction,
    pub soft: bool,
}

/// Marks half-edges that are whole edges of the input.
pub(crate) const WHOLE: u32 = 1 << 31;

/// A facet that a face is a piece of, and whether their normals point the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct FacetParent {
    pub facet: u32,
    pub same_way: bool,
}

/// The facets that are cut, or whose edges are, by groups that overlap in one plane. All others are faces as they are.
#[derive(Debug)]
pub(crate) struct Groups {
    /// The first facet of each group, ascending.
    pub leaders: Vec<u32>,
    /// The facets of each group, ascending.
    pub members: Cells,
    /// Whether each facet is in a group.
    pub is_member: Vec<bool>,
}

impl Groups {
    /// From the sets of facets that overlap, and what was found in and on the facets.
    pub(crate) fn new(soup: &Soup, cuts: &Cuts, mut overlapping: UnionFind) -> Self {
        let n = soup.n_facets();
        let is_split = |&code: &u32| !cuts.inner.of(code / 2).is_empty();
        let users = || cuts.inner.keys().iter().flat_map(|&edge| soup.facets_of_edge[edge as usize]);
        let mut is_member = if users().any(|user| user == MANY) {
            parallel::map(n, |f| soup.facet_edges[f].iter().any(is_split))
        } else {
            vec![false; n]
        };
        for f in cuts.cut_facets().iter().copied().chain(users().filter(|&user| user < MANY)) {
            is_member[f as usize] = true;
        }
        for f in overlapping.joined() {
            is_member[f as usize] = true;
            is_member[overlapping.find(f) as usize] = true;
        }
        let members = (0..n as u32).filter(|&f| is_member[f as usize]);
        let mut led: Vec<(u32, u32)> = members.map(|f| (overlapping.find(f), f)).collect();
        led.sort_unstable();
        let mut out = Self { leaders: Vec::new(), members: Cells::new(), is_member };
        for group in led.chunk_by(|a, b| a.0 == b.0) {
            out.leaders.push(group[0].0);
            out.members.push(&group.iter().map(|g| g.1).collect::<Vec<_>>());
        }
        out
    }

    /// Number of groups of several facets.
    pub(crate) fn n_overlapping(&self) -> u64 {
        self.members.iter().filter(|group| group.len() > 1).count() as u64
    }
}

/// The faces of some facets.
#[derive(Debug, Default)]
pub(crate) struct Fragments {
    pub vertices: Vec<Vertex>,
    pub pieces: Vec<Piece>,
    /// Half-edges of all loops: 2 · piece, + 1 against its direction; or, marked with `WHOLE`, directed edges of the
    /// input that are not split.
    pub half_edges: Vec<u32>,
    /// End of each loop in `half_edges`.
    pub loop_ends: Vec<u32>,
    /// End of each face in `loop_ends`.
    pub face_ends: Vec<u32>,
    pub parents: Vec<FacetParent>,
    /// End of each face in `parents`.
    pub parent_ends: Vec<u32>,
    /// End of each group of facets in `face_ends`.
    pub group_ends: Vec<u32>,
}

impl Fragments {
    fn close_loop(&mut self) {
        self.loop_ends.push(self.half_edges.len() as u32);
    }

    fn close_face(&mut self, parents: impl IntoIterator<Item = FacetParent>) {
        self.parents.extend(parents);
        self.parent_ends.push(self.parents.len() as u32);
        self.face_ends.push(self.loop_ends.len() as u32);
    }
}

/// Whether all contacts of the facets are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    Everywhere,
    /// Not where they do not matter to a result: edges that lie over each other may be split at different points there.
    NearResult,
}

/// What fragmentation reads.
pub(crate) struct Fragmenter<'a> {
    pub soup: &'a Soup,
    pub cuts: &'a Cuts,
    /// Vertices known to all facets.
    pub vertices: &'a [Vertex],
    pub extent: Extent,
    /// Without reports: the work in a group is part of a chunk.
    pub course: Course<'a>,
}

impl Fragmenter<'_> {
    /// Cuts one group of facets that lie in one plane.
    pub(crate) fn fragment(&self, group: &[u32], out: &mut Fragments) -> Result<(), Cancelled> {
        self.course.go_on()?;
        match group {
            &[facet] if self.cuts.segments(facet).is_empty() => self.whole(facet, out),
            _ => Local::new(self, group).fragment(out)?,
        }
        out.group_ends.push(out.face_ends.len() as u32);
        Ok(())
    }

    /// A facet with nothing inside: one face, its edges possibly split.
    fn whole(&self, facet: u32, out: &mut Fragments) {
        let mut first = None;
        for &edge in &self.soup.facet_edges[facet as usize] {
            let [tail, head] = self.soup.directed(edge);
            first.get_or_insert(tail);
            if self.cuts.inner.of(edge / 2).is_empty() {
                out.half_edges.push(WHOLE | edge);
            } else {
                self.walk(edge, |piece| {
                    out.half_edges.push(2 * out.pieces.len() as u32);
                    out.pieces.push(piece);
                });
            }
            if first == Some(head) {
                out.close_loop();
                first = None;
            }
        }
        out.close_face([FacetParent { facet, same_way: true }]);
    }

    /// The pieces of a directed edge in its direction.
    fn walk(&self, edge: u32, mut visit: impl FnMut(Piece)) {
        let id = edge / 2;
        let ends = self.soup.edges[id as usize];
        let along = self.soup.geometry.direction(Along::Edge(ends));
        let direction = if edge.is_multiple_of(2) { along } else { along.opposite() };
        let [tail, head] = self.soup.directed(edge);
        let inner = self.cuts.inner.of(id);
        let n = inner.len();
        let at = |i: usize| match i {
            0 => tail,
            i if i == n + 1 => head,
            i if edge.is_multiple_of(2) => inner[i - 1],
            i => inner[n - i],
        };
        for i in 0..=n {
            visit(Piece { ends: [at(i), at(i + 1)], direction, soft: self.soup.is_soft(id) });
        }
    }
}

/// A segment that cuts the group, from the end that comes first along `axis`; or a point, when the ends are equal.
struct CutLine {
    ends: [u32; 2],
    other: u32,
    direction: Direction,
    axis: usize,
    splits: Vec<u32>,
}

impl CutLine {
    fn is_point(&self) -> bool {
        self.ends[0] == self.ends[1]
    }
}

/// A boundary piece's use by a member of the group: +1 when the member runs along it.
#[derive(Clone, Copy, Debug)]
struct Use {
    member: u32,
    sign: i8,
}

/// A boundary piece, by whom it is used, and the input edge that it is part of.
type Used = (Piece, Use, u32);

/// One group with its own numbering of vertices.
struct Local<'a> {
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
    fn new(from: &'a Fragmenter<'a>, group: &'a [u32]) -> Self {
        let (axis, up) = from.soup.geometry.dominant_axis(group[0]);
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let uv = if up { [u, v] } else { [v, u] };
        let mut known = Vec::new();
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
        let mut interner = Interner::default();
        for &v in &known {
            interner.push(from.vertices[v as usize]);
        }
        Self {
            from,
            group,
            uv,
            known,
            interner,
            pieces: Vec::new(),
            uses: Vec::new(),
            use_ends: Vec::new(),
            boxes: OnceCell::new(),
        }
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

    fn fragment(mut self, out: &mut Fragments) -> Result<(), Cancelled> {
        self.push_boundary();
        let mut lines = self.cut_lines();
        self.cross(&mut lines)?;
        self.push_cuts(lines);
        let edges: Vec<[u32; 2]> = self.pieces.iter().map(|p| p.ends).collect();
        let subdivision = Subdivision::new(self.interner.vertices.len(), &edges, &self);
        let windings = self.windings(&subdivision);
        self.emit(&subdivision, &windings, out);
        Ok(())
    }

    /// The boundary pieces of all members, each once, with who uses it.
    fn push_boundary(&mut self) {
        let mut all = Vec::new();
        for (&facet, member) in self.group.iter().zip(0..) {
            for &edge in &self.from.soup.facet_edges[facet as usize] {
                self.from.walk(edge, |piece| {
                    let [a, b] = piece.ends.map(|v| self.local(v));
                    let (ends, direction, sign) = if a < b {
                        ([a, b], piece.direction, 1)
                    } else {
                        ([b, a], piece.direction.opposite(), -1)
                    };
                    all.push((Piece { ends, direction, ..piece }, Use { member, sign }, edge / 2));
                });
            }
        }
        if self.from.extent == Extent::NearResult && self.group.len() > 1 {
            all = self.split_at_each_other(all);
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
    fn cut_lines(&self) -> Vec<CutLine> {
        let mut keyed: Vec<([u32; 2], u32, u32)> = Vec::new();
        for &facet in self.group {
            for s in self.from.cuts.segments(facet) {
                let [a, b] = s.ends.map(|v| self.local(v));
                keyed.push(([a.min(b), a.max(b)], facet, s.other));
            }
        }
        keyed.sort_unstable();
        keyed.dedup_by_key(|k| k.0);
        let mut lines: Vec<CutLine> = keyed
            .into_iter()
            .map(|([a, b], facet, other)| {
                let (direction, axis) = segment_direction(self.geometry(), facet, other);
                let ascending = self.geometry().cmp_coordinate(self.vertex(a), self.vertex(b), axis).is_lt();
                let ends = if ascending { [a, b] } else { [b, a] };
                CutLine { ends, other, direction, axis, splits: Vec::new() }
            })
            .collect();
        if let Some(template) = lines.first() {
            let (other, direction, axis) = (template.other, template.direction, template.axis);
            lines.extend(self.loose_points().into_iter().map(|p| CutLine {
                ends: [p, p],
                other,
                direction,
                axis,
                splits: Vec::new(),
            }));
        }
        lines
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

    /// Splits the lines where they meet. Few lines are tested pair by pair (at most 120 pairs), more through a
    /// tree of boxes.
    fn cross(&mut self, lines: &mut [CutLine]) -> Result<(), Cancelled> {
        if lines.len() <= 16 {
            for j in 1..lines.len() {
                for i in 0..j {
                    self.cross_pair(lines, i, j);
                }
            }
            return Ok(());
        }
        let boxes: Vec<Aabb> =
            lines.iter().map(|l| Aabb::around(l.ends.map(|v| self.vertex(v).at))).collect();
        for [i, j] in BoxTree::new(&boxes).pairs(&self.from.course, |_, _| true, |_, _| false)? {
            self.from.course.go_on()?;
            self.cross_pair(lines, i as usize, j as usize);
        }
        Ok(())
    }

    fn cross_pair(&mut self, lines: &mut [CutLine], i: usize, j: usize) {
        let (s, t) = (&lines[i], &lines[j]);
        match (s.is_point(), t.is_point()) {
            (true, true) => return,
            (true, false) => return self.split_at_points(lines, j, &[lines[i].ends[0]]),
            (false, true) => return self.split_at_points(lines, i, &[lines[j].ends[0]]),
            (false, false) => {}
        }
        let of_s = self.sides(s, t);
        if of_s[0].times(of_s[1]) == Sign::Positive {
            return;
        }
        if of_s == [Sign::Zero; 2] {
            let (of_i, of_j) = (lines[i].ends, lines[j].ends);
            self.split_at_points(lines, i, &of_j);
            self.split_at_points(lines, j, &of_i);
            return;
        }
        let of_t = self.sides(t, s);
        let proper = |signs: [Sign; 2]| signs[0].times(signs[1]) == Sign::Negative;
        if proper(of_s) && proper(of_t) {
            let vertex = self.geometry().facets_vertex([self.group[0], s.other, t.other]);
            let v = self.interner.intern(vertex, self.geometry());
            lines[i].splits.push(v);
            lines[j].splits.push(v);
            return;
        }
        for (k, signs, other, others) in [(i, of_s, j, of_t), (j, of_t, i, of_s)] {
            if proper(signs) {
                let ends = lines[other].ends;
                lines[k].splits.extend((0..2).filter(|&e| others[e] == Sign::Zero).map(|e| ends[e]));
            }
        }
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
    fn split_at_points(&self, lines: &mut [CutLine], i: usize, points: &[u32]) {
        let line = &lines[i];
        let ends = line.ends;
        let inside = |p: &&u32| {
            let v = self.vertex(**p);
            !ends.contains(p)
                && self.geometry().cmp_coordinate(self.vertex(ends[0]), v, line.axis).is_lt()
                && self.geometry().cmp_coordinate(v, self.vertex(ends[1]), line.axis).is_lt()
                && self.geometry().side(v, Support::Facet(line.other)) == Sign::Zero
        };
        let found: Vec<u32> = points.iter().filter(inside).copied().collect();
        lines[i].splits.extend(found);
    }

    /// Adds the pieces of the lines that are not boundary pieces, each once.
    fn push_cuts(&mut self, lines: Vec<CutLine>) {
        let n_boundary = self.pieces.len();
        let mut cuts = Vec::new();
        for mut line in lines {
            if line.is_point() {
                continue;
            }
            line.splits
                .sort_by(|&a, &b| self.geometry().cmp_coordinate(self.vertex(a), self.vertex(b), line.axis));
            line.splits.dedup();
            let mut tail = line.ends[0];
            for head in line.splits.into_iter().chain([line.ends[1]]) {
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
        for cut in cuts {
            match self.pieces[..n_boundary].binary_search_by_key(&cut.ends, |p| p.ends) {
                // A facet ends on this piece: it is there for more than its own polygon's sake.
                Ok(at) => self.pieces[at].soft = false,
                Err(_) => self.pieces.push(cut),
            }
        }
    }

    /// For each face the members that contain it, by walking from the outside across the boundary pieces.
    fn windings(&self, subdivision: &Subdivision) -> Cells {
        let n = subdivision.n_faces();
        if self.is_one_triangle() {
            // It has all faces but the outer one.
            let offsets = std::iter::once(0).chain(0..n as u32).collect();
            return Cells::from_parts(offsets, vec![0; n - 1]);
        }
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); n];
        for h in 0..2 * self.pieces.len() as u32 {
            around[subdivision.face(h) as usize].push(h);
        }
        let mut counts: Vec<Option<Vec<(u32, i32)>>> = vec![None; n];
        counts[0] = Some(Vec::new());
        let mut stack = vec![0u32];
        while let Some(face) = stack.pop() {
            for &h in &around[face as usize] {
                let beyond = subdivision.face(h ^ 1) as usize;
                if counts[beyond].is_none() {
                    let here =
                        counts[face as usize].as_ref().expect("faces are counted before they are stacked");
                    counts[beyond] = Some(self.across(here, h ^ 1));
                    stack.push(beyond as u32);
                }
            }
        }
        let mut members = Cells::new();
        for counted in counts {
            members.push(&counted.iter().flatten().map(|(member, _)| *member).collect::<Vec<_>>());
        }
        members
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

    /// The counts on the left of half-edge h, from those on its right.
    fn across(&self, right: &[(u32, i32)], h: u32) -> Vec<(u32, i32)> {
        let mut left = right.to_vec();
        let along = if h.is_multiple_of(2) { 1 } else { -1 };
        for used in self.uses_of(h / 2) {
            let same_way = self.geometry().same_way(self.group[0], self.group[used.member as usize]);
            let change = i32::from(used.sign) * along * if same_way { 1 } else { -1 };
            match left.binary_search_by_key(&used.member, |c| c.0) {
                Ok(at) if left[at].1 + change == 0 => {
                    left.remove(at);
                }
                Ok(at) => left[at].1 += change,
                Err(at) => left.insert(at, (used.member, change)),
            }
        }
        left
    }

    /// Writes the faces inside at least one member.
    fn emit(&self, subdivision: &Subdivision, windings: &Cells, out: &mut Fragments) {
        let n_base = self.from.vertices.len() as u32;
        let new_from = n_base + out.vertices.len() as u32;
        out.vertices.extend_from_slice(&self.interner.vertices[self.known.len()..]);
        let global = |v: u32| match self.known.get(v as usize) {
            Some(&known) => known,
            None => new_from + v - self.known.len() as u32,
        };
        let first_piece = out.pieces.len() as u32;
        out.pieces.extend(self.pieces.iter().map(|p| Piece { ends: p.ends.map(global), ..*p }));
        for face in 1..subdivision.n_faces() {
            let members = &windings[face];
            let Some(&first) = members.first() else { continue };
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
            out.close_face(members.iter().map(|&m| {
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
