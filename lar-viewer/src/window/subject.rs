//! What is shown: a scene as it is, or a complex in a session, taken apart as the session asks.

use super::exhibit::Exhibit;
use crate::session::{Command, Queries, Session, Shape, Stage};
use crate::{Appearance, Bounds, Camera, Scene, View, ViewerError};
use std::sync::Arc;

/// A complex, its state, and its drawables.
pub(crate) struct Explored {
    pub(crate) session: Session,
    pub(crate) queries: Box<dyn Queries>,
    stage: Stage,
    /// What the scene was built for.
    shape: Shape,
}

/// What a window shows.
pub(crate) struct Subject {
    /// What stands out, drawn first, and the pieces.
    pub(crate) scenes: [Arc<Scene>; 2],
    /// How the drawables of the pieces look.
    pub(crate) looks: Vec<Appearance>,
    /// Each rises when its scene changes.
    pub(crate) revisions: [u64; 2],
    pub(crate) explored: Option<Explored>,
    bounds: Option<Bounds>,
}

impl Subject {
    /// A scene as it is.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn scene(scene: Scene) -> Self {
        Self::pieces(Arc::new(scene), Scene::new())
    }

    fn pieces(pieces: Arc<Scene>, standing_out: Scene) -> Self {
        let (looks, bounds) = (pieces.appearances(), pieces.bounds([1.0; 3]));
        Self { scenes: [Arc::new(standing_out), pieces], looks, revisions: [0; 2], explored: None, bounds }
    }

    /// A complex in a session.
    pub(crate) fn complex(mut session: Session, queries: Box<dyn Queries>) -> Result<Self, ViewerError> {
        session.forget_past();
        let shape = session.shape();
        let stage = Stage::new(session.data(), shape.pieces)?;
        let mut subject = Self::pieces(Arc::clone(stage.pieces()), stage.standing_out(&session)?);
        subject.looks = stage.appearances(&session);
        subject.explored = Some(Explored { session, queries, stage, shape });
        Ok(subject)
    }

    /// Shows another complex with the same settings.
    pub(crate) fn replace(&mut self, exhibit: Exhibit) -> Result<(), ViewerError> {
        let Some(explored) = &self.explored else { return Ok(()) };
        let session = explored.session.with_data(exhibit.data);
        let revisions = self.revisions.map(|r| r + 1);
        *self = Self { revisions, ..Self::complex(session, exhibit.queries)? };
        Ok(())
    }

    /// Does what is asked, if there is a session to do it.
    pub(crate) fn apply(&mut self, commands: impl IntoIterator<Item = Command>) {
        if let Some(explored) = &mut self.explored {
            commands.into_iter().for_each(|command| explored.session.apply(command));
        }
    }

    /// Remembers what is visible as a step to be undone.
    pub(crate) fn settle(&mut self) {
        self.explored.iter_mut().for_each(|explored| explored.session.settle());
    }

    /// Follows the session: looks always, what stands out when it is something else, the pieces when they are finer or
    /// coarser.
    pub(crate) fn update(&mut self) -> Result<(), ViewerError> {
        let Some(Explored { session, stage, shape, .. }) = &mut self.explored else { return Ok(()) };
        let wanted = session.shape();
        if *shape != wanted {
            if stage.fineness() != wanted.pieces {
                *stage = Stage::new(session.data(), wanted.pieces)?;
                self.scenes[1] = Arc::clone(stage.pieces());
                self.revisions[1] += 1;
            }
            *shape = wanted;
            self.scenes[0] = Arc::new(stage.standing_out(session)?);
            self.revisions[0] += 1;
        }
        self.looks = stage.appearances(session);
        Ok(())
    }

    /// The view with what the session says of it.
    pub(crate) fn view(&self, view: View) -> View {
        let Some(Explored { session, .. }) = &self.explored else { return view };
        let clip = self.bounds.as_ref().and_then(|bounds| session.section.clip(bounds));
        let (explode, outline) = (session.explode.explosion(), session.outline());
        View { explode, outline, background: session.background, clip, ..view }
    }

    /// Whether it is a complex in the plane.
    pub(crate) fn is_plane(&self) -> bool {
        self.explored.as_ref().is_some_and(|e| e.session.data().complex().points().dim() == 2)
    }

    /// The camera with everything visible in the picture; the whole scene when nothing is.
    pub(crate) fn fit(&self, view: &View, aspect: f64) -> Camera {
        let points = self.scenes[1].visible_points(&self.looks, view.explode);
        let mut points = points.peekable();
        if points.peek().is_none() {
            view.fit(&self.scenes[1], aspect).camera
        } else {
            view.camera.fit_points(points, aspect)
        }
    }
}
