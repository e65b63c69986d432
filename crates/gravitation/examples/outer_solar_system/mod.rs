//! The outer Solar System of Hairer, Lubich & Wanner, *Geometric Numerical Integration*, I.2.4, about its centre of mass.

use std::array::from_fn;

use piola_gravitation::{Gravitation, GravitationError};

/// G in AU³/(Sun's mass · day²).
const G: f64 = 2.959_122_082_86e-4;
/// Sun with inner planets, Jupiter, Saturn, Uranus, Neptune, Pluto.
const MASSES: [f64; 6] = [
    1.000_005_976_82,
    0.000_954_786_104_043,
    0.000_285_583_733_151,
    0.000_043_727_316_454_6,
    0.000_051_775_913_844_9,
    1.0 / 130_000_000.0,
];
const POSITIONS: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [-3.502_365_3, -3.816_984_7, -1.550_796_3],
    [9.075_531_4, -3.045_835_3, -1.648_370_8],
    [8.310_142_0, -16.290_108_6, -7.252_127_8],
    [11.470_766_6, -25.729_482_9, -10.816_945_6],
    [-15.538_735_7, -25.222_559_4, -3.190_238_2],
];
const VELOCITIES: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.005_654_29, -0.004_124_90, -0.001_905_89],
    [0.001_683_18, 0.004_835_25, 0.001_924_62],
    [0.003_541_78, 0.001_371_02, 0.000_550_29],
    [0.002_889_30, 0.001_145_27, 0.000_396_77],
    [0.002_767_25, -0.001_707_02, -0.001_365_04],
];

/// The bodies and their state, at rest about the centre of mass: far from the origin positions would be rounded more coarsely.
pub(crate) fn outer_solar_system() -> Result<(Gravitation, Vec<f64>), GravitationError> {
    let centred = |values: &[[f64; 3]; 6]| {
        let total: f64 = MASSES.iter().sum();
        let mean: [f64; 3] = from_fn(|k| MASSES.iter().zip(values).map(|(mass, x)| mass * x[k]).sum::<f64>() / total);
        values.map(|x| from_fn(|k| x[k] - mean[k]))
    };
    let bodies = Gravitation::new(MASSES.map(|mass| G * mass).to_vec())?;
    let start = bodies.state(&centred(&POSITIONS), &centred(&VELOCITIES))?;
    Ok((bodies, start))
}
