//! Laws that violate a claim are caught, and good ones pass.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::strain::GreenStrain;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, MooneyRivlin};
use piola_specimens::checks::{
    ChangedReference, CrystalClass, Elastic, Kinematics, Sampler, Search, Stored, SymmetryGroup, acoustic_tensor,
    baker_ericksen, drucker, drucker_path, ellipticity, ellipticity_scan, first_loss, frame_indifference,
    hyperelasticity, material_symmetry, noll, potential,
};
use piola_specimens::homogeneous::Mode;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

fn search() -> Search {
    Search { samples: 200, ..Search::default() }
}

/// W = ½ λ (tr E)² + μ E : E, and a fibre `½ k E_ff²` along a direction.
struct Quadratic {
    lambda: f64,
    mu: f64,
    fibre: f64,
    along: [f64; 3],
}

impl Hyperelastic for Quadratic {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let trace = strain.trace();
        let along = self.along.map(T::lit);
        let turned = strain.apply(along);
        let stretch = along[0] * turned[0] + along[1] * turned[1] + along[2] * turned[2];
        T::lit(0.5 * self.lambda) * trace * trace
            + T::lit(self.mu) * strain.double_contraction(&strain)
            + T::lit(0.5 * self.fibre) * stretch * stretch
    }
}

/// W = ½ |F − 1|²: changes with the observer.
struct OfDisplacement;

impl Hyperelastic for OfDisplacement {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let h = deformation.displacement_rows();
        h.as_flattened().iter().fold(T::zero(), |sum, &x| sum + x * x) * T::lit(0.5)
    }
}

/// Cubic: `W = Σ E_ii²` (not an invariant of all rotations) + ½ tr² E.
struct Cubic;

impl Hyperelastic for Cubic {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let [a, b, c, d, e, f] = strain.components;
        let trace = strain.trace();
        (a * a + b * b + c * c) + T::lit(0.5) * trace * trace + T::lit(0.3) * (d * d + e * e + f * f)
    }
}

#[test]
fn stress_of_a_turned_body_equals_the_turned_stress() {
    assert!(frame_indifference(&Stored(&rubber()), &search()).passes());
    // T = F Fᵀ F keeps an F too many.
    let bad = |f: &Matrix3<f64>| f * f.transpose() * f;
    let report = frame_indifference(&bad, &search());
    let worst = report.worst.expect("a sample");
    assert!(0.1 < report.size && !report.passes(), "{}", report.size);
    // The counterexample is one.
    let turned = worst.rotation * worst.stress * worst.rotation.transpose();
    assert!(0.1 < (bad(&(worst.rotation * worst.gradient)) - turned).norm() / worst.stress.norm());
    assert_eq!(report, frame_indifference(&bad, &search()), "the same search gives the same report");
    let blind = |_: &Matrix3<f64>| Matrix3::from_element(f64::NAN);
    assert!(frame_indifference(&blind, &search()).size.is_infinite());
}

#[test]
fn closure_of_the_generators_has_the_order_of_the_crystal_class() {
    for class in CrystalClass::ALL {
        let group = SymmetryGroup::crystal(class);
        assert_eq!(group.order(), Some(class.order()), "{class:?}");
        let generated = SymmetryGroup::generated(&class.generators(), 48).expect("finite");
        assert_eq!(generated.order(), Some(class.order()), "{class:?}");
        let mut sampler = Sampler::new(0);
        for k in 0..class.order() {
            let q = group.element(k, &mut sampler);
            let defect = (q * q.transpose() - Matrix3::identity()).norm();
            assert_close_at_scale("QQᵀ − 1", &[defect, q.determinant() - 1.0], &[0.0; 2], 1.0, Tol::ulps(64.0));
        }
    }
    let symbols = "1 -1 2 m 2/m 222 mm2 mmm 4 -4 4/m 422 4mm -42m 4/mmm 3 -3 32 3m -3m 6 -6 6/m 622 6mm -6m2 6/mmm \
                   23 m-3 432 -43m m-3m";
    assert_eq!(symbols.split_whitespace().filter_map(CrystalClass::of_symbol).count(), 32);
}

