//! Disjoint sets of small integers; the representative is the smallest member, so results do not depend on the
//! order of the unions.

/// Disjoint sets over 0..n.
#[derive(Clone, Debug)]
pub(crate) struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    pub(crate) fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect() }
    }

    /// Smallest member of the set of x. Amortised O(log n) by path halving.
    pub(crate) fn find(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            let grandparent = self.parent[self.parent[x as usize] as usize];
            self.parent[x as usize] = grandparent;
            x = grandparent;
        }
        x
    }

    /// Smallest member of the set of x, without shortening the way to it.
    pub(crate) fn root(&self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            x = self.parent[x as usize];
        }
        x
    }

    /// Joins the sets of x and y; true when they were distinct.
    pub(crate) fn union(&mut self, x: u32, y: u32) -> bool {
        let (x, y) = (self.find(x), self.find(y));
        self.parent[x.max(y) as usize] = x.min(y);
        x != y
    }

    /// Number of each element's set; sets are numbered by their smallest members. Also the number of sets.
    pub(crate) fn labels(&mut self) -> (Vec<u32>, u32) {
        let mut labels = vec![0; self.parent.len()];
        let mut n = 0;
        for x in 0..self.parent.len() as u32 {
            let root = self.find(x);
            if root == x {
                labels[x as usize] = n;
                n += 1;
            } else {
                labels[x as usize] = labels[root as usize];
            }
        }
        (labels, n)
    }
}
