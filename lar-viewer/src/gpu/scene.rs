//! A scene on the graphics card, and which of it each pass draws.

use super::batch::{Batch, Span};
use super::context::Context;
use super::cull::{Ball, Frustum};
use super::elements::{self, KINDS};
use super::frame::Placement;
use super::parts::{GroupOffsets, NO_GROUP, Part, group_offsets};
use super::table::Table;
use crate::scene::{Drawable, Extents};
use crate::{Appearance, Scene, ViewerError};
use std::ops::Range;
use wgpu::{Buffer, BufferUsages};

/// Two stretches of elements with fewer than this many between them are drawn by one call: the shader drops what lies
/// between. So many elements take about as long as a call on a processor that draws.
const GAP: u32 = 64;

/// Which elements a pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    Opaque,
    Layer,
    /// Opaque or not, for picking.
    Id,
    /// Triangles, opaque or not, as the solids that are outlined.
    Solid,
}

/// Elements of one kind in one buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) kind: usize,
    pub(crate) chunk: usize,
    pub(crate) elements: Range<u32>,
}

/// Buffers, tables, and what the parts in them are.
pub(crate) struct SceneBuffers {
    pub(crate) placement: Placement,
    pub(crate) extents: Extents,
    pub(crate) parts: Table,
    pub(crate) groups: Table,
    pub(crate) chunks: [Vec<Buffer>; KINDS],
    capacity: [u32; KINDS],
    spans: Vec<Span>,
    balls: Vec<Ball>,
    offsets: Vec<GroupOffsets>,
    looks: Vec<Part>,
}

impl SceneBuffers {
    pub(crate) fn new(context: &Context, scene: &Scene, buffer_bytes: u64) -> Result<Self, ViewerError> {
        let batch = Batch::new(scene, buffer_bytes.min(context.limits.max_buffer_size));
        Self::uploaded(context, scene, batch)
    }

    /// A scene that is drawn together with this one: their groups move alike.
    #[cfg(feature = "window")]
    pub(crate) fn beside(&self, context: &Context, scene: &Scene) -> Result<Self, ViewerError> {
        Self::uploaded(context, scene, Batch::beside(scene, self.placement, context.limits.max_buffer_size))
    }

    fn uploaded(context: &Context, scene: &Scene, batch: Batch) -> Result<Self, ViewerError> {
        let capacity = batch.capacity;
        let looks = looks(&batch.spans, scene.drawables(), |i| scene.drawables()[i].appearance);
        let offsets = group_offsets(scene, &batch.placement);
        Ok(Self {
            parts: Table::new(context, "drawables", &looks)?,
            groups: Table::new(context, "groups", &offsets)?,
            chunks: [
                upload(context, "triangles", &batch.triangles, capacity[elements::MESH])?,
                upload(context, "segments", &batch.lines, capacity[elements::LINES])?,
                upload(context, "points", &batch.dots, capacity[elements::POINTS])?,
                upload(context, "strokes of labels", &batch.strokes, capacity[elements::STROKES])?,
            ],
            capacity,
            spans: batch.spans,
            balls: batch.balls,
            offsets,
            looks,
            placement: batch.placement,
            extents: batch.extents,
        })
    }

    /// Makes the drawables look like this from the next frame on: one upload of 32 bytes a drawable.
    ///
    /// # Errors
    /// `Attribute` with the drawable's name; the scene then looks as before.
    pub(crate) fn set_appearances(
        &mut self,
        context: &Context,
        scene: &Scene,
        appearances: &[Appearance],
    ) -> Result<(), ViewerError> {
        let drawables = scene.drawables();
        drawables.iter().zip(appearances).try_for_each(|(d, a)| a.validate(d.name()))?;
        let or_own = |i: usize| appearances.get(i).copied().unwrap_or(drawables[i].appearance);
        self.looks = looks(&self.spans, drawables, or_own);
        self.parts.write(context, &self.looks);
        Ok(())
    }

