//! Permanent folds.

use crate::common::*;

/// Lifts the right half for half a second.
#[derive(Clone, Copy, Debug)]
struct Hand;

selvedge_cloth::identify!(Hand {});

impl Effect for Hand {
    fn name(&self) -> &'static str {
        "hand"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for Hand {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        for (velocity, start) in velocities.iter_mut().zip(step.start) {
            if step.time < 0.5 && start.x > 0.05 {
                velocity.z += 20.0 * step.h;
            }
        }
    }
}

/// A strip of 10 cm, clamped at its left end or free, that is lifted at its right end and released.
fn strip(is_clamped: bool, folds: Option<PlasticFolds>) -> Scene {
    let strip = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.1, DVec3::Y * 0.02], [20, 4], 0.2).unwrap();
    let clamped: Vec<u32> = (0..105).filter(|v| v % 21 < 2).collect();
    let mut scene = Scene::new(strip, 1e-3);
    scene.add(Stretch::isotropic(1000.0)).add(Shear::new(300.0));
    scene.add(Bend::isotropic(1e-4)).add(AirDrag { rate: 10.0 }).add(Hand);
    if is_clamped {
        scene.add(resting(clamped));
    }
    if let Some(folds) = folds {
        scene.add(folds);
    }
    scene
}

fn height(simulation: &Simulation) -> f64 {
    simulation.positions()[20].z
}

#[test]
fn what_is_bent_beyond_the_yield_curvature_stays_bent_and_what_is_not_comes_back() {
    let lifted = |yield_curvature| {
        let folds = Some(PlasticFolds::beyond(yield_curvature));
        [500, 2500].map(|steps| height(&run(strip(true, folds), steps)))
    };
    let [up, back] = lifted(1e4);
    assert!(up > 0.04 && back.abs() < 1e-4, "{up} {back}");
    let [up, kept] = lifted(30.0);
    assert!(kept > 0.02 && kept < up, "{up} {kept}");
    // A cloth that yields sooner keeps more of the bend.
    let [_, more] = lifted(20.0);
    assert!(more > 1.5 * kept, "{more} {kept}");
}

#[test]
fn folds_that_never_yield_change_no_bit() {
    let [with, without] = [Some(PlasticFolds::beyond(1e6)), None].map(|folds| run(strip(true, folds), 600));
    assert_eq!(with.positions(), without.positions());
}

/// Three corners of a square of two triangles are held, and one is lifted within a tenth of a second. The excess over yielding
/// decays by e in each `creep`.
#[test]
fn what_is_held_bent_creeps_until_it_pulls_no_more_than_at_yielding() {
    let held = |folds: Option<PlasticFolds>, steps: u64| {
        let mut scene = square([&[0, 1, 2], &[3]], DVec3::Z * 0.3, 0.1, 1e-3);
        scene.add(Bend::isotropic(1e-5));
        if let Some(folds) = folds {
            scene.add(folds);
        }
        run(scene, steps).energy().elastic().unwrap()
    };
    let yielding = |curvature: f64, creep: f64, steps| {
        let folds = PlasticFolds {
            creep,
            ..PlasticFolds::beyond(curvature)
        };
        held(Some(folds), steps)
    };
    // This part no fold can take: C is not quite along the normal, since the square is stretched.
    let least = yielding(1e-3, 0.0, 200);
    // The energy grows with the square of the elastic part.
    let pull = |energy: f64| (energy - least).sqrt();
    let at_once = pull(yielding(0.1, 0.0, 200));
    assert!(at_once < 0.5 * pull(held(None, 200)) && at_once > 0.0);
    let [sooner, later] = [200, 500].map(|steps| pull(yielding(0.1, 0.1, steps)) - at_once);
    assert!((sooner / later / 3.0_f64.exp() - 1.0).abs() < 1e-3, "{sooner} {later}");
}

/// The loads on a free strip sum to zero. Drag slows everything at one rate.
#[test]
fn folds_push_nothing_as_a_whole() {
    let mut scene = strip(false, Some(PlasticFolds::beyond(2.0)));
    scene.add(AirDrag { rate: 0.0 });
    let mut free = run(scene, 600);
    let masses = shares(&free);
    let momentum = |now: &Simulation| -> DVec3 { now.velocities().iter().zip(&masses).map(|(v, m)| *v * *m).sum() };
    let before = momentum(&free);
    advance(&mut free, 500);
    let change = momentum(&free) - before;
    assert!(
        before.z > 1.0 && change.length() < 1e-9 * before.length(),
        "{before} {change}"
    );
    // The strip has folded, since it moves differently from an elastic one.
    let mut elastic = strip(false, None);
    elastic.add(AirDrag { rate: 0.0 });
    let elastic = run(elastic, 1100);
    let differ = free.positions().iter().zip(elastic.positions()).map(|(a, b)| a.distance(*b));
    assert!(differ.fold(0.0, f64::max) > 1e-3);
}

#[test]
fn folds_are_the_same_bits_on_two_threads_and_resumed_from_a_checkpoint() {
    let scene = || {
        let folds = PlasticFolds {
            creep: 0.05,
            ..PlasticFolds::beyond(20.0)
        };
        strip(true, Some(folds))
    };
    assert_same_bits(scene, 2 * CHECKPOINT_STEPS, 300);
}

const CRUMPLING: &str = include_str!("scenes/crumpling.toml");

/// Kinetic energy only becomes elastic energy and heat, in folds as well.
#[test]
fn a_sheet_that_crumples_never_moves_faster_than_it_was_thrown() {
    let mut simulation = set_up(CRUMPLING, "scene.toml", 1);
    let start = simulation.energy().kinetic;
    let mut most = 0.0_f64;
    for _ in 0..800 {
        simulation.step().unwrap();
        most = most.max(simulation.energy().kinetic);
    }
    assert!(most <= start * (1.0 + 1e-9) && simulation.is_certified(), "{most} of {start}");
    assert!(simulation.contact_counts().unwrap().pushed > 1000);
}

#[test]
fn folds_that_yield_at_once_are_an_error() {
    assert_complaints! { strip(true, None);
        |s| _ = s.add(PlasticFolds::beyond(0.0)) => "plastic_folds: `yield_curvature` is 0 1/m, but must be from…";
    }
}
