//! Stage 6a: the winding number of every input solid in every 3-cell, by walking the dual graph from the exterior.
//!
//! Crossing a face from the side its normal points to changes the winding number of solid s by the sum of the
//! signed coefficients of those faces of s that it is a piece of. A solid's winding numbers are consistent over
//! all faces if and only if its boundary is closed; otherwise its parity may still be (closed but not oriented
//! consistently); otherwise the surface is open and bounds nothing.

use crate::counting::sorted_by_place;
use crate::parallel;
use std::ops::Range;

/// What a surface bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closure {
    /// Closed and oriented: every cell has a winding number.
    Closed,
    /// Closed, but not oriented consistently: every cell has a parity.
    Unoriented,
    /// Open: it divides space but bounds no solid.
    Open,
}

/// Winding numbers of all solids in all cells, sparse by cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Windings {
    /// Parities for unoriented solids. No cells when there are no solids.
    rows: Rows,
    pub closure: Vec<Closure>,
}

/// For each cell solids and their numbers, where they are not zero; sorted by solid.
#[derive(Clone, Debug, Default)]
struct Rows {
    /// Where the entries of a cell begin and end.
    of_cell: Vec<Range<usize>>,
    entries: Vec<(u32, i32)>,
}

/// The same rows: in whatever order they lie.
impl PartialEq for Rows {
    fn eq(&self, other: &Self) -> bool {
        self.of_cell.len() == other.of_cell.len()
            && (0..self.of_cell.len()).all(|cell| self.of(cell) == other.of(cell))
    }
}

impl Rows {
    fn of(&self, cell: usize) -> &[(u32, i32)] {
        &self.entries[self.of_cell[cell].clone()]
    }

    /// Makes what was added to the entries since `begin` the row of the next cell.
    fn close(&mut self, begin: usize) {
        self.of_cell.push(begin..self.entries.len());
    }

    /// The numbers of all cells: those of the cell that a cell is entered from, changed by the wall between.
    fn propagated(
        n_cells: usize,
        tree: &[(u32, u32, u32, i32)],
        walls: &Walls,
        value: impl Fn(&Jump) -> i32,
    ) -> Self {
        let mut out = Self { of_cell: vec![0..0; n_cells], entries: Vec::new() };
        for &(cell, from, wall, sign) in tree {
            let Range { start: mut at, end } = out.of_cell[from as usize].clone();
            let begin = out.entries.len();
            for jump in walls.of(wall) {
                let same = out.entries[at..end].partition_point(|e| e.0 < jump.solid);
                out.entries.extend_from_within(at..at + same);
                at += same;
                let before = out.entries[at..end].first().filter(|e| e.0 == jump.solid).map(|e| e.1);
                at += usize::from(before.is_some());
                let number = before.unwrap_or(0) + sign * value(jump);
                if number != 0 {
                    out.entries.push((jump.solid, number));
                }
            }
            out.entries.extend_from_within(at..end);
            out.of_cell[cell as usize] = begin..out.entries.len();
        }
        out
    }

    /// The solids whose numbers, reduced, differ on the two sides of some wall by something else than its jump.
    fn inconsistent(
        &self,
        walls: &Walls,
        value: impl Fn(&Jump) -> i32 + Sync + Send,
        reduced: impl Fn(i32) -> i32 + Sync + Send,
    ) -> Vec<u32> {
        let (n_chunks, range) = parallel::chunks(walls.cells.len(), WALLS_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut out = Vec::new();
            for wall in range(chunk) {
                let sides = walls.cells[wall].map(|cell| self.of(cell as usize));
                let jumps = walls.of(wall as u32).iter().map(|jump| (jump.solid, value(jump)));
                each_excess(sides, jumps, |solid, excess| {
                    out.extend((reduced(excess) != 0).then_some(solid));
                });
            }
            // Where a surface is open many walls say so.
            out.sort_unstable();
            out.dedup();
            out
        });
        parts.concat()
    }
}

/// Calls `visit` with all solids that have numbers in front of a wall or behind it that differ, or jump there, and by how much
/// more than its jump the number of each rises. Rows and jumps are sorted by solid.
fn each_excess(
    sides: [&[(u32, i32)]; 2],
    jumps: impl Iterator<Item = (u32, i32)>,
    mut visit: impl FnMut(u32, i32),
) {
    let mut rest = sides;
    for (solid, jump) in jumps {
        let split = rest.map(|side| side.split_at(side.partition_point(|entry| entry.0 < solid)));
        each_difference(split.map(|(before, _)| before), &mut visit);
        rest = split.map(|(_, after)| after);
        let [front, back] = rest.each_mut().map(|side| match side.split_first() {
            Some((&(first, number), after)) if first == solid => {
                *side = after;
                number
            }
            _ => 0,
        });
        visit(solid, back - front - jump);
    }
    each_difference(rest, visit);
}

