//! σ̊ = C : D for each objective rate, with the rate of the stress by dual numbers along a motion.

use nalgebra::Matrix3;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::rates::{GradientRate, RateOfDeformation, StretchRates};
use piola_continuum::stress::tangents::ObjectiveRate::{
    GreenNaghdi, Jaumann, Logarithmic, LowerConvected, UpperConvected,
};
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Dual, Real};
use piola_tensor::internal::rows::{Rows, product, product_transposed, sum, transpose};
use piola_tensor::{PairSymmetric, Skew};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{deformation, nine, rows};
use super::energies::{FIBRES, first_piola, green, material, second_piola};

/// What a motion with given F and Ḟ does to the Kirchhoff stress of an energy.
struct Moving {
    rate: GradientRate,
    velocity_gradient: Rows<f64>,
    kirchhoff: Symmetric,
    /// τ̇.
    kirchhoff_rate: Symmetric,
    /// Ṙ Rᵀ.
    polar_spin: Skew,
}

fn moving(d: DeformationGradient, rate: Rows<f64>, fibres: f64) -> Moving {
    let f = d.gradient_rows();
    let f: Rows<Dual<f64>> =
        core::array::from_fn(|i| core::array::from_fn(|a| Dual { value: f[i][a], tangent: rate[i][a] }));
    let stress = second_piola(&green(f), fibres).0.congruence(f);
    let dual = DeformationGradient::new(from_rows(f)).expect("0 < det F");
    let rotation = StretchAnalysis::of(&dual).rotation();
    let part = |part: fn(Dual<f64>) -> f64| rotation.map(|row| row.map(part));
    let (r, r_rate) = (part(|x| x.value), part(|x| x.tangent));
    Moving {
        rate: GradientRate(from_rows(rate)),
        velocity_gradient: product(rate, d.inverse_rows()),
        kirchhoff: Symmetric { components: stress.components.map(|x| x.value) },
        kirchhoff_rate: Symmetric { components: stress.components.map(|x| x.tangent) },
        polar_spin: Skew::skew_part(product_transposed(r_rate, r)),
    }
}

/// A + Aᵀ.
fn both<T: Real>(a: Rows<T>) -> Symmetric<T> {
    Symmetric::symmetric_part(sum(a, transpose(a)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn objective_rates_of_the_stress_equal_the_tangents_times_the_stretching(d in deformation(), rate in rows()) {
        for fibres in FIBRES {
            let m = moving(d, rate, fibres);
            let (j, l) = (d.jacobian(), m.velocity_gradient);
            let stretching = RateOfDeformation(Symmetric::symmetric_part(l));
            let (tau, tau_rate, tr) = (m.kirchhoff, m.kirchhoff_rate, stretching.0.trace());
            let cauchy = CauchyStress(tau / j);
            let cauchy_rate = (tau_rate - tau * tr) / j;
            let spin = Skew::skew_part(l);
            let logarithmic_spin = StretchRates::of(&d, &m.rate).logarithmic_spin();
            let logarithmic_spin = Skew { axial: logarithmic_spin.axial.into() };

            let c: MaterialTangent =
                MaterialTangent(material(&green(d.gradient_rows()), fibres).major_symmetric().expect("an energy"));
            let truesdell = c.truesdell(&d);
            let jaumann = truesdell.jaumann(&cauchy);
            let of_kirchhoff = |rate| truesdell.of_kirchhoff_rate(rate, &cauchy, &d).contract(&stretching.0);
            let of_cauchy = |rate| truesdell.of_cauchy_rate(rate, &cauchy, &d).contract(&stretching.0);

            let size = c.0.norm() * 16.0 * stretching.0.norm() + tau_rate.norm() + tau.norm();
            let check = |what: &str, rate: Symmetric, expected: Symmetric| {
                assert_close_at_scale(what, &nine(&rate), &nine(&expected), size, Tol::ulps_because(256.0, "sums of some hundred products"));
            };
            let lie = tau_rate - both(product(l, tau.rows()));
            check("Lie", c.lie(&d).rate(&stretching).0.0, lie);
            check("Truesdell", truesdell.rate(&stretching).0.0, lie / j);
            check("Jaumann", jaumann.rate(&stretching), (tau_rate - spin.turning(&tau)) / j);
            check("upper", of_kirchhoff(UpperConvected), lie / j);
            check("lower", of_kirchhoff(LowerConvected), (tau_rate + both(product(tau.rows(), l))) / j);
            check("Green–Naghdi", of_kirchhoff(GreenNaghdi), (tau_rate - m.polar_spin.turning(&tau)) / j);
            check("logarithmic", of_kirchhoff(Logarithmic), (tau_rate - logarithmic_spin.turning(&tau)) / j);

            let t = cauchy.0;
            check("Jaumann of T", of_cauchy(Jaumann), cauchy_rate - spin.turning(&t));
            check(
                "upper of T",
                of_cauchy(UpperConvected),
                cauchy_rate - both(product(l, t.rows())),
            );
            check(
                "lower of T",
                of_cauchy(LowerConvected),
                cauchy_rate + both(product(t.rows(), l)),
            );
            check(
                "Green–Naghdi of T",
                of_cauchy(GreenNaghdi),
                cauchy_rate - m.polar_spin.turning(&t),
            );
            check(
                "logarithmic of T",
                of_cauchy(Logarithmic),
                cauchy_rate - logarithmic_spin.turning(&t),
            );
        }
    }

    #[test]
    fn rate_of_first_piola_stress_equals_its_tangent_times_the_rate_of_f(d in deformation(), rate in rows()) {
        for fibres in FIBRES {
            let m = moving(d, rate, fibres);
            let tangent = FirstPiolaTangent(first_piola(d.gradient_rows(), fibres).1);
            let first_piola = tangent.rate(&m.rate);
            // τ̇ = Ṗ Fᵀ + P Ḟᵀ, P = τ F⁻ᵀ.
            let p = product_transposed(m.kirchhoff.rows(), d.inverse_rows());
            let sum = sum(
                product_transposed(first_piola.rows(), d.gradient_rows()),
                product_transposed(p, m.rate.rows()),
            );
            let size = tangent.0.components.as_flattened().iter().fold(1.0_f64, |a, b| a.max(b.abs())) * 16.0;
            let expected = nine(&m.kirchhoff_rate);
            assert_close_at_scale("dτ/dt", sum.as_flattened(), &expected, size, Tol::ulps_because(256.0, "sums of some hundred products"));
        }
    }
}

#[test]
fn at_rest_all_rates_have_one_tangent() {
    let d = DeformationGradient::new(Matrix3::identity()).expect("0 < det F");
    let c: MaterialTangent = MaterialTangent(material(&Symmetric::zero(), 3.0).major_symmetric().expect("an energy"));
    let unstressed = CauchyStress::zero();
    let truesdell = c.truesdell(&d);
    assert_eq!(truesdell.jaumann(&unstressed).0, c.0);
    for rate in [UpperConvected, Jaumann, LowerConvected, GreenNaghdi, Logarithmic] {
        assert_eq!(truesdell.of_kirchhoff_rate(rate, &unstressed, &d), c.0.minor());
        assert_eq!(truesdell.of_cauchy_rate(rate, &unstressed, &d), c.0.minor());
    }
}
