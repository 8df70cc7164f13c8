//! The edges of the skeleton, numbered in the order in which its faces have them.
//!
//! The edges of the input are in the order in which facets have them, and those that no group of facets may have in its loops
//! stay in it: they are the same edges, and their numbers only shift. Those *at the border*, and what else groups have, are
//! numbered one by one, where a face has them first.
//!
//! ```text
//!     edges of the input    0  1  2  3  4  5      3 is at the border
//!     a group adds a, b              ↑            where a face has neither 3 nor what is behind it yet
//!     edges                 0  1  2  a  b  4  5   3 is a or b, or none: 4 and 5 shift by 2 − 1
//! ```

use super::{Group, Parts};
use crate::counting;
use crate::fragment::{Fragments, Piece, WHOLE};
use crate::half_edges::{self, HalfEdges};
use crate::kernel::Way;
use crate::parallel;
use crate::soup::Soup;
use crate::split::Cuts;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// No edge, and no step that has one.
const NONE: u32 = u32::MAX;

/// What edges become.
pub(super) struct Numbering<'a> {
    parts: &'a Parts<'a>,
    /// The edge that each edge of the input is: of those at the border, and of all once the edges are written.
    whole: Vec<u32>,
    /// The edges of the input that are left out where they were, ascending.
    border: Vec<u32>,
    /// Those that come instead, in their order.
    added: Vec<Added>,
    /// The half-edge that each piece of each part is.
    half_edges_of_pieces: Vec<u32>,
    /// The edges that are no edges of the input, ascending.
    pub pieces: Vec<u32>,
    /// Their directions, from the smaller end to the larger.
    pub directions: Vec<Way>,
}

/// An edge that is not where the input has it.
#[derive(Clone, Copy)]
struct Added {
    /// Before this edge of the input.
    at: u32,
    ends: [u32; 2],
}

impl<'a> Numbering<'a> {
    /// Numbers what is at the border or new. O(n), and hashing for pieces between points of the input.
    ///
    /// Each part of the groups tells by itself what it adds and in which order. What all of it is numbered is known once it is
    /// known how much the parts before it add.
    pub(super) fn new(parts: &'a Parts<'a>, cuts: &Cuts, n_vertices: usize) -> Self {
        let fragments = parts.fragments;
        let border = Border::new(parts, cuts);
        let steps = Steps::new(parts, &border);
        let mut first_piece = first_pieces(fragments, n_vertices);
        let n_pieces = || fragments.iter().map(|part| part.pieces.len());
        let mut edge_of_first = parallel::map_light(first_piece.len(), |_| NONE);
        let part_of_groups =
            |part| PartOfGroups { parts, part, border: &border, steps: &steps, first_piece: &first_piece };
        let own = parallel::cut(&mut edge_of_first, n_pieces());
        parallel::map_each(own, |part, own| part_of_groups(part).note_users(own));
        let own = parallel::cut(&mut edge_of_first, n_pieces());
        let of_parts = parallel::map_each(own, |part, own| part_of_groups(part).additions(own));
        debug_assert!(
            first_piece.iter().all(|&first| edge_of_first[first as usize] != NONE),
            "a piece is in no loop"
        );
        let n_before = counting::offsets(of_parts.iter().map(|part| part.added.len() as u32));
        let pieces = parallel::map_each(parallel::cut(&mut edge_of_first, n_pieces()), |part, own| {
            let additions = &of_parts[part];
            let numbers = border.numbers(&additions.added, n_before[part]);
            let is_added = |edge: &&mut u32| **edge & WHOLE == 0;
            own.iter_mut().filter(is_added).for_each(|edge| *edge = numbers[*edge as usize]);
            for &(edge, addition) in &additions.whole {
                border.state[edge as usize].store(numbers[addition as usize], Relaxed);
            }
            additions.pieces.iter().map(|&addition| numbers[addition as usize]).collect::<Vec<u32>>()
        });
        let whole: Vec<u32> = border.state.into_iter().map(AtomicU32::into_inner).collect();
        let own = parallel::cut(&mut first_piece, n_pieces()).into_iter().zip(fragments).collect();
        parallel::each(own, |(half_edges, part): (&mut [u32], &Fragments)| {
            for (half_edge, piece) in half_edges.iter_mut().zip(&part.pieces) {
                let edge = match edge_of_first[*half_edge as usize] {
                    edge if edge & WHOLE == 0 => edge,
                    marked => whole[(marked ^ WHOLE) as usize],
                };
                *half_edge = 2 * edge + u32::from(piece.ends[0] > piece.ends[1]);
            }
        });
        let (added, directions) = of_parts.into_iter().map(|part| (part.added, part.directions)).unzip();
        Self {
            parts,
            whole,
            border: border.edges,
            added: parallel::joined(added),
            half_edges_of_pieces: first_piece,
            pieces: parallel::concat(&pieces),
            directions: parallel::joined(directions),
        }
    }

