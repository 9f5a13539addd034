//! Meshes of files in scenes, with their groups, units and seams, and figures that share an animation.

#[path = "../../../files/tests/nonsense/mod.rs"]
mod nonsense;

use crate::common::*;
use nonsense::nonsense;
use std::fs;
use tempfile::TempDir;

/// Two triangles of a square in centimetres with a split seam, each a group, and a small one apart from them.
const SQUARE: &str = "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 0 0\nv 100 100 1e-5\nv 0 100 0\nv 0 0 9\nv 50 0 9\nv 0 50 9\n\
                      g lower\nf 1 2 3\ng upper\nf 4 5 6\ng pocket\nf 7 8 9\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("square.obj"), SQUARE).unwrap();
    folder
}

fn scene(folder: &TempDir, cloth: &str, bodies: &str) -> Result<Scene, String> {
    let text = format!("time_step = 0.002\nduration = 1\n[cloth]\ndensity = 0.2\n{cloth}\n{bodies}\n[effects.gravity]\n");
    let path = folder.path().join("scene.toml");
    let found = |error: selvedge_cloth::SceneError| error.to_string().replace(&*folder.path().to_string_lossy(), "F");
    Scene::parse(&text, Path::new(&path)).map_err(found)
}

#[test]
fn a_file_is_read_in_its_unit_with_its_seams_merged_and_a_group_alone() {
    let folder = folder();
    let size = |keys: &str| {
        let scene = scene(&folder, &format!("shape = \"file\"\nfile = \"square.obj\"\n{keys}"), "").unwrap();
        let mesh = scene.cloths[0].mesh();
        let far = mesh
            .positions
            .iter()
            .map(|position| position.max_element())
            .fold(0.0, f64::max);
        (mesh.positions.len(), mesh.triangles.len(), far)
    };
    assert_eq!(size(""), (9, 3, 100.0));
    assert_eq!(size("unit = \"cm\""), (9, 3, 1.0));
    assert_eq!(size("unit = \"cm\"\nscale = 2"), (9, 3, 2.0));
    // The tolerance is in metres, after scaling.
    assert_eq!(size("unit = \"cm\"\nweld = 0"), (8, 3, 1.0));
    assert_eq!(size("unit = \"cm\"\nweld = \"1 um\""), (7, 3, 1.0));
    assert_eq!(size("unit = \"cm\"\ngroup = \"upper\""), (3, 1, 1.0));
    assert_eq!(size("group = \"pocket\"\nweld = 0"), (3, 1, 50.0));

    // Scaled, then turned about x, so that y goes up, then moved.
    let turned = "unit = \"cm\"\nrotation = { axis = [2, 0, 0], angle = \"90 deg\" }\ntranslation = [0, \"50 cm\", 3]";
    let placed = scene(&folder, &format!("shape = \"file\"\nfile = \"square.obj\"\n{turned}"), "").unwrap();
    let corners = &placed.cloths[0].mesh().positions;
    assert!(corners[2].distance(DVec3::new(1.0, 0.5, 4.0)) < 1e-15 && corners[6].distance(DVec3::new(0.0, 0.41, 3.0)) < 1e-15);

    let refused = |keys: &str| scene(&folder, &format!("shape = \"file\"\nfile = \"square.obj\"\n{keys}"), "").unwrap_err();
    assert!(refused("rotation = { axis = [0, 0, 0], angle = 1 }").starts_with("F/scene.toml:7:21: `axis` must not be zero"));
    assert!(refused("rotation = { axis = [0, 0, 1] }").contains("`angle`"));
    let message = "F/scene.toml:7:9: F/square.obj: there is no group or object 'hood'; choose from 'lower', 'upper', 'pocket'";
    assert_eq!(refused("group = \"hood\""), message);
    assert!(refused("unit = \"yard\"").starts_with("F/scene.toml:7:8: `unit` cannot be 'yard'"));
    assert!(refused("weld = \"1 m\"").starts_with("F/scene.toml:7:8: `weld` is 1 m, but must be from 0 m to"));
    fs::write(folder.path().join("square.obj"), format!("{SQUARE}surf 0 1 0 1 1 2 3\n")).unwrap();
    assert_eq!(
        refused(""),
        "F/scene.toml:6:8: F/square.obj: not all of the file can be read: 1 line 'surf' (line 16); export it as plain triangles"
    );
}

