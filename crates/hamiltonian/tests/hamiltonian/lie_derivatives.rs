//! Lie derivatives of forms against their definition, evaluated by mpmath, and against linear fields by hand.

use nalgebra::Matrix4;
use piola_hamiltonian::{
    CanonicalOneForm, CanonicalTwoForm, OneForm, TwoForm, VectorField, lie_derivative_of_one_form,
    lie_derivative_of_two_form, locally_hamiltonian_test,
};
use piola_numerics::Real;
use piola_testkit::golden::{load, text, vector};
use piola_testkit::{Tol, assert_close, assert_each_close, assert_each_close_at_scales};
use proptest::prelude::*;

/// k = (q₁ p₂² − q₂, sin q₁ + p₁ q₂, q₁² p₁ − exp(p₂/2), q₂ p₁ p₂ + q₁), of the reference.
struct Known;

impl VectorField for Known {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let [q1, q2, p1, p2] = [x[0], x[1], x[2], x[3]];
        out[0] = q1 * p2 * p2 - q2;
        out[1] = q1.sin() + p1 * q2;
        out[2] = q1 * q1 * p1 - (T::lit(0.5) * p2).exp();
        out[3] = q2 * p1 * p2 + q1;
    }
}

/// Forms of both degrees that are neither closed nor canonical, of the reference.
struct Uneven;

impl OneForm for Uneven {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[x[1] * x[2], x[0] * x[0], x[3].sin(), x[0] * x[1]]);
    }
}

impl TwoForm for Uneven {
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
        out.fill(T::zero());
        let entries = [
            (0, 1, x[2]),
            (0, 2, x[0] * x[3]),
            (0, 3, x[1].sin()),
            (1, 2, x[3]),
            (1, 3, x[0] * x[0]),
            (2, 3, x[1] * x[2]),
        ];
        for (i, j, entry) in entries {
            (out[i + 4 * j], out[j + 4 * i]) = (entry, -entry);
        }
    }
}

/// W(9.15–9.18): d/ds of a form pulled back by the flow, at one point. The signs are those of `L_k θ = −ω(k) + d(θ(k))`.
#[test]
fn lie_derivatives_equal_rates_of_the_forms_pulled_back() {
    let data = load("equations");
    let case = data.cases.iter().find(|case| text(&case["equation"]) == "W(9.15-9.18)").expect("a case");
    let (x, of) = (vector(&case["x"]), |key: &str| vector(&case[key]));
    let one = lie_derivative_of_one_form(&Known, &CanonicalOneForm, &x).expect("regular");
    // Each component is a sum of at most eight terms of the size of one.
    let few = Tol::ulps(8.0);
    assert_each_close("L_k θ", one.as_slice(), &of("lie_theta"), few);
    let one = lie_derivative_of_one_form(&Known, &Uneven, &x).expect("regular");
    assert_each_close("L_k α", one.as_slice(), &of("lie_one_form"), few);
    // Rows of the reference.
    let two = lie_derivative_of_two_form(&Known, &CanonicalTwoForm, &x).expect("regular").transpose();
    assert_each_close("L_k ω", two.as_slice(), &of("lie_omega"), few);
    let two = lie_derivative_of_two_form(&Known, &Uneven, &x).expect("regular").transpose();
    assert_each_close_at_scales("L_k β", two.as_slice(), &of("lie_two_form"), &[1.0; 16], few);
}

/// k = A x, by rows.
#[derive(Clone, Copy, Debug)]
struct Linear([[f64; 4]; 4]);

impl VectorField for Linear {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        for (row, out) in self.0.iter().zip(out) {
            *out = row.iter().zip(x).fold(T::zero(), |sum, (&a, &x)| sum + T::lit(a) * x);
        }
    }
}

/// ω = dp ∧ dq: entry (i, j) is `ω(e_i, e_j)`, W(8.22).
fn omega() -> Matrix4<f64> {
    Matrix4::new(0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
}

proptest! {
    /// The flow of A x is exp(A s), which pulls ω back to exp(A s)ᵀ Ω exp(A s): the rate is Aᵀ Ω + Ω A. That of θ = p dq
    /// is k^p·dq + p·dk^q.
    #[test]
    fn lie_derivatives_along_linear_fields_equal_products_of_matrices(
        rows in prop::array::uniform4(prop::array::uniform4(-2.0..2.0_f64)), x in prop::array::uniform4(-2.0..2.0_f64),
    ) {
        let a = Matrix4::from_fn(|i, j| rows[i][j]);
        let expected = a.transpose() * omega() + omega() * a;
        let found = lie_derivative_of_two_form(&Linear(rows), &CanonicalTwoForm, &x).unwrap();
        // One sum of two entries of A: one rounding.
        assert_each_close("L_k ω", found.as_slice(), expected.as_slice(), Tol::ulps(1.0));
        let found = lie_derivative_of_one_form(&Linear(rows), &CanonicalOneForm, &x).unwrap();
        let k = |i: usize| (0..4).map(|j| rows[i][j] * x[j]).sum::<f64>();
        let stretched = |j: usize| x[2] * rows[0][j] + x[3] * rows[1][j];
        let expected = [k(2) + stretched(0), k(3) + stretched(1), stretched(2), stretched(3)];
        assert_each_close_at_scales("L_k θ", found.as_slice(), &expected, &[8.0; 4], Tol::ulps(4.0));
    }
}

/// Two oscillators, q̇ = p and ṗ = −K q, with one entry of A more: `L_k ω = Σ dk^p ∧ dq + dp ∧ dk^q` has one pair of entries.
#[test]
fn residual_of_a_field_that_is_not_locally_hamiltonian_equals_what_was_added() {
    let oscillators =
        Linear([[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [-2.0, 0.5, 0.0, 0.0], [0.5, -3.0, 0.0, 0.0]]);
    let x = [0.25, -0.5, 1.0, 2.0];
    let none = locally_hamiltonian_test(&oscillators, &x).unwrap();
    assert_eq!((none.residual.to_bits(), none.relative.to_bits()), (0, 0));
    // (row and column of A, what is added; row and column of L_k ω, residual, relative): a coupling that is not symmetric,
    // ∂₁k^{p₂} = 3/4 against ∂₂k^{p₁} = 1/2; friction of the second; a velocity that feels the other's momentum; a swelling.
    let cases = [
        ((3, 0, 0.25), (1, 0, 0.25, 0.2)),
        ((3, 3, -0.125), (3, 1, 0.125, 1.0)),
        ((0, 3, 0.5), (3, 2, 0.5, 1.0)),
        ((0, 0, 0.75), (2, 0, 0.75, 1.0)),
    ];
    for ((i, j, added), (row, column, residual, relative)) in cases {
        let mut field = oscillators;
        field.0[i][j] += added;
        let found = locally_hamiltonian_test(&field, &x).unwrap();
        assert_eq!((found.row, found.column), (row, column), "{i} {j}");
        assert_close("residual, relative", &[found.residual, found.relative], &[residual, relative], Tol::ulps(0.0));
    }
}
