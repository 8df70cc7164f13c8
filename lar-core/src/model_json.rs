//! Models and hierarchies as JSON.
//!
//! ```text
//! {"format": "lar-model", "version": 1, "space": 2, "points": [[0.0, 0.0], …], "cells": [[[0], …], [[0, 1], …], …]}
//!
//! {"format": "lar-struct", "version": 1,
//!  "models": [{"space": 2, "points": […], "cells": […]}, …],
//!  "structs": [{"name": "scene", "category": "",
//!               "nodes": [{"model": {"index": 0, "name": "A"}}, {"transform": [[1.0, 0.0, 2.0], …]},
//!                         {"struct": 3}]}, …]}
//! ```
//!
//! `space` is the number of coordinates of a point, `cells[p]` are the p-cells. The models and containers of a
//! hierarchy stand in two flat lists, each once however often it is placed, and what was shared is shared again
//! when it is read. A container names only containers that stand before it, so that no file can describe a
//! cycle; the last one is the outermost. One hierarchy always gives the same bytes.

use crate::atomic_write::read;
use crate::listing::first_few;
use crate::{
    Affine, AffineError, Cells, FileError, Model, ModelViolation, Node, Points, Struct, VertexId,
    atomic_write,
};
use nalgebra::DMatrix;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const MODEL: &str = "lar-model";
const STRUCT: &str = "lar-struct";
const VERSION: u64 = 1;

/// Why a text is no model or hierarchy, or one cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelJsonError {
    /// The text is not JSON of the expected form.
    #[error("not JSON of the expected form: {0}")]
    Syntax(#[from] serde_json::Error),
    /// `format` names something else.
    #[error("format is {found:?}, not {expected:?}")]
    Format {
        /// The format needed.
        expected: &'static str,
        /// The format found.
        found: String,
    },
    /// The version is not one that can be read.
    #[error("version {found} cannot be read, only version 1")]
    Version {
        /// The version found.
        found: u64,
    },
    /// A point has not `space` coordinates.
    #[error("point {vertex} of model {model} has {found} coordinates, not {expected}")]
    PointSize {
        /// The model, 0 when it stands alone.
        model: usize,
        /// The point.
        vertex: VertexId,
        /// The coordinates stated.
        expected: usize,
        /// The coordinates found.
        found: usize,
    },
    /// A model is malformed; all violations are listed.
    #[error("model {model} is malformed: {}", first_few(.violations))]
    Malformed {
        /// The model, 0 when it stands alone.
        model: usize,
        /// What is wrong.
        violations: Vec<ModelViolation>,
    },
    /// A model has more cell entries than `u32` can number.
    #[error("model {model} has 2^32 cell entries or more")]
    TooLarge {
        /// The model, 0 when it stands alone.
        model: usize,
    },
    /// The rows of a matrix are not as long as there are rows.
    #[error("node {node} of container {container}: row {row} has {found} entries, not {expected}")]
    Row {
        /// The container.
        container: usize,
        /// The node in it.
        node: usize,
        /// The row.
        row: usize,
        /// The number of rows.
        expected: usize,
        /// The entries found.
        found: usize,
    },
    /// A matrix is no affine map, or has entries that are infinite or not numbers.
    #[error("node {node} of container {container}: {source}")]
    Transform {
        /// The container.
        container: usize,
        /// The node in it.
        node: usize,
        /// What is wrong with its matrix.
        source: AffineError,
    },
    /// A node names a model that does not exist, or a container that does not stand before its own.
    #[error("node {node} of container {container} names {what} {index} of {available}")]
    Reference {
        /// The container.
        container: usize,
        /// The node in it.
        node: usize,
        /// "model" or "container".
        what: &'static str,
        /// What it names.
        index: usize,
        /// How many there are to be named.
        available: usize,
    },
    /// A hierarchy has no container.
    #[error("no container")]
    Empty,
    /// The file could not be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// What is wrong with the text of a file.
    #[error("{}: {source}", .path.display())]
    In {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: Box<ModelJsonError>,
    },
}

