//! Identities between measures of stress, tractions, areas, invariants and powers.

use core::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use nalgebra::{Matrix3, Vector3};
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::rates::{self, GradientRate, StretchRates, VelocityGradient};
use piola_continuum::strain::RightCauchyGreen;
use piola_continuum::stress::{
    MohrCircle, gradients, invariants, moment_residual, oblique_traction, reference_surface_force,
};
use piola_continuum::{
    CauchyStress, Deformation, DeformationGradient, DisplacementGradient, FirstPiola, ReferenceNormal, SecondPiola,
    UnitNormal,
};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_order};
use proptest::prelude::*;

use super::cases::{deformation, direction, matrix, nine, rate, rotation, size, stress};

/// Stretches between ½ and 2: each conversion multiplies errors by cond F ≤ 4 at most, and sums three terms.
fn conversions(count: f64) -> Tol {
    Tol::ulps(12.0 * count)
}

fn flat(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// The components of all measures, from a measure that has the conversions.
macro_rules! all_of {
    ($stress:expr, $f:expr) => {
        [
            nine(&$stress.cauchy($f).0),
            nine(&$stress.kirchhoff($f).0),
            flat(&$stress.first_piola($f).0),
            nine(&$stress.second_piola($f).0),
            flat(&$stress.mandel($f).0),
            flat(&$stress.biot($f).0),
        ]
    };
}

/// Adds the conversion of a measure to itself, so that all measures have the same ones.
macro_rules! itself {
    ($name:ident, $method:ident) => {
        impl Itself for piola_continuum::$name {
            fn all(&self, f: &DeformationGradient) -> [Vec<f64>; 6] {
                trait Same: Sized + Copy {
                    fn $method(&self, _: &DeformationGradient) -> Self {
                        *self
                    }
                }
                impl Same for piola_continuum::$name {}
                all_of!(self, f)
            }
        }
    };
}
trait Itself {
    fn all(&self, f: &DeformationGradient) -> [Vec<f64>; 6];
}
itself!(CauchyStress, cauchy);
itself!(KirchhoffStress, kirchhoff);
itself!(FirstPiola, first_piola);
itself!(SecondPiola, second_piola);
itself!(MandelStress, mandel);
itself!(BiotStress, biot);

const NAMES: [&str; 6] = ["Cauchy", "Kirchhoff", "first Piola", "second Piola", "Mandel", "Biot"];

const CANCELLED: Tol = Tol::ulps_because(400.0, "a traction whose terms cancel, beside stresses of up to 100 Pa");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn conversions_between_all_measures_commute(t in stress(), f in deformation()) {
        let direct = t.all(&f);
        let ways = [
            t.kirchhoff(&f).all(&f),
            t.first_piola(&f).all(&f),
            t.second_piola(&f).all(&f),
            t.mandel(&f).all(&f),
            t.biot(&f).all(&f),
        ];
        for (way, by) in ways.iter().zip(&NAMES[1..]) {
            for ((actual, expected), to) in way.iter().zip(&direct).zip(NAMES) {
                assert_close(&format!("{to} by {by}"), actual, expected, conversions(3.0));
            }
        }
        // Through all six in turn and back.
        let around = t.kirchhoff(&f).mandel(&f).second_piola(&f).biot(&f).first_piola(&f).cauchy(&f);
        assert_close("around", &nine(&around.0), &direct[0], conversions(6.0));
    }

    #[test]
    fn both_kinds_of_deformation_convert_alike(t in stress(), f in deformation()) {
        let u = DisplacementGradient::new(f.matrix() - Matrix3::identity()).expect("0 < det F");
        assert_close("P", &flat(&t.first_piola(&u).0), &flat(&t.first_piola(&f).0), conversions(2.0));
        assert_close("S", &nine(&t.second_piola(&u).0), &nine(&t.second_piola(&f).0), conversions(2.0));
        assert_close("T", &nine(&t.first_piola(&u).cauchy(&u).0), &nine(&t.0), conversions(2.0));
    }

    #[test]
    fn mandel_stress_equals_right_cauchy_green_times_second_piola(t in stress(), f in deformation()) {
        let s = t.second_piola(&f);
        let c = RightCauchyGreen::of(&f);
        assert_close("M", &flat(&s.mandel_of_right_cauchy_green(&c).0), &flat(&s.mandel(&f).0), conversions(2.0));
    }

    #[test]
    fn biot_stress_equals_right_stretch_times_second_piola(t in stress(), f in deformation()) {
        let analysis = StretchAnalysis::of(&f);
        let (s, p) = (t.second_piola(&f), t.first_piola(&f));
        let expected = flat(&s.biot_of_right_stretch(&analysis.right_stretch()).0);
        assert_close("U S", &flat(&t.biot(&f).0), &expected, conversions(3.0));
        assert_close("analysed", &flat(&p.biot_of_analysis(&analysis).0), &flat(&p.biot(&f).0), Tol::ulps(0.0));
        let r = matrix(analysis.rotation());
        let biot = p.biot_of_rotation(&r).expect("a rotation");
        assert_close("Rᵀ P", &flat(&biot.0), &flat(&(r.transpose() * p.0)), Tol::ulps(8.0));
        assert_close("R Rᵀ P", &flat(&biot.first_piola_of_rotation(&r).expect("a rotation").0), &flat(&p.0), conversions(1.0));
        // ½ (U S + S U), symmetric though Biot's stress is not.
        let symmetric = nine(&biot.symmetric_part());
        let both = 0.5 * (biot.0 + biot.0.transpose());
        assert_close("sym", &symmetric, &flat(&both), Tol::ulps(2.0));
        let left_out = biot.skew_residual();
        let skew = both - biot.0;
        assert_close_at_scale("skew", &[2.0 * skew[(1, 2)]], &[left_out.x], size(&symmetric), Tol::ulps(2.0));
    }

    #[test]
    fn principal_stresses_compose_the_stress(t in stress(), n in direction()) {
        let principal = t.principal();
        let size = size(&nine(&t.0));
        let [s1, s2, s3] = principal.values();
        let [p1, p2, p3] = principal.projectors();
        prop_assert!(s2 <= s1 && s3 <= s2);
        let sum = p1 * s1 + p2 * s2 + p3 * s3;
        assert_close_at_scale("Σ σₖ Pₖ", &nine(&sum), &nine(&t.0), size, Tol::ulps(16.0));
        assert_close_at_scale("Haigh–Westergaard", &t.haigh_westergaard().principal_values(), &[s1, s2, s3], size, Tol::ulps(16.0));
        assert_close_at_scale("shear", &[principal.maximum_shear()], &[t.maximum_shear()], size, Tol::ulps(16.0));
        for (k, direction) in principal.directions().iter().enumerate() {
            let traction = t.traction(direction);
            let expected = direction.vector() * principal.values()[k];
            assert_close_at_scale("T n = σ n", traction.as_slice(), expected.as_slice(), size, Tol::ulps(16.0));
        }
        // The tractions of every plane lie in the outer circle of Mohr and outside of the inner ones.
        let n = UnitNormal::new(n).expect("a direction");
        let (normal, shear) = (t.normal_traction(&n), t.shear_traction_size(&n));
        let slack = 32.0 * f64::EPSILON * size * size;
        let power = |circle: MohrCircle| (normal - circle.centre).powi(2) + shear * shear - circle.radius.powi(2);
        let [outer, upper, lower] = principal.mohr_circles();
        prop_assert!(power(outer) <= slack && -slack <= power(upper) && -slack <= power(lower));
    }

    #[test]
    fn gradient_of_tresca_equals_difference_of_projectors(t in stress()) {
        let principal = t.principal();
        let [p1, _, p3] = principal.projectors();
        let [d1, d2, d3] = principal.deviatoric;
        let gap = (d1 - d2).min(d2 - d3);
        prop_assume!(1e-6 * d1 < gap);
        let tolerance = Tol::ulps(64.0).times(size(&nine(&t.0)) / gap);
        assert_close("n₁⊗n₁ − n₃⊗n₃", &nine(&gradients::tresca(&t.0)), &nine(&(p1 - p3)), tolerance);
    }

    #[test]
    fn stress_of_a_body_is_symmetric_in_all_measures(t in stress(), f in deformation()) {
        let p = t.first_piola(&f);
        let scale = size(&flat(&p.0)) * size(&flat(f.matrix()));
        assert_close_at_scale("P Fᵀ", p.moment_residual(&f).as_slice(), &[0.0; 3], scale, conversions(2.0));
        prop_assert!(p.check_moment(&f).is_ok());
        let m = t.mandel(&f);
        assert_close_at_scale("M", m.moment_residual(&f).as_slice(), &[0.0; 3], scale, conversions(4.0));
    }

    #[test]
    fn moment_residual_equals_twice_the_axial_vector_of_the_skew_part(
        p in rate(), f in deformation(), v in direction(),
    ) {
        let p = FirstPiola::new(p).expect("finite");
        let kirchhoff = p.0 * f.matrix().transpose();
        let skew = kirchhoff - kirchhoff.transpose();
        let expected = skew * v;
        let actual = p.moment_residual(&f).cross(&v);
        assert_close_at_scale("axial", actual.as_slice(), expected.as_slice(), 1.0, conversions(2.0));
        assert_close_at_scale("T", moment_residual(&kirchhoff).cross(&v).as_slice(), expected.as_slice(), 1.0, conversions(1.0));
        prop_assert!(p.check_moment(&f).is_err());
    }

    #[test]
    fn turned_body_has_turned_cauchy_and_unchanged_second_piola(
        t in stress(), f in deformation(), q in rotation(),
    ) {
        let turned = DeformationGradient::new(q * f.matrix()).expect("0 < det F");
        let turned_t = t.rotated(&q).expect("a rotation");
        assert_close("Q T Qᵀ", &nine(&turned_t.0), &flat(&(q * t.0.matrix() * q.transpose())), Tol::ulps(16.0));
        assert_close("S", &nine(&turned_t.second_piola(&turned).0), &nine(&t.second_piola(&f).0), conversions(3.0));
        assert_close("M", &flat(&turned_t.mandel(&turned).0), &flat(&t.mandel(&f).0), conversions(3.0));
        let p = t.first_piola(&f).rotated(&q).expect("a rotation");
        assert_close("Q P", &flat(&turned_t.first_piola(&turned).0), &flat(&p.0), conversions(3.0));
        let kirchhoff = t.kirchhoff(&f).rotated(&q).expect("a rotation");
        assert_close("Q τ Qᵀ", &nine(&turned_t.kirchhoff(&turned).0), &nine(&kirchhoff.0), conversions(3.0));
        // The traction turns with the body.
        let n = UnitNormal::new(Vector3::new(0.6, 0.0, 0.8)).expect("a direction");
        let turned_n = UnitNormal::new(q * n.vector()).expect("a direction");
        assert_close("t", turned_t.traction(&turned_n).as_slice(), (q * t.traction(&n)).as_slice(), CANCELLED);
    }

    #[test]
    fn invariants_of_the_turned_stress_equal_those_of_the_stress(t in stress(), q in rotation()) {
        let turned = t.rotated(&q).expect("a rotation");
        let size = size(&nine(&t.0));
        let tolerance = Tol::ulps(32.0);
        let (a, b) = (turned.principal_invariants(), t.principal_invariants());
        assert_close_at_scale("I₁", &[a[0]], &[b[0]], size, tolerance);
        assert_close_at_scale("I₂", &[a[1]], &[b[1]], size * size, tolerance);
        assert_close_at_scale("I₃", &[a[2]], &[b[2]], size * size * size, tolerance);
        assert_close_at_scale("J₂", &[turned.j2()], &[t.j2()], size * size, tolerance);
        assert_close_at_scale("J₃", &[turned.j3()], &[t.j3()], size * size * size, tolerance);
        assert_close_at_scale("von Mises", &[turned.von_mises()], &[t.von_mises()], size, tolerance);
        assert_close_at_scale("Tresca", &[turned.tresca()], &[t.tresca()], size, tolerance);
        let (a, b) = (turned.haigh_westergaard(), t.haigh_westergaard());
        let radius = size / b.deviatoric;
        assert_close_at_scale("θ", &[a.lode_angle], &[b.lode_angle], 1.0, tolerance.times(radius));
        assert_close_at_scale("θ", &[turned.lode_angle_from_shear()], &[FRAC_PI_6 - b.lode_angle], 1.0, tolerance.times(radius));
    }

    #[test]
    fn invariants_of_the_deviator_equal_their_principal_forms(t in stress()) {
        let size = size(&nine(&t.0));
        let values = t.haigh_westergaard().principal_values();
        let [s1, s2, s3] = values;
        prop_assert!(s2 <= s1 && s3 <= s2);
        let tolerance = Tol::ulps(16.0);
        // The characteristic polynomial vanishes at each principal stress.
        let [i1, i2, i3] = t.principal_invariants();
        assert_close_at_scale("Σ", &[s1 + s2 + s3], &[i1], size, tolerance);
        assert_close_at_scale("I₂", &[s1 * s2 + s2 * s3 + s3 * s1], &[i2], size * size, tolerance.times(4.0));
        assert_close_at_scale("I₃", &[s1 * s2 * s3], &[i3], size * size * size, tolerance.times(4.0));
        assert_close_at_scale("Tresca", &[t.tresca()], &[s1 - s3], size, tolerance);
        let von_mises = (0.5 * ((s1 - s2).powi(2) + (s2 - s3).powi(2) + (s3 - s1).powi(2))).sqrt();
        assert_close_at_scale("von Mises", &[t.von_mises()], &[von_mises], size, tolerance);
        assert_close_at_scale("J₂", &[3.0 * t.j2()], &[i1 * i1 - 3.0 * i2], size * size, tolerance.times(4.0));
        let d = t.deviator();
        assert_close_at_scale("det D", &[t.j3()], &[d.0.determinant()], size.powi(3), tolerance);
        assert_close_at_scale("D : D", &[2.0 * t.j2()], &[d.0.double_contraction(&d.0)], size * size, tolerance);
        assert_close_at_scale("octahedral", &[t.octahedral_shear()], &[(2.0 / 3.0 * t.j2()).sqrt()], size, tolerance);
        // Both conventions of the Lode angle.
        let ratio = 1.5 * 3.0_f64.sqrt() * t.j3() / t.j2().powf(1.5);
        assert_close_at_scale("cos 3θ", &[(3.0 * t.lode_angle()).cos()], &[ratio], 1.0, tolerance.times(4.0));
        assert_close_at_scale("sin 3θ", &[(3.0 * t.lode_angle_from_shear()).sin()], &[ratio], 1.0, tolerance.times(4.0));
        prop_assert!(0.0 <= t.lode_angle() && t.lode_angle() <= FRAC_PI_3);
        assert_close_at_scale("η", &[t.triaxiality().expect("a deviator") * t.von_mises()], &[t.mean()], size, tolerance);
    }

    #[test]
    fn normal_and_shear_tractions_compose_the_traction(t in stress(), n in direction()) {
        let n = UnitNormal::new(n).expect("a direction");
        let size = size(&nine(&t.0));
        let (along, shear) = (t.normal_traction(&n), t.shear_traction(&n));
        let traction = t.traction(&n);
        assert_close_at_scale("t", (n.vector() * along + shear).as_slice(), traction.as_slice(), size, Tol::ulps(8.0));
        assert_close_at_scale("n·t", &[along], &[traction.dot(&n.vector())], size, Tol::ulps(8.0));
        assert_close_at_scale("n·tₛ", &[shear.dot(&n.vector())], &[0.0], size, Tol::ulps(8.0));
        assert_close_at_scale("|tₛ|", &[t.shear_traction_size(&n)], &[shear.norm()], size, Tol::ulps(4.0));
        // No plane bears more shear than the largest, and none a normal traction beyond the principal ones.
        let [s1, _, s3] = t.haigh_westergaard().principal_values();
        let slack = 16.0 * f64::EPSILON * size;
        prop_assert!(t.shear_traction_size(&n) <= t.maximum_shear() + slack);
        prop_assert!(s3 - slack <= along && along <= s1 + slack);
        // Cauchy's lemma: the other side bears the opposite traction.
        prop_assert_eq!(t.traction(&-n), -traction);
    }

    #[test]
    fn tractions_on_coordinate_planes_give_the_traction_on_every_plane(t in stress(), n in direction()) {
        let n = UnitNormal::new(n).expect("a direction");
        let planes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e| t.traction(&UnitNormal::new(e).expect("unit")));
        let oblique = oblique_traction(&planes, &n, 0.0, &Vector3::zeros());
        assert_close_at_scale("t", oblique.as_slice(), t.traction(&n).as_slice(), size(&nine(&t.0)), Tol::ulps(4.0));
        prop_assert_eq!(CauchyStress::of_coordinate_tractions(&planes).expect("symmetric"), t);
    }

    #[test]
    fn force_on_a_deformed_area_equals_first_piola_traction(t in stress(), f in deformation(), n in direction()) {
        let reference = ReferenceNormal::new(n).expect("a direction");
        let area = reference.deformed(&f);
        let force = t.traction(&area.normal) * area.ratio;
        let first_piola = t.first_piola(&f).traction(&reference);
        let scale = size(&flat(&t.first_piola(&f).0));
        assert_close_at_scale("P N dA = t da", first_piola.as_slice(), force.as_slice(), scale, conversions(2.0));
        let g = reference_surface_force(&f, &reference, &t.traction(&area.normal));
        assert_close_at_scale("g", g.as_slice(), first_piola.as_slice(), scale, conversions(2.0));
        // Back to the reference body.
        let (back, ratio) = area.normal.reference(&f);
        assert_close("N", &back.components(), &reference.components(), conversions(4.0));
        assert_close("dA/da", &[ratio * area.ratio], &[1.0], conversions(4.0));
        assert_close("n", (area.normal.vector() * area.ratio).as_slice(), area.vector.as_slice(), Tol::ulps(4.0));
    }

    #[test]
    fn area_of_mapped_parallelogram_equals_nansons(f in deformation(), a in direction(), b in direction()) {
        let spanned = a.cross(&b);
        prop_assume!(0.1 < spanned.norm());
        let mapped = (f.matrix() * a).cross(&(f.matrix() * b));
        let area = ReferenceNormal::new(spanned).expect("a direction").deformed(&f);
        let tolerance = conversions(2.0).times(1.0 / spanned.norm());
        assert_close("n da", (area.vector * spanned.norm()).as_slice(), mapped.as_slice(), tolerance);
        assert_close("da", &[area.ratio * spanned.norm()], &[mapped.norm()], tolerance);
    }

    #[test]
    fn stress_powers_agree(t in stress(), f in deformation(), l in rate()) {
        let matrix = f.matrix();
        let l = VelocityGradient::new(l).expect("finite");
        let f_rate = GradientRate::of(&f, &l);
        let e_rate = rates::strain::green_rate(&f, &f_rate);
        let u_rate = StretchRates::of(&f, &f_rate).right_stretch();
        let (p, s) = (t.first_piola(&f), t.second_piola(&f));
        let deformed = t.power_per_deformed_volume(&l);
        // Sums of nine products of stress and rate, some of which cancel.
        let scale = 9.0 * size(&nine(&t.0)) * size(&flat(&l.0));
        let close = |what: &str, power: f64| assert_close_at_scale(what, &[power], &[deformed], scale, conversions(3.0));
        close("tr(T L)", (t.0.matrix() * l.0).trace());
        close("P : Ḟ/J", p.power_per_deformed_volume(&f_rate, &f));
        close("S : Ė/J", s.power_per_deformed_volume(&e_rate, &f));
        let reference = t.power_per_reference_volume(&l, &f);
        let scale = scale * f.jacobian();
        let close = |what: &str, power: f64| assert_close_at_scale(what, &[power], &[reference], scale, conversions(3.0));
        close("J tr(T L)", deformed * f.jacobian());
        close("τ : D", t.kirchhoff(&f).power_per_reference_volume(&l));
        close("P : Ḟ", p.power_per_reference_volume(&f_rate));
        close("S : Ė", s.power_per_reference_volume(&e_rate));
        let pulled_back = matrix.try_inverse().expect("regular") * f_rate.0;
        close("sym(Rᵀ P) : U̇", t.biot(&f).power_per_reference_volume(&u_rate));
        close("M : F⁻¹ Ḟ", t.mandel(&f).power_per_reference_volume(&pulled_back));
    }

    #[test]
    fn spin_has_no_power(t in stress(), l in rate()) {
        let spin = VelocityGradient::new(l - l.transpose()).expect("finite");
        assert_close("T : W", &[t.power_per_deformed_volume(&spin)], &[0.0], Tol::ulps(0.0));
    }

    #[test]
    fn measures_form_vector_spaces(t in stress(), other in stress(), f in deformation(), k in -3.0..3.0_f64) {
        let sum = (t * k + other).first_piola(&f);
        let expected = t.first_piola(&f) * k + other.first_piola(&f);
        let scale = size(&flat(&other.first_piola(&f).0)) + size(&flat(&(t.first_piola(&f) * k).0));
        assert_close_at_scale("linear", &flat(&sum.0), &flat(&expected.0), scale, conversions(2.0));
        prop_assert_eq!((t - t, -t + t), (CauchyStress::zero(), CauchyStress::default()));
        let s: SecondPiola = t.second_piola(&f);
        let mut total = s;
        total += s;
        total -= s * 2.0;
        prop_assert_eq!(total, SecondPiola::zero());
    }
}

