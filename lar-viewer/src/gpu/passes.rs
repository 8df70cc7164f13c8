//! The passes of one frame, over all scenes that are drawn together.

use super::context::Context;
use super::cull::Frustum;
use super::elements;
use super::frame::Frame;
use super::layers::{Band, Layers};
use super::pipelines::Pipelines;
use super::scene::{Run, SceneBuffers, Way};
use super::shared::{FRAME_STRIDE, attachment, draw_runs, frame_group, frames};
use super::targets::{Outlines, Sums, Targets};
use crate::{View, ViewerError};
use wgpu::{BindGroup, CommandEncoder, LoadOp, Operations, RenderPass, StoreOp};

/// The bits of the depth 1.
const FARTHEST: wgpu::Color = wgpu::Color { r: 0x3f80_0000_u32 as f64, g: 0.0, b: 0.0, a: 0.0 };

/// A scene and what of it is drawn in which pass.
struct Cast<'a> {
    scene: &'a SceneBuffers,
    frame: Frame,
    opaque: Vec<Run>,
    layer: Vec<Run>,
    /// Triangles, for outlines.
    solid: Vec<Run>,
}

/// The drawing of one frame.
pub(super) struct Draw<'a> {
    context: &'a Context,
    pipelines: &'a Pipelines,
    casts: Vec<Cast<'a>>,
    view: &'a View,
    targets: &'a Targets,
}

impl<'a> Draw<'a> {
    pub(super) fn new(
        context: &'a Context,
        pipelines: &'a Pipelines,
        scenes: &[&'a SceneBuffers],
        view: &'a View,
        targets: &'a Targets,
    ) -> Self {
        let cast = |(&scene, frame): (&&'a SceneBuffers, Frame)| {
            let frustum = Frustum::new(&frame);
            let [opaque, layer] =
                [Way::Opaque, Way::Layer].map(|way| scene.runs(way, view.opacity, &frustum));
            let mut solid = Vec::new();
            if view.outline.is_some() {
                solid = scene.runs(Way::Id, view.opacity, &frustum);
                solid.retain(|run| run.kind == elements::MESH);
            }
            Cast { scene, frame, opaque, layer, solid }
        };
        let casts = scenes.iter().zip(frames(view, &targets.raster, scenes)).map(cast).collect();
        Self { context, pipelines, casts, view, targets }
    }

    /// Draws everything; returns the memory of layers that it took when it is new.
    pub(super) fn all(
        &self,
        layers: Option<&Layers>,
        layer_memory: u64,
    ) -> Result<Option<Layers>, ViewerError> {
        match &self.targets.sums {
            _ if self.casts.iter().all(|cast| cast.layer.is_empty()) => self.without_layers(),
            Some(sums) => self.with_sums(sums),
            None => self.with_layers(layers, layer_memory),
        }
    }

    fn without_layers(&self) -> Result<Option<Layers>, ViewerError> {
        let groups = self.frame_groups(&[Band { row: 0, rows: 0 }], 0)?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &groups);
        self.last_passes(&mut encoder, &groups);
        self.submit(encoder)?;
        Ok(None)
    }

