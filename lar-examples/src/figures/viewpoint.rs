//! From where a cell is seen best.

use super::sheet::Eye;
use lar_core::TriangleMesh;
use std::f64::consts::TAU;

/// Azimuths tried, and the elevations tried with each, in radians.
const AZIMUTHS: u32 = 24;
const ELEVATIONS: [f64; 3] = [0.2, 0.45, 0.7];

/// A direction is better only by more than rounding: equal ones are equal on every machine.
const BETTER: f64 = 1e-9;

/// The direction from which the triangles of a closed mesh show the most, by the entropy of their projected areas
/// (P.-P. Vázquez, M. Feixas, M. Sbert, W. Heidrich, *Viewpoint selection using viewpoint entropy*, 2001), faces that
/// hide each other not considered. O(triangles).
pub(crate) fn best_eye(mesh: &TriangleMesh) -> Eye {
    let normals: Vec<[f64; 3]> = mesh.triangles.iter().map(|t| normal(mesh, t)).collect();
    let mut best = (f64::MIN, Eye::default());
    for i in 0..AZIMUTHS {
        let azimuth = TAU * (f64::from(i) / f64::from(AZIMUTHS) - 0.5);
        for elevation in ELEVATIONS {
            let eye = Eye { azimuth, elevation };
            let entropy = entropy(&normals, eye);
            if best.0 + BETTER < entropy {
                best = (entropy, eye);
            }
        }
    }
    best.1
}

/// Entropy of the shares of the visible area.
fn entropy(normals: &[[f64; 3]], eye: Eye) -> f64 {
    let eye = eye.direction();
    let seen = |n: &[f64; 3]| (n[0] * eye[0] + n[1] * eye[1] + n[2] * eye[2]).max(0.0);
    let areas: Vec<f64> = normals.iter().map(seen).filter(|a| 0.0 < *a).collect();
    let total: f64 = areas.iter().sum();
    areas.iter().map(|a| a / total).map(|share| -share * share.ln()).sum()
}

fn normal(mesh: &TriangleMesh, triangle: &[u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|v| mesh.points.xyz(v as usize));
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lar_core::cuboid_grid;

    #[test]
    fn three_faces_of_a_cube_are_seen_evenly() {
        let eye = best_eye(&cuboid_grid(&[1, 1, 1]).to_triangle_mesh().unwrap());
        let seen = eye.direction().map(f64::abs);
        assert!(seen.iter().all(|share| 0.5 < *share), "{seen:?}");
    }
}
