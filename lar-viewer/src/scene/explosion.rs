//! Explosion: how far groups move, level by level.
//!
//! A group of level 0 moves by (s₀ − 1) × (its centroid − the fixed point), per axis; a group inside another moves with
//! it and, by its own level's factors, away from the other's centroid. So a solid, its cells, their faces and the edges of
//! those are pulled apart one after the other or all at once, by four triples of numbers and no change of the scene.

/// Levels of nested groups: parent solid, cell, face, edge.
pub const LEVELS: usize = 4;

/// Factors of an explosion. Three factors alone are those of level 0.
///
/// ```
/// use lar_viewer::Explosion;
/// let still = Explosion::default();
/// assert_eq!(still, [1.0; 3].into());
/// let nested = still.level(1, [1.5; 3]).about([0.0; 3]);
/// assert_eq!(nested.factors[1], [1.5; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explosion {
    /// Factors x, y, z for the groups of each level, outermost first; 1 leaves them in place.
    pub factors: [[f32; 3]; LEVELS],
    /// The fixed point; the scene's centre when `None`.
    pub about: Option<[f64; 3]>,
}

impl Default for Explosion {
    /// Nothing moves.
    fn default() -> Self {
        Self { factors: [[1.0; 3]; LEVELS], about: None }
    }
}

impl From<[f32; 3]> for Explosion {
    fn from(factors: [f32; 3]) -> Self {
        Self::default().level(0, factors)
    }
}

impl Explosion {
    /// With these factors for the groups of one level; levels beyond the last are ignored.
    #[must_use]
    pub fn level(mut self, level: usize, factors: [f32; 3]) -> Self {
        if let Some(of_level) = self.factors.get_mut(level) {
            *of_level = factors;
        }
        self
    }

    /// About this point.
    #[must_use]
    pub fn about(self, point: [f64; 3]) -> Self {
        Self { about: Some(point), ..self }
    }

    /// How far a group moves, given its centroid and those of the groups around it, outermost first.
    pub(crate) fn displacement(&self, centroids: &[[f64; 3]], center: [f64; 3]) -> [f64; 3] {
        let mut from = self.about.unwrap_or(center);
        let mut moved = [0.0; 3];
        for (centroid, factors) in centroids.iter().zip(self.factors) {
            moved =
                std::array::from_fn(|k| moved[k] + (f64::from(factors[k]) - 1.0) * (centroid[k] - from[k]));
            from = *centroid;
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(explosion: Explosion, centroids: &[[f64; 3]], expected: [f64; 3]) {
        assert_eq!(explosion.displacement(centroids, [1.0, 0.0, 0.0]), expected);
    }

    #[test]
    fn inner_groups_move_with_the_outer_ones() {
        let outer = Explosion::from([3.0, 1.0, 1.0]);
        check(outer, &[], [0.0; 3]);
        check(outer, &[[2.0, 5.0, 0.0]], [2.0, 0.0, 0.0]);
        check(outer, &[[2.0, 5.0, 0.0], [9.0; 3]], [2.0, 0.0, 0.0]);
        check(outer.level(1, [1.0, 2.0, 1.0]), &[[2.0, 5.0, 0.0], [9.0; 3]], [2.0, 4.0, 0.0]);
        check(outer.about([0.0; 3]), &[[2.0, 5.0, 0.0]], [4.0, 0.0, 0.0]);
    }
}
