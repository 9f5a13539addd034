//! Closed forms of rest: lengths of curves, and numbers that solve an equation.

/// Returns the root of a function between two numbers. The function is negative below its root and positive above.
pub(super) fn root([mut low, mut high]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if function(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
}

/// A catenary between two points at one height, at the distance `span`: y = a·cosh(x/a), with the length 2a·sinh(span/2a).
#[derive(Clone, Copy, Debug)]
pub(super) struct Catenary {
    a: f64,
    span: f64,
}

impl Catenary {
    /// Returns the catenary with a length that grows with the parameter a, as that of an elastic cloth does.
    pub(super) fn of_length(span: f64, length: impl Fn(f64) -> f64) -> Self {
        // A flatter catenary, with a larger parameter, is shorter.
        let too_short = |a: f64| length(a) - 2.0 * a * (0.5 * span / a).sinh();
        let a = root([0.02 * span, 1e4 * span], too_short);
        Self { a, span }
    }

    /// Returns the height at the distance `x` from the first point, relative to both.
    pub(super) fn height(self, x: f64) -> f64 {
        let of = |x: f64| self.a * ((x - 0.5 * self.span) / self.a).cosh();
        of(x) - of(0.0)
    }

    pub(super) fn sag(self) -> f64 {
        -self.height(0.5 * self.span)
    }
}

/// Returns the complete elliptic integral of the first kind K(k), by the arithmetic-geometric mean.
pub(super) fn elliptic_k(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..10 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}
