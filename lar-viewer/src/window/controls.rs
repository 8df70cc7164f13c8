//! The interface of a window: panels, mouse and keys change a subject and a view. Needs no window and no graphics card.

mod clicks;

pub(crate) use clicks::{Click, PickAs, Tool};

use super::exhibit::Exhibit;
use super::keys::{self, Action};
use super::navigation::Navigation;
use super::panels::{self, Capture, Texts, Tools};
use super::subject::Subject;
use crate::session::{Command, Relation};
use crate::{StandardView, View};
use egui::{Rect, Response, Ui};
use std::path::PathBuf;

/// Widths of the panels in points.
const TREE_WIDTH: f32 = 230.0;
const PANEL_WIDTH: f32 = 270.0;
/// Height of what is known of the selection, in points.
const SELECTION_HEIGHT: f32 = 300.0;
/// The most of the left panel that it takes.
const SELECTION_SHARE: f32 = 0.6;

/// What the user asked for in one frame, and where the picture goes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Asked {
    /// Area of the picture, in points.
    pub(crate) area: Rect,
    pub(crate) capture: Option<Capture>,
    pub(crate) click: Option<Click>,
    /// Files to show instead.
    pub(crate) load: Vec<PathBuf>,
    pub(crate) close: bool,
    /// The mouse is dragging the scene or a slider.
    pub(crate) dragging: bool,
}

/// The state of the interface.
pub(crate) struct Controls {
    pub(crate) view: View,
    pub(crate) subject: Subject,
    /// Shown below the picture: what was saved, loaded, refused.
    pub(crate) message: String,
    navigation: Navigation,
    tool: Tool,
    pick_as: PickAs,
    texts: Texts,
    help: bool,
    adapter: String,
    /// Width by height of the picture.
    aspect: f64,
    /// Fits the camera as soon as that is known.
    fit: bool,
}

impl Controls {
    /// `fit` fits the camera when the size of the picture is known; drawings in the plane are then seen from above.
    pub(crate) fn new(view: View, subject: Subject, adapter: String, fit: bool) -> Self {
        Self {
            view,
            subject,
            message: String::new(),
            navigation: Navigation::default(),
            tool: Tool::default(),
            pick_as: PickAs::default(),
            texts: Texts::default(),
            help: false,
            adapter,
            aspect: 1.0,
            fit,
        }
    }

    /// Lays out panels and picture and applies the input.
    pub(crate) fn show(&mut self, ui: &mut Ui, picture: egui::TextureId) -> Asked {
        let mut actions = keys::pressed(ui);
        let load = ui.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        let mut capture = self.bars(ui, &mut actions);
        let commands = self.side_panels(ui);
        let response = Self::picture(ui, picture);
        self.aspect = f64::from(response.rect.width().max(1.0) / response.rect.height().max(1.0));
        if std::mem::take(&mut self.fit) {
            self.fit_at_first();
        }
        self.navigation.mouse(ui, &response, &mut self.view.camera);
        if !(commands.is_empty() && actions.is_empty()) {
            // The panels of this frame were drawn before what they ask for is done.
            ui.ctx().request_repaint();
        }
        self.subject.apply(commands);
        let mut close = false;
        for action in actions {
            match action {
                Action::Screenshot => capture = Some(Capture::Screenshot),
                Action::Leave => close = !self.leave(),
                action => self.act(action),
            }
        }
        panels::help(ui, &mut self.help);
        if capture == Some(Capture::Camera) {
            let arguments = self.view.camera.arguments();
            self.message = format!("copied: {arguments}");
            ui.ctx().copy_text(arguments);
            capture = None;
        }
        if let Err(error) = self.subject.update() {
            self.message = error.to_string();
        }
        self.view = self.subject.view(self.view);
        let dragging = ui.input(|i| i.pointer.any_down());
        if !dragging {
            self.subject.settle();
        }
        Asked { area: response.rect, capture, click: clicks::click(&response), load, close, dragging }
    }

    fn fit_at_first(&mut self) {
        if self.subject.is_plane() {
            self.navigation.toggle_plane(&mut self.view.camera);
        }
        self.view = self.subject.view(self.view);
        self.view.camera = self.subject.fit(&self.view, self.aspect);
    }

