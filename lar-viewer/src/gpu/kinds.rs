//! The kinds of geometry: their shaders, and how what these read lies in the buffers.

use super::elements::{Dot, KINDS, Line, Stroke, Vertex};
use super::shaders::{self, Sources};
use wgpu::{PrimitiveTopology, VertexAttribute, VertexStepMode};

/// One kind of geometry: entry points, topology, and the layout of what is read per vertex or instance.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub(super) sources: &'static Sources,
    /// The entry points begin with it.
    pub(super) name: &'static str,
    pub(super) topology: PrimitiveTopology,
    /// Bytes from one vertex or instance to the next.
    stride: usize,
    step: VertexStepMode,
    attributes: &'static [VertexAttribute],
}

impl Kind {
    pub(super) fn buffer(&self) -> wgpu::VertexBufferLayout<'static> {
        wgpu::VertexBufferLayout {
            array_stride: self.stride as u64,
            step_mode: self.step,
            attributes: self.attributes,
        }
    }
}

/// In the order of the kinds of `batch`.
pub(super) const ALL: [Kind; KINDS] = [
    Kind {
        sources: &shaders::MESH,
        name: "mesh",
        topology: PrimitiveTopology::TriangleList,
        stride: size_of::<Vertex>(),
        step: VertexStepMode::Vertex,
        attributes: &MESH_ATTRIBUTES,
    },
    Kind {
        sources: &shaders::LINES,
        name: "line",
        topology: PrimitiveTopology::TriangleStrip,
        stride: size_of::<Line>(),
        step: VertexStepMode::Instance,
        attributes: &LINE_ATTRIBUTES,
    },
    Kind {
        sources: &shaders::POINTS,
        name: "point",
        topology: PrimitiveTopology::TriangleStrip,
        stride: size_of::<Dot>(),
        step: VertexStepMode::Instance,
        attributes: &POINT_ATTRIBUTES,
    },
    Kind {
        sources: &shaders::LABELS,
        name: "label",
        topology: PrimitiveTopology::TriangleList,
        stride: size_of::<Stroke>(),
        step: VertexStepMode::Instance,
        attributes: &STROKE_ATTRIBUTES,
    },
];

/// What the mesh shader reads per vertex, in the order of the fields of `Vertex`.
const MESH_ATTRIBUTES: [VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Snorm16x4];
/// What the line shader reads per instance, in the order of the fields of `Line`.
const LINE_ATTRIBUTES: [VertexAttribute; 5] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Float32x3, 3 => Float32, 4 => Float32];
/// What the point shader reads per instance, in the order of the fields of `Dot`.
const POINT_ATTRIBUTES: [VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Float32];
/// What the label shader reads per instance, in the order of the fields of `Stroke`.
const STROKE_ATTRIBUTES: [VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Sint16x4, 3 => Float32];

#[cfg(test)]
mod tests {
    use super::*;
    use std::mem::offset_of;

    #[track_caller]
    fn check_offsets(attributes: &[VertexAttribute], offsets: &[usize], size: usize) {
        let read: Vec<_> = attributes.iter().map(|a| a.offset as usize).collect();
        assert_eq!(read, offsets);
        let end = attributes.iter().map(|a| a.offset + a.format.size()).max();
        assert_eq!(end, Some(size as u64));
    }

    #[test]
    fn attributes_lie_where_the_structs_have_their_fields() {
        let mesh = [offset_of!(Vertex, position), offset_of!(Vertex, part), offset_of!(Vertex, normal)];
        check_offsets(&MESH_ATTRIBUTES, &mesh, size_of::<Vertex>());
        let line = [offset_of!(Line, start), offset_of!(Line, part), offset_of!(Line, end)];
        let line = [&line[..], &[offset_of!(Line, width), offset_of!(Line, most)]].concat();
        check_offsets(&LINE_ATTRIBUTES, &line, size_of::<Line>());
        let point = [offset_of!(Dot, center), offset_of!(Dot, part), offset_of!(Dot, size)];
        check_offsets(&POINT_ATTRIBUTES, &point, size_of::<Dot>());
        let stroke = [offset_of!(Stroke, anchor), offset_of!(Stroke, part), offset_of!(Stroke, ends)];
        let stroke = [&stroke[..], &[offset_of!(Stroke, width)]].concat();
        check_offsets(&STROKE_ATTRIBUTES, &stroke, size_of::<Stroke>());
    }
}
