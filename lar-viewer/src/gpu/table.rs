//! Tables that vertex shaders look things up in: textures of four 32-bit numbers, which every adapter has, while storage
//! buffers in vertex shaders are missing in WebGL 2.

use super::context::Context;
use crate::ViewerError;
use bytemuck::{Pod, cast_slice};
use wgpu::{Extent3d, Texture, TextureFormat, TextureUsages, TextureView};

/// Texels in a row: the widest that every adapter takes. `TABLE_WIDTH` in `common.wgsl`.
pub(crate) const WIDTH: u32 = 2048;
const TEXEL_BYTES: usize = 16;
const ROW_BYTES: usize = WIDTH as usize * TEXEL_BYTES;

/// Entries of a whole number of texels each.
pub(crate) struct Table {
    texture: Texture,
    pub(crate) view: TextureView,
}

impl Table {
    /// A table of these entries.
    ///
    /// # Errors
    /// `SceneTooLarge` when they do not fit in a texture of the adapter; `Gpu`.
    pub(crate) fn new<T: Pod>(
        context: &Context,
        what: &'static str,
        entries: &[T],
    ) -> Result<Self, ViewerError> {
        const { assert!(size_of::<T>().is_multiple_of(TEXEL_BYTES)) };
        let bytes = size_of_val(entries);
        let height = bytes.div_ceil(ROW_BYTES).max(1);
        let limit = context.limits.max_texture_dimension_2d;
        if (limit as usize) < height {
            return Err(ViewerError::SceneTooLarge {
                what,
                bytes: bytes as u64,
                limit: u64::from(limit) * ROW_BYTES as u64,
                adapter: context.adapter_name.clone(),
            });
        }
        let texture = context.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(what),
            size: Extent3d { width: WIDTH, height: height as u32, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Rgba32Uint,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        context.check()?;
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let table = Self { texture, view };
        context.count(|traffic| traffic.tables.made += 1);
        table.write(context, entries);
        Ok(table)
    }

    /// Replaces all entries by as many others.
    pub(crate) fn write<T: Pod>(&self, context: &Context, entries: &[T]) {
        let mut bytes = cast_slice::<T, u8>(entries).to_vec();
        bytes.resize(ROW_BYTES * self.texture.height() as usize, 0);
        context.write_table(&self.texture, &bytes, ROW_BYTES as u32);
    }
}
