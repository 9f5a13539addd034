//! `selvedge cull`.

use crate::support::{Workplace, moved_by};
use selvedge_laboratory::methods::{PairSource, Preset};

const CULL: [&str; 3] = ["cull", "start.obj", "end.obj"];

fn with<'a>(options: &[&'a str]) -> Vec<&'a str> {
    [&CULL[..], options].concat()
}

#[test]
fn stages_are_those_of_the_preset() {
    let place = Workplace::with_step();
    for preset in Preset::ALL {
        let document = place.json(&with(&["--json", "--pipeline", preset.name()]));
        let names: Vec<_> = document["stages"]
            .as_array()
            .unwrap()
            .iter()
            .map(|stage| stage["stage"].as_str().unwrap().to_owned())
            .collect();
        let mut expected = vec!["broad-phase".to_owned()];
        if preset.stages().source != PairSource::MovingBoxes {
            expected.push("distribution".to_owned());
        }
        expected.extend(preset.stages().tests.iter().map(|test| test.stage().to_string()));
        expected.push("elementary".to_owned());
        assert_eq!(names, expected);
        assert_eq!(document["pipeline"], preset.name());
        assert_eq!(document["contacts"]["vertex_face"], 3, "{preset}");
    }
}

/// The bytes of a point cache of the frames that `moved_by` makes.
fn cache(heights: &[f64], is_mdd: bool) -> Vec<u8> {
    let word = |number: u32| if is_mdd { number.to_be_bytes() } else { number.to_le_bytes() };
    let frames = heights.len() as u32;
    let mut words: Vec<[u8; 4]> = match is_mdd {
        true => [vec![word(frames), word(6)], vec![[0; 4]; heights.len()]].concat(),
        false => vec![
            *b"POIN",
            *b"TCAC",
            *b"HE2\0",
            word(1),
            word(6),
            [0; 4],
            word(1_f32.to_bits()),
            word(frames),
        ],
    };
    for text in heights.iter().map(|&height| moved_by(height)) {
        let numbers = text.lines().take(6).flat_map(|line| line[2..].split(' '));
        words.extend(numbers.map(|number| word(number.parse::<f32>().unwrap().to_bits())));
    }
    words.concat()
}

