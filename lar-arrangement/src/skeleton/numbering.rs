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
use crate::fragment::{Fragments, Piece, WHOLE};
use crate::half_edges::{self, HalfEdges};
use crate::kernel::Way;
use crate::parallel;
use crate::soup::Soup;
use crate::split::Cuts;
use rustc_hash::FxHashMap;
use std::iter::Peekable;
use std::ops::Range;
use std::vec::IntoIter;

/// An edge that no face has yet.
const NOT_SEEN: u32 = u32::MAX;

/// Something that is not as in the input.
struct Change {
    /// Before this edge of the input.
    at: u32,
    /// Another one is added; without, the edge itself is left out.
    added: Option<[u32; 2]>,
    /// What is added (modulo 2^32) to the number of an edge behind, up to the next change.
    shift: u32,
}

/// What edges become.
pub(super) struct Numbering<'a> {
    soup: &'a Soup,
    cuts: &'a Cuts,
    /// The edge that each edge of the input is: of those at the border, and of all once the edges are written.
    whole: Vec<u32>,
    /// Which edges of the input are at the border.
    is_border: Vec<bool>,
    /// Those that have not been passed.
    ahead: Peekable<IntoIter<u32>>,
    /// The first edge of the input that no face up to here has.
    at: u32,
    /// Ascending.
    changes: Vec<Change>,
    /// The half-edges of all groups' loops.
    pub half_edges: Vec<u32>,
    /// The edges that are no edges of the input, ascending.
    pub pieces: Vec<u32>,
    /// Their directions, from the smaller end to the larger.
    pub directions: Vec<Way>,
    /// Whether there may be soft edges.
    any_soft: bool,
    /// Edges that stay because of a piece.
    hard: Vec<u32>,
    /// Input edges that pieces between points of the input may be, and others, by their ends.
    input_edges: FxHashMap<[u32; 2], u32>,
    /// Of all pieces of all parts, the first one with the same ends.
    first_piece: Vec<u32>,
    /// The edge that each first piece is.
    edge_of_first: Vec<u32>,
}

impl<'a> Numbering<'a> {
    /// Numbers what is at the border or new. O(n), and hashing for pieces between points of the input.
    pub(super) fn new(parts: &Parts<'a>, cuts: &'a Cuts, n_vertices: usize) -> Self {
        let mut out = Self::unnumbered(parts, cuts, n_vertices);
        let (mut leaders, mut groups) = (parts.groups.leaders.iter().peekable(), parts.each_group());
        for (facet, seen) in out.stops() {
            if !parts.groups.is_member[facet as usize] {
                out.number_facet(facet, seen);
            } else if leaders.next_if_eq(&&facet).is_some() {
                out.pass(seen);
                groups.next().into_iter().for_each(|group| out.number_group(&group));
            }
        }
        out.pass(out.soup.edges.len() as u32);
        out
    }

    fn unnumbered(parts: &Parts<'a>, cuts: &'a Cuts, n_vertices: usize) -> Self {
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
        let border = parallel::select(is_border.len(), |edge| is_border[edge as usize]);
        let mut whole = parallel::zeros(soup.edges.len());
        border.iter().for_each(|&edge| whole[edge as usize] = NOT_SEEN);
        let [tails, heads] = [0, 1].map(|end| {
            let lengths = parts.fragments.iter().map(|part| part.pieces.len());
            let mut ends = parallel::zeros(lengths.clone().sum());
            let of_parts = parallel::cut(&mut ends, lengths).into_iter().zip(parts.fragments).collect();
            parallel::each(of_parts, |(ends, part): (&mut [u32], &Fragments)| {
                ends.iter_mut().zip(&part.pieces).for_each(|(to, piece)| *to = piece.ends[end]);
            });
            ends
        });
        let half_edges = HalfEdges::Listed { tails: &tails, heads: &heads };
        let first_piece = half_edges::first_of_edge(n_vertices, half_edges);
        let n_pieces = first_piece.iter().zip(0u32..).filter(|(first, piece)| *first == piece).count();
        Self {
            soup,
            cuts,
            whole,
            is_border,
            at: 0,
            // A piece is one edge at most; one at the border is left out where it was, and may be added elsewhere.
            changes: Vec::with_capacity(n_pieces + 2 * border.len()),
            ahead: border.into_iter().peekable(),
            half_edges: Vec::with_capacity(parts.sum(|part| part.half_edges.len())),
            pieces: Vec::with_capacity(n_pieces),
            directions: Vec::with_capacity(n_pieces),
            any_soft: soup.has_soft_edges(),
            hard: Vec::new(),
            input_edges,
            edge_of_first: vec![NOT_SEEN; first_piece.len()],
            first_piece,
        }
    }

