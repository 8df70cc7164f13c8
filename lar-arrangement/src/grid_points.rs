//! Numbers of grid points by their coordinates.

/// Open addressing: at least half of the slots are empty.
#[derive(Debug, Default)]
pub(crate) struct PointTable {
    /// 0, or 32 bits of the hash above the point's number + 1.
    slots: Vec<u64>,
}

impl PointTable {
    /// A table for at most `n` points.
    pub(crate) fn with_capacity(n: usize) -> Self {
        Self { slots: vec![0; (2 * n).next_power_of_two().max(2)] }
    }

    /// The number of a point; a new one is appended to `points`. O(1) expected.
    pub(crate) fn number(&mut self, point: [i64; 3], points: &mut Vec<[i64; 3]>) -> u32 {
        match self.slot(point, |id| points[id as usize]) {
            Ok(id) => id,
            Err(slot) => {
                points.push(point);
                self.fill(slot, point, points.len() as u32 - 1);
                points.len() as u32 - 1
            }
        }
    }

    /// Adds a point that is not there yet, by its number; `at` gives the coordinates of the others.
    pub(crate) fn insert(&mut self, point: [i64; 3], id: u32, at: impl Fn(u32) -> [i64; 3]) {
        if let Err(slot) = self.slot(point, at) {
            self.fill(slot, point, id);
        }
    }

    /// The number of the point with these coordinates; `at` gives those of a number.
    pub(crate) fn find(&self, point: [i64; 3], at: impl Fn(u32) -> [i64; 3]) -> Option<u32> {
        if self.slots.is_empty() { None } else { self.slot(point, at).ok() }
    }

    fn fill(&mut self, slot: usize, point: [i64; 3], id: u32) {
        self.slots[slot] = tag(hash(point)) | (u64::from(id) + 1);
    }

    /// The number of a point, or the empty slot where it belongs.
    fn slot(&self, point: [i64; 3], at: impl Fn(u32) -> [i64; 3]) -> Result<u32, usize> {
        let hash = hash(point);
        let mask = self.slots.len() - 1;
        let mut slot = (hash >> (64 - mask.count_ones())) as usize;
        loop {
            match self.slots[slot] {
                0 => return Err(slot),
                entry if entry & TAG == tag(hash) && at((entry & !TAG) as u32 - 1) == point => {
                    return Ok((entry & !TAG) as u32 - 1);
                }
                _ => slot = (slot + 1) & mask,
            }
        }
    }
}

const TAG: u64 = 0xffff_ffff << 32;

fn tag(hash: u64) -> u64 {
    hash << 32 & TAG
}

/// Coordinates are often multiples of a high power of two: each factor's high bits come down before the next.
pub(crate) fn hash<const N: usize>(point: [i64; N]) -> u64 {
    let mixed = point
        .iter()
        .fold(0u64, |hash, &x| (hash.rotate_left(32) ^ x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (mixed ^ mixed >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_numbered_in_the_order_in_which_they_come() {
        // All on a coarse lattice, so that the low bits are equal.
        let lattice = |i: u64| [i % 7, i / 7 % 7, i / 49].map(|x| (x as i64 - 3) << 37);
        let mut table = PointTable::with_capacity(343);
        let mut points = Vec::new();
        for round in 0..2 {
            for i in 0..343 {
                assert_eq!(table.number(lattice(i), &mut points), i as u32, "round {round}");
            }
        }
        assert_eq!(points.len(), 343);
        assert_eq!(table.find(lattice(200), |id| points[id as usize]), Some(200));
        assert_eq!(table.find([1, 2, 3], |id| points[id as usize]), None);
        assert_eq!(PointTable::default().find([0; 3], |_| [0; 3]), None);
    }
}
