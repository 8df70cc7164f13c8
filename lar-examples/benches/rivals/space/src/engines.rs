//! The libraries, each as a function from solids to the surface of their union, or of the first without the others.

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use manifold_rust::types::{Error as Status, MeshGL64};
use std::error::Error;

/// Triangles over points: three numbers a point.
pub struct Mesh {
    pub points: Vec<f64>,
    pub triangles: Vec<[usize; 3]>,
}

pub type Engine = fn(&[Mesh], bool) -> Result<Mesh, Box<dyn Error>>;

pub fn named(name: &str) -> Option<Engine> {
    match name {
        "boolmesh" => Some(boolmesh),
        "manifold-rust" => Some(manifold_rust),
        _ => None,
    }
}

/// Two at a time, so that operands stay small as long as possible.
fn boolmesh(meshes: &[Mesh], is_union: bool) -> Result<Mesh, Box<dyn Error>> {
    let solid = |m: &Mesh| Manifold::<f64>::new(&m.points, m.triangles.as_flattened());
    let solids = meshes.iter().map(solid).collect::<Result<Vec<_>, _>>()?;
    let result = if is_union {
        union(&solids)?
    } else {
        compute_boolean(&solids[0], &union(&solids[1..])?, OpType::Subtract)?
    };
    let tails: Vec<usize> = result.hs.iter().map(|h| h.tail).collect();
    Ok(Mesh {
        points: result.ps.iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
        triangles: tails.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    })
}

fn union(solids: &[Manifold<f64>]) -> Result<Manifold<f64>, String> {
    match solids {
        [only] => Ok(only.clone()),
        _ => {
            let (left, right) = solids.split_at(solids.len() / 2);
            compute_boolean(&union(left)?, &union(right)?, OpType::Add)
        }
    }
}

fn manifold_rust(meshes: &[Mesh], is_union: bool) -> Result<Mesh, Box<dyn Error>> {
    use manifold_rust::manifold::Manifold;
    use manifold_rust::types::OpType;
    let solid = |m: &Mesh| {
        Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: m.points.clone(),
            tri_verts: m.triangles.as_flattened().iter().map(|&v| v as u64).collect(),
            ..MeshGL64::default()
        })
    };
    let solids: Vec<_> = meshes.iter().map(solid).collect();
    let operation = if is_union { OpType::Add } else { OpType::Subtract };
    let result = Manifold::batch_boolean(&solids, operation);
    if result.status() != Status::NoError {
        return Err(format!("{:?}", result.status()).into());
    }
    let mesh = result.get_mesh_gl64(-1);
    let vertices: Vec<usize> = mesh.tri_verts.iter().map(|&v| v as usize).collect();
    Ok(Mesh {
        points: mesh.vert_properties,
        triangles: vertices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    })
}

impl Mesh {
    pub fn area(&self) -> f64 {
        self.corners().map(|[a, b, c]| length(cross(minus(b, a), minus(c, a))) / 2.0).sum()
    }

    pub fn volume(&self) -> f64 {
        self.corners().map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
    }

    fn corners(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        let point = |v: usize| [0, 1, 2].map(|k| self.points[3 * v + k]);
        self.triangles.iter().map(move |t| t.map(point))
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
