//! An effect that a scene does not name costs nothing.

use crate::common::*;

const HEAD: &str = r#"
time_step = "1 ms"
duration = "1 s"
[cloth]
shape = "sheet"
corner = [0, 0, 1]
sides = { first = [0.3, 0, 0], second = [0, 0.3, 0] }
cells = [12, 12]
density = "200 g/m2"
[[body]]
name = "ball"
shape = "ball"
centre = [0, 0, 0]
radius = "10 cm"
"#;

const EFFECTS: [(&str, &str); 17] = [
    ("gravity", ""),
    ("wind", "velocity = [1, 0, 0]"),
    (
        "wind_field",
        "fan = [{ at = [0, 0, -1], velocity = [0, 0, 1], radius = 0.1 }]",
    ),
    ("inflation", "pressure = \"1 Pa\""),
    ("air_drag", "rate = 1"),
    ("pins", "group = [{ part = \"left\" }]"),
    ("attachments", "group = [{ part = \"top-right\", limit = 1 }]"),
    ("stretch", "stiffness = 100"),
    ("shear", "stiffness = 100"),
    ("bend", "stiffness = 1e-5"),
    ("plastic_folds", "yield_curvature = 100"),
    ("strain_limit", "limit = 1.1"),
    (
        "seams",
        "seam = [{ first = { part = \"left\" }, second = { part = \"right\" } }]",
    ),
    ("body_contact", "thickness = \"1 mm\""),
    ("self_collision", "thickness = \"1 mm\""),
    ("friction", "coefficient = 0.3"),
    ("tearing", "strength = 1e6"),
];

fn scene(effects: &[(&str, &str)]) -> Simulation {
    let tables = effects.iter().map(|(name, keys)| format!("[effects.{name}]\n{keys}\n"));
    let text = HEAD.to_owned() + &tables.collect::<String>();
    set_up(&text, "sheet.toml", 1)
}

fn names(simulation: &Simulation) -> Vec<&str> {
    simulation.effects().iter().map(|effect| effect.name).collect()
}

#[test]
fn exactly_the_effects_named_are_constructed_and_reported() {
    // Every effect is in the list except internal pressure, which needs a closed cloth, and the two of ropes.
    assert_eq!(EFFECTS.len() + 3, effect_names().len());
    for left_out in 0..EFFECTS.len() {
        let mut effects = EFFECTS.to_vec();
        let (removed, _) = effects.remove(left_out);
        // Folds need bending, and tearing needs stretch.
        effects.retain(|(name, _)| ![("bend", "plastic_folds"), ("stretch", "tearing")].contains(&(removed, name)));
        // The file has them in reverse, but they run in the registry's order.
        let reversed: Vec<_> = effects.iter().rev().copied().collect();
        let simulation = scene(&reversed);
        let expected: Vec<_> = effects.iter().map(|(name, _)| *name).collect();
        assert_eq!(names(&simulation), expected);
    }
}

#[test]
fn without_a_contact_effect_nothing_looks_for_contact() {
    let contact = ["body_contact", "self_collision", "friction"];
    let others: Vec<_> = EFFECTS.into_iter().filter(|(name, _)| !contact.contains(name)).collect();
    let simulation = scene(&others);
    assert!(simulation.contact_counts().is_none() && simulation.contact_seconds().is_none());
    assert!(!simulation.is_certified());
    assert!(scene(&EFFECTS).is_certified());
}

/// Each effect adds to the bytes of set-up; without it nothing is allocated.
#[test]
fn every_effect_named_and_no_other_takes_memory() {
    let bytes = |count: usize| {
        let mut simulation = None;
        let counted = allocation_counter::measure(|| simulation = Some(scene(&EFFECTS[..count])));
        drop(simulation);
        counted.bytes_current
    };
    let sheet = 13 * 13 * size_of::<[f64; 3]>() as i64;
    for count in 0..EFFECTS.len() {
        let more = bytes(count + 1) - bytes(count);
        assert!(more > 0, "{}", EFFECTS[count].0);
        // These own a few numbers, and nothing per vertex; pins and attachments own their list.
        if ["gravity", "air_drag", "pins", "attachments", "friction"].contains(&EFFECTS[count].0) {
            assert!(more < sheet / 2, "{}: {more} bytes", EFFECTS[count].0);
        }
    }
    assert_eq!(bytes(0), bytes(0));
}

#[test]
fn a_step_allocates_nothing_after_the_first_few() {
    for (name, settled) in [("hanging.toml", 1), ("flag.toml", 1)] {
        let mut simulation = load(name, |text| text, 1);
        (0..settled).for_each(|_| simulation.step().unwrap());
        let counted = allocation_counter::measure(|| (0..100).for_each(|_| simulation.step().unwrap()));
        assert_eq!(counted.count_total, 0, "{name}");
    }
}
