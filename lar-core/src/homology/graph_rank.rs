//! The rank of a matrix whose lines have at most two entries: a graph with a weight on each edge.
//!
//! Read a line a·x_i + b·x_j as an equation = 0. It makes x_j a multiple of x_i, or, where a chain of equations
//! did so already with another factor, makes both zero. A line is independent of those before it when its
//! equation says something new. Disjoint sets with factors keep what is said.

use super::field::Field;

/// Indices of lines that are independent and span all others: the first ones possible. A line has at most two
/// (unknown, factor) pairs, factors other than zero, unknowns below `n_unknowns`. O(n α(n)) field operations.
pub(super) fn independent_lines<'a>(
    n_unknowns: usize,
    lines: impl Iterator<Item = &'a [(u32, u32)]>,
    field: Field,
) -> Vec<u32> {
    let mut sets = Multiples::new(n_unknowns, field);
    (0..).zip(lines).filter(|(_, line)| sets.adds(line)).map(|(index, _)| index).collect()
}

/// Unknowns that are multiples of each other.
struct Multiples {
    field: Field,
    parents: Vec<u32>,
    /// x_i = factor[i] · x_parent.
    factors: Vec<u32>,
    sizes: Vec<u32>,
    /// Of each root: known to be zero.
    zero: Vec<bool>,
}

impl Multiples {
    fn new(n: usize, field: Field) -> Self {
        let parents = (0..u32::try_from(n).expect("cells are numbered by u32")).collect();
        Self { field, parents, factors: vec![1; n], sizes: vec![1; n], zero: vec![false; n] }
    }

    /// Adds an equation; true when it says something new.
    fn adds(&mut self, line: &[(u32, u32)]) -> bool {
        match *line {
            [(i, _)] => {
                let (root, _) = self.find(i);
                !std::mem::replace(&mut self.zero[root as usize], true)
            }
            [(i, a), (j, b)] => {
                let ((i, f), (j, g)) = (self.find(i), self.find(j));
                self.relate((i, self.field.mul(a, f)), (j, self.field.mul(b, g)))
            }
            _ => false,
        }
    }

    /// a·x_i + b·x_j = 0 for two roots.
    fn relate(&mut self, (i, a): (u32, u32), (j, b): (u32, u32)) -> bool {
        let zero = self.zero[i as usize];
        if i == j {
            return self.field.add(a, b) != 0 && !std::mem::replace(&mut self.zero[i as usize], true);
        }
        if zero && self.zero[j as usize] {
            return false;
        }
        let ((i, a), (j, b)) =
            if self.sizes[i as usize] < self.sizes[j as usize] { ((j, b), (i, a)) } else { ((i, a), (j, b)) };
        self.parents[j as usize] = i;
        self.factors[j as usize] = self.field.neg(self.field.mul(a, self.field.inverse(b)));
        self.sizes[i as usize] += self.sizes[j as usize];
        self.zero[i as usize] |= self.zero[j as usize];
        true
    }

    /// The root of `i` and the factor of x_i in terms of it; halves the path.
    fn find(&mut self, mut i: u32) -> (u32, u32) {
        let mut factor = 1;
        while self.parents[i as usize] != i {
            let parent = self.parents[i as usize] as usize;
            let own = self.field.mul(self.factors[i as usize], self.factors[parent]);
            if self.parents[parent] as usize != parent {
                self.parents[i as usize] = self.parents[parent];
                self.factors[i as usize] = own;
            }
            factor = self.field.mul(factor, self.factors[i as usize]);
            i = self.parents[i as usize];
        }
        (i, factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(prime: u32, lines: &[&[(u32, i8)]], expected: &[u32]) {
        let field = Field::new(prime).unwrap();
        let lines: Vec<Vec<(u32, u32)>> =
            lines.iter().map(|line| line.iter().map(|&(i, x)| (i, field.element(x))).collect()).collect();
        assert_eq!(independent_lines(5, lines.iter().map(|l| &l[..]), field), expected);
    }

    #[test]
    fn cycles() {
        let balanced: [&[(u32, i8)]; 3] = [&[(0, -1), (1, 1)], &[(1, -1), (2, 1)], &[(0, -1), (2, 1)]];
        check(7, &balanced, &[0, 1]);
        let twisted: [&[(u32, i8)]; 3] = [&[(0, -1), (1, 1)], &[(1, -1), (2, 1)], &[(0, 1), (2, 1)]];
        check(7, &twisted, &[0, 1, 2]);
        check(2, &twisted, &[0, 1]);
        check(5, &[&[(0, 1), (1, 2)], &[(0, 2), (1, 4)], &[(0, 2), (1, 3)]], &[0, 2]);
    }

    #[test]
    fn zeros_spread() {
        check(
            3,
            &[&[(0, 1)], &[(0, 1), (1, 1)], &[(1, 1)], &[], &[(2, 1), (3, 1)], &[(3, 1), (1, 1)], &[(2, 1)]],
            &[0, 1, 4, 5],
        );
        check(3, &[&[(0, 1)], &[(1, 1)], &[(0, 1), (1, 1)]], &[0, 1]);
    }
}
