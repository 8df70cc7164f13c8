//! A session as text, to be shown elsewhere: what `lar export-html` puts into a page, and the page reads.
//!
//! ```text
//! {"format": "lar-view", "version": 1, "title": …,
//!  "complex": a chain complex as in lar-core, "exterior": whether cell 0 is the exterior,
//!  "triangles": {"corners": [[0, 1, 2], …], "offsets": [0, 2, …]},
//!  "solids": [{"name": "A", "refusal": null}, …], "parents": [[[solid, face, sign], …], …], "inside": [[solid, …], …],
//!  "wrappings": [cell: [shell: [step: [[face, sign], …], …], …], …],
//!  "settings": {…}, "camera": {"eye": …, "target": …, "up": …, "fov": …, "projection": …, "fitted": …}}
//! ```

mod answers;

pub use answers::{Answers, Wrapping};

use crate::session::{Session, Settings};
use crate::{Camera, CellData, FaceParent, Projection, Provenance, ViewerError};
use lar_core::{ChainComplex, serde_json};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

const FORMAT: &str = "lar-view";
const VERSION: u32 = 1;

/// A session and all that a window needs to show it where neither its files nor their arrangement are.
///
/// ```
/// use lar_core::{ChainComplex, cuboid_grid};
/// use lar_viewer::session::Session;
/// use lar_viewer::{Answers, Camera, CellData, SharedView};
/// let grid = CellData::new(ChainComplex::from_model(&cuboid_grid(&[2, 1, 1]))?)?;
/// let answers = Answers::default();
/// let (session, camera) = (Session::new(grid), Camera::default());
/// let view = SharedView { title: "grid".into(), session, camera, is_fitted: true, answers };
/// let text = view.to_json()?;
/// assert_eq!(SharedView::from_json(&text)?.session.data().n_cells(3), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SharedView {
    /// Title of the page.
    pub title: String,
    /// The complex and how it is shown at first.
    pub session: Session,
    /// Where it is seen from.
    pub camera: Camera,
    /// Moves the camera at first, without turning it, so that all is in the picture, whatever its size.
    pub is_fitted: bool,
    /// What the arrangement was asked.
    pub answers: Answers,
}

#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    format: String,
    version: u32,
    title: String,
    complex: Box<RawValue>,
    exterior: bool,
    triangles: Triangles,
    solids: Vec<Solid>,
    parents: Vec<Vec<(u32, u32, i8)>>,
    inside: Vec<Vec<u32>>,
    wrappings: Vec<Wrapping>,
    settings: Settings,
    camera: Seen,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Triangles {
    corners: Vec<[u32; 3]>,
    offsets: Vec<u32>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Solid {
    name: String,
    refusal: Option<String>,
}

/// A camera by what it sees.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Seen {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    fov: f64,
    projection: Projection,
    fitted: bool,
}

impl SharedView {
    /// The view as JSON, one line. The same view always gives the same bytes. O(size).
    ///
    /// # Errors
    /// `SharedView` when the complex breaks a law of chain complexes.
    pub fn to_json(&self) -> Result<String, ViewerError> {
        let data = self.session.data();
        let provenance = data.provenance();
        let refusals = self.answers.refusals.iter().cloned().chain(std::iter::repeat(None));
        let names = provenance.solids.iter().cloned();
        let (corners, offsets) = data.all_triangles();
        let parents = provenance.parents_of_face.iter();
        let record = Record {
            format: FORMAT.to_owned(),
            version: VERSION,
            title: self.title.clone(),
            complex: RawValue::from_string(data.complex().to_json().map_err(|e| refused(&e))?)
                .map_err(|e| refused(&e))?,
            exterior: data.has_exterior(),
            triangles: Triangles { corners: corners.to_vec(), offsets: offsets.to_vec() },
            solids: names.zip(refusals).map(|(name, refusal)| Solid { name, refusal }).collect(),
            parents: parents.map(|p| p.iter().map(|p| (p.solid, p.face, p.sign)).collect()).collect(),
            inside: provenance.solids_of_cell.clone(),
            wrappings: self.answers.wrappings.clone(),
            settings: self.session.settings(),
            camera: Seen::new(&self.camera, self.is_fitted),
        };
        serde_json::to_string(&record).map_err(|e| refused(&e))
    }

    /// A view from its JSON. O(size · log).
    ///
    /// # Errors
    /// `SharedView` when the text is malformed, of another format or version, or holds no complex; as [`CellData`] when
    /// the complex cannot be shown; `InvalidView` when the camera cannot be.
    pub fn from_json(text: &str) -> Result<Self, ViewerError> {
        let Header { format, version } = serde_json::from_str(text).map_err(|e| refused(&e))?;
        if format != FORMAT || version != VERSION {
            return Err(refused(&format!(
                "format is {format:?} of version {version}, not {FORMAT:?} of version {VERSION}"
            )));
        }
        let record: Record = serde_json::from_str(text).map_err(|e| refused(&e))?;
        let complex = ChainComplex::from_json(record.complex.get()).map_err(|e| refused(&e))?;
        let (solids, refusals) = record.solids.into_iter().map(|s| (s.name, s.refusal)).unzip();
        let parent = |(solid, face, sign)| FaceParent { solid, face, sign };
        let parents_of_face = record.parents.into_iter().map(|p| p.into_iter().map(parent).collect());
        let provenance =
            Provenance { solids, parents_of_face: parents_of_face.collect(), solids_of_cell: record.inside };
        let data =
            CellData::new(complex)?.with_triangles(record.triangles.corners, record.triangles.offsets)?;
        let data = if record.exterior { data.with_exterior() } else { data };
        Ok(Self {
            title: record.title,
            session: Session::new(data.with_provenance(provenance)).with_settings(record.settings),
            camera: record.camera.camera()?,
            is_fitted: record.camera.fitted,
            answers: Answers { refusals, wrappings: record.wrappings },
        })
    }
}

impl Seen {
    fn new(camera: &Camera, fitted: bool) -> Self {
        let [_, up, _] = camera.axes();
        let Camera { target, fov_y, projection, .. } = *camera;
        Self { eye: camera.eye(), target, up, fov: fov_y, projection, fitted }
    }

    fn camera(&self) -> Result<Camera, ViewerError> {
        let placed = Camera::looking(self.eye, self.target, self.up)?;
        let camera = Camera { fov_y: self.fov, projection: self.projection, ..placed };
        camera.validate()?;
        Ok(camera)
    }
}

fn refused(reason: &dyn std::fmt::Display) -> ViewerError {
    ViewerError::SharedView(reason.to_string())
}

#[cfg(test)]
mod tests;
