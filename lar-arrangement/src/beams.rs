//! Boxes that are searched for facets all at once, without a tree.
//!
//! The beams around rays along x are points as seen along x. A grid of cells over them, with a table of sums, tells of every
//! facet at once whether any beam is among the cells that its projection reaches into: of most facets none is.
//!
//! ```text
//!    z ^  ·  ·  ╱╲ ·  ·      targets in the cells y0..=y1 × z0..=z1 are
//!      │  ·  · ╱ ●╲·  ·      S(y1, z1) − S(y0 − 1, z1) − S(y1, z0 − 1) + S(y0 − 1, z0 − 1)
//!      │  ·  · ▔▔▔▔·  ·
//!      └────────────────> y
//! ```

use crate::boxes::Aabb;
use crate::meeting::box_of;
use crate::parallel;
use crate::soup::Soup;

/// Facets a chunk of work.
const FACETS_A_CHUNK: usize = 1 << 12;
/// Cells along an axis. All targets are in those that are not at a border.
const CELLS: usize = 64;
/// Of the 62 × 62 cells that may hold targets so many fill one in fifteen: most facets reach into none. A facet is compared with no
/// more than so many.
pub(crate) const TARGETS_A_PASS: usize = 256;

/// The facets whose boxes meet each target. O(facets + targets · facets with one in the same cells).
pub(crate) fn facets_in(soup: &Soup, targets: &[Aabb]) -> Vec<Vec<u32>> {
    if let [target] = targets {
        return vec![facets_in_one(soup, target)];
    }
    let cells = Cells::over(targets);
    let places =
        parallel::map_light(soup.geometry.n_points(), |p| cells.place(soup.geometry.position(p as u32)));
    let place = |p: u32| places[p as usize];
    let are_triangles = soup.are_triangles();
    let (n_chunks, range) = parallel::chunks(soup.n_facets(), FACETS_A_CHUNK);
    let parts = parallel::map(n_chunks, |chunk| {
        let mut found = Vec::new();
        for facet in range(chunk) {
            let facet = facet as u32;
            let [a, b, c] = soup.geometry.base(facet).map(place);
            if are_triangles && !a.is_near_targets() && a.is_close_to(b) && a.is_close_to(c) {
                continue;
            }
            let mut block = a.block().around(b.block()).around(c.block());
            if !are_triangles {
                let edges = soup.facet_edges[facet as usize].iter();
                let corners = edges.map(|&code| place(soup.directed(code)[0]).block());
                block = corners.fold(block, Block::around);
            }
            if cells.have_targets(block) {
                let of_facet = box_of(soup, facet);
                let met = targets.iter().zip(0u32..).filter(|(target, _)| of_facet.meets(target));
                found.extend(met.map(|(_, target)| (target, facet)));
            }
        }
        found
    });
    let mut facets = vec![Vec::new(); targets.len()];
    for (target, facet) in parts.into_iter().flatten() {
        facets[target as usize].push(facet);
    }
    facets
}

/// The facets whose boxes meet one other, as most scenes have one component: half the time that the cells would take. O(n).
fn facets_in_one(soup: &Soup, target: &Aabb) -> Vec<u32> {
    // A box beyond one of the target's sides has all its corners there.
    let sides = parallel::map_light(soup.geometry.n_points(), |p| {
        let at = soup.geometry.position(p as u32);
        let beyond = |k: usize| {
            u8::from(at[k] < target.lo[k]) << (2 * k) | u8::from(at[k] > target.hi[k]) << (2 * k + 1)
        };
        beyond(0) | beyond(1) | beyond(2)
    });
    let of = |p: u32| sides[p as usize];
    let of_others =
        |f: u32| soup.facet_edges[f as usize].iter().fold(!0, |all, &code| all & of(soup.directed(code)[0]));
    parallel::select(soup.n_facets(), |f| {
        let [a, b, c] = soup.geometry.base(f).map(of);
        a & b & c == 0 || !soup.are_triangles() && of_others(f) == 0
    })
}

/// Cells in the plane of y and z.
struct Cells {
    lo: [f64; 2],
    scale: f64,
    /// The number of targets in the cells before column y and row z: every target counts in each cell that it is in.
    sums: Vec<u32>,
    /// The places of points in each cell.
    places: Vec<Place>,
}

/// The cell of a point: its row z, its column y, and whether targets are *near*, from one cell before it along each axis to
/// two behind, a byte each.
#[derive(Clone, Copy)]
struct Place(u32);

impl Place {
    fn block(self) -> Block {
        let [z, y, ..] = self.0.to_le_bytes();
        Block { first: [y, z], last: [y, z] }
    }

    fn is_near_targets(self) -> bool {
        self.0 >> 16 != 0
    }

    /// Whether the cell of another is from one cell before this one's to two behind.
    fn is_close_to(self, other: Self) -> bool {
        // What is less by more than one borrows from the bits above.
        (other.0 as u16).wrapping_sub(self.0 as u16).wrapping_add(0x0101) & 0xfcfc == 0
    }
}

/// The first and the last cells along each axis.
#[derive(Clone, Copy)]
struct Block {
    first: [u8; 2],
    last: [u8; 2],
}

impl Block {
    fn around(self, other: Self) -> Self {
        Self {
            first: [0, 1].map(|k| self.first[k].min(other.first[k])),
            last: [0, 1].map(|k| self.last[k].max(other.last[k])),
        }
    }
}