    /// The half-edge that one of a group's is, once the edges are written.
    pub(super) fn half_edge(&self, group: &Group<'_>, half_edge: u32) -> u32 {
        match half_edge & WHOLE {
            0 => self.half_edges_of_pieces[(group.first_piece + half_edge / 2) as usize] ^ (half_edge % 2),
            _ => self.whole_half_edge(half_edge ^ WHOLE),
        }
    }

    /// The half-edge that a directed edge of the input is, once the edges are written.
    pub(super) fn whole_half_edge(&self, code: u32) -> u32 {
        2 * self.whole[(code / 2) as usize] + code % 2
    }

    /// Writes the ends of all edges, with new numbers for the vertices, and notes what became of the input's. O(n).
    pub(super) fn edges(&mut self, new_vertex: impl Fn(u32) -> u32 + Sync + Send) -> Vec<[u32; 2]> {
        let (old, border, added) = (&self.parts.soup.edges, &self.border, &self.added);
        // What is left out and added before an edge of the input; what is added behind all of these belongs to the last part.
        let before = |end: usize| {
            let is_before = |edge: u32| (edge as usize) < end || end == old.len();
            let n_added = if end == 0 { 0 } else { added.partition_point(|added| is_before(added.at)) };
            (border.partition_point(|&edge| (edge as usize) < end), n_added)
        };
        let part_of = |part: usize| {
            let range = parallel::part_of(old.len(), part);
            let (from, to) = (before(range.start), before(range.end));
            (range, &border[from.0..to.0], &added[from.1..to.1])
        };
        let parts: Vec<_> = (0..parallel::n_threads()).map(part_of).collect();
        let lengths = parts.iter().map(|(range, border, added)| range.len() - border.len() + added.len());
        let mut edges = parallel::zeros(lengths.clone().sum());
        let own = parallel::cut(&mut edges, lengths.clone()).into_iter();
        let own = own.zip(parallel::cut(&mut self.whole, parts.iter().map(|(range, ..)| range.len())));
        let mut end = 0;
        let begins = lengths.map(|n| {
            end += n as u32;
            end - n as u32
        });
        parallel::each(parts.iter().zip(begins).zip(own).collect(), |((part, begin), (edges, whole))| {
            let (range, border, added) = part;
            let (mut border, mut added) = (border.iter().peekable(), added.iter().peekable());
            let (mut at, mut n) = (range.start, 0);
            loop {
                let next = border.peek().map_or(range.end, |&&edge| edge as usize);
                let next = added.peek().map_or(next, |added| next.min(added.at as usize));
                let kept = whole[at - range.start..next - range.start].iter_mut().zip(&old[at..next]);
                let to = edges[n..].iter_mut().zip(begin + n as u32..);
                for ((edge, number), (new, ends)) in to.zip(kept) {
                    (*edge, *new) = (ends.map(&new_vertex), number);
                }
                n += next - at;
                at = next;
                if let Some(added) = added.next_if(|added| added.at as usize == at) {
                    edges[n] = added.ends.map(&new_vertex);
                    n += 1;
                } else if border.next().is_some() {
                    at += 1;
                } else {
                    return;
                }
            }
        });
        edges
    }

