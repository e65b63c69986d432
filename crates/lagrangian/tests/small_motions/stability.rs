//! Verdicts on stability at known thresholds.

use nalgebra::{DMatrix, dmatrix};
use piola_lagrangian::small_motions::{ComplexMode, Linearisation, Stability};
use piola_testkit::{Tol, assert_close};

use crate::systems::{GRAVITY, Still, TOP, linear, standing};

fn verdict(linearisation: &Linearisation) -> Stability {
    linearisation.stability().unwrap()
}

#[test]
fn sleeping_top_is_stable_above_four_a_m_g_h_over_c_squared() {
    let [transverse, axial, mass, height] = TOP;
    let overturning = mass * GRAVITY * height;
    let threshold = 2.0 * (transverse * overturning).sqrt() / axial;
    let spinning = |spin: f64| standing(Still::top()).linearise(&[0.0; 3], &[0.0, 0.0, spin], 0.0).unwrap();
    for factor in [1.0 + 1e-6, 1.01, 2.0, 10.0] {
        assert_eq!(verdict(&spinning(factor * threshold)), Stability::Marginal, "{factor}");
    }
    for factor in [0.0, 0.5, 0.99, 1.0 - 1e-6] {
        let top = spinning(factor * threshold);
        assert_eq!(verdict(&top), Stability::Unstable, "{factor}");
        let modes = top.complex_modes().unwrap().modes;
        let growth = modes.iter().map(ComplexMode::growth_rate).fold(0.0, f64::max);
        // Re λ = √(4 A m g h − C²ω²)/2A; it is sensitive to the spin near the threshold.
        let expected = (overturning / transverse * (1.0 - factor * factor)).sqrt();
        assert_close("growth", &[growth], &[expected], Tol::ulps(64.0).times(1.0 / (1.0 - factor)));
    }
}

#[test]
fn circulatory_forces_make_equal_frequencies_flutter() {
    // λ² = −k ± i n: growth Im √(k + i n).
    let (k, n) = (4.0_f64, 0.5);
    let flutter = linear(DMatrix::identity(2, 2), &DMatrix::zeros(2, 2), &dmatrix![k, n; -n, k]);
    assert_eq!(verdict(&flutter), Stability::Unstable);
    let growth = flutter.complex_modes().unwrap().modes.iter().map(ComplexMode::growth_rate).fold(0.0, f64::max);
    let size = k.hypot(n);
    assert_close("growth", &[growth], &[((size - k) / 2.0).sqrt()], Tol::ulps(256.0));
    // Damping of d holds it where n < d √k.
    for (damping, expected) in [(0.26, Stability::Asymptotic), (0.24, Stability::Unstable)] {
        let damped = linear(DMatrix::identity(2, 2), &(DMatrix::identity(2, 2) * damping), &dmatrix![k, n; -n, k]);
        assert_eq!(verdict(&damped), expected, "{damping}");
    }
}

#[test]
fn theorems_of_kelvin_tait_and_chetayev_hold() {
    let one = DMatrix::<f64>::identity(2, 2);
    let zero = DMatrix::<f64>::zeros(2, 2);
    let turn = dmatrix![0.0, 5.0; -5.0, 0.0];
    // 0 < K: stable, also with gyroscopic forces; asymptotically with complete damping.
    assert_eq!(verdict(&linear(one.clone(), &zero, &one)), Stability::Stable);
    assert_eq!(verdict(&linear(one.clone(), &turn, &one)), Stability::Stable);
    assert_eq!(verdict(&linear(one.clone(), &(&one + &turn), &one)), Stability::Asymptotic);
    // K < 0: gyroscopic forces may hold it, and any damping destroys that.
    assert_eq!(verdict(&linear(one.clone(), &zero, &-&one)), Stability::Unstable);
    assert_eq!(verdict(&linear(one.clone(), &turn, &-&one)), Stability::Marginal);
    assert_eq!(verdict(&linear(one.clone(), &(&turn + &one * 0.01), &-&one)), Stability::Unstable);
    // Damping of one mass reaches the other through the spring.
    let coupled = dmatrix![2.0, -1.0; -1.0, 2.0];
    let partial = dmatrix![1.0, 0.0; 0.0, 0.0];
    assert_eq!(verdict(&linear(one.clone(), &partial, &coupled)), Stability::Asymptotic);
    // Without the coupling it does not.
    assert_eq!(verdict(&linear(one.clone(), &partial, &one)), Stability::Stable);
    // Drift: nothing holds the centre.
    assert_eq!(verdict(&linear(one.clone(), &zero, &dmatrix![1.0, -1.0; -1.0, 1.0])), Stability::Marginal);
    assert_eq!(verdict(&linear(one, &zero, &zero)), Stability::Marginal);
}