    /// The facets with an edge at the border, ascending, and the first edge that no facet before each has.
    fn stops(&self) -> Vec<(u32, u32)> {
        let facets = &self.soup.facet_edges;
        if self.ahead.len() == 0 {
            return Vec::new();
        }
        let of_parts = parallel::map(parallel::n_threads(), |part| {
            let (mut stops, mut seen) = (Vec::new(), 0);
            let range = parallel::part_of(facets.len(), part);
            for (codes, facet) in facets.iter().skip(range.start).take(range.len()).zip(range.start as u32..)
            {
                if codes.iter().any(|&code| self.is_border[(code / 2) as usize]) {
                    stops.push((facet, seen));
                }
                seen = codes.iter().fold(seen, |seen, &code| seen.max(code / 2 + 1));
            }
            (stops, seen)
        });
        let mut all = Vec::new();
        let mut before = 0;
        for (stops, seen) in of_parts {
            all.extend(stops.into_iter().map(|(facet, seen)| (facet, before.max(seen))));
            before = before.max(seen);
        }
        all
    }

    /// Comes to an edge of the input. Those at the border that are passed are left out where they were.
    fn pass(&mut self, edge: u32) {
        self.at = edge;
        while let Some(at) = self.ahead.next_if(|&at| at < edge) {
            let shift = self.shift().wrapping_sub(1);
            self.changes.push(Change { at, added: None, shift });
        }
    }

    fn shift(&self) -> u32 {
        self.changes.last().map_or(0, |change| change.shift)
    }

    fn add(&mut self, ends: [u32; 2]) -> u32 {
        let shift = self.shift();
        self.changes.push(Change { at: self.at, added: Some(ends), shift: shift.wrapping_add(1) });
        self.at.wrapping_add(shift)
    }

    /// A facet in no group: numbers its edges at the border. No facet before has the edge `seen` or one behind.
    fn number_facet(&mut self, facet: u32, mut seen: u32) {
        for &code in &self.soup.facet_edges[facet as usize] {
            if self.is_border[(code / 2) as usize] {
                self.pass(seen);
                self.whole_edge(code / 2);
            }
            seen = seen.max(code / 2 + 1);
        }
    }

    fn number_group(&mut self, group: &Group) {
        let loops = group.faces().flat_map(|face| group.loops(face));
        for h in loops.flat_map(|l| group.half_edges(l)).map(|i| group.part.half_edges[i]) {
            let half_edge = match h & WHOLE {
                0 => self.half_edge(group, h / 2) ^ (h % 2),
                _ => 2 * self.whole_edge((h ^ WHOLE) / 2) + h % 2,
            };
            self.half_edges.push(half_edge);
        }
    }

    /// The edge that one at the border is, if it is not split.
    fn whole_edge(&mut self, edge: u32) -> u32 {
        if self.whole[edge as usize] == NOT_SEEN {
            self.whole[edge as usize] = self.add(self.soup.edges[edge as usize]);
        }
        self.whole[edge as usize]
    }

