//! Selvedge in JavaScript: the classes and functions of the npm package `selvedge`.
//!
//! wasm-bindgen writes the JavaScript and the TypeScript declarations from this crate. Both take their comments from here, so the
//! comments name things as JavaScript does. Lengths are in the caller's unit for a [`Detector`], and SI units hold in a
//! [`Simulation`].
//!
//! A typed array that a getter of positions returns is a view of the module's memory. It is valid until the next call of its
//! object, and as long as the memory does not grow. Read, draw or copy it at once. All other arrays are the caller's own.

mod detector;
mod numbers;
mod pair;

#[cfg(feature = "page")]
mod page;
#[cfg(feature = "cloth")]
mod scene;
#[cfg(feature = "cloth")]
mod simulation;
mod values;

pub use detector::Detector;
#[cfg(feature = "cloth")]
pub use simulation::Simulation;