/// A curved patch (a, b) ↦ X of the reference body and a nonlinear motion of it.
fn patch(a: f64, b: f64) -> Vector3<f64> {
    Vector3::new(a, b, 0.3 * (1.7 * a).sin() * b + 0.2 * a * b * b)
}
fn patch_tangents(a: f64, b: f64) -> [Vector3<f64>; 2] {
    let wave = 0.3 * (1.7 * a).sin();
    let slope = 0.51 * (1.7 * a).cos();
    [Vector3::new(1.0, 0.0, slope * b + 0.2 * b * b), Vector3::new(0.0, 1.0, wave + 0.4 * a * b)]
}
fn motion(x: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        x.x + 0.2 * (x.y + x.z).sin(),
        1.3 * x.y + 0.1 * x.x * x.z,
        0.8 * x.z + 0.15 * (x.x * x.y) + 0.1 * x.x * x.x,
    )
}
fn gradient(x: &Vector3<f64>) -> DeformationGradient {
    let wave = 0.2 * (x.y + x.z).cos();
    let rows = Matrix3::new(1.0, wave, wave, 0.1 * x.z, 1.3, 0.1 * x.x, 0.15 * x.y + 0.2 * x.x, 0.15 * x.x, 0.8);
    DeformationGradient::new(rows).expect("0 < det F")
}

