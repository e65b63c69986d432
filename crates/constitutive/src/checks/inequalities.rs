//! The inequalities of Baker and Ericksen, and of Drucker.

use piola_continuum::spectral::decompose;
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient, Symmetric};
use piola_numerics::{Dual, Gradient, Real};

use super::{Kinematics, Sampler, Search};
use crate::solids::Hyperelastic;

/// The least of Baker and Ericksen's quotients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakerEricksen {
    /// How many stretches were looked at.
    pub samples: usize,
    /// How many more were drawn at which the law has no answer.
    pub refused: usize,
    /// The least (Tᵢ − Tⱼ)/(λᵢ − λⱼ), Pa.
    pub least: f64,
    /// The principal stretches there.
    pub stretches: [f64; 3],
    /// i and j.
    pub pair: [usize; 2],
}

impl BakerEricksen {
    /// Whether something was looked at, and the greater stress was always along the greater stretch.
    #[must_use]
    pub fn passes(&self) -> bool {
        0 < self.samples && 0.0 < self.least
    }
}

/// Tries to refute Baker and Ericksen's inequalities of an isotropic law: (Tᵢ − Tⱼ)(λᵢ − λⱼ) > 0 where λᵢ ≠ λⱼ.
///
/// The pressure of an incompressible law drops out of the differences; its stretches are isochoric.
///
/// # Example
/// ```
/// use piola_constitutive::checks::{Search, baker_ericksen};
/// use piola_constitutive::solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// assert!(baker_ericksen(&rubber, &Search { strain: 2.0, ..Search::default() }).passes());
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
///
/// # Source
/// M. Baker, J. L. Ericksen, *Inequalities restricting the form of the stress-deformation relations for isotropic elastic
/// solids*, J. Wash. Acad. Sci. 44 (1954).
#[must_use]
pub fn baker_ericksen(law: &impl Hyperelastic, search: &Search) -> BakerEricksen {
    let mut sampler = Sampler::new(search.seed);
    let mut report = BakerEricksen { samples: 0, refused: 0, least: f64::INFINITY, stretches: [1.0; 3], pair: [0, 1] };
    for _ in 0..search.samples {
        let mut stretches = sampler.stretches(search.strain);
        if law.is_incompressible() {
            let mean = (stretches[0] * stretches[1] * stretches[2]).cbrt();
            stretches = stretches.map(|stretch| stretch / mean);
        }
        let answered = DeformationGradient::diagonal(stretches).ok().filter(|f| law.check(f).is_ok());
        let Some(deformation) = answered else {
            report.refused += 1;
            continue;
        };
        let stress = law.cauchy(&deformation).0.components;
        let mut compared = false;
        for pair in [[0, 1], [1, 2], [0, 2]] {
            let apart = stretches[pair[0]] - stretches[pair[1]];
            // Closer together the difference of the stresses is rounding.
            if apart.abs() < 1e-6 * stretches[pair[0]] {
                continue;
            }
            compared = true;
            let quotient = (stress[pair[0]] - stress[pair[1]]) / apart;
            if quotient < report.least || quotient.is_nan() {
                (report.least, report.stretches, report.pair) = (quotient, stretches, pair);
            }
        }
        report.samples += usize::from(compared);
    }
    report
}

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
/// The axes stand still: increments of shear obey Baker and Ericksen's inequalities, see [`baker_ericksen`].
///
/// # Example
/// ```
/// use piola_constitutive::checks::{Kinematics, drucker};
/// use piola_constitutive::solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?; // μ = 1.5
/// let rest = drucker(&rubber, [1.0; 3], Kinematics::Isochoric);
/// assert!((rest.modulus - 3.0).abs() < 1e-14); // 2 μ
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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
    /// Whether the modulus was positive everywhere, up to the end of the path.
    #[must_use]
    pub fn passes(&self) -> bool {
        0.0 < self.worst.modulus
    }
}

/// Drucker's condition along a path of principal stretches, from `from` to `to` in `steps` steps.
///
/// The path ends where the law has no answer: beyond a limiting stretch nothing is lost.
///
/// # Example
/// The stretches of a homogeneous test, in tension and compression.
/// ```
/// use piola_constitutive::checks::{Kinematics, drucker_path};
/// use piola_constitutive::homogeneous::Mode;
/// use piola_constitutive::solids::MooneyRivlin;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let path = |stretch: f64| Mode::Uniaxial.elongations(stretch).map(|x| 1.0 + x);
/// assert!(drucker_path(&rubber, path, 0.2, 8.0, 50, Kinematics::Isochoric).passes());
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
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
