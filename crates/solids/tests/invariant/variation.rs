//! Membrane and plate: the force of equilibrium does the work that the energy asks for.

use nalgebra::{Matrix3, Vector3};
use piola_solids::{Membrane, ThinPlate};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

const POINTS: u32 = 8;

/// The mean over a period of the phase.
fn mean(f: impl Fn(f64) -> f64) -> f64 {
    let phase = |k: u32| 2.0 * core::f64::consts::PI * f64::from(k) / f64::from(POINTS);
    (0..POINTS).map(|k| f(phase(k))).sum::<f64>() / f64::from(POINTS)
}

#[test]
fn work_of_the_force_of_equilibrium_equals_change_of_energy() {
    let (k, a) = (Vector3::new(0.5, -1.0, 2.0), Vector3::new(0.25, 1.0, -0.5));
    let square = k.norm_squared();
    let membrane = Membrane::new(3.0).expect("bounds");
    let plate = ThinPlate::new(3.0).expect("bounds");
    // u = a sin φ, φ = k · X, and δu = u: δΠ = 2 Π_stored − ∫ f · u.
    let stored = mean(|phase| membrane.energy_density(&(a * k.transpose() * phase.cos())));
    let force = |phase: f64| a * (-membrane.symbol(&k) * phase.sin());
    let work = mean(|phase| force(phase).dot(&a) * phase.sin());
    assert_close("membrane", &[work], &[2.0 * stored], Tol::ulps(8.0));
    let residual = membrane.residual(&force(1.0), &(a * (-square * 1.0_f64.sin())));
    let size = force(1.0).norm();
    assert_close_at_scale("f + τ Δu = 0", residual.as_slice(), &[0.0; 3], size, Tol::ulps(4.0));

    let hessian = |phase: f64| {
        let entry = |i: usize, j: usize, l: usize| -a[i] * k[j] * k[l] * phase.sin();
        core::array::from_fn(|i| core::array::from_fn(|j| core::array::from_fn(|l| entry(i, j, l))))
    };
    let stored = mean(|phase| plate.energy_density(&hessian(phase)));
    let force = |phase: f64| a * (-plate.symbol(&k) * phase.sin());
    let work = mean(|phase| force(phase).dot(&a) * phase.sin());
    assert_close("plate", &[work], &[2.0 * stored], Tol::ulps(8.0));
    assert!(0.0 < work, "with the other sign no force would hold the plate");
    let residual = plate.residual(&force(1.0), &(a * (square * square * 1.0_f64.sin())));
    let size = force(1.0).norm();
    assert_close_at_scale("f − D Δ²u = 0", residual.as_slice(), &[0.0; 3], size, Tol::ulps(4.0));
}

#[test]
fn stress_and_moment_equal_derivatives_of_the_energies() {
    let gradient = Matrix3::new(1.0, 2.0, -3.0, 0.5, 4.0, 1.0, -2.0, 1.0, 0.25);
    let membrane = Membrane::new(3.0).expect("bounds");
    // A quadratic form: half of the product with its derivative.
    let energy = membrane.energy_density(&gradient);
    assert_close("membrane", &[0.5 * membrane.stress(&gradient).dot(&gradient)], &[energy], Tol::ulps(8.0));
    let second = [[[1.0, 2.0, 3.0], [2.0, -1.0, 0.5], [3.0, 0.5, 4.0]]; 3];
    let plate = ThinPlate::new(3.0).expect("bounds");
    let product: f64 = plate
        .moment(&second)
        .as_flattened()
        .as_flattened()
        .iter()
        .zip(second.as_flattened().as_flattened())
        .map(|(m, g)| m * g)
        .sum();
    assert_close("plate", &[0.5 * product], &[plate.energy_density(&second)], Tol::ulps(8.0));
}
