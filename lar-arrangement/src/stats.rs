//! What an arrangement cost: counts and stage times.

use std::time::Duration;

/// Counts and times of one arrangement.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Stats {
    /// Distance of neighbouring grid points, in the input's unit of length.
    pub grid_step: f64,
    /// Facets after snapping, deduplication and triangulation of polygons that are not planar.
    pub facets: u64,
    /// Input polygons that were triangulated.
    pub triangulated_polygons: u64,
    /// Input faces without an inside, which were left out.
    pub degenerate_faces: u64,
    /// Planes that nearly coplanar facets were put on.
    pub canonical_planes: u64,
    /// Points of the input that moved to lie on them, or to be one with another point.
    pub moved_points: u64,
    /// The farthest that one of them moved, in the input's unit of length.
    pub farthest_move: f64,
    /// Pairs of facets whose boxes meet and that are not known to be apart from what is around them.
    pub pairs_tested: u64,
    /// Pairs of facets with a point in common beyond shared corners.
    pub pairs_crossing: u64,
    /// Groups of overlapping coplanar facets.
    pub coplanar_groups: u64,
    /// Predicates that the `f64` filters left to exact integers.
    pub exact_fallbacks: u64,
    /// Time of each stage, in their order.
    pub stages: Vec<(&'static str, Duration)>,
}

impl Stats {
    /// Time of all stages.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.stages.iter().map(|s| s.1).sum()
    }
}
