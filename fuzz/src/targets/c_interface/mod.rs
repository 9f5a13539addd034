//! Any calls of C's interface.
//!
//! The caller keeps the one promise of C's headers: a pointer that is neither NULL nor misaligned points to as many entries as
//! the count says, unless the count is one that the library refuses before it reads an entry.

mod caller;
mod detectors;
mod simulations;
mod worlds;

use caller::Caller;
use detectors::Detectors;
use simulations::Simulations;
use worlds::Worlds;

/// Calls C's functions with any arguments, in any order. None panics. Each that fails has a message and writes no answer; lists
/// of earlier calls keep their entries. Calls that succeed leave the last error as it was.
pub fn c_interface(data: &[u8]) {
    let mut caller = Caller::new(data);
    let (mut detectors, mut worlds, mut simulations) = (Detectors::default(), Worlds::default(), Simulations::default());
    while !caller.is_done() {
        match caller.byte() {
            0..120 => detectors.call(&mut caller),
            120..190 => worlds.call(&mut caller),
            _ => simulations.call(&mut caller),
        }
    }
    detectors.free();
    worlds.free();
    simulations.free();
}
