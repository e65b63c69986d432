//! Solids with memory against closed forms.

use nalgebra::Matrix3;
use piola_continuum::strain::GreenStrain;
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_numerics::{Dual, Real};
use piola_solids::memory::{History, Prony, PronyTerm, Reduced, Remembered, SimpleMaterial, Viscoelastic};
use piola_solids::{Hyperelastic, MooneyRivlin};
use piola_specimens::checks::{Search, history_indifference};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale, assert_order};

/// S = λ tr E 1 + 2 μ E.
#[derive(Clone)]
struct Quadratic {
    lambda: f64,
    mu: f64,
}

impl Hyperelastic for Quadratic {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let trace = strain.trace();
        T::lit(0.5 * self.lambda) * trace * trace + T::lit(self.mu) * strain.double_contraction(&strain)
    }
}

fn series() -> Prony {
    let term = |weight, time| PronyTerm { weight, time };
    Prony::new(vec![term(0.5, 0.1), term(0.25, 1.0), term(0.125, 30.0)]).expect("series")
}

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

fn overstress() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.8, 0.1, 0.5).expect("parameters")
}

fn solid() -> Viscoelastic<MooneyRivlin, MooneyRivlin> {
    Viscoelastic::new(rubber(), overstress(), series())
}

fn some_deformation() -> DeformationGradient {
    DeformationGradient::from_rows([[1.3, 0.4, -0.1], [0.2, 0.9, 0.3], [0.0, -0.2, 1.2]]).expect("0 < det F")
}

#[test]
fn factors_of_a_step_equal_those_in_twice_the_precision() {
    use piola_testkit::DoubleDouble;
    for k in -120..=120 {
        let x = 10.0_f64.powf(0.1 * f64::from(k));
        let series = Prony::new(vec![PronyTerm { weight: 1.0, time: 1.0 }]).expect("series");
        let step = series.step(x).expect("step");
        let wide = DoubleDouble::lit(x);
        let share = (-(-wide).exp_m1() / wide).primal(0);
        assert_close(&format!("φ({x:e})"), &[step.share(0).expect("a term")], &[share], Tol::ulps(4.0));
        let decay = (-wide).exp().primal(0);
        assert_close_at_scale(
            &format!("exp(−{x:e})"),
            &[step.decay(0).expect("a term")],
            &[decay],
            1e-300,
            Tol::ulps(4.0),
        );
    }
    let step = series().step(f64::MAX).expect("step");
    assert!(step.decay(0).is_some_and(|x| x <= 0.0) && step.share(0).is_some_and(|x| x < 1e-300));
    let jump = series().step(0.0).expect("step");
    assert_eq!((jump.decay(0), jump.share(0), jump.share(3)), (Some(1.0), Some(1.0), None));
}

#[test]
fn relaxation_equals_the_series_however_the_time_is_divided() {
    let (solid, f) = (solid(), some_deformation());
    let (rest, driving) = (rubber().second_piola(&f).0, overstress().second_piola(&f).0);
    for steps in [vec![1e-12, 0.1, 0.05, 2.0, 1e3], vec![1.0; 40], vec![1e-3; 100], vec![1e12]] {
        let mut state = solid.at_rest();
        solid.advance(&mut state, &f, &series().step(0.0).expect("step"));
        let mut time = 0.0;
        for duration in steps {
            time += duration;
            let step = series().step(duration).expect("step");
            let stress = solid.second_piola(&state, &f, &step).0;
            let expected = rest + driving * series().relaxation(time);
            assert_close(&format!("S({time})"), &stress.components, &expected.components, Tol::ulps(16.0));
            solid.advance(&mut state, &f, &step);
        }
    }
}

#[test]
fn ramp_of_the_green_strain_is_integrated_exactly_at_finite_strain() {
    // S_D is linear in E, and E in time.
    let law = Quadratic { lambda: 1.5, mu: 1.0 };
    let solid = Viscoelastic::new(law.clone(), law.clone(), series());
    let at = |time: f64| {
        let stretch = |rate: f64| (1.0 + 2.0 * rate * time).sqrt();
        DeformationGradient::diagonal([stretch(0.4), stretch(-0.1), stretch(0.2)]).expect("stretches")
    };
    let rate = law.second_piola(&at(1.0)).0;
    for count in [1, 2, 7, 100] {
        let step = series().step(2.0 / f64::from(count)).expect("step");
        let mut state = solid.at_rest();
        for k in 1..count {
            solid.advance(&mut state, &at(2.0 * f64::from(k) / f64::from(count)), &step);
        }
        let stress = solid.second_piola(&state, &at(2.0), &step).0;
        // h = τ (1 − exp(−t/τ)) Ṡ.
        let share: f64 = series().terms().iter().map(|p| -p.weight * p.time * (-2.0 / p.time).exp_m1()).sum();
        let expected = rate * (2.0 + share);
        assert_close(&format!("{count} steps"), &stress.components, &expected.components, Tol::ulps(16.0));
    }
}

