//! Stage 1g: where facets come near each other that are in no common chart.
//!
//! Space is divided into voxels larger than most facets: their boxes reach from one voxel no farther than into its upper
//! neighbours. Each voxel is marked with the charts that all facets that begin there share, or as *crowded* when there is
//! none. Spread to where such facets reach, and back from there to where facets begin that reach into what is
//! crowded, the marks tell which facets meet nothing but their neighbours in their chart: the broad phase need not look at
//! them. Of two meshes that cross along a curve that is nearly everything.
//!
//! ```text
//!     first voxels       what they reach into     what reaches into ▒▒
//!    ┌──┬──┬──┬──┐        ┌──┬──┬──┬──┐            ┌──┬──┬──┬──┐
//!    │a │a │  │b │        │a │a │▒▒│b │            │  │▒▒│▒▒│  │
//!    └──┴──┴──┴──┘        └──┴──┴──┴──┘            └──┴──┴──┴──┘
//! ```

use crate::boxes::Aabb;
use crate::charts::{Charts, Shared};
use crate::parallel;
use crate::soup::Soup;
use wide::u8x16;

/// Fewer facets are not worth it.
const FEW: usize = 1 << 12;
/// Of so many facets most begin where it is not crowded, and need no closer look.
pub(crate) const MANY: usize = 1 << 15;
/// There are so many voxels a facet in a cube around the scene.
const VOXELS_A_FACET: f64 = 3.0;
/// And no more than so many: a place fits into eight bits.
const MOST_VOXELS: f64 = 255.0;
/// Facets that are too large for one voxel may begin in so many for each facet that there is, so that marking them is O(n).
const MOST_VOXELS_A_FACET: usize = 16;
/// A facet that is too large for one voxel.
const LARGE: u32 = u32::MAX;

/// The facets whose boxes, larger than the facets by what the voxels were made with, may meet that of one that shares no chart with it,
/// ascending; `None` when they are not worth to be told from the others. O(n).
pub(crate) fn facets(soup: &Soup, charts: &Charts, voxels: impl FnOnce() -> Voxels) -> Option<Vec<u32>> {
    let n = soup.n_facets();
    if n < FEW || 4 * charts.without.len() > n {
        return None;
    }
    let voxels = voxels();
    let mut marks: Vec<Shared> = parallel::zeros(voxels.size.iter().product());
    let looked_at: Vec<u32> =
        if n < MANY { (0..n as u32).collect() } else { voxels.in_crowds(soup, charts, &mut marks)? };
    let blocks = parallel::map_light(looked_at.len(), |i| voxels.block(soup, looked_at[i]));
    if n < MANY {
        voxels.bound(n, blocks.iter().filter(|block| voxels.first(**block) == LARGE))?;
    } else {
        voxels.clear(&mut marks, &blocks);
    }
    voxels.mark(&mut marks, &blocks, |i| charts.all(looked_at[i]));
    let is_met = |i: u32| {
        let mut is_met = false;
        voxels.each(blocks[i as usize], |voxel| is_met |= marks[voxel].is_nothing());
        is_met
    };
    let met = parallel::select(looked_at.len(), is_met);
    (4 * met.len() < 3 * n).then(|| met.into_iter().map(|i| looked_at[i as usize]).collect())
}

/// What something reaches into: along each axis k the first voxel, byte k, and the last, 255 less byte 4 + k.
type Block = [u8; 8];

/// The block around three.
fn around([a, b, c]: [Block; 3]) -> Block {
    let wide = |block: Block| {
        let mut bytes = [0; 16];
        bytes[..8].copy_from_slice(&block);
        u8x16::from(bytes)
    };
    let all = wide(a).min(wide(b)).min(wide(c));
    std::array::from_fn(|k| all.as_array()[k])
}

/// The first voxel of a block along each axis.
fn first(block: Block) -> [usize; 3] {
    [0, 1, 2].map(|k| usize::from(block[k]))
}

