//! Every request of rates of Kirchhoff's stress, of rates back to Ṫ and of tangents that turn with the stretch gives at a
//! point what the one-point interface gives.

use nalgebra::Vector3;
use piola_continuum::rates::strain::GreenStrainRate;
use piola_continuum::{rates::{AccelerationGradient, GradientRate, GradientSecondRate, RateOfDeformation, StretchRates, VelocityGradient}, stress::rates::{GreenNaghdiRate, JaumannRate, LogarithmicRate, LowerConvectedRate, MaterialRate, TruesdellRate, UpperConvectedRate}};
use piola_continuum::strain::SethHill;
use piola_continuum::stress::reference_body_force;
use piola_continuum::stress::tangents::{CauchyGreenNaghdiTangent, CauchyJaumannTangent, CauchyLogarithmicTangent, CauchyLowerConvectedTangent, CauchyUpperConvectedTangent, FirstPiolaTangent, GreenNaghdiTangent, JaumannTangent, LieTangent, LogarithmicTangent, LowerConvectedTangent, MaterialTangent, TruesdellTangent};
use piola_tensor::{FourthOrder, MajorSymmetric, MinorSymmetric};
use piola_batch as batch;
use piola_continuum::{BiotStress, CauchyStress, Deformation, KirchhoffStress, MandelStress, SecondPiola, Symmetric, UnitNormal};
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

use super::cases::{deformations, stresses};
use super::every_request::{all, flat, same, slots};

#[test]
fn rates_of_kirchhoff_stress_and_material_rates_equal_those_of_one_point() {
    let mut random = Random::new(17);
    let scale = SethHill::new(1.5).expect("an order");
    for f in &deformations(97) {
        let [s, r] = [(); 2].map(|()| [(); 6].map(|()| random.symmetric()));
        let [stress, other] = [s, r].map(|components| Symmetric { components });
        let (tau, tau_rate) = (KirchhoffStress(stress), MaterialRate(KirchhoffStress(other)));
        let (t, rated) = (CauchyStress(stress), CauchyStress(other));
        let g = from_rows(random.matrix());
        let (l, gradient) = (VelocityGradient(g), GradientRate(g));
        let rates = StretchRates::of(f, &gradient);
        let carried = StretchRates::of(f, &GradientRate::of(f, &l));
        let (polar, logarithmic) = (carried.polar_spin(), carried.logarithmic_spin());
        let (s, r, g) = (&[s][..], &[r][..], &[g][..]);
        all! { f:
            kirchhoff_jaumann_rate(s, r, g) = JaumannRate::of(&tau, &tau_rate, &l.spin()).0.0.components;
            kirchhoff_upper_convected_rate(s, r, g) = UpperConvectedRate::of(&tau, &tau_rate, &l).0.0.components;
            kirchhoff_lower_convected_rate(s, r, g) = LowerConvectedRate::of(&tau, &tau_rate, &l).0.0.components;
            kirchhoff_green_naghdi_rate(s, r, g) = GreenNaghdiRate::of(&tau, &tau_rate, &polar).0.0.components;
            kirchhoff_logarithmic_rate(s, r, g) = LogarithmicRate::of(&tau, &tau_rate, &logarithmic).0.0.components;
            jaumann_to_material_rate(s, r, g) = JaumannRate(rated).material(&t, &l.spin()).0.0.components;
            truesdell_to_material_rate(s, r, g) = TruesdellRate(rated).material(&t, &l).0.0.components;
            upper_convected_to_material_rate(s, r, g) = UpperConvectedRate(rated).material(&t, &l).0.0.components;
            lower_convected_to_material_rate(s, r, g) = LowerConvectedRate(rated).material(&t, &l).0.0.components;
            green_naghdi_to_material_rate(s, r, g) = GreenNaghdiRate(rated).material(&t, &polar).0.0.components;
            logarithmic_to_material_rate(s, r, g) = LogarithmicRate(rated).material(&t, &logarithmic).0.0.components;
            cauchy_to_kirchhoff_rate(s, r, g) = MaterialRate(rated).kirchhoff(&t, f, &l).0.0.components;
            material_spin(g) = rates.material_spin().axial.into();
            divergence(g) = [l.divergence()];
            vorticity(g) = l.spin().vorticity().into();
            acceleration_gradient(g) = flat(&AccelerationGradient::of(f, &GradientSecondRate(g[0])).0);
            gradient_second_rate(g) = flat(&AccelerationGradient(g[0]).gradient_second_rate(f).0);
            seth_hill_rate(scale, g) = rates.material_function(&scale).components;
            seth_hill_spatial_rate(scale, g) = rates.spatial_function(&scale).components;
        }
    }
}

