//! Curvilinear coordinates against Cartesian ones: explicit forms, any orthogonal system, the general metric.

use nalgebra::{Matrix3, Vector3};
use piola_fields::FieldsError;
use piola_fields::{
    Cartesian, Coordinates, Cylindrical, Field, PhysicalFrame, Spherical, Uniform, equilibrium_residual,
};
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_numerics::{Gradient, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::fixtures::{ByHand, Column, Entry, Physical, Tensor, tensor};

impl ByHand for Cartesian {
    fn directions<T: Real>(&self, _q: &Vector3<T>) -> Matrix3<T> {
        let (o, l) = (T::zero(), T::one());
        Matrix3::new(l, o, o, o, l, o, o, o, l)
    }
}

impl ByHand for Cylindrical {
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T> {
        let ((s, c), o, l) = (q[1].sin_cos(), T::zero(), T::one());
        Matrix3::new(c, s, o, -s, c, o, o, o, l)
    }
}

impl ByHand for Spherical {
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T> {
        let ((s, c), (sp, cp)) = (q[1].sin_cos(), q[2].sin_cos());
        Matrix3::new(sp * c, sp * s, cp, -s, c, T::zero(), cp * c, cp * s, -sp)
    }
}

/// Parabolic cylindrical: x = (½(u² − v²), u v, z).
#[derive(Clone, Copy, Debug)]
struct Parabolic;

impl Coordinates for Parabolic {
    fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
        Vector3::new(T::lit(0.5) * (q[0] * q[0] - q[1] * q[1]), q[0] * q[1], q[2])
    }
}

impl ByHand for Parabolic {
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T> {
        let (h, o) = ((q[0] * q[0] + q[1] * q[1]).sqrt(), T::zero());
        Matrix3::new(q[0] / h, q[1] / h, o, -q[1] / h, q[0] / h, o, o, o, T::one())
    }
}

/// Elliptic cylindrical: x = (a cosh μ cos ν, a sinh μ sin ν, z).
#[derive(Clone, Copy, Debug)]
struct Elliptic {
    focus: f64,
}

impl Coordinates for Elliptic {
    fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
        let (a, (s, c)) = (T::lit(self.focus), q[1].sin_cos());
        Vector3::new(a * q[0].cosh() * c, a * q[0].sinh() * s, q[2])
    }
}

impl ByHand for Elliptic {
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T> {
        let ((s, c), sh, ch) = (q[1].sin_cos(), q[0].sinh(), q[0].cosh());
        let (h, o) = ((sh * sh + s * s).sqrt(), T::zero());
        Matrix3::new(sh * c / h, ch * s / h, o, -(ch * s) / h, sh * c / h, o, o, o, T::one())
    }
}

/// Toroidal: ρ = a sinh τ/D, z = a sin σ/D, D = cosh τ − cos σ, in the order τ, σ, azimuth.
#[derive(Clone, Copy, Debug)]
struct Toroidal {
    focus: f64,
}

impl Coordinates for Toroidal {
    fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
        let ((ss, cs), (s, c)) = (q[1].sin_cos(), q[2].sin_cos());
        let factor = T::lit(self.focus) / (q[0].cosh() - cs);
        Vector3::new(factor * q[0].sinh() * c, factor * q[0].sinh() * s, factor * ss)
    }
}

impl ByHand for Toroidal {
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T> {
        let ((ss, cs), (s, c)) = (q[1].sin_cos(), q[2].sin_cos());
        let (sh, ch) = (q[0].sinh(), q[0].cosh());
        let d = ch - cs;
        let (along, across) = ((T::one() - ch * cs) / d, -(ss * sh) / d);
        Matrix3::new(along * c, along * s, across, across * c, across * s, -along, -s, c, T::zero())
    }
}

/// A system without right angles.
#[derive(Clone, Copy, Debug)]
struct Oblique;

impl Coordinates for Oblique {
    fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
        let c = T::lit;
        Vector3::new(
            q[0] + c(0.3) * q[1] * q[1] + c(0.2) * q[2],
            q[1] + c(0.2) * q[0] * q[2],
            q[2] + c(0.1) * q[0] * q[1],
        )
    }
}

/// gᵢ by hand, in the columns of ∂x/∂q.
fn oblique_jacobian<T: Real>(q: &Vector3<T>) -> [[T; 3]; 3] {
    let c = T::lit;
    [[c(1.0), c(0.6) * q[1], c(0.2)], [c(0.2) * q[2], c(1.0), c(0.2) * q[0]], [c(0.1) * q[1], c(0.1) * q[0], c(1.0)]]
}

/// Tⁱʲ and vⁱ of Cartesian fields in the oblique system.
struct Contravariant(Tensor);