#[derive(Deserialize)]
struct Header {
    format: String,
    version: u64,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelFile {
    format: String,
    version: u64,
    space: usize,
    points: Vec<Vec<f64>>,
    cells: Vec<Vec<Vec<u32>>>,
}

impl From<ModelFile> for ModelText {
    fn from(ModelFile { space, points, cells, .. }: ModelFile) -> Self {
        Self { space, points, cells }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelText {
    space: usize,
    points: Vec<Vec<f64>>,
    cells: Vec<Vec<Vec<u32>>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StructFile {
    format: String,
    version: u64,
    models: Vec<ModelText>,
    structs: Vec<StructText>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StructText {
    name: String,
    category: String,
    nodes: Vec<NodeText>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum NodeText {
    Model { index: usize, name: Option<String> },
    Transform(Vec<Vec<f64>>),
    Struct(usize),
}

impl Model {
    /// The model as JSON, one line. O(size).
    ///
    /// # Errors
    /// When the model is malformed (see [`validate`](Self::validate)): it could not be read back.
    ///
    /// ```
    /// use lar_core::{Model, cuboid_grid};
    /// let grid = cuboid_grid(&[2, 1]);
    /// assert_eq!(Model::from_json(&grid.to_json()?)?, grid);
    /// # Ok::<(), lar_core::ModelJsonError>(())
    /// ```
    pub fn to_json(&self) -> Result<String, ModelJsonError> {
        let ModelText { space, points, cells } = model_text(0, self)?;
        let file = ModelFile { format: MODEL.to_owned(), version: VERSION, space, points, cells };
        Ok(serde_json::to_string(&file)?)
    }

    /// A model from its JSON. Memory stays in proportion to the text. O(size · log).
    ///
    /// # Errors
    /// When the text is malformed, of another format or version, or the model is malformed.
    pub fn from_json(text: &str) -> Result<Self, ModelJsonError> {
        let file: ModelFile = parse(text.as_bytes(), MODEL)?;
        model_of(0, file.into())
    }

    /// Writes the model as JSON to a file, whole or not at all. O(size).
    ///
    /// # Errors
    /// As [`to_json`](Self::to_json), and when the file cannot be written.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<(), ModelJsonError> {
        write_line(path.as_ref(), &self.to_json()?)
    }

    /// Reads a model from a JSON file. O(size).
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), naming the file, and when it cannot be read.
    pub fn read_json(path: impl AsRef<Path>) -> Result<Self, ModelJsonError> {
        let path = path.as_ref();
        let found = parse(&read(path)?, MODEL).and_then(|file: ModelFile| model_of(0, file.into()));
        found.map_err(|source| in_file(path, source))
    }
}

impl Struct {
    /// The hierarchy as JSON, one line; each shared model and container once. O(size), of any depth.
    ///
    /// # Errors
    /// When a model is malformed, or a matrix has entries that are infinite or not numbers.
    ///
    /// ```
    /// use lar_core::{Struct, cuboid_grid, t};
    /// use std::sync::Arc;
    /// let cube = Arc::new(cuboid_grid(&[1, 1, 1]));
    /// let row = Struct::new("row").with(cube.clone()).with(t(&[2., 0., 0.])).with(("last", cube));
    /// let json = row.to_json()?;
    /// assert_eq!(json.matches("points").count(), 1);
    /// assert_eq!(Struct::from_json(&json)?, row);
    /// # Ok::<(), lar_core::ModelJsonError>(())
    /// ```
    pub fn to_json(&self) -> Result<String, ModelJsonError> {
        let mut writer = Writer::default();
        writer.hierarchy(self)?;
        let Writer { models, structs, .. } = writer;
        let file = StructFile { format: STRUCT.to_owned(), version: VERSION, models, structs };
        Ok(serde_json::to_string(&file)?)
    }

    /// A hierarchy from its JSON; models and containers that stand once in the text are shared. O(size · log).
    ///
    /// # Errors
    /// When the text is malformed, of another format or version, a model is malformed, a matrix is no affine
    /// map, or a node names what does not exist.
    pub fn from_json(text: &str) -> Result<Self, ModelJsonError> {
        hierarchy_of(parse(text.as_bytes(), STRUCT)?)
    }

    /// Writes the hierarchy as JSON to a file, whole or not at all. O(size).
    ///
    /// # Errors
    /// As [`to_json`](Self::to_json), and when the file cannot be written.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<(), ModelJsonError> {
        write_line(path.as_ref(), &self.to_json()?)
    }

    /// Reads a hierarchy from a JSON file. O(size).
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), naming the file, and when it cannot be read.
    pub fn read_json(path: impl AsRef<Path>) -> Result<Self, ModelJsonError> {
        let path = path.as_ref();
        parse(&read(path)?, STRUCT).and_then(hierarchy_of).map_err(|source| in_file(path, source))
    }
}

fn in_file(path: &Path, source: ModelJsonError) -> ModelJsonError {
    ModelJsonError::In { path: path.to_owned(), source: Box::new(source) }
}

fn write_line(path: &Path, text: &str) -> Result<(), ModelJsonError> {
    atomic_write(path, |file| {
        file.write_all(text.as_bytes())?;
        file.write_all(b"\n")
    })?;
    Ok(())
}

fn parse<T: DeserializeOwned>(text: &[u8], expected: &'static str) -> Result<T, ModelJsonError> {
    let header: Header = serde_json::from_slice(text)?;
    if header.format != expected {
        return Err(ModelJsonError::Format { expected, found: header.format });
    }
    if header.version != VERSION {
        return Err(ModelJsonError::Version { found: header.version });
    }
    Ok(serde_json::from_slice(text)?)
}

fn model_text(index: usize, model: &Model) -> Result<ModelText, ModelJsonError> {
    let violations = model.validate();
    if !violations.is_empty() {
        return Err(ModelJsonError::Malformed { model: index, violations });
    }
    let cells = |p: usize| model.cells(p).iter().map(<[u32]>::to_vec).collect();
    Ok(ModelText {
        space: model.points().dim(),
        points: model.points().iter().map(<[f64]>::to_vec).collect(),
        cells: (0..model.f_vector().len()).map(cells).collect(),
    })
}

fn model_of(index: usize, text: ModelText) -> Result<Model, ModelJsonError> {
    let expected = text.space;
    let mut coords = Vec::new();
    for (vertex, point) in (0..).map(VertexId).zip(&text.points) {
        if point.len() != expected {
            return Err(ModelJsonError::PointSize { model: index, vertex, expected, found: point.len() });
        }
        coords.extend_from_slice(point);
    }
    for cells in &text.cells {
        let entries: usize = cells.iter().map(Vec::len).sum();
        if u32::try_from(entries.max(cells.len())).is_err() {
            return Err(ModelJsonError::TooLarge { model: index });
        }
    }
    let cells = text.cells.into_iter().map(|cells| cells.into_iter().collect::<Cells>()).collect();
    let model = Model::new(Points::from_columns(expected, coords), cells);
    let violations = model.validate();
    if violations.is_empty() {
        Ok(model)
    } else {
        Err(ModelJsonError::Malformed { model: index, violations })
    }
}

/// Models and containers in the order in which they are written, and where each, known by its address, stands.
#[derive(Default)]
struct Writer {
    models: Vec<ModelText>,
    structs: Vec<StructText>,
    model_at: FxHashMap<*const Model, usize>,
    struct_at: FxHashMap<*const Struct, usize>,
}

impl Writer {
    /// Containers after those that they hold, without recursion.
    fn hierarchy(&mut self, root: &Struct) -> Result<(), ModelJsonError> {
        let mut stack = vec![root];
        while let Some(&container) = stack.last() {
            let waiting = container.nodes().iter().rev().filter_map(|node| match node {
                Node::Struct(nested) if !self.struct_at.contains_key(&Arc::as_ptr(nested)) => Some(&**nested),
                _ => None,
            });
            let before = stack.len();
            stack.extend(waiting);
            if stack.len() == before {
                stack.pop();
                if !self.struct_at.contains_key(&std::ptr::from_ref(container)) {
                    self.container(container)?;
                }
            }
        }
        Ok(())
    }

