//! What the commands refuse, and the exit codes.

use lar_arrangement::{ArrangementError, BooleanError, ExpressionError};
use lar_core::{FileError, IntegrationError, JsonError, MeshFileError, ModelJsonError, ObjError, SvgError};
use lar_triangle::TriangulateError;
use std::io;
use std::path::PathBuf;

/// Why a command ends without its result. The message is one line; [`exit_code`](Self::exit_code) tells a missing
/// graphics adapter from everything else.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CommandError {
    /// The arguments are not what the command takes.
    #[error("{0}")]
    Usage(String),
    /// An input file cannot be read, or a mesh cannot be written.
    #[error(transparent)]
    Mesh(#[from] MeshFileError),
    /// An OBJ file cannot be written.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// An SVG drawing cannot be read.
    #[error(transparent)]
    Svg(#[from] SvgError),
    /// A chain complex cannot be read or written.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The path.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A model or hierarchy cannot be read.
    #[error(transparent)]
    Model(#[from] ModelJsonError),
    /// A file breaks the rules of what it holds.
    #[error("{}: {}", .path.display(), if *.violations == 1 { "1 violation".to_owned() } else { format!("{} violations", .violations) })]
    Invalid {
        /// The file.
        path: PathBuf,
        /// How many.
        violations: usize,
    },
    /// A surface encloses no space.
    #[error("{}: the surface encloses nothing", .path.display())]
    EnclosesNothing {
        /// The file.
        path: PathBuf,
    },
    /// A complex has no faces to be written as a surface.
    #[error("{}: edges without faces cannot be written as a surface", .path.display())]
    NoFaces {
        /// The file.
        path: PathBuf,
    },
    /// What is to be drawn does not lie in the plane.
    #[error("{}: only drawings and complexes of the plane can be written as {}", .path.display(), .output.display())]
    NotPlanar {
        /// The file.
        path: PathBuf,
        /// The file to be written.
        output: PathBuf,
    },
    /// Mass properties cannot be computed.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// A file or directory cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// The path.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The directory for the cells has something in it that would be lost.
    #[error("cannot write {}: the directory is not empty", .path.display())]
    NotEmpty {
        /// The directory.
        path: PathBuf,
    },
    /// Two operands have one name.
    #[error("two operands are named {name}: {} and {}", .files[0].display(), .files[1].display())]
    SameName {
        /// The name.
        name: String,
        /// Their files.
        files: [PathBuf; 2],
    },
    /// An input is a chain complex where surfaces are needed.
    #[error("{}: a chain complex cannot be an operand; operands are OBJ, STL, PLY or OFF files", .path.display())]
    NotASurface {
        /// The file.
        path: PathBuf,
    },
    /// An input is no drawing.
    #[error("{}: drawings are .svg or .seg files", .path.display())]
    NotADrawing {
        /// The file.
        path: PathBuf,
    },
    /// A drawing has no segments.
    #[error("{}: nothing is drawn there", .path.display())]
    NothingDrawn {
        /// The file.
        path: PathBuf,
    },
    /// Two regions of drawings have one name.
    #[error(
        "two regions are named {name}; give the drawings other names, by NAME=PATH, or the elements other ids"
    )]
    SameRegion {
        /// The name.
        name: String,
    },
    /// The result of a Boolean in the plane reaches to infinity.
    #[error("{expression}: the result is unbounded")]
    Unbounded {
        /// The expression.
        expression: String,
    },
    /// A picture of the plane is neither SVG nor PNG.
    #[error("{}: pictures are .svg or .png files", .path.display())]
    PictureFormat {
        /// The file.
        path: PathBuf,
    },
    /// The input cannot be arranged.
    #[error(transparent)]
    Arrangement(#[from] ArrangementError),
    /// The text is not an expression over the operands.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// An operand is no solid.
    #[error("{}{source}", file.as_ref().map_or(String::new(), |f| format!("{}: ", f.display())))]
    Boolean {
        /// Its file, when it comes from one.
        file: Option<PathBuf>,
        /// What is wrong with it.
        source: BooleanError,
    },
    /// Two outputs of one command go to the same place.
    #[error("two outputs go to {}", .path.display())]
    SameOutput {
        /// The place.
        path: PathBuf,
    },
    /// An example scene gives no surfaces.
    #[error(transparent)]
    Scene(#[from] crate::scenes::SceneError),
    /// Faces cannot be triangulated.
    #[error(transparent)]
    Triangulate(#[from] TriangulateError),
    /// A picture cannot be drawn or a window opened.
    #[cfg(feature = "viewer")]
    #[error(transparent)]
    Viewer(#[from] lar_viewer::ViewerError),
    /// The viewer for browsers was not built.
    #[error(
        "the viewer for browsers is not built: run lar-viewer/web/build.sh, or name the page that it makes by --viewer or \
         LAR_VIEWER_PAGE"
    )]
    NoViewerPage,
    /// A file is not the viewer for browsers.
    #[error("{}: not the page that lar-viewer/web/build.sh makes", .path.display())]
    NotAViewerPage {
        /// The file.
        path: PathBuf,
    },
    /// The program was built without what the command needs.
    #[error("this build has no {feature}; build it with `--features {feature}`")]
    NotBuilt {
        /// The cargo feature.
        feature: &'static str,
    },
    /// Results cannot be printed.
    #[error("cannot write to the standard output: {0}")]
    Print(#[from] io::Error),
    /// Results cannot be put into JSON.
    #[error("cannot write the report as JSON: {0}")]
    Report(#[from] serde_json::Error),
}

impl From<BooleanError> for CommandError {
    fn from(source: BooleanError) -> Self {
        Self::Boolean { file: None, source }
    }
}

impl CommandError {
    /// 1 when what was asked about a file is not so, 3 when there is no graphics adapter or display, 2 for bad input or
    /// usage and everything else.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Invalid { .. } => 1,
            #[cfg(feature = "viewer")]
            Self::Viewer(lar_viewer::ViewerError::NoAdapter { .. }) => 3,
            #[cfg(feature = "window")]
            Self::Viewer(lar_viewer::ViewerError::NoDisplay(_)) => 3,
            _ => 2,
        }
    }
}
