//! What the time stepping gives for motions of one degree of freedom, from the lengths of its steps. Steps are implicit Euler:
//! forces act on the velocity first, and the new velocity moves the position.

/// Returns the way in m of a fall from rest with an acceleration in m/s². Steps of h give ½·a·t·(t + h).
pub(super) fn fallen(steps: &[f64], acceleration: f64) -> f64 {
    slowed([0.0, acceleration, 0.0], steps)[0]
}

/// Returns way and velocity of a fall that begins with a velocity in m/s, with an acceleration in m/s² and a rate of drag in 1/s.
/// A step takes the acceleration first, and then exact drag.
pub(super) fn slowed([velocity, acceleration, rate]: [f64; 3], steps: &[f64]) -> [f64; 2] {
    steps.iter().fold([0.0, velocity], |[way, velocity], h| {
        let velocity = (velocity + acceleration * h) * (-rate * h).exp();
        [way + velocity * h, velocity]
    })
}

/// Returns amplitude and phase of an oscillation at a frequency in rad/s, over the amplitude at the start. A step turns the phase
/// by atan(ω·h) instead of ω·h, and divides the amplitude by √(1 + ω²h²).
pub(super) fn swung(steps: &[f64], frequency: f64) -> [f64; 2] {
    steps.iter().fold([1.0, 0.0], |[amplitude, phase], h| {
        let turn = frequency * h;
        [amplitude / turn.hypot(1.0), phase + turn.atan()]
    })
}
