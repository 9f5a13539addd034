//! Rows of vertices that are sewn together.

use crate::common::*;

/// An upright panel, 0.2 m wide and 0.3 m high.
fn panel(name: &str, corner: DVec3, cells: [u32; 2]) -> Cloth {
    let cloth = Cloth::sheet(corner, [0.2 * DVec3::X, 0.3 * DVec3::Z], cells, 0.15).unwrap();
    cloth.named(name)
}

/// Makes the front and the back of a bag, 6 cm apart, of different meshes and not yet sewn.
fn panels() -> Scene {
    let mut scene = Scene::new(panel("front", DVec3::ZERO, [10, 15]), 2e-3);
    scene.cloths.push(panel("back", 0.06 * DVec3::Y, [8, 11]));
    scene.add(Gravity::default()).add(Stretch::isotropic(300.0));
    scene.add(Shear::new(60.0));
    scene.add(Bend::isotropic(1e-5)).add(StrainLimit::at(1.1));
    scene.add(SelfCollision(Thickness::new(THICKNESS)));
    scene
}

const THICKNESS: f64 = 3e-3;
const SIDES: [&str; 3] = ["left", "bottom", "right"];

fn rows(scene: &Scene, side: &str) -> [Vec<u32>; 2] {
    ["front", "back"].map(|cloth| scene.part(cloth, side).unwrap())
}

/// Makes a bag that is sewn along three sides in 0.3 s and hangs by the upper edge of the front.
fn bag() -> Scene {
    let mut scene = panels();
    let seam = |side| {
        let [first, second] = rows(&scene, side);
        Seam {
            closing: Some(0.3),
            ..Seam::new(first, second)
        }
    };
    let seams = SIDES.map(seam).into();
    let top = scene.part("front", "top").unwrap();
    scene.add(Seams { seams }).add(resting(top));
    scene
}

