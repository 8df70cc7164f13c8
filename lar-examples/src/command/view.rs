//! `lar view`: a window on the arrangement of the inputs, to be asked and taken apart.

use super::camera::CameraArguments;
use super::input::Inputs;
#[cfg(feature = "viewer")]
use super::picture::{Accent, Look};
use crate::CommandError;

/// A window on the inputs' arrangement. Inputs are surfaces in space or drawings in the plane (.svg, .seg).
#[derive(Debug, clap::Args)]
#[command(after_help = "F1 in the window lists mouse and keys; files can be dropped on it.\n\nExamples:\n  \
    lar view a.obj b.obj\n  \
    lar view a.obj b.obj --explode 1.5 --color solid --numbers cells\n  \
    lar view plan.svg --numbers faces\n  \
    lar view Box=a.stl Ball=b.stl --eye 4,-6,3 --target 0,0,0")]
pub(crate) struct Window {
    #[command(flatten)]
    inputs: Inputs,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    look: Look,
    #[cfg(feature = "viewer")]
    #[command(flatten)]
    accent: Accent,
    #[command(flatten)]
    camera: CameraArguments,
}

#[cfg(not(feature = "window"))]
impl Window {
    #[expect(clippy::unused_self, reason = "the same call with and without the window")]
    pub(crate) fn run(&self) -> Result<(), CommandError> {
        Err(CommandError::NotBuilt { feature: "window" })
    }
}

#[cfg(feature = "window")]
mod with_window {
    use super::{CommandError, Window};
    use crate::command::input::named;
    use crate::command::picture::{cells, cells_of};
    use crate::exploration::Explored;
    use lar_arrangement::Arranger;
    use lar_viewer::{Exhibit, Exploration, NoQueries, Queries, Source};
    use std::path::PathBuf;

    impl Window {
        pub(crate) fn run(&self) -> Result<(), CommandError> {
            let (data, explored) = cells(&self.inputs, Explored::new)?;
            let queries = queries(explored);
            let mut session = self.look.session(data)?;
            self.accent.apply(&mut session, &*queries)?;
            // Without an eye, the window fits the camera to the size that it has.
            let camera = self.camera.camera(|lens| lens)?;
            let (names, files): (Vec<String>, Vec<PathBuf>) = self.inputs.named()?.into_iter().unzip();
            lar_viewer::explore(Exploration {
                session,
                queries,
                source: Box::new(Files { names, files: files.clone() }),
                files,
                camera: self.camera.is_placed().then_some(camera),
                title: "lar".to_owned(),
            })?;
            Ok(())
        }
    }

    /// What can be asked of an arrangement of space; nothing of one of the plane.
    fn queries(explored: Option<Explored>) -> Box<dyn Queries> {
        explored.map_or_else(|| Box::new(NoQueries) as Box<dyn Queries>, |explored| Box::new(explored))
    }

    /// Arranges files when they change or are dropped on the window. The first ones keep their names.
    struct Files {
        names: Vec<String>,
        files: Vec<PathBuf>,
    }

    impl Source for Files {
        fn load(&self, files: &[PathBuf]) -> Result<Exhibit, String> {
            self.arranged(files).map_err(|error| error.to_string())
        }
    }

    impl Files {
        fn arranged(&self, files: &[PathBuf]) -> Result<Exhibit, CommandError> {
            let named = if files == self.files {
                self.names.iter().cloned().zip(files.iter().cloned()).collect()
            } else {
                named(files)?
            };
            let arranged = |surfaces: &[_]| Arranger::new().arrange(surfaces);
            let (data, explored) = cells_of(named, arranged, Explored::new)?;
            Ok(Exhibit { data, queries: queries(explored) })
        }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn files_keep_their_names_and_bad_ones_are_named() {
            let dir = tempfile::tempdir().unwrap();
            let [cube, other] = ["cube.obj", "other.obj"].map(|name| dir.path().join(name));
            let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
            std::fs::write(&cube, text).unwrap();
            let files = Files { names: vec!["tip".to_owned()], files: vec![cube.clone()] };
            assert_eq!(files.load(std::slice::from_ref(&cube)).unwrap().data.solids(), ["tip"]);
            std::fs::write(&other, text.replace("v 0 0 1", "v 0 0 2")).unwrap();
            let dropped = files.load(&[cube.clone(), other.clone()]).unwrap();
            assert_eq!(dropped.data.solids(), ["A", "B"]);
            assert!(dropped.queries.boolean("B - A").unwrap().entries().len() == 1);
            std::fs::write(&other, "v 0 0\n").unwrap();
            let error = files.load(&[other]).unwrap_err();
            assert!(error.contains("other.obj") && !error.contains('\n'), "{error}");
            let drawing = dir.path().join("square.seg");
            std::fs::write(&drawing, "0 0 1 0\n1 0 1 1\n1 1 0 0\n").unwrap();
            let plane = files.load(&[drawing]).unwrap();
            assert_eq!((plane.data.dim(), plane.data.n_cells(2)), (2, 2), "a triangle and the exterior");
        }
    }
}
