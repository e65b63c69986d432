//! Drucker's condition over deformations of any axes, against closed forms and differences of the energy.

use nalgebra::Matrix3;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{Deformation, DeformationGradient, Symmetric};
use piola_solids::isochoric::{Gent, MooneyRivlin, NeoHookean};
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    Compressible, Fibre, Hencky, HolzapfelGasserOgden, Hyperelastic, IncompressibleSolid, Ogden, OgdenTerm,
    ReinforcedNeoHookean, SaintVenantKirchhoff,
};
use piola_specimens::checks::{Kinematics, Sampler, Search, drucker, drucker_path, drucker_scan, second_order_work};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

fn svk() -> SaintVenantKirchhoff {
    SaintVenantKirchhoff::new(0.0, 1.0).expect("parameters")
}

fn reinforced() -> ReinforcedNeoHookean {
    let fibre = Fibre::new([1.0, 2.0, 2.0]).expect("axis");
    ReinforcedNeoHookean::new(0.8, 3.0, 2.0, fibre).expect("parameters")
}

fn wall() -> HolzapfelGasserOgden {
    let fibres = [Fibre::in_plane(0.6).expect("fibre"), Fibre::in_plane(-0.6).expect("fibre")];
    HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 1.0, 0.1, fibres).expect("parameters")
}

fn drawn(sampler: &mut Sampler, strain: f64) -> DeformationGradient {
    DeformationGradient::new(sampler.gradient(strain)).expect("0 < det F")
}