    /// The bars above and below.
    fn bars(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) -> Option<Capture> {
        let tools =
            Tools { navigation: self.navigation, projection: self.view.camera.projection, tool: self.tool };
        let pick_as = self.subject.explored.is_some().then_some(&mut self.pick_as);
        let top = egui::Panel::top("toolbar").show(ui, |ui| panels::toolbar(ui, tools, pick_as));
        let (clicked, capture) = top.inner;
        actions.extend(clicked);
        egui::Panel::bottom("status").show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(if self.message.is_empty() { "F1 lists mouse and keys" } else { &self.message });
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.weak(&self.adapter));
            });
        });
        capture
    }

    /// To the left the tree and, below it, what is known of the selection; everything else to the right.
    fn side_panels(&mut self, ui: &mut Ui) -> Vec<Command> {
        let Some(explored) = &mut self.subject.explored else {
            let view = &mut self.view;
            egui::Panel::right("controls").default_size(PANEL_WIDTH).show(ui, |ui| {
                section(ui, "Explode", true, |ui| panels::explode_plain(ui, view));
                section(ui, "Show", true, |ui| panels::show_plain(ui, view));
            });
            return Vec::new();
        };
        let (session, queries, texts) = (&mut explored.session, &*explored.queries, &mut self.texts);
        let left = egui::Panel::left("tree").default_size(TREE_WIDTH);
        let mut commands = Vec::new();
        left.show(ui, |ui| {
            // The tree keeps some of a low window.
            let most = (SELECTION_SHARE * ui.available_height()).max(1.0);
            let below = egui::Panel::bottom("selection").default_size(SELECTION_HEIGHT).max_size(most);
            let below = below.resizable(true);
            below.show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    commands.extend(panels::inspector(ui, session));
                });
            });
            commands.extend(panels::tree(ui, session, texts));
        });
        egui::Panel::right("controls").default_size(PANEL_WIDTH).show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                section(ui, "Explode", true, |ui| panels::explode(ui, &mut session.explode));
                section(ui, "Show", true, |ui| commands.extend(panels::show(ui, session)));
                section(ui, "Clip plane", false, |ui| panels::section(ui, &mut session.section));
                section(ui, "Boolean, gift wrapping", true, |ui| {
                    commands.extend(panels::algebra(ui, session, queries, texts));
                });
                if !session.data().solids().is_empty() {
                    section(ui, "Opacity of solids", false, |ui| {
                        commands.extend(panels::solids(ui, session));
                    });
                }
            });
        });
        commands
    }

    fn picture(ui: &mut Ui, picture: egui::TextureId) -> Response {
        let central = egui::CentralPanel::no_frame().show(ui, |ui| {
            let mut response = ui.allocate_response(ui.available_size(), egui::Sense::click_and_drag());
            response.rect = whole_pixels(response.rect, ui.ctx().pixels_per_point());
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            let painter = ui.painter().with_clip_rect(response.rect);
            painter.image(picture, response.rect, whole, egui::Color32::WHITE);
            response
        });
        central.inner
    }

    fn act(&mut self, action: Action) {
        let fitted = (action == Action::Fit).then(|| self.subject.fit(&self.view, self.aspect));
        let camera = &mut self.view.camera;
        match action {
            Action::LookFrom(i) => self.navigation.look_from(StandardView::ALL[i], camera),
            Action::Fit => *camera = fitted.unwrap_or(*camera),
            Action::Projection => *camera = camera.toggle_projection(),
            Action::Plane => self.navigation.toggle_plane(camera),
            Action::Trackball => self.navigation.toggle_trackball(camera),
            Action::Help => self.help = !self.help,
            Action::Measure => {
                self.tool = if self.tool == Tool::Measure { Tool::Select } else { Tool::Measure };
            }
            action => {
                let command = self.command(action);
                self.subject.apply(command);
            }
        }
    }

    /// What an action asks of the session.
    fn command(&self, action: Action) -> Option<Command> {
        let session = &self.subject.explored.as_ref()?.session;
        let selected = session.selected();
        let picture = session.replay().map(crate::session::Replay::picture);
        match action {
            Action::Layer(dim) => Some(Command::ToggleLayer(dim.min(session.data().dim()))),
            Action::Hide => Some(Command::Hide(vec![selected?])),
            Action::Isolate => Some(Command::Isolate(vec![selected?])),
            Action::ShowAll => Some(Command::ShowAll),
            Action::Undo => Some(Command::Undo),
            Action::Redo => Some(Command::Redo),
            Action::Boundary => Some(Command::Highlight(selected?, Relation::Boundary)),
            Action::Coboundary => Some(Command::Highlight(selected?, Relation::Coboundary)),
            Action::Back => Some(Command::Back),
            Action::Next => Some(Command::GoTo(picture? + 1)),
            Action::Previous => Some(Command::GoTo(picture?.saturating_sub(1))),
            _ => None,
        }
    }

    /// Leaves the innermost thing that can be left; returns whether there was one.
    fn leave(&mut self) -> bool {
        if self.help || self.tool == Tool::Measure {
            (self.help, self.tool) = (false, Tool::Select);
            return true;
        }
        let Some(session) = self.subject.explored.as_ref().map(|e| &e.session) else { return false };
        let command = if session.replay().is_some() || session.highlight().is_some() {
            Command::ClearHighlight
        } else if session.selected().is_some() {
            Command::Select(None)
        } else {
            return false;
        };
        self.subject.apply([command]);
        true
    }

    /// Shows what was loaded, or says why not.
    pub(crate) fn loaded(&mut self, files: &[PathBuf], result: Result<Exhibit, String>) {
        let names: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
        let replaced = result.and_then(|exhibit| self.subject.replace(exhibit).map_err(|e| e.to_string()));
        self.message = match replaced {
            Ok(()) => format!("loaded {}", names.join(", ")),
            Err(error) => error,
        };
    }
}

/// A rectangle with all of the pixels that it touches: panels end between pixels.
fn whole_pixels(rect: Rect, pixels_per_point: f32) -> Rect {
    let pixels = rect * pixels_per_point;
    Rect::from_min_max(pixels.min.floor(), pixels.max.ceil()) / pixels_per_point
}

fn section<R>(ui: &mut Ui, title: &str, open: bool, add: impl FnOnce(&mut Ui) -> R) {
    egui::CollapsingHeader::new(egui::RichText::new(title).strong())
        .default_open(open)
        .show_unindented(ui, add);
}

#[cfg(test)]
mod tests;