#[test]
fn nonsense_is_refused_with_its_place_in_the_scene_and_in_the_file() {
    let folder = folder();
    for (name, content, message) in nonsense() {
        fs::write(folder.path().join(name), content).unwrap();
        let error = scene(&folder, &format!("shape = \"file\"\nfile = \"{name}\""), "").unwrap_err();
        assert_eq!(error, format!("F/scene.toml:6:8: F/{name}: {message}"));
    }
}

/// Writes a triangle that two nodes move along x by a metre, one from 0 to 1 s, the other from 0.5 to 1.5 s.
fn two_nodes(folder: &TempDir) {
    let numbers: [f32; 19] = [
        0., 0., 0., 1., 0., 0., 0., 1., 0., /* times */ 0., 1., 0.5, 1.5, /* x y z, twice */ 0., 0., 0., 1., 0., 0.,
    ];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    fs::write(folder.path().join("two.bin"), bytes).unwrap();
    let accessor = |offset: usize, kind: &str, count: usize| {
        format!(r#"{{"bufferView":0,"byteOffset":{offset},"componentType":5126,"type":"{kind}","count":{count}}}"#)
    };
    let accessors = [
        accessor(0, "VEC3", 3),
        accessor(36, "SCALAR", 2),
        accessor(44, "SCALAR", 2),
        accessor(52, "VEC3", 2),
    ];
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"uri":"two.bin","byteLength":76}}],"bufferViews":[{{"buffer":0,"byteLength":76}}],
"accessors":[{}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{{"name":"A","mesh":0}},{{"name":"B","mesh":0}}],
"animations":[{{"samplers":[{{"input":1,"output":3}},{{"input":2,"output":3}}],"channels":[{{"sampler":0,"target":{{"node":0,"path":"translation"}}}},
{{"sampler":1,"target":{{"node":1,"path":"translation"}}}}]}}]}}"#,
        accessors.join(",")
    );
    fs::write(folder.path().join("two.gltf"), json).unwrap();
}

#[test]
fn nodes_of_one_animation_keep_one_clock() {
    let folder = folder();
    two_nodes(&folder);
    let along = |keys: &str| {
        let sheet = "shape = \"sheet\"\nsides = { first = [1, 0, 0], second = [0, 0, 1] }\ncells = [2, 2]";
        let body = format!("[[body]]\nname = \"body\"\nshape = \"gltf\"\nfile = \"two.gltf\"\n{keys}");
        let scene = scene(&folder, sheet, &body).unwrap();
        let BodyMotion::Animated(animation) = &scene.bodies[0].motion else {
            panic!("it is animated");
        };
        let animation = animation.clone();
        move |time: f64| -> Vec<f64> {
            animation
                .positions_at(time)
                .iter()
                .step_by(3)
                .map(|position| position.x)
                .collect()
        }
    };
    let (a, b, both) = (along("node = \"A\""), along("node = \"B\""), along(""));
    for (time, expected) in [
        (0.0, [0.0, 0.0]),
        (0.5, [0.5, 0.0]),
        (1.0, [1.0, 0.5]),
        (1.5, [1.0, 1.0]),
        (9.0, [1.0, 1.0]),
    ] {
        assert_eq!([a(time), b(time)].concat(), expected, "{time}");
        assert_eq!(both(time), expected, "{time}");
    }
    let later = [along("node = \"A\"\nstart = 1"), along("node = \"B\"\nstart = 1")];
    assert_eq!([later[0](1.75), later[1](1.75)].concat(), [0.75, 0.25]);
    assert_eq!(along("unit = \"cm\"")(1.0), [0.01, 0.005]);
    assert_eq!(along("translation = [3, 0, 0]\nscale = 2")(1.0), [5.0, 4.0]);
    // Half a turn about z.
    let turned = along("rotation = { axis = [0, 0, 1], angle = \"180 deg\" }")(1.0);
    assert!(
        (turned[0] + 1.0).abs() < 1e-15 && (turned[1] + 0.5).abs() < 1e-15,
        "{turned:?}"
    );
}

