//! Drucker's condition: at states, over random deformations, along paths.

use nalgebra::{Matrix3, Matrix6};
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient, Symmetric};
use piola_numerics::{Dual, Gradient, Real};
use piola_solids::Hyperelastic;
use piola_tensor::spectral::{Exponential, decompose, derivative, second_derivative};

use super::law::isochoric;
use super::{Kinematics, Sampler, Search};

/// Drucker's modulus of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drucker {
    /// min dτ : dε over unit increments dε of the logarithmic strain along the axes, Pa; NaN where the law has no answer.
    pub modulus: f64,
    /// The principal components of that dε.
    pub increment: [f64; 3],
}

/// Drucker's condition 0 < dτ : dε at principal stretches along the coordinates, ε = ln V.
///
/// ```text
/// dτᵢ = Dᵢⱼ dεⱼ,   Dᵢⱼ = ∂²W/∂ ln λᵢ ∂ ln λⱼ      min of dε · D dε over |dε| = 1  (and tr dε = 0, if isochoric)
/// ```
/// Of an incompressible law increments are isochoric, whatever is asked for.
///
/// The axes stand still: increments of shear obey the inequalities of [`baker_ericksen`](super::baker_ericksen);
/// [`second_order_work`] takes them in, along any axes.
///
/// # Example
/// ```
/// use piola_specimens::checks::{Kinematics, drucker};
/// use piola_solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?; // μ = 1.5
/// let rest = drucker(&rubber, [1.0; 3], Kinematics::Isochoric);
/// assert!((rest.modulus - 3.0).abs() < 1e-14); // 2 μ
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[must_use]
pub fn drucker(law: &impl Hyperelastic, stretches: [f64; 3], kinematics: Kinematics) -> Drucker {
    let nowhere = Drucker { modulus: f64::NAN, increment: [f64::NAN; 3] };
    let Ok(deformation) = DeformationGradient::diagonal(stretches) else { return nowhere };
    if law.check(&deformation).is_err() {
        return nowhere;
    }
    let d = logarithmic_curvatures(law, stretches);
    let along =
        |v: [f64; 3], w: [f64; 3]| -> f64 { (0..3).map(|i| v[i] * (0..3).map(|j| d[i][j] * w[j]).sum::<f64>()).sum() };
    match kinematics.of(law) {
        Kinematics::Free => {
            let decomposition = decompose(&Symmetric::symmetric_part(d));
            Drucker { modulus: decomposition.values[2], increment: decomposition.vectors[2] }
        }
        Kinematics::Isochoric => {
            let (r, s) = (0.5_f64.sqrt(), 6.0_f64.sqrt().recip());
            let (u, v) = ([r, -r, 0.0], [s, s, -2.0 * s]);
            let (a, b, c) = (along(u, u), along(v, v), along(u, v));
            let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
            let (sine, cosine) = (0.5 * c.atan2(half)).sin_cos();
            let increment = core::array::from_fn(|i| cosine * v[i] - sine * u[i]);
            Drucker { modulus: mean - half.hypot(c), increment }
        }
    }
}

/// ∂²W/∂ ln λᵢ ∂ ln λⱼ.
fn logarithmic_curvatures(law: &impl Hyperelastic, stretches: [f64; 3]) -> [[f64; 3]; 3] {
    core::array::from_fn(|j| {
        let elongations: [Gradient<Dual<f64>, 3>; 3] = core::array::from_fn(|i| {
            let logarithm = if i == j { Dual::variable(stretches[i].ln()) } else { Dual::constant(stretches[i].ln()) };
            Gradient::variable(logarithm, i).exp_m1()
        });
        let zero = Gradient::constant(Dual::constant(0.0));
        let rest = DisplacementGradient::<f64>::zero();
        let deformation = rest.lifted(|i, k, _| if i == k { elongations[i] } else { zero });
        law.energy(&deformation).partials.map(|slope| slope.tangent)
    })
}

/// The least second-order work at a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondOrderWork {
    /// min dτ : dε over all unit increments dε of the logarithmic strain, Pa; NaN where the law has no answer.
    pub modulus: f64,
    /// That increment as all observers see it: the unit increment Rᵀ dε R of ln U, F = R U.
    pub increment: Symmetric<f64>,
}

