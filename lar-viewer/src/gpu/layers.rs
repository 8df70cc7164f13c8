//! Memory of the A-buffer: how many transparent layers there is room for, and what happens when there are more.
//!
//! The layer shaders count layers also when they find no room, so one frame says how many nodes the next needs. The
//! node buffer then grows and the frame is drawn again. Where it may not grow further, the picture is cut into bands
//! of rows that are stored and blended one after the other in the same buffers: any scene is drawn exactly as long
//! as one row of samples fits.

use super::context::Context;
use super::pipelines::Pipelines;
use super::targets::Targets;
use crate::ViewerError;
use wgpu::{BindingResource, Buffer, BufferUsages};

/// Size of `Node` in `layers.wgsl`.
pub(crate) const NODE_BYTES: u32 = 12;
/// Bytes that the node buffer takes at most unless asked for otherwise: 22 million layers.
pub(crate) const DEFAULT_MEMORY: u64 = 256 << 20;

/// Buffers of the A-buffer for pictures of one size.
pub(crate) struct Layers {
    /// Width and height of the picture in samples.
    size: [u32; 2],
    /// Rows of samples in a band.
    band_rows: u32,
    node_capacity: u32,
    pub(crate) heads: Buffer,
    pub(crate) counts: Buffer,
    readback: Buffer,
    pub(crate) group: wgpu::BindGroup,
}

/// A horizontal strip of the picture: its first row and number of rows, in samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Band {
    pub(crate) row: u32,
    pub(crate) rows: u32,
}

/// What the counts of a frame ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Need {
    /// All layers were stored.
    Satisfied,
    /// Draw again with bands of so many rows and room for so many nodes.
    Redraw { band_rows: u32, node_capacity: u32 },
    /// One row alone has more layers than there can be room for.
    Hopeless,
}

impl Layers {
    /// Buffers for one picture; the band is cut to what a buffer of heads can hold.
    pub(crate) fn new(
        context: &Context,
        pipelines: &Pipelines,
        targets: &Targets,
        band_rows: u32,
        node_capacity: u32,
    ) -> Self {
        let size = targets.raster.size();
        let band_rows = band_rows.min(largest_band(context, size));
        let n_bands = size[1].div_ceil(band_rows);
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let heads = context.buffer("heads", 4 * u64::from(size[0]) * u64::from(band_rows), storage);
        let nodes = context.buffer("nodes", u64::from(NODE_BYTES) * u64::from(node_capacity), storage);
        let counts = context.buffer("counts", 4 * u64::from(n_bands), storage | BufferUsages::COPY_SRC);
        let readback =
            context.buffer("counts", 4 * u64::from(n_bands), BufferUsages::COPY_DST | BufferUsages::MAP_READ);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = context.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("layers"),
            layout: &pipelines.layers_layout,
            entries: &[
                entry(0, heads.as_entire_binding()),
                entry(1, nodes.as_entire_binding()),
                entry(2, counts.as_entire_binding()),
                entry(3, BindingResource::TextureView(&targets.opaque_depth)),
            ],
        });
        Self { size, band_rows, node_capacity, heads, counts, readback, group }
    }

    /// Buffers for the first frame of a size, with room for as many layers as there are samples.
    pub(crate) fn first(context: &Context, pipelines: &Pipelines, targets: &Targets, memory: u64) -> Self {
        let [width, height] = targets.raster.size();
        let capacity = width.saturating_mul(height).min(most_nodes(context, memory));
        Self::new(context, pipelines, targets, height, capacity)
    }

    /// The bands from top to bottom.
    pub(crate) fn bands(&self) -> impl Iterator<Item = Band> + '_ {
        let rows = (0..self.size[1]).step_by(self.band_rows as usize);
        rows.map(|row| Band { row, rows: self.band_rows.min(self.size[1] - row) })
    }

    /// Room for layers in each band.
    pub(crate) fn node_capacity(&self) -> u32 {
        self.node_capacity
    }

    /// Asks for the counts to be read after the frame.
    pub(crate) fn read_back(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.counts, 0, &self.readback, 0, self.counts.size());
    }

    /// The buffers to draw the frame again with, when the counts of the submitted frame say that layers were lost.
    ///
    /// # Errors
    /// `TooManyLayers` when one row of samples has more layers than fit; `Gpu`.
    pub(crate) fn larger(
        &self,
        context: &Context,
        pipelines: &Pipelines,
        targets: &Targets,
        memory: u64,
    ) -> Result<Option<Self>, ViewerError> {
        let needed = context.read(&self.readback, |bytes| {
            bytes.chunks_exact(4).map(|c| u32::from_ne_bytes([c[0], c[1], c[2], c[3]])).max().unwrap_or(0)
        })?;
        let limit = most_nodes(context, memory);
        match need(needed, self.node_capacity, limit, self.band_rows) {
            Need::Satisfied => Ok(None),
            Need::Redraw { band_rows, node_capacity } => {
                Ok(Some(Self::new(context, pipelines, targets, band_rows, node_capacity)))
            }
            Need::Hopeless => {
                let adapter = context.adapter_name.clone();
                Err(ViewerError::TooManyLayers { layers: needed, limit, adapter })
            }
        }
    }
}