/// How many voxels wide a block is along each axis, less one.
fn width(block: Block) -> [usize; 3] {
    [0, 1, 2].map(|k| usize::from(!block[4 + k] - block[k]))
}

/// Voxels, and where the facets of a soup are among them.
pub(crate) struct Voxels {
    /// Number of voxels along each axis; the last has no upper neighbour and nothing begins there.
    size: [usize; 3],
    /// Around each point.
    blocks: Vec<Block>,
    /// Where each facet begins, when there are many.
    firsts: Vec<u32>,
}

impl Voxels {
    /// For boxes that are larger by `reach`, all of which are in one. O(n).
    pub(crate) fn new(soup: &Soup, all: &Aabb, reach: f64) -> Self {
        let extent: [f64; 3] = std::array::from_fn(|k| all.hi[k] - all.lo[k]);
        let longest = extent.iter().copied().fold(1.0, f64::max);
        let scale = (soup.n_facets() as f64 * VOXELS_A_FACET).cbrt().min(MOST_VOXELS) / longest;
        let end = extent.map(|x| (x * scale) as u8);
        // What is farther right is in no voxel farther left, whatever is rounded.
        let place = |x: f64, k: usize| (((x - all.lo[k]) * scale) as u8).min(end[k]);
        let blocks = parallel::map_light(soup.geometry.n_points(), |p| {
            let at = soup.geometry.position(p as u32);
            let mut block = [0; 8];
            for k in 0..3 {
                block[k] = place(at[k] - reach, k);
                block[4 + k] = !place(at[k] + reach, k);
            }
            block
        });
        let mut out = Self { size: end.map(|end| usize::from(end) + 2), blocks, firsts: Vec::new() };
        if soup.n_facets() >= MANY {
            out.firsts = parallel::map_light(soup.n_facets(), |f| out.first(out.block(soup, f as u32)));
        }
        out
    }

    /// The block of a facet.
    fn block(&self, soup: &Soup, facet: u32) -> Block {
        let of = |p: u32| self.blocks[p as usize];
        let of_base = around(soup.geometry.base(facet).map(of));
        if soup.are_triangles() {
            return of_base;
        }
        let edges = soup.facet_edges[facet as usize].iter();
        edges.fold(of_base, |block, &code| around([block, block, of(soup.directed(code)[0])]))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    /// Where a facet with a block begins.
    fn first(&self, block: Block) -> u32 {
        let width = width(block);
        if width[0] | width[1] | width[2] <= 1 { self.index(first(block)) as u32 } else { LARGE }
    }

    /// Nothing when the blocks of so many facets that are large have too many voxels.
    fn bound<'a>(&self, n: usize, large: impl Iterator<Item = &'a Block>) -> Option<()> {
        let mut left = MOST_VOXELS_A_FACET * n;
        for &block in large {
            left = left.checked_sub(width(block).iter().map(|width| width + 1).product())?;
        }
        Some(())
    }

    /// The facets that begin where it is crowded, or are too large for one voxel, and some of their marks; nothing when there
    /// are too many large ones. Marks are those of the facets that begin in a voxel, which is everywhere for large ones.
    /// Every thread looks at all facets for its part of the voxels.
    fn in_crowds(&self, soup: &Soup, charts: &Charts, marks: &mut [Shared]) -> Option<Vec<u32>> {
        let n = soup.n_facets();
        let firsts = &self.firsts;
        let large = parallel::select(n, |f| firsts[f as usize] == LARGE);
        let blocks: Vec<Block> = large.iter().map(|&facet| self.block(soup, facet)).collect();
        self.bound(n, blocks.iter())?;
        parallel::map_parts(marks, |range, marks| {
            for (facet, &first) in firsts.iter().enumerate() {
                if let Some(mark) = (first as usize).checked_sub(range.start).and_then(|i| marks.get_mut(i)) {
                    *mark = mark.with(charts.all(facet as u32));
                }
            }
        });
        self.mark(marks, &blocks, |i| charts.all(large[i]));
        let is_crowded = self.crowded(marks);
        let layer = self.size[0] * self.size[1];
        Some(parallel::select(n, |f| match firsts[f as usize] {
            // There are few.
            LARGE => true,
            // Nothing begins in the last layer.
            first => is_crowded[first as usize] | is_crowded[first as usize + layer],
        }))
    }

