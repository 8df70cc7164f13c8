//! Points that are nearly one.

use super::Input;
use rustc_hash::FxHashMap;

/// The side of a cell over the distance up to which its points are near: a point near a side is looked for in the cell
/// beyond too.
const CELL: i64 = 8;

/// Pairs of points within the tolerance, ascending: of facets in a pair, or of one facet. Corners of facets of one chart,
/// or that share a clean point, are farther apart.
///
/// Points are put in cells, once for each power of two that is about the tolerance of some of them: expected time is linear
/// in the points, unless many are near each other.
pub(super) fn points(input: &Input) -> Vec<[u32; 2]> {
    let geometry = &input.soup.geometry;
    let points = in_question(input);
    let limit = |p: u32| input.soup.tolerances[p as usize].points().floor() as i64;
    let is_near = |p: u32, q: u32| {
        let (a, b) = (geometry.nearest_grid_point(p), geometry.nearest_grid_point(q));
        let limit = limit(p).max(limit(q));
        (0..3).all(|k| (a[k] - b[k]).abs() <= limit)
    };
    let mut classes: Vec<u32> = points.iter().map(|&p| class(limit(p))).collect();
    classes.sort_unstable();
    classes.dedup();
    let mut near = Vec::new();
    for of in classes {
        // Points of a class, and those that are more exact.
        let cells = Cells { side: CELL << of, reach: 1 << of };
        let mut last: FxHashMap<[i64; 3], u32> = FxHashMap::default();
        let members: Vec<u32> = points.iter().copied().filter(|&p| class(limit(p)) <= of).collect();
        let mut before = vec![u32::MAX; members.len()];
        for (&p, i) in members.iter().zip(0u32..) {
            let at = geometry.nearest_grid_point(p);
            cells.around(at, |cell| {
                let mut next = last.get(&cell).copied().unwrap_or(u32::MAX);
                while next != u32::MAX {
                    let q = members[next as usize];
                    if class(limit(p).max(limit(q))) == of && is_near(p, q) {
                        near.push([q.min(p), q.max(p)]);
                    }
                    next = before[next as usize];
                }
            });
            before[i as usize] = last.insert(cells.of(at), i).unwrap_or(u32::MAX);
        }
    }
    near.sort_unstable();
    near
}

/// The corners of facets that are in a pair, or that may have two that are near.
fn in_question(input: &Input) -> Vec<u32> {
    let mut seen = vec![false; input.soup.geometry.n_points()];
    let mut points = Vec::new();
    let mut see = |facet: u32| {
        let new = input.corners(facet).filter(|&p| !std::mem::replace(&mut seen[p as usize], true));
        points.extend(new);
    };
    input.pairs.as_flattened().iter().for_each(|&facet| see(facet));
    (0..input.soup.n_facets() as u32).filter(|&f| !input.has_corners_apart(f)).for_each(see);
    points
}

/// The exponent of the power of two that is not below a distance.
fn class(distance: i64) -> u32 {
    i64::BITS - (distance - 1).max(0).leading_zeros()
}

/// A grid of cells.
struct Cells {
    side: i64,
    reach: i64,
}

impl Cells {
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