/// The area vector of the deformed patch over [0, 1]² by Nanson's formula on the reference patch, n × n midpoints.
fn area_by_nanson(n: u32) -> Vector3<f64> {
    let h = 1.0 / f64::from(n);
    let mut sum = Vector3::zeros();
    for i in 0..n {
        for j in 0..n {
            let (a, b) = ((f64::from(i) + 0.5) * h, (f64::from(j) + 0.5) * h);
            let [ta, tb] = patch_tangents(a, b);
            let reference = ta.cross(&tb);
            let normal = ReferenceNormal::new(reference).expect("a surface");
            sum += normal.deformed(&gradient(&patch(a, b))).vector * (reference.norm() * h * h);
        }
    }
    sum
}

/// The area vector of the deformed patch by sampling the motion alone: half the circulation ½ ∮ x × dx of its edge,
/// which any surface with that edge has.
fn area_by_edge(n: u32) -> Vector3<f64> {
    let h = 1.0 / f64::from(n);
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)];
    let mut sum = Vector3::zeros();
    for side in corners.windows(2) {
        let ((a0, b0), (a1, b1)) = (side[0], side[1]);
        let at = |k: u32| {
            let s = f64::from(k) * h;
            motion(&patch(a0 + s * (a1 - a0), b0 + s * (b1 - b0)))
        };
        for k in 0..n {
            sum += at(k).cross(&at(k + 1)) * 0.5;
        }
    }
    sum
}

