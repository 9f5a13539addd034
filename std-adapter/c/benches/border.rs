//! Measures the cost of C's interface: a step through it beside the same step of the detector, in turn.
//!
//! ```sh
//! cargo bench -p selvedge-c -- START.ply END.ply
//! ```
//!
//! Both are linked into this program, so that only the interface differs.

use selvedge::{CollisionDetector, Contact};
use selvedge_files::mesh::{MeshStep, read_step};
use std::ffi::c_void;
use std::path::Path;
use std::time::Instant;
use std::{env, ptr};

use selvedge_c as _;

unsafe extern "C" {
    fn selvedge_detector_new(scalar: u32, vertices: usize, triangles: *const u32, count: usize, out: *mut *mut c_void) -> i32;
    fn selvedge_detector_contacts_f64(
        detector: *mut c_void,
        start: *const f64,
        end: *const f64,
        vertices: usize,
        contacts: *mut *const c_void,
        count: *mut usize,
    ) -> i32;
    fn selvedge_detector_free(detector: *mut c_void) -> i32;
}

/// The number of pairs of new detectors. The memory that each happens to get changes its time by more than the interface does.
const PAIRS: usize = 10;
/// The number of steps of each.
const STEPS: usize = 12;

fn main() {
    let paths: Vec<String> = env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [start, end] = &paths[..] else {
        println!("usage: cargo bench -p selvedge-c -- START.ply END.ply");
        return;
    };
    let step = read_step(Path::new(start), Path::new(end)).unwrap();

    let mut least = [Vec::new(), Vec::new()];
    for pair in 0..PAIRS {
        let (mut rust, mut c);
        if pair % 2 == 0 {
            rust = Rust::new(&step);
            c = C::new(&step);
        } else {
            c = C::new(&step);
            rust = Rust::new(&step);
        }
        let mut of_pair = [f64::INFINITY; 2];
        for _ in 0..STEPS {
            let clock = Instant::now();
            let found = rust.step(&step);
            of_pair[0] = of_pair[0].min(clock.elapsed().as_secs_f64());

            let clock = Instant::now();
            let found_by_c = c.step(&step);
            of_pair[1] = of_pair[1].min(clock.elapsed().as_secs_f64());
            assert_eq!(found_by_c, found);
        }
        println!("Rust {:.2} ms, C {:.2} ms", 1e3 * of_pair[0], 1e3 * of_pair[1]);
        least[0].push(of_pair[0]);
        least[1].push(of_pair[1]);
    }
    let [rust, c] = least.map(|seconds| 1e3 * seconds.iter().sum::<f64>() / PAIRS as f64);
    let more = c - rust;
    println!(
        "mean: Rust {rust:.2} ms, C {c:.2} ms: {more:.2} ms more, {:.1} %",
        100.0 * more / rust
    );
}

struct Rust {
    detector: CollisionDetector<f64>,
    contacts: Vec<Contact<f64>>,
}

impl Rust {
    fn new(step: &MeshStep) -> Self {
        Self {
            detector: CollisionDetector::new(step.topology.clone()),
            contacts: Vec::new(),
        }
    }

    fn step(&mut self, step: &MeshStep) -> usize {
        self.detector.contacts(&step.start, &step.end, &mut self.contacts).unwrap();
        self.contacts.len()
    }
}

struct C(*mut c_void);

impl C {
    fn new(step: &MeshStep) -> Self {
        let mut handle = ptr::null_mut();
        let (triangles, vertices) = (step.topology.triangles(), step.topology.vertex_count());
        // SAFETY: the arrays are as long as the counts say; 1 is for double.
        let made = unsafe { selvedge_detector_new(1, vertices, triangles.as_ptr().cast(), triangles.len(), &raw mut handle) };
        assert_eq!(made, 0);
        Self(handle)
    }

    fn step(&mut self, step: &MeshStep) -> usize {
        let (mut rows, mut found) = (ptr::null(), 0);
        let (start, end, vertices) = (step.start.as_ptr().cast(), step.end.as_ptr().cast(), step.start.len());
        // SAFETY: these are positions of that mesh, three numbers each.
        let status = unsafe { selvedge_detector_contacts_f64(self.0, start, end, vertices, &raw mut rows, &raw mut found) };
        assert_eq!(status, 0);
        found
    }
}

impl Drop for C {
    fn drop(&mut self) {
        // SAFETY: it was made above.
        unsafe { selvedge_detector_free(self.0) };
    }
}
