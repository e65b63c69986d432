//! Bodies: freedom of K, isomorphisms, stresses, Noll's equations.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use piola_continuum::DeformationGradient;
use piola_fields::integral::{Cuboid, Quadrature, StoredEnergy, strain_energy};
use piola_fields::{Body, Field, Material, Motion, Uniform};
use piola_numerics::Real;
use piola_solids::{Fibre, Hyperelastic, NeoHookeanLogarithmic, ReinforcedNeoHookean};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient};
use piola_uniformity::{
    AffineConnection, CharacteristicMetric, ConstantMap, LieAlgebra, MapOfMetric, MaterialConnection,
    MateriallyUniformBody, NollEquations, NominalGroup, StressInMotion, UniformityMap, isomorphism,
};
use proptest::prelude::*;

use super::fixtures::{Turned, Waves, point, waves};

/// μ and λ of `rubber`, Pa.
const SHEAR: f64 = 1.0;
const LAME: f64 = 2.0;

fn rubber() -> NeoHookeanLogarithmic {
    NeoHookeanLogarithmic::with_constants(SHEAR, LAME).expect("moduli")
}

/// A motion that bends, over X and t.
#[derive(Clone, Copy)]
struct Bending;

impl Motion for Bending {
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        let [x, y, z] = (*reference).into();
        let n = T::lit;
        Vector3::new(
            x + n(0.1) * y * y + n(0.05) * t * z,
            y + n(0.1) * (x + t).sin(),
            z * (T::one() + n(0.1) * x * t) + n(0.05) * x * y,
        )
    }
}

fn some_deformation(x: &Vector3<f64>) -> DeformationGradient {
    Bending.deformation_gradient(x, 1.5).expect("regular")
}

/// Rotations of a cube's group that two turns generate.
fn cubic() -> NominalGroup {
    let quarter = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let diagonal = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    NominalGroup::generated(&[quarter, diagonal], 24).expect("24 rotations")
}

/// A law of cubic symmetry: `W = Σ (λ_a² − 1)²` with `λ_a` the stretches of the crystal's axes, ⅛ μ each, and ½ μ Σ γ².
#[derive(Clone, Copy)]
struct Cubic;

impl Hyperelastic for Cubic {
    fn energy<T: Real>(&self, deformation: &impl piola_continuum::Deformation<T>) -> T {
        let f = deformation.gradient_rows();
        let c = |a: usize, b: usize| f[0][a] * f[0][b] + f[1][a] * f[1][b] + f[2][a] * f[2][b];
        let stretch = |a: usize| (c(a, a) - T::one()) * (c(a, a) - T::one());
        let shear = c(0, 1) * c(0, 1) + c(1, 2) * c(1, 2) + c(2, 0) * c(2, 0);
        T::lit(0.125) * (stretch(0) + stretch(1) + stretch(2)) + T::lit(0.5) * shear
    }
}

/// The reference density of a body whose crystal has 3 kg/m³.
struct Density<'a>(&'a MateriallyUniformBody<NeoHookeanLogarithmic, Waves>);
impl Field for Density<'_> {
    type Value = f64;
    fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> T {
        self.0.reference_density(T::lit(3.0), place).expect("regular")
    }
}

/// x = X.
struct Rest;
impl Motion for Rest {
    fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        *reference
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn response_is_the_same_for_every_choice_of_the_map(map in waves(), x in point(), rate in -2.0..2.0_f64) {
        // K H(X) with H in the group of the law: all rotations, those about an axis, a cube's.
        let f = some_deformation(&x);
        let axis = [2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0];
        let turned = Turned { map, rate, axis };
        let of = |law, map| MateriallyUniformBody { law, map };
        let isotropic = of(rubber(), map).cauchy(&f, &x)?.0.components;
        let again = MateriallyUniformBody { law: rubber(), map: turned }.cauchy(&f, &x)?.0.components;
        assert_close("isotropic", &again, &isotropic, Tol::ulps(256.0).or(Tol::stated(2e-13, "two products with K")));
        prop_assert!(isomorphism::freedom_defect(&map, &turned, &NominalGroup::Isotropic, &x)? < 1e-13);

        let fibre = ReinforcedNeoHookean::new(SHEAR, LAME, 3.0, Fibre::new(axis).expect("a direction")).expect("fibres");
        let reinforced = MateriallyUniformBody { law: fibre, map }.cauchy(&f, &x)?.0.components;
        let about = MateriallyUniformBody { law: fibre, map: turned }.cauchy(&f, &x)?.0.components;
        assert_close("fibres", &about, &reinforced, Tol::stated(5e-13, "two products with K"));
        let group = NominalGroup::transversely_isotropic(Vector3::from(axis))?;
        prop_assert!(isomorphism::freedom_defect(&map, &turned, &group, &x)? < 1e-13);
    }

