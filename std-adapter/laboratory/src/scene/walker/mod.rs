//! A figure in a shirt that walks and raises its arms: a skinned mesh to try simulations with bodies that change their shape on.

mod surface;

use libm::{exp, log, sin};
use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::f64::consts::{PI, TAU};
use surface::{Cut, surface};

/// A limb's part: all that is near a line, nearer where it is thinner.
struct Limb {
    bone: usize,
    ends: [DVec3; 2],
    radii: [f64; 2],
}

/// A bone: its parent, and the joint about which it turns, in metres.
#[derive(Clone, Copy, Debug)]
pub struct Bone {
    /// Its name.
    pub name: &'static str,
    /// Among the bones; `None`: the first.
    pub parent: Option<usize>,
    /// At rest.
    pub joint: DVec3,
}

/// The bones of a walker, in order.
const HIPS: usize = 0;
const CHEST: usize = 1;
const HEAD: usize = 2;
const UPPER_ARMS: [usize; 2] = [3, 4];
const FOREARMS: [usize; 2] = [5, 6];
const THIGHS: [usize; 2] = [7, 8];
const SHINS: [usize; 2] = [9, 10];
const BONES: [(&str, Option<usize>, [f64; 3]); 11] = [
    ("hips", None, [0.0, 0.95, 0.0]),
    ("chest", Some(HIPS), [0.0, 1.12, 0.0]),
    ("head", Some(CHEST), [0.0, 1.47, 0.0]),
    ("left upper arm", Some(CHEST), [0.18, 1.38, 0.0]),
    ("right upper arm", Some(CHEST), [-0.18, 1.38, 0.0]),
    ("left forearm", Some(UPPER_ARMS[0]), [0.45, 1.38, 0.0]),
    ("right forearm", Some(UPPER_ARMS[1]), [-0.45, 1.38, 0.0]),
    ("left thigh", Some(HIPS), [0.1, 0.9, 0.0]),
    ("right thigh", Some(HIPS), [-0.1, 0.9, 0.0]),
    ("left shin", Some(THIGHS[0]), [0.1, 0.48, 0.0]),
    ("right shin", Some(THIGHS[1]), [-0.1, 0.48, 0.0]),
];

/// How far the parts of the figure, and of the shirt, flow into each other, in metres.
const BLEND: f64 = 0.03;
const SHIRT_BLEND: f64 = 0.045;
/// How far the shirt is from the figure at the start, in metres.
const EASE: f64 = 0.016;
/// How much longer edges of the shirt are than those of the figure.
const SHIRT_PITCH: f64 = 1.13;
/// How far influences of bones reach, in metres.
const INFLUENCE: f64 = 0.045;

/// A figure of 1.8 m that stands in a shirt with its arms spread, lowers them, walks, and raises one arm after the other.
///
/// All lengths are in metres, y is up; the figure faces z. Positions are the same bits on every platform.
///
/// ```
/// use selvedge_laboratory::scene::Walker;
///
/// let walker = Walker::new(0.035);
/// assert!(walker.body().triangles.len() > 1000 && walker.shirt().triangles.len() > 700);
/// assert_eq!(walker.turns(0.0)[0].to_array(), [0.0; 3]);
/// ```
#[derive(Clone, Debug)]
pub struct Walker {
    body: Mesh,
    influences: Vec<[(u16, f32); 4]>,
    shirt: Mesh,
}

impl Walker {
    /// How long it moves, in seconds.
    pub const DURATION: f64 = 3.0;

    /// A figure with edges of about `pitch` metres, from 0.005 to 0.035, and a shirt with slightly longer ones.
    #[must_use]
    pub fn new(pitch: f64) -> Self {
        let pitch = pitch.clamp(0.005, 0.035);
        let limbs = limbs();
        let body = surface(
            |point| blended(limbs.iter(), BLEND, point),
            [DVec3::new(-1.0, -0.1, -0.3), DVec3::new(1.0, 1.9, 0.35)],
            pitch,
            &[],
        );
        let cut = |axis, at, side| Cut { axis, at, side };
        let shirt = surface(
            |point| blended(limbs.iter(), SHIRT_BLEND, point) - EASE,
            [DVec3::new(-0.6, 0.7, -0.3), DVec3::new(0.6, 1.6, 0.3)],
            SHIRT_PITCH * pitch,
            &[cut(0, 0.4, 1.0), cut(0, -0.4, -1.0), cut(1, 1.5, 1.0), cut(1, 0.87, -1.0)],
        );
        Self {
            influences: body.positions.iter().map(|&point| influences(&limbs, point)).collect(),
            body,
            shirt,
        }
    }