    fn container(&mut self, container: &Struct) -> Result<(), ModelJsonError> {
        let at = self.structs.len();
        let mut nodes = Vec::with_capacity(container.nodes().len());
        for (i, node) in container.nodes().iter().enumerate() {
            nodes.push(match node {
                Node::Model(name, model) => NodeText::Model { index: self.model(model)?, name: name.clone() },
                Node::Transform(map) => NodeText::Transform(rows(at, i, map)?),
                Node::Struct(nested) => NodeText::Struct(self.struct_at[&Arc::as_ptr(nested)]),
            });
        }
        let (name, category) = (container.name().to_owned(), container.category().to_owned());
        self.structs.push(StructText { name, category, nodes });
        self.struct_at.insert(container, at);
        Ok(())
    }

    fn model(&mut self, model: &Arc<Model>) -> Result<usize, ModelJsonError> {
        let next = self.models.len();
        let at = *self.model_at.entry(Arc::as_ptr(model)).or_insert(next);
        if at == next {
            self.models.push(model_text(next, model)?);
        }
        Ok(at)
    }
}

fn rows(container: usize, node: usize, map: &Affine) -> Result<Vec<Vec<f64>>, ModelJsonError> {
    let matrix = map.matrix();
    if let Some(i) = matrix.iter().position(|x| !x.is_finite()) {
        let (row, col) = (i % matrix.nrows(), i / matrix.nrows());
        let source = AffineError::NonFinite { row, col, value: matrix[(row, col)] };
        return Err(ModelJsonError::Transform { container, node, source });
    }
    Ok(matrix.row_iter().map(|row| row.iter().copied().collect()).collect())
}

fn map_of(container: usize, node: usize, rows: &[Vec<f64>]) -> Result<Affine, ModelJsonError> {
    let expected = rows.len();
    if let Some(row) = rows.iter().position(|row| row.len() != expected) {
        let found = rows[row].len();
        return Err(ModelJsonError::Row { container, node, row, expected, found });
    }
    let matrix = DMatrix::from_row_iterator(expected, expected, rows.iter().flatten().copied());
    Affine::from_matrix(matrix).map_err(|source| ModelJsonError::Transform { container, node, source })
}

fn hierarchy_of(file: StructFile) -> Result<Struct, ModelJsonError> {
    let models = file.models.into_iter().enumerate().map(|(i, text)| model_of(i, text).map(Arc::new));
    let models: Vec<Arc<Model>> = models.collect::<Result<_, _>>()?;
    let mut structs: Vec<Arc<Struct>> = Vec::new();
    for (container, text) in file.structs.into_iter().enumerate() {
        let mut built = Struct::new(text.name).with_category(text.category);
        for (i, node) in text.nodes.into_iter().enumerate() {
            let missing = |what, index, available| ModelJsonError::Reference {
                container,
                node: i,
                what,
                index,
                available,
            };
            built.push(match node {
                NodeText::Model { index, name } => match models.get(index) {
                    Some(model) => Node::Model(name, Arc::clone(model)),
                    None => return Err(missing("model", index, models.len())),
                },
                NodeText::Transform(rows) => Node::Transform(map_of(container, i, &rows)?),
                NodeText::Struct(index) => match structs.get(index) {
                    Some(nested) => Node::Struct(Arc::clone(nested)),
                    None => return Err(missing("container", index, structs.len())),
                },
            });
        }
        structs.push(Arc::new(built));
    }
    let root = structs.pop().ok_or(ModelJsonError::Empty)?;
    // A hierarchy that nothing else holds is taken out of its box, not copied.
    drop(structs);
    Ok(Arc::unwrap_or_clone(root))
}
