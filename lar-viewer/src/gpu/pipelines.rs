//! The fixed part of the renderer: bind group layouts and pipelines, made once per device.
//!
//! Each kind of geometry has three pipelines: *opaque*, with a depth test, *layer*, which stores fragments in the lists of
//! the A-buffer or sums them, and *id*, which tells what is seen where. Two more steps work on the whole screen.

use super::context::Transparency;
use super::elements::KINDS;
use super::kinds::{self, Kind};
use super::layouts::{
    SAMPLE_COLOR, bind_group_layout, frame_layout, layers_layout, pipeline_layout, sums_layout, texture_entry,
};
use super::scene::Way;
use super::shaders;
use wgpu::{BindGroupLayout, Device, PipelineLayout, RenderPipeline, TextureFormat};

/// Colour of samples and of the finished picture.
pub(crate) const COLOR: TextureFormat = TextureFormat::Rgba8Unorm;
/// Depth of the opaque surface, as the layer shaders read it: the bits of an f32, since OpenGL can neither load from
/// depth textures nor everywhere draw into textures of floats.
pub(crate) const OPAQUE_DEPTH: TextureFormat = TextureFormat::R32Uint;
/// What is seen: part plus one, and the index of the element in its buffer.
pub(crate) const ID: TextureFormat = TextureFormat::Rg32Uint;
/// Which solid is seen, for outlines.
pub(crate) const SOLID: TextureFormat = TextureFormat::R32Uint;
/// Sums and weights of layers.
pub(crate) const SUM: TextureFormat = TextureFormat::Rgba16Float;
/// Depth buffer of the opaque pass.
pub(crate) const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// The ways of drawing one kind of geometry.
pub(crate) struct Ways {
    opaque: RenderPipeline,
    layer: RenderPipeline,
    id: RenderPipeline,
    /// Of triangles only.
    solid: Option<RenderPipeline>,
}

impl Ways {
    pub(crate) fn pipeline(&self, way: Way) -> &RenderPipeline {
        match way {
            Way::Opaque => &self.opaque,
            Way::Layer => &self.layer,
            Way::Id => &self.id,
            Way::Solid => self.solid.as_ref().unwrap_or(&self.id),
        }
    }
}

/// Layouts and pipelines.
pub(crate) struct Pipelines {
    pub(crate) frame_layout: BindGroupLayout,
    pub(crate) layers_layout: BindGroupLayout,
    pub(crate) samples_layout: BindGroupLayout,
    /// In the order of the kinds of `batch`.
    pub(crate) kinds: [Ways; KINDS],
    pub(crate) resolve: RenderPipeline,
    pub(crate) reduce: RenderPipeline,
    pub(crate) outline_layout: BindGroupLayout,
    pub(crate) outline: RenderPipeline,
}

impl Pipelines {
    pub(crate) fn new(device: &Device, transparency: Transparency) -> Self {
        let frame_layout = frame_layout(device);
        let (layers_layout, resolve) = match transparency {
            Transparency::Sorted => (layers_layout(device), (shaders::RESOLVE, "resolve")),
            Transparency::Weighted => (sums_layout(device), (shaders::COMPOSE, "compose")),
        };
        let samples_layout = bind_group_layout(device, "samples", &[texture_entry(0, SAMPLE_COLOR)]);
        let solids = texture_entry(0, wgpu::TextureSampleType::Uint);
        let outline_layout = bind_group_layout(device, "solids", &[solids]);
        let outline = pipeline_layout(device, &[&frame_layout, &outline_layout]);
        let opaque = pipeline_layout(device, &[&frame_layout]);
        let layer = pipeline_layout(device, &[&frame_layout, &layers_layout]);
        let reduce = pipeline_layout(device, &[&frame_layout, &samples_layout]);
        // Summed layers read nothing but the frame.
        let layered = if transparency == Transparency::Sorted { &layer } else { &opaque };
        let maker = Maker { device, opaque: &opaque, layer: layered, transparency };
        Self {
            kinds: kinds::ALL.map(|kind| maker.ways(&kind)),
            resolve: whole_screen(device, resolve.0, resolve.1, &layer, Some(OVER)),
            reduce: whole_screen(device, shaders::REDUCE, "reduce", &reduce, None),
            outline: whole_screen(device, shaders::OUTLINE, "outline", &outline, None),
            outline_layout,
            frame_layout,
            layers_layout,
            samples_layout,
        }
    }
}

