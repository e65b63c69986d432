//! The same kernel over singles, lanes, doubled precision and differentiable numbers.

#[expect(dead_code, reason = "the rest serves the tests of `it`")]
#[path = "../it/polar/cases.rs"]
mod cases;

use nalgebra::Matrix3;
use piola_continuum::polar::{StretchAnalysis, polar_hencky};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Dual, Gradient, Jet, Kernel, Lanes, Level, Real, dispatch_at};
use piola_tensor::spectral::decompose;
use piola_testkit::spectral::{Random, Rows, adversarial_set, polar_reference, with_stretches};
use piola_testkit::{DoubleDouble, Tol, assert_close, difference_quotient, ulps_between};

use cases::{analysis, gradient, matrix};

struct Batch<'a>(&'a [DeformationGradient<Lanes<f64, 4>>], &'a mut Vec<[Lanes<f64, 4>; 27]>);

impl Kernel for Batch<'_> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        for f in self.0 {
            let stretch = StretchAnalysis::of(f);
            let mut all = [Lanes::splat(0.0); 27];
            all[..9].copy_from_slice(stretch.rotation().as_flattened());
            all[9..15].copy_from_slice(&stretch.right_stretch().components);
            all[15..21].copy_from_slice(&stretch.left_stretch().components);
            all[21..].copy_from_slice(&stretch.hencky_material().components);
            self.1.push(all);
        }
    }
}

/// All but the logarithms, which lanes take from their own, equal to the last bit.
#[test]
fn lanes_equal_scalars() {
    let set = adversarial_set();
    let points: Vec<_> = set
        .chunks_exact(4)
        .map(|chunk| {
            let lanes = Matrix3::from_fn(|i, j| Lanes(core::array::from_fn(|lane| chunk[lane].gradient[i][j])));
            DeformationGradient::new(lanes).expect("0 < det F")
        })
        .collect();
    for level in Level::available() {
        let mut results = Vec::new();
        dispatch_at(level, Batch(&points, &mut results));
        for (case, result) in set.chunks_exact(4).zip(&results) {
            for (lane, case) in case.iter().enumerate() {
                let stretch = analysis(case.gradient);
                let mut exact = stretch.rotation().concat();
                exact.extend(stretch.right_stretch().components);
                exact.extend(stretch.left_stretch().components);
                for (place, expected) in exact.iter().enumerate() {
                    let ulps = ulps_between(result[place].primal(lane), *expected);
                    assert!(ulps <= 0.0, "{}: entry {place} differs by {ulps} ulp", case.kind);
                }
                let logarithm: Vec<_> = result[21..].iter().map(|x| x.primal(lane)).collect();
                let expected = stretch.hencky_material().components;
                assert_close(case.kind, &logarithm, &expected, Tol::ulps(4.0));
            }
        }
    }
}

#[test]
fn results_for_the_machine_equal_those_for_any_machine() {
    for case in adversarial_set() {
        let stretch = analysis(case.gradient);
        let polar = polar_hencky(&gradient(case.gradient));
        assert_eq!(polar.rotation, from_rows(stretch.rotation()), "R, {}", case.kind);
        assert_eq!(polar.right_stretch, stretch.right_stretch(), "U, {}", case.kind);
        assert_eq!(polar.hencky, stretch.hencky_material(), "ln U, {}", case.kind);
    }
}

#[test]
fn singles_are_decomposed_to_their_own_rounding() {
    let mut random = Random::new(31);
    for _ in 0..2_000 {
        let (p, q) = (random.rotation(), random.rotation());
        let stretches: [f64; 3] = core::array::from_fn(|_| random.symmetric().exp());
        let f = with_stretches(&p, stretches, &q).map(|row| row.map(|x| f64::from(f32::lit(x))));
        let reference = polar_reference(f);
        let single = DeformationGradient::new(Matrix3::from_fn(|i, j| f32::lit(f[i][j]))).expect("0 < det F");
        let stretch = StretchAnalysis::of(&single);
        let tol = Tol::ulps32(8.0).times(reference.stretches[0] / reference.stretches[2]);
        let wide = |rows: Rows<f32>| rows.concat().iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        assert_close("R", &wide(stretch.rotation()), &reference.rotation.concat(), tol);
        assert_close("U", &wide(stretch.right_stretch().rows()), &reference.right_stretch.concat(), Tol::ulps32(8.0));
        let scale = piola_testkit::relative_error(&reference.hencky_material.concat(), &[0.0; 9]).max(1.0);
        let hencky = wide(stretch.hencky_material().rows());
        piola_testkit::assert_close_at_scale("ln U", &hencky, &reference.hencky_material.concat(), scale, tol);
    }
    let tiny = decompose(&Symmetric::new(1e-30_f32, 0.0, 0.0, 1e-30, 0.0, 0.0));
    assert!(tiny.values[0] > tiny.values[1]);
}

