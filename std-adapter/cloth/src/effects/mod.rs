//! Effects: everything that acts on cloth, one file each. Their fields are the settings of scene files, in SI units.
//! [`Scene::add`](crate::Scene::add) adds one to a scene, [`Scene::add_to`](crate::Scene::add_to) to one of several cloths.
//!
//! Your own effect implements [`Effect`], and puts [`Force`]s and [`Term`]s into the [`Plan`] of a step: accelerations, and
//! energies that the step minimises together with those of this crate. Every step is certified whatever they do. See
//! `examples/own_effect.rs`.
// To add an effect here: its own file, a `mod` line, a `pub use`, and a line of `REGISTRY`.

mod air;
mod air_drag;
mod anchor;
mod attachments;
mod bend;
mod body_contact;
mod called;
mod enclosed;
mod friction;
mod gravity;
mod inflation;
mod pins;
pub(crate) mod plan;
mod plastic_folds;
mod pressure;
mod reading;
mod registration;
mod registry;
mod rope_bend;
mod rope_stretch;
mod seams;
mod selection;
mod self_collision;
mod shear;
mod soft_pins;
mod strain_limit;
mod stretch;
mod tearing;
mod thickness;
mod vertices;

pub use crate::contact::Thickness;
pub use crate::model::energy::{Configuration, StoredEnergy};
pub use crate::model::step::{Force, Memory, Release, TimeStep};
pub use crate::solve::{Matrix, Prediction, Renewed, Term};
pub use crate::world::SceneParts;
pub use air::{Air, AirSource, Fan, Vortex, Wind, WindField};
pub use air_drag::AirDrag;
pub use attachments::{AttachmentGroup, Attachments};
pub use bend::Bend;
pub use body_contact::BodyContact;
pub use friction::Friction;
pub use gravity::Gravity;
pub(crate) use gravity::NAME as GRAVITY;
pub use inflation::{Inflation, PressureKey};
pub use pins::{PinGroup, PinMotion, Pins};
pub use plan::Plan;
pub use plastic_folds::PlasticFolds;
pub use pressure::InternalPressure;
pub use registration::{ActsOn, Effect, Scope};
pub use registry::effect_names;
pub use rope_bend::{RopeBend, RopeShape};
pub use rope_stretch::RopeStretch;
pub use seams::{Seam, Seams};
pub use self_collision::SelfCollision;
pub use shear::Shear;
pub use strain_limit::StrainLimit;
pub use stretch::Stretch;
pub use tearing::{Perforation, Tearing};

pub(crate) use called::{Called, Effects, Wrong};
pub(crate) use reading::{read, read_known};
