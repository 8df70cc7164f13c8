//! Pictures without a window.

use crate::gpu::context::Context;
use crate::gpu::renderer::Renderer;
use crate::gpu::scene::SceneBuffers;
use crate::{Appearance, Hit, Image, Scene, Traffic, View, ViewerError};

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
    /// Bytes of the largest buffer of a scene.
    buffer_bytes: u64,
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
        Ok(Self { renderer: Renderer::new(Context::off_screen()?)?, buffer_bytes: u64::MAX })
    }

    /// A renderer that uses nothing which WebGL 2 lacks, as it draws in a browser and on old adapters: transparent layers
    /// are not sorted but blended by weight, so that two or more of them come out approximately. Everything opaque is the
    /// same.
    ///
    /// # Errors
    /// As `new`.
    pub fn portable() -> Result<Self, ViewerError> {
        Ok(Self { renderer: Renderer::new(Context::portable()?)?, buffer_bytes: u64::MAX })
    }

    /// With this many bytes at most for the layers of transparent pictures, 256 MiB when not said. Pictures that need
    /// more are drawn in bands, one after the other, and come out the same.
    #[must_use]
    pub fn layer_memory(mut self, bytes: u64) -> Self {
        self.renderer.set_layer_memory(bytes);
        self
    }

    /// With this many bytes at most in one buffer of a scene, the adapter's limit when not said. Larger scenes are split
    /// and come out the same.
    #[must_use]
    pub fn buffer_memory(self, bytes: u64) -> Self {
        Self { buffer_bytes: bytes, ..self }
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
        self.prepare(scene)?.render(view, width, height)
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
        let mut prepared = self.prepare(scene)?;
        views.iter().map(|view| prepared.render(view, width, height)).collect()
    }

    /// Uploads a scene, to be drawn and asked repeatedly.
    ///
    /// # Errors
    /// `SceneTooLarge`, or `Gpu` with the driver's message.
    pub fn prepare<'a>(&'a mut self, scene: &'a Scene) -> Result<Prepared<'a>, ViewerError> {
        let buffers = SceneBuffers::new(&self.renderer.context, scene, self.buffer_bytes)?;
        Ok(Prepared { renderer: &mut self.renderer, scene, buffers })
    }
}

/// A scene on the graphics card, from [`OffscreenRenderer::prepare`].
///
/// ```no_run
/// use lar_viewer::{Appearance, Drawable, OffscreenRenderer, Scene, View};
/// let mut scene = Scene::new();
/// scene.push(Drawable::points("dots", [[0.; 3], [1.; 3]]))?;
/// let view = View::fitted(&scene, [1.; 3], 4. / 3.);
/// let mut renderer = OffscreenRenderer::new()?;
/// let mut prepared = renderer.prepare(&scene)?;
/// if let Some(hit) = prepared.pick(&view, [640, 480], [320, 240], 4)? {
///     let mut looks = scene.appearances();
///     looks[hit.drawable].highlighted = true;
///     prepared.set_appearances(&looks)?;
/// }
/// prepared.render(&view, 640, 480)?.write_png("dots.png")?;
/// # Ok::<(), lar_viewer::ViewerError>(())
/// ```
pub struct Prepared<'a> {
    renderer: &'a mut Renderer,
    scene: &'a Scene,
    buffers: SceneBuffers,
}

impl std::fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").finish_non_exhaustive()
    }
}

impl Prepared<'_> {
    /// Draws the scene in a picture of `width` × `height` pixels.
    ///
    /// # Errors
    /// `InvalidView`, `ImageSize`, `TooManyLayers`, or `Gpu` with the driver's message.
    pub fn render(&mut self, view: &View, width: u32, height: u32) -> Result<Image, ViewerError> {
        self.renderer.draw(&[&self.buffers], view, width, height)?;
        self.renderer.read_picture()
    }

    /// What its renderer has handed to the graphics card since it was made.
    #[must_use]
    pub fn traffic(&self) -> Traffic {
        self.renderer.context.traffic()
    }

    /// Makes the drawables look like this, one entry each, until the next call; geometry is not uploaded again.
    ///
    /// # Errors
    /// `Attribute` with the name of the drawable; everything then looks as before.
    pub fn set_appearances(&mut self, appearances: &[Appearance]) -> Result<(), ViewerError> {
        self.buffers.set_appearances(&self.renderer.context, self.scene, appearances)
    }

    /// What is seen within `radius` pixels (64 at most) of a pixel of the picture, counted from the left and the top: the
    /// nearest label, else dot, else line, else triangle.
    ///
    /// # Errors
    /// As `render`, and `InvalidView` when the pixel lies outside the picture.
    pub fn pick(
        &self,
        view: &View,
        size: [u32; 2],
        pixel: [u32; 2],
        radius: u32,
    ) -> Result<Option<Hit>, ViewerError> {
        let seen = self.renderer.pick(&[&self.buffers], view, size, pixel, radius)?;
        Ok(seen.map(|seen| Hit::new(self.scene, self.buffers.placement.center, view, size, seen)))
    }
}