/// The least dτ : dε of an isotropic law with dτᵢ/dεⱼ = slope(λᵢ) δᵢⱼ and τᵢ = stress(λᵢ).
fn least_of(stretches: [f64; 3], stress: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> f64 {
    let along = stretches.map(&slope);
    let across = [[0, 1], [1, 2], [0, 2]].map(|[i, j]| {
        let apart = stretches[i].ln() - stretches[j].ln();
        (stress(stretches[i]) - stress(stretches[j])) / apart
    });
    along.into_iter().chain(across).fold(f64::INFINITY, f64::min)
}

#[test]
fn henckys_modulus_is_the_same_everywhere() {
    let law = Hencky::new(2.0, 0.9).expect("parameters");
    for kinematics in [Kinematics::Free, Kinematics::Isochoric] {
        let scan = drucker_scan(&law, &Search { samples: 100, strain: 1.0, ..Search::default() }, kinematics);
        assert!(scan.passes() && scan.samples == 100 && scan.refused == 0, "{scan:?}");
        let rounding = Tol::ulps(64.0);
        assert_close("2 μ", &[scan.worst.modulus], &[1.8], rounding);
        assert_close_at_scale("tr h", &[scan.worst.increment.trace()], &[0.0], 1.0, rounding);
        assert_close("|h|", &[scan.worst.increment.matrix().norm()], &[1.0], Tol::ulps(16.0));
    }
    // λ < 0: the dilation is the softest, 3 λ + 2 μ.
    let law = Hencky::new(-0.3, 0.9).expect("parameters");
    let found = second_order_work(&law, &drawn(&mut Sampler::new(2), 0.5), Kinematics::Free);
    assert_close("3 λ + 2 μ", &[found.modulus], &[0.9], Tol::ulps(16.0));
}

#[test]
fn saint_venant_kirchhoff_loses_the_condition_where_its_closed_form_does() {
    // λ = 0: τ = μ (λ⁴ − λ²) and dτ/dε = 2 μ λ² (2 λ² − 1), zero at √½.
    let (stress, slope) = (|x: f64| x.powi(4) - x * x, |x: f64| 2.0 * x * x * (2.0 * x * x - 1.0));
    let path = |stretch: f64| [stretch, 1.0, 1.0];
    let lost = drucker_path(&svk(), path, 1.0, 0.5, 20, Kinematics::Free).first_loss.expect("a loss");
    assert_close("√½", &[lost], &[0.5_f64.sqrt()], Tol::ulps(64.0));
    // The first Piola–Kirchhoff stress P = τ/λ of the bar is stationary later, at √⅓: there dτ/dε = τ.
    let bar = DeformationGradient::uniaxial(3.0_f64.sqrt().recip(), 1.0).expect("F");
    let tangent = svk().first_piola_tangent(&bar);
    assert_close_at_scale("dP/dλ", &[tangent.entry(0, 0, 0, 0)], &[0.0], 1.0, Tol::ulps(16.0));
    let found = second_order_work(&svk(), &bar, Kinematics::Free);
    assert_close("τ", &[found.modulus], &[-2.0 / 9.0], Tol::ulps(16.0));
    let mut along = Symmetric::zero();
    along.components[0] = found.increment.components[0].signum();
    assert_close("along the bar", &found.increment.components, &along.components, Tol::ulps(64.0));
    // Everywhere: the condition holds as long as all stretches are above √½, along any axes.
    let search = Search { strain: 0.34, ..Search::default() };
    assert!(drucker_scan(&svk(), &search, Kinematics::Free).passes());
    let scan = drucker_scan(&svk(), &Search { strain: 0.8, ..search }, Kinematics::Free);
    assert!(!scan.passes());
    // The least of dτ/dε is −μ/4, where λ = ½.
    assert!((-0.25..-0.249).contains(&scan.worst.modulus), "{scan:?}");
    let mut sampler = Sampler::new(8);
    for _ in 0..100 {
        let f = drawn(&mut sampler, 0.8);
        let found = second_order_work(&svk(), &f, Kinematics::Free).modulus;
        let stretches = StretchAnalysis::of(&f).principal_stretches();
        let scale = stretches.into_iter().map(|x| slope(x).abs()).fold(1.0, f64::max);
        assert_close_at_scale("modulus", &[found], &[least_of(stretches, stress, slope)], scale, Tol::ulps(64.0));
    }
}

#[test]
fn worst_of_a_scan_is_the_least_of_its_samples() {
    let search = Search { samples: 60, strain: 0.6, ..Search::default() };
    for kinematics in [Kinematics::Free, Kinematics::Isochoric] {
        let scan = drucker_scan(&reinforced(), &search, kinematics);
        assert_eq!(second_order_work(&reinforced(), &scan.gradient, kinematics), scan.worst);
        for samples in [10, 20, 40] {
            let part = drucker_scan(&reinforced(), &Search { samples, ..search }, kinematics);
            assert!(scan.worst.modulus <= part.worst.modulus);
        }
        if kinematics == Kinematics::Isochoric {
            assert_close("det F", &[scan.gradient.jacobian()], &[1.0], Tol::ulps(32.0));
        }
    }
}

#[test]
fn laws_that_keep_the_condition_pass() {
    let wide = Search { samples: 200, strain: 1.0, ..Search::default() };
    let mooney = IncompressibleSolid::new(MooneyRivlin::new(0.37, 0.11).expect("parameters"));
    let scan = drucker_scan(&mooney, &wide, Kinematics::Free);
    assert!(scan.passes() && scan.samples == 200, "{scan:?}");
    assert_close_at_scale("tr h of |h| = 1", &[scan.worst.increment.trace()], &[0.0], 1.0, Tol::ulps(32.0));
    // W = Σ (μ/α) Σ λᵢ^α is convex in ln λᵢ where 0 < μ α.
    let terms = [OgdenTerm { modulus: 0.6, exponent: 1.3 }, OgdenTerm { modulus: -0.02, exponent: -2.0 }];
    let ogden = Ogden::new(&terms, 4.0).expect("terms");
    assert!(drucker_scan(&ogden, &wide, Kinematics::Isochoric).passes());
    // A falling stress in equibiaxial tension does not.
    let soft = IncompressibleSolid::new(MooneyRivlin::new(0.5, -0.1).expect("0 < C₁₀ + C₀₁"));
    let scan = drucker_scan(&soft, &wide, Kinematics::Free);
    assert!(!scan.passes() && scan.worst.modulus < 0.0, "{scan:?}");
    // The modulus of small shears.
    let rest = IncompressibleSolid::new(NeoHookean::new(0.8).expect("μ"));
    let found = second_order_work(&rest, &DeformationGradient::<f64>::identity(), Kinematics::Free);
    assert_close("2 μ", &[found.modulus], &[1.6], Tol::ulps(32.0));
}

#[test]
fn all_observers_find_the_same_modulus_and_increment() {
    fn same(law: &impl Hyperelastic) {
        let mut sampler = Sampler::new(21);
        for _ in 0..20 {
            let f = drawn(&mut sampler, 0.5);
            let turned = DeformationGradient::new(sampler.rotation() * f.matrix()).expect("0 < det F");
            for kinematics in [Kinematics::Free, Kinematics::Isochoric] {
                let (here, there) =
                    (second_order_work(law, &f, kinematics), second_order_work(law, &turned, kinematics));
                let moduli = law.first_piola_tangent(&f).0.components;
                let scale = moduli.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                assert_close_at_scale("modulus", &[here.modulus], &[there.modulus], scale, Tol::ulps(64.0));
                // Up to its sign; where two moduli are near one another their increments mix.
                let along = here.increment.matrix().dot(&there.increment.matrix()).abs();
                assert_close("increment", &[along], &[1.0], Tol::ulps(64.0));
            }
        }
    }
    same(&svk());
    same(&reinforced());
    same(&wall());
}

#[test]
fn fixed_axes_are_a_part_of_all_increments() {
    let mut sampler = Sampler::new(4);
    for _ in 0..40 {
        let stretches = sampler.stretches(0.5);
        let f = DeformationGradient::diagonal(stretches).expect("F");
        for kinematics in [Kinematics::Free, Kinematics::Isochoric] {
            // Isotropic and stiff in shear: the same.
            let law = Compressible::new(Gent::new(0.8, 30.0).expect("J_m"), Quadratic::new(5.0).expect("κ"));
            let (all, fixed) = (second_order_work(&law, &f, kinematics), drucker(&law, stretches, kinematics));
            assert!(all.modulus <= fixed.modulus + 1e-13, "{all:?} {fixed:?}");
            let law = reinforced();
            let (all, fixed) = (second_order_work(&law, &f, kinematics), drucker(&law, stretches, kinematics));
            assert!(all.modulus < fixed.modulus, "{all:?} {fixed:?}");
        }
    }
}

/// W(R e^(H + s h)) on both sides of s = 0, in fourth order.
#[test]
fn modulus_equals_second_differences_of_the_energy_and_is_their_least() {
    fn compare(law: &impl Hyperelastic) {
        let mut sampler = Sampler::new(13);
        for _ in 0..10 {
            let f = drawn(&mut sampler, 0.4);
            let analysis = StretchAnalysis::of(&f);
            let rotation = Matrix3::from(analysis.rotation()).transpose();
            let strain = analysis.hencky_material();
            let work = |h: &Symmetric<f64>| {
                let at = |s: f64| {
                    let moved = (strain + *h * s).matrix();
                    let gradient = rotation * moved.exp();
                    law.energy(&DeformationGradient::new(gradient).expect("0 < det F"))
                };
                let second = |s: f64| (at(s) - 2.0 * at(0.0) + at(-s)) / (s * s);
                (4.0 * second(2e-3) - second(4e-3)) / 3.0
            };
            let moduli = law.first_piola_tangent(&f).0.components;
            let scale = moduli.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let tolerance = Tol::stated(1e-8, "differences of fourth order, s = 2e-3").times(scale);
            let free = second_order_work(law, &f, Kinematics::Free);
            let tied = second_order_work(law, &f, Kinematics::Isochoric);
            for found in [free, tied] {
                assert_close_at_scale("h : W″ h", &[work(&found.increment)], &[found.modulus], 1.0, tolerance);
            }
            assert_close_at_scale("tr h", &[tied.increment.trace()], &[0.0], 1.0, Tol::ulps(16.0));
            assert!(free.modulus <= tied.modulus + 1e-13 * scale);
            for _ in 0..40 {
                let h = Matrix3::from_fn(|_, _| sampler.balanced());
                let h = h + h.transpose();
                let rows = |h: Matrix3<f64>| Symmetric::symmetric_part(h.transpose().into()) * h.norm().recip();
                assert!(free.modulus - tolerance.value() <= work(&rows(h)));
                let h = h - Matrix3::identity() * (h.trace() / 3.0);
                assert!(tied.modulus - tolerance.value() <= work(&rows(h)));
            }
        }
    }
    compare(&svk());
    compare(&reinforced());
    compare(&Compressible::new(Gent::new(0.8, 30.0).expect("J_m"), Quadratic::new(5.0).expect("κ")));
}

#[test]
fn where_the_law_has_no_answer_nothing_is_said() {
    let gent = |limit| Compressible::new(Gent::new(0.8, limit).expect("J_m"), Quadratic::new(5.0).expect("κ"));
    let search = Search { samples: 30, ..Search::default() };
    let scan = drucker_scan(&gent(1e-9), &search, Kinematics::Free);
    assert!(!scan.passes() && scan.samples == 0 && scan.refused == 30 && scan.worst.modulus.is_nan(), "{scan:?}");
    let scan = drucker_scan(&gent(0.2), &search, Kinematics::Isochoric);
    assert!(0 < scan.refused && 0 < scan.samples && scan.samples + scan.refused == 30, "{scan:?}");
    assert!(scan.passes(), "{scan:?}");
    assert!(!drucker_scan(&gent(1.0), &Search { samples: 0, ..search }, Kinematics::Free).passes());
    let far = DeformationGradient::diagonal([3.0, 1.0, 1.0]).expect("F");
    assert!(second_order_work(&gent(0.2), &far, Kinematics::Free).modulus.is_nan());
}