#[test]
fn nansons_area_of_a_patch_equals_that_of_its_sampled_image() {
    let exact = area_by_edge(1 << 14);
    let counts = [8_u32, 16, 32, 64];
    let steps = counts.map(|n| 1.0 / f64::from(n));
    let errors = counts.map(|n| (area_by_nanson(n) - exact).norm());
    assert_order("midpoints", &steps, &errors, 2.0, 0.1);
    // Richardson's extrapolation of the last two leaves the error of the edge, h²/12 of its curvature.
    let extrapolated = (area_by_nanson(128) * 4.0 - area_by_nanson(64)) / 3.0;
    let tolerance = Tol::order(2.0_f64.powi(-14), 2).or(Tol::order(2.0_f64.powi(-7), 4));
    assert_close("∫ n da", extrapolated.as_slice(), exact.as_slice(), tolerance);
}

/// A stress field that is not homogeneous, with div T of its own.
fn field(x: &Vector3<f64>) -> CauchyStress {
    CauchyStress::new(
        3.0 + x.x * x.y - x.z,
        1.0 + (0.5 * x.y).sin(),
        -2.0 + x.z * x.z + x.x,
        0.5 + x.y * x.z,
        1.5 - x.x * x.x,
        0.25 + 2.0 * x.y,
    )
    .expect("finite")
}
fn divergence(x: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(x.y + x.z + 0.0, 0.0 + 0.5 * (0.5 * x.y).cos() + 0.0, 0.0 + 0.0 + 2.0 * x.z)
}

