//! Lagrangian and Eulerian frames: inversion with certificate, and the material derivative from both sides.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::Symmetric;
use piola_fields::FieldsError;
use piola_fields::{Eulerian, Field, FieldValue, Inversion, Material, Motion, Spatial, Uniform, ValueOf};
use piola_numerics::{Dual, Gradient, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::fixtures::{Column, Entry, Stress, Tensor, Wave, point, tensor, wave};

/// The components of a value of a field.
fn components<F: Field>(_: &F, value: &ValueOf<F, f64>) -> Vec<f64> {
    (0..F::Value::COMPONENTS).map(|i| F::Value::component(value, i)).collect()
}

/// Ψ̇ of a field in space, by its parts, along (v, 1) and along the motion.
fn check_material_derivative<F: Field + Copy>(
    field: F,
    motion: &Wave,
    x: &Vector3<f64>,
    t: f64,
) -> Result<(), FieldsError> {
    let (place, velocity) = (motion.position(x, t)?, motion.velocity(x, t)?);
    let spatial = Spatial(field);
    let slopes = spatial.gradient(&place, t)?.map(|slope| components(&field, &slope));
    let local = components(&field, &spatial.local_rate(&place, t)?);
    let parts: Vec<f64> = (0..local.len())
        .map(|i| local[i] + slopes[0][i] * velocity[0] + slopes[1][i] * velocity[1] + slopes[2][i] * velocity[2])
        .collect();
    let tol = Tol::ulps(32.0);
    let scale = 10.0;
    let eulerian = components(&field, &spatial.material_derivative(&Uniform(velocity), &place, t)?);
    assert_close_at_scale("∂Ψ/∂t + (grad Ψ) v", &eulerian, &parts, scale, tol);
    let lagrangian = components(&field, &spatial.rate_following(motion, x, t)?);
    assert_close_at_scale("Ψ̇ along the motion", &lagrangian, &parts, scale, tol);
    let followed = components(&field, &spatial.following(*motion).rate(x, t)?);
    assert_close_at_scale("∂Ψ/∂t at fixed X", &followed, &parts, scale, tol);
    Ok(())
}

/// ∂Ψ/∂t at fixed x plus (grad Ψ) v is the rate of a field of particles.
fn check_eulerian_parts<F: Field + Copy>(field: F, motion: &Wave, x: &Vector3<f64>, t: f64) -> Result<(), FieldsError> {
    let (space, material) = (Eulerian::new(motion), Material(field));
    let (place, velocity) = (motion.position(x, t)?, motion.velocity(x, t)?);
    let slopes = space.gradient(&material, &place, t)?.map(|slope| components(&field, &slope));
    let local = components(&field, &space.local_rate(&material, &place, t)?);
    let parts: Vec<f64> = (0..local.len())
        .map(|i| local[i] + slopes[0][i] * velocity[0] + slopes[1][i] * velocity[1] + slopes[2][i] * velocity[2])
        .collect();
    let rate = components(&field, &material.rate(x, t)?);
    // X is found to 8 ulp of |x| + |F| |X| times |F⁻¹|, and slopes of second order multiply that.
    let tol = Tol::ulps(512.0);
    assert_close_at_scale("Ψ̇", &parts, &rate, 10.0, tol);
    let there = components(&field, &space.material_derivative(&material, &place, t)?);
    assert_close_at_scale("Ψ̇ at x", &there, &rate, 10.0, tol);
    let value = components(&field, &space.field(&material, &place, t)?);
    assert_close_at_scale("Ψ(x)", &value, &components(&field, &material.value(x, t)?), 10.0, tol);
    Ok(())
}

/// x₁ = ln X₁, of the particles with 0 < X₁ alone.
struct Logarithmic;

impl Motion for Logarithmic {
    fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
        Vector3::new(reference.x.ln(), reference.y, reference.z)
    }
    fn check_domain<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Result<(), FieldsError> {
        let value = reference.x.primal(0);
        if 0.0 < value {
            return Ok(());
        }
        Err(FieldsError::OutsideSamples { quantity: "X1", value, low: 0.0, high: f64::INFINITY })
    }
}

