//! `selvedge walker`.

use crate::support::Workplace;

#[test]
fn the_scene_that_it_writes_runs_and_stays_free_of_intersections() {
    let place = Workplace::new();
    place.stdout(&["walker", "--output", "walker"]);
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