/// Drucker's condition 0 < dτ : dε at any deformation, for increments along any axes, ε = ln V.
///
/// ```text
/// F = R e^H:   dτ : dε = d²/ds² W(R e^(H + s h)) at s = 0,   |h| = 1  (and tr h = 0, if isochoric),   h = Rᵀ dε R
///            = (R U′) : ∂P/∂F : (R U′) + P : (R U″),         U = e^H
/// ```
/// | symbol | meaning | unit |
/// |---|---|---|
/// | H, h | ln U and its increment, R held | – |
/// | τ | what works on ε: of an isotropic law Kirchhoff's stress | Pa |
/// | W, P | of the law | J/m³, Pa |
///
/// Where the axes stand still it is [`drucker`]; increments of shear between the principal axes have (τᵢ − τⱼ)/(ln λᵢ − ln λⱼ)
/// if the law is isotropic. Of an incompressible law increments are isochoric, whatever is asked for.
///
/// # Accuracy
/// The modulus within some ulp of the largest: it is the least eigenvalue of the matrix of six (five, if isochoric) increments.
///
/// # Example
/// ```
/// use piola_specimens::checks::{Kinematics, second_order_work};
/// use piola_solids::Hencky;
/// use piola_continuum::DeformationGradient;
/// // τ = λ tr ε 1 + 2 μ ε: the modulus is 2 μ at every deformation.
/// let law = Hencky::new(2.0, 0.9)?;
/// let found = second_order_work(&law, &DeformationGradient::simple_shear(1.5)?, Kinematics::Free);
/// assert!((found.modulus - 1.8).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. Hill, *Constitutive inequalities for isotropic elastic solids under finite strain*, Proc. R. Soc. Lond. A 314 (1970).
#[must_use]
pub fn second_order_work(
    law: &impl Hyperelastic,
    deformation: &impl Deformation<f64>,
    kinematics: Kinematics,
) -> SecondOrderWork {
    let nowhere = SecondOrderWork { modulus: f64::NAN, increment: Symmetric { components: [f64::NAN; 6] } };
    if law.check(deformation).is_err() {
        return nowhere;
    }
    let basis = increments();
    let analysis = StretchAnalysis::of(deformation);
    let (rotation, strain) = (Matrix3::from(analysis.rotation()).transpose(), analysis.hencky_material());
    let (stress, tangent) = law.first_piola_and_tangent(deformation);
    let rates = basis.map(|h| rotation * derivative(&Exponential, &strain, &h).matrix());
    let slopes = rates.map(|rate| {
        Matrix3::from_fn(|i, a| {
            let entry = |j: usize, b: usize| tangent.entry(i, a, j, b) * rate[(j, b)];
            (0..3).map(|j| (0..3).map(|b| entry(j, b)).sum::<f64>()).sum()
        })
    });
    let mut works = Matrix6::from_fn(|a, b| {
        let bent = rotation * second_derivative(&Exponential, &strain, &basis[a], &basis[b]).matrix();
        rates[a].dot(&slopes[b]) + stress.0.dot(&bent)
    });
    if !works.iter().all(|work| work.is_finite()) {
        return nowhere;
    }
    works = (works + works.transpose()) * 0.5;
    if kinematics.of(law) == Kinematics::Isochoric {
        // The last increment is the dilation: apart from the others, and never the least.
        works.row_mut(5).fill(0.0);
        works.column_mut(5).fill(0.0);
        works[(5, 5)] = 2.0 * works.norm();
    }
    let eigen = works.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let direction = eigen.eigenvectors.column(least);
    let increment = basis.iter().zip(direction.iter()).fold(Symmetric::zero(), |sum, (h, x)| sum + *h * *x);
    SecondOrderWork { modulus: eigen.eigenvalues[least], increment }
}

/// Orthonormal symmetric tensors: five without trace, then the dilation.
fn increments() -> [Symmetric<f64>; 6] {
    let (r, s, t) = (0.5_f64.sqrt(), 6.0_f64.sqrt().recip(), 3.0_f64.sqrt().recip());
    [
        [r, -r, 0.0, 0.0, 0.0, 0.0],
        [s, s, -2.0 * s, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, r, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, r, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, r],
        [t, t, t, 0.0, 0.0, 0.0],
    ]
    .map(|components| Symmetric { components })
}

