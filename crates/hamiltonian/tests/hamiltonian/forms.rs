//! Canonical and extended forms: closed, not degenerate, kept by flows; velocities and momenta in other coordinates.

use nalgebra::DMatrix;
use piola_hamiltonian::{
    CanonicalOneForm, CanonicalTwoForm, CotangentVector, Differential, ExtendedOneForm, ExtendedTwoForm, OneForm,
    PhaseFunction, PhaseMap, PointTransformation, SymplecticGradient, TangentVector, TwoForm, VectorField,
    closedness_residual, exterior_derivative, image_and_jacobian, lie_derivative_of_one_form,
    lie_derivative_of_two_form, locally_hamiltonian_test, raise,
};
use piola_lagrangian::ChangeOfCoordinates;
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{AnyField, any_function, any_point};

/// θ(k) as a function is the form of degree zero; its differential by the chain rule through a form.
struct ThetaOf<'a, K>(&'a K);

impl<K: VectorField> PhaseFunction for ThetaOf<'_, K> {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let x = [q[0], q[1], p[0], p[1]];
        let mut k = [T::zero(); 4];
        self.0.components(&x, &mut k);
        CanonicalOneForm.along(p, &k[..2])
    }
}

/// The Lie derivative of θ as a form.
struct LieOfTheta<'a, K>(&'a K);
impl<K: VectorField> OneForm for LieOfTheta<'_, K> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let derivative = lie_derivative_of_one_form(self.0, &CanonicalOneForm, x);
        out.copy_from_slice(derivative.expect("a regular point").as_slice());
    }
}

/// θ̃ along the motion.
struct Along<'a, H>(&'a H);
impl<H: PhaseFunction> PhaseFunction for Along<'_, H> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let x = [q[0], q[1], p[0], p[1], t];
        let (mut k, mut theta) = ([T::zero(); 5], [T::zero(); 5]);
        SymplecticGradient(self.0).components(&x, &mut k);
        ExtendedOneForm(self.0).components(&x, &mut theta);
        k.iter().zip(theta).fold(T::zero(), |sum, (&k, theta)| sum + k * theta)
    }
}

/// A change of coordinates that is regular in the range of the tests, and moves.
struct Bent;

