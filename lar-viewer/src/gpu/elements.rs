//! What the buffers of a scene hold: triangles, segments, dots and strokes as the shaders read them.

use bytemuck::{Pod, Zeroable};

/// Vertex of a triangle; the normal is in units of 1/32767.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 3],
    pub(crate) part: u32,
    pub(crate) normal: [i16; 4],
}

/// A segment.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Line {
    pub(crate) start: [f32; 3],
    pub(crate) part: u32,
    pub(crate) end: [f32; 3],
    pub(crate) width: f32,
    /// The most that the width may be, as a length in the scene.
    pub(crate) most: f32,
}

/// A dot.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Dot {
    pub(crate) center: [f32; 3],
    pub(crate) part: u32,
    pub(crate) size: f32,
}

/// A stroke of a label.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Stroke {
    /// Where the label is.
    pub(crate) anchor: [f32; 3],
    pub(crate) part: u32,
    /// Both ends relative to it, x to the right and y up, in units of 1/16 pixel.
    pub(crate) ends: [i16; 4],
    /// Pixels; negative for what is drawn over everything.
    pub(crate) width: f32,
}

/// Kinds of geometry, as indices of arrays.
pub(crate) const MESH: usize = 0;
pub(crate) const LINES: usize = 1;
pub(crate) const POINTS: usize = 2;
pub(crate) const STROKES: usize = 3;
/// Number of kinds.
pub(crate) const KINDS: usize = 4;
/// Vertices of one instance of each kind; triangles are drawn by their vertices. A stroke has a rim under its core.
pub(crate) const VERTICES: [u32; KINDS] = [3, 4, 4, 12];

/// Bytes of one element of each kind; a triangle is an element.
pub(crate) const ELEMENT_BYTES: [usize; KINDS] =
    [3 * size_of::<Vertex>(), size_of::<Line>(), size_of::<Dot>(), size_of::<Stroke>()];