/// As `each_excess`, where nothing jumps. Mostly both sides are the same.
fn each_difference(sides: [&[(u32, i32)]; 2], mut visit: impl FnMut(u32, i32)) {
    if sides[0] != sides[1] {
        for &(solid, _) in sides.into_iter().flatten() {
            let [front, back] = sides.map(|side| number_of(side, solid));
            visit(solid, back - front);
        }
    }
}

fn number_of(row: &[(u32, i32)], solid: u32) -> i32 {
    row.binary_search_by_key(&solid, |e| e.0).map_or(0, |at| row[at].1)
}

/// A face is compared with so many walls before it.
const RECENT: usize = 4;

/// Faces a chunk of work.
const FACES_A_CHUNK: usize = 1 << 12;

/// Walls a chunk of work.
const WALLS_A_CHUNK: usize = 1 << 10;

/// The change of winding numbers across a face, from front to back: solid, signed sum, sum modulo 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Jump {
    pub solid: u32,
    pub signed: i32,
    pub odd: bool,
}

/// Faces that come soon after each other, lie between the same cells and have the same jumps: one wall. Most faces of a mesh
/// are of very few.
#[derive(Debug)]
pub(crate) struct Walls {
    /// The cells in front and behind.
    cells: Vec<[u32; 2]>,
    offsets: Vec<u32>,
    /// Sorted by solid.
    jumps: Vec<Jump>,
}

impl Walls {
    pub(crate) fn new() -> Self {
        Self { cells: Vec::new(), offsets: vec![0], jumps: Vec::new() }
    }

    /// Adds the next face between two cells with its contributions to the jumps: solid and signed coefficient.
    pub(crate) fn push_face(&mut self, cells: [u32; 2], contributions: impl Iterator<Item = (u32, i32)>) {
        let mut jumps = contributions.map(|(solid, signed)| Jump { solid, signed, odd: signed % 2 != 0 });
        let (first, second) = (jumps.next(), jumps.next());
        if let (Some(only), None) = (first, second) {
            // As most faces have; mostly it is the same as the last one's.
            if self.cells.last() == Some(&cells) && self.jumps.last() == Some(&only) && self.has_single_last()
            {
                return;
            }
            return self.push_wall(cells, &[only]);
        }
        let mut all: Vec<Jump> = first.into_iter().chain(second).chain(jumps).collect();
        all.sort_unstable_by_key(|j| j.solid);
        let sums = all.chunk_by(|a, b| a.solid == b.solid).map(|same| Jump {
            solid: same[0].solid,
            signed: same.iter().map(|j| j.signed).sum(),
            odd: same.iter().fold(false, |odd, j| odd ^ j.odd),
        });
        self.push_wall(cells, &sums.collect::<Vec<_>>());
    }

    /// Whether the last wall has one jump.
    fn has_single_last(&self) -> bool {
        matches!(self.offsets[..], [.., begin, end] if end - begin == 1)
    }

    /// Adds a wall, unless one of the last is the same.
    fn push_wall(&mut self, cells: [u32; 2], jumps: &[Jump]) {
        let n = self.cells.len();
        let is_same = |wall: usize| self.cells[wall] == cells && self.of(wall as u32) == jumps;
        if !(n.saturating_sub(RECENT)..n).rev().any(is_same) {
            self.cells.push(cells);
            self.jumps.extend_from_slice(jumps);
            self.offsets.push(self.jumps.len() as u32);
        }
    }

    /// The walls of n faces: `push(walls, face)` adds each.
    pub(crate) fn of_faces(n: usize, push: impl Fn(&mut Self, usize) + Sync + Send) -> Self {
        let (n_chunks, range) = parallel::chunks(n, FACES_A_CHUNK);
        let parts = parallel::map(n_chunks, |chunk| {
            let mut walls = Self::new();
            range(chunk).for_each(|face| push(&mut walls, face));
            walls
        });
        let sum = |n: fn(&Self) -> usize| parts.iter().map(n).sum::<usize>();
        let mut all = Self::new();
        all.cells.reserve(sum(|part| part.cells.len()));
        all.offsets.reserve(sum(|part| part.cells.len()));
        all.jumps.reserve(sum(|part| part.jumps.len()));
        parts.iter().flat_map(Self::iter).for_each(|(cells, jumps)| all.push_wall(cells, jumps));
        all
    }

    fn of(&self, wall: u32) -> &[Jump] {
        &self.jumps[self.offsets[wall as usize] as usize..self.offsets[wall as usize + 1] as usize]
    }

    fn iter(&self) -> impl Iterator<Item = ([u32; 2], &[Jump])> + '_ {
        self.cells
            .iter()
            .copied()
            .zip(self.offsets.windows(2).map(|w| &self.jumps[w[0] as usize..w[1] as usize]))
    }
}