    #[test]
    fn response_of_a_crystal_is_the_same_for_its_rotations_only(map in waves(), x in point(), k in 0..24_usize) {
        #[derive(Clone, Copy)]
        struct Chosen(Waves, Matrix3<f64>);
        impl UniformityMap for Chosen {
            fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
                self.0.at(reference) * self.1.map(T::lit)
            }
        }
        let NominalGroup::Finite(elements) = cubic() else { unreachable!("a finite group") };
        prop_assert_eq!(elements.len(), 24);
        let f = some_deformation(&x);
        let body = MateriallyUniformBody { law: Cubic, map };
        let expected = body.cauchy(&f, &x)?.0.components;
        let chosen = Chosen(map, elements[k]);
        let actual = MateriallyUniformBody { law: Cubic, map: chosen }.cauchy(&f, &x)?.0.components;
        assert_close_at_scale("T", &actual, &expected, 1.0, Tol::ulps(64.0));
        prop_assert!(isomorphism::freedom_defect(&map, &chosen, &cubic(), &x)? < 1e-13);
        // A turn by 45° is no symmetry, and is felt.
        let eighth = Rotation3::from_axis_angle(&Vector3::z_axis(), core::f64::consts::FRAC_PI_4).into_inner();
        let other = Chosen(map, eighth);
        prop_assert!(0.5 < isomorphism::freedom_defect(&map, &other, &cubic(), &x)?);
    }

    #[test]
    fn isomorphisms_carry_the_response_from_point_to_point(map in waves(), x in point(), y in point(), turn in -3.0..3.0_f64) {
        // G(F, Y) = G(F K(X, Y), X).
        let axis = Unit::new_normalize(Vector3::new(1.0, 2.0, -1.0));
        let h = Rotation3::from_axis_angle(&axis, turn).into_inner();
        let iso = isomorphism::of_element(&map, &x, &y, &h)?;
        let body = MateriallyUniformBody { law: rubber(), map };
        let f = some_deformation(&y);
        let at_y = body.cauchy(&f, &y)?.0.components;
        let at_x = body.cauchy(&DeformationGradient::new(f.matrix() * iso)?, &x)?.0.components;
        assert_close("G", &at_x, &at_y, Tol::stated(1e-12, "products with K, K⁻¹ and H"));
        prop_assert!(isomorphism::defect(&map, &NominalGroup::Isotropic, &x, &y, &iso)? < 1e-12);
        prop_assert!(1e-3 < isomorphism::defect(&map, &NominalGroup::Isotropic, &x, &y, &(iso * 1.01))?);
        // M-isometries are the isomorphisms of isotropic solids.
        let metric = CharacteristicMetric(map);
        let residual = isomorphism::isometry_residual(&metric, &x, &y, &iso)?;
        prop_assert!(residual.components.iter().all(|r| r.abs() < 1e-12));
        let stretched = isomorphism::isometry_residual(&metric, &x, &y, &(iso * 1.01))?;
        prop_assert!(stretched.components.iter().any(|r| 1e-3 < r.abs()));
    }

    #[test]
    fn stress_of_an_isotropic_solid_depends_on_the_metric_alone(map in waves(), x in point()) {
        // T = N(F K KᵀFᵀ): of the upper triangular root of M⁻¹ as of K.
        let f = some_deformation(&x);
        let expected = MateriallyUniformBody { law: rubber(), map }.cauchy(&f, &x)?.0;
        let of_metric = MapOfMetric(CharacteristicMetric(map));
        let actual = MateriallyUniformBody { law: rubber(), map: of_metric }.cauchy(&f, &x)?.0;
        assert_close("T", &actual.components, &expected.components, Tol::stated(1e-12, "the metric and its root"));
        // By hand: T = (μ (B − 1) + λ ln J)/J with B = F M⁻¹ Fᵀ.
        let inverse = CharacteristicMetric(map).inverse_at(&x)?.matrix();
        let b = f.matrix() * inverse * f.matrix().transpose();
        let j = b.determinant().sqrt();
        let by_hand = ((b - Matrix3::identity()) * SHEAR + Matrix3::identity() * (LAME * j.ln())) / j;
        assert_close("T", actual.matrix().as_slice(), by_hand.as_slice(), Tol::stated(1e-12, "B by hand"));
    }

    #[test]
    fn first_piola_is_the_derivative_of_the_energy(map in waves(), x in point()) {
        let body = MateriallyUniformBody { law: rubber(), map };
        let f = some_deformation(&x);
        let stress = body.first_piola(&f, &x)?.0;
        let direction = Matrix3::new(0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.2, 0.6, -0.1);
        let energy = |f: &[f64]| {
            let varied = DeformationGradient::new(Matrix3::from_column_slice(f)).expect("near");
            vec![body.energy(&varied, &x).expect("W")]
        };
        let slope = difference_quotient(energy, f.matrix().as_slice(), direction.as_slice());
        let tol = Tol::stated(1e-10, "differences of the sixth order");
        assert_close_at_scale("P", &[stress.dot(&direction)], &slope, 1.0, tol);
        // The same by the trait of integrals, and T = P Fᵀ/J.
        let of_trait = StoredEnergy::stress(&body, &x, f.matrix()).0;
        assert_close("P", of_trait.as_slice(), stress.as_slice(), Tol::ulps(8.0));
        let cauchy = stress * f.matrix().transpose() / f.matrix().determinant();
        let expected = body.cauchy(&f, &x)?.0.matrix();
        assert_close_at_scale("T", cauchy.as_slice(), expected.as_slice(), 1.0, Tol::ulps(64.0));
    }

    #[test]
    fn nolls_equations_equal_the_direct_divergence(map in waves(), x in point(), t in 0.0..1.0_f64) {
        let body = MateriallyUniformBody { law: rubber(), map };
        let force = Uniform(Vector3::new(0.5, -9.81, 1.0));
        let moving = Body { motion: Bending, reference_density: Density(&body) };
        let stress = Material(StressInMotion { body: &body, motion: &Bending });
        let direct = moving.momentum_residual(&stress, &Material(force), &x, t)?;
        // In every material connection: of a crystal, about an axis, of the metric.
        let about = LieAlgebra::rotations_about(Vector3::new(1.0, -2.0, 0.5))?;
        for algebra in [LieAlgebra::trivial(), about, LieAlgebra::rotations()] {
            let connection = MaterialConnection::new(map, algebra);
            let equations = NollEquations { body: &body, connection: &connection };
            let noll = equations.residual(&Bending, 3.0, &force, &x, t)?;
            let tol = Tol::ulps_because(256.0, "sums of 54 products of third order in K");
            assert_close_at_scale("Noll", noll.value.as_slice(), direct.value.as_slice(), noll.scale.amax(), tol);
            let divergence = equations.divergence(&Bending, &x, t)?;
            let density = body.reference_density(3.0, &x)?;
            let rest = (force.0 - Bending.acceleration(&x, t)?) * density;
            let sum = divergence.value + rest;
            assert_close_at_scale("Div P", sum.as_slice(), direct.value.as_slice(), noll.scale.amax(), tol);
        }
        // A connection that is not material leaves out a part of the divergence.
        let foreign = MaterialConnection::of_crystal(ConstantMap(Matrix3::identity()));
        let wrong = NollEquations { body: &body, connection: &foreign }.residual(&Bending, 3.0, &force, &x, t)?;
        prop_assert!(1e-6 < (wrong.value - direct.value).norm());
    }
}