    /// The figure's surface at rest.
    #[must_use]
    pub fn body(&self) -> &Mesh {
        &self.body
    }

    /// The shirt about the figure at rest.
    #[must_use]
    pub fn shirt(&self) -> &Mesh {
        &self.shirt
    }

    /// Of each vertex of the figure: bones that it follows, and how much each counts.
    #[must_use]
    pub fn influences(&self) -> &[[(u16, f32); 4]] {
        &self.influences
    }

    /// The bones, parents first.
    #[must_use]
    pub fn bones(&self) -> [Bone; 11] {
        BONES.map(|(name, parent, joint)| Bone {
            name,
            parent,
            joint: joint.into(),
        })
    }

    /// How far each bone is turned against its parent at a time, in seconds: angles in radians, about x, then y, then z.
    #[must_use]
    pub fn turns(&self, time: f64) -> [DVec3; 11] {
        let mut turns = [DVec3::ZERO; 11];
        let walks = eased(time, 0.4, 1.0);
        let swing = walks * sin(TAU * time);
        turns[HIPS].y = 0.1 * swing;
        turns[CHEST].y = -0.22 * swing;
        turns[CHEST].z = 0.04 * walks * sin(TAU * time + 0.5 * PI);
        turns[HEAD].y = 0.1 * swing;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let raised = if side == 0 {
                eased(time, 1.3, 2.0) - eased(time, 2.0, 2.7)
            } else {
                eased(time, 1.8, 2.5)
            };
            let lowered = 0.75 * eased(time, 0.1, 0.9) - 1.1 * raised;
            turns[UPPER_ARMS[side]] = DVec3::new(0.0, -0.3 * sign * swing * sign, -sign * lowered);
            turns[FOREARMS[side]].y = -sign * (0.25 + 0.15 * sign * swing) * eased(time, 0.2, 0.9);
            turns[THIGHS[side]].x = -0.45 * sign * swing;
            turns[SHINS[side]].x = 0.35 * walks * (1.0 - sin(TAU * time + sign * 0.5 * PI));
        }
        turns
    }

    /// The scene as text, whose files are `walker.glb` and `walker-shirt.ply` beside it.
    #[must_use]
    pub fn scene(&self) -> &'static str {
        selvedge_cloth::WALKER
    }

    /// How far the first bone has moved at a time, in metres.
    #[must_use]
    pub fn moved(&self, time: f64) -> DVec3 {
        let walks = eased(time, 0.4, 1.0);
        let bob = 0.5 * (1.0 - sin(2.0 * TAU * time + 0.5 * PI));
        // The time that it has walked, so that it starts as softly as `walks` says.
        let walked = 0.6 * eased_integral(time, 0.4, 1.0);
        DVec3::new(0.0, -0.02 * walks * bob, 1.1 * walked)
    }
}

