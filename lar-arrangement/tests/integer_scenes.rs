//! Random boxes and rectangular sheets with small integer corners against counting on the integer grid.
//!
//! The counts follow from which unit squares the input covers. A unit edge belongs to the skeleton when it lies on
//! an input edge or where two covered squares meet at a right angle; a grid point is a vertex when edges of two
//! directions end there; faces are the covered squares of a plane joined across all other unit edges; cells are
//! the unit cubes joined across all squares that are not covered.

mod common;

use common::{Random, arrange_checked, arranged, counts, cuboid, moved, sorted_volumes, surface};
use lar_arrangement::Arrangement;
use lar_core::{CellId, Surface, rotation};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Coordinates of corners are 0..=SIZE.
const SIZE: i32 = 5;

type Corner = [i32; 3];

/// A box, or a rectangle when one extent is 0.
#[derive(Clone, Copy, Debug)]
struct Block {
    lo: Corner,
    hi: Corner,
}

impl Block {
    fn flat_axis(&self) -> Option<usize> {
        (0..3).find(|&k| self.lo[k] == self.hi[k])
    }

    fn surface(&self) -> Surface {
        let (lo, hi) = (self.lo.map(f64::from), self.hi.map(f64::from));
        let Some(axis) = self.flat_axis() else { return cuboid(lo, hi) };
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |at_u: f64, at_v: f64| {
            let mut p = lo;
            (p[u], p[v]) = (at_u, at_v);
            p
        };
        let corners =
            [corner(lo[u], lo[v]), corner(hi[u], lo[v]), corner(hi[u], hi[v]), corner(lo[u], hi[v])];
        surface(&corners, &[&[0, 1, 2, 3]])
    }

    /// The unit squares of the block's boundary, or of the sheet, with this normal, by their lowest corners.
    fn unit_squares(&self, normal: usize) -> Vec<Corner> {
        let (u, v) = ((normal + 1) % 3, (normal + 2) % 3);
        let mut out = Vec::new();
        for level in BTreeSet::from([self.lo[normal], self.hi[normal]]) {
            for i in self.lo[u]..self.hi[u] {
                for j in self.lo[v]..self.hi[v] {
                    let mut p = [0; 3];
                    (p[normal], p[u], p[v]) = (level, i, j);
                    out.push(p);
                }
            }
        }
        out
    }

    fn unit_edges(&self, along: usize) -> Vec<Corner> {
        let (u, v) = ((along + 1) % 3, (along + 2) % 3);
        let mut out = Vec::new();
        for at_u in [self.lo[u], self.hi[u]] {
            for at_v in [self.lo[v], self.hi[v]] {
                for i in self.lo[along]..self.hi[along] {
                    let mut p = [0; 3];
                    (p[along], p[u], p[v]) = (i, at_u, at_v);
                    out.push(p);
                }
            }
        }
        out
    }

    fn contains_cube(&self, cube: Corner) -> bool {
        (0..3).all(|k| self.lo[k] <= cube[k] && cube[k] < self.hi[k])
    }
}

fn step(mut p: Corner, axis: usize, by: i32) -> Corner {
    p[axis] += by;
    p
}

/// Classes of keys under joining.
struct Classes<K> {
    ids: BTreeMap<K, usize>,
    parent: Vec<usize>,
}

impl<K: Ord + Copy> Classes<K> {
    fn new(keys: impl IntoIterator<Item = K>) -> Self {
        let ids: BTreeMap<K, usize> = keys.into_iter().zip(0..).collect();
        Self { parent: (0..ids.len()).collect(), ids }
    }

    fn root(&self, key: K) -> usize {
        let mut at = self.ids[&key];
        while self.parent[at] != at {
            at = self.parent[at];
        }
        at
    }

    fn join(&mut self, a: K, b: K) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b);
    }

    fn classes(&self) -> BTreeMap<usize, Vec<K>> {
        let mut out: BTreeMap<usize, Vec<K>> = BTreeMap::new();
        self.ids.keys().for_each(|&k| out.entry(self.root(k)).or_default().push(k));
        out
    }
}

