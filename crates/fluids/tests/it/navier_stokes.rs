//! The equation of Navier and Stokes, and the viscous stress as a field.

use nalgebra::Vector3;
use piola_fields::{Cartesian, Cylindrical, Field, Flow, Uniform};
use piola_fluids::{
    CarreauYasuda, GeneralisedNewtonian, LinearViscous, ViscometricFluid, ViscousStress, navier_stokes_residual,
};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

/// A flow of everything: of polynomials, that changes with time.
#[derive(Clone, Debug)]
struct Polynomial([f64; 9]);
impl Field for Polynomial {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        let c = |i: usize| T::lit(self.0[i]);
        Vector3::new(
            c(0) * x[1] * x[1] * x[0] + c(1) * (x[2] * t).sin(),
            c(2) * x[0] * x[2] + c(3) * x[1] * x[1] + c(4) * t * x[0],
            c(5) * x[0] * x[1] * x[2] + c(6) * x[2].exp() + c(7) * x[1],
        )
    }
}
struct Pressure(f64);
impl Field for Pressure {
    type Value = f64;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> T {
        T::lit(self.0) * (x[0] * x[1] + t * x[2] * x[2])
    }
}
struct Density;
impl Field for Density {
    type Value = f64;
    fn at<T: Real>(&self, x: &Vector3<T>, _: T) -> T {
        T::lit(2.0) + x[0] * x[0]
    }
}
/// f per mass from f per volume.
struct PerMass(Vector3<f64>);
impl Field for PerMass {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, x: &Vector3<T>, t: T) -> Vector3<T> {
        self.0.map(T::lit) / Density.at(x, t)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn navier_stokes_residual_equals_the_balance_of_momentum_of_the_viscous_stress(
        entries in strategies::vector(9, -2.0..2.0), place in strategies::vector(3, -1.0..1.0), time in -1.0..1.0_f64,
        force in strategies::vector(3, -2.0..2.0), second in -0.4..2.0_f64, pressure in -2.0..2.0_f64,
    ) {
        let velocity = Polynomial(core::array::from_fn(|i| entries[i]));
        let fluid = LinearViscous::new(second, 0.75).expect("bounds");
        let flow = Flow { coordinates: Cartesian, density: Density, velocity: velocity.clone() };
        let (place, force) = (Vector3::from_column_slice(&place), Vector3::from_column_slice(&force));
        let found = navier_stokes_residual(&fluid, &flow, &Pressure(pressure), &Uniform(force), &place, time);
        let found = found.expect("finite");
        let stress = ViscousStress { fluid, coordinates: Cartesian, velocity, pressure: Pressure(pressure) };
        let balance = flow.momentum_residual(&stress, &PerMass(force), &place, time).expect("finite");
        let error = (found.value + balance.value).norm();
        prop_assert!(error <= Tol::ulps(64.0).value() * found.scale.norm(), "{error:e}");
    }
}

/// The decaying vortex of Lamb and Oseen in cylindrical coordinates; its pressure balances it radially.
struct Vortex;
impl Field for Vortex {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, t: T) -> Vector3<T> {
        // Γ = 2 π, ν = ¼: v = (1 − exp(−r²/t))/r.
        let r = q[0];
        Vector3::new(T::zero(), -(-(r * r) / t).exp_m1() / r, T::zero())
    }
}

#[test]
fn decaying_vortex_satisfies_the_azimuthal_balance_in_cylindrical_coordinates() {
    let fluid = LinearViscous::new(0.5, 0.25).expect("bounds");
    let stress = ViscousStress { fluid, coordinates: Cylindrical, velocity: Vortex, pressure: Uniform(0.0) };
    let flow = Flow { coordinates: Cylindrical, density: Uniform(1.0), velocity: Vortex };
    for (r, time) in [(0.25, 0.5), (1.0, 1.0), (2.0, 0.75)] {
        let q = Vector3::new(r, 0.5, 0.25);
        let residual = flow.momentum_residual(&stress, &Uniform(Vector3::zeros()), &q, time).expect("finite");
        assert!(residual.value.y.abs() <= Tol::ulps(64.0).value() * residual.scale.y, "{residual:?}");
        // Radially −ρ v²/r is left for the pressure.
        let v = -(-r * r / time).exp_m1() / r;
        let left = [v * v / r];
        assert_close_at_scale("−ρ v²/r", &[residual.value.x], &left, residual.scale.x, Tol::ulps(16.0));
    }
    // Channel flow of a thinning fluid: the stress field is that of its own law, and div T is −c only where it is the solution's.
    let thinning = GeneralisedNewtonian::new(CarreauYasuda::new(2.0, 0.5, 1.0, 0.5, 2.0).expect("bounds"));
    let stress = ViscousStress { fluid: thinning, coordinates: Cylindrical, velocity: Vortex, pressure: Uniform(0.0) };
    let t = stress.at(&Vector3::new(1.0, 0.0, 0.0), 1.0);
    // T_rθ = τ(r (v/r)′), r (v/r)′ = 2 e⁻¹ − 2 (1 − e⁻¹) at r = t = 1.
    let e = (-1.0_f64).exp();
    let k = 2.0 * e - 2.0 * (1.0 - e);
    assert_close("T_rθ", &[t.0.components[3]], &[thinning.fluid().shear_stress(k)], Tol::ulps(16.0));
    let nowhere = stress.at::<f64>(&Vector3::new(0.0, 0.0, 0.0), 1.0);
    assert!(nowhere.0.components[0].is_nan());
}
