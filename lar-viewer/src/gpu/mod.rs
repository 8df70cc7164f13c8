//! Everything that talks to the graphics card.

pub(crate) mod batch;
pub(crate) mod context;
pub(crate) mod cull;
pub(crate) mod frame;
pub(crate) mod layers;
pub(crate) mod parts;
pub(crate) mod picking;
pub(crate) mod pipelines;
pub(crate) mod renderer;
pub(crate) mod scene;
pub(crate) mod shaders;
pub(crate) mod table;
pub(crate) mod targets;
