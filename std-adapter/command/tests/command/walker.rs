//! `selvedge walker`.

use crate::support::Workplace;

#[test]
fn the_scene_that_it_writes_runs_and_stays_free_of_intersections() {
    let place = Workplace::new();
    place.stdout(&["walker", "--pitch", "0.03", "--output", "walker"]);
    let scene = place.read("walker/walker.toml");
    place.write(
        "walker/walker.toml",
        scene.replace("duration = \"3 s\"", "duration = \"40 ms\""),
    );
    let document = place.json(&["simulate", "walker/walker.toml", "--json"]);
    assert_eq!(
        (
            &document["steps"],
            &document["intersections_at_end"],
            &document["blocked_steps"]
        ),
        (&10.into(), &0.into(), &0.into())
    );
}

#[test]
fn edges_of_any_other_length_are_refused() {
    let place = Workplace::new();
    for pitch in ["0", "0.1", "nan", "long"] {
        let message = place.refusal(2, &["walker", "--pitch", pitch]);
        assert!(message.contains("--pitch"), "{message}");
    }
}
