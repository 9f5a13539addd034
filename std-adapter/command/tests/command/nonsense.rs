//! Files that are no mesh.

#[path = "../../../files/tests/nonsense/mod.rs"]
mod table;

use crate::support::Workplace;

#[test]
fn each_is_named_with_the_place_and_what_was_found() {
    let place = Workplace::with_step();
    place.write("folder/a.obj", "");
    for (name, content, _) in table::nonsense() {
        place.write(name, content);
    }
    let others = [
        ("gone.ply", "there is no such file"),
        ("folder", "this is a folder; name a mesh file in it"),
    ];
    let all = table::nonsense()
        .into_iter()
        .map(|(name, _, message)| (name, message))
        .chain(others);
    for (name, message) in all {
        let said = format!("error: {name}: {message}\n");
        assert_eq!(place.refusal(&["check", name]), said);
        assert_eq!(
            place.refusal(&["cull", "start.obj", name, "--pairs", "p.csv", "--candidates", "c.csv"]),
            said
        );
    }
}
