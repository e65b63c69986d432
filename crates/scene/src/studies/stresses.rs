//! The table of stresses through a wall.

use core::fmt::Write as _;

use piola_studies::StressAt;

/// Names of the components of [`StressAt`].
pub(super) const COMPONENTS: [&str; 4] = ["T_rr", "T_θθ", "T_zz", "T_θz"];

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
