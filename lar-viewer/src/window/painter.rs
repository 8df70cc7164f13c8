//! Draws a window: the scene into its texture, egui around it, both onto the surface.

use super::controls::{Asked, Controls};
use crate::gpu::context::{Context, best_adapter};
use crate::gpu::renderer::Renderer;
use crate::gpu::scene::SceneBuffers;
use crate::{Scene, View, ViewerError};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use wgpu::CurrentSurfaceTexture;
use winit::event::WindowEvent;
use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

/// A view and the size in pixels at which it was drawn.
type Drawn = (View, [u32; 2]);

/// Everything behind one window.
pub(crate) struct Painter {
    window: Arc<Window>,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    renderer: Renderer,
    scene: SceneBuffers,
    controls: Controls,
    egui: egui_winit::State,
    egui_renderer: egui_wgpu::Renderer,
    picture: egui::TextureId,
    drawn: Option<Drawn>,
}

/// What comes after a frame.
pub(crate) struct After {
    pub(crate) close: bool,
    /// Draw again after this time even without input.
    pub(crate) repaint_in: Option<Duration>,
}

impl Painter {
    pub(crate) fn new(
        window: Arc<Window>,
        display: &OwnedDisplayHandle,
        scene: &Arc<Scene>,
        view: View,
    ) -> Result<Self, ViewerError> {
        let handle = Box::new(display.clone());
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle(handle).with_env());
        let surface = new_surface(&instance, &window)?;
        let adapter = best_adapter(&instance, Some(&surface))?;
        let mut renderer = Renderer::new(Context::on(&adapter)?)?;
        let config = configuration(&surface, &adapter, &window)?;
        let buffers = SceneBuffers::new(&renderer.context, scene, u64::MAX)?;
        let options = egui_wgpu::RendererOptions::default();
        let mut egui_renderer = egui_wgpu::Renderer::new(&renderer.context.device, config.format, options);
        // A first picture of one pixel, so that egui has a texture to name.
        let first = renderer.draw(&buffers, &view, 1, 1)?.picture_view.clone();
        let picture = egui_renderer.register_native_texture(
            &renderer.context.device,
            &first,
            wgpu::FilterMode::Nearest,
        );
        let controls = Controls::new(view, Arc::clone(scene), renderer.context.adapter_name.clone());
        let egui = egui_state(&window, &renderer.context);
        let mut painter = Self {
            window,
            instance,
            surface,
            config,
            renderer,
            scene: buffers,
            controls,
            egui,
            egui_renderer,
            picture,
            drawn: None,
        };
        let size = painter.window.inner_size();
        painter.resize(size.width, size.height);
        Ok(painter)
    }

    pub(crate) fn window(&self) -> &Window {
        &self.window
    }

    /// Hands an event to egui; returns whether it asks for a new frame.
    pub(crate) fn on_event(&mut self, event: &WindowEvent) -> bool {
        let repaint = self.egui.on_window_event(&self.window, event).repaint;
        repaint && !matches!(event, WindowEvent::RedrawRequested)
    }

    /// Follows the size of the window; a window without area is not drawn.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        let limit = self.renderer.context.limits.max_texture_dimension_2d;
        (self.config.width, self.config.height) = (width.min(limit), height.min(limit));
        if 0 < width && 0 < height {
            self.surface.configure(&self.renderer.context.device, &self.config);
        }
    }

    /// Runs the interface and draws one frame.
    pub(crate) fn frame(&mut self) -> Result<After, ViewerError> {
        if self.config.width == 0 || self.config.height == 0 {
            return Ok(After { close: false, repaint_in: None });
        }
        let input = self.egui.take_egui_input(&self.window);
        let context = self.egui.egui_ctx().clone();
        let mut asked = None;
        let mut output = context.run_ui(input, |ui| asked = Some(self.controls.show(ui, self.picture)));
        let unused = self.update_textures(&mut output.textures_delta);
        self.egui.handle_platform_output(&self.window, output.platform_output);
        let mut repaint_in = output.viewport_output.values().map(|v| v.repaint_delay).min();
        let close = asked.is_some_and(|a| a.close);
        if let Some(asked) = asked {
            let coarse = self.draw_scene(&asked, output.pixels_per_point)?;
            if coarse && !asked.dragging {
                self.window.request_redraw();
            }
            if asked.screenshot {
                self.save_screenshot();
                self.window.request_redraw();
            }
        }
        let jobs = context.tessellate(output.shapes, output.pixels_per_point);
        self.present(&jobs, output.pixels_per_point)?;
        unused.iter().for_each(|id| self.egui_renderer.free_texture(id));
        if repaint_in == Some(Duration::ZERO) {
            self.window.request_redraw();
            repaint_in = None;
        }
        Ok(After { close, repaint_in })
    }

    /// Uploads egui's new textures; returns those that are to be freed after the frame.
    fn update_textures(&mut self, textures: &mut egui::TexturesDelta) -> Vec<egui::TextureId> {
        let Context { device, queue, .. } = &self.renderer.context;
        for (id, deltas) in textures.set.drain() {
            deltas.iter().for_each(|delta| self.egui_renderer.update_texture(device, queue, id, delta));
        }
        textures.free.drain().collect()
    }

    /// Draws the scene when view or size have changed. On a software driver a changing view is drawn with one sample
    /// per pixel, and finely once it rests; returns whether that is still to be done.
    fn draw_scene(&mut self, asked: &Asked, pixels_per_point: f32) -> Result<bool, ViewerError> {
        let limit = self.renderer.context.limits.max_texture_dimension_2d;
        let size = asked.area.size() * pixels_per_point;
        let [width, height] = [size.x, size.y].map(|s| (s.round() as u32).clamp(1, limit));
        let scale = self.controls.view.scale * pixels_per_point;
        let fine = View { scale: scale.clamp(0.01, 100.0), ..self.controls.view };
        let coarse = View { samples: 1, ..fine };
        let draft = self.renderer.context.is_software && fine != coarse;
        let same = |view: View| self.drawn == Some((view, [width, height]));
        let resting = same(coarse) && !asked.dragging;
        let wanted = if draft && !same(fine) && !resting { coarse } else { fine };
        if !same(wanted) {
            let picture = self.renderer.draw(&self.scene, &wanted, width, height)?.picture_view.clone();
            self.egui_renderer.update_egui_texture_from_wgpu_texture(
                &self.renderer.context.device,
                &picture,
                wgpu::FilterMode::Nearest,
                self.picture,
            );
            self.drawn = Some((wanted, [width, height]));
        }
        Ok(wanted != fine)
    }

    /// Saves the scene, finely sampled, as the first `lar-N.png` that does not exist yet.
    fn save_screenshot(&mut self) {
        let saved = self.screenshot();
        self.controls.message = match saved {
            Ok(path) => format!("saved {}", path.display()),
            Err(error) => error.to_string(),
        };
    }

    fn screenshot(&mut self) -> Result<PathBuf, ViewerError> {
        let Some((view, [width, height])) = self.drawn else { return Ok(PathBuf::new()) };
        let view = View { samples: self.controls.view.samples, ..view };
        self.renderer.draw(&self.scene, &view, width, height)?;
        self.drawn = None;
        let free = (1_u32..).map(|n| PathBuf::from(format!("lar-{n}.png"))).find(|path| !path.exists());
        let path = free.unwrap_or_else(|| PathBuf::from("lar.png"));
        self.renderer.read_picture()?.write_png(&path)?;
        Ok(path)
    }

    /// Draws egui's triangles onto the surface and shows it.
    fn present(&mut self, jobs: &[egui::ClippedPrimitive], pixels_per_point: f32) -> Result<(), ViewerError> {
        if let Some(texture) = self.next_texture()? {
            let Context { device, queue, .. } = &self.renderer.context;
            let size_in_pixels = [self.config.width, self.config.height];
            let screen = egui_wgpu::ScreenDescriptor { size_in_pixels, pixels_per_point };
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut buffers = self.egui_renderer.update_buffers(device, queue, &mut encoder, jobs, &screen);
            let target = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            self.egui_renderer.render(&mut surface_pass(&mut encoder, &target), jobs, &screen);
            buffers.push(encoder.finish());
            queue.submit(buffers);
            self.window.pre_present_notify();
            queue.present(texture);
        }
        self.renderer.context.check()
    }

    /// The surface's next texture; `None` when this frame is to be skipped.
    fn next_texture(&mut self) -> Result<Option<wgpu::SurfaceTexture>, ViewerError> {
        let device = &self.renderer.context.device;
        match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => {
                return Ok(Some(texture));
            }
            CurrentSurfaceTexture::Occluded => return Ok(None),
            CurrentSurfaceTexture::Timeout => {}
            CurrentSurfaceTexture::Outdated => self.surface.configure(device, &self.config),
            CurrentSurfaceTexture::Lost => {
                self.surface = new_surface(&self.instance, &self.window)?;
                self.surface.configure(device, &self.config);
            }
            CurrentSurfaceTexture::Validation => self.renderer.context.check()?,
        }
        self.window.request_redraw();
        Ok(None)
    }
}

