//! The event loop's side: one window from its creation to its end.

use super::painter::Painter;
use crate::{Scene, View, ViewerError};
use std::sync::Arc;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, OwnedDisplayHandle};
use winit::window::{Window, WindowId};

/// Size of a new window, in logical pixels.
const SIZE: LogicalSize<u32> = LogicalSize::new(1200, 760);

/// The state of [`super::view`].
pub(crate) struct App {
    scene: Arc<Scene>,
    view: View,
    title: String,
    display: OwnedDisplayHandle,
    painter: Option<Painter>,
    result: Result<(), ViewerError>,
}

impl App {
    pub(crate) fn new(scene: Scene, view: View, title: String, display: OwnedDisplayHandle) -> Self {
        Self { scene: Arc::new(scene), view, title, display, painter: None, result: Ok(()) }
    }

    /// The error that closed the window, if one did.
    pub(crate) fn into_result(self) -> Result<(), ViewerError> {
        self.result
    }

    fn open(&self, event_loop: &ActiveEventLoop) -> Result<Painter, ViewerError> {
        let attributes = Window::default_attributes().with_title(self.title.as_str()).with_inner_size(SIZE);
        let window = event_loop.create_window(attributes).map_err(|e| ViewerError::Window(e.to_string()))?;
        Painter::new(Arc::new(window), &self.display, &self.scene, self.view)
    }

    fn close_on_error(&mut self, event_loop: &ActiveEventLoop, result: Result<(), ViewerError>) {
        if result.is_err() {
            self.result = result;
            event_loop.exit();
        }
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.painter.is_none() {
            match self.open(event_loop) {
                Ok(painter) => {
                    painter.window().request_redraw();
                    self.painter = Some(painter);
                }
                Err(error) => self.close_on_error(event_loop, Err(error)),
            }
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(painter)) = (cause, &self.painter) {
            event_loop.set_control_flow(ControlFlow::Wait);
            painter.window().request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(painter) = &mut self.painter else { return };
        if painter.on_event(&event) {
            painter.window().request_redraw();
        }
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => event_loop.exit(),
            WindowEvent::Resized(size) => {
                painter.resize(size.width, size.height);
                painter.window().request_redraw();
            }
            WindowEvent::ScaleFactorChanged { .. } => painter.window().request_redraw(),
            WindowEvent::RedrawRequested => match painter.frame() {
                Ok(after) if after.close => event_loop.exit(),
                Ok(after) => {
                    if let Some(wake) = after.repaint_in.and_then(|delay| Instant::now().checked_add(delay)) {
                        event_loop.set_control_flow(ControlFlow::WaitUntil(wake));
                    }
                }
                Err(error) => self.close_on_error(event_loop, Err(error)),
            },
            _ => {}
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.painter = None;
    }
}
