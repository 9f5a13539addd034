//! A step as every layer uses it: positions, motions, contacts, errors.

mod cancellation;
mod collision_filter;
mod contact;
mod error;
mod frames;

pub use cancellation::Cancellation;
pub(crate) use collision_filter::Members;
pub use collision_filter::{CollisionFilter, Groups};
pub use contact::{Contact, Intersection, Truncation};
pub use error::{Frame, StepError};
pub use frames::check_frames;
pub(crate) use frames::{Motions, Step, check_frame, check_length, check_pair, exactly, nearest, rounded};