#[test]
fn tractions_powers_and_elements_of_area_equal_those_of_one_point() {
    let mut random = Random::new(18);
    for f in &deformations(97) {
        let [s, h] = [(); 2].map(|()| [(); 6].map(|()| random.symmetric()));
        let (symmetric, other) = (Symmetric { components: s }, Symmetric { components: h });
        let t = CauchyStress(symmetric);
        let (g, k) = (from_rows(random.matrix()), from_rows(random.matrix()));
        let normal = UnitNormal::new(Vector3::new(1.0, random.symmetric(), random.symmetric())).expect("a normal");
        let (area, ratio) = normal.reference(f);
        let (s, h, g, k, n) = (&[s][..], &[h][..], &[g][..], &[k][..], &[normal.vector()][..]);
        all! { f:
            normal_traction(s, n) = [t.normal_traction(&normal)];
            shear_traction(s, n) = t.shear_traction(&normal).into();
            power_of_kirchhoff(s, g) = [KirchhoffStress(symmetric).power_per_reference_volume(&VelocityGradient(g[0]))];
            power_of_biot(g, h) = [BiotStress(g[0]).power_per_reference_volume(&other)];
            power_of_mandel(g, k) = [MandelStress(g[0]).power_per_reference_volume(&k[0])];
            pull_body_force(n) = reference_body_force(f, &n[0]).into();
        }
        let found = batch::pull_area(n, &mut [[0.0; 3]; 0][..]).at(f, 0);
        assert_close("N dA", &found, (area.vector() * ratio).as_slice(), Tol::ulps(8.0));
        let there_and_back = batch::push_area(&[found][..], &mut [[0.0; 3]; 0][..]).at(f, 0);
        let condition = f.matrix().norm() * f.inverse_rows().as_flattened().iter().map(|x| x.abs()).sum::<f64>();
        assert_close("n da", &there_and_back, n[0].as_slice(), Tol::ulps(8.0).times(condition.max(1.0)));
    }
}

