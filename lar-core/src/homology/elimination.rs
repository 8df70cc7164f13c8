//! Gaussian elimination of a sparse matrix over a finite field, with pivots chosen for little fill-in.
//!
//! A column of one entry is a pivot that changes no other entry but those of its row; so is a row of one entry
//! for its column. They are taken first, for as long as there are any. Else the pivot is in a row of fewest
//! entries, in that row's shortest column (Markowitz's rule, one side of it).

use super::Matrix;
use super::field::Field;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

type Column = Vec<(u32, u32)>;

/// The pivots as (row, column). Their number is the rank; the rows are a row basis of the matrix, the columns
/// a column basis.
pub(super) fn pivots(matrix: Matrix, field: Field) -> Vec<(u32, u32)> {
    let mut state = Elimination::new(matrix, field);
    let mut pivots = Vec::new();
    while let Some((row, column)) = state.choose() {
        pivots.push((row, column));
        state.eliminate(row, column);
    }
    pivots
}

struct Elimination {
    field: Field,
    columns: Vec<Column>,
    /// The columns that have, or once had, an entry in each row; repetitions occur.
    rows: Vec<Vec<u32>>,
    /// The number of entries of each row.
    counts: Vec<u32>,
    /// Rows by number of entries; those whose number has changed since are skipped.
    queue: BinaryHeap<Reverse<(u32, u32)>>,
    /// Columns that have been seen with one entry.
    single: Vec<u32>,
}

impl Elimination {
    fn new(matrix: Matrix, field: Field) -> Self {
        let mut rows = vec![Vec::new(); matrix.n_rows];
        for (c, column) in (0..).zip(&matrix.columns) {
            for &(row, _) in column {
                rows[row as usize].push(c);
            }
        }
        let counts: Vec<u32> = rows.iter().map(|r| u32::try_from(r.len()).unwrap_or(u32::MAX)).collect();
        let queue = (0..).zip(&counts).filter(|e| *e.1 > 0).map(|(row, &n)| Reverse((n, row))).collect();
        let single = (0..).zip(&matrix.columns).filter(|e| e.1.len() == 1).map(|e| e.0).collect();
        Self { field, columns: matrix.columns, rows, counts, queue, single }
    }

    /// The next pivot; `None` when all entries are zero.
    fn choose(&mut self) -> Option<(u32, u32)> {
        while let Some(c) = self.single.pop() {
            if let [(row, _)] = self.columns[c as usize][..] {
                return Some((row, c));
            }
        }
        while let Some(Reverse((n, row))) = self.queue.pop() {
            if n > 0 && self.counts[row as usize] == n {
                let candidates = self.live(row).into_iter();
                return candidates.min_by_key(|&c| (self.columns[c as usize].len(), c)).map(|c| (row, c));
            }
        }
        None
    }

    /// The columns with an entry in `row`.
    fn live(&mut self, row: u32) -> Vec<u32> {
        let mut names = std::mem::take(&mut self.rows[row as usize]);
        names.sort_unstable();
        names.dedup();
        names.retain(|&c| entry(&self.columns[c as usize], row).is_some());
        self.rows[row as usize].clone_from(&names);
        names
    }

    /// Clears the row of the pivot by adding multiples of its column to the others, then drops both.
    fn eliminate(&mut self, row: u32, column: u32) {
        let others = self.live(row);
        let pivot = std::mem::take(&mut self.columns[column as usize]);
        let Some(x) = entry(&pivot, row) else { return };
        let minus_inverse = self.field.neg(self.field.inverse(x));
        for &(r, _) in &pivot {
            self.count(r, -1);
        }
        for c in others.into_iter().filter(|&c| c != column) {
            let old = std::mem::take(&mut self.columns[c as usize]);
            let factor = entry(&old, row).map_or(0, |y| self.field.mul(y, minus_inverse));
            self.columns[c as usize] = self.sum(c, &old, &pivot, factor);
            if self.columns[c as usize].len() == 1 {
                self.single.push(c);
            }
        }
        self.rows[row as usize] = Vec::new();
    }

    /// `old` + `factor` · `pivot` as column `c`, with the bookkeeping of the rows.
    fn sum(&mut self, c: u32, old: &[(u32, u32)], pivot: &[(u32, u32)], factor: u32) -> Column {
        let mut new = Column::with_capacity(old.len() + pivot.len());
        let mut at = 0;
        for &(row, x) in pivot {
            let before = old[at..].partition_point(|e| e.0 < row);
            new.extend_from_slice(&old[at..at + before]);
            at += before;
            let x = self.field.mul(factor, x);
            if old.get(at).is_some_and(|e| e.0 == row) {
                let sum = self.field.add(old[at].1, x);
                at += 1;
                if sum == 0 {
                    self.count(row, -1);
                } else {
                    new.push((row, sum));
                }
            } else {
                new.push((row, x));
                self.count(row, 1);
                self.rows[row as usize].push(c);
            }
        }
        new.extend_from_slice(&old[at..]);
        new
    }

    fn count(&mut self, row: u32, change: i32) {
        let n = &mut self.counts[row as usize];
        *n = n.saturating_add_signed(change);
        self.queue.push(Reverse((*n, row)));
    }
}

fn entry(column: &[(u32, u32)], row: u32) -> Option<u32> {
    column.binary_search_by_key(&row, |e| e.0).ok().map(|i| column[i].1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The rank by dense elimination.
    fn dense_rank(mut rows: Vec<Vec<u32>>, field: Field) -> usize {
        let mut rank = 0;
        for c in 0..rows.first().map_or(0, Vec::len) {
            let Some(r) = (rank..rows.len()).find(|&r| rows[r][c] != 0) else { continue };
            rows.swap(rank, r);
            let pivot = rows[rank].clone();
            for row in &mut rows[rank + 1..] {
                let factor = field.neg(field.mul(row[c], field.inverse(pivot[c])));
                for (x, &y) in row.iter_mut().zip(&pivot) {
                    *x = field.add(*x, field.mul(factor, y));
                }
            }
            rank += 1;
        }
        rank
    }

    proptest! {
        #[test]
        fn rank_is_that_of_dense_elimination(
            entries in prop::collection::vec(prop::collection::vec(-4..4_i8, 9), 1..12),
            prime in prop::sample::select(vec![2, 3, 7, 2_147_483_647]),
        ) {
            let field = Field::new(prime).unwrap();
            let dense: Vec<Vec<u32>> = entries
                .iter()
                .map(|row| row.iter().map(|&x| if x.abs() > 2 { field.element(x) } else { 0 }).collect())
                .collect();
            let column = |c: usize| (0..).zip(&dense).map(|(r, row)| (r, row[c])).filter(|e| e.1 != 0).collect();
            let matrix = Matrix { n_rows: dense.len(), columns: (0..9).map(column).collect() };
            let found = pivots(matrix, field);
            prop_assert_eq!(found.len(), dense_rank(dense.clone(), field));
            let minor = found
                .iter()
                .map(|&(r, _)| found.iter().map(|&(_, c)| dense[r as usize][c as usize]).collect())
                .collect();
            prop_assert_eq!(dense_rank(minor, field), found.len());
        }
    }
}
