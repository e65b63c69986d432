//! Objective rates of stress: the same for every observer, and equal to what they are the rate of.

use nalgebra::Matrix3;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{CauchyStress, DeformationGradient, KirchhoffStress, SecondPiola, Symmetric};
use piola_continuum::{
    rates::{GradientRate, StretchRates, VelocityGradient},
    stress::rates::{
        GreenNaghdiRate, JaumannRate, LogarithmicRate, LowerConvectedRate, MaterialRate, TruesdellRate,
        UpperConvectedRate,
    },
};
use piola_numerics::linear::matrix3::{determinant, from_rows, inverse, rows_of};
use piola_numerics::{Dual, Real};
use piola_testkit::Tol;
use piola_testkit::strategies::random_cases;
use proptest::prelude::*;

use super::super::cases::{Path, assert_same, path};
use super::{tangent, value};

/// What an observer sees: F, Ḟ, the stress and its material derivative.
struct Seen {
    deformation: DeformationGradient,
    rate: GradientRate,
    stress: Symmetric,
    stress_rate: Symmetric,
}

impl Seen {
    fn of(gradient: &Matrix3<Dual<f64>>, stress: &Matrix3<Dual<f64>>) -> Self {
        let symmetric = |a: &Matrix3<f64>| Symmetric::symmetric_part(rows_of(a));
        Self {
            deformation: DeformationGradient::new(value(gradient)).expect("0 < det F"),
            rate: GradientRate(tangent(gradient)),
            stress: symmetric(&value(stress)),
            stress_rate: symmetric(&tangent(stress)),
        }
    }

    /// Every rate of Cauchy's stress, and of Kirchhoff's where it is another formula.
    fn rates(&self) -> Vec<(&'static str, Matrix3<f64>)> {
        let l = VelocityGradient::of(&self.deformation, &self.rate);
        let stretch = StretchRates::of(&self.deformation, &self.rate);
        let (t, rate) = (CauchyStress(self.stress), MaterialRate(CauchyStress(self.stress_rate)));
        let (k, kirchhoff) = (KirchhoffStress(self.stress), MaterialRate(KirchhoffStress(self.stress_rate)));
        let logarithmic = stretch.logarithmic_spin();
        vec![
            ("Jaumann", JaumannRate::of(&t, &rate, &l.spin()).0.matrix()),
            ("Green–Naghdi", GreenNaghdiRate::of(&t, &rate, &stretch.polar_spin()).0.matrix()),
            ("logarithmic", LogarithmicRate::of(&k, &kirchhoff, &logarithmic).0.matrix()),
            ("Oldroyd", UpperConvectedRate::of(&k, &kirchhoff, &l).0.matrix()),
            ("Cotter–Rivlin", LowerConvectedRate::of(&t, &rate, &l).0.matrix()),
            ("Truesdell", TruesdellRate::of(&t, &rate, &l).0.matrix()),
        ]
    }
}

/// F, T and Q as differentiable functions of time, at t = 0.
fn moving(path: &Path) -> [Matrix3<Dual<f64>>; 3] {
    let t = Dual::variable(0.0);
    [path.at(t), path.stress_at(t).matrix(), path.frame_at(t)]
}

