//! Fluids whose stress is a function of density and rate of deformation: special cases, rest, indifference, representation.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::VelocityGradient;
use piola_fluids::{
    CompressibleReinerRivlin, ConstantCoefficients, EulerianFluid, LinearViscous, Polytropic, ReinerRivlinCoefficients,
    StokesianFluid, ViscousFluid,
};
use piola_numerics::Real;
use piola_tensor::spectral::{EigenvalueCase, representation};
use piola_testkit::golden::{load, number, text};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::stresses::{gradient, rows};

fn state() -> Polytropic {
    Polytropic::new(3.0, 1.25, 1.4).expect("bounds")
}

/// A density at which the pressure is this.
fn density_of(pressure: f64) -> f64 {
    1.25 * (pressure / 3.0).powf(1.0 / 1.4)
}

/// γ₀ = −ρ² + ρ I + II/4, γ₁ = ρ + III, γ₂ = 0.5 ρ I − 0.3.
struct Mixed;

impl StokesianFluid for Mixed {
    fn coefficients<T: Real>(&self, density: T, [first, second, third]: [T; 3]) -> [T; 3] {
        [
            density * first - density * density + T::lit(0.25) * second,
            density + third,
            T::lit(0.5) * density * first - T::lit(0.3),
        ]
    }
}

#[test]
fn golden_stresses_are_those_of_compressible_fluids_at_densities_of_their_pressures() {
    let mut count = 0;
    for case in &load("fluids").cases {
        let (input, output) = (&case["input"], &case["output"]);
        let of = |name: &str| number(&input[name]);
        let (second_viscosity, coefficients) = match text(&case["kind"]) {
            "newtonian" => (of("lambda"), [2.0 * of("mu"), 0.0]),
            "reiner_rivlin" => (0.0, [of("g1"), of("g2")]),
            _ => continue,
        };
        // The pressure of the case, by an equation of state: p = p₀ at ρ = ρ₀.
        let pressure = of("p");
        let [first, second] = coefficients;
        let coefficients = ConstantCoefficients::new(first, second).expect("bounds");
        let l = gradient(&input["L"]);
        let expected = rows(&output["T"]);
        let scale = expected.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let tol = Tol::stated(1e-13, "closed forms");
        let stress = if 0.0 < pressure {
            let state = Polytropic::new(pressure, 2.0, 1.5).expect("bounds");
            let fluid = CompressibleReinerRivlin::new(state, second_viscosity, coefficients).expect("finite");
            fluid.cauchy(2.0, &l).0
        } else {
            // Pressures that no gas has, as a part of the stress.
            let state = Polytropic::new(1.0, 2.0, 1.5).expect("bounds");
            let fluid = CompressibleReinerRivlin::new(state, second_viscosity, coefficients).expect("finite");
            fluid.cauchy(2.0, &l).0 + piola_tensor::Symmetric::identity() * (1.0 - pressure)
        };
        let scale = scale.max(1.0);
        assert_close_at_scale(text(&case["id"]), stress.rows().as_flattened(), expected.as_flattened(), scale, tol);
        count += 1;
    }
    assert!(4 <= count, "{count}");
}