#[test]
fn doubled_precision_gives_doubled_digits() {
    let mut random = Random::new(32);
    for _ in 0..100 {
        let f = with_stretches(&random.rotation(), [2.0, 1.1, 0.4], &random.rotation());
        let wide = Matrix3::from_fn(|i, j| DoubleDouble::lit(f[i][j]));
        let stretch = StretchAnalysis::of(&DeformationGradient::new(wide).expect("0 < det F"));
        let (r, u) = (stretch.rotation(), stretch.right_stretch().rows());
        for i in 0..3 {
            for j in 0..3 {
                let product = r[i][0] * u[0][j] + r[i][1] * u[1][j] + r[i][2] * u[2][j];
                assert!((product - DoubleDouble::lit(f[i][j])).primal(0).abs() < 1e-28);
            }
        }
    }
}

/// The components of ln U of a deformation with some entries.
fn computed<T: Real>(seed: impl Fn(usize, usize) -> T) -> Vec<T> {
    let f = DeformationGradient::new(Matrix3::from_fn(seed)).expect("0 < det F");
    StretchAnalysis::of(&f).hencky_material().rows().concat()
}

#[test]
fn every_differentiable_scalar_gives_the_same_derivative() {
    let mut random = Random::new(33);
    for _ in 0..50 {
        let (p, q) = (random.rotation(), random.rotation());
        let (f, h) = (with_stretches(&p, [1.6, 1.6, 0.8], &q), random.matrix());
        let hencky = |rows: &[f64]| {
            let rows = core::array::from_fn(|i| core::array::from_fn(|j| rows[3 * i + j]));
            polar_reference(rows).hencky_material.concat()
        };
        let expected = difference_quotient(hencky, &f.concat(), &h.concat());
        let tol = Tol::stated(1e-11, "sixth-order differences");
        let dual = computed(|i, j| Dual::new(f[i][j], h[i][j]));
        assert_close("Dual", &dual.iter().map(|x| x.tangent).collect::<Vec<_>>(), &expected, tol);
        let gradient = computed(|i, j| Gradient { value: f[i][j], partials: [h[i][j], 0.0] });
        assert_close("Gradient", &gradient.iter().map(|x| x.partials[0]).collect::<Vec<_>>(), &expected, tol);
        let jet =
            computed(|i, j| Jet::<f64, 1> { value: f[i][j], partials: [h[i][j]], rate: h[i][j], second_rate: 0.0 });
        assert_close("Jet", &jet.iter().map(|x| x.rate).collect::<Vec<_>>(), &expected, tol);
        let lanes = computed(|i, j| Dual::new(Lanes([f[i][j]; 2]), Lanes([h[i][j]; 2])));
        assert_close("lanes", &lanes.iter().map(|x| x.tangent.0[1]).collect::<Vec<_>>(), &expected, tol);
    }
}

/// Single stretches have derivatives where they are distinct: λ̇ = q · (Rᵀ Ḟ) q.
#[test]
fn derivative_of_a_distinct_stretch_equals_the_rate_along_its_axis() {
    let mut random = Random::new(34);
    for _ in 0..200 {
        let (p, q) = (random.rotation(), random.rotation());
        let (f, h) = (with_stretches(&p, [2.0, 1.2, 0.5], &q), random.matrix());
        let dual = DeformationGradient::new(Matrix3::from_fn(|i, j| Dual::new(f[i][j], h[i][j]))).expect("0 < det F");
        let stretches = StretchAnalysis::of(&dual).principal_stretches();
        let plain = analysis(f);
        let rate = matrix(plain.spatial_axes()) * matrix(h) * matrix(plain.material_axes()).transpose();
        let expected = [rate[(0, 0)], rate[(1, 1)], rate[(2, 2)]];
        assert_close("λ̇", &stretches.map(|x| x.tangent), &expected, Tol::ulps(64.0));
    }
}
