//! A sheet that is folded until its halves pass through each other.

const SIDE: u32 = 15;

pub(crate) fn triangles() -> Vec<[u32; 3]> {
    let squares = (0..SIDE - 1).flat_map(|row| (0..SIDE - 1).map(move |column| row * SIDE + column));
    squares
        .flat_map(|a| [[a, a + 1, a + SIDE], [a + 1, a + SIDE + 1, a + SIDE]])
        .collect()
}

/// Returns a frame. Between the second and the third the halves stand upright, against each other.
pub(crate) fn frame(number: u32) -> Vec<[f64; 3]> {
    let angle = 1.41 + 0.08 * f64::from(number);
    let place = |index: u32| f64::from(2 * index) / f64::from(SIDE - 1) - 1.0;
    let vertices = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (place(row), place(column))));
    vertices
        .map(|(along, across)| {
            let ripple = 0.03 * (7.0 * along + 3.0 * across + f64::from(number)).sin();
            [across * angle.cos() + ripple, along, across.abs() * angle.sin()]
        })
        .collect()
}