/// The worst of random deformations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DruckerScan {
    /// Number of deformations compared.
    pub samples: usize,
    /// Number of further samples that the law refused.
    pub refused: usize,
    /// The deformation with the least modulus; the reference if nothing was compared.
    pub gradient: DeformationGradient,
    /// The least modulus, and the increment that has it; NaN if nothing was compared.
    pub worst: SecondOrderWork,
}

impl DruckerScan {
    /// True if something was compared, and more strain always took more stress.
    #[must_use]
    pub fn passes(&self) -> bool {
        0 < self.samples && 0.0 < self.worst.modulus
    }
}

/// Tries to refute Drucker's condition over random deformations, of any stretches along any axes, and all increments of each:
/// see [`second_order_work`]. Deformations and increments are isochoric where the kinematics or the law are.
#[must_use]
pub fn drucker_scan(law: &impl Hyperelastic, search: &Search, kinematics: Kinematics) -> DruckerScan {
    let mut sampler = Sampler::new(search.seed);
    let kinematics = kinematics.of(law);
    let worst = SecondOrderWork { modulus: f64::NAN, increment: Symmetric { components: [f64::NAN; 6] } };
    let mut scan = DruckerScan { samples: 0, refused: 0, gradient: DeformationGradient::identity(), worst };
    for _ in 0..search.samples {
        let mut matrix = sampler.gradient(search.strain);
        if kinematics == Kinematics::Isochoric {
            matrix = isochoric(matrix);
        }
        let answered = DeformationGradient::new(matrix).ok().filter(|gradient| law.check(gradient).is_ok());
        let Some(gradient) = answered else {
            scan.refused += 1;
            continue;
        };
        let found = second_order_work(law, &gradient, kinematics);
        if scan.samples == 0 || found.modulus < scan.worst.modulus || found.modulus.is_nan() {
            (scan.gradient, scan.worst) = (gradient, found);
        }
        scan.samples += 1;
    }
    scan
}

/// Drucker's modulus along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DruckerPath {
    /// The least modulus of the points looked at; NaN if the path does not begin.
    pub worst: Drucker,
    /// Where it was found.
    pub parameter: f64,
    /// Where the modulus first became zero, bisected to rounding; none if it did not.
    pub first_loss: Option<f64>,
    /// Where the path ends because the law has no answer beyond, bisected to rounding; none if it does not.
    pub end: Option<f64>,
}

impl DruckerPath {
    /// True if the modulus was positive everywhere, up to the end of the path.
    #[must_use]
    pub fn passes(&self) -> bool {
        0.0 < self.worst.modulus
    }
}

/// Drucker's condition along a path of principal stretches, from `from` to `to` in `steps` steps.
///
/// The path ends where the law has no answer: beyond a limiting stretch nothing is lost.
#[must_use]
pub fn drucker_path(
    law: &impl Hyperelastic,
    path: impl Fn(f64) -> [f64; 3],
    from: f64,
    to: f64,
    steps: u32,
    kinematics: Kinematics,
) -> DruckerPath {
    let answered = |parameter: f64| {
        DeformationGradient::diagonal(path(parameter)).is_ok_and(|deformation| law.check(&deformation).is_ok())
    };
    let at = |parameter: f64| drucker(law, path(parameter), kinematics);
    let mut report = DruckerPath { worst: at(from), parameter: from, first_loss: None, end: None };
    if !answered(from) {
        report.end = Some(from);
        return report;
    }
    if !report.passes() {
        report.first_loss = Some(from);
    }
    let mut before = from;
    for step in 1..=steps {
        let mut parameter = from + (to - from) * f64::from(step) / f64::from(steps);
        if !answered(parameter) {
            // The last point that is answered is looked at in its stead.
            let (good, bad) = bisected(before, parameter, answered);
            report.end = Some(bad);
            parameter = good;
        }
        let found = at(parameter);
        if (found.modulus <= 0.0 || found.modulus.is_nan()) && report.first_loss.is_none() {
            report.first_loss = Some(bisected(before, parameter, |middle| 0.0 < at(middle).modulus).1);
        }
        if found.modulus < report.worst.modulus || found.modulus.is_nan() {
            (report.worst, report.parameter) = (found, parameter);
        }
        if report.end.is_some() {
            break;
        }
        before = parameter;
    }
    report
}

/// The last point at which something holds and the first at which it does not, next to one another.
fn bisected(mut good: f64, mut bad: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    for _ in 0..60 {
        let middle = 0.5 * (good + bad);
        if holds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    (good, bad)
}