/// Counts, and for each bounded cell its membership in the blocks and its volume, sorted.
#[derive(Debug, PartialEq)]
struct Expected {
    counts: [usize; 4],
    cells: Vec<(Vec<bool>, usize)>,
}

fn expected(blocks: &[Block]) -> Expected {
    let squares: BTreeSet<(usize, Corner)> = (0..3)
        .flat_map(|normal| {
            blocks.iter().flat_map(move |b| b.unit_squares(normal).into_iter().map(move |p| (normal, p)))
        })
        .collect();
    let edges = skeleton_edges(blocks, &squares);
    let vertices = |p: Corner| {
        let directions =
            (0..3).filter(|&k| edges.contains(&(k, p)) || edges.contains(&(k, step(p, k, -1)))).count();
        directions >= 2
    };
    let points: BTreeSet<Corner> = edges.iter().flat_map(|&(k, p)| [p, step(p, k, 1)]).collect();
    let n_vertices = points.iter().filter(|&&p| vertices(p)).count();
    // A point with edges of one direction only lies inside an edge and joins two unit edges.
    let n_edges = edges.len() - (points.len() - n_vertices);
    let cells = cells(blocks, &squares);
    Expected { counts: [n_vertices, n_edges, n_faces(&squares, &edges), cells.len() + 1], cells }
}

fn skeleton_edges(blocks: &[Block], squares: &BTreeSet<(usize, Corner)>) -> BTreeSet<(usize, Corner)> {
    let mut edges: BTreeSet<(usize, Corner)> = (0..3)
        .flat_map(|k| blocks.iter().flat_map(move |b| b.unit_edges(k).into_iter().map(move |p| (k, p))))
        .collect();
    for &(normal, p) in squares {
        for along in (0..3).filter(|&k| k != normal) {
            let across = 3 - normal - along;
            for edge in [p, step(p, across, 1)] {
                // The squares around this unit edge whose normal is `across`.
                let upright = [edge, step(edge, normal, -1)];
                if upright.iter().any(|&q| squares.contains(&(across, q))) {
                    edges.insert((along, edge));
                }
            }
        }
    }
    edges
}

fn n_faces(squares: &BTreeSet<(usize, Corner)>, edges: &BTreeSet<(usize, Corner)>) -> usize {
    let mut faces = Classes::new(squares.iter().copied());
    for &(normal, p) in squares {
        for along in (0..3).filter(|&k| k != normal) {
            let across = 3 - normal - along;
            let next = (normal, step(p, across, 1));
            if squares.contains(&next) && !edges.contains(&(along, next.1)) {
                faces.join((normal, p), next);
            }
        }
    }
    faces.classes().len()
}

fn cells(blocks: &[Block], squares: &BTreeSet<(usize, Corner)>) -> Vec<(Vec<bool>, usize)> {
    let range = -1..=SIZE;
    let cubes = range.clone().flat_map(|x| {
        let range = range.clone();
        range.clone().flat_map(move |y| range.clone().map(move |z| [x, y, z]))
    });
    let mut classes = Classes::new(cubes);
    for cube in classes.ids.keys().copied().collect::<Vec<_>>() {
        for k in 0..3 {
            let next = step(cube, k, 1);
            if next[k] <= SIZE && !squares.contains(&(k, next)) {
                classes.join(cube, next);
            }
        }
    }
    let exterior = classes.root([-1; 3]);
    let mut out: Vec<(Vec<bool>, usize)> = classes
        .classes()
        .into_iter()
        .filter(|(root, _)| *root != exterior)
        .map(|(_, cubes)| (blocks.iter().map(|b| b.contains_cube(cubes[0])).collect(), cubes.len()))
        .collect();
    out.sort();
    out
}

fn found(a: &Arrangement, n_blocks: usize) -> Expected {
    let mut cells: Vec<(Vec<bool>, usize)> = (1..a.n_cells())
        .map(|c| {
            let inside = (0..n_blocks).map(|s| a.winding(CellId(c as u32), s) != 0).collect();
            (inside, a.volumes()[c].round() as usize)
        })
        .collect();
    cells.sort();
    Expected { counts: counts(a), cells }
}