#[test]
fn anisotropic_laws_keep_their_group_and_no_larger_one() {
    let isotropic = SymmetryGroup::isotropic();
    assert!(material_symmetry(&Stored(&rubber()), &isotropic, &search()).passes());
    assert!(!material_symmetry(&Stored(&rubber()), &SymmetryGroup::fluid(), &search()).passes());
    let gas = |f: &Matrix3<f64>| Matrix3::identity() * -(1.0 / f.determinant());
    assert!(material_symmetry(&gas, &SymmetryGroup::fluid(), &search()).passes());

    let axis = [0.6, 0.0, 0.8];
    let fibred = Quadratic { lambda: 1.0, mu: 1.0, fibre: 5.0, along: axis };
    let about = SymmetryGroup::transversely_isotropic(axis).expect("axis");
    assert!(material_symmetry(&Stored(&fibred), &about, &search()).passes());
    let report = material_symmetry(&Stored(&fibred), &isotropic, &search());
    let worst = report.worst.expect("a sample");
    assert!(0.1 < report.size);
    let image = Stored(&fibred).cauchy(&(worst.gradient * worst.element));
    assert!(0.1 < (image - worst.stress).norm() / image.norm().max(worst.stress.norm()));

    for class in CrystalClass::ALL {
        let passes = material_symmetry(&Stored(&Cubic), &SymmetryGroup::crystal(class), &search()).passes();
        let threefold_about_3 = matches!(
            class,
            CrystalClass::TrigonalLow
                | CrystalClass::TrigonalHigh
                | CrystalClass::HexagonalLow
                | CrystalClass::HexagonalHigh
        );
        assert_eq!(passes, !threefold_about_3, "{class:?}");
    }
    assert!(!material_symmetry(&Stored(&Cubic), &isotropic, &search()).passes());
}

/// W = ½ |E|² and one more invariant of a turn about e₃, of z = E₁₁ − E₂₂ + 2i E₁₂ and w = E₁₃ + i E₂₃, which turn
/// twice and once with the axes.
struct About {
    /// How often the invariant turns with the axes: 3 of z w, 4 of z², 6 of z³.
    fold: u32,
    /// Its imaginary part instead of its real one.
    imaginary: bool,
}

impl Hyperelastic for About {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        let [a, b, _, d, e, f] = strain.components;
        let times = |x: [T; 2], y: [T; 2]| [x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]];
        let (z, w) = ([a - b, d + d], [f, e]);
        let [real, imaginary] = match self.fold {
            3 => times(z, w),
            4 => times(z, z),
            _ => times(times(z, z), z),
        };
        T::lit(0.5) * strain.double_contraction(&strain) + if self.imaginary { imaginary } else { real }
    }
}

#[test]
fn half_turns_of_the_high_classes_are_about_the_first_axis() {
    use CrystalClass::{HexagonalHigh, HexagonalLow, TetragonalHigh, TetragonalLow, TrigonalHigh, TrigonalLow};
    // A half turn about e₁ takes z to its conjugate and w to the negative of its own.
    for (fold, kept, low, high) in [
        (3, true, TrigonalLow, TrigonalHigh),
        (4, false, TetragonalLow, TetragonalHigh),
        (6, false, HexagonalLow, HexagonalHigh),
    ] {
        for imaginary in [false, true] {
            let law = About { fold, imaginary };
            let passes = |class| material_symmetry(&Stored(&law), &SymmetryGroup::crystal(class), &search()).passes();
            assert!(passes(low), "{low:?}, {imaginary}");
            assert_eq!(passes(high), imaginary == kept, "{high:?}, {imaginary}");
        }
    }
    for (symbol, class) in [("-4m2", TetragonalHigh), ("-62m", HexagonalHigh), ("31m", TrigonalHigh)] {
        assert_eq!(CrystalClass::of_symbol(symbol), Some(class));
    }
}

#[test]
fn group_of_a_changed_reference_is_the_conjugate_group() {
    let held = DeformationGradient::from_rows([[1.4, 0.3, 0.0], [0.0, 0.8, 0.1], [0.0, 0.0, 1.1]]).expect("K");
    let told = ChangedReference::new(rubber(), &held);
    let (old, new) = (SymmetryGroup::isotropic(), SymmetryGroup::isotropic().under(held.matrix()).expect("regular"));
    assert!(!material_symmetry(&Stored(&told), &old, &search()).passes());
    assert!(material_symmetry(&Stored(&told), &new, &search()).passes());
    // And back again.
    let back = new.under(held.inverse().expect("K⁻¹").matrix()).expect("regular");
    assert!(material_symmetry(&Stored(&rubber()), &back, &search()).passes());
    assert!(SymmetryGroup::isotropic().under(&Matrix3::zeros()).is_err());
    // The stress is the same, told from either reference.
    let mut sampler = Sampler::new(3);
    for _ in 0..50 {
        let gradient = sampler.gradient(0.5);
        let as_response = ChangedReference::new(|f: &Matrix3<f64>| Stored(&rubber()).cauchy(f), &held);
        let expected = Stored(&rubber()).cauchy(&(gradient * held.matrix()));
        let found = Stored(&told).cauchy(&gradient);
        let rounding = Tol::ulps(64.0);
        assert_close("T", found.as_slice(), expected.as_slice(), rounding);
        assert_close("T of a response", as_response.cauchy(&gradient).as_slice(), expected.as_slice(), rounding);
    }
}