/// The mean over a triangle, by subdivision into n² equal ones and their centroids.
fn mean_over_triangle(corners: [Vector3<f64>; 3], n: u32, f: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    let [o, a, b] = corners;
    let h = 1.0 / f64::from(n);
    let at = |u: f64, v: f64| f(&(o + (a - o) * (u * h) + (b - o) * (v * h)));
    let mut sum = Vector3::zeros();
    for i in 0..n {
        for j in 0..n - i {
            let (u, v) = (f64::from(i), f64::from(j));
            sum += at(u + 1.0 / 3.0, v + 1.0 / 3.0);
            if j + 1 < n - i {
                sum += at(u + 2.0 / 3.0, v + 2.0 / 3.0);
            }
        }
    }
    sum * (h * h)
}

/// The mean over the tetrahedron with one corner at the origin and edges along the axes.
fn mean_over_tetrahedron(edges: [f64; 3], n: u32, f: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    // The cube mapped onto it: x = u, y = (1 − u) v, z = (1 − u)(1 − v) w, with Jacobian (1 − u)² (1 − v).
    let h = 1.0 / f64::from(n);
    let (mut sum, mut volume) = (Vector3::zeros(), 0.0);
    let middle = |k: u32| (f64::from(k) + 0.5) * h;
    for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
        let (u, v, w) = (middle(i), middle(j), middle(k));
        let weight = (1.0 - u).powi(2) * (1.0 - v);
        let x = Vector3::new(u * edges[0], (1.0 - u) * v * edges[1], (1.0 - u) * (1.0 - v) * w * edges[2]);
        sum += f(&x) * weight;
        volume += weight;
    }
    sum / volume
}