    /// Marks the blocks of some facets. Every thread looks at all of them for its part of the voxels.
    fn mark(&self, marks: &mut [Shared], blocks: &[Block], charts: impl Fn(usize) -> Shared + Sync + Send) {
        parallel::map_parts(marks, |range, marks| {
            for (i, &block) in blocks.iter().enumerate() {
                let own = charts(i);
                self.each_in(block, range.start, marks, |mark| *mark = mark.with(own));
            }
        });
    }

    /// Leaves no mark in some blocks. Every thread looks at all of them for its part of the voxels.
    fn clear(&self, marks: &mut [Shared], blocks: &[Block]) {
        parallel::map_parts(marks, |range, marks| {
            for &block in blocks {
                self.each_in(block, range.start, marks, |mark| *mark = Shared::default());
            }
        });
    }

    /// Changes the marks of a block's voxels that are in a part of all, with some more than once.
    fn each_in(&self, block: Block, begin: usize, part: &mut [Shared], change: impl Fn(&mut Shared)) {
        self.each(block, |voxel| {
            if let Some(mark) = part.get_mut(voxel.wrapping_sub(begin)) {
                change(mark);
            }
        });
    }

    /// Calls `visit` with the voxels of a block, with some more than once.
    fn each(&self, block: Block, mut visit: impl FnMut(usize)) {
        let (begin, width) = (first(block), width(block));
        if width[0] | width[1] | width[2] <= 1 {
            // As most are. Without branches, which would be predicted badly.
            let end = [0, 1, 2].map(|k| begin[k] + width[k]);
            for z in [begin[2], end[2]] {
                for y in [begin[1], end[1]] {
                    for x in [begin[0], end[0]] {
                        visit(self.index([x, y, z]));
                    }
                }
            }
            return;
        }
        for z in begin[2]..begin[2] + width[2] + 1 {
            for y in begin[1]..begin[1] + width[1] + 1 {
                let row = self.index([begin[0], y, z]);
                (row..row + width[0] + 1).for_each(&mut visit);
            }
        }
    }

    /// Whether a facet that begins in a voxel, or in the one below, may reach into one of the voxel's layer that others reach into.
    /// O(n).
    fn crowded(&self, marks: &mut [Shared]) -> Vec<bool> {
        let (row, layer) = (self.size[0], self.size[0] * self.size[1]);
        parallel::each(marks.chunks_mut(layer).collect(), |marks| spread_up(marks, row));
        let layers: Vec<&[Shared]> = marks.chunks(layer).collect();
        // What others reach into: with what begins in the layer below and reaches into it. Then spread back.
        let mut met = parallel::zeros(marks.len());
        parallel::each(met.chunks_mut(layer).enumerate().collect(), |(z, met): (usize, &mut [bool])| {
            let lower = layers[z.saturating_sub(1)];
            for ((met, &mark), &lower) in met.iter_mut().zip(layers[z]).zip(lower) {
                *met = mark.with(lower).is_nothing();
            }
            spread_down(met, row);
        });
        met
    }
}

/// Joins the mark of each voxel in a layer with those of its lower neighbours.
fn spread_up(layer: &mut [Shared], row: usize) {
    let mut joined = vec![Shared::default(); row];
    for begin in (0..layer.len()).step_by(row).rev() {
        let (lower, own) = layer.split_at_mut(begin);
        let own = &mut own[..row];
        join(own, &lower[begin.saturating_sub(row)..], Shared::with);
        joined.copy_from_slice(own);
        join(&mut own[1..], &joined, Shared::with);
    }
}

