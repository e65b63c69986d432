//! Each energy of the change of volume: its derivatives, its modulus, its digits near J = 1.

use piola_numerics::{Dual, Real};
use piola_solids::SolidsError;
use piola_solids::volumetric::{
    HartmannNeff, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor, Volumetric,
};
use piola_testkit::{DoubleDouble, Tol, assert_close_at_scale};

fn of<T: Real>(law: &impl Volumetric, change: T) -> [T; 3] {
    let jacobian = T::one() + change;
    [law.energy(change, jacobian), law.mean_kirchhoff(change, jacobian), law.curvature(change, jacobian)]
}

fn examine(name: &str, law: &impl Volumetric) {
    assert!((law.bulk_modulus() / 7.0 - 1.0).abs() <= 4.0 * f64::EPSILON, "{name}: U″(1) = κ");
    for change in [-0.999, -0.9, -0.5, -0.1, 1e-3, 0.3, 1.0, 4.0] {
        let [energy, mean, curvature] = of(law, Dual::variable(Dual::variable(change)));
        let jacobian = 1.0 + change;
        // Of the largest term: where U is not convex U″ passes through zero.
        let scale = jacobian.max(1.0) * curvature.value.value.abs().max(7.0);
        let close = |what: &str, a: f64, b: f64| {
            assert_close_at_scale(&format!("{name} at {change}: {what}"), &[a], &[b], scale, Tol::ulps(64.0));
        };
        close("J U′", mean.value.value, jacobian * energy.tangent.value);
        close("U″", curvature.value.value, energy.tangent.tangent);
        close("(J U′)′", mean.tangent.value, energy.tangent.value + jacobian * energy.tangent.tangent);
        assert!(0.0 < energy.value.value, "{name}");
    }
    for k in 12..64 {
        for sign in [1.0, -1.0] {
            let change = sign * 10.0_f64.powf(-0.25 * f64::from(k));
            let (rounded, exact) = (of(law, change), of(law, DoubleDouble::lit(change)));
            for (x, y) in exact.into_iter().zip(rounded).take(2) {
                assert!(x.rounding_of(y).abs() <= 1e-14 * y.abs(), "{name} at {change:e}");
            }
        }
    }
}

#[test]
fn volumetric_stress_and_modulus_equal_derivatives_of_the_energy() -> Result<(), SolidsError> {
    examine("quadratic", &Quadratic::new(7.0)?);
    examine("logarithmic", &Logarithmic::new(7.0)?);
    examine("quadratic and logarithmic", &QuadraticLogarithmic::new(7.0)?);
    examine("Simo–Taylor", &SimoTaylor::new(7.0)?);
    examine("Liu", &Liu::new(7.0)?);
    examine("Miehe", &Miehe::new(7.0)?);
    examine("Ogden, 9", &OgdenVolumetric::new(7.0, 9.0)?);
    examine("Ogden, −2", &OgdenVolumetric::new(7.0, -2.0)?);
    examine("Hartmann–Neff", &HartmannNeff::new(7.0)?);
    Ok(())
}
