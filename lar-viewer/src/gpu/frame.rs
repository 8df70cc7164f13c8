//! The parameters of a frame as the shaders read them.

use crate::{Bounds, LEVELS, Projection, View};
use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// Centroids, fixed points and planes are taken for no farther than this from the centre, in radii of the scene.
const FARTHEST: f64 = 1e20;
/// A plane that cuts nothing away: all heights over it are −1.
const NO_CUT: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// Level of groups that stands for all of them as one; `WHOLE` in `common.wgsl`.
pub(crate) const WHOLE: u32 = u32::MAX;

fn clamped(x: f64) -> f32 {
    x.clamp(-FARTHEST, FARTHEST) as f32
}

/// Mirror of `Frame` in `common.wgsl`, 304 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Frame {
    pub(crate) view_from_scene: [[f32; 4]; 4],
    pub(crate) clip_from_view: [[f32; 4]; 4],
    pub(crate) explode: [[f32; 4]; LEVELS],
    pub(crate) about: [f32; 3],
    pub(crate) opacity: f32,
    pub(crate) cut: [f32; 4],
    pub(crate) viewport: [f32; 2],
    pub(crate) samples_per_pixel: f32,
    pub(crate) sample_size: f32,
    pub(crate) near: f32,
    pub(crate) perspective: u32,
    pub(crate) hide_edges: u32,
    pub(crate) supersample: u32,
    pub(crate) band_row: u32,
    pub(crate) band: u32,
    pub(crate) node_capacity: u32,
    pub(crate) cut_groups: u32,
    /// Number of the scene's first part among all scenes of the frame.
    pub(crate) first_part: u32,
    /// Level of the groups that are outlined; [`WHOLE`] for everything as one.
    pub(crate) outlined_level: u32,
    /// Half the width of outlines, in samples.
    pub(crate) outline_reach: f32,
    pub(crate) padding: u32,
    pub(crate) outline_color: [f32; 4],
}

/// Size of a picture and how finely it is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Raster {
    /// Pixels.
    pub(crate) width: u32,
    /// Pixels.
    pub(crate) height: u32,
    /// Samples per pixel and axis.
    pub(crate) samples: u32,
    /// Pixels of the picture for each pixel of line width or point size; the scale factor of the screen.
    pub(crate) scale: f32,
}

impl Raster {
    /// Width and height in samples.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.width * self.samples, self.height * self.samples]
    }
}

/// Where the numbers of a batch lie in the world: p_world = center + unit · p_scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    pub(crate) center: [f64; 3],
    pub(crate) unit: f64,
}

impl Placement {
    /// A world position, to be rounded to f32 where it is small.
    pub(crate) fn scene_from_world(&self, p: [f64; 3]) -> [f64; 3] {
        ((DVec3::from(p) - DVec3::from(self.center)) / self.unit).to_array()
    }

    /// A point that may lie anywhere, whatever the size of the scene, but whose product with any explosion is finite.
    pub(crate) fn far_from_world(&self, p: [f64; 3]) -> [f32; 3] {
        self.scene_from_world(p).map(clamped)
    }

    /// The fixed point of an explosion.
    fn about(&self, point: Option<[f64; 3]>) -> [f32; 3] {
        point.map_or([0.0; 3], |p| self.far_from_world(p))
    }
}

