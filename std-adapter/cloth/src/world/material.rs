//! Fabrics by name, with measured density and resistance to stretch, shear and bending.
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
//! 1. Wang, O'Brien and Ramamoorthi 2011, data-driven elastic models for cloth. The fabrics are `11oz-black-denim` (99 % cotton)
//!    and `royal-target` (trousers, 65 % cotton), with their moduli at the smallest strain and curvature. The stiffer direction
//!    of denim is taken as the warp, since spandex is in the weft.
//! 2. Penava, Šimić Penava and Knezić 2014: a plain weave of cotton, 150.3 g/m² and 0.318 mm.
//! 3. The values are chosen from cantilever measurements of unnamed fabrics of that weight (Feng, Huang, Xu and Wang 2022).
//!    Fabrics of 140 to 160 g/m² have 2.5 to 58 µN m. Fabrics of 55 to 80 g/m² have 1.1 to 33 µN m, most of them below 7.
//! 4. Kawabata 1980 has means of 214 winter suitings: a bending rigidity of 10^−0.867 gf cm²/cm, a shear stiffness of 10^−0.066
//!    gf/(cm deg), 10^1.421 mg/cm². The cotton's shear stiffness is a choice: 1.16 gf/(cm deg) in these units.
//! 5. De Boos and Tester 1994 (SiroFAST, CSIRO report WT92.02): suitings without faults stretch by 2 to 6 % under 98 N/m, their
//!    100 gf/cm. Here they stretch by 3 and 4 %.
//! 6. The value is fitted to a drape coefficient: Memon, Chaklie, Yesuf and Zhu 2021 found 47 to 70 % for sheep leather of 0.64
//!    to 0.96 mm.
//! 7. Rubber of constant volume with a Young's modulus of 1.2 MPa and 930 kg/m³ (Treloar 1975): stretch E·h, shear E·h/3, bending
//!    E·h³/9. No published drape coefficient was found.
//! 8. A choice within the usual range, without a measurement.
//!
//! **Sources that were read**: 1 and 3, the weight in 2 and the range in 6. The following are quoted from memory: the means in 4
//! (Mahar and Postle's study of the same set has the number of 214 fabrics), the limits in 5, 1.2 MPa and 930 kg/m³ in 7, and
//! Cusick's regression in the tests. Treloar's measurements of 1944, as later fits quote them, are 0.286 MPa at a stretch of
//! 1.427 and 0.383 MPa at 1.616. Three times s/(λ − λ⁻²) gives 0.91 and 0.93 MPa, and rubber is stiffer at smaller stretch. Look
//! these up before something depends on them.
//!
//! Real fabrics also stiffen with stretch, and show hysteresis; these numbers do not.

/// A fabric. Measured fabrics have names; any other fabric has its own numbers.
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
    /// The name in scene files.
    pub name: &'static str,
    /// Mass per area in kg/m².
    pub density: f64,
    /// Stretch stiffness of warp and weft, in N/m.
    pub stretch: [f64; 2],
    /// Stiffness of the angle between warp and weft, in N/m. It gives the bias its stiffness.
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
    /// All named materials.
    pub const ALL: [Self; 6] = [Self::COTTON, Self::DENIM, Self::SILK, Self::WOOL, Self::LEATHER, Self::LATEX];

    /// Returns the bending lengths of warp and weft, in m: the cube root of the bending rigidity over the weight per area (Peirce
    /// 1930). It is half the overhang of a strip whose tip is 41.5° below its edge.
    #[must_use]
    pub fn bending_lengths(&self) -> [f64; 2] {
        self.bend.map(|rigidity| libm::cbrt(rigidity / (self.density * GRAVITY)))
    }
}

/// The acceleration for which bending lengths are defined, in m/s².
const GRAVITY: f64 = 9.81;
