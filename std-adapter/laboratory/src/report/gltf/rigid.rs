//! Finds parts that move without changing their shape.

use selvedge_core::glam::{DMat3, DQuat, DVec3};

/// The rotation and translation of a part since its first frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) rotation: DQuat,
    pub(super) translation: DVec3,
}

/// The allowed error of a vertex, relative to the largest coordinate: several roundings of f32.
const TOLERANCE: f64 = 2e-6;

/// Returns the pose in each frame if all of them are rigid motions of the first. Returns `None` if some are not, or if the part
/// is too small or thin to decide.
pub(super) fn poses(frames: &[&[[f32; 3]]]) -> Option<Vec<Pose>> {
    let point = |frame: &[[f32; 3]], vertex: usize| DVec3::from(frame[vertex].map(f64::from));
    let first = frames.first().copied().filter(|first| !first.is_empty())?;
    let all = || 0..first.len();
    let farthest = |away: &dyn Fn(DVec3) -> f64| all().max_by(|&a, &b| away(point(first, a)).total_cmp(&away(point(first, b))));
    let a = 0;
    let b = farthest(&|p| p.distance_squared(point(first, a)))?;
    let along = (point(first, b) - point(first, a)).try_normalize()?;
    let c = farthest(&|p| (p - point(first, a)).reject_from_normalized(along).length_squared())?;
    let axes = |frame: &[[f32; 3]]| {
        let [a, b, c] = [a, b, c].map(|vertex| point(frame, vertex));
        let x = (b - a).try_normalize()?;
        let z = x.cross(c - a).try_normalize()?;
        Some(DMat3::from_cols(x, z.cross(x), z))
    };
    let at_first = axes(first)?.transpose();
    let mut before = DQuat::IDENTITY;
    let mut poses = Vec::with_capacity(frames.len());
    for &frame in frames {
        let turned = DQuat::from_mat3(&(axes(frame)? * at_first)).normalize();
        // A rotation has two quaternions; the one nearer to the last makes the animation take the short way.
        let rotation = if turned.dot(before) < 0.0 { -turned } else { turned };
        let translation = point(frame, a) - rotation * point(first, a);
        let size = all()
            .map(|vertex| point(frame, vertex).abs().max_element())
            .fold(0.0, f64::max);
        let is_near = |vertex: usize| {
            let placed = rotation * point(first, vertex) + translation;
            placed.distance(point(frame, vertex)) <= TOLERANCE * size.max(point(first, vertex).abs().max_element())
        };
        if !all().all(is_near) {
            return None;
        }
        poses.push(Pose { rotation, translation });
        before = rotation;
    }
    Some(poses)
}