#[test]
fn a_point_cache_moves_the_body_of_another_file() {
    let folder = folder();
    let put = |name: &str, bytes: Vec<u8>| fs::write(folder.path().join(name), bytes).unwrap();
    // Nine vertices in two frames: at the origin, then a metre up.
    let numbers = [vec![0.0_f32; 27], [0.0_f32, 0.0, 1.0].repeat(9)].concat();
    let header = [
        &b"POINTCACHE2\0"[..],
        &1_u32.to_le_bytes(),
        &9_u32.to_le_bytes(),
        &[0; 8],
        &2_u32.to_le_bytes(),
    ]
    .concat();
    put(
        "leaf.pc2",
        [header, numbers.iter().flat_map(|number| number.to_le_bytes()).collect()].concat(),
    );
    let sheet = "shape = \"sheet\"\nsides = { first = [1, 0, 0], second = [0, 0, 1] }\ncells = [2, 2]";
    let read = |keys: &str| {
        let body = format!("[[body]]\nname = \"leaf\"\nshape = \"frames\"\nframes_per_second = 2\n{keys}");
        scene(&folder, sheet, &body).map(|mut scene| scene.bodies.remove(0))
    };
    let body = read("files = \"leaf.pc2\"\nmesh = \"square.obj\"\ntranslation = [1, 0, 0]").unwrap();
    let BodyMotion::Animated(animation) = &body.motion else {
        panic!("it is animated");
    };
    assert_eq!((body.mesh.triangles.len(), animation.span()), (3, [0.0, 0.5]));
    assert_eq!(animation.positions_at(0.25)[8], DVec3::new(1.0, 0.0, 0.5));
    for (keys, message) in [
        (
            "files = \"leaf.pc2\"",
            "12:9: a point cache has no triangles: name the mesh that it moves, such as `mesh = \"body.obj\"`",
        ),
        (
            "mesh = \"square.obj\"\nfiles = \"leaf-#.obj\"",
            "12:8: `mesh` is for point caches",
        ),
        (
            "mesh = \"square.obj\"\nfiles = \"two.mdd\"",
            "13:9: F/two.mdd: there is no such file",
        ),
        (
            "mesh = \"no.obj\"\nfiles = \"leaf.pc2\"",
            "12:8: F/no.obj: there is no such file",
        ),
    ] {
        let error = read(keys).unwrap_err();
        assert!(error.starts_with(&format!("F/scene.toml:{message}")), "{error}");
    }
}

#[test]
fn a_split_seam_is_named_with_its_remedy_and_runs_once_it_is_merged() {
    let folder = folder();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
    fs::write(folder.path().join("square.obj"), square).unwrap();
    let made = |keys: &str| {
        let cloth = format!("shape = \"file\"\nfile = \"square.obj\"\n{keys}");
        let scene = scene(&folder, &cloth, "[effects.self_collision]\nthickness = 0.003").unwrap();
        Simulation::new(scene, 1).map_err(|error| error.to_string())
    };
    let message = made("").err().unwrap();
    assert!(
        message.contains("; 2 vertices lie in the same place as others: merge them with `weld = \"0\"`"),
        "{message}"
    );
    let mut welded = made("weld = 0").unwrap();
    welded.step().unwrap();
    assert_eq!(welded.positions().len(), 4);
    // Written as in the file, with the seam.
    let in_files = welded.mesh_in_files();
    let written = in_files.mesh;
    assert_eq!(
        (written.triangles, in_files.number_of),
        (vec![[0, 1, 2], [3, 4, 5]], vec![0, 1, 2, 5])
    );
    let now = welded.positions();
    assert_eq!(written.positions, [0, 1, 2, 0, 2, 3].map(|vertex| now[vertex]));
    assert!(now[0].z < 0.0);
}

#[test]
fn a_second_side_with_other_diagonals_is_named_and_the_cloth_runs_without_it() {
    let folder = folder();
    let vertices = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n";
    let front = "f 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n";
    let back = "f 1 4 2\nf 2 4 5\nf 2 5 3\nf 3 5 6\n";
    let own_back = "f 7 10 8\nf 8 10 11\nf 8 11 9\nf 9 11 12\n";
    let made = |mesh: String, keys: &str| {
        fs::write(folder.path().join("sides.obj"), mesh).unwrap();
        let cloth = format!("shape = \"file\"\nfile = \"sides.obj\"\n{keys}");
        let scene = scene(&folder, &cloth, "[effects.self_collision]\nthickness = 0.003").unwrap();
        Simulation::new(scene, 1).map_err(|error| error.to_string())
    };
    let advice =
        "; the faces 4 to 7 lie on earlier ones, as those of a second side do: leave them out of the mesh; `tangled_start";
    for (mesh, keys) in [
        (format!("{vertices}{front}{back}"), ""),
        (format!("{vertices}{vertices}{front}{own_back}"), ""),
        (format!("{vertices}{vertices}{front}{own_back}"), "weld = 0"),
    ] {
        let message = made(mesh, keys).err().unwrap();
        assert!(message.contains(advice), "{message}");
    }
    made(format!("{vertices}{front}"), "").unwrap().step().unwrap();
}