impl Frame {
    /// The parameters of a view of a scene placed in the world; `bounds` is the exploded scene.
    pub(crate) fn new(view: &View, raster: &Raster, placement: &Placement, bounds: Option<Bounds>) -> Self {
        let camera = view.camera.relative_to(placement.center, placement.unit);
        let [width, height] = raster.size().map(f64::from);
        let (center, radius) = bounds.map_or(([0.0; 3], 1.0), |b| {
            (placement.scene_from_world(b.center()), b.radius() / placement.unit)
        });
        let (depth, reach) = (camera.depth(center), 1.1 * radius.max(1e-3 * camera.distance));
        let (near, far) = match camera.projection {
            Projection::Orthographic => (depth - reach - camera.world_per_pixel(1.0), depth + reach),
            Projection::Perspective => depth_range(depth, reach, camera.distance),
        };
        let perspective = camera.projection == Projection::Perspective;
        let sample_size = camera.world_per_pixel(height) / if perspective { camera.distance } else { 1.0 };
        let samples_per_pixel = raster.samples as f32 * raster.scale;
        let outline = view.outline.unwrap_or_default();
        let [r, g, b] = outline.color;
        Self {
            view_from_scene: camera.view_from_world().as_mat4().to_cols_array_2d(),
            clip_from_view: camera.clip_from_view(width / height, near, far).as_mat4().to_cols_array_2d(),
            explode: view.explode.factors.map(|[x, y, z]| [x - 1.0, y - 1.0, z - 1.0, 0.0]),
            about: placement.about(view.explode.about),
            opacity: view.opacity,
            cut: view.clip.map_or(NO_CUT, |c| c.in_scene(placement.center, placement.unit).map(clamped)),
            viewport: [width as f32, height as f32],
            samples_per_pixel,
            sample_size: sample_size as f32,
            near: near as f32,
            perspective: u32::from(perspective),
            hide_edges: u32::from(!view.edges),
            supersample: raster.samples,
            band_row: 0,
            band: 0,
            node_capacity: 0,
            cut_groups: u32::from(view.clip.is_some_and(|c| c.whole_cells)),
            first_part: 0,
            outlined_level: outline.of.level().map_or(WHOLE, |level| level as u32),
            outline_reach: 0.5 * outline.width * samples_per_pixel,
            padding: 0,
            outline_color: [r, g, b, 1.0],
        }
    }
}

/// Nearest and farthest depth of a sphere of radius `reach` whose centre lies at `depth`, with room for lines and
/// points that are drawn nearer to the eye than they are, by half their depth at most (an orthographic camera leaves
/// the height of the picture). What is behind the eye, or so near that the depth buffer would suffer, is cut off.
fn depth_range(depth: f64, reach: f64, distance: f64) -> (f64, f64) {
    let far = (depth + reach).max(2e-3 * distance);
    ((0.5 * (depth - reach)).max(1e-4 * far), far)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;
    use glam::{Mat4, Vec3};

    #[track_caller]
    fn check_inside(camera: Camera, bounds: Bounds) {
        let placement = Placement { center: bounds.center(), unit: bounds.radius() };
        let view = View { camera: camera.fit(&bounds, 1.5), ..View::default() };
        let raster = Raster { width: 300, height: 200, samples: 2, scale: 1.0 };
        let frame = Frame::new(&view, &raster, &placement, Some(bounds));
        let clip_from_scene = Mat4::from_cols_array_2d(&frame.clip_from_view)
            * Mat4::from_cols_array_2d(&frame.view_from_scene);
        for corner in bounds.corners() {
            let scene = Vec3::from(placement.scene_from_world(corner).map(|x| x as f32));
            let clip = clip_from_scene.project_point3(scene);
            let inside = clip.x.abs() < 1.0 && clip.y.abs() < 1.0 && 0.0 < clip.z && clip.z < 1.0;
            assert!(inside, "{corner:?} goes to {clip} with {camera:?}");
        }
    }

    #[test]
    fn a_fitted_scene_lies_inside_the_picture_at_any_size_and_place() {
        for camera in [Camera::default(), Camera::default().toggle_projection()] {
            for scale in [1e-30, 1e-3, 1.0, 1e20] {
                for offset in [0.0, 1e6] {
                    let at = |x: f64| (offset + x) * scale;
                    check_inside(
                        camera,
                        Bounds { min: [at(-1.0), at(0.0), at(3.0)], max: [at(2.0), at(1.0), at(5.0)] },
                    );
                }
            }
        }
    }

    #[test]
    fn depth_range_stays_before_the_eye() {
        assert_eq!(depth_range(5.0, 1.0, 5.0), (2.0, 6.0));
        let (near, far) = depth_range(0.5, 1.0, 0.5);
        assert!(0.0 < near && near < far, "inside the scene: {near} {far}");
        let (near, far) = depth_range(-9.0, 1.0, 2.0);
        assert!(0.0 < near && near < far, "scene behind the eye: {near} {far}");
    }
}
