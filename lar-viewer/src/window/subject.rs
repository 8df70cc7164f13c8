//! What is shown: a scene as it is, or a complex in a session, taken apart as the session asks.

use super::exhibit::{Exhibit, Queries};
use crate::session::{Command, Session, Shape, Stage};
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
    pub(crate) scene: Arc<Scene>,
    /// How the drawables look.
    pub(crate) looks: Vec<Appearance>,
    /// Rises when the scene changes.
    pub(crate) revision: u64,
    pub(crate) explored: Option<Explored>,
    bounds: Option<Bounds>,
}

impl Subject {
    /// A scene as it is.
    pub(crate) fn scene(scene: Scene) -> Self {
        let (looks, bounds) = (scene.appearances(), scene.bounds([1.0; 3]));
        Self { scene: Arc::new(scene), looks, revision: 0, explored: None, bounds }
    }

    /// A complex in a session.
    pub(crate) fn complex(session: Session, queries: Box<dyn Queries>) -> Result<Self, ViewerError> {
        let shape = session.shape();
        let stage = Stage::new(session.data(), shape.pieces)?;
        let mut subject = Self::scene(stage.scene(&session)?);
        subject.explored = Some(Explored { session, queries, stage, shape });
        Ok(subject)
    }

    /// Shows another complex with the same settings.
    pub(crate) fn replace(&mut self, exhibit: Exhibit) -> Result<(), ViewerError> {
        let Some(explored) = &self.explored else { return Ok(()) };
        let session = explored.session.with_data(exhibit.data);
        let revision = self.revision + 1;
        *self = Self { revision, ..Self::complex(session, exhibit.queries)? };
        Ok(())
    }

    /// Does what is asked, if there is a session to do it.
    pub(crate) fn apply(&mut self, commands: impl IntoIterator<Item = Command>) {
        if let Some(explored) = &mut self.explored {
            commands.into_iter().for_each(|command| explored.session.apply(command));
        }
    }

    /// Follows the session: looks always, the scene when other things are drawn.
    pub(crate) fn update(&mut self) -> Result<(), ViewerError> {
        let Some(Explored { session, stage, shape, .. }) = &mut self.explored else { return Ok(()) };
        let wanted = session.shape();
        if *shape != wanted {
            if stage.pieces() != wanted.pieces {
                *stage = Stage::new(session.data(), wanted.pieces)?;
            }
            *shape = wanted;
            self.scene = Arc::new(stage.scene(session)?);
            self.revision += 1;
        }
        self.looks = stage.appearances(&self.scene, session);
        Ok(())
    }

    /// The view with what the session says of it.
    pub(crate) fn view(&self, view: View) -> View {
        let Some(Explored { session, .. }) = &self.explored else { return view };
        let clip = self.bounds.as_ref().and_then(|bounds| session.section.clip(bounds));
        View { explode: session.explode.explosion(), background: session.background, clip, ..view }
    }

    /// Whether it is a complex in the plane.
    pub(crate) fn is_plane(&self) -> bool {
        self.explored.as_ref().is_some_and(|e| e.session.data().complex().points().dim() == 2)
    }

    /// The camera with everything visible in the picture; the whole scene when nothing is.
    pub(crate) fn fit(&self, view: &View, aspect: f64) -> Camera {
        let points = self.scene.visible_points(&self.looks, view.explode);
        let mut points = points.peekable();
        if points.peek().is_none() {
            view.fit(&self.scene, aspect).camera
        } else {
            view.camera.fit_points(points, aspect)
        }
    }
}