#[test]
fn tetrahedron_shrinks_to_cauchys_traction() {
    let normal = UnitNormal::new(Vector3::new(1.0, 2.0, 2.0)).expect("a direction");
    let n = normal.components();
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let heights = [0.1, 0.05, 0.025, 0.0125];
    let mut balances = Vec::new();
    let mut limits = Vec::new();
    for height in heights {
        let edges = n.map(|n| height / n);
        let corners = [axes[0] * edges[0], axes[1] * edges[1], axes[2] * edges[2]];
        // Mean tractions with the normals +eᵢ on the three faces through the vertex, and on the oblique face.
        let face = |i: usize| {
            let e = UnitNormal::new(axes[i]).expect("unit");
            let corners = [Vector3::zeros(), corners[(i + 1) % 3], corners[(i + 2) % 3]];
            mean_over_triangle(corners, 24, |x| field(x).traction(&e))
        };
        let oblique = mean_over_triangle(corners, 24, |x| field(x).traction(&normal));
        // The body is at rest: ρ (b − a) = −div T, W(17.12).
        let force = mean_over_tetrahedron(edges, 24, |x| -divergence(x));
        let balance = oblique_traction(&[face(0), face(1), face(2)], &normal, height, &force) - oblique;
        balances.push(balance.norm());
        // W(16.9): with the tractions at the vertex and no force at all, the error is of the first order.
        let at_vertex = [0, 1, 2].map(|i| field(&Vector3::zeros()).traction(&UnitNormal::new(axes[i]).expect("unit")));
        limits.push((oblique_traction(&at_vertex, &normal, 0.0, &Vector3::zeros()) - oblique).norm());
    }
    assert_order("t̄(n) → Σ nᵢ t(eᵢ)", &heights, &limits, 1.0, 0.1);
    // At finite height the balance holds to the error of the quadrature, second order in h/24.
    for (height, balance) in heights.iter().zip(&balances) {
        let tolerance = Tol::order(height / 24.0, 2).times(4.0);
        assert_close_at_scale("balance", &[*balance], &[0.0], 1.0, tolerance);
    }
    let at_vertex = field(&Vector3::zeros()).traction(&normal);
    let components = [0, 1, 2].map(|i| field(&Vector3::zeros()).traction(&UnitNormal::new(axes[i]).expect("unit")));
    let theorem = oblique_traction(&components, &normal, 0.0, &Vector3::zeros());
    assert_close("W(16.9)", theorem.as_slice(), at_vertex.as_slice(), Tol::ulps(4.0));
}

#[test]
fn invariants_as_functions_equal_methods() {
    let t: CauchyStress = CauchyStress::new(3.0, -1.0, 2.0, 0.5, 4.0, -2.0).expect("finite");
    assert_close("mean", &[t.mean()], &[invariants::mean(&t.0)], Tol::ulps(0.0));
    assert_close("Lode", &[t.lode_angle()], &[invariants::lode_angle(&t.0)], Tol::ulps(0.0));
}