#[test]
fn compressible_newtonian_and_eulerian_fluids_are_special_cases_and_rest_is_a_pressure() {
    let l = VelocityGradient::from_rows([[0.5, 0.3, -1.5], [2.9, -0.75, -1.4], [2.2, 0.3, 0.5]]).expect("finite");
    let rest = VelocityGradient::from_rows([[0.0, 0.4, -1.0], [-0.4, 0.0, 2.0], [1.0, -2.0, 0.0]]).expect("finite");
    for pressure in [0.5, 3.0, 40.0] {
        let density = density_of(pressure);
        let newtonian = ConstantCoefficients::new(1.5, 0.0).expect("bounds");
        let fluid = CompressibleReinerRivlin::new(state(), 0.25, newtonian).expect("finite");
        let linear = LinearViscous::new(0.25, 0.75).expect("bounds");
        let tol = Tol::ulps_because(64.0, "the power of the equation of state");
        assert_close_at_scale(
            "Newtonian",
            &fluid.cauchy(density, &l).0.components,
            &linear.cauchy(pressure, &l).0.components,
            pressure + 4.0,
            tol,
        );
        assert_close_at_scale(
            "dissipation",
            &[fluid.dissipation(density, &l)],
            &[linear.dissipation(&l)],
            16.0 * (pressure + 4.0),
            tol,
        );
        let eulerian =
            CompressibleReinerRivlin::new(state(), 0.0, ConstantCoefficients::new(0.0, 0.0).expect("bounds"));
        let eulerian = eulerian.expect("finite").cauchy(density, &l).0.components;
        assert_close("Eulerian", &eulerian[..3], &[-state().pressure(density); 3], Tol::ulps(2.0));
        assert_eq!(&eulerian[3..], &[0.0; 3]);
        // A rigid rotation is rest.
        let quadratic =
            CompressibleReinerRivlin::new(state(), 0.25, ConstantCoefficients::new(1.5, 0.7).expect("bounds"));
        let still = quadratic.expect("finite").cauchy(density, &rest).0.components;
        assert_close("rest", &still[..3], &[-pressure; 3], tol);
        assert_eq!(&still[3..], &[0.0; 3]);
    }
    let still = Mixed.cauchy(1.5, &rest).0.components;
    assert_close("rest", &still, &[-2.25, -2.25, -2.25, 0.0, 0.0, 0.0], Tol::ulps(0.0));
    let endless = ConstantCoefficients::new(1.0, 0.0).expect("bounds");
    assert!(CompressibleReinerRivlin::new(state(), f64::INFINITY, endless).is_err());
    assert!(0.0 < endless.first([0.0; 3]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(5_000)))]

    #[test]
    fn stress_of_density_and_rate_is_seen_turned_and_has_the_coefficients_of_its_representation(
        entries in strategies::vector(9, -2.0..2.0), density in 0.2..3.0_f64,
        q in strategies::rotation(), spin in strategies::vector(3, -3.0..3.0),
    ) {
        let l = VelocityGradient::new(Matrix3::from_row_slice(&entries)).expect("finite");
        let r = strategies::rotation_matrix(q);
        let (rotation, spin) = (Matrix3::from_fn(|i, j| r[i][j]), Vector3::from_column_slice(&spin));
        let stress = Mixed.cauchy(density, &l).0;
        let seen = Mixed.cauchy(density, &l.seen_from(&rotation, &spin)).0.matrix();
        let d = l.rate_of_deformation().0;
        let size = (1.0 + d.norm()).powi(4) * (1.0 + density).powi(2) * (1.0 + spin.norm());
        prop_assert!((seen - rotation * stress.matrix() * rotation.transpose()).norm() < 256.0 * f64::EPSILON * size);

        // γ by the values at the eigenvalues alone, and by the invariants alone.
        let found = representation(&d, &stress, 1e-6).expect("finite");
        prop_assume!(found.case == EigenvalueCase::Three);
        let eigenvalues = d.matrix().symmetric_eigenvalues();
        let mut values = [eigenvalues[0], eigenvalues[1], eigenvalues[2]];
        values.sort_by(f64::total_cmp);
        let gaps = [values[1] - values[0], values[2] - values[1]];
        let largest = values[0].abs().max(values[2].abs());
        let [a, b, c] = values;
        let expected = Mixed.coefficients(density, [a + b + c, a * b + b * c + c * a, a * b * c]);
        let condition = size * (1.0 + largest * largest) / (gaps[0] * gaps[1]).min(1.0);
        assert_close_at_scale("γ", &found.coefficients, &expected, condition, Tol::ulps(256.0));
        prop_assert!(found.residual * stress.norm() < 256.0 * f64::EPSILON * condition);
    }
}
