//! Sets `cfg(unoptimised)` in builds without optimisation.
//!
//! There, vector code is far slower than a plain loop, takes minutes and gigabytes to compile, and its frames overflow the stack
//! of a thread. So it is left out. Both builds give the same verdicts, bit for bit.

fn main() {
    println!("cargo::rustc-check-cfg=cfg(unoptimised)");
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("OPT_LEVEL").as_deref() == Ok("0") {
        println!("cargo::rustc-cfg=unoptimised");
    }
}