/// The shear stress of small shears in equal steps, and the largest error of it against `expected`.
fn sheared(count: u32, end: f64, amount: impl Fn(f64) -> f64, expected: impl Fn(f64) -> f64) -> f64 {
    let solid = solid();
    let step = series().step(end / f64::from(count)).expect("step");
    let mut state = solid.at_rest();
    let mut worst = 0.0_f64;
    for k in 1..=count {
        let time = end * f64::from(k) / f64::from(count);
        let shear = DisplacementGradient::simple_shear(1e-9 * amount(time)).expect("shear");
        let stress = 1e9 * solid.cauchy(&state, &shear, &step).0.components[3];
        if 0.5 * end <= time {
            worst = worst.max((stress - expected(time)).abs());
        }
        solid.advance(&mut state, &shear, &step);
    }
    worst
}

#[test]
fn oscillation_equals_storage_and_loss_to_second_order() {
    let (mu, nu) = (rubber().shear_modulus(), overstress().shear_modulus());
    // Starting from rest leaves a transient: the closed form has it.
    let omega = 3.0;
    let expected = |time: f64| {
        let mut sum = mu * (omega * time).sin();
        for term in series().terms() {
            let x = omega * term.time;
            let steady = x * x * (omega * time).sin() + x * (omega * time).cos() - x * (-time / term.time).exp();
            sum += nu * term.weight * steady / (1.0 + x * x);
        }
        sum
    };
    let errors = [400, 800].map(|count| sheared(count, 8.0, |time| (omega * time).sin(), expected));
    // Of the second order: half of the step leaves a quarter of the error.
    assert_order("oscillation", &[1.0, 0.5], &errors, 2.0, 0.07);
    assert!(errors[1] < Tol::order(8.0 / 800.0, 2).value(), "{errors:?}");
    // The steady part is that of the moduli.
    let terms = series();
    let (storage, loss) = (terms.storage(omega), terms.loss(omega));
    let by_hand = terms.terms().iter().fold([0.0; 2], |[a, b], p| {
        let x = omega * p.time;
        [a + p.weight * x * x / (1.0 + x * x), b + p.weight * x / (1.0 + x * x)]
    });
    assert_close("g′, g″", &[storage, loss], &by_hand, Tol::ulps(4.0));
    assert_close("g′(∞), g″(0)", &[terms.storage(1e300), terms.loss(0.0)], &[terms.sum(), 0.0], Tol::ulps(4.0));
}

#[test]
fn creep_equals_the_closed_form_to_second_order() {
    // One term: k(t) = σ/G [1 − g/(G + g) exp(−t/τ_c)], τ_c = τ (G + g)/G, with the moduli G at rest and g that relaxes.
    let (tau, weight) = (0.7, 0.6);
    let series = Prony::new(vec![PronyTerm { weight, time: tau }]).expect("series");
    let solid = Viscoelastic::new(rubber(), overstress(), series.clone());
    let (rest, relaxing) = (rubber().shear_modulus(), weight * overstress().shear_modulus());
    let (stress, end) = (1e-9, 4.0);
    let run = |count: u32| {
        let mut state = solid.at_rest();
        let mut worst = 0.0_f64;
        for k in 0..=count {
            let time = end * f64::from(k) / f64::from(count);
            let step = series.step(if k == 0 { 0.0 } else { end / f64::from(count) }).expect("step");
            // One Newton step with the consistent tangent: the response to small shears is linear.
            let trial = DisplacementGradient::<f64>::zero();
            let (p, tangent) = solid.first_piola_and_tangent(&state, &trial, &step);
            let amount = (stress - p.0[(1, 0)]) / tangent.entry(1, 0, 1, 0);
            let shear = DisplacementGradient::simple_shear(amount).expect("shear");
            let reached = solid.cauchy(&state, &shear, &step).0.components[3];
            assert_close("σ", &[reached], &[stress], Tol::ulps(64.0));
            let late = rest * tau.recip() / (rest + relaxing) * time;
            let expected = stress / rest * (1.0 - relaxing / (rest + relaxing) * (-late).exp());
            worst = worst.max((amount / expected - 1.0).abs());
            solid.advance(&mut state, &shear, &step);
        }
        worst
    };
    let errors = [run(100), run(200)];
    assert_order("creep", &[1.0, 0.5], &errors, 2.0, 0.07);
    assert!(errors[1] < Tol::order(end / 200.0, 2).times(1.0 / 40.0).value(), "{errors:?}");
}