#[test]
fn covariant_gradient_of_a_homogeneous_motion_is_minus_the_connection() {
    // x = X: ∇_D F^k_C = −Γ^k_CD.
    let map = super::fixtures::Golden::Smooth;
    let x = Vector3::new(0.5, -0.25, 0.75);
    let body = MateriallyUniformBody { law: rubber(), map };
    let connection = MaterialConnection::of_crystal(map);
    let equations = NollEquations { body: &body, connection: &connection };
    let gradient = equations.covariant_gradient(&Rest, &x, 0.0).expect("∇F");
    let gamma = connection.coefficients(&x).expect("Γ").components;
    for (a, b) in gradient.as_flattened().as_flattened().iter().zip(gamma.as_flattened().as_flattened()) {
        assert!((a + b).abs() <= f64::EPSILON * b.abs());
    }
    // 81 components of H, homogeneous of degree one in the moduli: those of N(F) at the natural state are Lamé's.
    let natural = MateriallyUniformBody { law: rubber(), map: ConstantMap(Matrix3::identity()) };
    let natural = NollEquations { body: &natural, connection: &connection };
    let h = natural.elasticity(&DeformationGradient::identity(), &x).expect("H");
    let (mu, lame) = (SHEAR, LAME);
    assert_close(
        "H",
        &[h[0][0][0][0], h[1][0][0][1], h[0][1][0][1], h[0][0][1][1]],
        &[lame + 2.0 * mu, lame, mu, mu],
        Tol::ulps(8.0),
    );
}

#[test]
fn energy_of_a_body_at_rest_is_that_of_its_residual_strain() {
    // A block whose crystal is compressed by 0.9 along X₁: W/det K times the volume.
    let map = ConstantMap(Matrix3::from_diagonal(&Vector3::new(0.9, 1.0, 1.0)));
    let body = MateriallyUniformBody { law: rubber(), map };
    let block = Cuboid::new(Vector3::zeros(), Vector3::new(2.0, 1.0, 1.0)).expect("a block");
    let energy: f64 =
        strain_energy(&Quadrature::of_degree(1).expect("a rule"), &block, &Rest, &body, 0.0).expect("energy");
    let crystal = rubber().energy(&DeformationGradient::diagonal([0.9, 1.0, 1.0]).expect("regular"));
    assert_close("W", &[energy], &[2.0 * crystal / 0.9], Tol::ulps(16.0));
    let density = body.reference_density(9.0, &Vector3::zeros()).expect("density");
    assert_close("ρ", &[density], &[10.0], Tol::ulps(2.0));
}
