//! Points that are nearly one.

use super::Input;
use crate::parallel;
use rustc_hash::FxHashMap;

/// The side of a cell over the distance up to which its points are near: a point near a side is looked for in the cell
/// beyond too.
const CELL: i64 = 8;

/// Pairs of points within the tolerance, ascending: of facets in a pair, or of one facet. Corners of facets of one chart,
/// or that share a clean point, are farther apart.
pub(super) fn points(input: &Input) -> Vec<[u32; 2]> {
    let at = |p: u32| input.soup.geometry.nearest_grid_point(p);
    let limit = |p: u32| input.soup.tolerances[p as usize].points().floor() as i64;
    pairs(&in_question(input), at, limit)
}

/// Pairs of points of which no coordinate differs by more than the larger of their limits, ascending.
///
/// Points are put in cells, once for each power of two that is about the limit of some of them, without those of larger
/// limits: expected time is linear in the points, unless many are near each other.
fn pairs(points: &[u32], at: impl Fn(u32) -> [i64; 3], limit: impl Fn(u32) -> i64) -> Vec<[u32; 2]> {
    let mut classes: Vec<u32> = points.iter().map(|&p| class(limit(p))).collect();
    classes.sort_unstable();
    classes.dedup();
    let mut near = Vec::new();
    for of in classes {
        let is_near = |p: u32, q: u32| {
            let ((a, b), limit) = ((at(p), at(q)), limit(p).max(limit(q)));
            class(limit) == of && (0..3).all(|k| (a[k] - b[k]).abs() <= limit)
        };
        let cells = CellGrid { side: CELL << of, reach: 1 << of };
        let members: Vec<u32> = points.iter().copied().filter(|&p| class(limit(p)) <= of).collect();
        // The last member in a cell, and the one before each.
        let mut last: FxHashMap<[i64; 3], u32> = FxHashMap::default();
        last.reserve(members.len());
        let mut before: Vec<Option<u32>> = Vec::with_capacity(members.len());
        for (&p, i) in members.iter().zip(0..) {
            cells.around(at(p), |cell| {
                let mut next = last.get(&cell).copied();
                while let Some(j) = next {
                    let q = members[j as usize];
                    if is_near(p, q) {
                        near.push([q.min(p), q.max(p)]);
                    }
                    next = before[j as usize];
                }
            });
            before.push(last.insert(cells.of(at(p)), i));
        }
    }
    near.sort_unstable();
    near
}

/// The corners of facets that are in a pair, without most that are near none of the other, and of facets that may have two
/// that are near.
fn in_question(input: &Input) -> Vec<u32> {
    let n_points = input.soup.geometry.n_points();
    let mut seen = vec![false; n_points];
    let mut points = Vec::new();
    let mut see = |facet: u32| {
        let new = input.corners(facet).filter(|&p| !std::mem::replace(&mut seen[p as usize], true));
        points.extend(new);
    };
    if input.pairs.len() < n_points {
        let may_be_near = parallel::select(input.pairs.len(), |pair| {
            let [f, g] = input.pairs[pair as usize];
            !have_corners_apart(input, f, g)
        });
        may_be_near.iter().flat_map(|&pair| input.pairs[pair as usize]).for_each(&mut see);
    } else {
        // Each point, and each facet, is in many pairs.
        let mut is_seen = vec![false; input.soup.n_facets()];
        let facets = input.pairs.as_flattened().iter().copied();
        facets.filter(|&f| !std::mem::replace(&mut is_seen[f as usize], true)).for_each(&mut see);
    }
    input.charts.without.iter().copied().filter(|&f| !input.has_corners_apart(f)).for_each(see);
    points
}

/// Whether two facets are triangles without corners that are near and not the same.
fn have_corners_apart(input: &Input, f: u32, g: u32) -> bool {
    let soup = input.soup;
    if ![f, g].iter().all(|&facet| soup.is_triangle(facet)) {
        return false;
    }
    let corners = |facet: u32| soup.geometry.base(facet).map(|p| (p, soup.geometry.position(p)));
    let limit = |(p, _): (u32, [f64; 3])| soup.tolerances[p as usize].points();
    let are_near = |(p, a): (u32, [f64; 3]), (q, b): (u32, [f64; 3]), limit: f64| {
        p != q && (0..3).all(|k| (a[k] - b[k]).abs() <= limit)
    };
    let (of_f, of_g) = (corners(f), corners(g));
    // Points may be off their nearest ones on the grid by half a step each.
    let limit = of_f.into_iter().chain(of_g).map(limit).fold(0.0, f64::max) + 1.0;
    !of_f.iter().any(|&a| of_g.iter().any(|&b| are_near(a, b, limit)))
}

/// The exponent of the power of two that is not below a distance.
fn class(distance: i64) -> u32 {
    i64::BITS - (distance - 1).max(0).leading_zeros()
}

/// A grid of cells.
struct CellGrid {
    side: i64,
    /// At most as long as a side.
    reach: i64,
}

impl CellGrid {
    /// The cell of a point. Places that are round numbers lie in the middle of cells.
    fn of(&self, at: [i64; 3]) -> [i64; 3] {
        at.map(|x| (x + self.side / 2).div_euclid(self.side))
    }

    /// Calls `visit` with the cells, at most eight, within reach of a point.
    fn around(&self, at: [i64; 3], mut visit: impl FnMut([i64; 3])) {
        let (low, high) = (self.of(at.map(|x| x - self.reach)), self.of(at.map(|x| x + self.reach)));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    visit([x, y, z]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn all_near_pairs_are_found(
            points in prop::collection::vec((prop::array::uniform3(-40i64..40), 0usize..4), 0..60),
            spread in 1i64..5,
        ) {
            let at = |p: u32| points[p as usize].0.map(|x| x * spread);
            let limit = |p: u32| [0, 1, 5, 48][points[p as usize].1];
            let all: Vec<u32> = (0..points.len() as u32).collect();
            let is_near = |p: u32, q: u32| {
                (0..3).all(|k| (at(p)[k] - at(q)[k]).abs() <= limit(p).max(limit(q)))
            };
            let expected: Vec<[u32; 2]> = all
                .iter()
                .flat_map(|&p| (p + 1..points.len() as u32).map(move |q| [p, q]))
                .filter(|&[p, q]| is_near(p, q))
                .collect();
            prop_assert_eq!(pairs(&all, at, limit), expected);
        }
    }
}
