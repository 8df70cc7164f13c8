//! Stage 2c: every input edge is split once, globally, at all points found on it; both its facets see the same
//! pieces. Also the lists of what lies inside each facet.

use crate::crossing::{Contacts, Segment};
use crate::kernel::{Along, Sign, Vertex};
use crate::marks::Marks;
use crate::parallel;
use crate::soup::Soup;
use crate::vertices::Vertices;
use std::mem::take;

/// The contacts of all facets, by edge and by facet.
#[derive(Debug)]
pub(crate) struct Cuts {
    /// Points inside the edges, from the first end to the second.
    pub inner: Sparse<u32>,
    /// By facet.
    segments: Sparse<Segment>,
    touches: Sparse<u32>,
}

/// Lists for some of many things.
#[derive(Debug)]
pub(crate) struct Sparse<T> {
    /// What has a list, ascending.
    keys: Vec<u32>,
    /// The same.
    marks: Marks,
    /// The list of `keys[i]` is `items[offsets[i]..offsets[i + 1]]`.
    offsets: Vec<u32>,
    items: Vec<T>,
}

impl<T> Sparse<T> {
    /// Lists for some of n things: of entries, these in the order of what they are of.
    fn new<E>(n: usize, sorted: Vec<E>, key: impl Fn(&E) -> u32, item: impl Fn(E) -> T) -> Self {
        let (mut keys, mut offsets) = (Vec::new(), Vec::new());
        for (key, at) in sorted.iter().map(key).zip(0..) {
            if keys.last() != Some(&key) {
                keys.push(key);
                offsets.push(at);
            }
        }
        offsets.push(sorted.len() as u32);
        let marks = Marks::among(n, &keys);
        Self { keys, marks, offsets, items: sorted.into_iter().map(item).collect() }
    }

    /// What has a list that is not empty, ascending.
    pub(crate) fn keys(&self) -> &[u32] {
        &self.keys
    }

    /// The list of one thing. O(1).
    pub(crate) fn of(&self, key: u32) -> &[T] {
        match self.marks.place(key) {
            Some(i) => &self.items[self.offsets[i] as usize..self.offsets[i + 1] as usize],
            None => &[],
        }
    }
}

impl Cuts {
    /// Unifies the vertices of the contacts and sorts everything.
    pub(crate) fn new(soup: &Soup, mut contacts: Vec<Contacts>, vertices: &mut Vertices) -> Self {
        let geometry = &soup.geometry;
        let n_points = geometry.n_points() as u32;
        let found = contacts.iter_mut().map(|chunk| take(&mut chunk.vertices)).collect();
        let (begins, ids) = vertices.unify_chunks(found, geometry);
        let chunks = || contacts.iter().zip(&begins);
        let id = |begin: u32, v: u32| if v < n_points { v } else { ids[(begin + (v - n_points)) as usize] };
        let inside_edges = || {
            let mut splits = Vec::with_capacity(chunks().map(|(chunk, _)| chunk.splits.len()).sum());
            for (chunk, &begin) in chunks() {
                splits.extend(chunk.splits.iter().map(|&(e, v)| (e, id(begin, v))));
            }
            splits.sort_unstable();
            splits.dedup();
            sorted_along_edges(soup, splits, &vertices.list)
        };
        let inside_facets = || {
            let mut segments = Vec::with_capacity(chunks().map(|(chunk, _)| chunk.segments.len()).sum());
            let mut touches: Vec<(u32, u32)> = Vec::new();
            for (chunk, &begin) in chunks() {
                let with_ids = |s: &Segment| Segment { ends: s.ends.map(|v| id(begin, v)), ..*s };
                segments.extend(chunk.segments.iter().map(with_ids));
                touches.extend(chunk.touches.iter().map(|&(f, v)| (f, id(begin, v))));
            }
            segments.sort_by_key(|s| (s.facet, s.other, s.ends));
            touches.sort_unstable();
            touches.dedup();
            let n = soup.n_facets();
            (Sparse::new(n, segments, |s| s.facet, |s| s), Sparse::new(n, touches, |t| t.0, |t| t.1))
        };
        let (inner, (segments, touches)) = parallel::join(inside_edges, inside_facets);
        Self { inner, segments, touches }
    }

    /// The facets with segments inside, ascending.
    pub(crate) fn cut_facets(&self) -> &[u32] {
        self.segments.keys()
    }

    /// The segments inside a facet.
    pub(crate) fn segments(&self, facet: u32) -> &[Segment] {
        self.segments.of(facet)
    }

    /// The points inside a facet where another only touches it.
    pub(crate) fn touches(&self, facet: u32) -> &[u32] {
        self.touches.of(facet)
    }
}

/// Where each of 0..n begins in a list of some of them once it is sorted.
pub(crate) fn offsets(n: usize, list: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut offsets = vec![0; n + 1];
    for x in list {
        offsets[x as usize + 1] += 1;
    }
    for i in 0..n {
        offsets[i + 1] += offsets[i];
    }
    offsets
}

/// The points inside edges, from the first end to the second.
fn sorted_along_edges(soup: &Soup, splits: Vec<(u32, u32)>, vertices: &[Vertex]) -> Sparse<u32> {
    let geometry = &soup.geometry;
    let vertex = |v: u32| &vertices[v as usize];
    let mut inner = Sparse::new(soup.edges.len(), splits, |s| s.0, |s| s.1);
    for (&edge, range) in inner.keys.iter().zip(inner.offsets.windows(2)) {
        let on_edge = &mut inner.items[range[0] as usize..range[1] as usize];
        if on_edge.len() > 1 {
            let (axis, sign) = geometry.axis_of(&geometry.direction(Along::Edge(soup.edges[edge as usize])));
            on_edge.sort_by(|&a, &b| geometry.cmp_coordinate(vertex(a), vertex(b), axis));
            if sign == Sign::Negative {
                on_edge.reverse();
            }
        }
    }
    inner
}
