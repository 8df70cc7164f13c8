//! What is seen near a pixel: the scene drawn once more, only around that pixel, with ids for colours.

use super::cull::Frustum;
use super::elements::{LINES, POINTS, STROKES};
use super::frame::Raster;
use super::pipelines::{DEPTH, ID};
use super::renderer::Renderer;
use super::scene::{SceneBuffers, Way};
use super::shared::{attachment, draw_runs, frame_group, frames};
use crate::{View, ViewerError};
use wgpu::{BufferUsages, LoadOp, Operations, StoreOp, TextureUsages};

/// Bytes of an id.
const ID_BYTES: u32 = 8;
/// Largest radius around a pixel.
const MOST_RADIUS: u32 = 64;

/// An element of a drawable and the pixel at which it is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    /// Which of the scenes it is in.
    pub(crate) scene: usize,
    pub(crate) drawable: usize,
    pub(crate) element: usize,
    pub(crate) pixel: [u32; 2],
}

impl Renderer {
    /// The nearest label, else dot, else line, else triangle that is seen within `radius` pixels of a pixel of a picture.
    pub(crate) fn pick(
        &self,
        scenes: &[&SceneBuffers],
        view: &View,
        [width, height]: [u32; 2],
        pixel: [u32; 2],
        radius: u32,
    ) -> Result<Option<Seen>, ViewerError> {
        view.validate()?;
        let view = View { samples: 1, ..*view };
        let raster = self.raster(&view, width, height)?;
        for (at, side) in pixel.into_iter().zip([width, height]) {
            if side <= at {
                let (parameter, expected) = ("a coordinate of the picked pixel", "inside the picture");
                return Err(ViewerError::InvalidView { parameter, value: f64::from(at), expected });
            }
        }
        let radius = radius.min(MOST_RADIUS);
        let ids = self.ids(scenes, &view, &raster, pixel, radius)?;
        let side = 2 * radius + 1;
        let candidates = ids.chunks_exact(2).enumerate().filter_map(|(i, id)| {
            let (index, part) = of_scene(scenes, id[0].checked_sub(1)?)?;
            let (drawable, element) = scenes[index].origin(part, id[1])?;
            let [x, y] = [i as u32 % side, i as u32 / side];
            let [dx, dy] = [x.abs_diff(radius), y.abs_diff(radius)];
            let distance = dx * dx + dy * dy;
            let pixel = [(pixel[0] + x).checked_sub(radius)?, (pixel[1] + y).checked_sub(radius)?];
            let in_reach = distance <= radius * radius && pixel[0] < width && pixel[1] < height;
            let rank = [STROKES, POINTS, LINES]
                .into_iter()
                .position(|k| Some(k) == scenes[index].kind(part))
                .unwrap_or(3);
            in_reach.then_some(((rank, distance, i), Seen { scene: index, drawable, element, pixel }))
        });
        Ok(candidates.min_by_key(|(order, _)| *order).map(|(_, seen)| seen))
    }

    /// The ids of the square of pixels around a pixel, row by row.
    fn ids(
        &self,
        scenes: &[&SceneBuffers],
        view: &View,
        raster: &Raster,
        pixel: [u32; 2],
        radius: u32,
    ) -> Result<Vec<u32>, ViewerError> {
        let context = &self.context;
        let side = 2 * radius + 1;
        let target = |format, usage| super::targets::texture(context, [side; 2], format, usage);
        let ids = target(ID, TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC);
        let depth = target(DEPTH, TextureUsages::RENDER_ATTACHMENT);
        let frames = frames(view, raster, scenes);
        let groups = scenes.iter().zip(&frames);
        let groups: Vec<_> = groups
            .map(|(scene, frame)| frame_group(context, &self.pipelines, scene, &[*frame]))
            .collect::<Result<_, _>>()?;
        let mut encoder = context.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("ids"),
                color_attachments: &[attachment(
                    &super::targets::view(&ids),
                    LoadOp::Clear(wgpu::Color::TRANSPARENT),
                )],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &super::targets::view(&depth),
                    depth_ops: Some(Operations { load: LoadOp::Clear(1.0), store: StoreOp::Discard }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            // The picture as a whole, placed so that the square falls into the small target.
            let corner = pixel.map(|at| radius as f32 - at as f32);
            pass.set_viewport(corner[0], corner[1], raster.width as f32, raster.height as f32, 0.0, 1.0);
            for ((scene, frame), group) in scenes.iter().zip(&frames).zip(&groups) {
                let near = Frustum::around(frame, pixel, radius);
                let runs = scene.runs(Way::Id, view.opacity, &near);
                pass.set_bind_group(0, group, &[0]);
                draw_runs(&mut pass, context, &self.pipelines, scene, Way::Id, &runs);
            }
        }
        let row_bytes = (ID_BYTES * side).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
        let buffer = context.buffer("ids", u64::from(row_bytes * side), usage);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_bytes), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            ids.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            ids.size(),
        );
        context.queue.submit([encoder.finish()]);
        context.read(&buffer, |bytes| {
            let rows = bytes.chunks_exact(row_bytes as usize);
            let used = rows.flat_map(|row| row[..(ID_BYTES * side) as usize].chunks_exact(4));
            used.map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
        })
    }
}

/// Which scene a part is in, and its number there.
fn of_scene(scenes: &[&SceneBuffers], mut part: u32) -> Option<(usize, u32)> {
    for (index, scene) in scenes.iter().enumerate() {
        if part < scene.n_parts() {
            return Some((index, part));
        }
        part -= scene.n_parts();
    }
    None
}