#[test]
fn work_around_closed_circuits_is_zero_only_with_an_energy() {
    let search = Search { samples: 60, ..Search::default() };
    for strain in [0.1, 0.5, 1.0] {
        let report = hyperelasticity(&Stored(&rubber()), &Search { strain, ..search });
        assert!(report.passes(), "{strain}: {}", report.size);
    }
    // T = f(I₁) B: isotropic and indifferent, but without an energy.
    let cauchy = |f: &Matrix3<f64>| {
        let b = f * f.transpose();
        b * b.trace()
    };
    assert!(frame_indifference(&cauchy, &search).passes());
    assert!(material_symmetry(&cauchy, &SymmetryGroup::isotropic(), &search).passes());
    let report = hyperelasticity(&cauchy, &search);
    let worst = report.worst.clone().expect("a circuit");
    assert!(1e-3 < report.size && worst.quadrature < 1e-8 * worst.scale, "{}", report.size);
    // T = I₁ B/J has W = ¼ I₁².
    let stored = |f: &Matrix3<f64>| {
        let b = f * f.transpose();
        b * (b.trace() / f.determinant())
    };
    assert!(hyperelasticity(&stored, &search).passes());
}

#[test]
fn potential_equals_the_energy() {
    let mut sampler = Sampler::new(11);
    for _ in 0..40 {
        let gradient = DeformationGradient::new(sampler.gradient(0.7)).expect("0 < det F");
        let found = potential(&Stored(&rubber()), &gradient);
        let expected = rubber().energy(&gradient);
        // Of W itself, and no further off than is stated.
        let rounding = Tol::stated(1e-13, "quadrature to 1e-13 of the work without signs, which is some W");
        assert_close("W", &[found.energy], &[expected], rounding);
        let off = (found.energy - expected).abs();
        assert!(off <= found.error + Tol::ulps(16.0).value() * expected, "{off:e} of {found:?}");
        assert_close_at_scale("stated error", &[found.error], &[0.0], expected, rounding.times(10.0));
        // An energy that changes with the observer: half turns have some.
        let found = potential(&Stored(&OfDisplacement), &gradient);
        assert_close("W", &[found.energy], &[OfDisplacement.energy(&gradient)], rounding);
    }
}

#[test]
fn nolls_three_claims_stand_and_fall_together() {
    let good = noll(&rubber(), &search());
    assert!(good.passes() && good.agrees(), "{good:?}");
    let bad = noll(&OfDisplacement, &search());
    assert!(!bad.passes() && bad.agrees());
    assert!(0.1 < bad.energy.size && 0.1 < bad.response.size && 0.1 < bad.symmetry.size);
}

#[test]
fn saint_venant_kirchhoff_loses_ellipticity_in_compression() {
    // A₁₁₁₁ = ½ (λ + 2μ)(3 λ₁² − 1) of a bar pressed along 1 between smooth walls; shear fails later for λ < μ.
    let law = Quadratic { lambda: 0.25, mu: 1.0, fibre: 0.0, along: [1.0, 0.0, 0.0] };
    let path = |stretch: f64| DeformationGradient::uniaxial(stretch, 1.0).ok();
    let loss = first_loss(&law, path, 1.0, 0.3, 40, Kinematics::Free).expect("a loss");
    let expected = (1.0_f64 / 3.0).sqrt();
    assert!(expected - 1e-9 <= loss.parameter, "{loss:?}");
    // The waves that fail do: m · Q(N) m is not positive, computed apart.
    let tangent = law.first_piola_tangent(&path(loss.parameter).expect("F"));
    let q = acoustic_tensor(&tangent, loss.ellipticity.normal);
    let m = Vector3::from(loss.ellipticity.amplitude);
    let modulus = (Matrix3::from(q) * m).dot(&m);
    assert_close_at_scale("m · Q m", &[modulus], &[0.0], 2.25, Tol::ulps(64.0));
    let along = acoustic_tensor(&law.first_piola_tangent(&path(0.5).expect("F")), [1.0, 0.0, 0.0]);
    assert_close("Q₁₁", &[along[0][0]], &[0.5 * 2.25 * (3.0 * 0.25 - 1.0)], Tol::ulps(16.0));
    assert!(!ellipticity_scan(&law, &Search { samples: 40, strain: 1.0, ..search() }, Kinematics::Free).passes());
}