    /// Whether each of n edges is only a diagonal inside a polygon, once they are written; nothing when none can be.
    pub(super) fn soft(&self, n: usize) -> Vec<bool> {
        let soup = self.parts.soup;
        if !soup.has_soft_edges() {
            return Vec::new();
        }
        let mut soft = vec![true; n];
        let stays = |edge: &u32| !soup.is_soft(*edge);
        let whole = (0..self.whole.len() as u32).filter(stays).map(|edge| self.whole[edge as usize]);
        let pieces =
            self.parts.fragments.iter().flat_map(|part| &part.pieces).zip(&self.half_edges_of_pieces);
        let hard = pieces.filter(|(piece, _)| !piece.soft).map(|(_, half_edge)| half_edge / 2);
        for edge in whole.filter(|&edge| edge != NONE).chain(hard) {
            soft[edge as usize] = false;
        }
        soft
    }
}

/// The edges of the input that faces need not have in the order of the input.
struct Border<'a> {
    soup: &'a Soup,
    cuts: &'a Cuts,
    is_border: Vec<bool>,
    /// They, ascending.
    edges: Vec<u32>,
    /// Edges of the input that pieces between points of the input may be, and others, by their ends.
    input_edges: FxHashMap<[u32; 2], u32>,
    /// Of each edge at the border the first step that has it, nothing while it is given a place, then its number.
    state: Vec<AtomicU32>,
}

impl<'a> Border<'a> {
    fn new(parts: &Parts<'a>, cuts: &'a Cuts) -> Self {
        let soup = parts.soup;
        let mut is_border = vec![false; soup.edges.len()];
        for &code in parts.groups.members.indices().iter().flat_map(|&f| &soup.facet_edges[f as usize]) {
            is_border[(code / 2) as usize] = true;
        }
        // Pieces between points of the input may be edges of it, of members or of others.
        let n_points = soup.geometry.n_points() as u32;
        let between_points: Vec<[u32; 2]> = parallel::map(parts.fragments.len(), |part| {
            let pieces = parts.fragments[part].pieces.iter();
            pieces.map(ends_of).filter(|ends| ends[1] < n_points).collect::<Vec<_>>()
        })
        .concat();
        let input_edges = soup.edges_between(between_points.iter().copied());
        for ends in between_points {
            if let Some(&edge) = input_edges.get(&ends) {
                is_border[edge as usize] = true;
            }
        }
        let edges = parallel::select(is_border.len(), |edge| is_border[edge as usize]);
        let state = parallel::map_light(is_border.len(), |_| AtomicU32::new(NONE));
        Self { soup, cuts, is_border, edges, input_edges, state }
    }

    /// The edge of the input that a piece is, with the ends of one that is not split.
    fn edge_of_piece(&self, piece: &Piece) -> Option<u32> {
        let ends = ends_of(piece);
        if ends[1] as usize >= self.soup.geometry.n_points() {
            return None;
        }
        let is_whole = |&edge: &u32| self.cuts.inner.of(edge).is_empty();
        self.input_edges.get(&ends).copied().filter(is_whole)
    }

    /// The numbers of some edges that are added one after the other, behind so many others.
    fn numbers(&self, added: &[Added], n_before: u32) -> Vec<u32> {
        let first = added.first().map_or(0, |added| added.at);
        let mut left_out = self.edges.partition_point(|&edge| edge < first);
        let number = |(added, n_added): (&Added, u32)| {
            left_out += self.edges[left_out..].iter().take_while(|&&edge| edge < added.at).count();
            added.at - left_out as u32 + n_added
        };
        added.iter().zip(n_before..).map(number).collect()
    }
}