/// Returns the distances of the rows of a bag: of each vertex of the finer row to the nearest point of the other.
fn gaps(simulation: &Simulation, scene: &Scene) -> Vec<f64> {
    let at = |vertex: u32| simulation.positions()[vertex as usize];
    let mut gaps = Vec::new();
    for side in SIDES {
        let [first, second] = rows(scene, side);
        for &vertex in &first {
            let to = |two: &[u32]| {
                let [from, way] = [at(two[0]), at(two[1]) - at(two[0])];
                let share = ((at(vertex) - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
                at(vertex).distance(from + way * share)
            };
            gaps.push(second.windows(2).map(to).fold(f64::INFINITY, f64::min));
        }
    }
    gaps
}

#[test]
fn panels_are_drawn_together_in_the_given_time_and_keep_their_gap_from_then_on() {
    let scene = bag();
    let mut simulation = Simulation::new(bag(), 1).unwrap();
    let (mut widest, mut middle) = (Vec::new(), Vec::new());
    for step in 1..=400 {
        simulation.step().unwrap();
        let mut gaps = gaps(&simulation, &scene);
        gaps.sort_by(f64::total_cmp);
        // Sides that a seam joins come as near as half the thickness of neighbours, which is 0.14 thicknesses.
        assert!(gaps[0] > 0.11 * THICKNESS, "step {step}: {}", gaps[0]);
        middle.push(gaps[gaps.len() / 2]);
        widest.push(gaps[gaps.len() - 1]);
    }
    // The distance falls from 6 cm to the thickness. Contacts push after the seam, so some points are a little farther apart.
    assert!((0.030..0.032).contains(&widest[75]), "{}", widest[75]);
    for (middle, widest) in middle.iter().zip(&widest).skip(160) {
        assert!(*middle < 1.15 * THICKNESS && *widest < 1.6 * THICKNESS, "{middle} {widest}");
    }
    // The fold at a corner that is sewn needs a shorter step now and then.
    assert!(simulation.is_certified() && simulation.contact_counts().unwrap().cuts <= 4);
}

#[test]
fn a_seam_without_a_time_holds_rows_as_they_lie_and_one_that_is_not_named_lets_them_fall_apart() {
    let hung = |is_sewn: bool| {
        let mut scene = Scene::new(panel("upper", 0.31 * DVec3::Z, [8, 8]), 2e-3);
        scene.cloths.push(panel("lower", DVec3::ZERO, [8, 8]));
        scene.add(Gravity::default()).add(Stretch::isotropic(300.0));
        scene.add(Shear::new(60.0));
        scene.add(SelfCollision(Thickness::new(THICKNESS)));
        let row = |cloth, part| scene.part(cloth, part).unwrap();
        let [top, first, second] = [row("upper", "top"), row("upper", "bottom"), row("lower", "top")];
        scene.add(resting(top));
        if is_sewn {
            scene.add(Seams {
                seams: vec![Seam::new(first.clone(), second.clone())],
            });
        }
        let simulation = run(scene, 300);
        let at = |vertex: u32| simulation.positions()[vertex as usize];
        let pairs = first.iter().zip(&second);
        pairs.map(|(&a, &b)| at(a).distance(at(b))).fold(0.0, f64::max)
    };
    assert!((0.0099..0.0101).contains(&hung(true)), "{}", hung(true));
    assert!(hung(false) > 1.0);
}

#[test]
fn seams_have_the_same_bits_on_any_number_of_threads_and_resumed_while_they_close() {
    let scene = || {
        let mut scene = bag();
        // The seam is still open after 0.4 s, where the run is resumed.
        scene.add(Seams {
            seams: SIDES
                .map(|side| {
                    let [first, second] = rows(&scene, side);
                    Seam {
                        closing: Some(0.6),
                        gap: Some(0.004),
                        ..Seam::new(first, second)
                    }
                })
                .into(),
        });
        scene
    };
    assert_same_bits(scene, CHECKPOINT_STEPS, 150);
}

/// Adds a changed seam at the left sides.
fn sewn(change: impl FnOnce(&mut Seam)) -> impl FnOnce(&mut Scene) {
    |scene| {
        let [first, second] = rows(scene, "left");
        let mut seam = Seam::new(first, second);
        change(&mut seam);
        scene.add(Seams { seams: vec![seam] });
    }
}

#[test]
fn wrong_seams_from_code_get_errors_that_say_what_would_be_right() {
    assert_complaints! { panels();
        sewn(|seam| seam.gap = Some(1e-3))
            => "seams: `gap` is 0.001 m, but contact keeps 0.003 m between the rows: choose at least that, or leave `gap` out";
        sewn(|seam| seam.gap = Some(1.0)) => "seams: `gap` is 1 m, but must be from 0 m to 0.1 m";
        sewn(|seam| seam.closing = Some(0.0)) => "seams: `closing` is 0 s, but must be from 1e-6 s to 100000 s";
        sewn(|seam| seam.closing = Some(1e-4))
            => "seams: the rows of the seam would close at 570 m/s, but the limit is 100 m/s: choose a longer `closing`";
        sewn(|seam| seam.first.truncate(1))
            => "seams: a row of a seam needs at least two vertices, and successive vertices must differ in place; or both rows are single vertices";
        sewn(|seam| seam.second.insert(0, seam.second[0]))
            => "seams: a row of a seam needs at least two vertices, and successive vertices must differ in place; or both rows are single vertices";
        sewn(|seam| seam.second[1] = seam.first[1]) => "seams: vertex 11 is in both rows of a seam, but cannot be sewn to itself";
        sewn(|seam| seam.second[1] = 9999) => "seams: the scene has no vertex 9999 of cloth: it has 284, numbered from 0";
        |s| _ = s.add(Seams::default()) => "seams: seams need at least one [[effects.seams.seam]]";
    }
}

const BAG: &str = include_str!("scenes/bag.toml");

#[test]
fn a_file_names_rows_by_cloth_and_part_and_reversed_where_they_run_against_each_other() {
    let simulation = run(Scene::parse(BAG, Path::new("bag.toml")).unwrap(), 200);
    // The front is numbered row by row from below, the back from above and from the right: its last vertex is the lower left one.
    let [front, back] = [0, 1].map(|cloth| simulation.vertices_of_cloth(cloth).unwrap());
    for row in 0..=15 {
        let [a, b] = [front.start + 11 * row, back.end - 1 - 11 * row].map(|vertex| simulation.positions()[vertex]);
        assert!(a.distance(b) < 5e-3, "{row}: {}", a.distance(b));
    }
}