#[test]
fn consistent_tangents_equal_derivatives_by_dual_numbers() {
    let solid = solid();
    let mut state = solid.at_rest();
    let first = DeformationGradient::from_rows([[0.9, 0.2, 0.0], [0.1, 1.2, 0.0], [0.3, 0.0, 1.1]]).expect("F");
    for duration in [1e-12, 1e-3, 0.3, 50.0, 1e12] {
        let step = series().step(duration).expect("step");
        solid.advance(&mut state, &first, &step);
        let f = some_deformation();
        let (stress, tangent) = solid.first_piola_and_tangent(&state, &f, &step);
        let lifted = state.lifted(Dual::constant);
        let scale = tangent.0.components.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        for k in 0..3 {
            for b in 0..3 {
                let varied = f.lifted(|i, j, x| if (i, j) == (k, b) { Dual::variable(x) } else { Dual::constant(x) });
                let along = solid.first_piola(&lifted, &varied, &step).0;
                assert_close("P", along.map(|x| x.value).as_slice(), stress.0.as_slice(), Tol::ulps(64.0));
                let expected: Vec<f64> = (0..9).map(|n| along[(n / 3, n % 3)].tangent).collect();
                let found: Vec<f64> = (0..9).map(|n| tangent.entry(n / 3, n % 3, k, b)).collect();
                assert_close_at_scale("∂P/∂F", &found, &expected, scale, Tol::ulps(32.0));
            }
        }
    }
}

#[test]
fn stress_of_turned_histories_equals_the_turned_stress() {
    let solid = solid();
    let material = Remembered::new(&solid, 2.0, 40).expect("horizon");
    let report = history_indifference(&material, 1.0, &Search { samples: 30, ..Search::default() });
    assert!(report.passes(), "{}", report.size);
}

/// T = U(0)² − ∫ e^(−s) U(s) ds, by a sum: a law written in U-histories.
struct OfStretches;

impl SimpleMaterial for OfStretches {
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        let now = history.gradient(0.0);
        let past = (1..20).map(|k| 0.2 * f64::from(k)).map(|s| history.gradient(s) * (0.2 * (-s).exp()));
        now * now - past.sum::<Matrix3<f64>>()
    }
}

#[test]
fn reduced_form_makes_functionals_indifferent_and_keeps_those_that_are() {
    let search = Search { samples: 30, ..Search::default() };
    assert!(!history_indifference(&OfStretches, 1.0, &search).passes());
    let report = history_indifference(&Reduced(OfStretches), 1.0, &search);
    assert!(report.passes(), "{}", report.size);
    // A frame-indifferent material equals its reduced form.
    let solid = solid();
    let material = Remembered::new(&solid, 2.0, 25).expect("horizon");
    let history = |s: f64| {
        let turn = nalgebra::Rotation3::new(nalgebra::Vector3::new(0.3, -1.0, 0.7) * s).into_inner();
        turn * Matrix3::new(1.0 + 0.2 * s.cos(), 0.3, 0.0, 0.1 * s, 1.1, 0.2, 0.0, 0.0, 0.9)
    };
    let (whole, reduced) = (material.cauchy(&history), Reduced(material).cauchy(&history));
    assert_close("T", reduced.as_slice(), whole.as_slice(), Tol::ulps(64.0));
    let inside_out = |_: f64| -Matrix3::<f64>::identity();
    assert!(Reduced(OfStretches).cauchy(&inside_out)[(0, 0)].is_nan() && material.cauchy(&inside_out)[(0, 0)].is_nan());
}

