//! Materials by name: published properties, and their use in scenes.

use crate::common::*;

/// Rigidities in µN m and densities in g/m² agree with cantilever measurements of fabrics of that weight (Feng et al. 2022), and
/// for wool with Kawabata's means within twice their standard deviations.
#[test]
fn bending_lengths_are_among_those_that_were_published() {
    let length = |rigidity: f64, weight: f64| (rigidity * 1e-6 / (weight * 1e-3 * 9.81)).cbrt();
    for (material, rigidities, weights) in [
        (Material::COTTON, [2.5, 58.1], [140.0, 160.0]),
        (Material::DENIM, [8.7, 189.0], [300.0, 350.0]),
        (Material::SILK, [1.1, 33.5], [55.0, 80.0]),
        (Material::WOOL, [7.4, 23.8], [201.0, 346.0]),
    ] {
        let published = length(rigidities[0], weights[1])..=length(rigidities[1], weights[0]);
        for found in material.bending_lengths() {
            assert!(published.contains(&found), "{}: {found}, not {published:?}", material.name);
        }
        assert!(
            (weights[0]..=weights[1]).contains(&(material.density * 1e3)),
            "{}",
            material.name
        );
    }
}

/// The sheet has 0.4 mm, 1.2 MPa and 930 kg/m³.
#[test]
fn latex_is_an_isotropic_sheet_that_keeps_its_volume() {
    let latex = Material::LATEX;
    let (thickness, modulus) = (0.4e-3_f64, 1.2e6);
    let expected = [
        930.0 * thickness,
        modulus * thickness,
        modulus * thickness / 3.0,
        modulus * thickness.powi(3) / 9.0,
    ];
    let found = [latex.density, latex.stretch[0], latex.shear, latex.bend[0]];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 0.005, "{found}, not {expected}");
    }
    assert_eq!((latex.stretch[0], latex.bend[0]), (latex.stretch[1], latex.bend[1]));
}

/// A strip that is held at its upper end, three times as long as wide, stretches as its stiffness says.
#[test]
fn denim_gives_under_its_weight_as_warp_weft_and_bias_say() {
    let sag = |warp: DVec3| {
        let strip = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::NEG_Z * 0.6], [8, 24], 1.0).unwrap();
        let top = strip.part("bottom").unwrap().to_vec();
        let mut strip = Cloth::from_mesh(strip.mesh().clone(), warp, 1.0).unwrap();
        strip.set_material(Material::DENIM);
        let mut scene = Scene::new(strip, 2e-4);
        scene.add(Gravity::default()).add(AirDrag { rate: 10.0 });
        scene.add(resting(top));
        let simulation = run(scene, 5000);
        -0.6 - simulation.positions().iter().map(|p| p.z).fold(0.0, f64::min)
    };
    let [warp, weft, bias] = [DVec3::Z, DVec3::X, DVec3::X + DVec3::Z].map(sag);
    // Half its weight acts on all of it: ½ρgl²/k. The strip is too narrow for its sides to matter.
    let expected = |stiffness: f64| 0.5 * 0.324 * 9.81 * 0.36 / stiffness;
    // A pull along the bias acts half along the warp, half along the weft, and half as shear.
    let of_bias = 4.0 / (1.0 / 1014.0 + 1.0 / 205.0 + 1.0 / 53.0);
    for (found, stiffness) in [(warp, 1014.0), (weft, 205.0), (bias, of_bias)] {
        let expected = expected(stiffness);
        assert!((found / expected - 1.0).abs() < 0.15, "{found}, not {expected}");
    }
}

const SHEET: &str = include_str!("scenes/materials.toml");

fn parsed(more: &str) -> Result<Scene, SceneError> {
    Scene::parse(&format!("{SHEET}{more}"), Path::new("s.toml"))
}

fn ends(scene: Scene) -> Vec<DVec3> {
    run(scene, 100).positions().to_vec()
}

fn from_code() -> Scene {
    let mut sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.3, DVec3::Y * 0.3], [6, 6], 1.0).unwrap();
    sheet.set_material(Material::DENIM);
    Scene::new(sheet, 1e-3)
}

const HELD: &str = "[effects.gravity]\n[[effects.pins.group]]\npart = \"left\"\n";

fn held(mut scene: Scene) -> Scene {
    let left = scene.cloths[0].part("left").unwrap().to_vec();
    scene.add(Gravity::default()).add(resting(left));
    scene
}

#[test]
fn a_material_in_a_file_and_in_code_is_the_same_to_the_last_bit() {
    let scene = parsed(HELD).unwrap();
    assert_eq!(scene.effect_names(), ["gravity", "pins", "stretch", "shear", "bend"]);
    assert!(scene.fabric().contains(&("material".to_owned(), "denim".to_owned())));
    assert!(scene.fabric().contains(&("weight".to_owned(), "324 g/m2".to_owned())));
    assert_eq!(ends(scene), ends(held(from_code())));
}

#[test]
fn a_scene_may_say_otherwise_than_its_material_number_by_number() {
    let bend = Bend {
        weft_stiffness: 64e-6,
        ..Bend::isotropic(97e-6)
    };
    let mut scene = held(from_code());
    scene.cloths[0].density = 0.3;
    scene.add(Shear::new(10.0)).add_to("cloth", bend);
    scene.add(Stretch::isotropic(500.0));
    let said = "density = \"300 g/m2\"\n[effects.shear]\nstiffness = 10\n[effects.bend]\nweft_stiffness = \"64 uN m\"\n[effects.stretch]\nstiffness = 500\n";
    let of_file = parsed(&format!("{said}{HELD}")).unwrap();
    assert_eq!(of_file.fabric(), scene.fabric());
    assert_ne!(of_file.fabric(), parsed(HELD).unwrap().fabric());
    assert_eq!(ends(of_file), ends(scene));
}

/// A cloth's own table comes first, then the scene's effects, then the material.
#[test]
fn each_of_several_cloths_has_a_material_of_its_own() {
    let other = SHEET.split_once("[cloth]").unwrap().1;
    let other = other.replace("denim", "silk").replace("[0.3, 0, 0]", "[0.2, 0, 0]");
    let both = SHEET.replace("[cloth]", "[[cloth]]\nname = \"jacket\"\nshear = { stiffness = 10 }");
    let text = format!("{both}[[cloth]]\nname = \"lining\"\n{other}[effects.bend]\nweft_stiffness = \"4 uN m\"\n");
    let scene = Scene::parse(&text, Path::new("s.toml")).unwrap();
    let fabric = scene.fabric();
    for (what, expected) in [
        ("material of 'jacket'", "denim"),
        ("material of 'lining'", "silk"),
        ("weight of 'lining'", "60 g/m2"),
        ("shear stiffness of 'jacket'", "10 N/m"),
        ("shear stiffness of 'lining'", "20 N/m"),
        ("bending stiffness of the warp of 'jacket'", "97 uN m"),
        ("bending stiffness of the weft of 'jacket'", "4 uN m"),
        ("bending stiffness of the warp of 'lining'", "2.5 uN m"),
        ("bending stiffness of the weft of 'lining'", "4 uN m"),
    ] {
        assert!(fabric.contains(&(what.to_owned(), expected.to_owned())), "{what}: {fabric:?}");
    }
}
