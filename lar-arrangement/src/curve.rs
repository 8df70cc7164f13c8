//! The order of boxes along a Z-shaped space-filling curve through their middles.

use crate::boxes::Aabb;
use crate::counting::sorted_numbers;
use crate::parallel;

/// Bits of a place along an axis of the curve.
const BITS: usize = 20;

/// The box around n boxes.
pub(crate) fn hull<const D: usize>(n: usize, box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Aabb<D> {
    let (n_chunks, range) = parallel::chunks(n, parallel::LIGHT_CHUNK);
    let hulls = parallel::map(n_chunks, |chunk| {
        range(chunk).fold(Aabb::EMPTY, |all, i| all.joined(&box_of(i as u32)))
    });
    hulls.iter().fold(Aabb::EMPTY, |all, hull| all.joined(hull))
}

/// The order of n boxes in another one along a Z-shaped space-filling curve through their middles.
pub(crate) fn z_order<const D: usize>(
    all: &Aabb<D>,
    n: usize,
    box_of: impl Fn(u32) -> Aabb<D> + Sync + Send,
) -> Vec<u32> {
    let curve = Curve::through(all);
    let upper = parallel::map_light(n, |i| curve.upper(&box_of(i as u32), i as u32));
    curve.sorted(&upper, box_of)
}

/// A Z-shaped curve through a box.
pub(crate) struct Curve<const D: usize> {
    lo: [f64; D],
    /// From lengths to squares of the curve.
    scale: [f64; D],
}

impl<const D: usize> Curve<D> {
    pub(crate) fn through(all: &Aabb<D>) -> Self {
        let scale =
            |k: usize| if all.hi[k] > all.lo[k] { 1_048_575.0 / (all.hi[k] - all.lo[k]) } else { 0.0 };
        Self { lo: all.lo, scale: std::array::from_fn(scale) }
    }

    /// Where the middle of a box lies on the curve.
    fn key(&self, b: &Aabb<D>) -> u64 {
        let cell =
            |k: usize| (((b.lo[k] - self.lo[k]) * 0.5 + (b.hi[k] - self.lo[k]) * 0.5) * self.scale[k]) as u64;
        (0..D).fold(0, |key, k| key | spread::<D>(cell(k)) << k)
    }

    /// The upper half of a box's key, above its number; what is below decides for few.
    pub(crate) fn upper(&self, b: &Aabb<D>, i: u32) -> u64 {
        (self.key(b) >> (D * BITS - 32)) << 32 | u64::from(i)
    }

    /// The numbers of boxes along the curve.
    pub(crate) fn sorted(&self, upper: &[u64], box_of: impl Fn(u32) -> Aabb<D> + Sync + Send) -> Vec<u32> {
        let settle = |sorted: &mut [u64]| {
            for same in sorted.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|same| same.len() > 1) {
                same.sort_unstable_by_key(|&x| (self.key(&box_of(x as u32)), x));
            }
        };
        let sorted = sorted_numbers(upper, 64, settle);
        parallel::map_light(sorted.len(), |i| sorted[i] as u32)
    }
}

/// The low 20 bits, each with D − 1 zeros before it, in the plane or in space.
fn spread<const D: usize>(x: u64) -> u64 {
    let halved = |x: u64, shift: u32, mask: u64| (x | x << shift) & mask;
    if D == 2 {
        let x = halved(x, 16, 0x0000_ffff_0000_ffff);
        let x = halved(x, 8, 0x00ff_00ff_00ff_00ff);
        let x = halved(x, 4, 0x0f0f_0f0f_0f0f_0f0f);
        let x = halved(x, 2, 0x3333_3333_3333_3333);
        halved(x, 1, 0x5555_5555_5555_5555)
    } else {
        let x = halved(x, 32, 0x001f_0000_0000_ffff);
        let x = halved(x, 16, 0x001f_0000_ff00_00ff);
        let x = halved(x, 8, 0x100f_00f0_0f00_f00f);
        let x = halved(x, 4, 0x10c3_0c30_c30c_30c3);
        halved(x, 2, 0x1249_2492_4924_9249)
    }
}