impl Cells {
    fn over(targets: &[Aabb]) -> Self {
        let all = targets.iter().fold(Aabb::EMPTY, |all, target| all.joined(target));
        let extent = (all.hi[1] - all.lo[1]).max(all.hi[2] - all.lo[2]).max(1.0);
        let mut cells = Self {
            lo: [all.lo[1], all.lo[2]],
            scale: (CELLS - 3) as f64 / extent,
            sums: vec![0; (CELLS + 1) * (CELLS + 1)],
            places: Vec::new(),
        };
        for target in targets {
            let Block { first, last } = cells.cell(target.lo).around(cells.cell(target.hi));
            for y in first[0]..=last[0] {
                for z in first[1]..=last[1] {
                    cells.sums[Self::index(y.into(), z.into()) + CELLS + 2] += 1;
                }
            }
        }
        for y in 1..=CELLS {
            for z in 1..=CELLS {
                let at = Self::index(y, z);
                cells.sums[at] +=
                    cells.sums[at - 1] + cells.sums[at - CELLS - 1] - cells.sums[at - CELLS - 2];
            }
        }
        let of_cell = |y: u8, z: u8| {
            let last = |cell: u8| (cell + 2).min(CELLS as u8 - 1);
            let near = Block { first: [y, z].map(|cell| cell.saturating_sub(1)), last: [y, z].map(last) };
            Place(u32::from_le_bytes([z, y, u8::from(cells.have_targets(near)), 0]))
        };
        cells.places = (0..CELLS as u8).flat_map(|y| (0..CELLS as u8).map(move |z| of_cell(y, z))).collect();
        cells
    }

    fn index(y: usize, z: usize) -> usize {
        y * (CELLS + 1) + z
    }

    fn place(&self, at: [f64; 3]) -> Place {
        let [y, z] = self.cell(at).first.map(usize::from);
        self.places[y * CELLS + z]
    }

    /// The cell of a point. What is farther right is in no cell farther left, whatever is rounded.
    fn cell(&self, at: [f64; 3]) -> Block {
        let cell = [0, 1].map(|k| {
            // Only what is beyond all targets is in the first cell or the last.
            ((at[k + 1] - self.lo[k]) * self.scale + 1.0).clamp(0.0, (CELLS - 1) as f64) as u8
        });
        Block { first: cell, last: cell }
    }

    fn have_targets(&self, Block { first, last }: Block) -> bool {
        let [y0, z0] = first.map(usize::from);
        let [y1, z1] = last.map(|cell| usize::from(cell) + 1);
        let sum = |y, z| self.sums[Self::index(y, z)];
        sum(y1, z1) + sum(y0, z0) != sum(y0, z1) + sum(y1, z0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soup::Placed;
    use lar_core::{Points, Surface, cuboid_grid, icosphere};
    use proptest::prelude::*;

    /// Looks for the facets in boxes, given in parts of a thousand of the scene, one by one and all at once.
    #[track_caller]
    fn check(surfaces: &[Surface], targets: &[[[i32; 3]; 2]]) {
        let placed = Placed::snapped(surfaces, |_, _| 0.0).expect("the points are finite");
        let soup = Soup::new(surfaces, placed);
        let facets = 0..soup.n_facets() as u32;
        let all = facets.clone().fold(Aabb::EMPTY, |all, f| all.joined(&box_of(&soup, f)));
        let place = |at: [i32; 3]| {
            std::array::from_fn(|k| all.lo[k] + f64::from(at[k]) / 1000.0 * (all.hi[k] - all.lo[k]))
        };
        let targets: Vec<Aabb> = targets.iter().map(|&[a, b]| Aabb::around([place(a), place(b)])).collect();
        let meeting = |target: &Aabb| facets.clone().filter(|&f| box_of(&soup, f).meets(target)).collect();
        let expected: Vec<Vec<u32>> = targets.iter().map(meeting).collect();
        assert_eq!(facets_in(&soup, &targets), expected);
        for (target, expected) in targets.iter().zip(&expected) {
            assert_eq!(&facets_in(&soup, &[*target]), std::slice::from_ref(expected));
        }
    }

    #[test]
    fn facets_in_boxes_and_beams() {
        let ball = Surface::from_triangles("ball", &icosphere(2));
        let block = cuboid_grid(&[3, 2, 1]).to_surface("block").expect("a block");
        let box_at = |i: i32| {
            let [x, y, z, size] = [7, 11, 15, 19].map(|step| i * step % 100 * 10);
            [[x, y, z], [x + size / 4, y + size / 4, z + size / 4]]
        };
        let boxes: Vec<_> = (0..100).map(box_at).collect();
        let beams: Vec<_> = boxes.iter().map(|&[lo, _]| [[-1000, lo[1], lo[2]], lo]).collect();
        for surfaces in [vec![ball.clone()], vec![ball, block]] {
            check(&surfaces, &boxes);
            check(&surfaces, &beams);
            check(&surfaces, &[[[500; 3]; 2]; 2]);
        }
    }

    proptest! {
        #[test]
        fn facets_in_any_boxes(
            corners in prop::collection::vec(prop::array::uniform3(-9i32..9), 4..60),
            targets in prop::collection::vec(prop::array::uniform2(prop::array::uniform3(-300..1300)), 0..20),
        ) {
            let points: Vec<[f64; 3]> = corners.iter().map(|p| p.map(f64::from)).collect();
            let mut surface = Surface::new("soup", Points::from_xyz(&points));
            for i in 0..points.len() as u32 - 3 {
                surface.push_face([&[i, i + 1, i + 2][..]], 1);
            }
            surface.push_face([&[0, 1, 2, 3][..]], 1);
            check(&[surface], &targets);
        }
    }
}