impl Windings {
    /// O(walls · parents + entries).
    pub(crate) fn new(n_cells: usize, n_solids: usize, walls: &Walls) -> Self {
        let tree = spanning_tree(n_cells, &walls.cells);
        let mut closure = vec![Closure::Closed; n_solids];
        let rows = Rows::propagated(n_cells, &tree, walls, |j| j.signed);
        for solid in rows.inconsistent(walls, |j| j.signed, |a| a) {
            closure[solid as usize] = Closure::Unoriented;
        }
        if !closure.contains(&Closure::Unoriented) {
            return Self { rows, closure };
        }
        let odd = |j: &Jump| i32::from(j.odd && closure[j.solid as usize] == Closure::Unoriented);
        let parities = Rows::propagated(n_cells, &tree, walls, odd);
        let open = parities.inconsistent(walls, odd, |a| a.rem_euclid(2));
        open.into_iter().for_each(|solid| closure[solid as usize] = Closure::Open);
        let mut out = Rows::default();
        for cell in 0..n_cells {
            let begin = out.entries.len();
            let closed = rows.of(cell).iter().copied().filter(|e| closure[e.0 as usize] == Closure::Closed);
            let unoriented =
                parities.of(cell).iter().filter(|e| closure[e.0 as usize] == Closure::Unoriented);
            let odd = unoriented.map(|e| (e.0, e.1.rem_euclid(2))).filter(|e| e.1 != 0);
            out.entries.extend(closed.chain(odd));
            out.entries[begin..].sort_unstable();
            out.close(begin);
        }
        Self { rows: out, closure }
    }

    /// For new cells their old ones: the same numbers, and all zero where there is no old one.
    pub(crate) fn of_some(&self, old_cells: &[Option<usize>]) -> Self {
        let mut rows = Rows::default();
        for old in old_cells {
            let begin = rows.entries.len();
            rows.entries.extend(old.iter().flat_map(|&old| self.of_cell(old)));
            rows.close(begin);
        }
        Self { rows, closure: self.closure.clone() }
    }

    /// Number of cells; of those of the plane only where there are regions.
    pub(crate) fn n_cells(&self) -> usize {
        self.rows.of_cell.len()
    }

    /// The solids with a winding number other than zero in a cell.
    pub(crate) fn of_cell(&self, cell: usize) -> &[(u32, i32)] {
        if self.closure.is_empty() { &[] } else { self.rows.of(cell) }
    }
}

/// For each cell but the exterior, in the order of a breadth-first walk: the cell, the one it is entered from, the
/// wall crossed and the sign of the crossing (+1 from front to back).
fn spanning_tree(n_cells: usize, cells_of_wall: &[[u32; 2]]) -> Vec<(u32, u32, u32, i32)> {
    // Sides of walls: 2 · wall in front, + 1 behind.
    let cell_at = |side: u32| cells_of_wall.as_flattened()[side as usize];
    let sides: Vec<u32> = (0..2 * cells_of_wall.len() as u32).collect();
    let (offsets, sides) = sorted_by_place(n_cells, &sides, |&side| cell_at(side) as usize);
    let mut seen = vec![false; n_cells];
    seen[0] = true;
    let mut order = vec![0u32];
    let mut tree = Vec::with_capacity(n_cells);
    let mut at = 0;
    while at < order.len() {
        let cell = order[at];
        at += 1;
        for &side in &sides[offsets[cell as usize] as usize..offsets[cell as usize + 1] as usize] {
            let (next, sign) = (cell_at(side ^ 1), if side.is_multiple_of(2) { 1 } else { -1 });
            if !std::mem::replace(&mut seen[next as usize], true) {
                order.push(next);
                tree.push((next, cell, side / 2, sign));
            }
        }
    }
    tree
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_rises_by_more_than_the_jump_is_found(
            numbers in prop::array::uniform3(prop::collection::vec(-1i32..2, 6)),
        ) {
            // A row has no zeros; a jump may be one.
            let list = |of: &[i32]| (0..).zip(of.iter().copied()).collect::<Vec<(u32, i32)>>();
            let [front, back, mut jumps] = numbers.each_ref().map(|of| list(of));
            let rows = [&front, &back].map(|row| row.iter().copied().filter(|e| e.1 != 0).collect::<Vec<_>>());
            jumps.retain(|jump| jump.0 % 3 != 1 || jump.1 == 1);
            let jump_of = |solid| jumps.iter().find(|jump| jump.0 == solid).map_or(0, |jump| jump.1);
            let rise = |solid: u32| back[solid as usize].1 - front[solid as usize].1 - jump_of(solid);
            let mut found = Vec::new();
            each_excess(rows.each_ref().map(Vec::as_slice), jumps.iter().copied(), |solid, excess| {
                assert_eq!(excess, rise(solid));
                found.push(solid);
            });
            let missed = (0..6).find(|&solid| rise(solid) != 0 && !found.contains(&solid));
            prop_assert_eq!(missed, None);
        }
    }
}