impl Contravariant {
    fn tensor<T: Real>(&self, q: &Vector3<T>, time: T) -> Matrix3<T> {
        let inverse = from_rows(inverse_and_determinant(oblique_jacobian(q)).0);
        inverse * self.0.at(&Oblique.place(q), time) * inverse.transpose()
    }
    fn vector<T: Real>(&self, q: &Vector3<T>, time: T) -> Vector3<T> {
        let inverse = from_rows(inverse_and_determinant(oblique_jacobian(q)).0);
        inverse * Column(self.0).at(&Oblique.place(q), time)
    }
}

/// Divergence, gradient and Laplacian in one system against those by hand in Cartesian coordinates.
fn check<C: ByHand>(system: C, field: Tensor, q: &Vector3<f64>, t: f64) -> Result<(), FieldsError> {
    let (x, e) = (system.place(q), system.directions(q));
    let tol = Tol::ulps(64.0);

    let tensor = Physical { system, field };
    let residual = equilibrium_residual(&system, &tensor, &Uniform(Vector3::zeros()), q, t)?;
    let expected = e * field.divergence(&x, t);
    let scale = residual.scale.amax();
    let divergence = system.divergence(&tensor, q, t)?;
    assert_close_at_scale("div T", divergence.as_slice(), expected.as_slice(), scale, tol);
    assert_close_at_scale("div T with scale", residual.value.as_slice(), expected.as_slice(), scale, tol);

    let vector = Physical { system, field: Column(field) };
    let slopes = Matrix3::from_fn(|i, j| field.slope(&x, t, i, 0, j));
    let expected = e * slopes * e.transpose();
    let h = system.scale_factors(q)?;
    // Components turn with the basis: what cancels is of the size v/h.
    let size = vector.at(q, t).amax();
    let scale = slopes.amax() + size * h.iter().fold(0.0_f64, |largest, h| largest.max(1.0 / h));
    let gradient = system.vector_gradient(&vector, q, t)?;
    assert_close_at_scale("grad v", gradient.as_slice(), expected.as_slice(), 4.0 * scale, tol);
    let divergence = system.vector_divergence(&vector, q, t)?;
    assert_close_at_scale("div v", &[divergence], &[slopes.trace()], 4.0 * scale, tol);

    let scalar = Physical { system, field: Entry(field) };
    let slope = Vector3::from_fn(|k, _| field.slope(&x, t, 2, 2, k));
    let gradient = system.scalar_gradient(&scalar, q, t)?;
    assert_close_at_scale("grad f", gradient.as_slice(), (e * slope).as_slice(), slope.amax(), tol);
    // f = c (z² + sin(y + t)) + x
    let laplacian = field.coefficients[8] * (2.0 - (x.y + t).sin());
    let local = system.local_basis(q)?;
    let second = local.inverse_metric().components.iter().fold(0.0_f64, |largest, g| largest.max(g.abs()));
    let scale = (1.0 + slope.amax()) * second.max(1.0) * h.iter().fold(1.0_f64, |largest, h| largest.max(*h)).powi(2);
    assert_close_at_scale("Δf", &[system.laplacian(&scalar, q, t)?], &[laplacian], scale, tol);

    check_explicit_form(&system, &tensor, &vector, q, t)
}

/// The explicit form of a system equals the one by curvatures of its coordinate lines and by Christoffel's symbols.
fn check_explicit_form<C: ByHand>(
    system: &C,
    tensor: &Physical<C, Tensor>,
    vector: &Physical<C, Column>,
    q: &Vector3<f64>,
    t: f64,
) -> Result<(), FieldsError> {
    let (tol, local) = (Tol::ulps(64.0), system.local_basis(q)?);
    let frame: PhysicalFrame = local.physical_frame()?;
    let variables = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(q[i], i));
    let value = tensor.at(&variables, Gradient::constant(t));
    let rows = |part: &dyn Fn(&Gradient<f64, 3>) -> f64| rows_of(&value.map(|x| part(&x)));
    let (plain, partials) = (rows(&|x| x.value), [0, 1, 2].map(|k: usize| rows(&|x| x.partials[k])));
    let explicit = system.divergence_terms(q, &plain, &partials)?;
    let general = frame.divergence_terms(&plain, &partials);
    for i in 0..3 {
        let scale = general[i].scale.max(explicit[i].scale);
        assert_close_at_scale("explicit", &[explicit[i].value], &[general[i].value], scale, tol);
    }
    // The same with contravariant components Tⁱʲ = Tᵢⱼ/(hᵢhⱼ).
    let h = frame.scale_factors;
    let contravariant = contravariant_partials(&frame, &plain, &partials);
    let raised = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| plain[i][j] / (h[i] * h[j])));
    let divergence = local.tensor_divergence(&raised, &contravariant);
    for i in 0..3 {
        let largest = general.iter().fold(0.0_f64, |largest, term| largest.max(term.scale));
        assert_close_at_scale("Christoffel", &[divergence[i] * h[i]], &[general[i].value], largest, Tol::ulps(256.0));
    }

    let value = vector.at(&variables, Gradient::constant(t));
    let (v, slopes) = (value.map(|x| x.value), [0, 1, 2].map(|k: usize| value.map(|x| x.partials[k]).into()));
    let explicit = system.gradient_from_partials(q, &v.into(), &slopes)?;
    let general = frame.gradient(&v.into(), &slopes);
    let scale = general.as_flattened().iter().fold(v.amax(), |largest, x| largest.max(x.abs()))
        + frame.curvatures.as_flattened().iter().fold(0.0_f64, |largest, k| largest.max(k.abs())) * v.amax();
    assert_close_at_scale("explicit grad v", explicit.as_flattened(), general.as_flattened(), scale, tol);
    Ok(())
}

