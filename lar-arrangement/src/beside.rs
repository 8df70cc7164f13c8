//! Stage 2a: facets that lie side by side, as extreme coordinates tell.
//!
//! Where the greatest coordinate of one facet is the least of another, what they have in common lies where both have it:
//! between the corners that do. Of these the next axis may leave fewer. In the end there is nothing, or a shared corner,
//! or a shared edge, and none of them is a contact. In grids of boxes most pairs of facets are such.
//!
//! ```text
//!     ┌───┐      along x      │      along y
//!     │ F │    corners at ┆   │    corners at ┆
//!     └───┼───┐           ●   │               ● the only one of both
//!         │ G │           ●   │
//!         └───┘           ●   │
//! ```

use crate::boxes::Aabb;
use crate::kernel::Spot;
use crate::polygon::MAX_CORNERS;

/// There is a bit for each corner.
const _: () = assert!(MAX_CORNERS <= u64::BITS as usize);

/// The corners of a facet, at least three, and the box around them.
pub(crate) struct Corners {
    pub spots: Vec<Spot>,
    pub hull: Aabb,
    /// Whether no coordinate is rounded: of rounded ones only the order is known, and not whether they are equal.
    are_exact: bool,
}

impl Default for Corners {
    fn default() -> Self {
        Self { spots: Vec::new(), hull: Aabb::EMPTY, are_exact: true }
    }
}

impl Corners {
    /// Reads others. O(corners).
    #[inline(always)]
    pub(crate) fn read<const N: usize>(&mut self, spots: [Spot; N]) {
        self.spots.clear();
        self.spots.extend_from_slice(&spots);
        self.look(&spots);
    }

    /// Reads any number.
    pub(crate) fn read_all(&mut self, spots: impl Iterator<Item = Spot>) {
        let mut all = std::mem::take(&mut self.spots);
        all.clear();
        all.extend(spots);
        self.look(&all);
        self.spots = all;
    }

    #[inline(always)]
    fn look(&mut self, spots: &[Spot]) {
        self.hull = hull(spots);
        self.are_exact = spots.iter().fold(true, |exact, spot| exact & (spot.rounding == 0.0));
    }

    /// Whether they lie in a plane along two of the axes.
    pub(crate) fn are_flat(&self) -> bool {
        (0..3).fold(false, |flat, k| flat | (self.hull.lo[k] == self.hull.hi[k]))
    }

    /// Whether two facets are known to have nothing in common but a shared corner or a shared edge. O(corners): every round
    /// but the last leaves less of one of two convex hulls, a face of it.
    pub(crate) fn are_beside(&self, other: &Self) -> bool {
        if !self.hull.meets(&other.hull) {
            return true;
        }
        if !(self.are_exact && other.are_exact) {
            return false;
        }
        let hulls = [self.hull, other.hull];
        match (self.spots.as_array::<3>(), other.spots.as_array::<3>()) {
            (Some(f), Some(g)) => end_beside([f, g], hulls),
            _ => end_beside([&self.spots, &other.spots], hulls),
        }
    }
}

#[inline(always)]
fn hull(spots: &[Spot]) -> Aabb {
    spots.iter().fold(Aabb::EMPTY, |hull, spot| hull.joined(&Aabb { lo: spot.at, hi: spot.at }))
}

/// The same for facets whose boxes meet, without rounded coordinates. Compiled once for triangles and once for all.
#[inline(always)]
fn end_beside(facets: [&[Spot]; 2], [mut of_f, mut of_g]: [Aabb; 2]) -> bool {
    let [mut f, mut g] =
        facets.map(|spots| Ends { spots, left: u64::MAX >> (u64::BITS as usize - spots.len()) });
    loop {
        let before = [f.left, g.left];
        for k in 0..3 {
            for (low, high) in [(of_f.hi[k], of_g.lo[k]), (of_g.hi[k], of_f.lo[k])] {
                if low == high {
                    f.keep(k, low);
                    g.keep(k, low);
                }
            }
        }
        if [f.left, g.left] == before {
            return false;
        }
        let is_nothing_else = match [f.left.count_ones(), g.left.count_ones()] {
            [0, _] | [_, 0] | [1, 1] => true,
            [1, _] | [2, 2] => f.are_among(&g),
            [_, 1] => g.are_among(&f),
            _ => false,
        };
        if is_nothing_else {
            return true;
        }
        (of_f, of_g) = (f.hull(), g.hull());
        if !of_f.meets(&of_g) {
            return true;
        }
    }
}

/// The corners of a facet between which it may meet another.
struct Ends<'a> {
    spots: &'a [Spot],
    /// As bits.
    left: u64,
}

impl Ends<'_> {
    /// Only those with a coordinate.
    #[inline(always)]
    fn keep(&mut self, k: usize, at: f64) {
        let is_there = |(i, spot): (usize, &Spot)| u64::from(spot.at[k] == at) << i;
        self.left &= self.spots.iter().enumerate().map(is_there).fold(0, |all, one| all | one);
    }

    /// Whether others have all that are left.
    #[inline(always)]
    fn are_among(&self, other: &Self) -> bool {
        let is_other = |p: u32| {
            other.spots.iter().enumerate().fold(false, |is, (j, spot)| is | ((spot.p == p) & other.has(j)))
        };
        self.spots.iter().enumerate().fold(true, |are, (i, spot)| are & (!self.has(i) | is_other(spot.p)))
    }

    fn has(&self, i: usize) -> bool {
        self.left >> i & 1 == 1
    }

    #[inline(always)]
    fn hull(&self) -> Aabb {
        let left = self.spots.iter().enumerate().filter(|(i, _)| self.has(*i));
        left.fold(Aabb::EMPTY, |hull, (_, spot)| hull.joined(&Aabb { lo: spot.at, hi: spot.at }))
    }
}