/// Front over back, with the front's colour multiplied by its coverage already.
const OVER: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;

/// Colours add up; what a layer lets through multiplies what those before it did. The same for both targets, as WebGL 2
/// asks for.
const SUMMED: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    },
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
        operation: wgpu::BlendOperation::Add,
    },
};

fn shader(device: &Device, source: &'static str) -> wgpu::ShaderModule {
    let source = wgpu::ShaderSource::Wgsl(source.into());
    device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
}

fn whole_screen(
    device: &Device,
    source: &'static str,
    entry: &str,
    layout: &PipelineLayout,
    blend: Option<wgpu::BlendState>,
) -> RenderPipeline {
    let module = shader(device, source);
    let target = wgpu::ColorTargetState { format: COLOR, blend, write_mask: wgpu::ColorWrites::ALL };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("whole_screen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(target)],
        }),
        multiview_mask: None,
        cache: None,
    })
}

struct Maker<'a> {
    device: &'a Device,
    opaque: &'a PipelineLayout,
    layer: &'a PipelineLayout,
    transparency: Transparency,
}

impl Maker<'_> {
    fn ways(&self, kind: &Kind) -> Ways {
        let target = |format, write_mask| Some(wgpu::ColorTargetState { format, blend: None, write_mask });
        let depth = wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        let opaque = [target(COLOR, wgpu::ColorWrites::ALL), target(OPAQUE_DEPTH, wgpu::ColorWrites::ALL)];
        let sum = || {
            let state = wgpu::ColorTargetState {
                format: SUM,
                blend: Some(SUMMED),
                write_mask: wgpu::ColorWrites::ALL,
            };
            Some(state)
        };
        let (source, layer, layer_depth) = match self.transparency {
            Transparency::Sorted => {
                (kind.sources.layer, vec![target(COLOR, wgpu::ColorWrites::empty())], None)
            }
            Transparency::Weighted => {
                let tested = wgpu::DepthStencilState { depth_write_enabled: Some(false), ..depth.clone() };
                (kind.sources.weighted, vec![sum(), sum()], Some(tested))
            }
        };
        let id = [target(ID, wgpu::ColorWrites::ALL)];
        let solids = [target(SOLID, wgpu::ColorWrites::ALL)];
        let solid = shader(self.device, kind.sources.solid);
        let layered = shader(self.device, source);
        Ways {
            opaque: self.pipeline(kind, &solid, "opaque", self.opaque, &opaque, Some(depth.clone())),
            layer: self.pipeline(kind, &layered, "layer", self.layer, &layer, layer_depth),
            solid: (kind.name == "mesh")
                .then(|| self.pipeline(kind, &solid, "solid", self.opaque, &solids, Some(depth.clone()))),
            id: self.pipeline(kind, &solid, "id", self.opaque, &id, Some(depth)),
        }
    }

    fn pipeline(
        &self,
        kind: &Kind,
        module: &wgpu::ShaderModule,
        way: &str,
        layout: &PipelineLayout,
        targets: &[Option<wgpu::ColorTargetState>],
        depth_stencil: Option<wgpu::DepthStencilState>,
    ) -> RenderPipeline {
        let (vertex, fragment) = (format!("{}_{way}_vertex", kind.name), format!("{}_{way}", kind.name));
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&fragment),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(&vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(kind.buffer())],
            },
            primitive: wgpu::PrimitiveState { topology: kind.topology, ..Default::default() },
            depth_stencil,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(&fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
