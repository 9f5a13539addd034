//! Bodies in screw motion in numbers of 256 bits, which stand for exact ones: the error is below 2⁻²⁴⁰ of the largest coordinate.

use crate::generator::Screw;
use rug::Float;
use selvedge_core::glam::DVec3;

const BITS: u32 = 256;

pub type FloatPoint = [Float; 3];

/// Converts a number exactly.
pub fn float(x: f64) -> Float {
    Float::with_val(BITS, x)
}

pub fn place(point: DVec3) -> FloatPoint {
    point.to_array().map(float)
}

pub fn plus(a: &FloatPoint, b: &FloatPoint) -> FloatPoint {
    [0, 1, 2].map(|k| Float::with_val(BITS, &a[k] + &b[k]))
}

pub fn minus(a: &FloatPoint, b: &FloatPoint) -> FloatPoint {
    [0, 1, 2].map(|k| Float::with_val(BITS, &a[k] - &b[k]))
}

pub fn times(a: &FloatPoint, factor: &Float) -> FloatPoint {
    a.each_ref().map(|x| Float::with_val(BITS, x * factor))
}

pub fn dot(a: &FloatPoint, b: &FloatPoint) -> Float {
    let mut sum = float(0.0);
    for k in 0..3 {
        sum += Float::with_val(BITS, &a[k] * &b[k]);
    }
    sum
}

fn cross(a: &FloatPoint, b: &FloatPoint) -> FloatPoint {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        Float::with_val(BITS, &a[i] * &b[j]) - Float::with_val(BITS, &a[j] * &b[i])
    })
}

pub fn distance(a: &FloatPoint, b: &FloatPoint) -> Float {
    let way = minus(a, b);
    dot(&way, &way).sqrt()
}

/// The pose of a body in screw motion at a time.
#[derive(Debug)]
pub struct Pose {
    /// The axis, of length one.
    axis: FloatPoint,
    sine: Float,
    cosine: Float,
    centre: FloatPoint,
    /// The place of the centre at that time.
    moved: FloatPoint,
    translation: FloatPoint,
    spin: FloatPoint,
}

impl Pose {
    pub fn at_time(screw: &Screw, time: f64) -> Self {
        let (angle, time) = (float(screw.angle), float(time));
        let axis = place(screw.axis);
        let axis = times(&axis, &dot(&axis, &axis).sqrt().recip());
        let (sine, cosine) = Float::with_val(BITS, &angle * &time).sin_cos(float(0.0));
        let [centre, translation] = [screw.centre, screw.translation].map(place);
        Self {
            sine,
            cosine,
            moved: plus(&centre, &times(&translation, &time)),
            spin: times(&axis, &angle),
            axis,
            centre,
            translation,
        }
    }

    /// Rotates a vector about the axis by the angle of this sine.
    fn turned(&self, way: &FloatPoint, sine: &Float) -> FloatPoint {
        let along = times(&self.axis, &dot(&self.axis, way));
        let across = minus(way, &along);
        let sideways = cross(&self.axis, way);
        plus(&along, &plus(&times(&across, &self.cosine), &times(&sideways, sine)))
    }

    fn turned_from(&self, start: DVec3) -> FloatPoint {
        self.turned(&minus(&place(start), &self.centre), &self.sine)
    }

    /// Returns the position of the point that started at `start`.
    pub fn at(&self, start: DVec3) -> FloatPoint {
        plus(&self.moved, &self.turned_from(start))
    }

    /// Returns the velocity of the point that started at `start`.
    pub fn velocity(&self, start: DVec3) -> FloatPoint {
        plus(&self.translation, &cross(&self.spin, &self.turned_from(start)))
    }

    /// Returns the start of a point that is `there`, rounded.
    pub fn start_of(&self, there: &FloatPoint) -> DVec3 {
        let back = self.turned(&minus(there, &self.moved), &-self.sine.clone());
        DVec3::from_array(plus(&self.centre, &back).map(|x| x.to_f64()))
    }
}
