//! Vertices by definition: different definitions of one point become one vertex, by exact equality. Many are unified at
//! once, by all threads.

use crate::counting::offsets;
use crate::grid_points::PointTable;
use crate::kernel::{Geometry, Vertex};
use crate::parallel;
use crate::positions::{each_position, position_of, sorted_by_position};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Not known.
const NONE: u32 = u32::MAX;

/// All vertices found so far: pairwise distinct points.
#[derive(Debug)]
pub(crate) struct Vertices {
    pub list: Vec<Vertex>,
    /// Points of the input by their coordinates.
    grid_points: PointTable,
    /// The others, as they came together: the hash of each one's position above its number, ascending.
    others: Vec<Vec<u64>>,
}

impl Vertices {
    /// The points of the input, in their order. Grid points are looked up by their integer coordinates and need no
    /// other keys.
    pub(crate) fn new(geometry: &Geometry, grid_points: PointTable) -> Self {
        let n = geometry.n_points();
        let mut list = Vec::with_capacity(n + n / 8);
        parallel::extend_light(&mut list, n, |p| geometry.point_vertex(p as u32));
        let mut others = Vec::new();
        if !geometry.is_on_grid() {
            let rational = parallel::select(n, |p| geometry.grid_point(p).is_none());
            others.push(sorted_vertices(&list, &rational));
        }
        Self { list, grid_points, others }
    }

    /// As `unify`, for the vertices of some chunks: where those of each begin among all, and the numbers.
    pub(crate) fn unify_chunks(
        &mut self,
        found: Vec<Vec<Vertex>>,
        geometry: &Geometry,
    ) -> (Vec<u32>, Vec<u32>) {
        let begins = offsets(found.iter().map(|chunk| chunk.len() as u32));
        (begins, self.unify(&parallel::joined(found), geometry))
    }

    /// The number of each of some vertices, known or new; new ones are numbered in the order in which they come first.
    /// O(n) expected.
    fn unify(&mut self, found: &[Vertex], geometry: &Geometry) -> Vec<u32> {
        let known = parallel::map_light(found.len(), |i| self.on_grid(&found[i], geometry).unwrap_or(NONE));
        let unknown = parallel::select(found.len(), |i| known[i as usize] == NONE);
        let sorted = sorted_vertices(found, &unknown);
        let n_known = self.list.len() as u32;
        // A vertex that is not known is, counted behind the known ones, the first that is the same point.
        let first: Vec<AtomicU32> = known.into_iter().map(AtomicU32::new).collect();
        let set = |i: u32, number| first[i as usize].store(number, Relaxed);
        each_position(&sorted, |same| self.unify_position(same, found, geometry, set));
        let is_first = |i: u32| first[i as usize].load(Relaxed).checked_sub(n_known) == Some(i);
        let firsts = parallel::select(found.len(), is_first);
        let number = parallel::atomic_zeros(found.len());
        parallel::for_each(firsts.len(), |k| number[firsts[k] as usize].store(n_known + k as u32, Relaxed));
        let number_of = |i: usize| match first[i].load(Relaxed).checked_sub(n_known) {
            Some(first) => number[first as usize].load(Relaxed),
            None => first[i].load(Relaxed),
        };
        // Contacts come first; where facets are cut more are found, but fewer.
        self.list.reserve(firsts.len() + firsts.len() / 2);
        parallel::extend_light(&mut self.list, firsts.len(), |k| found[firsts[k] as usize]);
        let keyed = parallel::select(sorted.len(), |k| is_first(sorted[k as usize] as u32));
        self.others.push(parallel::map_light(keyed.len(), |k| {
            let entry = sorted[keyed[k] as usize];
            position_of(entry) | u64::from(number[entry as u32 as usize].load(Relaxed))
        }));
        parallel::map_light(found.len(), number_of)
    }

    /// The point of the input that a vertex is, if it is one on the grid.
    fn on_grid(&self, vertex: &Vertex, geometry: &Geometry) -> Option<u32> {
        let at = vertex.at.map(|x| x as i64);
        let p = self.grid_points.find(at, |p| geometry.nearest_grid_point(p))?;
        geometry.coincide(&self.list[p as usize], vertex).then_some(p)
    }