impl ChangeOfCoordinates<2> for Bent {
    const TIME_DEPENDENT: bool = true;
    fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; 2] {
        [T::lit(2.0) * new[0] + new[1].sin() + t, T::lit(3.0) * new[1] + T::lit(0.2) * new[0] * new[0]]
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn the_lie_derivative_of_the_one_form_is_that_of_cartan(
        a in any_function(), b in any_function(), (q, p) in any_point(),
    ) {
        let (x, field) = ([q[0], q[1], p[0], p[1]], AnyField(a, b));
        let derivative = lie_derivative_of_one_form(&field, &CanonicalOneForm, &x).unwrap();
        let mut slope = [0.0; 4];
        Differential(ThetaOf(&field)).components(&x, &mut slope);
        let (mut k, mut lowered) = ([0.0; 4], [0.0; 4]);
        field.components(&x, &mut k);
        CanonicalTwoForm.lower_into(&k, &mut lowered);
        // Mind the sign: ω(k) fills the second place of ω.
        let expected: Vec<f64> = slope.iter().zip(lowered).map(|(slope, lowered)| slope - lowered).collect();
        assert_close_at_scale("L_k θ", derivative.as_slice(), &expected, 20.0, Tol::ulps(20.0));
    }

    #[test]
    fn hamiltonian_fields_keep_the_two_form_and_others_do_not(
        k in any_function(), b in any_function(), (q, p) in any_point(),
    ) {
        let x = [q[0], q[1], p[0], p[1]];
        let kept = lie_derivative_of_two_form(&SymplecticGradient(&k), &CanonicalTwoForm, &x).unwrap();
        assert_close_at_scale("L_k ω", kept.as_slice(), &[0.0; 16], 20.0, Tol::ulps(10.0));
        // Derivatives of k are sums of a few terms, which may cancel: their rounding is not measured by their size.
        let rounding = 10.0 * Tol::ulps(10.0).value();
        let worst = locally_hamiltonian_test(&SymplecticGradient(&k), &x).unwrap();
        prop_assert!(worst.residual <= 20.0 * rounding, "{worst:?}");
        let other = AnyField(&k, &b);
        // L_k ω = d(L_k θ): the two computed apart.
        let lie = lie_derivative_of_two_form(&other, &CanonicalTwoForm, &x).unwrap();
        let of_theta = exterior_derivative(&LieOfTheta(&other), &x).unwrap();
        assert_close_at_scale("L_k dθ = d L_k θ", lie.as_slice(), of_theta.as_slice(), 40.0, Tol::ulps(20.0));
    }

    #[test]
    fn the_motion_keeps_the_extended_forms(h in any_function(), (q, p) in any_point(), t in -2.0..2.0_f64) {
        let x = [q[0], q[1], p[0], p[1], t];
        let motion = SymplecticGradient(&h);
        let kept = lie_derivative_of_two_form(&motion, &ExtendedTwoForm(&h), &x).unwrap();
        assert_close_at_scale("L_h ω̃", kept.as_slice(), &[0.0; 25], 40.0, Tol::ulps(10.0));
        // ω̃ = dθ̃, and the motion is its null direction.
        let exact = exterior_derivative(&ExtendedOneForm(&h), &x).unwrap();
        let mut entries = DMatrix::zeros(5, 5);
        ExtendedTwoForm(&h).entries(&x, entries.as_mut_slice());
        assert_close_at_scale("ω̃ = dθ̃", entries.as_slice(), exact.as_slice(), 10.0, Tol::ulps(4.0));
        let mut direction = [0.0; 5];
        motion.components(&x, &mut direction);
        let null = &entries * nalgebra::DVector::from_row_slice(&direction);
        assert_close_at_scale("ω̃(h)", null.as_slice(), &[0.0; 5], 20.0, Tol::ulps(10.0));
        // L_h θ̃ = d(θ̃(h)), θ̃(h) = p·H_p − H.
        let lie = lie_derivative_of_one_form(&motion, &ExtendedOneForm(&h), &x).unwrap();
        let mut slope = [0.0; 5];
        Differential(Along(&h)).components(&x, &mut slope);
        assert_close_at_scale("L_h θ̃", lie.as_slice(), &slope, 40.0, Tol::ulps(20.0));
        // Second derivatives of H cancel in pairs.
        prop_assert!(closedness_residual(&ExtendedTwoForm(&h), &x).unwrap() < 1e-13);
    }

    #[test]
    fn momenta_and_velocities_pair_to_the_same_in_all_coordinates(
        new in prop::array::uniform2(-1.0..1.0_f64),
        v in prop::array::uniform2(-1.0..1.0_f64),
        p in prop::array::uniform2(-1.0..1.0_f64),
        t in -1.0..1.0_f64,
    ) {
        let (velocity, momentum) = (TangentVector(v), CotangentVector(p));
        let seen = (velocity.to_new(&Bent, &new, t).unwrap(), momentum.to_new(&Bent, &new, t));
        assert_close_at_scale("p·v", &[seen.1.of(seen.0)], &[momentum.of(velocity)], 2.0, Tol::ulps(8.0));
        assert_close("v", &seen.0.to_old(&Bent, &new, t).0, &v, Tol::ulps(8.0));
        assert_close("p", &seen.1.to_old(&Bent, &new, t).unwrap().0, &p, Tol::ulps(8.0));
    }

    #[test]
    fn a_point_transformation_keeps_both_canonical_forms(
        new in prop::array::uniform2(-1.0..1.0_f64),
        p in prop::array::uniform2(-1.0..1.0_f64),
        u in prop::array::uniform4(-1.0..1.0_f64),
        v in prop::array::uniform4(-1.0..1.0_f64),
    ) {
        let q = Bent.old_coordinates(&new, 0.4);
        let map = PointTransformation::new(Bent, [0.0; 2]);
        let (image, jacobian) = image_and_jacobian(&map, &q, &p, 0.4).unwrap();
        assert_close_at_scale("Q", &image.as_slice()[..2], &new, 1.0, Tol::ulps(8.0));
        let carry = |w: [f64; 4]| &jacobian * nalgebra::DVector::from_row_slice(&w);
        let (carried_u, carried_v) = (carry(u), carry(v));
        let theta = (CanonicalOneForm.along(&p, &u[..2]), CanonicalOneForm.along(&image.as_slice()[2..], &carried_u.as_slice()[..2]));
        assert_close_at_scale("θ", &[theta.1], &[theta.0], 2.0, Tol::ulps(16.0));
        let omega = (CanonicalTwoForm.of(&u, &v), CanonicalTwoForm.of(carried_u.as_slice(), carried_v.as_slice()));
        assert_close_at_scale("ω", &[omega.1], &[omega.0], 8.0, Tol::ulps(16.0));
        let mut new_point = [0.0; 4];
        map.map(&q, &p, 0.4, &mut new_point).unwrap();
        assert_close("the image alone", &new_point, image.as_slice(), Tol::ulps(8.0));
    }
}

#[test]
fn the_canonical_two_form_pairs_the_natural_basis_as_the_text_says() {
    // W(8.22): ω(H_A, K^Γ) = −δ, ω(K^A, H_Γ) = δ; W(8.23): ω(H_A) = K_A, ω(K^A) = −H^A.
    let (h, k) = ([1.0, 0.0], [0.0, 1.0]);
    assert_eq!((CanonicalTwoForm.of(&h, &k), CanonicalTwoForm.of(&k, &h)), (-1.0, 1.0));
    let mut covector = [0.0; 2];
    CanonicalTwoForm.lower_into(&h, &mut covector);
    assert_eq!((covector[0], covector[1]), (0.0, 1.0));
    CanonicalTwoForm.lower_into(&k, &mut covector);
    assert_eq!((covector[0], covector[1]), (-1.0, 0.0));
    assert_eq!(raise(&covector).unwrap().as_slice(), k);
    assert!(closedness_residual(&CanonicalTwoForm, &[1.0, 2.0, 3.0, 4.0]).unwrap() <= 0.0);
}
