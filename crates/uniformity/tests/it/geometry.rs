//! Connections, torsion and curvature: identities over random bodies.

use nalgebra::{Matrix3, Vector3};
use piola_fields::compatibility::Curvature;
use piola_fields::{Coordinates, Cylindrical, Field, Material};
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_numerics::{Gradient, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_uniformity::{
    AffineConnection, CharacteristicMetric, ConnectionCoefficients, ConnectionIn, HomogeneousIn, LeviCivita,
    LieAlgebra, MaterialConnection, MaterialityResidual, MetricGeometry, UniformityMap,
};
use proptest::prelude::*;

use super::fixtures::{Turned, Vectors, Waves, point, waves};

/// Rounding through an inverse and two derivatives, of the sums of the terms.
const ROUNDING: Tol = Tol::ulps_because(512.0, "products of up to six factors of a few ulp each, through K⁻¹");

fn algebras() -> [LieAlgebra; 4] {
    let about = LieAlgebra::rotations_about(Vector3::new(1.0, 2.0, 2.0)).expect("axis");
    [LieAlgebra::trivial(), about, LieAlgebra::rotations(), LieAlgebra::unimodular()]
}

fn flat(components: &[[[f64; 3]; 3]; 3]) -> &[f64] {
    components.as_flattened().as_flattened()
}

/// A smooth connection without symmetry: the mean of two others.
struct Mean(Waves, Waves);

impl AffineConnection for Mean {
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        let [a, b] = [&self.0, &self.1].map(|map| MaterialConnection::of_crystal(*map).at(place).components);
        let half = T::lit(0.5);
        let mean = |c: usize, i: usize, j: usize| half * (a[c][i][j] + b[c][i][j]);
        ConnectionCoefficients { components: [0, 1, 2].map(|c| [0, 1, 2].map(|i| [0, 1, 2].map(|j| mean(c, i, j)))) }
    }
}

/// Coordinates that bend: X = q + ⅒ (q₂², sin q₁, q₁ q₃).
#[derive(Clone, Copy)]
struct Bent;

impl Coordinates for Bent {
    fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
        let tenth = T::lit(0.1);
        Vector3::new(q.x + tenth * q.y * q.y, q.y + tenth * q.x.sin(), q.z + tenth * q.x * q.z)
    }
}