fn inverse_of<T: Real>(a: &Matrix3<T>) -> Matrix3<T> {
    inverse(a).expect("regular")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn rates_seen_by_a_turning_observer_equal_turned_rates(path in path()) {
        let [f, stress, q] = moving(&path);
        let here = Seen::of(&f, &stress).rates();
        let there = Seen::of(&(q * f), &(q * stress * q.transpose())).rates();
        let turn = value(&q);
        for ((name, here), (_, there)) in here.into_iter().zip(there) {
            let turned = turn * here * turn.transpose();
            assert_same(name, &there, &turned, 1.0, Tol::ulps(64.0).times(path.condition()));
        }
        // And the velocity gradient itself, with the observer's own turning.
        let seen = Seen::of(&(q * f), &stress);
        let there = VelocityGradient::of(&seen.deformation, &seen.rate);
        let expected = path.velocity_gradient().seen_from(&turn, &path.turning);
        assert_same("L* = Q L Qᵀ + Ω", &there.0, &expected.0, 1.0, Tol::ulps(32.0).times(path.condition()));
    }

    #[test]
    fn convected_rates_equal_pushed_derivatives_of_pulled_tensors(path in path()) {
        let [f, stress, _] = moving(&path);
        let seen = Seen::of(&f, &stress);
        let l = path.velocity_gradient();
        let now = value(&f);
        let (inverse, inverse_now) = (inverse_of(&f), inverse_of(&now));
        let (t, rate) = (CauchyStress(seen.stress), MaterialRate(CauchyStress(seen.stress_rate)));
        let (k, kirchhoff) = (KirchhoffStress(seen.stress), MaterialRate(KirchhoffStress(seen.stress_rate)));
        let tol = Tol::ulps(32.0).times(path.condition().powi(2));
        let upper = now * tangent(&(inverse * stress * inverse.transpose())) * now.transpose();
        assert_same("F (F⁻¹TF⁻ᵀ)˙ Fᵀ", &UpperConvectedRate::of(&t, &rate, &l).0.matrix(), &upper, 1.0, tol);
        let lower = inverse_now.transpose() * tangent(&(f.transpose() * stress * f)) * inverse_now;
        assert_same("F⁻ᵀ (FᵀTF)˙ F⁻¹", &LowerConvectedRate::of(&k, &kirchhoff, &l).0.matrix(), &lower, 1.0, tol);
        let j = determinant(rows_of(&f));
        let pulled = inverse * stress * inverse.transpose() * j;
        let truesdell = now * tangent(&pulled) * now.transpose() / j.value;
        assert_same("J⁻¹ F Ṡ Fᵀ", &TruesdellRate::of(&t, &rate, &l).0.matrix(), &truesdell, 1.0, tol);
        // The same by the rate of the second Piola–Kirchhoff stress, as a rate of Kirchhoff's stress.
        let second = MaterialRate(SecondPiola(Symmetric::symmetric_part(rows_of(&tangent(&pulled)))));
        let pushed = UpperConvectedRate::of_second_piola(&second, &seen.deformation);
        let of_truesdell = TruesdellRate::of(&t, &rate, &l).upper_convected(&seen.deformation);
        assert_same("F Ṡ Fᵀ = J T°", &pushed.0.matrix(), &of_truesdell.0.matrix(), 1.0 + j.value, tol);
        let first = second.first_piola(&SecondPiola(Symmetric::symmetric_part(rows_of(&value(&pulled)))), &seen.deformation, &seen.rate);
        let scale = value(&pulled).norm() * now.norm();
        assert_same("Ṗ = ḞS + FṠ", &first.0.0, &tangent(&(f * pulled)), scale, tol);
    }

    #[test]
    fn green_naghdi_rate_equals_turned_derivative_of_turned_back_stress(path in path()) {
        let [f, stress, _] = moving(&path);
        let seen = Seen::of(&f, &stress);
        let analysis = StretchAnalysis::of(&DeformationGradient::new(f).expect("0 < det F"));
        let r = from_rows(analysis.rotation());
        let now = value(&r);
        let expected = now * tangent(&(r.transpose() * stress * r)) * now.transpose();
        let (t, rate) = (CauchyStress(seen.stress), MaterialRate(CauchyStress(seen.stress_rate)));
        let spin = StretchRates::of(&seen.deformation, &seen.rate).polar_spin();
        let actual = GreenNaghdiRate::of(&t, &rate, &spin);
        assert_same("R (RᵀTR)˙ Rᵀ", &actual.0.matrix(), &expected, 1.0, Tol::ulps(32.0).times(path.condition()));
        let back = actual.material(&t, &spin);
        assert_same("Ṫ back", &back.0.matrix(), &rate.0.matrix(), spin.axial.norm() + 1.0, Tol::ulps(8.0));
    }

    #[test]
    fn convected_rates_of_cauchy_green_tensors_vanish(path in path()) {
        let f = path.at(Dual::variable(0.0));
        let l = path.velocity_gradient();
        let left = f * f.transpose();
        let of = |a: &Matrix3<f64>| KirchhoffStress(Symmetric::symmetric_part(rows_of(a)));
        let size = value(&left).norm() * l.0.norm();
        let zero = Matrix3::zeros();
        let tol = Tol::ulps(32.0).times(path.condition());
        let upper = UpperConvectedRate::of(&of(&value(&left)), &MaterialRate(of(&tangent(&left))), &l);
        assert_same("upper-convected rate of B", &upper.0.matrix(), &zero, size, tol);
        let inverse = inverse_of(&left);
        let size = value(&inverse).norm() * l.0.norm();
        let tol = Tol::ulps(64.0).times(path.condition().powi(2));
        let lower = LowerConvectedRate::of(&of(&value(&inverse)), &MaterialRate(of(&tangent(&inverse))), &l);
        assert_same("lower-convected rate of B⁻¹", &lower.0.matrix(), &zero, size, tol);
    }

    #[test]
    fn rates_of_kirchhoff_stress_equal_those_of_cauchy_stress_with_volume(path in path()) {
        let [f, stress, _] = moving(&path);
        let seen = Seen::of(&f, &stress);
        let l = path.velocity_gradient();
        let deformation = &seen.deformation;
        let (t, rate) = (CauchyStress(seen.stress), MaterialRate(CauchyStress(seen.stress_rate)));
        let weighed = stress * determinant(rows_of(&f));
        let of = |a: &Matrix3<f64>| KirchhoffStress(Symmetric::symmetric_part(rows_of(a)));
        let (k, kirchhoff) = (of(&value(&weighed)), MaterialRate(of(&tangent(&weighed))));
        let scale = 1.0 + k.matrix().norm() * (1.0 + l.0.norm());
        let tol = Tol::ulps(32.0).times(path.condition());
        let same = |what: &str, a: Matrix3<f64>, b: Matrix3<f64>| assert_same(what, &a, &b, scale, tol);
        same("τ̇", rate.kirchhoff(&t, deformation, &l).0.matrix(), kirchhoff.0.matrix());
        let spin = l.spin();
        let of_cauchy = JaumannRate::of(&t, &rate, &spin).kirchhoff(&t, deformation, &l);
        let direct = JaumannRate::of(&k, &kirchhoff, &spin);
        same("Jaumann", of_cauchy.0.matrix(), direct.0.matrix());
        same("Jaumann back", direct.cauchy(&k, deformation, &l).kirchhoff(&t, deformation, &l).0.matrix(), direct.0.matrix());
        let of_cauchy = LowerConvectedRate::of(&t, &rate, &l).kirchhoff(&t, deformation, &l);
        same("Cotter–Rivlin", of_cauchy.0.matrix(), LowerConvectedRate::of(&k, &kirchhoff, &l).0.matrix());
        let of_truesdell = TruesdellRate::of(&t, &rate, &l).upper_convected(deformation);
        same("Oldroyd of τ = J Truesdell of T", of_truesdell.0.matrix(), UpperConvectedRate::of(&k, &kirchhoff, &l).0.matrix());
    }

    #[test]
    fn material_rate_of_an_objective_rate_equals_the_one_it_was_made_from(path in path()) {
        let rate = MaterialRate(CauchyStress(path.stress[1]));
        let t = CauchyStress(path.stress[0]);
        let l = path.velocity_gradient();
        let spin = l.spin();
        let same = |what: &str, back: MaterialRate<CauchyStress>| {
            assert_same(what, &back.0.matrix(), &rate.0.matrix(), 1.0 + 2.0 * l.0.norm(), Tol::ulps(8.0));
        };
        same("Jaumann", JaumannRate::of(&t, &rate, &spin).material(&t, &spin));
        same("Oldroyd", UpperConvectedRate::of(&t, &rate, &l).material(&t, &l));
        same("Cotter–Rivlin", LowerConvectedRate::of(&t, &rate, &l).material(&t, &l));
        same("Truesdell", TruesdellRate::of(&t, &rate, &l).material(&t, &l));
    }
}
