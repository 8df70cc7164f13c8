//! The renderer of window and off-screen pictures alike.
//!
//! A frame is drawn at several samples per pixel and averaged at the end, in these passes:
//!
//! 1. *opaque*: triangles, lines and points with a depth test, into a colour and a depth texture;
//! 2. *layers*: everything transparent, each fragment in front of the opaque surface into the list of its sample;
//! 3. *resolve*: the lists sorted by depth and blended over the opaque colour;
//! 4. *outline*, where the view asks for it: which solid is seen where, and ink where that changes;
//! 5. *reduce*: samples to pixels.
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

use super::context::Context;
use super::frame::Raster;
use super::layers::{DEFAULT_MEMORY, Layers};
use super::passes::Draw;
use super::pipelines::Pipelines;
use super::scene::SceneBuffers;
use super::targets::Targets;
use crate::{Image, View, ViewerError};
use wgpu::BufferUsages;

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

    /// Draws scenes that share a placement, the first over the others where they lie at equal depth, and returns the textures
    /// with the picture, `width` × `height` pixels of 8-bit RGBA.
    pub(crate) fn draw(
        &mut self,
        scenes: &[&SceneBuffers],
        view: &View,
        width: u32,
        height: u32,
    ) -> Result<&Targets, ViewerError> {
        view.validate()?;
        let raster = self.raster(view, width, height)?;
        let outlined = view.outline.is_some();
        let targets = match self.targets.take() {
            Some(targets) if targets.raster == raster && targets.outlines.is_some() == outlined => targets,
            _ => {
                self.layers = None;
                Targets::new(&self.context, &self.pipelines, raster, outlined)
            }
        };
        let layers = Draw::new(&self.context, &self.pipelines, scenes, view, &targets)
            .all(self.layers.as_ref(), self.layer_memory)?;
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
        let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
        let buffer = self.context.buffer("picture", u64::from(padded) * u64::from(height), usage);
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
