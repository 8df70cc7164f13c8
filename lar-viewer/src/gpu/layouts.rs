//! Layouts of what shaders read: bind groups and pipelines.

use super::frame::Frame;
use wgpu::{BindGroupLayout, Device, PipelineLayout, ShaderStages};

/// The parameters of the frame and the tables of a scene.
pub(super) fn frame_layout(device: &Device) -> BindGroupLayout {
    let frame = wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: wgpu::BufferSize::new(size_of::<Frame>() as u64),
        },
        count: None,
    };
    let table = |binding| wgpu::BindGroupLayoutEntry {
        visibility: ShaderStages::VERTEX,
        ..texture_entry(binding, wgpu::TextureSampleType::Uint)
    };
    bind_group_layout(device, "frame", &[frame, table(1), table(2)])
}

/// The lists of layers, and the depth of what is opaque.
pub(super) fn layers_layout(device: &Device) -> BindGroupLayout {
    bind_group_layout(
        device,
        "layers",
        &[writable(0), writable(1), writable(2), texture_entry(3, wgpu::TextureSampleType::Uint)],
    )
}

/// The sums of layers and their weights.
pub(super) fn sums_layout(device: &Device) -> BindGroupLayout {
    bind_group_layout(device, "sums", &[texture_entry(0, SAMPLE_COLOR), texture_entry(1, SAMPLE_COLOR)])
}

fn writable(binding: u32) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BufferBindingType::Storage { read_only: false };
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::FRAGMENT, ty, count: None }
}

/// What the shader that averages samples reads.
pub(super) const SAMPLE_COLOR: wgpu::TextureSampleType = wgpu::TextureSampleType::Float { filterable: false };

/// A texture that fragment shaders read.
pub(super) fn texture_entry(
    binding: u32,
    sample_type: wgpu::TextureSampleType,
) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::FRAGMENT, ty, count: None }
}

/// A layout of these entries.
pub(super) fn bind_group_layout(
    device: &Device,
    label: &str,
    entries: &[wgpu::BindGroupLayoutEntry],
) -> BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
}

/// A pipeline's layout of these groups.
pub(super) fn pipeline_layout(device: &Device, groups: &[&BindGroupLayout]) -> PipelineLayout {
    let groups: Vec<_> = groups.iter().copied().map(Some).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &groups,
        immediate_size: 0,
    })
}
