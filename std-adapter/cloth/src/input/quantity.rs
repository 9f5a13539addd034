//! Physical quantities in a scene: a number in SI units, or text with a unit (`"3 mm"`).

use super::error::suggestion;

/// A kind of quantity and its units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantity {
    /// The name with its article: `a length`.
    what: &'static str,
    /// Names of units, the SI unit first, each with its size in SI units.
    units: &'static [(&'static str, f64)],
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

macro_rules! quantities {
    ($($name:ident = $what:literal [$($unit:literal $size:expr),+];)+) => {
        $(pub(crate) const $name: Quantity = Quantity { what: $what, units: &[$(($unit, $size)),+] };)+
    };
}

quantities! {
    RATIO = "a plain number" ["" 1.0];
    LENGTH = "a length" ["m" 1.0, "mm" 1e-3, "cm" 1e-2, "um" 1e-6];
    TIME = "a time" ["s" 1.0, "ms" 1e-3, "us" 1e-6];
    CURVATURE = "a curvature" ["1/m" 1.0, "1/cm" 1e2, "1/mm" 1e3];
    ANGLE = "an angle" ["rad" 1.0, "deg" DEGREE];
    ANGULAR_SPEED = "an angular speed" ["rad/s" 1.0, "deg/s" DEGREE, "rpm" 6.0 * DEGREE];
    SPEED = "a speed" ["m/s" 1.0, "cm/s" 1e-2, "km/h" 1.0 / 3.6];
    ACCELERATION = "an acceleration" ["m/s2" 1.0];
    FREQUENCY = "a frequency" ["Hz" 1.0, "1/s" 1.0];
    MASS = "a mass" ["kg" 1.0, "g" 1e-3];
    AREA_DENSITY = "a mass per area" ["kg/m2" 1.0, "g/m2" 1e-3];
    LINEAR_DENSITY = "a mass per length" ["kg/m" 1.0, "g/m" 1e-3];
    AIR_DENSITY = "a density" ["kg/m3" 1.0];
    MEMBRANE_STIFFNESS = "a stiffness of a membrane" ["N/m" 1.0, "kN/m" 1e3];
    BENDING_STIFFNESS = "a bending stiffness" ["N m" 1.0, "mN m" 1e-3, "uN m" 1e-6];
    ROPE_BENDING_STIFFNESS = "a bending stiffness of a rope" ["N m2" 1.0, "mN m2" 1e-3, "uN m2" 1e-6];
    FORCE = "a force" ["N" 1.0, "mN" 1e-3, "kN" 1e3];
    PRESSURE = "a pressure" ["Pa" 1.0, "kPa" 1e3];
}

/// The largest coordinate in a scene, in metres.
pub(crate) const LARGEST_COORDINATE: f64 = 1e3;
/// The longest time in a scene, in seconds.
pub(crate) const LARGEST_TIME: f64 = 1e5;

impl Quantity {
    /// Reads text such as `3 mm` and returns the value in SI units, or an error message.
    pub(crate) fn parse(&self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let is_number = |text: &str| text.parse::<f64>().is_ok();
        // The number is the longest prefix that parses, so that `1e3 m` and `1.5m` both work.
        let end = (1..=text.len())
            .rev()
            .find(|&end| text.is_char_boundary(end) && is_number(text[..end].trim_end()));
        let Some(end) = end else {
            return Err(format!("must be {}, such as {}, not '{text}'", self.what, self.example()));
        };
        let (number, unit) = (text[..end].trim_end(), text[end..].trim());
        let value: f64 = number.parse().unwrap_or(f64::NAN);
        if unit.is_empty() {
            return Ok(value);
        }
        match self.units.iter().find(|(name, _)| *name == unit) {
            Some((_, size)) => Ok(value * size),
            None if self.units[0].0.is_empty() => Err(format!("is a plain number without the unit '{unit}'")),
            None => {
                let names = self.units.iter().map(|(name, _)| *name);
                Err(format!(
                    "must be {}, but '{unit}' is not a unit of it{}",
                    self.what,
                    suggestion(unit, names)
                ))
            }
        }
    }

    /// Writes a value with its SI unit.
    pub(crate) fn written(&self, value: f64) -> String {
        // The shortest form, with an exponent where zeros would hide the size.
        let number = if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
            format!("{value:e}")
        } else {
            format!("{value}")
        };
        match self.units[0].0 {
            "" => number,
            unit => format!("{number} {unit}"),
        }
    }

    /// Writes a value to six digits in the unit that makes it shortest.
    pub(crate) fn written_short(&self, value: f64) -> String {
        let in_unit = |&(unit, size): &(&str, f64)| {
            let digits = format!("{:.5e}", value / size);
            let number = digits.parse().unwrap_or(value / size);
            match unit {
                "" => format!("{number}"),
                unit => format!("{number} {unit}"),
            }
        };
        let written = self.units.iter().map(in_unit);
        written.min_by_key(String::len).unwrap_or_default()
    }

    pub(crate) fn example(&self) -> String {
        match self.units {
            [("", _), ..] => "0.5".to_owned(),
            [(unit, _)] => format!("0.5 (in {unit}) or \"0.5 {unit}\""),
            [(unit, _), (other, _), ..] => format!("0.5 (in {unit}) or \"5 {other}\""),
            [] => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_in_the_unit_that_fits() {
        let lengths = [3e-3, 0.1 * 3e-3, 0.5, 1e-6].map(|value| LENGTH.written_short(value));
        assert_eq!(lengths, ["3 mm", "0.3 mm", "0.5 m", "1 um"]);
        let times = [1e-3, 2.5e-5].map(|value| TIME.written_short(value));
        assert_eq!(times, ["1 ms", "25 us"]);
        assert_eq!(RATIO.written_short(1.0 / 3.0), "0.333333");
    }

    #[test]
    fn text_is_a_number_and_perhaps_a_unit() {
        assert_eq!(LENGTH.parse("3 mm"), Ok(3e-3));
        assert_eq!(LENGTH.parse("2.5cm"), Ok(0.025));
        assert_eq!(LENGTH.parse(" -1e1 "), Ok(-10.0));
        assert_eq!(ANGLE.parse("180 deg"), Ok(std::f64::consts::PI));
        assert!(LENGTH.parse("3 kg").unwrap_err().contains("not a unit of it"));
        assert!(LENGTH.parse("3 Mm").unwrap_err().contains("did you mean"));
        assert!(RATIO.parse("1 m").unwrap_err().contains("plain number"));
        assert!(TIME.parse("soon").unwrap_err().contains("a time"));
    }
}
