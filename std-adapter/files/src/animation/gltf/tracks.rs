//! The channels of an animation.

use super::{File, label, short, wrong};
use crate::animation::track::{AnimatedProperty, Interpolation, Track};
use crate::problem::AnimationProblem;
use gltf::accessor::Dimensions;
use gltf::scene::Transform;
use selvedge_core::glam::DQuat;

impl<'a> File<'a> {
    /// Returns the times of the first and the last key of an animation, for everything that it moves.
    pub(super) fn span(&self, animation: &gltf::Animation<'a>) -> Result<[f64; 2], AnimationProblem> {
        let mut span: Option<[f64; 2]> = None;
        for (index, channel) in animation.channels().enumerate() {
            let times = self.times(&channel, &format!("channel {index} of the animation"))?;
            let [first, last] = [times[0], times[times.len() - 1]];
            span = Some(span.map_or([first, last], |[low, high]| [low.min(first), high.max(last)]));
        }
        Ok(span.unwrap_or_default())
    }

    /// Returns the times of a channel's keys, one or more.
    fn times(&self, channel: &gltf::animation::Channel<'a>, what: &str) -> Result<Vec<f64>, AnimationProblem> {
        let times = self.numbers(
            &channel.sampler().input(),
            Dimensions::Scalar,
            None,
            &format!("{what}, times"),
        )?;
        if times.is_empty() || times[0] < 0.0 || !times.is_sorted_by(|a, b| a < b) {
            return Err(wrong(
                what,
                "its times must be zero or more, each later than the one before, and one at least",
            ));
        }
        Ok(times)
    }

    /// Returns the channels that move one of the nodes in `places`, or the weights of one of `parts`: nodes with their numbers of
    /// morph targets.
    pub(super) fn tracks(
        &self,
        animation: &gltf::Animation<'a>,
        parts: &[(usize, usize)],
        places: &[Option<usize>],
    ) -> Result<Vec<Track>, AnimationProblem> {
        let mut tracks: Vec<Track> = Vec::new();
        for (index, channel) in animation.channels().enumerate() {
            let target = channel.target();
            let node = target.node();
            let part = parts.iter().position(|&(own, targets)| own == node.index() && targets > 0);
            let target_count = part.map_or(0, |part| parts[part].1);
            let (property, dimensions, width) = match target.property() {
                gltf::animation::Property::Translation => (AnimatedProperty::Translation, Dimensions::Vec3, 3),
                gltf::animation::Property::Rotation => (AnimatedProperty::Rotation, Dimensions::Vec4, 4),
                gltf::animation::Property::Scale => (AnimatedProperty::Scale, Dimensions::Vec3, 3),
                gltf::animation::Property::MorphTargetWeights => (AnimatedProperty::Weights, Dimensions::Scalar, target_count),
            };
            let place = match property {
                AnimatedProperty::Weights => part,
                _ => places[node.index()],
            };
            let Some(place) = place else { continue };
            let what = format!(
                "channel {index} of the animation ({property:?} of '{}')",
                short(&label(&node))
            );
            if matches!(node.transform(), Transform::Matrix { .. }) && property != AnimatedProperty::Weights {
                return Err(wrong(
                    &what,
                    "moves a node that has a `matrix`; it must have `translation`, `rotation`, `scale`",
                ));
            }
            if tracks.iter().any(|track| (track.node, track.property) == (place, property)) {
                return Err(wrong(&what, "there is another channel of the same"));
            }
            let sampler = channel.sampler();
            let times = self.times(&channel, &what)?;
            let (interpolation, of_key) = match sampler.interpolation() {
                gltf::animation::Interpolation::Step => (Interpolation::Step, 1),
                gltf::animation::Interpolation::Linear => (Interpolation::Linear, 1),
                gltf::animation::Interpolation::CubicSpline => (Interpolation::Cubic, 3),
            };
            let each = if property == AnimatedProperty::Weights { width } else { 1 };
            let count = times.len().saturating_mul(of_key).saturating_mul(each);
            let mut values = self.numbers(&sampler.output(), dimensions, Some(count), &format!("{what}, values"))?;
            if property == AnimatedProperty::Rotation && interpolation != Interpolation::Cubic {
                for (key, value) in values.chunks_exact_mut(4).enumerate() {
                    let rotation = DQuat::from_slice(value);
                    if rotation.length_squared() <= 0.0 {
                        return Err(wrong(
                            &what,
                            format!("the rotation of key {key} is zero, but must be a quaternion of length one"),
                        ));
                    }
                    value.copy_from_slice(&rotation.normalize().to_array());
                }
            }
            tracks.push(Track {
                node: place,
                property,
                interpolation,
                times,
                values,
                width,
            });
        }
        Ok(tracks)
    }
}
