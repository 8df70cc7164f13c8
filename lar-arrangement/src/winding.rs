//! Stage 6a: the winding number of every input solid in every 3-cell, by walking the dual graph from the exterior.
//!
//! Crossing a face from the side its normal points to changes the winding number of solid s by the sum of the
//! signed coefficients of those faces of s that it is a piece of. A solid's winding numbers are consistent over
//! all faces if and only if its boundary is closed; otherwise its parity may still be (closed but not oriented
//! consistently); otherwise the surface is open and bounds nothing.

use crate::parallel;

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
    /// Empty when there are no solids.
    offsets: Vec<u32>,
    /// Solid and winding number (parity for unoriented solids), where it is not zero; sorted by solid.
    entries: Vec<(u32, i32)>,
    pub closure: Vec<Closure>,
}

/// A face is compared with so many walls before it.
const RECENT: usize = 4;

/// Faces a chunk of work.
const FACES_A_CHUNK: usize = 1 << 12;

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
        let begin = self.jumps.len();
        let jump =
            |(solid, coefficient): (u32, i32)| Jump { solid, signed: coefficient, odd: coefficient % 2 != 0 };
        self.jumps.extend(contributions.map(jump));
        if self.jumps.len() - begin > 1 {
            let mut all = self.jumps.split_off(begin);
            all.sort_unstable_by_key(|j| j.solid);
            self.jumps.extend(all.chunk_by(|a, b| a.solid == b.solid).map(|same| Jump {
                solid: same[0].solid,
                signed: same.iter().map(|j| j.signed).sum(),
                odd: same.iter().fold(false, |odd, j| odd ^ j.odd),
            }));
        }
        self.close(cells, begin);
    }

    /// Makes a wall of the jumps from `begin` on, unless one of the last is the same.
    fn close(&mut self, cells: [u32; 2], begin: usize) {
        let (n, jumps) = (self.cells.len(), &self.jumps[begin..]);
        let is_same = |wall: usize| self.cells[wall] == cells && self.of(wall as u32) == jumps;
        if (n.saturating_sub(RECENT)..n).rev().any(is_same) {
            self.jumps.truncate(begin);
        } else {
            self.cells.push(cells);
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
        let mut all = Self::new();
        for (cells, jumps) in parts.iter().flat_map(Self::iter) {
            let begin = all.jumps.len();
            all.jumps.extend_from_slice(jumps);
            all.close(cells, begin);
        }
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
        let mut windings = propagate(n_cells, &tree, walls, |j| j.signed);
        for (cells, jumps) in walls.iter() {
            check_wall(&windings, cells, jumps, |j| j.signed, |a| a, &mut closure, Closure::Unoriented);
        }
        if closure.contains(&Closure::Unoriented) {
            let odd = |j: &Jump| i32::from(j.odd && closure[j.solid as usize] == Closure::Unoriented);
            let parity = propagate(n_cells, &tree, walls, odd);
            let mut open = closure.clone();
            for (cells, jumps) in walls.iter() {
                check_wall(&parity, cells, jumps, odd, |a| a.rem_euclid(2), &mut open, Closure::Open);
            }
            for (cell, row) in windings.iter_mut().enumerate() {
                row.retain(|e| closure[e.0 as usize] == Closure::Closed);
                let unoriented = parity[cell].iter().filter(|e| open[e.0 as usize] == Closure::Unoriented);
                row.extend(unoriented.map(|e| (e.0, e.1.rem_euclid(2))).filter(|e| e.1 != 0));
                row.sort_unstable();
            }
            closure = open;
        }
        let mut offsets = vec![0];
        let mut entries = Vec::new();
        for row in windings {
            entries.extend(row);
            offsets.push(entries.len() as u32);
        }
        Self { offsets, entries, closure }
    }

    /// For new cells their old ones: the same numbers, and all zero where there is no old one.
    pub(crate) fn of_some(&self, old_cells: &[Option<usize>]) -> Self {
        let mut out = Self { offsets: vec![0], entries: Vec::new(), closure: self.closure.clone() };
        for old in old_cells {
            out.entries.extend(old.iter().flat_map(|&old| self.of_cell(old)));
            out.offsets.push(out.entries.len() as u32);
        }
        out
    }

    /// Number of cells; of those of the plane only where there are regions.
    pub(crate) fn n_cells(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    /// The solids with a winding number other than zero in a cell.
    pub(crate) fn of_cell(&self, cell: usize) -> &[(u32, i32)] {
        if self.closure.is_empty() {
            return &[];
        }
        &self.entries[self.offsets[cell] as usize..self.offsets[cell + 1] as usize]
    }
}

/// For each cell but the exterior, in the order of a breadth-first walk: the cell, the one it is entered from, the
/// wall crossed and the sign of the crossing (+1 from front to back).
fn spanning_tree(n_cells: usize, cells_of_wall: &[[u32; 2]]) -> Vec<(u32, u32, u32, i32)> {
    let mut offsets = vec![0u32; n_cells + 1];
    for &cell in cells_of_wall.as_flattened() {
        offsets[cell as usize + 1] += 1;
    }
    for c in 0..n_cells {
        offsets[c + 1] += offsets[c];
    }
    let mut fill = offsets.clone();
    let mut walls = vec![0u32; 2 * cells_of_wall.len()];
    for (&cells, wall) in cells_of_wall.iter().zip(0..) {
        for cell in cells {
            walls[fill[cell as usize] as usize] = wall;
            fill[cell as usize] += 1;
        }
    }
    let mut seen = vec![false; n_cells];
    seen[0] = true;
    let mut order = vec![0u32];
    let mut tree = Vec::with_capacity(n_cells);
    let mut at = 0;
    while at < order.len() {
        let cell = order[at];
        at += 1;
        for &wall in &walls[offsets[cell as usize] as usize..offsets[cell as usize + 1] as usize] {
            let [front, back] = cells_of_wall[wall as usize];
            let (next, sign) = if front == cell { (back, 1) } else { (front, -1) };
            if !std::mem::replace(&mut seen[next as usize], true) {
                order.push(next);
                tree.push((next, cell, wall, sign));
            }
        }
    }
    tree
}

fn propagate(
    n_cells: usize,
    tree: &[(u32, u32, u32, i32)],
    walls: &Walls,
    value: impl Fn(&Jump) -> i32,
) -> Vec<Vec<(u32, i32)>> {
    let mut rows: Vec<Vec<(u32, i32)>> = vec![Vec::new(); n_cells];
    for &(cell, from, wall, sign) in tree {
        let mut row = rows[from as usize].clone();
        for jump in walls.of(wall) {
            let change = sign * value(jump);
            match row.binary_search_by_key(&jump.solid, |e| e.0) {
                _ if change == 0 => {}
                Ok(at) if row[at].1 + change == 0 => {
                    row.remove(at);
                }
                Ok(at) => row[at].1 += change,
                Err(at) => row.insert(at, (jump.solid, change)),
            }
        }
        rows[cell as usize] = row;
    }
    rows
}

/// Marks the solids whose numbers on the two sides of a wall differ by something else than its jump.
fn check_wall(
    rows: &[Vec<(u32, i32)>],
    [front, back]: [u32; 2],
    jumps: &[Jump],
    value: impl Fn(&Jump) -> i32,
    reduced: impl Fn(i32) -> i32,
    closure: &mut [Closure],
    mark: Closure,
) {
    let (a, b) = (&rows[front as usize], &rows[back as usize]);
    let in_row =
        |row: &[(u32, i32)], solid: u32| row.binary_search_by_key(&solid, |e| e.0).map_or(0, |i| row[i].1);
    let jump = |solid: u32| jumps.binary_search_by_key(&solid, |j| j.solid).map_or(0, |i| value(&jumps[i]));
    for solid in a.iter().chain(b).map(|e| e.0).chain(jumps.iter().map(|j| j.solid)) {
        if reduced(in_row(b, solid) - in_row(a, solid) - jump(solid)) != 0 {
            closure[solid as usize] = mark;
        }
    }
}