/// What to do when the fullest band has `needed` layers, there is room for `capacity`, and can be for `limit`.
fn need(needed: u32, capacity: u32, limit: u32, band_rows: u32) -> Need {
    if needed <= capacity {
        Need::Satisfied
    } else if needed <= limit {
        // A quarter more, so that turning the scene does not redraw every frame.
        Need::Redraw { band_rows, node_capacity: needed.saturating_add(needed / 4).min(limit) }
    } else if 1 < band_rows {
        let parts = needed.div_ceil(limit).saturating_add(1);
        Need::Redraw { band_rows: (band_rows / parts).max(1), node_capacity: limit }
    } else {
        Need::Hopeless
    }
}

/// Nodes that fit in this many bytes and in a buffer of the adapter.
fn most_nodes(context: &Context, memory: u64) -> u32 {
    let nodes = context.largest_storage().min(memory) / u64::from(NODE_BYTES);
    u32::try_from(nodes).unwrap_or(u32::MAX).max(1)
}

fn largest_band(context: &Context, [width, height]: [u32; 2]) -> u32 {
    let rows = context.largest_storage() / (4 * u64::from(width));
    u32::try_from(rows).unwrap_or(u32::MAX).clamp(1, height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(needed: u32, capacity: u32, limit: u32, band_rows: u32, expected: Need) {
        assert_eq!(need(needed, capacity, limit, band_rows), expected);
    }

    #[test]
    fn buffers_grow_then_bands_shrink_then_it_is_refused() {
        check(100, 100, 1000, 64, Need::Satisfied);
        check(101, 100, 1000, 64, Need::Redraw { band_rows: 64, node_capacity: 126 });
        check(900, 100, 1000, 64, Need::Redraw { band_rows: 64, node_capacity: 1000 });
        check(1001, 1000, 1000, 64, Need::Redraw { band_rows: 21, node_capacity: 1000 });
        check(1_000_000, 1000, 1000, 64, Need::Redraw { band_rows: 1, node_capacity: 1000 });
        check(1001, 1000, 1000, 1, Need::Hopeless);
        check(u32::MAX, 10, u32::MAX, 9, Need::Redraw { band_rows: 9, node_capacity: u32::MAX });
    }

    proptest! {
        #[test]
        fn redrawing_comes_to_an_end(per_row in 0_u32..5000, limit in 1_u32..4000, rows in 1_u32..3000) {
            let (mut band_rows, mut capacity) = (rows, 16.min(limit));
            for _ in 0..64 {
                match need(per_row.saturating_mul(band_rows), capacity, limit, band_rows) {
                    Need::Satisfied => return Ok(()),
                    Need::Hopeless => {
                        prop_assert!(limit < per_row && band_rows == 1);
                        return Ok(());
                    }
                    Need::Redraw { band_rows: b, node_capacity: c } => {
                        prop_assert!(b < band_rows || capacity < c);
                        (band_rows, capacity) = (b, c);
                    }
                }
            }
            prop_assert!(false, "still redrawing");
        }
    }
}