/// From 0 before one time to 1 after another one, smoothly.
fn eased(time: f64, from: f64, to: f64) -> f64 {
    let s = ((time - from) / (to - from)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

/// The time that passes under [`eased`], in units of its way up.
fn eased_integral(time: f64, from: f64, to: f64) -> f64 {
    let s = ((time - from) / (to - from)).clamp(0.0, 1.0);
    s * s * s * (1.0 - 0.5 * s) + ((time - to) / (to - from)).max(0.0)
}

fn limbs() -> Vec<Limb> {
    let mut limbs = Vec::new();
    let mut add = |bone, from: [f64; 3], to: [f64; 3], radii| {
        let ends = [from, to].map(DVec3::from);
        limbs.push(Limb { bone, ends, radii });
    };
    add(HIPS, [-0.07, 0.93, 0.0], [0.07, 0.93, 0.0], [0.12; 2]);
    add(HIPS, [-0.05, 1.06, 0.0], [0.05, 1.06, 0.0], [0.105; 2]);
    add(CHEST, [-0.05, 1.14, 0.0], [0.05, 1.14, 0.0], [0.105; 2]);
    add(CHEST, [-0.08, 1.28, 0.0], [0.08, 1.28, 0.0], [0.115; 2]);
    add(CHEST, [-0.14, 1.38, -0.01], [0.14, 1.38, -0.01], [0.065; 2]);
    add(HEAD, [0.0, 1.4, -0.01], [0.0, 1.56, 0.01], [0.055, 0.05]);
    add(HEAD, [0.0, 1.66, 0.02], [0.0, 1.7, 0.02], [0.1; 2]);
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let arm = |x: f64| [sign * x, 1.38, 0.0];
        add(UPPER_ARMS[side], arm(0.18), arm(0.44), [0.058, 0.044]);
        add(FOREARMS[side], arm(0.46), arm(0.68), [0.043, 0.032]);
        add(FOREARMS[side], arm(0.7), arm(0.8), [0.036, 0.03]);
        let leg = |y: f64, z: f64| [sign * 0.1, y, z];
        add(THIGHS[side], leg(0.86, 0.0), leg(0.5, 0.0), [0.085, 0.058]);
        add(SHINS[side], leg(0.46, 0.0), leg(0.08, 0.0), [0.056, 0.04]);
        add(SHINS[side], leg(0.045, 0.0), leg(0.045, 0.15), [0.045, 0.035]);
    }
    limbs
}

impl Limb {
    /// How far a point is out of it.
    fn distance(&self, point: DVec3) -> f64 {
        let axis = self.ends[1] - self.ends[0];
        let share = ((point - self.ends[0]).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
        point.distance(self.ends[0] + axis * share) - (self.radii[0] + share * (self.radii[1] - self.radii[0]))
    }
}

/// How far a point is out of all limbs, which flow into each other over about `blend`.
fn blended<'a>(limbs: impl Iterator<Item = &'a Limb> + Clone, blend: f64, point: DVec3) -> f64 {
    let distances = limbs.map(|limb| limb.distance(point));
    let nearest = distances.clone().fold(f64::INFINITY, f64::min);
    let sum: f64 = distances.map(|distance| exp((nearest - distance) * 4.0 / blend)).sum();
    nearest - 0.25 * blend * log(sum)
}

/// The bones that a point of the surface follows: the nearest four, the nearer the more.
fn influences(limbs: &[Limb], point: DVec3) -> [(u16, f32); 4] {
    let mut nearness = [0.0_f64; BONES.len()];
    for limb in limbs {
        let distance = limb.distance(point).max(0.0) / INFLUENCE;
        let own = exp(-distance * distance);
        nearness[limb.bone] = nearness[limb.bone].max(own);
    }
    let mut bones: Vec<usize> = (0..BONES.len()).collect();
    bones.sort_by(|&a, &b| nearness[b].total_cmp(&nearness[a]));
    let sum: f64 = bones[..4].iter().map(|&bone| nearness[bone]).sum();
    [0, 1, 2, 3].map(|k| (bones[k] as u16, (nearness[bones[k]] / sum) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figure_is_closed_and_the_shirt_has_four_openings() {
        for pitch in [0.035, 0.025] {
            let walker = Walker::new(pitch);
            let body = walker.body().topology().unwrap().statistics();
            assert_eq!((body.boundary_edges, body.non_manifold_edges, body.components), (0, 0, 1));
            let shirt = walker.shirt().topology().unwrap().statistics();
            assert_eq!((shirt.non_manifold_edges, shirt.components), (0, 1));
            // A tube with two sleeves: the edges of a sphere with four holes.
            let topology = walker.shirt().topology().unwrap();
            let [v, e, f] = [topology.vertex_count(), topology.edges().len(), topology.triangles().len()];
            assert_eq!(v as i64 - e as i64 + f as i64, 2 - 4);
        }
    }

    #[test]
    fn the_scene_that_comes_with_the_program_is_of_the_coarsest_walker() {
        let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../cloth/scenes");
        let walker = Walker::new(0.035);
        let figure = crate::report::gltf::walker(&walker).unwrap();
        assert!(
            std::fs::read(scenes.join("walker.glb")).unwrap() == figure,
            "run `selvedge walker --pitch 0.035` there"
        );
        let shirt = selvedge_files::mesh::read(&scenes.join("walker-shirt.ply")).unwrap().mesh;
        assert!(shirt == *walker.shirt());
    }
}
