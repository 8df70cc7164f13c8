//! What the passes of a picture and of picking share.

use super::context::Context;
use super::elements;
use super::frame::{Frame, Raster};
use super::pipelines::Pipelines;
use super::scene::{Run, SceneBuffers, Way};
use crate::{Bounds, View, ViewerError};
use wgpu::{BindGroup, BufferUsages, LoadOp, Operations, RenderPass, StoreOp};

/// Distance of the frames of two bands in the uniform buffer: a multiple of 256, the largest alignment that any adapter
/// asks for.
pub(super) const FRAME_STRIDE: usize = 512;
/// The parameters of a frame of scenes that share a placement, one for each scene.
pub(super) fn frames(view: &View, raster: &Raster, scenes: &[&SceneBuffers]) -> Vec<Frame> {
    let bounds = scenes.iter().filter_map(|s| s.extents.bounds(&view.explode)).reduce(Bounds::union);
    let mut first_part = 0;
    let frame = |scene: &&SceneBuffers| {
        let frame = Frame { first_part, ..Frame::new(view, raster, &scene.placement, bounds) };
        first_part += scene.n_parts();
        frame
    };
    scenes.iter().map(frame).collect()
}

/// A texture to draw into.
pub(super) fn attachment(
    view: &wgpu::TextureView,
    load: LoadOp<wgpu::Color>,
) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    let ops = Operations { load, store: StoreOp::Store };
    Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
}

/// The group of these frames, at multiples of [`FRAME_STRIDE`], and of the tables of the scene.
pub(super) fn frame_group(
    context: &Context,
    pipelines: &Pipelines,
    scene: &SceneBuffers,
    frames: &[Frame],
) -> Result<BindGroup, ViewerError> {
    let mut bytes = vec![0; FRAME_STRIDE * frames.len()];
    for (slot, frame) in bytes.chunks_exact_mut(FRAME_STRIDE).zip(frames) {
        slot[..size_of::<Frame>()].copy_from_slice(bytemuck::bytes_of(frame));
    }
    let buffer = context.upload("frame", &bytes, BufferUsages::UNIFORM)?;
    let size = wgpu::BufferSize::new(size_of::<Frame>() as u64);
    let frame = wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: &buffer, offset: 0, size });
    let table = wgpu::BindingResource::TextureView;
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    Ok(context.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout: &pipelines.frame_layout,
        entries: &[entry(0, frame), entry(1, table(&scene.parts.view)), entry(2, table(&scene.groups.view))],
    }))
}

/// Draws stretches of elements: triangles by their vertices, all else as a few corners an instance.
pub(super) fn draw_runs(
    pass: &mut RenderPass<'_>,
    context: &Context,
    pipelines: &Pipelines,
    scene: &SceneBuffers,
    way: Way,
    runs: &[Run],
) {
    context.count(|traffic| traffic.draw_calls += runs.len() as u64);
    for Run { kind, chunk, elements } in runs {
        pass.set_pipeline(pipelines.kinds[*kind].pipeline(way));
        pass.set_vertex_buffer(0, scene.chunks[*kind][*chunk].slice(..));
        if *kind == elements::MESH {
            pass.draw(3 * elements.start..3 * elements.end, 0..1);
        } else {
            pass.draw(0..elements::VERTICES[*kind], elements.clone());
        }
    }
}
