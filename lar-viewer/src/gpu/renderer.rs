//! The renderer of window and off-screen pictures alike.
//!
//! A frame is drawn at several samples per pixel and averaged at the end, in these passes:
//!
//! 1. *opaque*: triangles, lines and points with a depth test, into a colour and a depth texture;
//! 2. *layers*: everything transparent, each fragment in front of the opaque surface into the list of its sample;
//! 3. *resolve*: the lists sorted by depth and blended over the opaque colour;
//! 4. *reduce*: samples to pixels.
//!
//! Where an adapter has no storage buffers that fragments can write (WebGL 2), the second pass sums layers by weight and
//! the third takes the mean.
//!
//! Supersampling, not multisampling: with lists per sample, transparent outlines, lines and points become as smooth
//! as opaque ones, the depth texture can be read on every backend, and 1 to 8 samples a side can be had where
//! multisampling offers only four in all. On the software drivers that servers draw with, four multisamples cost no
//! less than four whole samples: 70 to 90 ms against 15 ms for a thousand triangles at 1280 × 720, 230 to 310 ms
//! against 40 ms for a hundred thousand (llvmpipe, two cores; `examples/frame_times.rs` measures again). Three by
//! three, the default, takes 30 and 60 ms, and 200 and 300 ms when everything is transparent.

use super::batch;
use super::context::Context;
use super::cull::Frustum;
use super::frame::{Frame, Raster};
use super::layers::{Band, DEFAULT_MEMORY, Layers};
use super::pipelines::Pipelines;
use super::scene::{Run, SceneBuffers, Way};
use super::targets::{Sums, Targets};
use crate::{Image, View, ViewerError};
use wgpu::{BufferUsages, CommandEncoder, LoadOp, Operations, RenderPass, StoreOp};

/// Distance of the frames of two bands in the uniform buffer: a multiple of 256, the largest alignment that any adapter
/// asks for.
const FRAME_STRIDE: usize = 512;
/// The bits of the depth 1.
const FARTHEST: wgpu::Color = wgpu::Color { r: 0x3f80_0000_u32 as f64, g: 0.0, b: 0.0, a: 0.0 };
/// Samples in one frame at most: their textures take 12 bytes each.
const SAMPLE_LIMIT: u64 = 1 << 26;

/// Draws scenes into textures.
pub(crate) struct Renderer {
    pub(crate) context: Context,
    pub(super) pipelines: Pipelines,
    targets: Option<Targets>,
    layers: Option<Layers>,
    /// Bytes that stored layers may take.
    layer_memory: u64,
}

impl Renderer {
    pub(crate) fn new(context: Context) -> Result<Self, ViewerError> {
        let pipelines = Pipelines::new(&context.device, context.transparency);
        context.check()?;
        Ok(Self { context, pipelines, targets: None, layers: None, layer_memory: DEFAULT_MEMORY })
    }

    /// Draws the scene and returns the picture, `width` × `height` pixels of 8-bit RGBA.
    pub(crate) fn draw(
        &mut self,
        scene: &SceneBuffers,
        view: &View,
        width: u32,
        height: u32,
    ) -> Result<&Targets, ViewerError> {
        view.validate()?;
        let raster = self.raster(view, width, height)?;
        let targets = match self.targets.take() {
            Some(targets) if targets.raster == raster => targets,
            _ => {
                self.layers = None;
                Targets::new(&self.context, &self.pipelines, raster)
            }
        };
        let frame = Frame::new(view, &raster, &scene.placement, scene.extents.bounds(&view.explode));
        let frustum = Frustum::new(&frame);
        let [opaque, layer] = [Way::Opaque, Way::Layer].map(|way| scene.runs(way, view.opacity, &frustum));
        let draw = Draw { renderer: self, scene, view, frame, targets: &targets, opaque, layer };
        let layers = match (&draw.layer[..], &targets.sums) {
            ([], _) => draw.without_layers()?,
            (_, Some(sums)) => draw.with_sums(sums)?,
            (_, None) => draw.with_layers()?,
        };
        self.layers = layers.or(self.layers.take());
        Ok(self.targets.insert(targets))
    }

    /// Allows this many bytes for layers from the next frame on.
    pub(crate) fn set_layer_memory(&mut self, bytes: u64) {
        self.layer_memory = bytes;
        self.layers = None;
    }