    /// Draws with the layers summed.
    fn with_sums(&self, sums: &Sums) -> Result<Option<Layers>, ViewerError> {
        let groups = self.frame_groups(&[Band { row: 0, rows: 0 }], 0)?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &groups);
        self.sum_pass(&mut encoder, &groups, sums);
        {
            let whole = Band { row: 0, rows: self.targets.raster.size()[1] };
            let mut pass = self.band_pass(&mut encoder, "compose", whole);
            self.whole_screen(&mut pass, &self.pipelines.resolve, &groups, 0, &sums.group);
        }
        self.last_passes(&mut encoder, &groups);
        self.submit(encoder)?;
        Ok(None)
    }

    fn sum_pass(&self, encoder: &mut CommandEncoder, groups: &[BindGroup], sums: &Sums) {
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
        self.draw_casts(&mut pass, groups, 0, Way::Layer);
    }

    /// Draws until no layer is lost; returns the buffers that it took when they are new.
    fn with_layers(&self, layers: Option<&Layers>, layer_memory: u64) -> Result<Option<Layers>, ViewerError> {
        let Self { context, pipelines, targets, .. } = self;
        let mut new = layers.is_none().then(|| Layers::first(context, pipelines, targets, layer_memory));
        loop {
            let Some(current) = new.as_ref().or(layers) else { return Ok(None) };
            self.draw_layers(current)?;
            match current.larger(context, pipelines, targets, layer_memory)? {
                Some(larger) => new = Some(larger),
                None => return Ok(new),
            }
        }
    }

    fn draw_layers(&self, layers: &Layers) -> Result<(), ViewerError> {
        let bands: Vec<Band> = layers.bands().collect();
        let groups = self.frame_groups(&bands, layers.node_capacity())?;
        let mut encoder = self.encoder();
        self.opaque_pass(&mut encoder, &groups);
        encoder.clear_buffer(&layers.counts, 0, None);
        for (i, &band) in bands.iter().enumerate() {
            encoder.clear_buffer(&layers.heads, 0, None);
            let offset = (i * FRAME_STRIDE) as u32;
            {
                let mut pass = self.band_pass(&mut encoder, "layers", band);
                pass.set_bind_group(1, &layers.group, &[]);
                self.draw_casts(&mut pass, &groups, offset, Way::Layer);
            }
            let mut pass = self.band_pass(&mut encoder, "resolve", band);
            self.whole_screen(&mut pass, &self.pipelines.resolve, &groups, offset, &layers.group);
        }
        layers.read_back(&mut encoder);
        self.last_passes(&mut encoder, &groups);
        self.submit(encoder)
    }

    fn encoder(&self) -> CommandEncoder {
        self.context.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    fn submit(&self, encoder: CommandEncoder) -> Result<(), ViewerError> {
        self.context.queue.submit([encoder.finish()]);
        self.context.check()
    }

    /// For each scene the parameters of the frame, once for each band, and the tables of the scene.
    fn frame_groups(&self, bands: &[Band], node_capacity: u32) -> Result<Vec<BindGroup>, ViewerError> {
        let group = |cast: &Cast<'_>| {
            let of_band = |(i, band): (usize, &Band)| Frame {
                band_row: band.row,
                band: i as u32,
                node_capacity,
                ..cast.frame
            };
            let frames: Vec<Frame> = bands.iter().enumerate().map(of_band).collect();
            frame_group(self.context, self.pipelines, cast.scene, &frames)
        };
        self.casts.iter().map(group).collect()
    }

    /// Draws what a pass draws of all scenes.
    fn draw_casts(&self, pass: &mut RenderPass<'_>, groups: &[BindGroup], offset: u32, way: Way) {
        for (cast, group) in self.casts.iter().zip(groups) {
            let runs = match way {
                Way::Opaque => &cast.opaque,
                Way::Layer => &cast.layer,
                Way::Id | Way::Solid => &cast.solid,
            };
            pass.set_bind_group(0, group, &[offset]);
            draw_runs(pass, self.context, self.pipelines, cast.scene, way, runs);
        }
    }

    /// A step over the whole screen, with the parameters of the frame.
    fn whole_screen(
        &self,
        pass: &mut RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        groups: &[BindGroup],
        offset: u32,
        textures: &BindGroup,
    ) {
        if let Some(group) = groups.first() {
            pass.set_bind_group(0, group, &[offset]);
            pass.set_bind_group(1, textures, &[]);
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }

    fn opaque_pass(&self, encoder: &mut CommandEncoder, groups: &[BindGroup]) {
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
        self.draw_casts(&mut pass, groups, 0, Way::Opaque);
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

    /// Outlines, and samples to pixels.
    fn last_passes(&self, encoder: &mut CommandEncoder, groups: &[BindGroup]) {
        if let Some(outlines) = &self.targets.outlines {
            self.solid_pass(encoder, groups, outlines);
            let mut pass =
                self.band_pass(encoder, "outlines", Band { row: 0, rows: self.targets.raster.size()[1] });
            self.whole_screen(&mut pass, &self.pipelines.outline, groups, 0, &outlines.group);
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("reduce"),
            color_attachments: &[attachment(&self.targets.picture_view, LoadOp::Clear(wgpu::Color::BLACK))],
            ..Default::default()
        });
        self.whole_screen(&mut pass, &self.pipelines.reduce, groups, 0, &self.targets.samples);
    }

    /// Which solid is seen where.
    fn solid_pass(&self, encoder: &mut CommandEncoder, groups: &[BindGroup], outlines: &Outlines) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("solids"),
            color_attachments: &[attachment(&outlines.solids, LoadOp::Clear(wgpu::Color::TRANSPARENT))],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.targets.depth,
                depth_ops: Some(Operations { load: LoadOp::Clear(1.0), store: StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        self.draw_casts(&mut pass, groups, 0, Way::Solid);
    }
}