#[test]
fn mooney_rivlin_keeps_ellipticity_and_baker_ericksen() {
    let wide = Search { samples: 40, strain: 1.5, ..search() };
    for kinematics in [Kinematics::Free, Kinematics::Isochoric] {
        let scan = ellipticity_scan(&rubber(), &wide, kinematics);
        assert!(scan.passes() && scan.samples == 40, "{scan:?}");
    }
    let report = baker_ericksen(&rubber(), &Search { samples: 1000, ..wide });
    assert!(report.passes(), "{report:?}");
    // (Tᵢ − Tⱼ)/(λᵢ − λⱼ) of St. Venant and Kirchhoff's law: pressed enough, the stress falls with the stretch.
    let soft = Quadratic { lambda: 0.25, mu: 1.0, fibre: 0.0, along: [1.0, 0.0, 0.0] };
    let report = baker_ericksen(&soft, &Search { samples: 1000, ..wide });
    assert!(!report.passes());
    let stress = soft.cauchy(&DeformationGradient::diagonal(report.stretches).expect("F")).0.components;
    let [i, j] = report.pair;
    assert!((stress[i] - stress[j]) * (report.stretches[i] - report.stretches[j]) < 0.0);
}

#[test]
fn least_acoustic_modulus_is_below_that_of_random_waves_and_is_reached() {
    let law = Quadratic { lambda: 1.0, mu: 1.0, fibre: 4.0, along: [0.48, 0.6, 0.64] };
    let mut sampler = Sampler::new(5);
    for _ in 0..10 {
        let f = DeformationGradient::new(sampler.gradient(0.4)).expect("F");
        let tangent = law.first_piola_tangent(&f);
        let modulus = |normal: [f64; 3], amplitude: [f64; 3]| {
            let m = Vector3::from(amplitude);
            (Matrix3::from(acoustic_tensor(&tangent, normal)) * m).dot(&m)
        };
        let free = ellipticity(&law, &f, Kinematics::Free);
        let tied = ellipticity(&law, &f, Kinematics::Isochoric);
        let rounding = Tol::ulps(16.0);
        assert_close_at_scale("free", &[modulus(free.normal, free.amplitude)], &[free.modulus], 10.0, rounding);
        assert_close_at_scale("tied", &[modulus(tied.normal, tied.amplitude)], &[tied.modulus], 10.0, rounding);
        // Moduli of about ten, each a few ulp off.
        let rounding_of_a_modulus = Tol::ulps(64.0).value() * 10.0;
        assert!(free.modulus <= tied.modulus + rounding_of_a_modulus);
        let inverse = f.matrix().try_inverse().expect("F⁻¹");
        let spatial = inverse.transpose() * Vector3::from(tied.normal);
        assert_close_at_scale("m · n", &[spatial.dot(&Vector3::from(tied.amplitude))], &[0.0], 1.0, Tol::ulps(32.0));
        for _ in 0..4000 {
            let (normal, amplitude) = (sampler.direction(), sampler.direction());
            assert!(free.modulus - rounding_of_a_modulus <= modulus(normal, amplitude));
            let n = (inverse.transpose() * Vector3::from(normal)).normalize();
            let m = Vector3::from(amplitude);
            let m = (m - n * n.dot(&m)).normalize();
            assert!(tied.modulus - rounding_of_a_modulus <= modulus(normal, m.into()));
        }
    }
}

#[test]
fn drucker_modulus_equals_its_closed_form_and_is_lost_where_that_is() {
    // A law that softens: C₀₁ < 0 gives the incompressible bar a falling stress at large stretch.
    let soft = MooneyRivlin::stress_free(0.5, -0.1, 1.0).expect("0 < C₁₀ + C₀₁");
    let path = |stretch: f64| Mode::Equibiaxial.elongations(stretch).map(|x| 1.0 + x);
    let report = drucker_path(&soft, path, 1.0, 3.0, 40, Kinematics::Isochoric);
    let lost = report.first_loss.expect("a loss");
    assert!(!report.passes());
    // D in the trace-free plane: Dᵢᵢ = 4 C₁₀ λᵢ² + 4 C₀₁ λᵢ⁻² with W = Σ C₁₀ λᵢ² + C₀₁ λᵢ⁻².
    let least = |stretch: f64| {
        let [a, b, c] = path(stretch).map(|l| 4.0 * (0.5 * l * l - 0.1 / (l * l)));
        // u = (1, −1, 0)/√2 and v = (1, 1, −2)/√6 do not mix as a = b.
        (0.5 * (a + b)).min((a + b + 4.0 * c) / 6.0)
    };
    assert_close_at_scale("modulus at the loss", &[least(lost)], &[0.0], 1.0, Tol::ulps(64.0));
    assert!(0.0 < least(lost - 1e-6) && least(lost + 1e-6) < 0.0);
    for stretch in [0.8, 1.0, 1.7] {
        let found = drucker(&soft, path(stretch), Kinematics::Isochoric);
        assert_close_at_scale("modulus", &[found.modulus], &[least(stretch)], 4.0, Tol::ulps(64.0));
        assert_close_at_scale("tr dε", &[found.increment.iter().sum()], &[0.0], 1.0, Tol::ulps(8.0));
    }
    let good = drucker_path(&rubber(), path, 0.5, 3.0, 40, Kinematics::Isochoric);
    assert!(good.passes() && good.first_loss.is_none());
}