/// ∂ₖ(Tᵢⱼ/(hᵢhⱼ)) with ∂ₖhᵢ = κᵢₖ hᵢ hₖ; for k = i, hᵢ is differentiated by hand of its definition.
fn contravariant_partials(
    frame: &PhysicalFrame,
    tensor: &[[f64; 3]; 3],
    partials: &[[[f64; 3]; 3]; 3],
) -> [[[f64; 3]; 3]; 3] {
    let (h, kappa) = (frame.scale_factors, frame.curvatures);
    let growth = |i: usize, k: usize| kappa[i][k] * h[k];
    [0, 1, 2].map(|k: usize| {
        [0, 1, 2].map(|i: usize| {
            [0, 1, 2].map(|j: usize| {
                let change = tensor[i][j] * (growth(i, k) + growth(j, k));
                // The growth of hₖ along its own line cancels in the divergence and is left out on both sides.
                (partials[k][i][j] - change) / (h[i] * h[j])
            })
        })
    })
}

fn angle() -> impl Strategy<Value = f64> + Clone {
    -3.0..3.0_f64
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn cylindrical_operators_equal_cartesian_ones(
        f in tensor(), r in 0.05..3.0_f64, theta in angle(), z in -1.0..1.0_f64, t in -1.0..1.0_f64
    ) {
        check(Cylindrical, f, &Vector3::new(r, theta, z), t)?;
    }

    #[test]
    fn spherical_operators_equal_cartesian_ones(
        f in tensor(), r in 0.05..3.0_f64, theta in angle(), phi in 0.05..3.09_f64, t in -1.0..1.0_f64
    ) {
        check(Spherical, f, &Vector3::new(r, theta, phi), t)?;
    }

    #[test]
    fn cartesian_operators_equal_those_by_hand(
        f in tensor(), q in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], t in -1.0..1.0_f64
    ) {
        check(Cartesian, f, &Vector3::from(q), t)?;
    }

    #[test]
    fn parabolic_divergence_equals_cartesian_one(
        f in tensor(), u in 0.2..2.0_f64, v in 0.2..2.0_f64, z in -1.0..1.0_f64, t in -1.0..1.0_f64
    ) {
        check_divergence(Parabolic, f, &Vector3::new(u, v, z), t)?;
    }

    #[test]
    fn elliptic_divergence_equals_cartesian_one(
        f in tensor(), mu in 0.2..1.5_f64, nu in angle(), z in -1.0..1.0_f64, t in -1.0..1.0_f64
    ) {
        check_divergence(Elliptic { focus: 0.7 }, f, &Vector3::new(mu, nu, z), t)?;
    }

    #[test]
    fn toroidal_divergence_equals_cartesian_one(
        f in tensor(), tau in 0.3..2.0_f64, sigma in 0.5..3.0_f64, phi in angle(), t in -1.0..1.0_f64
    ) {
        check_divergence(Toroidal { focus: 1.3 }, f, &Vector3::new(tau, sigma, phi), t)?;
    }

    #[test]
    fn covariant_derivatives_in_oblique_coordinates_equal_cartesian_ones(
        f in tensor(), q in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], t in -1.0..1.0_f64
    ) {
        let q = Vector3::from(q);
        let (x, local, field) = (Oblique.place(&q), Oblique.local_basis(&q)?, Contravariant(f));
        let variables = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(q[i], i));
        let tol = Tol::ulps(256.0);

        let value = field.tensor(&variables, Gradient::constant(t));
        let rows = |k: usize| rows_of(&value.map(|x| x.partials[k]));
        let raised = rows_of(&value.map(|x| x.value));
        let divergence = local.vector_to_cartesian(&local.tensor_divergence(&raised, &[rows(0), rows(1), rows(2)]));
        let scale = 10.0 * (1.0 + raised.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs())));
        assert_close_at_scale("div T", divergence.as_slice(), f.divergence(&x, t).as_slice(), scale, tol);
        let back = local.tensor_to_cartesian(&raised);
        assert_close("T", from_rows(back).as_slice(), f.at(&x, t).as_slice(), tol);
        assert_close("Tⁱʲ", local.tensor_from_cartesian(&back).as_flattened(), raised.as_flattened(), tol);

        let value = field.vector(&variables, Gradient::constant(t));
        let (v, slopes) = (value.map(|x| x.value), [0, 1, 2].map(|k: usize| value.map(|x| x.partials[k])));
        // ∇ⱼvⁱ gᵢ⊗gʲ in Cartesian components.
        let (basis, dual) = (from_rows(local.basis), from_rows(local.dual));
        let gradient = basis.transpose() * local.vector_gradient(&v, &slopes) * dual;
        let expected = Matrix3::from_fn(|i, j| f.slope(&x, t, i, 0, j));
        assert_close_at_scale("grad v", gradient.as_slice(), expected.as_slice(), scale, tol);
        let divergence = local.vector_divergence(&v, &slopes);
        assert_close_at_scale("div v", &[divergence], &[expected.trace()], scale, tol);
        let metric = local.metric().matrix() * local.inverse_metric().matrix();
        assert_close("g g⁻¹", metric.as_slice(), Matrix3::identity().as_slice(), tol);
        let slope = Vector3::from_fn(|k, _| f.slope(&x, t, 2, 2, k));
        let laplacian = Oblique.laplacian(&Pulled(Entry(f)), &q, t)?;
        let expected = f.coefficients[8] * (2.0 - (x.y + t).sin());
        assert_close_at_scale("Δf", &[laplacian], &[expected], 10.0 * (1.0 + slope.amax()), tol);
    }

    #[test]
    fn lanes_of_the_divergence_equal_its_scalars(
        f in tensor(), r in 0.5..3.0_f64, theta in angle(), phi in 0.2..2.9_f64, t in -1.0..1.0_f64
    ) {
        type Four = Lanes<f64, 4>;
        let field = Physical { system: Spherical, field: f };
        let q = Vector3::new(r, theta, phi);
        let lanes = Spherical.divergence(&field, &q.map(Four::lit), Four::lit(t))?;
        let residual = equilibrium_residual(&Spherical, &field, &Uniform(Vector3::zeros()), &q, t)?;
        let scalar = Spherical.divergence(&field, &q, t)?;
        let lane = lanes.map(|x| x.primal(3));
        assert_close_at_scale("lanes", lane.as_slice(), scalar.as_slice(), residual.scale.amax(), Tol::ulps(64.0));
    }
}

