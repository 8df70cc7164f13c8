//! Draws a window: the scene into its texture, egui around it, both onto the surface.

use super::capture::{self, Recording};
use super::controls::{Asked, Click, Controls};
use super::host::Host;
use super::input::split_off_later;
use super::panels::Capture;
use super::picture::Picture;
use super::surface::{self, Surface};
use crate::gpu::context::{Context, best_adapter};
use crate::gpu::renderer::Renderer;
use crate::{View, ViewerError};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use web_time::Instant;
use winit::event::WindowEvent;
use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

/// Everything behind one window.
pub(crate) struct Painter {
    window: Arc<Window>,
    surface: Surface,
    picture: Picture,
    controls: Controls,
    egui: egui_winit::State,
    egui_renderer: egui_wgpu::Renderer,
    shown: egui::TextureId,
    recording: Option<Recording>,
    host: Box<dyn Host>,
    begun: Instant,
}

/// What comes after a frame.
pub(crate) struct After {
    pub(crate) close: bool,
    /// Files to show instead.
    pub(crate) load: Vec<PathBuf>,
    /// Draw again after this time even without input.
    pub(crate) repaint_in: Option<Duration>,
}

impl Painter {
    /// A window with the controls that are made when the adapter's name is known.
    pub(crate) fn new(
        window: Arc<Window>,
        display: &OwnedDisplayHandle,
        host: Box<dyn Host>,
        controls: impl FnOnce(String) -> Controls,
    ) -> Result<Self, ViewerError> {
        let (instance, surface) = Surface::unconfigured(&window, display)?;
        let adapter = best_adapter(&instance, Some(&surface))?;
        let renderer = Renderer::new(Context::on(&adapter)?)?;
        let surface = Surface::new(Arc::clone(&window), instance, surface, &adapter)?;
        let controls = controls(renderer.context.adapter_name.clone());
        let mut picture = Picture::new(renderer, &controls.subject)?;
        // A first picture of one pixel, so that egui has a texture to name.
        let (first, _) = picture.draw(&controls.view, [1, 1], false)?;
        let first = first.expect("nothing was drawn before, so this picture is new");
        let device = &picture.renderer.context.device;
        let options = egui_wgpu::RendererOptions::default();
        let mut egui_renderer = egui_wgpu::Renderer::new(device, surface.config.format, options);
        let shown = egui_renderer.register_native_texture(device, &first, wgpu::FilterMode::Nearest);
        let egui = egui_state(&window, &picture.renderer.context);
        let size = window.inner_size();
        let mut painter = Self {
            window,
            surface,
            picture,
            controls,
            egui,
            egui_renderer,
            shown,
            recording: None,
            host,
            begun: Instant::now(),
        };
        painter.resize(size.width, size.height)?;
        Ok(painter)
    }

    pub(crate) fn window(&self) -> &Window {
        &self.window
    }

    pub(crate) fn controls(&mut self) -> &mut Controls {
        &mut self.controls
    }

    /// Hands an event to egui; returns whether it asks for a new frame.
    pub(crate) fn on_event(&mut self, event: &WindowEvent) -> bool {
        let repaint = self.egui.on_window_event(&self.window, event).repaint;
        repaint && !matches!(event, WindowEvent::RedrawRequested)
    }

    /// Follows the size of the window; a window without area is not drawn.
    pub(crate) fn resize(&mut self, width: u32, height: u32) -> Result<(), ViewerError> {
        self.surface.resize(&self.picture.renderer.context, width, height)
    }

    /// Runs the interface and draws one frame.
    pub(crate) fn frame(&mut self) -> Result<After, ViewerError> {
        if self.surface.is_empty() {
            return Ok(After { close: false, load: Vec::new(), repaint_in: None });
        }
        let mut input = self.input();
        let context = self.egui.egui_ctx().clone();
        let down = context.input(|i| i.pointer.press_origin());
        let later = split_off_later(&mut input.events, down);
        let mut asked = None;
        let mut output = context.run_ui(input, |ui| asked = Some(self.controls.show(ui, self.shown)));
        let unused = self.update_textures(&mut output.textures_delta);
        self.copy(&output.platform_output);
        self.egui.handle_platform_output(&self.window, output.platform_output);
        let mut repaint_in = output.viewport_output.values().map(|v| v.repaint_delay).min();
        if let Some(asked) = &asked {
            self.answer(asked, output.pixels_per_point)?;
        }
        let jobs = context.tessellate(output.shapes, output.pixels_per_point);
        self.present(&jobs, output.pixels_per_point)?;
        unused.iter().for_each(|id| self.egui_renderer.free_texture(id));
        if repaint_in == Some(Duration::ZERO) || !later.is_empty() {
            self.window.request_redraw();
            repaint_in = None;
        }
        self.egui.egui_input_mut().events.splice(..0, later);
        let (close, load) = asked.map_or((false, Vec::new()), |asked| (asked.close, asked.load));
        Ok(After { close, load, repaint_in })
    }

