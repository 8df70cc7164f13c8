//! The event loop's side: one window from its creation to its end.

use super::controls::Controls;
use super::host::Host;
use super::loader::{Loaded, Loader};
use super::painter::Painter;
use super::subject::Subject;
use crate::session::{Queries, Session};
use crate::{Camera, View, ViewerError};
use std::sync::Arc;
use web_time::Instant;
use winit::application::ApplicationHandler;
#[cfg(not(target_arch = "wasm32"))]
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, OwnedDisplayHandle};
use winit::window::{Window, WindowAttributes, WindowId};

/// Size of a new window, in logical pixels.
#[cfg(not(target_arch = "wasm32"))]
const SIZE: LogicalSize<u32> = LogicalSize::new(1280, 780);

/// What a window is opened on.
pub(crate) struct Contents {
    view: View,
    subject: Subject,
    /// Nobody chose the camera.
    fit: bool,
}

impl Contents {
    /// A scene as it is.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn scene(scene: crate::Scene, view: View) -> Self {
        Self { view, subject: Subject::scene(scene), fit: false }
    }

    /// A complex, seen from a camera, which may be fitted first.
    pub(crate) fn complex(
        session: Session,
        queries: Box<dyn Queries>,
        camera: Camera,
        fit: bool,
    ) -> Result<Self, ViewerError> {
        camera.validate()?;
        let view = View { camera, ..View::default() };
        Ok(Self { view, subject: Subject::complex(session, queries)?, fit })
    }
}

/// The state of a window.
pub(crate) struct App {
    title: String,
    display: OwnedDisplayHandle,
    /// What is shown and where, until there is a window to show it in.
    waiting: Option<(Contents, Box<dyn Host>)>,
    loader: Option<Loader>,
    painter: Option<Painter>,
    /// Is told the error that closes the window.
    failed: Box<dyn FnMut(ViewerError)>,
}

impl App {
    /// A window that is opened when the loop of events runs; `failed` is told the error that closes it.
    pub(crate) fn new(
        contents: Contents,
        title: String,
        display: OwnedDisplayHandle,
        host: Box<dyn Host>,
        failed: Box<dyn FnMut(ViewerError)>,
    ) -> Self {
        Self { title, display, waiting: Some((contents, host)), loader: None, painter: None, failed }
    }

    /// With a loader of files that change or are dropped on the window.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn with_loader(self, loader: Loader) -> Self {
        Self { loader: Some(loader), ..self }
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some((Contents { view, subject, fit }, host)) = self.waiting.take() else { return Ok(()) };
        let attributes = placed(Window::default_attributes().with_title(self.title.as_str()));
        let window = event_loop.create_window(attributes).map_err(|e| ViewerError::Window(e.to_string()))?;
        let controls = |adapter| Controls::new(view, subject, adapter, fit);
        let painter = Painter::new(Arc::new(window), &self.display, host, controls)?;
        painter.window().request_redraw();
        self.painter = Some(painter);
        Ok(())
    }

    fn close_on_error(&mut self, event_loop: &ActiveEventLoop, result: Result<(), ViewerError>) {
        if let Err(error) = result {
            (self.failed)(error);
            event_loop.exit();
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some(painter) = &mut self.painter else { return Ok(()) };
        let after = painter.frame()?;
        // A page stays until the browser closes it.
        if after.close && cfg!(not(target_arch = "wasm32")) {
            event_loop.exit();
        }
        if let (Some(loader), false) = (&self.loader, after.load.is_empty()) {
            loader.load(after.load);
        }
        if let Some(wake) = after.repaint_in.and_then(|delay| Instant::now().checked_add(delay)) {
            event_loop.set_control_flow(ControlFlow::WaitUntil(wake));
        }
        Ok(())
    }
}

/// A window of its own.
#[cfg(not(target_arch = "wasm32"))]
fn placed(attributes: WindowAttributes) -> WindowAttributes {
    attributes.with_inner_size(SIZE)
}

/// A canvas at the end of the page, whose style says how large it is.
#[cfg(target_arch = "wasm32")]
fn placed(attributes: WindowAttributes) -> WindowAttributes {
    winit::platform::web::WindowAttributesExtWebSys::with_append(attributes, true)
}

impl ApplicationHandler<Loaded> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let opened = self.open(event_loop);
        self.close_on_error(event_loop, opened);
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(painter)) = (cause, &self.painter) {
            event_loop.set_control_flow(ControlFlow::Wait);
            painter.window().request_redraw();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, (files, result): Loaded) {
        if let Some(painter) = &mut self.painter {
            painter.controls().loaded(&files, result);
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
                let resized = painter.resize(size.width, size.height);
                painter.window().request_redraw();
                self.close_on_error(event_loop, resized);
            }
            WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Occluded(false) => {
                painter.window().request_redraw();
            }
            WindowEvent::RedrawRequested => {
                let drawn = self.redraw(event_loop);
                self.close_on_error(event_loop, drawn);
            }
            _ => {}
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.painter = None;
    }
}
