//! Stresses through a wall.

/// The principal normal stresses of a particle with its coordinates.
///
/// # Example
/// See [`Balloon`](crate::balloon::Balloon).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressAt {
    /// X or R in the reference, m.
    pub reference: f64,
    /// r, m.
    pub radius: f64,
    /// `T_rr`, `T_θθ`, `T_zz` (of a sphere `T_φφ`) and `T_θz`, Pa.
    pub stress: [f64; 4],
}

impl StressAt {
    /// Of components in the order rr, θθ, zz, rθ, θz, rz.
    pub(crate) const fn of(reference: f64, radius: f64, [rr, tt, zz, _, tz, _]: [f64; 6]) -> Self {
        Self { reference, radius, stress: [rr, tt, zz, tz] }
    }
}

/// Places from the inner to the outer face, both among them.
pub(crate) fn through([inner, outer]: [f64; 2], parts: u32) -> impl Iterator<Item = f64> {
    (0..=parts).map(move |i| match i {
        0 => inner,
        _ if i == parts => outer,
        _ => inner + (outer - inner) * f64::from(i) / f64::from(parts),
    })
}