#[test]
fn tangents_that_turn_with_the_stretch_equal_those_of_one_point() {
    let mut random = Random::new(19);
    for f in &deformations(97) {
        let [s, h] = [(); 2].map(|()| [(); 6].map(|()| random.symmetric()));
        let c: [f64; 21] = std::array::from_fn(|_| random.symmetric());
        let m: [f64; 36] = std::array::from_fn(|_| random.symmetric());
        let a: [f64; 81] = std::array::from_fn(|_| random.symmetric());
        let rate = random.matrix();
        let (symmetric, strain_rate) = (Symmetric { components: s }, Symmetric { components: h });
        let (t, second) = (CauchyStress(symmetric), SecondPiola(symmetric));
        let (tensor, stretching) = (MajorSymmetric { components: c }, RateOfDeformation(strain_rate));
        let minor = MinorSymmetric { components: std::array::from_fn(|i| std::array::from_fn(|j| m[6 * i + j])) };
        let nominal = FirstPiolaTangent(FourthOrder {
            components: std::array::from_fn(|i| std::array::from_fn(|j| a[9 * i + j])),
        });
        let jaumann: JaumannTangent = TruesdellTangent(tensor).jaumann(&t);
        let lower: LowerConvectedTangent = LowerConvectedTangent(tensor);
        let (material, lie): (MaterialTangent, LieTangent) = (MaterialTangent(tensor), LieTangent(tensor));
        let (truesdell, of_jaumann): (TruesdellTangent, JaumannTangent) =
            (TruesdellTangent(tensor), JaumannTangent(tensor));
        let g = from_rows(rate);
        let (s, h, c, m, a, g) = (&[s][..], &[h][..], &[c][..], &[m][..], &[a][..], &[g][..]);
        all! { f:
            green_naghdi_tangent(s, c) = slots(&jaumann.green_naghdi(&t, f).0);
            logarithmic_tangent(s, c) = slots(&jaumann.logarithmic(&t, f).0);
            cauchy_green_naghdi_tangent(s, c) = slots(&jaumann.green_naghdi(&t, f).cauchy(&t).0);
            cauchy_logarithmic_tangent(s, c) = slots(&jaumann.logarithmic(&t, f).cauchy(&t).0);
            green_naghdi_to_jaumann_tangent(s, m) = slots(&GreenNaghdiTangent(minor).jaumann(&t, f).0);
            logarithmic_to_jaumann_tangent(s, m) = slots(&LogarithmicTangent(minor).jaumann(&t, f).0);
            lower_convected_to_truesdell_tangent(s, c) = lower.truesdell(&t).0.components;
            cauchy_jaumann_to_jaumann_tangent(s, m) = slots(&CauchyJaumannTangent(minor).kirchhoff(&t).0);
            cauchy_upper_convected_to_truesdell_tangent(s, m) =
                slots(&CauchyUpperConvectedTangent(minor).truesdell(&t).0);
            cauchy_lower_convected_to_lower_convected_tangent(s, m) =
                slots(&CauchyLowerConvectedTangent(minor).kirchhoff(&t).0);
            cauchy_green_naghdi_to_green_naghdi_tangent(s, m) =
                slots(&CauchyGreenNaghdiTangent(minor).kirchhoff(&t).0);
            cauchy_logarithmic_to_logarithmic_tangent(s, m) = slots(&CauchyLogarithmicTangent(minor).kirchhoff(&t).0);
            first_piola_to_truesdell_tangent(s, a) = slots(&nominal.truesdell(&second, f).0);
            rate_of_material_tangent(c, h) = material.rate(&GreenStrainRate(strain_rate).0).0.components;
            rate_of_lie_tangent(c, h) = lie.rate(&stretching).0.0.components;
            rate_of_truesdell_tangent(c, h) = truesdell.rate(&stretching).0.0.components;
            rate_of_jaumann_tangent(c, h) = of_jaumann.rate(&stretching).components;
            rate_of_lower_convected_tangent(c, h) = lower.rate(&stretching).components;
            rate_of_first_piola_tangent(a, g) = flat(&nominal.rate(&GradientRate(g[0])).0);
        }
    }
}

#[test]
fn tangents_that_turn_with_the_stretch_are_the_same_in_lanes_and_typed() {
    let (f, t) = (deformations(37), stresses(37));
    let truesdell: Vec<TruesdellTangent> =
        (0..37).map(|i| TruesdellTangent(MajorSymmetric::isotropic(1.0 + f64::from(i), 3.0))).collect();
    let mut naghdi = vec![GreenNaghdiTangent(MinorSymmetric::zero()); 37];
    batch::evaluate(&f[..], batch::green_naghdi_tangent(&t[..], &truesdell[..], &mut naghdi[..]))
        .expect("deformations");
    for (index, f) in f.iter().enumerate() {
        let (stress, jaumann) = (&t[index], truesdell[index].jaumann(&t[index]));
        assert_eq!(naghdi[index], jaumann.green_naghdi(stress, f), "point {index}");
    }
}
