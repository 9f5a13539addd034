//! Where a time and a share stand.

/// Shares closer to all than this are drawn as if they were this close.
const CLOSEST: f64 = 1e-6;

/// Time per pair, from left to right on a logarithmic scale.
pub(super) struct TimeAxis {
    /// Logarithms to the base of ten, of nanoseconds.
    ends: [f64; 2],
    width: f64,
}

impl TimeAxis {
    /// Covers all times that are positive and finite, with a little room.
    pub(super) fn over(times: impl Iterator<Item = f64>, width: f64) -> Self {
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        for time in times.filter(|time| *time > 0.0 && time.is_finite()) {
            ends = [ends[0].min(time.log10()), ends[1].max(time.log10())];
        }
        let [low, high] = if ends[0] <= ends[1] { ends } else { [0.0, 2.0] };
        // At least one power of ten has a name then.
        let ends = [(low - 0.12).min(low.round()), (high + 0.12).max(low.round() + 1.0)];
        Self { ends, width }
    }

    pub(super) fn place(&self, nanoseconds: f64) -> f64 {
        let [low, high] = self.ends;
        (nanoseconds.log10() - low) / (high - low) * self.width
    }

    /// Places of 1, 2, …, 9 times each power of ten in range, with the names of the powers of ten.
    pub(super) fn ticks(&self) -> Vec<(f64, Option<String>)> {
        let [low, high] = self.ends;
        let mut ticks = Vec::new();
        for power in low.floor() as i32..=high.floor() as i32 {
            for digit in 1..=9 {
                let nanoseconds = f64::from(digit) * 10.0_f64.powi(power);
                if (low..=high).contains(&nanoseconds.log10()) {
                    let name = (digit == 1).then(|| name(power));
                    ticks.push((self.place(nanoseconds), name));
                }
            }
        }
        ticks
    }
}

/// `10 ns`, `1 µs`: 10 to the power of `power`, in nanoseconds.
fn name(power: i32) -> String {
    let (power, unit) = match power {
        6.. => (power - 6, "ms"),
        3.. => (power - 3, "µs"),
        0.. => (power, "ns"),
        _ => return format!("0.{}1 ns", "0".repeat((-power - 1) as usize)),
    };
    format!("1{} {unit}", "0".repeat(power as usize))
}

/// A share of pairs that are culled, upwards; above all others a line for all of them.
pub(super) struct ShareAxis;

impl ShareAxis {
    /// Between two powers of ten.
    const STEP: f64 = 24.0;
    pub(super) const HEIGHT: f64 = 7.0 * Self::STEP;

    /// From the top down, for so many kept of a whole; nothing of an empty whole.
    pub(super) fn place(kept: usize, whole: usize) -> Option<f64> {
        let share = kept as f64 / whole as f64;
        match kept {
            _ if whole == 0 => None,
            0 => Some(0.0),
            _ => Some(Self::HEIGHT + Self::STEP * share.max(CLOSEST).log10()),
        }
    }

    /// Lines and their names, from the top down.
    pub(super) fn lines() -> [(f64, &'static str); 8] {
        let names = ["all", "99.9999 %", "99.999 %", "99.99 %", "99.9 %", "99 %", "90 %", "none"];
        let mut line = 0.0;
        names.map(|name| {
            line += 1.0;
            ((line - 1.0) * Self::STEP, name)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tenfold_times_are_equally_far_apart() {
        let axis = TimeAxis::over([1.0, 100.0, f64::NAN].into_iter(), 300.0);
        let [a, b, c] = [1.0, 10.0, 100.0].map(|time| axis.place(time));
        assert!((b - a - (c - b)).abs() < 1e-9 && a > 0.0 && c < 300.0);
        let names: Vec<_> = axis.ticks().into_iter().filter_map(|tick| tick.1).collect();
        assert_eq!(names, ["1 ns", "10 ns", "100 ns"]);
    }

    #[test]
    fn without_times_there_is_an_axis_all_the_same() {
        let axis = TimeAxis::over(std::iter::empty(), 300.0);
        assert!(axis.ticks().iter().any(|tick| tick.1.is_some()));
        let one = TimeAxis::over([3.0].into_iter(), 300.0);
        assert!((0.0..=300.0).contains(&one.place(3.0)));
        assert!(one.ticks().iter().any(|tick| tick.1.is_some()));
    }

    #[test]
    fn powers_of_ten_have_units() {
        assert_eq!(
            [-2, -1, 0, 2, 3, 5, 6].map(name),
            ["0.01 ns", "0.1 ns", "1 ns", "100 ns", "1 µs", "100 µs", "1 ms"]
        );
    }

    #[test]
    fn a_tenth_of_what_is_kept_is_a_line_up() {
        let lines = ShareAxis::lines().map(|line| line.0);
        let whole = 1_000_000;
        for (power, kept) in [1, 10, 100, 1000, 10_000, 100_000, 1_000_000].into_iter().enumerate() {
            let place = ShareAxis::place(kept, whole).unwrap();
            assert!((place - lines[1 + power]).abs() < 1e-9, "{kept}");
        }
        assert_eq!(ShareAxis::place(0, whole), Some(lines[0]));
        assert_eq!(ShareAxis::place(0, 0), None);
    }
}