#[test]
fn relaxing_solid_goes_from_the_law_to_its_share() {
    let solid = Viscoelastic::relaxing(rubber(), series()).expect("sum below 1");
    let f = some_deformation();
    let fast = solid.second_piola(&solid.at_rest(), &f, &series().step(0.0).expect("step")).0;
    let slow = solid.second_piola(&solid.at_rest(), &f, &series().step(1e20).expect("step")).0;
    let law = rubber().second_piola(&f).0;
    assert_close("fast", &fast.components, &law.components, Tol::ulps(16.0));
    assert_close("slow", &slow.components, &(law * 0.125).components, Tol::ulps(64.0));
}

#[test]
fn steps_allocate_nothing() {
    let solid = solid();
    let mut state = solid.at_rest();
    let mut step = series().step(0.1).expect("step");
    let f = some_deformation();
    let (count, ()) = allocations_in(|| {
        for _ in 0..10 {
            solid.prony().step_into(0.2, &mut step).expect("step");
            let _ = std::hint::black_box(solid.first_piola_and_tangent(&state, &f, &step));
            solid.advance(&mut state, &f, &step);
        }
    });
    assert_eq!(count, 0);
}

#[test]
fn bad_series_steps_and_states_are_refused() {
    let term = |weight, time| Prony::new(vec![PronyTerm { weight, time }]);
    for bad in [term(-0.1, 1.0), term(f64::NAN, 1.0), term(0.1, 0.0), term(0.1, -1.0), term(0.1, f64::INFINITY)] {
        assert!(bad.is_err());
    }
    for duration in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(series().step(duration).is_err());
    }
    let (one, three) = (Viscoelastic::new(rubber(), rubber(), term(0.1, 1.0).expect("series")), solid());
    assert!(one.check_state(&three.at_rest()).is_err() && three.check_state(&three.at_rest()).is_ok());
    assert!(Remembered::new(&three, 0.0, 1).is_err() && Remembered::new(&three, 1.0, 0).is_err());
}

#[test]
fn step_of_another_series_is_refused_and_answers_no_number() {
    let one = Prony::new(vec![PronyTerm { weight: 0.5, time: 0.1 }]).expect("series");
    let (solid, f) = (solid(), some_deformation());
    let (own, foreign) = (series().step(0.3).expect("step"), one.step(0.3).expect("step"));
    assert!(solid.check_step(&own).is_ok() && solid.check_step(&foreign).is_err());
    let mut state = solid.at_rest();
    assert!(solid.cauchy(&state, &f, &own).0.components[3].is_finite());
    // Terms left out would be a smaller stress that nobody would doubt.
    assert!(solid.cauchy(&state, &f, &foreign).0.components[3].is_nan());
    assert!(solid.material_tangent(&f, &foreign).0.components[0].is_nan());
    solid.advance(&mut state, &f, &foreign);
    assert!(state.driving().components[0].is_nan());
}

#[cfg(feature = "serde")]
#[test]
fn laws_and_states_are_read_as_they_were_written() {
    let solid = solid();
    let mut state = solid.at_rest();
    solid.advance(&mut state, &some_deformation(), &series().step(0.3).expect("step"));
    let written = serde_json::to_string(&(&solid, &state)).expect("written");
    let (law, read): (Viscoelastic<MooneyRivlin, MooneyRivlin>, piola_solids::memory::ViscoelasticState) =
        serde_json::from_str(&written).expect("read");
    assert_eq!((&law, &read), (&solid, &state));
    assert_ne!(read.driving(), &piola_continuum::Symmetric::zero());
    assert!(serde_json::from_str::<Prony>(r#"[{"weight": 0.5, "time": -1.0}]"#).is_err());
    // A law of fast loading, of which a share is at rest.
    let relaxing = Viscoelastic::relaxing(rubber(), series()).expect("Σ g ≤ 1");
    let written = serde_json::to_string(&relaxing).expect("written");
    let read: Viscoelastic<piola_solids::memory::Scaled<MooneyRivlin>, MooneyRivlin> =
        serde_json::from_str(&written).expect("read");
    assert_eq!(read, relaxing);
    let negative = written.replacen("\"factor\":0.125", "\"factor\":-0.125", 1);
    assert_ne!(negative, written);
    assert!(
        serde_json::from_str::<Viscoelastic<piola_solids::memory::Scaled<MooneyRivlin>, MooneyRivlin>>(&negative)
            .is_err()
    );
}
