//! Distances and angles between points that were picked.

use glam::DVec3;

/// Points that were picked: two give a distance, three an angle at the middle one; the next begins anew.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measuring {
    points: Vec<[f64; 3]>,
}

impl Measuring {
    /// Adds a point. Points with coordinates that are not finite are passed over.
    pub fn push(&mut self, point: [f64; 3]) {
        if self.points.len() == 3 {
            self.points.clear();
        }
        if point.iter().all(|x| x.is_finite()) {
            self.points.push(point);
        }
    }

    /// The points, at most three.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.points.clear();
    }

    /// Distances from each point to the next.
    #[must_use]
    pub fn distances(&self) -> Vec<f64> {
        self.points.windows(2).map(|w| DVec3::from(w[0]).distance(w[1].into())).collect()
    }

    /// The angle at the second of three points, in radians; `None` before, and where two of them coincide.
    #[must_use]
    pub fn angle(&self) -> Option<f64> {
        let &[a, b, c] = self.points.as_slice() else { return None };
        let [u, v] = [a, c].map(|p| DVec3::from(p) - DVec3::from(b));
        // The arc tangent keeps its digits where the cosine is flat.
        let angle = u.cross(v).length().atan2(u.dot(v));
        (0.0 < u.length() && 0.0 < v.length()).then_some(angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_points_give_a_distance_and_three_an_angle() {
        let mut measuring = Measuring::default();
        measuring.push([3.0, 0.0, 0.0]);
        assert_eq!((measuring.distances(), measuring.angle()), (vec![], None));
        measuring.push([0.0; 3]);
        measuring.push([f64::NAN, 0.0, 0.0]);
        assert_eq!((measuring.distances(), measuring.angle()), (vec![3.0], None));
        measuring.push([0.0, 0.0, 4.0]);
        assert_eq!(measuring.distances(), [3.0, 4.0]);
        assert!((measuring.angle().unwrap() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        measuring.push([1.0; 3]);
        assert_eq!(measuring.points(), [[1.0; 3]]);
        measuring.clear();
        assert!(measuring.points().is_empty());
    }

    #[test]
    fn small_angles_keep_their_digits_and_coinciding_points_have_none() {
        let mut measuring = Measuring::default();
        [[1.0, 0.0, 0.0], [0.0; 3], [1.0, 1e-9, 0.0]].into_iter().for_each(|p| measuring.push(p));
        assert!((measuring.angle().unwrap() - 1e-9).abs() < 1e-20);
        let mut measuring = Measuring::default();
        [[1.0; 3], [1.0; 3], [2.0; 3]].into_iter().for_each(|p| measuring.push(p));
        assert_eq!(measuring.angle(), None);
    }
}
