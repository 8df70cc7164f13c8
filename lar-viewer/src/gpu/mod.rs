//! Everything that talks to the graphics card.

pub(crate) mod batch;
pub(crate) mod context;
pub(crate) mod cull;
pub(crate) mod elements;
pub(crate) mod frame;
mod kinds;
pub(crate) mod layers;
mod layouts;
pub(crate) mod parts;
mod passes;
pub(crate) mod picking;
pub(crate) mod pipelines;
pub(crate) mod renderer;
pub(crate) mod scene;
pub(crate) mod shaders;
mod shared;
pub(crate) mod table;
pub(crate) mod targets;
pub(crate) mod traffic;