#[test]
fn steps_that_leave_the_body_are_halved_until_they_stay_in_it() {
    // From X₁ = 3 the step to ln X₁ = −5 would end at 3 − 3 (5 + ln 3) = −15.3.
    let (place, guess) = (Vector3::new(-5.0, 0.0, 0.0), Vector3::new(3.0, 0.0, 0.0));
    let found = Inversion::default().preimage_near(&Logarithmic, &place, 0.0, &guess).expect("a particle");
    assert_close("X", found.reference.as_slice(), &[(-5.0_f64).exp(), 0.0, 0.0], Tol::ulps(64.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn particle_found_at_its_place_equals_itself_within_the_certificate(
        motion in wave(), x in point(), t in -2.0..2.0_f64
    ) {
        let place = motion.position(&x, t)?;
        let found = Inversion::default().preimage(&motion, &place, t)?;
        let error = (found.reference - x).amax();
        prop_assert!(error <= found.error_bound, "{error:e} > {:e}", found.error_bound);
        // 8 ulp of |x| + |F| |X|, times |F⁻¹|.
        prop_assert!(found.error_bound < 1e-13, "{:e}", found.error_bound);
        prop_assert!(found.iterations <= 12, "{}", found.iterations);
        // u(x, t) is u(X, t), B(4.15).
        let u = Eulerian::new(&motion).displacement(&place, t)?;
        let tol = Tol::stated(found.error_bound, "the certificate of X, through ∇u of modulus below one");
        assert_close_at_scale("u", u.as_slice(), (place - x).as_slice(), 1.0, tol);
    }

    #[test]
    fn gradient_of_the_inverse_equals_inverse_of_the_gradient(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        let place = motion.position(&x, t)?;
        let f = *motion.deformation_gradient(&x, t)?.matrix();
        let variables = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(place[i], i));
        let found = Inversion::default().preimage(&motion, &variables, Gradient::constant(t))?;
        let inverse = Matrix3::from_fn(|i, j| found.reference[i].partials[j]);
        let tol = Tol::ulps(512.0);
        assert_close("∂X/∂x ∂x/∂X", (inverse * f).as_slice(), Matrix3::identity().as_slice(), tol);
        // The velocity field in space has the gradient L, W(14.21), and its rate with convection is a, W(14.18).
        let space = Eulerian::new(&motion);
        let v = space.velocity(&variables, Gradient::constant(t))?;
        let l = Matrix3::from_fn(|i, j| v[i].partials[j]);
        assert_close_at_scale("L", l.as_slice(), motion.velocity_gradient(&x, t)?.as_slice(), 1.0, tol);
        let along = space.velocity(&place.map(Dual::constant), Dual::variable(t))?.map(|v| v.tangent);
        let acceleration = along + l * motion.velocity(&x, t)?;
        assert_close_at_scale("a", acceleration.as_slice(), motion.acceleration(&x, t)?.as_slice(), 1.0, tol);
        let at_place = space.acceleration(&place, t)?;
        assert_close_at_scale("a(x)", at_place.as_slice(), motion.acceleration(&x, t)?.as_slice(), 1.0, tol);
    }

    #[test]
    fn second_derivatives_of_the_inverse_equal_those_of_the_identity(
        motion in wave(), x in point(), t in -2.0..2.0_f64
    ) {
        // x(X(x)) = x to second order in x along a line.
        let place = motion.position(&x, t)?;
        let line = Vector3::from_fn(|i, _| Dual::new(Dual::new(place[i], 1.0), Dual::constant(1.0)));
        let time = Dual::constant(Dual::constant(t));
        let found = Inversion::default().preimage(&motion, &line, time)?.reference;
        let back = motion.place(&found, time);
        assert_close("first", back.map(|x| x.value.tangent).as_slice(), &[1.0; 3], Tol::ulps(64.0));
        assert_close_at_scale("second", back.map(|x| x.tangent.tangent).as_slice(), &[0.0; 3], 1.0, Tol::ulps(64.0));
    }

    #[test]
    fn lanes_of_the_inversion_equal_its_scalars(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        type Four = Lanes<f64, 4>;
        let places = [0.0, 0.25, -0.5, 1.0].map(|shift| motion.place(&x.add_scalar(shift), t));
        let lanes = Vector3::from_fn(|i, _| Four::from([0, 1, 2, 3].map(|lane: usize| places[lane][i])));
        let found = Inversion::default().preimage(&motion, &lanes, Four::lit(t))?;
        for (lane, place) in places.iter().enumerate() {
            let alone = Inversion::default().preimage(&motion, place, t)?;
            let difference = (found.reference.map(|x| x.primal(lane)) - alone.reference).amax();
            prop_assert!(difference <= alone.error_bound + found.error_bound.primal(lane));
        }
    }

    #[test]
    fn material_derivative_in_space_equals_rate_along_the_motion(
        motion in wave(), x in point(), t in -2.0..2.0_f64, psi in tensor()
    ) {
        check_material_derivative(Entry(psi), &motion, &x, t)?;
        check_material_derivative(Column(psi), &motion, &x, t)?;
        check_material_derivative(psi, &motion, &x, t)?;
        check_material_derivative(Stress(psi), &motion, &x, t)?;
    }

    #[test]
    fn rate_of_a_field_of_particles_equals_its_parts_in_space(
        motion in wave(), x in point(), t in -2.0..2.0_f64, psi in tensor()
    ) {
        check_eulerian_parts(Entry(psi), &motion, &x, t)?;
        check_eulerian_parts(psi, &motion, &x, t)?;
    }
}

#[test]
fn field_and_its_values_have_the_same_components() {
    let tensor = Tensor { coefficients: [1.0; 9] };
    let place = Vector3::new(0.1, 0.2, 0.3);
    let (m, s) = (tensor.at(&place, 0.0), Stress(tensor).at(&place, 0.0).0);
    assert_close("Matrix3", &components(&tensor, &m), m.transpose().as_slice(), Tol::ulps(0.5));
    let again: Symmetric<f64> = <Symmetric as FieldValue>::from_components(|i| s.components[i]);
    assert_close("Symmetric", &again.components, &s.components, Tol::ulps(0.5));
}

proptest! {
    #[test]
    fn particles_within_the_radius_of_uniqueness_have_places_of_their_own(
        motion in wave(), x in point(), y in point(), z in point(), t in -2.0..2.0_f64
    ) {
        let found = Inversion::default().preimage(&motion, &motion.position(&x, t)?, t)?;
        let radius = found.uniqueness_radius(&motion, t, 4.0)?;
        prop_assert!(found.error_bound < radius);
        let (y, z) = (found.reference + y * radius, found.reference + z * radius);
        let inverse = motion.deformation_gradient(&found.reference, t)?.inverse()?;
        // |F⁻¹(X) (x(Y) − x(Z))| ≥ (1 − κ) |Y − Z| with κ = ½ at the points sampled, less than 1 between them.
        let apart = (inverse.matrix() * (motion.position(&y, t)? - motion.position(&z, t)?)).amax();
        prop_assert!(0.25 * (y - z).amax() <= apart, "{apart} for {}", (y - z).amax());
    }
}
