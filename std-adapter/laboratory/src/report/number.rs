//! Formats numbers, shares and times for readers. A [dash](ABSENT) stands for a value that is missing or not finite.

/// The sign for a missing value.
pub(super) const ABSENT: &str = "–";

/// Writes a whole number with a comma between thousands: `1,345`.
pub(super) fn grouped(number: impl ToString + Copy) -> String {
    let digits = number.to_string();
    let mut grouped = String::with_capacity(digits.len() * 4 / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// Writes a count: `1 step`, `1,500 steps`.
pub(super) fn counted(count: impl ToString + Copy, what: &str) -> String {
    let count = grouped(count);
    let s = if count == "1" { "" } else { "s" };
    format!("{count} {what}{s}")
}

/// Writes an ordinal: `1st`, `22nd`, `1,500th`.
pub(super) fn ordinal(number: u64) -> String {
    let ending = match (number % 10, number % 100) {
        (1, tens) if tens != 11 => "st",
        (2, tens) if tens != 12 => "nd",
        (3, tens) if tens != 13 => "rd",
        _ => "th",
    };
    format!("{}{ending}", grouped(number))
}

/// Writes any number with three significant digits, or all digits before the point, and no zeros at the end: `0.00123`, `1,345`.
pub(super) fn three_figures(number: f64) -> String {
    finite(number, |number| {
        let size = number.abs();
        let text = match size {
            0.0 => "0".to_owned(),
            size if size >= 99.95 => whole(size),
            size if size < 1e-4 => format!("{size:.2e}"),
            size => {
                let decimals = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
                let text = format!("{size:.decimals$}");
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            }
        };
        if number < 0.0 { format!("−{text}") } else { text }
    })
}

/// Writes the magnitude of a number, with one digit: `3e-9`.
pub(super) fn magnitude(number: f64) -> String {
    match number {
        0.0 => "0".to_owned(),
        number => format!("{number:.0e}"),
    }
}

/// Writes a part of a whole as a percentage: `85.2 %`.
pub(super) fn percent(part: usize, whole: usize, decimals: usize) -> String {
    finite(100.0 * part as f64 / whole as f64, |share| {
        format!("{share:.decimals$}\u{a0}%")
    })
}

/// Writes a share as a percentage with three significant digits.
pub(super) fn share(share: f64) -> String {
    finite(share, |share| format!("{}\u{a0}%", three_figures(100.0 * share)))
}

/// Writes a time in a suitable unit, with three digits: `12.3 ms`.
pub(super) fn time(seconds: f64) -> String {
    finite(seconds, |seconds| {
        let (number, unit) = in_unit(seconds);
        let digits = match number {
            n if n >= 99.95 => 0,
            n if n >= 9.995 => 1,
            _ => 2,
        };
        format!("{number:.digits$} {unit}")
    })
}

/// Writes a time in a simulation: `0.225 s`.
pub(super) fn moment(seconds: f64) -> String {
    finite(seconds, |seconds| format!("{} s", three_figures(seconds)))
}

/// Writes a time with its sign: `+12.3 ms`.
pub(super) fn signed_time(seconds: f64) -> String {
    let sign = if seconds < 0.0 { "−" } else { "+" };
    format!("{sign}{}", time(seconds.abs()))
}

/// Writes a round time, on an axis: `1 µs`, `10 ms`.
pub(super) fn round_time(seconds: f64) -> String {
    match in_unit(seconds) {
        (number, unit) if (1e-3..1e6).contains(&number) => format!("{} {unit}", three_figures(number)),
        _ => format!("{} s", magnitude(seconds)),
    }
}

fn in_unit(seconds: f64) -> (f64, &'static str) {
    match seconds {
        s if s >= 0.9995 => (s, "s"),
        s if s >= 0.000_999_5 => (s * 1e3, "ms"),
        s if s >= 0.000_000_999_5 => (s * 1e6, "µs"),
        s => (s * 1e9, "ns"),
    }
}

fn whole(number: f64) -> String {
    grouped(number.round() as u64)
}

/// Formats a finite number, or returns a dash.
pub(super) fn finite(number: f64, text: impl FnOnce(f64) -> String) -> String {
    if number.is_finite() { text(number) } else { ABSENT.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(
            [0, 999, 1000, 12_345, 5_197_332].map(grouped),
            ["0", "999", "1,000", "12,345", "5,197,332"]
        );
        assert_eq!([0, 1, 1500].map(|n| counted(n, "step")), ["0 steps", "1 step", "1,500 steps"]);
    }

    #[test]
    fn ordinals_have_their_endings() {
        assert_eq!(
            [1, 2, 3, 4, 11, 12, 13, 21, 102, 1113].map(ordinal),
            ["1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "102nd", "1,113th"]
        );
    }

    #[test]
    fn a_share_of_nothing_is_a_dash() {
        assert_eq!(percent(2, 3, 1), "66.7\u{a0}%");
        assert_eq!(percent(0, 0, 1), "–");
        assert_eq!([0.0123, f64::NAN].map(share), ["1.23\u{a0}%", "–"]);
    }

    #[test]
    fn numbers_and_times_have_three_figures() {
        assert_eq!(
            [0.0, 1.5, 34.22, 99.96, 1122.4, -0.001_234, 1.2e-7, -1234.5, f64::INFINITY].map(three_figures),
            ["0", "1.5", "34.2", "100", "1,122", "−0.00123", "1.20e-7", "−1,235", "–"]
        );
        assert_eq!(
            [2e-9, 4.56e-5, 0.0123, 0.9999, 120.0, f64::NAN].map(time),
            ["2.00 ns", "45.6 µs", "12.3 ms", "1.00 s", "120 s", "–"]
        );
        assert_eq!([-4.56e-5, 0.0].map(signed_time), ["−45.6 µs", "+0.00 ns"]);
    }

    #[test]
    fn powers_of_ten_have_units() {
        assert_eq!(
            [-2, -1, 0, 2, 3, 5, 6, 9, 10, 300].map(|power| round_time(10.0_f64.powi(power) * 1e-9)),
            [
                "0.01 ns", "0.1 ns", "1 ns", "100 ns", "1 µs", "100 µs", "1 ms", "1 s", "10 s", "1e291 s"
            ]
        );
    }
}
