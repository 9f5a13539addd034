use crate::garments::{NAMES, garment};
use selvedge_cloth::{Simulation, TangledStart};
#[test]
fn plateaus() {
    for (cells, depths) in [(20u32, &[1.0, 2.0, 3.0][..]), (60, &[1.0, 2.0][..])] {
        for name in NAMES {
            for &depth in depths {
                let mut scene = garment(name, cells, depth);
                scene.tangled_start = TangledStart::Untangle;
                let mut seen = Vec::new();
                let made = Simulation::with_progress(scene, 1, &mut |now| seen.push(now.crossings));
                let (mut fewest, mut at, mut longest) = (usize::MAX, 0, 0);
                for (k, &c) in seen.iter().enumerate() {
                    if c > 0 {
                        longest = longest.max(k - at);
                        if c < fewest {
                            fewest = c;
                            at = k;
                        }
                    }
                }
                println!(
                    "{cells} {name} {depth}: ok {} steps {} longest plateau {longest}, fewest {fewest} at {at}",
                    made.is_ok(),
                    seen.len()
                );
            }
        }
    }
}