/// What may have edges that are at the border or new, in the order of the faces: facets in no group, and groups.
struct Steps {
    list: Vec<Step>,
    /// Those of each part of the groups, and of facets before its first group, or behind its last.
    of_parts: Vec<Range<usize>>,
}

#[derive(Clone, Copy)]
struct Step {
    /// The first one, for a group.
    facet: u32,
    /// The first edge of the input that no facet before has.
    seen: u32,
    is_group: bool,
}

/// What a part adds.
#[derive(Default)]
struct Additions {
    added: Vec<Added>,
    /// Which of these are edges of the input: the edge, and its place.
    whole: Vec<(u32, u32)>,
    /// Which are not, and their directions.
    pieces: Vec<u32>,
    directions: Vec<Way>,
}

impl Steps {
    fn new(parts: &Parts<'_>, border: &Border<'_>) -> Self {
        let list = Self::all(parts, border);
        let first_of = |leader: u32| list.partition_point(|step| step.facet < leader);
        let mut n_groups = 0;
        let mut begins: Vec<usize> = Vec::with_capacity(parts.fragments.len() + 1);
        for part in parts.fragments {
            begins.push(if n_groups == 0 { 0 } else { first_of(parts.groups.leaders[n_groups]) });
            n_groups += part.group_ends.len();
        }
        begins.push(list.len());
        let of_parts = begins.windows(2).map(|w| w[0]..w[1]).collect();
        Self { list, of_parts }
    }

    fn all(parts: &Parts<'_>, border: &Border<'_>) -> Vec<Step> {
        let facets = &parts.soup.facet_edges;
        if border.edges.is_empty() {
            return Vec::new();
        }
        let of_parts = parallel::map(parallel::n_threads(), |part| {
            let (mut steps, mut seen) = (Vec::new(), 0);
            let range = parallel::part_of(facets.len(), part);
            let leaders = &parts.groups.leaders;
            let mut leaders = leaders[leaders.partition_point(|&leader| (leader as usize) < range.start)..]
                .iter()
                .peekable();
            for (codes, facet) in facets.iter().skip(range.start).take(range.len()).zip(range.start as u32..)
            {
                if codes.iter().any(|&code| border.is_border[(code / 2) as usize]) {
                    let is_group = leaders.next_if_eq(&&facet).is_some();
                    if is_group || !parts.groups.is_member[facet as usize] {
                        steps.push(Step { facet, seen, is_group });
                    }
                }
                seen = codes.iter().fold(seen, |seen, &code| seen.max(code / 2 + 1));
            }
            (steps, seen)
        });
        let mut all = Vec::new();
        let mut before = 0;
        for (steps, seen) in of_parts {
            all.extend(steps.into_iter().map(|step| Step { seen: before.max(step.seen), ..step }));
            before = before.max(seen);
        }
        all
    }
}

/// A part of the groups, and what its uses of edges are looked at with.
struct PartOfGroups<'a> {
    parts: &'a Parts<'a>,
    part: usize,
    border: &'a Border<'a>,
    steps: &'a Steps,
    /// For each piece of each part the first one of all with the same ends.
    first_piece: &'a [u32],
}

