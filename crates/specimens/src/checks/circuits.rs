//! Closed circuits: whether an elastic law has an energy, and that energy.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_continuum::polar::StretchAnalysis;

use super::law::{cofactor, first_piola, isochoric, jacobian};
use super::quadrature::{Integral, integrate};
use super::{Elastic, Report, Sampler, Search};

/// A closed polygon of deformation gradients, and the work per reference volume of going around.
#[derive(Clone, Debug, PartialEq)]
pub struct Circuit {
    /// The corners, in order.
    pub corners: Vec<Matrix3<f64>>,
    /// ∮ P : dF, J/m³.
    pub work: f64,
    /// ∮ |P| |dF|, J/m³.
    pub scale: f64,
    /// The error of `work`, as the quadrature estimates it, J/m³.
    pub quadrature: f64,
}

/// (P : F′, |P| |F′|), none where the law has no answer.
fn power(law: &impl Elastic, gradient: &Matrix3<f64>, rate: &Matrix3<f64>) -> Option<[f64; 2]> {
    law.answers(gradient).then(|| {
        let stress = first_piola(law, gradient);
        [stress.component_mul(rate).sum(), stress.norm() * rate.norm()]
    })
}

/// [`power`] on the straight line from one deformation to another, or on its isochoric part.
fn on_line(law: &impl Elastic, from: &Matrix3<f64>, to: &Matrix3<f64>, s: f64) -> Option<[f64; 2]> {
    let step = to - from;
    let line = from + step * s;
    if !law.is_incompressible() {
        return power(law, &line, &step);
    }
    // (J^(−⅓) G)′ = J^(−⅓) (G′ − ⅓ (G⁻ᵀ : G′) G).
    let volume = jacobian(&line);
    let growth = cofactor(&line).component_mul(&step).sum() / (3.0 * volume);
    power(law, &isochoric(line), &((step - line * growth) / volume.cbrt()))
}

/// Tries to refute that an elastic law has an energy: ∮ P : dF = 0 over closed circuits, W(20.31).
///
/// ```text
/// ∮ tr(G(F) F′ F⁻¹)/ρ dτ = 0      ⇔      ∮ P : dF = 0
/// ```
/// Polygons of three to six corners are gone around; the corners are Q (1 + H) with a common rotation Q and
/// ‖H‖ ≤ 1 − e^(−strain), so that 0 < det F everywhere between; of an incompressible body their isochoric parts. The size
/// is |∮ P : dF|, less its quadrature error, relative to ∮ |P| |dF|. A circuit that leaves the limits of the law is left out.
///
/// # Accuracy
/// Where the stress has kinks or jumps, as where fibres slacken, the quadrature is refined about them: until its error is below
/// a sixteenth of the tolerance of the search or rounding, at most to 1024 panels. Work within that error is no counterexample:
/// where it remains above the tolerance the circuit counts as [`unresolved`](Report::unresolved), and the report is
/// [`Verdict::Unresolved`](super::Verdict::Unresolved) if no other circuit refutes.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_specimens::checks::{Search, Stored, hyperelasticity};
/// use piola_solids::MooneyRivlin;
/// let search = Search { samples: 50, ..Search::default() };
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// assert!(hyperelasticity(&Stored(&rubber), &search).passes());
/// // T = B − 1 has the symmetries of a good law, but no energy.
/// let law = |f: &Matrix3<f64>| f * f.transpose() - Matrix3::identity();
/// assert!(!hyperelasticity(&law, &search).passes());
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[must_use]
pub fn hyperelasticity(law: &impl Elastic, search: &Search) -> Report<Circuit> {
    let mut sampler = Sampler::new(search.seed);
    let radius = -(-search.strain.abs()).exp_m1();
    let samples = (0..search.samples).map(|k| {
        let rotation = sampler.rotation();
        let corners: Vec<_> = (0..3 + k % 4)
            .map(|_| {
                let h = Matrix3::from_fn(|_, _| sampler.balanced());
                let corner = rotation * (Matrix3::identity() + h * (radius * sampler.unit().cbrt() / h.norm()));
                if law.is_incompressible() { isochoric(corner) } else { corner }
            })
            .collect();
        let count = corners.len();
        let side = |k: usize, s: f64| on_line(law, &corners[k], &corners[(k + 1) % count], s);
        let Integral { work, scale, error } = integrate(count, search.tolerance / 16.0, side)?;
        Some(([work.abs(), error], scale, Circuit { corners, work, scale, quadrature: error }))
    });
    Report::with_errors(search, samples)
}

/// An energy found by integration along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Potential {
    /// W(F) − W(1), J per m³ of the reference.
    pub energy: f64,
    /// Its error, as the quadrature estimates it, J/m³.
    pub error: f64,
}

/// The energy of an elastic law by a path integral from the reference, W(20.32).
///
/// ```text
/// W(F) − W(1) = ∫ P : dF      from 1 straight to U, then by rotation to F = R U
/// ```
/// For a law without energy it depends on the path and means nothing: see [`hyperelasticity`]. NaN where the law has no
/// answer on the path. Of an incompressible body the path is isochoric.
///
/// # Accuracy
/// The quadrature is refined, about kinks too, until its error is below 1e-13 of ∫ |P| |dF| or rounding, at most to 1024 panels.
#[must_use]
pub fn potential(law: &impl Elastic, deformation: &DeformationGradient) -> Potential {
    let analysis = StretchAnalysis::of(deformation);
    let stretch = analysis.right_stretch().matrix();
    let rotation = Matrix3::from(analysis.rotation()).transpose();
    // By the quaternion: half turns have an axis too.
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(rotation);
    let turn = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis();
    let spin = turn.cross_matrix();
    let path = |side: usize, s: f64| {
        if side == 0 {
            return on_line(law, &Matrix3::identity(), &stretch, s);
        }
        let gradient = nalgebra::Rotation3::new(turn * s).into_inner() * stretch;
        power(law, &gradient, &(spin * gradient))
    };
    integrate(2, 1e-13, path).map_or(Potential { energy: f64::NAN, error: f64::NAN }, |found| Potential {
        energy: found.work,
        error: found.error,
    })
}
