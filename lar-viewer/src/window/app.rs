//! The event loop's side: one window from its creation to its end.

use super::controls::Controls;
use super::exhibit::Exploration;
use super::loader::{Loaded, Loader};
use super::painter::Painter;
use super::subject::Subject;
use crate::{Scene, View, ViewerError};
use std::sync::Arc;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, OwnedDisplayHandle};
use winit::window::{Window, WindowId};

/// Size of a new window, in logical pixels.
const SIZE: LogicalSize<u32> = LogicalSize::new(1280, 780);

/// What a window is opened on.
pub(crate) enum Contents {
    Scene(Box<(Scene, View)>),
    Complex(Box<Exploration>),
}

/// What a window begins with.
struct Waiting {
    view: View,
    subject: Subject,
    /// Nobody chose the camera.
    fit: bool,
}

/// The state of [`super::view`] and [`super::explore`].
pub(crate) struct App {
    title: String,
    display: OwnedDisplayHandle,
    /// The view and the subject, until there is a window to show them in.
    waiting: Option<Waiting>,
    loader: Option<Loader>,
    painter: Option<Painter>,
    result: Result<(), ViewerError>,
}

impl App {
    pub(crate) fn new(
        contents: Contents,
        title: String,
        event_loop: &EventLoop<Loaded>,
    ) -> Result<Self, ViewerError> {
        let (waiting, loader) = match contents {
            Contents::Scene(shown) => {
                (Waiting { view: shown.1, subject: Subject::scene(shown.0), fit: false }, None)
            }
            Contents::Complex(exploration) => {
                let Exploration { session, queries, source, files, camera, .. } = *exploration;
                let subject = Subject::complex(session, queries)?;
                let view = View { camera: camera.unwrap_or_default(), ..View::default() };
                let proxy = event_loop.create_proxy();
                // Without a loop there is no one to tell.
                let loader = Loader::start(source, files, move |loaded| _ = proxy.send_event(loaded));
                (Waiting { view, subject, fit: camera.is_none() }, Some(loader))
            }
        };
        let display = event_loop.owned_display_handle();
        Ok(Self { title, display, waiting: Some(waiting), loader, painter: None, result: Ok(()) })
    }

    /// The error that closed the window, if one did.
    pub(crate) fn into_result(self) -> Result<(), ViewerError> {
        self.result
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some(Waiting { view, subject, fit }) = self.waiting.take() else { return Ok(()) };
        let attributes = Window::default_attributes().with_title(self.title.as_str()).with_inner_size(SIZE);
        let window = event_loop.create_window(attributes).map_err(|e| ViewerError::Window(e.to_string()))?;
        let controls = |adapter| Controls::new(view, subject, adapter, fit);
        let painter = Painter::new(Arc::new(window), &self.display, controls)?;
        painter.window().request_redraw();
        self.painter = Some(painter);
        Ok(())
    }

    fn close_on_error(&mut self, event_loop: &ActiveEventLoop, result: Result<(), ViewerError>) {
        if result.is_err() {
            self.result = result;
            event_loop.exit();
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some(painter) = &mut self.painter else { return Ok(()) };
        let after = painter.frame()?;
        if after.close {
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
                painter.resize(size.width, size.height);
                painter.window().request_redraw();
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
