//! Every request gives at a point what the one-point interface gives.

use nalgebra::{Matrix3, Vector3};
use piola_batch as batch;
use piola_batch::{Destination, Quantity, Request, Source};
use piola_continuum::rates::strain::{GreenStrainRate, self as strain_rates};
use piola_continuum::{rates::{GradientRate, StretchRates, VelocityGradient}, stress::rates::{GreenNaghdiRate, JaumannRate, LogarithmicRate, LowerConvectedRate, MaterialRate, TruesdellRate, UpperConvectedRate}};
use piola_continuum::polar::StretchAnalysis;
use piola_tensor::spectral::{SquareRoot, derivative, tensor_function};
use piola_continuum::strain::invariants as strain_invariants;
use piola_continuum::strain::{AlmansiStrain, BiotStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, LinearStrain, RightCauchyGreen, RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain, SpatialSethHillStrain};
use piola_continuum::stress::tangents::{FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::stress::{HaighWestergaard, PrincipalStresses, gradients, invariants};
use piola_continuum::deformation::transport;
use piola_tensor::{FourthOrder, MajorSymmetric, MinorSymmetric};
use piola_continuum::{BiotStress, CauchyStress, Deformation, DeformationGradient, FirstPiola, KirchhoffStress, MandelStress, ReferenceNormal, SecondPiola, Symmetric, UnitNormal};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

use super::cases::deformations;

/// Rows one after the other.
pub(super) fn flat(matrix: &Matrix3<f64>) -> [f64; 9] {
    let rows = rows_of(matrix);
    std::array::from_fn(|k| rows[k / 3][k % 3])
}

pub(super) fn flat_rows(rows: [[f64; 3]; 3]) -> [f64; 9] {
    std::array::from_fn(|k| rows[k / 3][k % 3])
}

/// The same formula, called in two ways.
pub(super) fn same<Q, S, V, const I: usize, const K: usize>(
    request: &Request<Q, S, V, I, K>,
    deformation: &DeformationGradient,
    expected: [f64; K],
) where
    Q: Quantity<I, K> + core::fmt::Debug,
    S: Source<Q::Input, f64, I>,
    V: Destination<Q::Output, f64, K>,
{
    let found = request.at(deformation, 0);
    assert_close(core::any::type_name::<Q>(), &found, &expected, Tol::ulps(1.0));
}

/// Requests that need no destination of some type.
macro_rules! all {
    ($f:ident: $($function:ident($($argument:expr),*) = $expected:expr;)*) => { $(
        same(&batch::$function($($argument,)* &mut [[0.0; _]; 0][..]), $f, $expected);
    )* };
}
pub(super) use all;

#[test]
fn measures_of_deformation_equal_those_of_one_point() {
    for f in &deformations(97) {
        let stretch = StretchAnalysis::of(f);
        all! { f:
            jacobian() = [f.jacobian()];
            volume_change() = [f.volume_change()];
            ln_jacobian() = [f.ln_jacobian()];
            inverse() = flat_rows(f.inverse_rows());
            cofactor() = flat_rows(f.cofactor_rows());
            right_cauchy_green() = RightCauchyGreen::of(f).0.components;
            right_cauchy_green_less_one() = RightCauchyGreen::minus_one(f).components;
            left_cauchy_green() = LeftCauchyGreen::of(f).0.components;
            left_cauchy_green_less_one() = LeftCauchyGreen::minus_one(f).components;
            green_strain() = GreenStrain::of(f).0.components;
            almansi_strain() = AlmansiStrain::of(f).0.components;
            linear_strain() = LinearStrain::of(f).0.components;
            engineering_strain() = LinearStrain::of(f).engineering();
            strain_invariants() =
                [strain_invariants::first(f), strain_invariants::second(f), strain_invariants::third(f)];
            strain_invariants_less_reference() = [
                strain_invariants::first_minus_three(f),
                strain_invariants::second_minus_three(f),
                strain_invariants::third_minus_one(f),
            ];
            isochoric_invariants_less_three() = [
                strain_invariants::isochoric_first_minus_three(f),
                strain_invariants::isochoric_second_minus_three(f),
            ];
            rotation() = flat_rows(Rotation::of(f).rows());
            right_stretch() = RightStretch::of(f).0.components;
            right_stretch_less_one() = BiotStrain::of(f).0.components;
            inverse_right_stretch() = stretch.inverse_right_stretch().components;
            left_stretch() = LeftStretch::of(f).0.components;
            left_stretch_less_one() = stretch.left_stretch_less_one().components;
            inverse_left_stretch() = stretch.inverse_left_stretch().components;
            hencky() = HenckyStrain::of(f).0.components;
            hencky_spatial() = SpatialHenckyStrain::of(f).0.components;
            principal_stretches() = stretch.principal_stretches();
            log_principal_stretches() = stretch.log_principal_stretches();
            principal_green_strains() = stretch.principal_green_strains();
            material_axes() = flat_rows(stretch.material_axes());
            spatial_axes() = flat_rows(stretch.spatial_axes());
            seth_hill_strain(SethHill::ALMANSI) = SethHillStrain::of(f, SethHill::ALMANSI).tensor.components;
            seth_hill_strain_spatial(SethHill::GREEN) = SpatialSethHillStrain::of(f, SethHill::GREEN).tensor.components;
        }
    }
}

#[test]
fn conversions_equal_those_of_one_point() {
    let mut random = Random::new(11);
    for f in &deformations(97) {
        let s: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let g = from_rows(random.matrix());
        let symmetric = Symmetric { components: s };
        let (t, tau, second) = (CauchyStress(symmetric), KirchhoffStress(symmetric), SecondPiola(symmetric));
        let (p, m, b) = (FirstPiola(g), MandelStress(g), BiotStress(g));
        let (s, g) = (&[s][..], &[g][..]);
        all! { f:
            cauchy_to_kirchhoff(s) = t.kirchhoff(f).0.components;
            cauchy_to_first_piola(s) = flat(&t.first_piola(f).0);
            cauchy_to_second_piola(s) = t.second_piola(f).0.components;
            cauchy_to_mandel(s) = flat(&t.mandel(f).0);
            cauchy_to_biot(s) = flat(&t.biot(f).0);
            kirchhoff_to_cauchy(s) = tau.cauchy(f).0.components;
            kirchhoff_to_first_piola(s) = flat(&tau.first_piola(f).0);
            kirchhoff_to_second_piola(s) = tau.second_piola(f).0.components;
            kirchhoff_to_mandel(s) = flat(&tau.mandel(f).0);
            kirchhoff_to_biot(s) = flat(&tau.biot(f).0);
            first_piola_to_cauchy(g) = p.cauchy(f).0.components;
            first_piola_to_kirchhoff(g) = p.kirchhoff(f).0.components;
            first_piola_to_second_piola(g) = p.second_piola(f).0.components;
            first_piola_to_mandel(g) = flat(&p.mandel(f).0);
            first_piola_to_biot(g) = flat(&p.biot(f).0);
            second_piola_to_cauchy(s) = second.cauchy(f).0.components;
            second_piola_to_kirchhoff(s) = second.kirchhoff(f).0.components;
            second_piola_to_first_piola(s) = flat(&second.first_piola(f).0);
            second_piola_to_mandel(s) = flat(&second.mandel(f).0);
            second_piola_to_biot(s) = flat(&second.biot(f).0);
            mandel_to_cauchy(g) = m.cauchy(f).0.components;
            mandel_to_kirchhoff(g) = m.kirchhoff(f).0.components;
            mandel_to_first_piola(g) = flat(&m.first_piola(f).0);
            mandel_to_second_piola(g) = m.second_piola(f).0.components;
            mandel_to_biot(g) = flat(&m.biot(f).0);
            biot_to_cauchy(g) = b.cauchy(f).0.components;
            biot_to_kirchhoff(g) = b.kirchhoff(f).0.components;
            biot_to_first_piola(g) = flat(&b.first_piola(f).0);
            biot_to_second_piola(g) = b.second_piola(f).0.components;
            biot_to_mandel(g) = flat(&b.mandel(f).0);
        }
    }
}

#[test]
fn invariants_forces_and_functions_equal_those_of_one_point() {
    let mut random = Random::new(12);
    for f in &deformations(97) {
        let s: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let h: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let (symmetric, other) = (Symmetric { components: s }, Symmetric { components: h });
        let t = CauchyStress(symmetric);
        let (g, k) = (from_rows(random.matrix()), from_rows(random.matrix()));
        let normal = UnitNormal::new(Vector3::new(1.0, random.symmetric(), random.symmetric())).expect("a normal");
        let reference = ReferenceNormal::new(normal.vector()).expect("a normal");
        let haigh_westergaard = HaighWestergaard::of(&symmetric);
        let (u, w) = (RightStretch::of(f).0, [RightStretch::of(f).0]);
        let (s, h, g, k) = (&[s][..], &[h][..], &[g][..], &[k][..]);
        let (n, nominal) = (&[normal.vector()][..], &[reference.vector()][..]);
        all! { f:
            mean_stress(s) = [t.mean()];
            pressure(s) = [t.pressure()];
            deviator(s) = t.deviator().0.components;
            stress_invariants(s) = t.principal_invariants();
            j2(s) = [t.j2()];
            j3(s) = [t.j3()];
            von_mises(s) = [t.von_mises()];
            octahedral_shear(s) = [t.octahedral_shear()];
            tresca(s) = [t.tresca()];
            maximum_shear(s) = [t.maximum_shear()];
            lode_angle(s) = [t.lode_angle()];
            lode_angle_from_shear(s) = [invariants::lode_angle_from_shear(&symmetric)];
            haigh_westergaard(s) =
                [haigh_westergaard.hydrostatic, haigh_westergaard.deviatoric, haigh_westergaard.lode_angle];
            principal_stresses(s) = PrincipalStresses::of(&symmetric).values();
            j2_gradient(s) = gradients::j2(&symmetric).components;
            j3_gradient(s) = gradients::j3(&symmetric).components;
            von_mises_gradient(s) = gradients::von_mises(&symmetric).components;
            lode_angle_gradient(s) = gradients::lode_angle(&symmetric).components;
            tresca_gradient(s) = gradients::tresca(&symmetric).components;
            traction(s, n) = t.traction(&normal).into();
            nominal_traction(g, nominal) = FirstPiola(g[0]).nominal_traction(&reference).into();
            power_of_cauchy(s, g) = [t.power_per_deformed_volume(&VelocityGradient(g[0]))];
            power_of_first_piola(g, k) = [FirstPiola(g[0]).power_per_reference_volume(&GradientRate(k[0]))];
            power_of_second_piola(s, h) =
                [SecondPiola(symmetric).power_per_reference_volume(&GreenStrainRate(other))];
            push_vector(n) = transport::push_vector(f, &n[0]).into();
            pull_vector(n) = transport::pull_vector(f, &n[0]).into();
            push_covector(n) = transport::push_covector(f, &n[0]).into();
            pull_covector(n) = transport::pull_covector(f, &n[0]).into();
            push_area(n) = f.area_element(n[0]).into();
            push_contravariant(s) = transport::push_contravariant(f, &symmetric).components;
            pull_contravariant(s) = transport::pull_contravariant(f, &symmetric).components;
            push_covariant(s) = transport::push_covariant(f, &symmetric).components;
            pull_covariant(s) = transport::pull_covariant(f, &symmetric).components;
            push_mixed(g) = flat(&transport::push_mixed(f, &g[0]));
            pull_mixed(g) = flat(&transport::pull_mixed(f, &g[0]));
            tensor_function(SquareRoot, &w[..]) = tensor_function(&SquareRoot, &u).components;
            tensor_function_derivative(SquareRoot, &w[..], h) = derivative(&SquareRoot, &u, &other).components;
        }
    }
}

#[test]
fn rates_equal_those_of_one_point() {
    let mut random = Random::new(13);
    for f in &deformations(97) {
        let [s, r] = [(); 2].map(|()| [(); 6].map(|()| random.symmetric()));
        let (t, rate) =
            (CauchyStress(Symmetric { components: s }), MaterialRate(CauchyStress(Symmetric { components: r })));
        let g = from_rows(random.matrix());
        let (l, gradient) = (VelocityGradient(g), GradientRate(g));
        let rates = StretchRates::of(f, &gradient);
        let carried = StretchRates::of(f, &GradientRate::of(f, &l));
        let (s, r, g) = (&[s][..], &[r][..], &[g][..]);
        all! { f:
            velocity_gradient(g) = flat(&VelocityGradient::of(f, &gradient).0);
            gradient_rate(g) = flat(&GradientRate::of(f, &l).0);
            stretching(g) = l.stretching().0.components;
            spin(g) = l.spin().axial.into();
            jacobian_rate(g) = [strain_rates::jacobian_rate(f, &gradient)];
            right_cauchy_green_rate(g) = strain_rates::right_cauchy_green_rate(f, &gradient).0.components;
            left_cauchy_green_rate(g) = strain_rates::left_cauchy_green_rate(f, &gradient).0.components;
            green_rate(g) = strain_rates::green_rate(f, &gradient).0.components;
            almansi_rate(g) = strain_rates::almansi_rate(f, &l).0.components;
            right_stretch_rate(g) = rates.right_stretch().components;
            left_stretch_rate(g) = rates.left_stretch().components;
            hencky_rate(g) = rates.hencky_material().components;
            hencky_rate_spatial(g) = rates.hencky_spatial().components;
            rotation_rate(g) = flat(&rates.rotation());
            polar_spin(g) = rates.polar_spin().axial.into();
            logarithmic_spin(g) = rates.logarithmic_spin().axial.into();
            jaumann_rate(s, r, g) = JaumannRate::of(&t, &rate, &l.spin()).0.0.components;
            truesdell_rate(s, r, g) = TruesdellRate::of(&t, &rate, &l).0.0.components;
            upper_convected_rate(s, r, g) = UpperConvectedRate::of(&t, &rate, &l).0.0.components;
            lower_convected_rate(s, r, g) = LowerConvectedRate::of(&t, &rate, &l).0.0.components;
            green_naghdi_rate(s, r, g) = GreenNaghdiRate::of(&t, &rate, &carried.polar_spin()).0.0.components;
            logarithmic_rate(s, r, g) = LogarithmicRate::of(&t, &rate, &carried.logarithmic_spin()).0.0.components;
        }
    }
}

pub(super) fn slots(tensor: &MinorSymmetric) -> [f64; 36] {
    std::array::from_fn(|k| tensor.components[k / 6][k % 6])
}

pub(super) fn entries(tensor: &FourthOrder) -> [f64; 81] {
    std::array::from_fn(|k| tensor.components[k / 9][k % 9])
}

#[test]
fn tangents_equal_those_of_one_point() {
    let mut random = Random::new(14);
    for f in &deformations(97) {
        let s: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let c: [f64; 21] = std::array::from_fn(|_| random.symmetric());
        let a: [f64; 81] = std::array::from_fn(|_| random.symmetric());
        let (t, second) = (CauchyStress(Symmetric { components: s }), SecondPiola(Symmetric { components: s }));
        let tensor = MajorSymmetric { components: c };
        let (material, lie): (MaterialTangent, LieTangent) = (MaterialTangent(tensor), LieTangent(tensor));
        let (truesdell, jaumann): (TruesdellTangent, JaumannTangent) =
            (TruesdellTangent(tensor), JaumannTangent(tensor));
        let nominal = FirstPiolaTangent(FourthOrder {
            components: std::array::from_fn(|i| std::array::from_fn(|j| a[9 * i + j])),
        });
        let (s, c, a) = (&[s][..], &[c][..], &[a][..]);
        all! { f:
            push_forward_tangent(c) = material.lie(f).0.components;
            truesdell_tangent(c) = material.truesdell(f).0.components;
            lie_to_truesdell_tangent(c) = lie.truesdell(f).0.components;
            pull_back_tangent(c) = lie.material(f).0.components;
            truesdell_to_material_tangent(c) = truesdell.material(f).0.components;
            truesdell_to_lie_tangent(c) = truesdell.lie(f).0.components;
            first_piola_tangent(s, c) = entries(&material.first_piola(&second, f).0);
            material_tangent(s, a) = slots(&nominal.material(&second, f).0);
            jaumann_tangent(s, c) = truesdell.jaumann(&t).0.components;
            jaumann_to_truesdell_tangent(s, c) = jaumann.truesdell(&t).0.components;
            lower_convected_tangent(s, c) = truesdell.lower_convected(&t).0.components;
            cauchy_jaumann_tangent(s, c) = slots(&truesdell.jaumann(&t).cauchy(&t).0);
            cauchy_upper_convected_tangent(s, c) = slots(&truesdell.cauchy_upper_convected(&t).0);
            cauchy_lower_convected_tangent(s, c) = slots(&truesdell.lower_convected(&t).cauchy(&t).0);
        }
    }
}
