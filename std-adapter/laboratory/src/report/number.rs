//! Numbers as people read them.

/// A whole number with a comma between thousands: `1,345`.
pub(super) fn grouped(number: u64) -> String {
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

/// A mean count: whole from 100 up, with one decimal below unless it is whole anyway; a dash if it is not finite.
pub(super) fn mean(number: f64) -> String {
    if !number.is_finite() {
        "–".to_owned()
    } else if number >= 99.95 || number.fract() == 0.0 {
        grouped(number.round() as u64)
    } else {
        format!("{number:.1}")
    }
}

/// A rate with three figures or so: `34.2`, `1,345`; a dash if it is not finite.
pub(super) fn rate(number: f64) -> String {
    if !number.is_finite() {
        "–".to_owned()
    } else if number >= 99.95 {
        grouped(number.round() as u64)
    } else if number >= 9.995 {
        format!("{number:.1}")
    } else {
        format!("{number:.2}")
    }
}

/// A share as a percentage: `85.2 %`; a dash if it is not a number.
pub(super) fn percent(part: usize, whole: usize, decimals: usize) -> String {
    if whole == 0 {
        return "–".to_owned();
    }
    let share = 100.0 * part as f64 / whole as f64;
    format!("{share:.decimals$}\u{a0}%")
}

/// A time in the unit that fits it, with three figures: `12.3 ms`.
pub(super) fn time(seconds: f64) -> String {
    let (number, unit) = match seconds {
        s if s >= 0.9995 => (s, "s"),
        s if s >= 0.000_999_5 => (s * 1e3, "ms"),
        s if s >= 0.000_000_999_5 => (s * 1e6, "µs"),
        s => (s * 1e9, "ns"),
    };
    let digits = match number {
        n if n >= 99.95 => 0,
        n if n >= 9.995 => 1,
        _ => 2,
    };
    format!("{number:.digits$} {unit}")
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
    }

    #[test]
    fn means_keep_a_decimal_where_it_says_something() {
        assert_eq!(
            [0.0, 31.0, 31.25, 99.96, 1122.4, f64::NAN].map(mean),
            ["0", "31", "31.2", "100", "1,122", "–"]
        );
    }

    #[test]
    fn a_share_of_nothing_is_a_dash() {
        assert_eq!(percent(2, 3, 1), "66.7\u{a0}%");
        assert_eq!(percent(0, 0, 1), "–");
    }

    #[test]
    fn rates_and_times_have_three_figures() {
        assert_eq!(
            [3.456, 34.22, 345.6, 12_345.0, f64::INFINITY].map(rate),
            ["3.46", "34.2", "346", "12,345", "–"]
        );
        assert_eq!(
            [2e-9, 4.56e-5, 0.0123, 0.9999, 120.0].map(time),
            ["2.00 ns", "45.6 µs", "12.3 ms", "1.00 s", "120 s"]
        );
    }
}
