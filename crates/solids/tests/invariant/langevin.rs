//! The Langevin function and its inverse against closed forms in twice the precision.

use piola_numerics::{Dual, Real};
use piola_solids::isochoric::{ArrudaBoyce, ArrudaBoyceSeries, Isochoric, inverse_langevin, langevin};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale};

/// coth β − 1/β as it is written.
fn plain(beta: f64) -> DoubleDouble {
    let (beta, one, two) = (DoubleDouble::lit(beta), DoubleDouble::lit(1.0), DoubleDouble::lit(2.0));
    one + two / (two * beta).exp_m1() - one / beta
}

#[test]
fn langevin_equals_its_closed_form_in_twice_the_precision() {
    let mut largest = 0.0_f64;
    for k in 0..4000 {
        let beta = 10.0_f64.powf(f64::from(k) / 4000.0 * 5.0 - 2.5);
        let value = langevin(beta);
        assert_eq!(langevin(-beta).to_bits(), (-value).to_bits());
        largest = largest.max(plain(beta).rounding_of(value).abs() / value);
    }
    assert!(largest <= 6.0 * f64::EPSILON, "{largest:e}");
}

#[test]
fn langevin_of_its_inverse_equals_identity() {
    let mut largest = 0.0_f64;
    for k in 1..2000 {
        for lambda in
            [f64::from(k) / 2000.0, 10.0_f64.powf(-0.01 * f64::from(k)), 1.0 - 10.0_f64.powf(-0.004 * f64::from(k))]
        {
            let beta = inverse_langevin(lambda);
            let exact = inverse_langevin(DoubleDouble::lit(lambda));
            // The inverse is right where the function of it is.
            let back = langevin(exact).rounding_of(lambda).abs();
            assert!(back <= 1e-15 * lambda * (1.0 - lambda), "{lambda}: {back:e}");
            let condition = 1.0 / (1.0 - lambda);
            largest = largest.max(exact.rounding_of(beta).abs() / beta / condition);
        }
    }
    assert!(largest <= 6.0 * f64::EPSILON, "{largest:e}");
    assert!(inverse_langevin(1.0_f64).is_nan());
}

#[test]
fn derivatives_of_the_inverse_equal_reciprocal_slopes() {
    for k in 1..1000 {
        let lambda = f64::from(k) / 1000.0;
        let beta = inverse_langevin(Dual::variable(Dual::variable(lambda)));
        let forward = langevin(Dual::variable(Dual::variable(beta.value.value)));
        let slope = 1.0 / forward.tangent.value;
        let bend = -forward.tangent.tangent * slope * slope * slope;
        let condition = 1.0 / (1.0 - lambda);
        let first = (beta.tangent.value / slope - 1.0).abs();
        assert!(first <= 64.0 * f64::EPSILON * condition, "{lambda}: {first:e}");
        let second = (beta.tangent.tangent - bend).abs() / (slope * slope);
        assert!(second <= 256.0 * f64::EPSILON * condition, "{lambda}: {second:e}");
    }
}

#[test]
fn series_approaches_the_network_as_its_documentation_says() {
    let (network, series) =
        (ArrudaBoyce::new(2.0, 10.0).expect("bounds"), ArrudaBoyceSeries::new(2.0, 10.0).expect("bounds"));
    for (square, shortfall) in [(0.3, 0.0019), (0.5, 0.027), (0.7, 0.16), (0.9, 0.59)] {
        let first = 30.0 * square - 3.0;
        let [exact, _] = network.slopes(first, 0.0);
        let [short, _] = series.slopes(first, 0.0);
        let measured = 1.0 - short / exact;
        assert!((measured - shortfall).abs() < 0.02 * shortfall, "{square}: {measured}");
    }
}

#[test]
fn network_energy_equals_the_integral_of_its_slope() {
    let network = ArrudaBoyce::new(2.0, 5.0).expect("bounds");
    for first in [1e-12, 1e-3, 0.5, 3.0, 8.0, 11.0, 11.9] {
        // dW/dx by the energy over a dual number, beside the closed slope.
        let varied = network.energy(Dual::variable(first), Dual::constant(0.0));
        let [slope, _] = network.slopes(first, 0.0);
        // Near the limit λ = 1 of the chains an ulp of λ is 1/(1 − λ) of β.
        let condition = 1.0 / (1.0 - ((first + 3.0) / 15.0).sqrt());
        let tolerance = Tol::ulps(16.0).times(condition);
        assert_close(&format!("slope at {first}"), &[varied.tangent], &[slope], tolerance);
        let exact = network.energy(DoubleDouble::lit(first), DoubleDouble::lit(0.0));
        let rounding = exact.rounding_of(varied.value);
        assert_close_at_scale(&format!("W at {first}"), &[rounding], &[0.0], varied.value, tolerance);
    }
}