/// Compares and returns the number of bounded cells.
#[track_caller]
fn check(blocks: &[Block]) -> usize {
    let surfaces: Vec<Surface> = blocks.iter().map(Block::surface).collect();
    let a = arranged(&surfaces);
    assert_eq!(found(&a, blocks.len()), expected(blocks), "{blocks:?}");
    for v in sorted_volumes(&a) {
        assert!((v - v.round()).abs() < 1e-12, "a cell of volume {v} in {blocks:?}");
    }
    a.n_cells() - 1
}

fn random_block(random: &mut Random, sheets: bool) -> Block {
    let mut block = Block { lo: [0; 3], hi: [0; 3] };
    for k in 0..3 {
        let (a, b) = (random.below(SIZE as usize + 1) as i32, random.below(SIZE as usize) as i32);
        let b = b + i32::from(b >= a);
        (block.lo[k], block.hi[k]) = (a.min(b), a.max(b));
    }
    if sheets && random.below(3) == 0 {
        let axis = random.below(3);
        block.hi[axis] = block.lo[axis];
    }
    block
}

#[test]
fn two_boxes_in_a_row() {
    check(&[Block { lo: [0; 3], hi: [2; 3] }, Block { lo: [2, 1, 0], hi: [4, 3, 2] }]);
    check(&[Block { lo: [0; 3], hi: [4; 3] }, Block { lo: [0, 2, 2], hi: [5, 2, 3] }]);
}

#[test]
fn random_boxes() {
    let mut n_cells = 0;
    for seed in 0..2_000 {
        let random = &mut Random(seed);
        let n = 1 + random.below(6);
        n_cells += check(&(0..n).map(|_| random_block(random, false)).collect::<Vec<_>>());
    }
    assert!(n_cells > 10_000, "only {n_cells} cells");
}

#[test]
fn random_boxes_and_sheets() {
    let mut n_cells = 0;
    for seed in 0..2_000 {
        let random = &mut Random(!seed);
        let n = 2 + random.below(8);
        n_cells += check(&(0..n).map(|_| random_block(random, true)).collect::<Vec<_>>());
    }
    assert!(n_cells > 10_000, "only {n_cells} cells");
}

/// After a rotation what was coplanar is so no longer: faces miss each other by fractions of a grid step, and
/// sliver cells appear. Counts are open, the laws and the volumes are not.
#[test]
fn rotated_boxes_keep_every_law() {
    for seed in 0..600 {
        let random = &mut Random(seed);
        let n = 2 + random.below(5);
        let blocks: Vec<Block> = (0..n).map(|_| random_block(random, false)).collect();
        let axis = [0; 3].map(|_| random.between(-1.0, 1.0));
        let turn = rotation(axis, random.between(0.1, 3.0)).expect("the axis is not zero");
        let surfaces: Vec<Surface> = blocks.iter().map(Block::surface).collect();
        let a = arrange_checked(&moved(&surfaces, &turn)).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let volumes = a.volumes();
        for (solid, block) in blocks.iter().enumerate() {
            let inside = (1..a.n_cells()).filter(|&c| a.winding(CellId(c as u32), solid) != 0);
            let found: f64 = inside.map(|c| volumes[c]).sum();
            let expected = (0..3).map(|k| f64::from(block.hi[k] - block.lo[k])).product::<f64>();
            assert!((found - expected).abs() <= 1e-9 * expected, "seed {seed}: {found} for {block:?}");
        }
    }
}

fn block() -> impl Strategy<Value = Block> {
    let side = (0..=SIZE, 0..=SIZE).prop_map(|(a, b)| (a.min(b), a.max(b)));
    prop::array::uniform3(side)
        .prop_map(|sides| Block { lo: sides.map(|s| s.0), hi: sides.map(|s| s.1) })
        .prop_filter("a box or a rectangle", |b| (0..3).filter(|&k| b.lo[k] == b.hi[k]).count() < 2)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]
    #[test]
    fn boxes_and_sheets_that_shrink(blocks in prop::collection::vec(block(), 0..8)) {
        check(&blocks);
    }
}