fn egui_state(window: &Window, context: &Context) -> egui_winit::State {
    let max_side = usize::try_from(context.limits.max_texture_dimension_2d).ok();
    let scale = Some(window.scale_factor() as f32);
    let root = egui::ViewportId::ROOT;
    egui_winit::State::new(egui::Context::default(), root, window, scale, window.theme(), max_side)
}

fn new_surface(
    instance: &wgpu::Instance,
    window: &Arc<Window>,
) -> Result<wgpu::Surface<'static>, ViewerError> {
    instance.create_surface(Arc::clone(window)).map_err(|e| ViewerError::Window(e.to_string()))
}

/// The surface in a format that takes colours as they are, since egui mixes sRGB values.
fn configuration(
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
    window: &Window,
) -> Result<wgpu::SurfaceConfiguration, ViewerError> {
    let size = window.inner_size();
    let default = surface.get_default_config(adapter, size.width.max(1), size.height.max(1));
    let mut config = default.ok_or_else(|| ViewerError::Window("the window has no pixel format".into()))?;
    let formats = surface.get_capabilities(adapter).formats;
    let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    config.format = formats.into_iter().find(|f| plain.contains(f)).unwrap_or(config.format);
    config.present_mode = wgpu::PresentMode::AutoVsync;
    Ok(config)
}

fn surface_pass(encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) -> wgpu::RenderPass<'static> {
    let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store };
    let target =
        wgpu::RenderPassColorAttachment { view: target, depth_slice: None, resolve_target: None, ops };
    let descriptor = wgpu::RenderPassDescriptor {
        label: Some("window"),
        color_attachments: &[Some(target)],
        ..Default::default()
    };
    encoder.begin_render_pass(&descriptor).forget_lifetime()
}