fn jacobian(coordinates: &impl Coordinates, q: &Vector3<f64>) -> Matrix3<f64> {
    let x = coordinates.place(&Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(q[i], i)));
    Matrix3::from_fn(|i, j| x[i].partials[j])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn columns_of_the_map_are_parallel_for_a_crystal(map in waves(), x in point()) {
        struct Column(Waves, usize);
        impl Field for Column {
            type Value = Vector3<f64>;
            fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Vector3<T> {
                self.0.at(place).column(self.1).into_owned()
            }
        }
        let connection = MaterialConnection::of_crystal(map);
        for column in 0..3 {
            let derivative = connection.covariant_derivative(&Column(map, column), &x)?;
            prop_assert!(derivative.amax() <= Tol::ulps(64.0).value(), "{derivative}");
        }
    }

    #[test]
    fn curvature_of_a_crystal_vanishes(map in waves(), x in point()) {
        let curvature = MaterialConnection::of_crystal(map).curvature(&x)?;
        prop_assert!(0.0 < curvature.scale && curvature.relative() <= ROUNDING.value(), "{}", curvature.relative());
    }

    #[test]
    fn torsion_of_a_gradient_vanishes(motion in waves(), x in point()) {
        let torsion = MaterialConnection::of_crystal(HomogeneousIn(motion)).torsion(&x)?;
        prop_assert!(torsion.relative() <= Tol::ulps(64.0).value(), "{}", torsion.relative());
    }

    #[test]
    fn least_torsion_of_an_isotropic_solid_is_levi_civita(map in waves(), x in point()) {
        let isotropic = MaterialConnection::new(map, LieAlgebra::rotations()).coefficients(&x)?;
        let levi_civita = LeviCivita(CharacteristicMetric(map)).coefficients(&x)?;
        assert_close_at_scale("Γ", flat(&isotropic.components), flat(&levi_civita.components), 1.0, ROUNDING);
    }

    #[test]
    fn material_connections_are_material_and_others_are_not(map in waves(), other in waves(), x in point()) {
        for algebra in algebras() {
            let connection = MaterialConnection::new(map, algebra.clone());
            let residual = MaterialityResidual::of(&connection, &map, &algebra, &x)?;
            prop_assert!(residual.relative() <= ROUNDING.value(), "{}: {}", algebra.dimension(), residual.relative());
            let foreign = MaterialConnection::of_crystal(other);
            prop_assert!(1e-6 < MaterialityResidual::of(&foreign, &map, &algebra, &x)?.relative());
        }
    }

    #[test]
    fn least_torsion_does_not_exceed_that_of_other_material_connections(
        map in waves(), x in point(), turn in prop::array::uniform3(-1.0..1.0_f64)
    ) {
        // ω_D = turn_D × the generator: another material connection, with no less torsion in the crystal's frame.
        let algebra = LieAlgebra::rotations_about(Vector3::z())?;
        let k = map.value(&x)?;
        let inverse = from_rows(inverse_and_determinant(rows_of(&k)).0);
        let size = |gamma: &ConnectionCoefficients| {
            let y = gamma.torsion().transformed(&k).expect("K is a basis");
            flat(&y.components).iter().map(|y| y * y).sum::<f64>()
        };
        let least = MaterialConnection::new(map, algebra.clone()).coefficients(&x)?;
        let mut other = least;
        for (d, turn) in turn.iter().enumerate() {
            let change = k * algebra.basis()[0] * inverse * *turn;
            for c in 0..3 {
                for a in 0..3 {
                    other.components[c][a][d] += change[(c, a)];
                }
            }
        }
        prop_assert!(size(&least) <= size(&other) * (1.0 + 1e-12));
    }

    #[test]
    fn material_connection_of_a_solid_does_not_depend_on_the_choice_of_the_map(
        map in waves(), x in point(), rate in -2.0..2.0_f64
    ) {
        let axis = [2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0];
        let turned = Turned { map, rate, axis };
        for algebra in [LieAlgebra::rotations_about(Vector3::from(axis))?, LieAlgebra::rotations()] {
            let first = MaterialConnection::new(map, algebra.clone()).coefficients(&x)?;
            let second = MaterialConnection::new(turned, algebra).coefficients(&x)?;
            let scale = 1.0 + rate.abs();
            assert_close_at_scale("Γ", flat(&first.components), flat(&second.components), scale, ROUNDING);
        }
        // Without the symmetry the turn is seen.
        let first = MaterialConnection::of_crystal(map).coefficients(&x)?;
        let second = MaterialConnection::of_crystal(turned).coefficients(&x)?;
        let difference = flat(&first.components).iter().zip(flat(&second.components)).map(|(a, b)| (a - b).abs());
        prop_assert!(0.1 * rate.abs() <= difference.fold(0.0, f64::max));
    }

    #[test]
    fn torsion_and_curvature_transform_as_tensors(first in waves(), second in waves(), q in point()) {
        let connection = Mean(first, second);
        let moved = ConnectionIn { connection: &connection, coordinates: Bent };
        let (x, j) = (Bent.place(&q), jacobian(&Bent, &q));
        let (torsion, expected) = (moved.torsion(&q)?, connection.torsion(&x)?.transformed(&j)?);
        let scale = torsion.scale.max(expected.scale);
        assert_close_at_scale("Y", flat(&torsion.components), flat(&expected.components), scale, ROUNDING);
        let (curvature, expected) = (moved.curvature(&q)?, connection.curvature(&x)?.transformed(&j)?);
        let all = |components: &[[[[f64; 3]; 3]; 3]; 3]| components.as_flattened().as_flattened().as_flattened().to_vec();
        let scale = curvature.scale.max(expected.scale);
        assert_close_at_scale("R", &all(&curvature.components), &all(&expected.components), scale, ROUNDING);
        prop_assert!(1e-6 < curvature.relative());
    }

    #[test]
    fn coefficients_there_and_back_are_the_same(map in waves(), x in point()) {
        // X ↦ q ↦ X by the inverse of a shear that bends.
        struct Shear(f64);
        impl Coordinates for Shear {
            fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
                Vector3::new(q.x, q.y + T::lit(self.0) * q.x * q.x, q.z)
            }
        }
        let connection = MaterialConnection::of_crystal(map);
        let there = ConnectionIn { connection: &connection, coordinates: Shear(0.25) };
        let back = ConnectionIn { connection: &there, coordinates: Shear(-0.25) };
        let (first, last) = (connection.coefficients(&x)?, back.coefficients(&x)?);
        assert_close_at_scale("Γ", flat(&first.components), flat(&last.components), 1.0, ROUNDING);
    }

    #[test]
    fn curvature_of_a_connection_equals_the_curvature_of_its_metric(map in waves(), x in point()) {
        let metric = CharacteristicMetric(map);
        let geometry = MetricGeometry::of(&metric, &x)?;
        let reference = Curvature::of_metric(&Material(metric), &x, 0.0)?;
        let lowered = |a: usize, b: usize, c: usize, d: usize| -> f64 {
            // R_ABCD of the other convention is minus M_AE R^E_BCD.
            -(0..3).map(|e| geometry.metric.rows()[a][e] * geometry.riemann.components[e][b][c][d]).sum::<f64>()
        };
        for (a, b, c, d) in [(0, 1, 0, 1), (1, 2, 1, 2), (0, 2, 0, 2), (0, 1, 1, 2), (0, 1, 0, 2), (0, 2, 1, 2)] {
            let scale = 4.0 * geometry.riemann.scale;
            let expected = reference.riemann(a, b, c, d);
            assert_close_at_scale("R_ABCD", &[lowered(a, b, c, d)], &[expected], scale, ROUNDING);
        }
        let (ricci, scale) = (reference.ricci().matrix(), 4.0 * geometry.riemann.scale);
        assert_close_at_scale("Ric", geometry.ricci.as_slice(), ricci.as_slice(), scale, ROUNDING);
        assert_close_at_scale("R", &[geometry.scalar], &[reference.scalar()], 4.0 * scale, ROUNDING);
    }

    #[test]
    fn first_identity_of_bianchi_holds_with_torsion(first in waves(), second in waves(), x in point()) {
        // Σ R(X, Y)Z = Σ T(T(X, Y), Z) + (∇_X T)(Y, Z), cyclic (Kobayashi, Nomizu III.5); there T^c_ab = Y^c_ba, R(d, b) = −R_abd… .
        let connection = Mean(first, second);
        let lifted = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(x[i], i));
        let (torsion, gamma) = (connection.torsion(&lifted)?, connection.coefficients(&x)?.components);
        let curvature = connection.curvature(&x)?;
        // T(∂m, ∂n)^r and its covariant derivative along ∂l.
        let t = |r: usize, m: usize, n: usize| torsion.components[r][n][m].value;
        let slope = |l: usize, r: usize, m: usize, n: usize| {
            let along = torsion.components[r][n][m].partials[l];
            (0..3).fold(along, |sum, e| {
                sum + gamma[r][e][l] * t(e, m, n) - gamma[e][m][l] * t(r, e, n) - gamma[e][n][l] * t(r, m, e)
            })
        };
        let usual = |r: usize, z: usize, m: usize, n: usize| -curvature.components[r][z][m][n];
        for r in 0..3 {
            let (mut left, mut right) = (0.0, 0.0);
            for (l, m, n) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                left += usual(r, n, l, m);
                right += slope(l, r, m, n) + (0..3).map(|e| t(e, l, m) * t(r, e, n)).sum::<f64>();
            }
            let scale = 4.0 * curvature.scale + 1.0;
            assert_close_at_scale("Bianchi 1", &[left], &[right], scale, ROUNDING);
        }
    }

    #[test]
    fn second_identity_of_bianchi_holds_with_torsion(first in waves(), second in waves(), x in point()) {
        // Σ (∇_X R)(Y, Z) + R(T(X, Y), Z) = 0, cyclic.
        let connection = Mean(first, second);
        let lifted = Vector3::from_fn(|i, _| Gradient::<f64, 3>::variable(x[i], i));
        let curvature = connection.curvature(&lifted)?;
        let (gamma, torsion) = (connection.coefficients(&x)?.components, connection.torsion(&x)?);
        let t = |r: usize, m: usize, n: usize| torsion.components[r][n][m];
        let r = |c: usize, a: usize, m: usize, n: usize| -curvature.components[c][a][m][n].value;
        let slope = |l: usize, c: usize, a: usize, m: usize, n: usize| {
            let along = -curvature.components[c][a][m][n].partials[l];
            (0..3).fold(along, |sum, e| {
                sum + gamma[c][e][l] * r(e, a, m, n)
                    - gamma[e][a][l] * r(c, e, m, n)
                    - gamma[e][m][l] * r(c, a, e, n)
                    - gamma[e][n][l] * r(c, a, m, e)
            })
        };
        for c in 0..3 {
            for a in 0..3 {
                let mut sum = 0.0;
                for (l, m, n) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                    sum += slope(l, c, a, m, n) + (0..3).map(|e| t(e, l, m) * r(c, a, e, n)).sum::<f64>();
                }
                // Third derivatives of the map: sizes of the terms, one power of the wave number beyond R.
                let scale = 10.0 * (curvature.scale.value + 1.0);
                assert_close_at_scale("Bianchi 2", &[sum], &[0.0], scale, ROUNDING);
            }
        }
    }

    #[test]
    fn covariant_derivative_transforms_as_a_tensor(map in waves(), q in point()) {
        // u^c = ∂q^c/∂X^C u^C.
        struct Moved;
        impl Field for Moved {
            type Value = Vector3<f64>;
            fn at<T: Real>(&self, q: &Vector3<T>, t: T) -> Vector3<T> {
                let x = Bent.place(&Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(q[i], i)));
                let jacobian = [x[0].partials, x[1].partials, x[2].partials];
                let u = Vectors.at(&x.map(|x| x.value), t);
                Vector3::from(piola_numerics::linear::matrix3::solve_rows(jacobian, [u[0], u[1], u[2]]))
            }
        }
        let connection = MaterialConnection::of_crystal(map);
        let moved = ConnectionIn { connection: &connection, coordinates: Bent };
        let (x, j) = (Bent.place(&q), jacobian(&Bent, &q));
        let actual = moved.covariant_derivative(&Moved, &q)?;
        let inverse = j.try_inverse().expect("regular");
        let expected = inverse * connection.covariant_derivative(&Vectors, &x)? * j;
        assert_close_at_scale("∇u", actual.as_slice(), expected.as_slice(), 1.0, ROUNDING);
    }
}