    /// The half-edge of a piece in its direction. A piece with the ends of an unsplit input edge is that edge.
    fn half_edge(&mut self, group: &Group, piece: u32) -> u32 {
        let first = self.first_piece[(group.first_piece + piece) as usize] as usize;
        let piece = &group.part.pieces[piece as usize];
        if self.edge_of_first[first] == NOT_SEEN {
            self.edge_of_first[first] = self.edge_of_piece(piece);
        }
        let id = self.edge_of_first[first];
        if self.any_soft && !piece.soft {
            self.hard.push(id);
        }
        2 * id + u32::from(piece.ends[0] > piece.ends[1])
    }

    fn edge_of_piece(&mut self, piece: &Piece) -> u32 {
        let ends = ends_of(piece);
        let is_whole = |&edge: &u32| self.cuts.inner.of(edge).is_empty();
        if (ends[1] as usize) < self.soup.geometry.n_points()
            && let Some(edge) = self.input_edges.get(&ends).copied().filter(is_whole)
        {
            return self.whole_edge(edge);
        }
        let id = self.add(ends);
        self.pieces.push(id);
        let is_ascending = ends == piece.ends;
        self.directions.push(if is_ascending { piece.direction } else { piece.direction.opposite() });
        id
    }

    /// The half-edge that a directed edge of the input is, once the edges are written.
    pub(super) fn whole_half_edge(&self, code: u32) -> u32 {
        2 * self.whole[(code / 2) as usize] + code % 2
    }

    /// Writes the ends of all edges, with new numbers for the vertices, and notes what became of the input's. O(n).
    pub(super) fn edges(&mut self, new_vertex: impl Fn(u32) -> u32 + Sync + Send) -> Vec<[u32; 2]> {
        let (old, changes) = (&self.soup.edges, &self.changes);
        let n = old.len();
        // The first part gets room for the others.
        let n_edges = (n as u32).wrapping_add(self.shift()) as usize;
        let mut parts = parallel::map_parts(&mut self.whole, |range, whole| {
            let changes_before = |edge: usize| changes.partition_point(|change| (change.at as usize) < edge);
            let begin = changes_before(range.start);
            let end = if range.end == n { changes.len() } else { changes_before(range.end) };
            let mut out =
                Vec::with_capacity(if range.start == 0 { n_edges } else { range.len() + end - begin });
            let mut shift = begin.checked_sub(1).map_or(0, |last| changes[last].shift);
            let mut from = range.start;
            let mut keep = |out: &mut Vec<[u32; 2]>, kept: Range<usize>, shift: u32| {
                out.extend(old[kept.clone()].iter().map(|ends| ends.map(&new_vertex)));
                let whole = &mut whole[kept.start - range.start..kept.end - range.start];
                whole
                    .iter_mut()
                    .zip(kept.start as u32..)
                    .for_each(|(to, edge)| *to = edge.wrapping_add(shift));
            };
            for change in &changes[begin..end] {
                let at = change.at as usize;
                keep(&mut out, from..at, shift);
                out.extend(change.added.map(|ends| ends.map(&new_vertex)));
                from = at + usize::from(change.added.is_none());
                shift = change.shift;
            }
            keep(&mut out, from..range.end, shift);
            out
        })
        .into_iter();
        let mut edges = parts.next().expect("there is a thread");
        parts.for_each(|part| edges.extend_from_slice(&part));
        edges
    }

    /// Whether each of n edges is only a diagonal inside a polygon, once they are written; nothing when none can be.
    pub(super) fn soft(&self, n: usize) -> Vec<bool> {
        if !self.any_soft {
            return Vec::new();
        }
        let mut soft = vec![true; n];
        let stays = |edge: &u32| !self.soup.is_soft(*edge);
        let whole = (0..self.whole.len() as u32).filter(stays).map(|edge| self.whole[edge as usize]);
        for edge in whole.filter(|&edge| edge != NOT_SEEN).chain(self.hard.iter().copied()) {
            soft[edge as usize] = false;
        }
        soft
    }
}

/// The ends of a piece, the smaller first.
fn ends_of(piece: &Piece) -> [u32; 2] {
    let [a, b] = piece.ends;
    [a.min(b), a.max(b)]
}