#[test]
fn frames_of_animations_are_culled_and_checked_like_meshes() {
    let place = Workplace::with_step();
    place.write("a.mdd", cache(&[1.0, 0.0, -4.0], true));
    place.write("a.PC2", cache(&[1.0, 0.0, -4.0], false));
    for (number, height) in [1.0, 0.0, -4.0].into_iter().enumerate() {
        place.write(&format!("a-{number}.obj"), moved_by(height));
    }
    for animation in ["a.mdd", "a.PC2", "a-#.obj"] {
        for (frame, contacts) in [("0", 0), ("1", 3)] {
            let found = place.json(&["cull", "start.obj", animation, "--frame", frame, "--json"]);
            assert_eq!(found["contacts"]["vertex_face"], contacts, "{animation} {frame}");
        }
        let checked = place.json(&["check", "start.obj", "--frames", animation, "--json"]);
        assert_eq!(checked["meshes"].as_array().unwrap().len(), 3, "{checked}");
    }
    place.write("cut.mdd", &cache(&[1.0, 0.0], true)[..100]);
    place.write("not.pc2", cache(&[1.0], true));
    place.write("nan.pc2", [&cache(&[1.0], false)[..100], &f32::NAN.to_le_bytes()].concat());
    place.write("one.mdd", cache(&[1.0], true));
    place.write("more.obj", format!("{}v 1 2 3\n", moved_by(0.0)));
    for (arguments, part) in [
        (
            ["start.obj", "a.mdd", "--frame=2"],
            "a.mdd: there are 3 frames; name the first of the step: --frame 0 to 1",
        ),
        (
            ["start.obj", "one.mdd", "--frame=0"],
            "one.mdd: there is one frame, but a step needs two",
        ),
        (["start.obj", "end.obj", "--frame=0"], "must have one run of '#'"),
        (
            ["more.obj", "a.mdd", "--frame=0"],
            "a.mdd: the header declares 6 points, but the mesh has 7 vertices",
        ),
        (
            ["start.obj", "cut.mdd", "--frame=0"],
            "declares 2 frames of 6 points, which take 160 bytes, but the file has 100; is it complete?",
        ),
        (
            ["start.obj", "not.pc2", "--frame=0"],
            "not.pc2: the header is missing: a PC2 file begins with 'POINTCACHE2'",
        ),
        (
            ["start.obj", "nan.pc2", "--frame=0"],
            "nan.pc2: 'frame' element 0: the z coordinate of vertex 5 is NaN",
        ),
    ] {
        let message = place.refusal(&[&["cull"], &arguments[..]].concat());
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn many_triangles_in_one_place_are_refused_by_the_memory_limit_and_it_can_be_set() {
    let place = Workplace::new();
    let faces: String = (0..200)
        .map(|k| format!("f {} {} {}\n", 3 * k + 1, 3 * k + 2, 3 * k + 3))
        .collect();
    place.write("heap.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n".repeat(200) + &faces);
    for (command, status) in [(&["cull", "heap.obj", "heap.obj"][..], 0), (&["check", "heap.obj"], 3)] {
        let message = place.refusal(&[command, &["--memory-limit", "1"]].concat());
        let expected = "more than 1048576 bytes: check whether many triangles are in one place";
        assert!(message.contains(expected), "{message}");
        let output = place.run(&[command, &["--memory-limit", "0", "--json"]].concat());
        assert_eq!(output.status.code(), Some(status));
    }
}

#[test]
fn times_of_single_precision_are_written_exactly() {
    let place = Workplace::new();
    place.write(
        "start.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 0.3\nv 3 0.2 0.3\nv 3 1 0.3\nf 1 2 3\nf 4 5 6\n",
    );
    place.write(
        "end.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -0.4\nv 3 0.2 0.3\nv 3 1 0.3\nf 1 2 3\nf 4 5 6\n",
    );
    place.stdout(&["cull", "start.obj", "end.obj", "--scalar", "f32", "--pairs", "pairs.csv"]);
    let list = place.read("pairs.csv");
    let times: Vec<f64> = list
        .lines()
        .skip(1)
        .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
        .collect();
    assert!(!times.is_empty());
    assert!(times.iter().all(|&time| f64::from(time as f32) == time), "{list}");
}

#[test]
fn contacts_are_written_with_their_vertices_and_times() {
    let place = Workplace::with_step();
    place.stdout(&with(&["--pairs", "out.csv"]));
    let text = place.read("out.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("kind,i0,i1,i2,i3,time"));
    for (line, (vertex, time)) in lines.zip([(3, 0.25), (4, 0.275), (5, 0.3)]) {
        let (pair, found) = line.rsplit_once(',').unwrap();
        assert_eq!(pair, format!("vertex-face,{vertex},0,1,2"));
        assert!((found.parse::<f64>().unwrap() - time).abs() < 1e-9, "{line}");
    }
    assert_eq!(text.lines().count(), 4);
}

#[test]
fn candidates_hold_every_pair_before_the_elementary_test() {
    let place = Workplace::with_step();
    let all = with(&["--json", "--pipeline", "curtis_2008", "--candidates", "out.csv"]);
    place.stdout(&all);
    let text = place.read("out.csv");
    let mut lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.remove(0), "kind,i0,i1,i2,i3");
    let count = |kind: &str| lines.iter().filter(|line| line.starts_with(kind)).count();
    assert_eq!((count("vertex-face,"), count("edge-edge,")), (6, 9));
    assert!(lines.contains(&"vertex-face,0,3,4,5"));
    lines.sort_unstable();
    lines.dedup();
    assert_eq!(lines.len(), 15);
}

#[test]
fn counts_do_not_depend_on_the_number_of_threads() {
    let place = Workplace::new();
    place.stdout(&["arm", "--frames", "55,56"]);
    let run = |threads: &str| {
        let arguments = ["cull", "arm-55.ply", "arm-56.ply", "--json", "--threads", threads];
        let document = place.json(&[&arguments[..], &["--pairs", "pairs.csv"]].concat());
        (document["contacts"].clone(), place.read("pairs.csv"))
    };
    let one = run("1");
    assert!(one.0["edge_edge"].as_u64().unwrap() > 0);
    assert_eq!(run("3"), one);
    assert_eq!(run("0"), one);
}

#[test]
fn every_instruction_set_can_be_forced_and_changes_nothing() {
    let place = Workplace::with_step();
    let contacts = |options: &[&str]| {
        place.stdout(&[&with(&["--pairs", "out.csv"])[..], options].concat());
        let earliest = place.json(&[&with(&["--json", "--earliest"])[..], options].concat());
        (place.read("out.csv"), earliest["contacts"].clone())
    };
    let best = contacts(&[]);
    for (name, _) in selvedge::simd::available_levels() {
        assert_eq!(contacts(&["--simd", name]), best, "{name}");
    }
}