#[test]
fn material_connection_in_cylindrical_coordinates_has_the_terms_of_the_metric() {
    // A homogeneous body: only the coordinates are curved. Γ^r_θθ = −r, Γ^θ_rθ = Γ^θ_θr = 1/r.
    let map = piola_uniformity::ConstantMap(Matrix3::new(2.0, 0.5, 0.0, 0.0, 1.0, 0.25, 0.0, 0.0, 1.5));
    let connection = MaterialConnection::of_crystal(map);
    let polar = ConnectionIn { connection, coordinates: Cylindrical };
    let gamma = polar.coefficients(&Vector3::new(2.5, 0.75, 1.0)).expect("off the axis").components;
    let mut expected = [[[0.0; 3]; 3]; 3];
    expected[0][1][1] = -2.5;
    (expected[1][0][1], expected[1][1][0]) = (0.4, 0.4);
    assert_close_at_scale("Γ", flat(&gamma), flat(&expected), 1.0, Tol::ulps(4.0));
    assert!(polar.coefficients(&Vector3::<f64>::zeros()).is_err(), "no basis on the axis");
}

/// Γ¹₁₁ = 2 X₂, Γ¹₁₂ = 3 X₁.
struct Linear;

impl AffineConnection for Linear {
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        let mut components = [[[T::zero(); 3]; 3]; 3];
        components[0][0][0] = T::lit(2.0) * place.y;
        components[0][0][1] = T::lit(3.0) * place.x;
        ConnectionCoefficients { components }
    }
}

#[test]
fn curvature_is_compared_with_the_moduli_of_its_terms() {
    // R¹₁₁₂ = ∂₂ Γ¹₁₁ − ∂₁ Γ¹₁₂ = 2 − 3; no products where Γ vanishes.
    let curvature = Linear.curvature(&Vector3::<f64>::zeros()).expect("R");
    let components = [curvature.components[0][0][0][1], curvature.components[0][0][1][0]];
    assert_close("R¹₁₁₂, R¹₁₂₁", &components, &[-1.0, 1.0], Tol::ulps(1.0));
    let sizes = [curvature.largest(), curvature.scale, curvature.relative()];
    assert_close("largest, scale, relative", &sizes, &[1.0, 5.0, 0.2], Tol::ulps(1.0));
}
