//! What goes to the graphics card, counted where it goes: `Context` is the only place that makes buffers and writes to them.

use std::ops::Sub;

/// Buffers or tables that were made, and bytes that were written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Upload {
    /// How many were made.
    pub made: u64,
    /// Bytes that were written into new and old ones.
    pub bytes: u64,
}

/// What a renderer has handed to the graphics card since it was made; the difference of two is what lies between.
///
/// ```no_run
/// use lar_viewer::{Drawable, OffscreenRenderer, Scene, Traffic, Upload, View};
/// let mut scene = Scene::new();
/// let group = scene.push_group([1., 0., 0.])?;
/// scene.push(Drawable::points("dot", [[1., 0., 0.]]).group(group))?;
/// let mut renderer = OffscreenRenderer::new()?;
/// let mut prepared = renderer.prepare(&scene)?;
/// let before = prepared.traffic();
/// prepared.render(&View::fitted(&scene, [2.0; 3], 1.0), 64, 64)?;
/// let Traffic { geometry, tables, .. } = prepared.traffic() - before;
/// assert_eq!((geometry, tables), (Upload::default(), Upload::default()), "an explosion uploads neither");
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Triangles, segments, dots and strokes of text.
    pub geometry: Upload,
    /// Looks of drawables and centroids of groups.
    pub tables: Upload,
    /// Parameters of frames: camera, explosion, clip plane.
    pub parameters: Upload,
    /// Draw calls of elements of scenes, in all passes.
    pub draw_calls: u64,
}

impl Sub for Upload {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self { made: self.made - before.made, bytes: self.bytes - before.bytes }
    }
}

impl Sub for Traffic {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self {
            geometry: self.geometry - before.geometry,
            tables: self.tables - before.tables,
            parameters: self.parameters - before.parameters,
            draw_calls: self.draw_calls - before.draw_calls,
        }
    }
}