/// A Cartesian scalar as a function of oblique coordinates.
struct Pulled(Entry);

impl Field for Pulled {
    type Value = f64;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> T {
        self.0.at(&Oblique.place(q), time)
    }
}

/// Divergence in any orthogonal system.
fn check_divergence<C: ByHand>(system: C, field: Tensor, q: &Vector3<f64>, t: f64) -> Result<(), FieldsError> {
    let (x, e) = (system.place(q), system.directions(q));
    let frame = system.physical_frame(q)?;
    assert_close("eᵢ", from_rows(frame.directions).as_slice(), e.as_slice(), Tol::ulps(64.0));
    let tensor = Physical { system, field };
    let residual = equilibrium_residual(&system, &tensor, &Uniform(Vector3::zeros()), q, t)?;
    let expected = e * field.divergence(&x, t);
    let tol = Tol::ulps(128.0);
    let scale = residual.scale.amax();
    assert_close_at_scale("div T", residual.value.as_slice(), expected.as_slice(), scale, tol);
    let cartesian = frame.vector_to_cartesian(&residual.value);
    assert_close_at_scale("div T", cartesian.as_slice(), field.divergence(&x, t).as_slice(), scale, tol);
    let turned = frame.tensor_to_cartesian(&rows_of(&tensor.at(q, t)));
    assert_close("T", from_rows(turned).as_slice(), field.at(&x, t).as_slice(), tol);
    assert_close(
        "T",
        frame.tensor_from_cartesian(&turned).as_flattened(),
        rows_of(&tensor.at(q, t)).as_flattened(),
        tol,
    );
    let vector = Column(field).at(&x, t);
    let there_and_back = frame.vector_to_cartesian(&frame.vector_from_cartesian(&vector));
    assert_close("v", there_and_back.as_slice(), vector.as_slice(), tol);
    Ok(())
}