    /// The pixels of the picture that was drawn last.
    pub(crate) fn read_picture(&self) -> Result<Image, ViewerError> {
        let Some(targets) = &self.targets else { return Ok(Image::new(0, 0, Vec::new())) };
        let Raster { width, height, .. } = targets.raster;
        let row_bytes = 4 * width;
        let padded = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.context.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(padded) * u64::from(height),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let mut encoder =
            self.context.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            targets.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            size,
        );
        self.context.queue.submit([encoder.finish()]);
        let rows = |bytes: &[u8]| {
            bytes.chunks_exact(padded as usize).flat_map(|row| &row[..row_bytes as usize]).copied().collect()
        };
        Ok(Image::from_premultiplied(width, height, self.context.read(&buffer, rows)?))
    }

    /// The size in samples, the finest that the adapter allows up to what the view asks for.
    pub(super) fn raster(&self, view: &View, width: u32, height: u32) -> Result<Raster, ViewerError> {
        let limit = self.context.limits.max_texture_dimension_2d;
        if !(1..=limit).contains(&width) || !(1..=limit).contains(&height) {
            return Err(ViewerError::ImageSize {
                width,
                height,
                limit,
                adapter: self.context.adapter_name.clone(),
            });
        }
        let fits = |s: &u32| {
            let (w, h) = (u64::from(width * s), u64::from(height * s));
            w.max(h) <= u64::from(limit) && w * h <= SAMPLE_LIMIT
        };
        let samples = (1..=view.samples).rev().find(fits).unwrap_or(1);
        Ok(Raster { width, height, samples, scale: view.scale })
    }
}

/// The drawing of one frame.
struct Draw<'a> {
    renderer: &'a Renderer,
    scene: &'a SceneBuffers,
    view: &'a View,
    frame: Frame,
    targets: &'a Targets,
    opaque: Vec<Run>,
    layer: Vec<Run>,
}

