//! What an arrangement or a Boolean can refuse, and why.

use crate::progress::Cancelled;
use lar_core::{FaceId, VertexId};

/// Why an operation was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArrangementError {
    /// A surface that does not live in 3-space.
    #[error("{solid}: points of {dim} coordinates, an arrangement in space needs 3")]
    Dimension {
        /// Name of the surface.
        solid: String,
        /// Its number of coordinates.
        dim: usize,
    },
    /// A coordinate that is NaN or infinite.
    #[error("{solid}: vertex {vertex} has the coordinate {value}")]
    NotFinite {
        /// Name of the surface.
        solid: String,
        /// The vertex.
        vertex: VertexId,
        /// The coordinate.
        value: f64,
    },
    /// A face that names a vertex that does not exist.
    #[error("{solid}: face {face} names vertex {vertex}, but there are {n_vertices} vertices")]
    NoSuchVertex {
        /// Name of the surface.
        solid: String,
        /// The face.
        face: FaceId,
        /// The vertex that it names.
        vertex: VertexId,
        /// How many there are.
        n_vertices: usize,
    },
    /// A drawing that does not live in the plane.
    #[error("points of {dim} coordinates, a planar arrangement needs 2")]
    PlanarDimension {
        /// Its number of coordinates.
        dim: usize,
    },
    /// A segment that names a point that does not exist.
    #[error("segment {segment} names point {vertex}, but there are {n_vertices} points")]
    NoSuchPoint {
        /// The segment.
        segment: usize,
        /// The point that it names.
        vertex: VertexId,
        /// How many there are.
        n_vertices: usize,
    },
    /// The thread pool could not be started.
    #[error("{threads} threads cannot be started: {reason}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system said.
        reason: String,
    },
    /// It was asked to stop ([`Cancel`](crate::Cancel)).
    #[error("cancelled")]
    Cancelled,
    /// A post-condition that does not hold: a bug of this crate.
    #[error("internal error after stage {stage}: {what}")]
    PostCondition {
        /// The stage.
        stage: &'static str,
        /// What does not hold.
        what: String,
    },
}

impl From<Cancelled> for ArrangementError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
