//! Stresses through a wall, and their table.

use core::fmt::Write as _;

/// The principal normal stresses of a particle with its coordinates.
///
/// # Example
/// See [`Balloon`](super::Balloon).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressAt {
    /// X or R in the reference, m.
    pub reference: f64,
    /// r, m.
    pub radius: f64,
    /// `T_rr`, `T_θθ`, `T_zz` (of a sphere `T_φφ`) and `T_θz`, Pa.
    pub stress: [f64; 4],
}

/// Names of the components of [`StressAt`].
pub(super) const COMPONENTS: [&str; 4] = ["T_rr", "T_θθ", "T_zz", "T_θz"];

impl StressAt {
    /// Of components in the order rr, θθ, zz, rθ, θz, rz.
    pub(super) const fn of(reference: f64, radius: f64, [rr, tt, zz, _, tz, _]: [f64; 6]) -> Self {
        Self { reference, radius, stress: [rr, tt, zz, tz] }
    }
}

/// A table of stresses: a state, its particles.
pub(super) fn stress_table<'s>(states: impl Iterator<Item = (String, &'s [StressAt])>) -> String {
    let mut text = String::from("state,reference_m,radius_m,T_rr_Pa,T_tt_Pa,T_zz_Pa,T_tz_Pa\n");
    for (state, particles) in states {
        for StressAt { reference, radius, stress: [rr, tt, zz, tz] } in particles {
            let _ = writeln!(text, "{state},{reference:?},{radius:?},{rr:?},{tt:?},{zz:?},{tz:?}");
        }
    }
    text
}

/// Places from the inner to the outer face, both among them.
pub(super) fn through([inner, outer]: [f64; 2], parts: u32) -> impl Iterator<Item = f64> {
    (0..=parts).map(move |i| match i {
        0 => inner,
        _ if i == parts => outer,
        _ => inner + (outer - inner) * f64::from(i) / f64::from(parts),
    })
}
