//! Triangles of the input with the same corners are one facet with several parents.

use super::{Parent, Parents, Soup};
use crate::half_edges::{self, MANY, NONE};
use crate::parallel;
use crate::split::offsets;
use lar_core::Cells;
use rustc_hash::FxHashMap;

/// Facets a chunk of work.
const FACETS_A_CHUNK: usize = 1 << 12;

/// A facet, the first one with the same corners, and whether both turn the same way.
pub(super) struct Double {
    facet: u32,
    first: u32,
    same_way: bool,
}

/// The triangles of the input that came before, ascending. O(n) expected: only those can be such that share two edges
/// with one facet, or an edge with more than one.
pub(super) fn of(soup: &Soup) -> Vec<Double> {
    let (n_chunks, range) = parallel::chunks(soup.n_facets(), FACETS_A_CHUNK);
    let candidates = parallel::map(n_chunks, |chunk| {
        let facets = range(chunk).map(|f| f as u32);
        facets.filter(|&f| may_be_double(soup, f)).collect::<Vec<_>>()
    });
    let mut first_with: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut doubles = Vec::new();
    for facet in candidates.into_iter().flatten() {
        let Some(corners) = input_triangle(soup, facet) else { continue };
        let mut key = corners;
        key.sort_unstable();
        let first = *first_with.entry(key).or_insert(facet);
        if first != facet {
            let same_way = turns_up(corners) == turns_up(soup.geometry.base(first));
            doubles.push(Double { facet, first, same_way });
        }
    }
    doubles
}

fn input_triangle(soup: &Soup, facet: u32) -> Option<[u32; 3]> {
    let f = facet as usize;
    let polygon = Some(&soup.facet_polygon[f]);
    let is_alone =
        (f == 0 || soup.facet_polygon.get(f - 1) != polygon) && soup.facet_polygon.get(f + 1) != polygon;
    (is_alone && soup.is_triangle(facet)).then(|| soup.geometry.base(facet))
}

fn may_be_double(soup: &Soup, facet: u32) -> bool {
    let &[a, b, _] = &soup.facet_edges[facet as usize] else { return false };
    let users = [a, b].map(|code| soup.facets_of_edge[(code / 2) as usize]);
    let [at_a, at_b] = [users[0][(1 - a % 2) as usize], users[1][(1 - b % 2) as usize]];
    users.as_flattened().contains(&MANY) || at_a != NONE && at_a == at_b
}

/// Whether the corners turn from the smallest to its smaller neighbour.
fn turns_up([a, b, c]: [u32; 3]) -> bool {
    if a < b && a < c {
        b < c
    } else if b < c {
        c < a
    } else {
        a < b
    }
}

/// The soup without doubles, whose parents go to the first facet with the same corners.
pub(super) fn dropped(mut soup: Soup, doubles: &[Double]) -> Soup {
    let n_polygons = soup.polygon_flat.len();
    // The polygon that takes a polygon's parents, and whether it turns the same way.
    let mut taker: Vec<(u32, bool)> = (0..n_polygons as u32).map(|p| (p, true)).collect();
    let mut is_double = vec![false; soup.n_facets()];
    for double in doubles {
        is_double[double.facet as usize] = true;
        let [polygon, first] = [double.facet, double.first].map(|f| soup.facet_polygon[f as usize]);
        taker[polygon as usize] = (first, double.same_way);
    }
    let stays: Vec<bool> = taker.iter().zip(0..).map(|(&(taker, _), p)| taker == p).collect();
    let mut new_polygon = offsets(n_polygons, (0..n_polygons as u32).filter(|&p| stays[p as usize]));
    new_polygon.truncate(n_polygons);
    let mut parents: Vec<(u32, Parent)> = Vec::with_capacity(soup.parents.len());
    for (polygon, &(taker, same_way)) in (0..n_polygons as u32).zip(&taker) {
        let sign = if same_way { 1 } else { -1 };
        let of_polygon = soup.polygon_parents(polygon).iter();
        parents.extend(of_polygon.map(|p| (new_polygon[taker as usize], p.turned(sign))));
    }
    soup.polygon_flat = (0..n_polygons).filter(|&p| stays[p]).map(|p| soup.polygon_flat[p]).collect();
    let mut is_staying = stays.iter();
    soup.polygon_plane.retain(|_| *is_staying.next().expect("a plane a polygon, or none at all"));
    soup.parents = Parents::sorted(soup.polygon_flat.len(), parents);
    let mut kept = Cells::with_capacity(soup.n_facets(), soup.facet_edges.indices().len());
    let staying = soup.facet_edges.iter().zip(&is_double).filter(|(_, is_double)| !**is_double);
    staying.for_each(|(edges, _)| kept.push(edges));
    let polygons = soup.facet_polygon.iter().zip(&is_double).filter(|(_, is_double)| !**is_double);
    soup.facet_polygon = polygons.map(|(&p, _)| new_polygon[p as usize]).collect();
    soup.facet_edges = kept;
    soup.geometry.retain_facets(|f| !is_double[f as usize]);
    soup.facets_of_edge = half_edges::facets_of_edges(soup.edges.len(), &soup.facet_edges);
    soup
}
