//! The textures that a frame is drawn into.

use super::context::{Context, Transparency};
use super::frame::Raster;
use super::pipelines::{COLOR, DEPTH, OPAQUE_DEPTH, Pipelines, SOLID, SUM};
use wgpu::{Texture, TextureUsages, TextureView};

/// Textures of one size: three of samples and the finished picture.
pub(crate) struct Targets {
    pub(crate) raster: Raster,
    pub(crate) color: TextureView,
    pub(crate) opaque_depth: TextureView,
    pub(crate) depth: TextureView,
    pub(crate) picture: Texture,
    pub(crate) picture_view: TextureView,
    pub(crate) samples: wgpu::BindGroup,
    /// Where layers are summed rather than sorted.
    pub(crate) sums: Option<Sums>,
    /// Where outlines are drawn.
    pub(crate) outlines: Option<Outlines>,
}

/// Which solid is seen at each sample, 0 where none is, and the group that reads it.
pub(crate) struct Outlines {
    pub(crate) solids: TextureView,
    pub(crate) group: wgpu::BindGroup,
}

impl Outlines {
    fn new(context: &Context, pipelines: &Pipelines, size: [u32; 2]) -> Self {
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let solids = view(&texture(context, size, SOLID, usage));
        let group = context.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("solids"),
            layout: &pipelines.outline_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&solids),
            }],
        });
        Self { solids, group }
    }
}

/// Textures for sums and weights of layers, and the group that reads them.
pub(crate) struct Sums {
    pub(crate) views: [TextureView; 2],
    pub(crate) group: wgpu::BindGroup,
}

impl Sums {
    fn new(context: &Context, pipelines: &Pipelines, size: [u32; 2]) -> Self {
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let views = [(); 2].map(|()| view(&texture(context, size, SUM, usage)));
        let entry = |binding: usize| wgpu::BindGroupEntry {
            binding: binding as u32,
            resource: wgpu::BindingResource::TextureView(&views[binding]),
        };
        let group = context.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("sums"),
            layout: &pipelines.layers_layout,
            entries: &[entry(0), entry(1)],
        });
        Self { views, group }
    }
}

impl Targets {
    pub(crate) fn new(context: &Context, pipelines: &Pipelines, raster: Raster, outlined: bool) -> Self {
        let drawn = TextureUsages::RENDER_ATTACHMENT;
        let size = raster.size();
        let color = view(&texture(context, size, COLOR, drawn | TextureUsages::TEXTURE_BINDING));
        let opaque_depth =
            view(&texture(context, size, OPAQUE_DEPTH, drawn | TextureUsages::TEXTURE_BINDING));
        let depth = view(&texture(context, size, DEPTH, drawn));
        let usage = drawn | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        let picture = texture(context, [raster.width, raster.height], COLOR, usage);
        let samples = context.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("samples"),
            layout: &pipelines.samples_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&color),
            }],
        });
        let picture_view = view(&picture);
        let weighted = context.transparency == Transparency::Weighted;
        let sums = weighted.then(|| Sums::new(context, pipelines, size));
        let outlines = outlined.then(|| Outlines::new(context, pipelines, size));
        Self { raster, color, opaque_depth, depth, picture, picture_view, samples, sums, outlines }
    }
}

pub(super) fn texture(
    context: &Context,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: TextureUsages,
) -> Texture {
    context.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

pub(super) fn view(texture: &Texture) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
