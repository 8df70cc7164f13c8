//! Pictures without a window.

use crate::gpu::context::Context;
use crate::gpu::renderer::{Renderer, SceneBuffers};
use crate::{Image, Scene, View, ViewerError};

/// Draws scenes into pictures, without a display. The same scene and view give the same bytes on one machine.
///
/// ```no_run
/// use lar_viewer::{Drawable, OffscreenRenderer, Scene, View};
/// let mut scene = Scene::new();
/// scene.push(Drawable::lines("diagonal", [[[0.; 3], [1.; 3]]]))?;
/// let image = OffscreenRenderer::new()?.render(&scene, &View::fitted(&scene, [1.; 3], 4. / 3.), 640, 480)?;
/// image.write_png("diagonal.png")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
pub struct OffscreenRenderer {
    renderer: Renderer,
}

impl std::fmt::Debug for OffscreenRenderer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OffscreenRenderer").field("adapter", &self.adapter_name()).finish_non_exhaustive()
    }
}

impl OffscreenRenderer {
    /// A renderer on the best adapter: a graphics card before a software driver, OpenGL only when nothing else is
    /// there. The environment variable `WGPU_BACKEND` (`vulkan`, `gl`, …) narrows the choice.
    ///
    /// # Errors
    /// `NoAdapter`, which says what to install; `Gpu` when the driver refuses a device.
    pub fn new() -> Result<Self, ViewerError> {
        Ok(Self { renderer: Renderer::new(Context::off_screen()?)? })
    }

    /// With this many bytes at most for the layers of transparent pictures, 256 MiB when not said. Pictures that need
    /// more are drawn in bands, one after the other, and come out the same.
    #[must_use]
    pub fn layer_memory(mut self, bytes: u64) -> Self {
        self.renderer.set_layer_memory(bytes);
        self
    }

    /// Name and backend of the adapter that draws.
    #[must_use]
    pub fn adapter_name(&self) -> &str {
        &self.renderer.context.adapter_name
    }

    /// Draws the scene in a picture of `width` × `height` pixels.
    ///
    /// # Errors
    /// `InvalidView`, `ImageSize`, `SceneTooLarge`, `TooManyLayers`, or `Gpu` with the driver's message.
    pub fn render(
        &mut self,
        scene: &Scene,
        view: &View,
        width: u32,
        height: u32,
    ) -> Result<Image, ViewerError> {
        let buffers = SceneBuffers::new(&self.renderer.context, scene)?;
        self.renderer.draw(&buffers, view, width, height)?;
        self.renderer.read_picture()
    }

    /// Draws the scene once for each view, uploading it once: for explosion sequences and turntables.
    ///
    /// # Errors
    /// As `render`.
    pub fn render_all(
        &mut self,
        scene: &Scene,
        views: &[View],
        width: u32,
        height: u32,
    ) -> Result<Vec<Image>, ViewerError> {
        let buffers = SceneBuffers::new(&self.renderer.context, scene)?;
        let mut images = Vec::with_capacity(views.len());
        for view in views {
            self.renderer.draw(&buffers, view, width, height)?;
            images.push(self.renderer.read_picture()?);
        }
        Ok(images)
    }
}