    /// What has happened since the last frame. The size is that of the surface: a window that is gone cannot be asked.
    fn input(&mut self) -> egui::RawInput {
        let (context, scale) = (self.egui.egui_ctx().clone(), self.window.scale_factor() as f32);
        let pixels = [self.surface.config.width, self.surface.config.height].map(|s| s as f32);
        let size = egui::Vec2::from(pixels) / (context.zoom_factor() * scale);
        let input = self.egui.egui_input_mut();
        input.time = Some(self.begun.elapsed().as_secs_f64());
        input.screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size));
        input.viewport_id = egui::ViewportId::ROOT;
        input.viewports.entry(egui::ViewportId::ROOT).or_default().native_pixels_per_point = Some(scale);
        input.take()
    }

    /// Looks up clicks, draws the scene, saves what is to be saved.
    fn answer(&mut self, asked: &Asked, pixels_per_point: f32) -> Result<(), ViewerError> {
        let limit = self.picture.renderer.context.limits.max_texture_dimension_2d;
        let size = asked.area.size() * pixels_per_point;
        let size = [size.x, size.y].map(|s| (s.round() as u32).clamp(1, limit));
        self.picture.follow(&self.controls.subject)?;
        if let Some(click) = asked.click {
            self.look_up(click, size, pixels_per_point)?;
        }
        let view = self.view(pixels_per_point);
        if self.recording.is_none() {
            self.draw(&view, size, asked.dragging)?;
        }
        if asked.capture.is_some() || self.recording.is_some() {
            if let Err(error) = self.save(asked.capture, &view, size) {
                self.recording = None;
                self.controls.message = error.to_string();
            }
            self.window.request_redraw();
        }
        Ok(())
    }

    /// Draws the scene where it has changed; what was drawn coarsely is drawn again when the mouse rests.
    fn draw(&mut self, view: &View, size: [u32; 2], dragging: bool) -> Result<(), ViewerError> {
        let (texture, coarse) = self.picture.draw(view, size, dragging)?;
        if let Some(texture) = texture {
            let device = &self.picture.renderer.context.device;
            let nearest = wgpu::FilterMode::Nearest;
            self.egui_renderer.update_egui_texture_from_wgpu_texture(device, &texture, nearest, self.shown);
        }
        if coarse && !dragging {
            self.window.request_redraw();
        }
        Ok(())
    }

    fn view(&self, pixels_per_point: f32) -> View {
        let scale = (self.controls.view.scale * pixels_per_point).clamp(0.01, 100.0);
        View { scale, ..self.controls.view }
    }

    fn look_up(&mut self, click: Click, size: [u32; 2], pixels_per_point: f32) -> Result<(), ViewerError> {
        let pixel = [0, 1].map(|k| ((click.at[k] * pixels_per_point) as u32).min(size[k] - 1));
        let view = self.view(pixels_per_point);
        let hit = self.picture.pick(&self.controls.subject, &view, size, pixel)?;
        self.controls.clicked(click, hit);
        self.picture.follow(&self.controls.subject)?;
        self.window.request_redraw();
        Ok(())
    }

    /// Saves a picture, or begins or goes on with a turn.
    fn save(&mut self, capture: Option<Capture>, view: &View, size: [u32; 2]) -> Result<(), ViewerError> {
        match capture {
            Some(Capture::Screenshot) => {
                let name = capture::screenshot(&self.picture.read(view, size)?, &mut *self.host)?;
                self.controls.message = format!("saved {name}");
            }
            Some(Capture::Frames) => self.recording = Some(Recording::frames(view, size, &*self.host)),
            Some(Capture::Animation) => self.recording = Some(Recording::animation(view, size)?),
            Some(Capture::Camera) | None => {}
        }
        if let Some(recording) = &mut self.recording {
            let (view, size) = recording.next();
            let (message, last) = recording.push(&self.picture.read(&view, size)?, &mut *self.host)?;
            self.controls.message = message;
            if last {
                self.recording = None;
            }
        }
        Ok(())
    }

    /// Puts what was copied on the clipboard of the system.
    fn copy(&mut self, output: &egui::PlatformOutput) {
        for command in &output.commands {
            if let egui::OutputCommand::CopyText(text) = command {
                self.host.copy(text);
            }
        }
    }

    /// Uploads egui's new textures; returns those that are to be freed after the frame.
    fn update_textures(&mut self, textures: &mut egui::TexturesDelta) -> Vec<egui::TextureId> {
        let Context { device, queue, .. } = &self.picture.renderer.context;
        for (id, deltas) in textures.set.drain() {
            deltas.iter().for_each(|delta| self.egui_renderer.update_texture(device, queue, id, delta));
        }
        textures.free.drain().collect()
    }

    /// Draws egui's triangles onto the surface and shows it.
    fn present(&mut self, jobs: &[egui::ClippedPrimitive], pixels_per_point: f32) -> Result<(), ViewerError> {
        let context = &self.picture.renderer.context;
        if let Some(texture) = self.surface.next_texture(context)? {
            let Context { device, queue, .. } = context;
            let size_in_pixels = [self.surface.config.width, self.surface.config.height];
            let screen = egui_wgpu::ScreenDescriptor { size_in_pixels, pixels_per_point };
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut buffers = self.egui_renderer.update_buffers(device, queue, &mut encoder, jobs, &screen);
            let target = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            self.egui_renderer.render(&mut surface::pass(&mut encoder, &target), jobs, &screen);
            buffers.push(encoder.finish());
            queue.submit(buffers);
            self.window.pre_present_notify();
            queue.present(texture);
        }
        context.check()
    }
}

fn egui_state(window: &Window, gpu: &Context) -> egui_winit::State {
    let max_side = usize::try_from(gpu.limits.max_texture_dimension_2d).ok();
    let scale = Some(window.scale_factor() as f32);
    let root = egui::ViewportId::ROOT;
    let context = egui::Context::default();
    // On a slow driver press and release may be frames apart: only moving makes a click a drag.
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
    egui_winit::State::new(context, root, window, scale, window.theme(), max_side)
}