impl Draw<'_> {
    fn without_layers(&self) -> Result<Option<Layers>, ViewerError> {
        let group = self.frame_group(&[Band { row: 0, rows: 0 }], 0)?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &group);
        self.reduce_pass(&mut encoder, &group);
        self.submit(encoder)?;
        Ok(None)
    }

    /// Draws with the layers summed.
    fn with_sums(&self, sums: &Sums) -> Result<Option<Layers>, ViewerError> {
        let group = self.frame_group(&[Band { row: 0, rows: 0 }], 0)?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &group);
        self.sum_pass(&mut encoder, &group, sums);
        {
            let whole = Band { row: 0, rows: self.targets.raster.size()[1] };
            let mut pass = self.band_pass(&mut encoder, "compose", whole);
            pass.set_bind_group(0, &group, &[0]);
            pass.set_bind_group(1, &sums.group, &[]);
            pass.set_pipeline(&self.renderer.pipelines.resolve);
            pass.draw(0..3, 0..1);
        }
        self.reduce_pass(&mut encoder, &group);
        self.submit(encoder)?;
        Ok(None)
    }

    fn sum_pass(&self, encoder: &mut CommandEncoder, group: &wgpu::BindGroup, sums: &Sums) {
        let nothing = LoadOp::Clear(wgpu::Color { r: 0.0, g: 0.0, b: 0.0, a: 1.0 });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sums"),
            color_attachments: &[attachment(&sums.views[0], nothing), attachment(&sums.views[1], nothing)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: Some(Operations { load: LoadOp::Load, store: StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, group, &[0]);
        draw_runs(&mut pass, &self.renderer.pipelines, self.scene, Way::Layer, &self.layer);
    }

    /// Draws until no layer is lost; returns the buffers that it took when they are new.
    fn with_layers(&self) -> Result<Option<Layers>, ViewerError> {
        let Renderer { context, pipelines, layers, layer_memory, .. } = self.renderer;
        let mut new =
            layers.is_none().then(|| Layers::first(context, pipelines, self.targets, *layer_memory));
        loop {
            let Some(current) = new.as_ref().or(layers.as_ref()) else { return Ok(None) };
            self.draw_layers(current)?;
            match current.larger(context, pipelines, self.targets, *layer_memory)? {
                Some(larger) => new = Some(larger),
                None => return Ok(new),
            }
        }
    }

    fn draw_layers(&self, layers: &Layers) -> Result<(), ViewerError> {
        let bands: Vec<Band> = layers.bands().collect();
        let group = self.frame_group(&bands, layers.node_capacity())?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &group);
        encoder.clear_buffer(&layers.counts, 0, None);
        for (i, &band) in bands.iter().enumerate() {
            encoder.clear_buffer(&layers.heads, 0, None);
            let offset = (i * FRAME_STRIDE) as u32;
            self.layer_pass(&mut encoder, &group, layers, band, offset);
            self.resolve_pass(&mut encoder, &group, layers, band, offset);
        }
        layers.read_back(&mut encoder);
        self.reduce_pass(&mut encoder, &group);
        self.submit(encoder)
    }

    fn encoder(&self) -> CommandEncoder {
        self.renderer.context.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    fn submit(&self, encoder: CommandEncoder) -> Result<(), ViewerError> {
        self.renderer.context.queue.submit([encoder.finish()]);
        self.renderer.context.check()
    }

    /// The parameters of the frame, once for each band, and the tables of the scene.
    fn frame_group(&self, bands: &[Band], node_capacity: u32) -> Result<wgpu::BindGroup, ViewerError> {
        let of_band = |(i, band): (usize, &Band)| Frame {
            band_row: band.row,
            band: i as u32,
            node_capacity,
            ..self.frame
        };
        let frames: Vec<Frame> = bands.iter().enumerate().map(of_band).collect();
        frame_group(&self.renderer.context, &self.renderer.pipelines, self.scene, &frames)
    }

    fn opaque_pass(&self, encoder: &mut CommandEncoder, group: &wgpu::BindGroup) {
        let a = f64::from(self.view.background_opacity);
        let [r, g, b] = self.view.background.map(|c| a * f64::from(c));
        let store = if self.targets.sums.is_some() { StoreOp::Store } else { StoreOp::Discard };
        let depth_ops = Operations { load: LoadOp::Clear(1.0), store };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("opaque"),
            color_attachments: &[
                attachment(&self.targets.color, LoadOp::Clear(wgpu::Color { r, g, b, a })),
                attachment(&self.targets.opaque_depth, LoadOp::Clear(FARTHEST)),
            ],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: Some(depth_ops),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, group, &[0]);
        draw_runs(&mut pass, &self.renderer.pipelines, self.scene, Way::Opaque, &self.opaque);
    }

    fn layer_pass(
        &self,
        encoder: &mut CommandEncoder,
        group: &wgpu::BindGroup,
        layers: &Layers,
        band: Band,
        offset: u32,
    ) {
        let mut pass = self.band_pass(encoder, "layers", band);
        pass.set_bind_group(0, group, &[offset]);
        pass.set_bind_group(1, &layers.group, &[]);
        draw_runs(&mut pass, &self.renderer.pipelines, self.scene, Way::Layer, &self.layer);
    }

    fn resolve_pass(
        &self,
        encoder: &mut CommandEncoder,
        group: &wgpu::BindGroup,
        layers: &Layers,
        band: Band,
        offset: u32,
    ) {
        let mut pass = self.band_pass(encoder, "resolve", band);
        pass.set_bind_group(0, group, &[offset]);
        pass.set_bind_group(1, &layers.group, &[]);
        pass.set_pipeline(&self.renderer.pipelines.resolve);
        pass.draw(0..3, 0..1);
    }

    fn band_pass<'e>(&self, encoder: &'e mut CommandEncoder, label: &str, band: Band) -> RenderPass<'e> {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[attachment(&self.targets.color, LoadOp::Load)],
            ..Default::default()
        });
        pass.set_scissor_rect(0, band.row, self.targets.raster.size()[0], band.rows);
        pass
    }

    fn reduce_pass(&self, encoder: &mut CommandEncoder, group: &wgpu::BindGroup) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("reduce"),
            color_attachments: &[attachment(&self.targets.picture_view, LoadOp::Clear(wgpu::Color::BLACK))],
            ..Default::default()
        });
        pass.set_bind_group(0, group, &[0]);
        pass.set_bind_group(1, &self.targets.samples, &[]);
        pass.set_pipeline(&self.renderer.pipelines.reduce);
        pass.draw(0..3, 0..1);
    }
}

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
) -> Result<wgpu::BindGroup, ViewerError> {
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
    pipelines: &Pipelines,
    scene: &SceneBuffers,
    way: Way,
    runs: &[Run],
) {
    for Run { kind, chunk, elements } in runs {
        pass.set_pipeline(pipelines.kinds[*kind].pipeline(way));
        pass.set_vertex_buffer(0, scene.chunks[*kind][*chunk].slice(..));
        if *kind == batch::MESH {
            pass.draw(3 * elements.start..3 * elements.end, 0..1);
        } else {
            pass.draw(0..batch::VERTICES[*kind], elements.clone());
        }
    }
}