/// Joins the mark of each voxel in a layer with those of its upper neighbours.
fn spread_down(layer: &mut [bool], row: usize) {
    let mut joined = vec![false; row];
    for begin in (0..layer.len()).step_by(row) {
        let (own, upper) = layer[begin..].split_at_mut(row);
        join(own, upper, |a, b| a | b);
        joined.copy_from_slice(own);
        join(own, &joined[1..], |a, b| a | b);
    }
}

/// Joins each item with another, as long as there are others.
fn join<T: Copy>(items: &mut [T], others: &[T], joined: impl Fn(T, T) -> T) {
    items.iter_mut().zip(others).for_each(|(item, &other)| *item = joined(*item, other));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::BoxTree;
    use crate::meeting::box_of;
    use crate::progress::{Control, Course};
    use crate::soup::Placed;
    use lar_core::{Affine, Surface, icosphere, rotation, s, t};

    /// Whether some facets can be left out, and those that meet one of another chart are not.
    fn check(surfaces: &[Surface], reach: f64, expected: bool) {
        let soup = Soup::new(surfaces, Placed::snapped(surfaces, |_, _| 0.0).expect("the points are finite"));
        let course = Course::new(Control::default(), &[]);
        let charts = Charts::new(&soup, 1.5, &course, || ()).expect("nobody cancels");
        let boxes: Vec<Aabb> = (0..soup.n_facets() as u32).map(|f| box_of(&soup, f).larger(reach)).collect();
        let all = boxes.iter().fold(Aabb::EMPTY, |all, b| all.joined(b));
        let crowded = facets(&soup, &charts, || Voxels::new(&soup, &all, reach));
        assert_eq!(crowded.is_some(), expected);
        let Some(crowded) = crowded else { return };
        let is_other = |[i, j]: [u32; 2], _: [f32; 2]| !charts.are_one(i, j);
        let meeting = BoxTree::new(&boxes).pairs(&course, is_other, |_, _| false).expect("nobody cancels");
        assert!(!meeting.is_empty());
        assert!(meeting.as_flattened().iter().all(|f| crowded.binary_search(f).is_ok()));
    }

    fn ball(subdivisions: u32, map: &Affine) -> Surface {
        let turned = rotation([1.0, 2.0, 3.0], 0.3).expect("an axis");
        let ball = Surface::from_triangles("ball", &icosphere(subdivisions));
        ball.transformed(map).and_then(|ball| ball.transformed(&turned)).expect("a map of space")
    }

    #[test]
    fn what_meets_another_chart_is_crowded() {
        check(&[ball(5, &t(&[0.0; 3])), ball(5, &t(&[0.3, 0.1, 0.2]))], 0.0, true);
        check(&[ball(5, &t(&[0.0; 3])), ball(4, &t(&[1.9, 0.1, 0.2]))], 1e6, true);
        check(&[ball(5, &t(&[0.0; 3])), ball(5, &s(&[0.99, 1.01, 0.98]))], 0.0, false);
        check(&[ball(3, &t(&[0.0; 3]))], 0.0, false);
    }

    #[test]
    fn large_facets_are_crowded_with_all_they_reach_into() {
        let small = || t(&[0.8, 0.5, 0.2]).compose(&s(&[0.2; 3])).expect("both are maps of space");
        check(&[ball(5, &t(&[0.0; 3])), ball(0, &small())], 0.0, true);
        check(&[ball(5, &t(&[0.0; 3])), ball(0, &t(&[0.5, 0.1, 0.2]))], 0.0, true);
        check(&[ball(5, &t(&[0.0; 3])), ball(0, &s(&[9.0; 3])), ball(0, &small())], 0.0, true);
        let many = [ball(5, &t(&[0.0; 3])), ball(5, &t(&[5.0, 0.0, 0.0])), ball(0, &small())];
        assert!(many.iter().map(Surface::n_faces).sum::<usize>() >= MANY);
        check(&many, 0.0, true);
    }
}