    /// What a pass draws of what may be seen, when the view multiplies the opacity of meshes by `opacity`. O(parts).
    pub(crate) fn runs(&self, way: Way, opacity: f32, frustum: &Frustum) -> Vec<Run> {
        let is_drawn = |span: &Span, part: &Part| {
            let dimming = if span.kind == elements::MESH { opacity } else { 1.0 };
            let is_layer = part.is_layer(dimming);
            match way {
                Way::Opaque => !is_layer && 0.0 < part.color[3] * dimming,
                Way::Layer => is_layer,
                Way::Id | Way::Solid => 0.0 < part.color[3] * dimming,
            }
        };
        let in_picture = |span: &Span, part: &Part, ball: &Ball| {
            let group = self.offsets.get(part.group as usize).filter(|_| part.group != NO_GROUP);
            // Labels reach as far from their anchors as their texts are long.
            span.kind == elements::STROKES || frustum.sees(ball, group)
        };
        let parts = self.spans.iter().zip(&self.looks).zip(&self.balls);
        let drawn = parts.filter(|((s, p), b)| is_drawn(s, p) && in_picture(s, p, b)).map(|((s, _), _)| s);
        runs(drawn, self.capacity)
    }

    /// Number of parts.
    pub(crate) fn n_parts(&self) -> u32 {
        self.spans.len() as u32
    }

    /// The kind of a part's elements.
    pub(crate) fn kind(&self, part: u32) -> Option<usize> {
        self.spans.get(part as usize).map(|span| span.kind)
    }

    /// Drawable and element of what the id pass found: a part, and the index of an element in its buffer. For labels it is
    /// the index of the stroke in the drawable.
    pub(crate) fn origin(&self, part: u32, index: u32) -> Option<(usize, usize)> {
        let span = self.spans.get(part as usize)?;
        let in_buffer = span.start % self.capacity[span.kind];
        let offset = index.checked_sub(in_buffer).filter(|&offset| offset < span.n)?;
        Some((span.drawable as usize, (span.element + offset) as usize))
    }
}

fn looks(spans: &[Span], drawables: &[Drawable], appearance: impl Fn(usize) -> Appearance) -> Vec<Part> {
    let part = |span: &Span| {
        let i = span.drawable as usize;
        Part::new(&drawables[i], &appearance(i))
    };
    spans.iter().map(part).collect()
}

/// Joins spans into stretches, kind by kind, in the order in which they lie in the buffers.
fn runs<'a>(spans: impl Iterator<Item = &'a Span>, capacity: [u32; KINDS]) -> Vec<Run> {
    let mut of_kind: [Vec<Run>; KINDS] = Default::default();
    for span in spans {
        let capacity = capacity[span.kind];
        let (chunk, first) = ((span.start / capacity) as usize, span.start % capacity);
        let runs = &mut of_kind[span.kind];
        match runs.last_mut() {
            Some(last) if last.chunk == chunk && first < last.elements.end.saturating_add(GAP) => {
                last.elements.end = first + span.n;
            }
            _ => runs.push(Run { kind: span.kind, chunk, elements: first..first + span.n }),
        }
    }
    of_kind.into_iter().flatten().collect()
}

fn upload<T: bytemuck::Pod>(
    context: &Context,
    what: &'static str,
    elements: &[T],
    capacity: u32,
) -> Result<Vec<Buffer>, ViewerError> {
    let chunks = elements.chunks(capacity as usize);
    chunks.map(|chunk| context.upload(what, bytemuck::cast_slice(chunk), BufferUsages::VERTEX)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(spans: &[(usize, u32, u32)], expected: &[(usize, usize, Range<u32>)]) {
        let span = |&(kind, start, n)| Span { drawable: 0, element: 0, kind, start, n };
        let spans: Vec<Span> = spans.iter().map(span).collect();
        let found = runs(spans.iter(), [10_000; KINDS]);
        let found: Vec<_> = found.into_iter().map(|r| (r.kind, r.chunk, r.elements)).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn spans_are_joined_over_short_gaps_within_a_buffer() {
        check(&[], &[]);
        check(&[(0, 0, 5), (1, 0, 2), (0, 9, 1)], &[(0, 0, 0..10), (1, 0, 0..2)]);
        check(&[(0, 0, 5), (0, 5 + GAP, 1)], &[(0, 0, 0..5), (0, 0, 5 + GAP..6 + GAP)]);
        check(&[(0, 9_990, 10), (0, 10_000, 10)], &[(0, 0, 9_990..10_000), (0, 1, 0..10)]);
    }
}