    /// For some with the same half of a hash: calls `set` with each, and with its number among the known ones or, behind them, that
    /// of the first one that is the same point. They are compared with each other, but few that differ have the same.
    fn unify_position(&self, same: &[u64], found: &[Vertex], geometry: &Geometry, set: impl Fn(u32, u32)) {
        let position = position_of(same[0]);
        let here = |list: &'_ Vec<u64>| {
            let begin = list.partition_point(|&entry| entry < position);
            let entries = list[begin..].iter().take_while(|&&entry| position_of(entry) == position);
            entries.map(|&entry| entry as u32).collect::<Vec<u32>>()
        };
        let known: Vec<u32> = self.others.iter().flat_map(here).collect();
        let n_known = self.list.len() as u32;
        let mut distinct: Vec<u32> = Vec::new();
        for i in same.iter().map(|&entry| entry as u32) {
            let vertex = &found[i as usize];
            let is_same = |other: &Vertex| geometry.coincide(other, vertex);
            let of_known = known.iter().copied().find(|&v| is_same(&self.list[v as usize]));
            let of_new = || distinct.iter().copied().find(|&j| is_same(&found[j as usize]));
            let number = of_known.or_else(|| of_new().map(|j| n_known + j));
            if number.is_none() {
                distinct.push(i);
            }
            set(i, number.unwrap_or(n_known + i));
        }
    }
}

/// Some vertices of a list by their positions.
fn sorted_vertices(list: &[Vertex], some: &[u32]) -> Vec<u64> {
    sorted_by_position(some.len(), |k| some[k as usize], |v| list[v as usize].at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Sign;
    use crate::soup::{Placed, Soup};
    use lar_core::{Points, Surface};
    use proptest::prelude::*;
    use std::num::NonZeroUsize;

    /// Where edges of a soup pass through its facets: on a coarse lattice many are one point, or a point of the input.
    fn crossings(soup: &Soup) -> Vec<Vertex> {
        let geometry = &soup.geometry;
        let of_facet = |facet: u32| {
            let is_across = move |ends: [u32; 2]| {
                ends.map(|p| geometry.side_of_point(p, facet)).iter().all(|s| *s != Sign::Zero)
                    && geometry.side_of_point(ends[0], facet) != geometry.side_of_point(ends[1], facet)
            };
            let across = soup.edges.iter().copied().filter(move |&ends| is_across(ends));
            across.map(move |ends| geometry.vertex_on_edge(geometry.edge_definition(ends, facet)))
        };
        (0..soup.n_facets() as u32).flat_map(of_facet).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn vertices_are_unified_as_one_by_one(
            corners in prop::collection::vec(prop::array::uniform3(0i8..4), 12..60),
            scale in prop::sample::select(vec![1.0, 0.3]),
            at_once in prop::sample::select(vec![1, 2, 7, 50, usize::MAX]),
        ) {
            let points: Vec<[f64; 3]> = corners.iter().map(|p| p.map(|x| scale * f64::from(x))).collect();
            let mut surface = Surface::new("soup", Points::from_xyz(&points));
            for corner in (0..points.len() as u32 - 2).step_by(3) {
                surface.push_face([&[corner, corner + 1, corner + 2][..]], 1);
            }
            let surfaces = [surface];
            let soup = || Soup::new(&surfaces, Placed::snapped(&surfaces, |_, _| 0.0).expect("finite points"));
            let geometry = soup().geometry;
            let found = crossings(&soup());
            let mut list: Vec<Vertex> = (0..geometry.n_points() as u32).map(|p| geometry.point_vertex(p)).collect();
            let number = |vertex: &Vertex| {
                let known = list.iter().position(|known| geometry.coincide(known, vertex));
                list.extend(known.is_none().then_some(*vertex));
                known.unwrap_or(list.len() - 1) as u32
            };
            let expected: Vec<u32> = found.iter().map(number).collect();
            for threads in 1..=3 {
                let unified = || {
                    let mut vertices = Vertices::new(&geometry, soup().point_ids);
                    // Later ones may be one with those that came before.
                    let some = found.chunks(at_once).map(|some| vertices.unify(some, &geometry));
                    let numbers = some.collect::<Vec<_>>().concat();
                    // Known ones behind more others than there are numbers.
                    let point = geometry.point_vertex(0);
                    for (vertex, &number) in found.iter().zip(&numbers).take(9) {
                        let mut some = vec![point; vertices.list.len() + 1];
                        some.push(*vertex);
                        assert_eq!(vertices.unify(&some, &geometry).pop(), Some(number));
                    }
                    (numbers, vertices.list)
                };
                let (numbers, unified) =
                    parallel::Team::new(NonZeroUsize::new(threads)).work(usize::MAX, unified).expect("threads");
                prop_assert_eq!(&numbers, &expected);
                prop_assert!(unified.iter().map(|v| v.def).eq(list.iter().map(|v| v.def)));
            }
        }
    }
}
