//! Places values on axes: of powers of ten, and even ones.

/// An axis on which equal differences are equally far apart.
pub(super) struct LinearAxis {
    ends: [f64; 2],
    length: f64,
}

impl LinearAxis {
    /// Makes an axis over all finite values.
    pub(super) fn over(values: impl Iterator<Item = f64>, length: f64) -> Self {
        let [low, high] = values
            .filter(|value| value.is_finite())
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            });
        let ends = match high - low {
            range if range > 1e-12 * high.abs() => [low, high],
            _ if low.is_finite() => [low - 0.5 * low.abs().max(1e-12), low + 0.5 * low.abs().max(1e-12)],
            _ => [0.0, 1.0],
        };
        Self { ends, length }
    }

    /// Returns the distance from the axis's beginning.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        (value - low) / (high - low) * self.length
    }

    /// Returns three to eight places with their values, which are multiples of 1, 2 or 5 times a power of ten.
    pub(super) fn ticks(&self) -> Vec<(f64, f64)> {
        let [low, high] = self.ends;
        let power = 10.0_f64.powf(((high - low) / 3.0).log10().floor());
        let fits = |stride: &f64| high - low >= 3.0 * stride;
        let stride = [5.0 * power, 2.0 * power].into_iter().find(fits).unwrap_or(power);
        let numbers = (low / stride).ceil() as i64..=(high / stride).floor() as i64;
        numbers
            .map(|number| number as f64 * stride)
            .map(|value| (self.place(value), value))
            .collect()
    }
}

/// An axis on which equal factors are equally far apart.
pub(super) struct LogAxis {
    /// The ends as logarithms to base ten.
    ends: [f64; 2],
    length: f64,
}

impl LogAxis {
    /// The largest number of powers of ten that are all drawn.
    const MOST_POWERS: f64 = 9.0;

    /// Makes an axis over all positive, finite values, with some room.
    pub(super) fn over(values: impl Iterator<Item = f64>, length: f64) -> Self {
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
            ends = [ends[0].min(value.log10()), ends[1].max(value.log10())];
        }
        let [low, high] = if ends[0] <= ends[1] { ends } else { [0.0, 2.0] };
        // With this at least one power of ten has a name.
        let ends = [(low - 0.12).min(low.round()), (high + 0.12).max(low.round() + 1.0)];
        Self { ends, length }
    }

    /// Returns the distance from the axis's beginning.
    pub(super) fn place(&self, value: f64) -> f64 {
        self.place_of_power(value.log10())
    }

    fn place_of_power(&self, power: f64) -> f64 {
        let [low, high] = self.ends;
        (power - low) / (high - low) * self.length
    }

    /// Returns places of 1, 2, …, 9 times each power of ten in range, with the names of the powers of ten.
    pub(super) fn ticks(&self, name: impl Fn(f64) -> String) -> Vec<(f64, Option<String>)> {
        let [low, high] = self.ends;
        let stride = ((high - low) / Self::MOST_POWERS).ceil() as i32;
        let powers = (low.floor() as i32..=high.floor() as i32).filter(|power| power.rem_euclid(stride) == 0);
        let digits = if stride == 1 { 1..=9 } else { 1..=1 };
        let ticks = powers.flat_map(|power| digits.clone().map(move |digit| (power, digit)));
        let in_range = ticks.filter_map(|(power, digit)| {
            let logarithm = f64::from(power) + f64::from(digit).log10();
            let name = || name(10.0_f64.powi(power));
            (low..=high)
                .contains(&logarithm)
                .then(|| (self.place_of_power(logarithm), (digit == 1).then(name)))
        });
        in_range.collect()
    }
}

/// An axis of shares, upwards: each line is ten times less than the last, and the top line is zero.
pub(super) struct TowardsNone {
    /// The exponent below which shares, except for zero, are drawn as if they were this large.
    pub(super) smallest: i32,
    /// The distance between two lines.
    pub(super) step: f64,
}

impl TowardsNone {
    pub(super) const fn height(&self) -> f64 {
        self.step * (1 - self.smallest) as f64
    }

    /// Returns the distance from the top.
    pub(super) fn place(&self, share: f64) -> f64 {
        if share > 0.0 {
            let smallest = f64::from(self.smallest);
            self.step * (share.log10().clamp(smallest, 0.0) - smallest + 1.0)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::number::round_time;

    fn names(axis: &LogAxis) -> Vec<String> {
        let ticks = axis.ticks(|nanoseconds| round_time(nanoseconds * 1e-9));
        ticks.into_iter().filter_map(|tick| tick.1).collect()
    }

    #[test]
    fn even_axes_have_round_ticks() {
        for (ends, expected) in [
            ([0.0, 1.0], [0.0, 0.2]),
            ([-3.1, 4.0], [-2.0, 0.0]),
            ([1e-9, 1.7e-8], [5e-9, 1e-8]),
        ] {
            let axis = LinearAxis::over(ends.into_iter(), 300.0);
            let ticks = axis.ticks();
            assert!((3..=8).contains(&ticks.len()), "{ticks:?}");
            assert!((0..2).all(|k| (ticks[k].1 - expected[k]).abs() < 1e-15), "{ticks:?}");
        }
        assert!(LinearAxis::over([2.0].into_iter(), 300.0).place(2.0) == 150.0);
        assert!(!LinearAxis::over(std::iter::empty(), 300.0).ticks().is_empty());
    }

    #[test]
    fn tenfold_values_are_equally_far_apart() {
        let axis = LogAxis::over([1.0, 100.0, f64::NAN].into_iter(), 300.0);
        let [a, b, c] = [1.0, 10.0, 100.0].map(|time| axis.place(time));
        assert!((b - a - (c - b)).abs() < 1e-9 && a > 0.0 && c < 300.0);
        assert_eq!(names(&axis), ["1 ns", "10 ns", "100 ns"]);
    }

    #[test]
    fn without_values_there_is_an_axis_all_the_same() {
        assert!(!names(&LogAxis::over(std::iter::empty(), 300.0)).is_empty());
        let one = LogAxis::over([3.0].into_iter(), 300.0);
        assert!((0.0..=300.0).contains(&one.place(3.0)));
        assert!(!names(&one).is_empty());
    }

    #[test]
    fn an_axis_of_all_numbers_has_few_ticks() {
        let axis = LogAxis::over([f64::MIN_POSITIVE, f64::MAX].into_iter(), 300.0);
        assert!((5..=10).contains(&axis.ticks(|_| String::new()).len()));
    }

    #[test]
    fn a_tenth_is_a_line_up_and_none_is_above_all() {
        let axis = TowardsNone {
            smallest: -6,
            step: 24.0,
        };
        assert_eq!((axis.place(0.0), axis.place(1.0)), (0.0, axis.height()));
        assert_eq!(axis.place(1e-9), 24.0);
        for power in -5..=0 {
            let [less, more] = [power - 1, power].map(|power| axis.place(10.0_f64.powi(power)));
            assert!((more - less - 24.0).abs() < 1e-9, "{power}");
        }
    }
}
