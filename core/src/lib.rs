//! Certified culling of vertex-face and edge-edge pairs.
#![no_std]
#![forbid(unsafe_code)]
pub use glam;
