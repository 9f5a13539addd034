//! Fabrics by name: what a square metre weighs, and how it resists being stretched, sheared and bent, from what was measured.
//!
//! | | density | stretch, warp and weft | shear | bend, warp and weft |
//! |---|---|---|---|---|
//! | cotton, a plain weave | 150 g/m² (2) | 2.02, 2.03 kN/m (1) | 65 N/m (4) | 25 µN m (3) |
//! | denim, 11 oz, 1 % spandex in the weft | 324 g/m² (1) | 1.01 kN/m, 205 N/m (1) | 53 N/m (1) | 97, 64 µN m (1) |
//! | silk, a crêpe de Chine of 14 momme | 60 g/m² (8) | 2 kN/m (8) | 20 N/m (8) | 2.5 µN m (3) |
//! | wool, a suiting for winter | 263 g/m² (4) | 3.3, 2.5 kN/m (5) | 48 N/m (4) | 13.3 µN m (4) |
//! | leather, sheep nappa of 0.8 mm | 480 g/m² (8) | 2 kN/m (8) | 770 N/m (8) | 44 µN m (6) |
//! | latex, a sheet of 0.4 mm | 372 g/m² (7) | 480 N/m (7) | 160 N/m (7) | 8.5 µN m (7) |
//!
//! 1. Wang, O'Brien and Ramamoorthi 2011, data-driven elastic models for cloth: the fabrics `11oz-black-denim` (99 % cotton) and
//!    `royal-target` (trousers, 65 % cotton), of which the moduli at the smallest strain and curvature are taken. Of denim's two
//!    directions the stiffer one is the warp: spandex is in the weft.
//! 2. Penava, Šimić Penava and Knezić 2014: a plain weave of cotton, 150.3 g/m² and 0.318 mm.
//! 3. A choice among what cantilevers found for fabrics of that weight, which have no names: Feng, Huang, Xu and Wang 2022. Of 140 to 160
//!    g/m² there are some from 2.5 to 58 µN m, of 55 to 80 g/m² from 1.1 to 33, most of them below 7.
//! 4. Kawabata 1980: means of 214 suitings for winter on his instruments: a bending rigidity of 10^−0.867 gf cm²/cm, a shear stiffness of
//!    10^−0.066 gf/(cm deg), 10^1.421 mg/cm². The cotton's shear stiffness is 1.16 gf/(cm deg) in his units, which is a choice.
//! 5. De Boos and Tester 1994 (SiroFAST, CSIRO report WT92.02): suitings that make no trouble give by 2 to 6 % under 98 N/m, which is their
//!    100 gf/cm: here by 3 and 4 %.
//! 6. Fitted to a drape coefficient: Memon, Chaklie, Yesuf and Zhu 2021 found 47 to 70 % for sheep leather of 0.64 to 0.96 mm.
//! 7. Rubber of a Young's modulus of 1.2 MPa and 930 kg/m³ (Treloar 1975) that keeps its volume: stretch E·h, shear E·h/3, and bending
//!    E·h³/9. No drape coefficient of it was found.
//! 8. A choice of ours in what is usual: no measurement was at hand.
//!
//! **What was read.** Of these 1 and 3, the weight of 2 and the range of 6. Not at hand, and quoted from memory: the means of 4 (that there are
//! 214 fabrics is in Mahar and Postle's study of the same set), the limits of 5, 1.2 MPa and 930 kg/m³ in 7, and Cusick's regression
//! in the tests. Treloar's measurements of 1944, as later fits have them, are 0.286 MPa at a stretch of 1.427 and 0.383 MPa at 1.616: three
//! times s/(λ − λ⁻²) is 0.91 and 0.93 MPa, and rubber that is stretched less is stiffer than that. Look these up before something depends on them.
//!
//! What real fabrics do beyond this: they get stiffer as they are stretched, and do not return on the way that they came.

/// A fabric: measured ones have names, and any other is one with its own numbers.
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Cloth, Material, Scene};
///
/// let denim = Material::DENIM;
/// let mut sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [10, 10], denim.density)?;
/// sheet.set_material(denim);
/// let scene = Scene::new(sheet, 1e-3);
/// assert_eq!(scene.effect_names(), ["stretch", "shear", "bend"]);
/// let [warp, weft] = denim.bending_lengths();
/// assert!(warp > weft && (0.03..0.035).contains(&warp));
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// As scene files call it.
    pub name: &'static str,
    /// Mass per area in kg/m².
    pub density: f64,
    /// Along warp and weft, in N/m.
    pub stretch: [f64; 2],
    /// Of the angle between warp and weft, in N/m: what gives the bias its stiffness.
    pub shear: f64,
    /// Flexural rigidities of warp and weft, in N·m.
    pub bend: [f64; 2],
}

impl Material {
    /// A plain weave of cotton.
    pub const COTTON: Self = Self {
        name: "cotton",
        density: 0.150,
        stretch: [2017.0, 2035.0],
        shear: 65.0,
        bend: [25e-6, 25e-6],
    };
    /// Denim of 11 ounces a square yard, with a little spandex in the weft.
    pub const DENIM: Self = Self {
        name: "denim",
        density: 0.324,
        stretch: [1014.0, 205.0],
        shear: 53.0,
        bend: [97e-6, 64e-6],
    };
    /// A crêpe de Chine of 14 momme.
    pub const SILK: Self = Self {
        name: "silk",
        density: 0.060,
        stretch: [2000.0, 2000.0],
        shear: 20.0,
        bend: [2.5e-6, 2.5e-6],
    };
    /// A woollen suiting for winter.
    pub const WOOL: Self = Self {
        name: "wool",
        density: 0.263,
        stretch: [3300.0, 2500.0],
        shear: 48.0,
        bend: [13.3e-6, 13.3e-6],
    };
    /// Sheep nappa of 0.8 mm, for garments.
    pub const LEATHER: Self = Self {
        name: "leather",
        density: 0.480,
        stretch: [2000.0, 2000.0],
        shear: 770.0,
        bend: [44e-6, 44e-6],
    };
    /// A sheet of natural rubber of 0.4 mm.
    pub const LATEX: Self = Self {
        name: "latex",
        density: 0.372,
        stretch: [480.0, 480.0],
        shear: 160.0,
        bend: [8.5e-6, 8.5e-6],
    };
    /// All that have a name.
    pub const ALL: [Self; 6] = [Self::COTTON, Self::DENIM, Self::SILK, Self::WOOL, Self::LEATHER, Self::LATEX];

    /// In m, of warp and weft: the cube root of the bending rigidity over the weight of an area (Peirce 1930), which is half of what a
    /// strip hangs over when its tip is 41.5° below its edge.
    #[must_use]
    pub fn bending_lengths(&self) -> [f64; 2] {
        self.bend.map(|rigidity| libm::cbrt(rigidity / (self.density * GRAVITY)))
    }
}

/// In m/s²: of the instruments that bending lengths are measured with.
const GRAVITY: f64 = 9.81;