impl PartOfGroups<'_> {
    fn piece(&self, piece: u32) -> &Piece {
        &self.parts.fragments[self.part].pieces[piece as usize]
    }

    /// The first piece with the ends of one of this part, by its place in the part; none when it is another part's.
    fn first(&self, piece: u32) -> Option<u32> {
        let begin = self.parts.first_pieces[self.part];
        self.first_piece[(begin + piece) as usize].checked_sub(begin)
    }

    /// Calls `visit` with each use of an edge of the input or of a piece in the steps of the part, in their order: with the step,
    /// the edge of the input that no facet up to there has, and what it is a use of.
    fn each_use(&self, mut visit: impl FnMut(u32, u32, Use)) {
        let (steps, border) = (self.steps.of_parts[self.part].clone(), self.border);
        let mut groups = self.parts.groups_of(self.part);
        for (step, number) in self.steps.list[steps.clone()].iter().zip(steps.start as u32..) {
            if step.is_group {
                let group = groups.next().expect("each group is a step");
                for &h in group.all_half_edges() {
                    let used = if h & WHOLE == 0 { Use::Piece(h / 2) } else { Use::Whole((h ^ WHOLE) / 2) };
                    visit(number, step.seen, used);
                }
                continue;
            }
            let mut seen = step.seen;
            for &code in &border.soup.facet_edges[step.facet as usize] {
                if border.is_border[(code / 2) as usize] {
                    visit(number, seen, Use::Whole(code / 2));
                }
                seen = seen.max(code / 2 + 1);
            }
        }
    }

    /// Notes the first step that has each edge of the border, and in `edge_of_first`, marked with `WHOLE`, which of the part's
    /// pieces that are the first ones with their ends are edges of the input.
    fn note_users(&self, edge_of_first: &mut [u32]) {
        self.each_use(|step, _, used| {
            let edge = match used {
                Use::Whole(edge) => edge,
                // One that is another's has a later step.
                Use::Piece(piece) if self.first(piece) == Some(piece) => {
                    let Some(edge) = self.border.edge_of_piece(self.piece(piece)) else { return };
                    edge_of_first[piece as usize] = WHOLE | edge;
                    edge
                }
                Use::Piece(_) => return,
            };
            self.border.state[edge as usize].fetch_min(step, Relaxed);
        });
    }

    /// What the part adds. Its pieces that are the first ones with their ends, and no edges of the input, get their places among
    /// these in `edge_of_first`.
    fn additions(&self, edge_of_first: &mut [u32]) -> Additions {
        let mut out = Additions::default();
        self.each_use(|step, at, used| {
            let place = out.added.len() as u32;
            let edge = match used {
                Use::Whole(edge) => edge,
                Use::Piece(piece) => {
                    let Some(first) = self.first(piece) else { return };
                    let edge_of_first = &mut edge_of_first[first as usize];
                    if *edge_of_first == NONE {
                        *edge_of_first = place;
                        let piece = self.piece(piece);
                        let (ends, way) = (ends_of(piece), piece.direction);
                        out.added.push(Added { at, ends });
                        out.pieces.push(place);
                        out.directions.push(if ends == piece.ends { way } else { way.opposite() });
                    }
                    if *edge_of_first & WHOLE == 0 {
                        return;
                    }
                    *edge_of_first ^ WHOLE
                }
            };
            let state = &self.border.state[edge as usize];
            // Nobody else changes the state of an edge that this step has first.
            if state.load(Relaxed) == step {
                state.store(NONE, Relaxed);
                out.whole.push((edge, place));
                out.added.push(Added { at, ends: self.border.soup.edges[edge as usize] });
            }
        });
        out
    }
}

/// What a face has in a loop.
enum Use {
    /// An edge of the input.
    Whole(u32),
    /// A piece of the part.
    Piece(u32),
}

/// For each piece of each part the first one of all with the same ends.
fn first_pieces(fragments: &[Fragments], n_vertices: usize) -> Vec<u32> {
    let [tails, heads] = [0, 1].map(|end| {
        let lengths = fragments.iter().map(|part| part.pieces.len());
        let mut ends = parallel::zeros(lengths.clone().sum());
        let of_parts = parallel::cut(&mut ends, lengths).into_iter().zip(fragments).collect();
        parallel::each(of_parts, |(ends, part): (&mut [u32], &Fragments)| {
            ends.iter_mut().zip(&part.pieces).for_each(|(to, piece)| *to = piece.ends[end]);
        });
        ends
    });
    half_edges::first_of_edge(n_vertices, HalfEdges::Listed { tails: &tails, heads: &heads })
}

/// The ends of a piece, the smaller first.
fn ends_of(piece: &Piece) -> [u32; 2] {
    let [a, b] = piece.ends;
    [a.min(b), a.max(b)]
}
