//! Distances with all their derivatives against closed forms.

use nalgebra::{Matrix2, Vector2};
use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::systems::Magnetic;

/// Of a charge in a uniform magnetic field, with ω = eB/m and the time T between the events:
///
/// ```text
/// G = ¼ m ω (cot(ωT/2) |q₁ − q₀|² + 2 (x₀ y₁ − x₁ y₀))
/// ```
///
/// R. P. Feynman, A. R. Hibbs, *Quantum Mechanics and Path Integrals*, problem 3-10.
#[test]
fn distance_of_a_charge_in_a_magnetic_field_and_its_derivatives_equal_their_closed_forms() {
    let (mass, charge, field) = (1.5, 0.8, 1.25);
    let magnetic = Magnetic { mass, charge, field };
    let (from, to) = (Vector2::new(0.3, -0.7), Vector2::new(1.1, 0.4));
    let turn = Matrix2::new(0.0, 1.0, -1.0, 0.0);
    for time in [1.2, 3.5, -2.0] {
        let (start, end) = (Event::new(from.as_slice(), 0.25), Event::new(to.as_slice(), 0.25 + time));
        let found = GeodeticDistance::new(&magnetic).between(&start, &end, &[0.0, 0.0]).unwrap();
        let half = 0.5 * charge * field;
        let cotangent = half / (half * time / mass).tan();
        let step = to - from;
        let integrated =
            Tol::stated(1e-11, "a few dozen steps of local error 1e-13, solved with at a condition below ten");
        let distance = 0.5 * cotangent * step.norm_squared() + half * from.dot(&(turn * to));
        assert_close_at_scale("G", &[found.distance], &[distance], 1.0, integrated);
        let (p0, p1) = (step * cotangent - turn * to * half, step * cotangent + turn.transpose() * from * half);
        assert_close("p₀", &found.initial_momenta, p0.as_slice(), integrated);
        assert_close("p₁", &found.final_momenta, p1.as_slice(), integrated);
        let even = Matrix2::from_diagonal_element(cotangent);
        assert_close("∂²G/∂q₀∂q₀", found.initial_hessian.as_slice(), even.as_slice(), integrated);
        assert_close("∂²G/∂q₁∂q₁", found.final_hessian.as_slice(), even.as_slice(), integrated);
        assert_close("∂²G/∂q₀∂q₁", found.mixed_hessian.as_slice(), (turn * half - even).as_slice(), integrated);
    }
}
