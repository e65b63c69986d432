//! Closed circuits: whether an elastic law has an energy, and that energy.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_continuum::spectral::StretchAnalysis;

use super::law::{cofactor, first_piola, isochoric, jacobian};
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
    /// The change of `work` when the quadrature is made twice as fine.
    pub quadrature: f64,
}

/// Nodes in (0, 1) and weights of Gauss and Legendre's rule with eight points, by halves.
const RULE: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// ∫ f over [0, 1] in equal panels; none where f has no value.
fn integral(panels: u32, mut f: impl FnMut(f64) -> Option<[f64; 2]>) -> Option<[f64; 2]> {
    let width = 1.0 / f64::from(panels);
    let mut sum = [0.0; 2];
    for panel in 0..panels {
        let centre = (f64::from(panel) + 0.5) * width;
        for (node, weight) in RULE {
            for side in [-node, node] {
                let value = f(centre + 0.5 * width * side)?;
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += 0.5 * width * weight * value;
                }
            }
        }
    }
    Some(sum)
}

/// (P : F′, |P| |F′|), none where the law has no answer.
fn power(law: &impl Elastic, gradient: &Matrix3<f64>, rate: &Matrix3<f64>) -> Option<[f64; 2]> {
    law.answers(gradient).then(|| {
        let stress = first_piola(law, gradient);
        [stress.component_mul(rate).sum(), stress.norm() * rate.norm()]
    })
}

/// (∫ P : dF, ∫ |P| |dF|) along the straight line, or along its isochoric part.
fn along(law: &impl Elastic, from: &Matrix3<f64>, to: &Matrix3<f64>, panels: u32) -> Option<[f64; 2]> {
    let step = to - from;
    integral(panels, |s| {
        let line = from + step * s;
        if !law.is_incompressible() {
            return power(law, &line, &step);
        }
        // (J^(−⅓) G)′ = J^(−⅓) (G′ − ⅓ (G⁻ᵀ : G′) G).
        let volume = jacobian(&line);
        let growth = cofactor(&line).component_mul(&step).sum() / (3.0 * volume);
        power(law, &isochoric(line), &((step - line * growth) / volume.cbrt()))
    })
}

fn around(law: &impl Elastic, corners: &[Matrix3<f64>], panels: u32) -> Option<[f64; 2]> {
    let mut sum = [0.0; 2];
    for (k, corner) in corners.iter().enumerate() {
        let side = along(law, corner, &corners[(k + 1) % corners.len()], panels)?;
        sum = [sum[0] + side[0], sum[1] + side[1]];
    }
    Some(sum)
}

/// Tries to refute that an elastic law has an energy: ∮ P : dF = 0 over closed circuits, W(20.31).
///
/// ```text
/// ∮ tr(G(F) F′ F⁻¹)/ρ dτ = 0      ⇔      ∮ P : dF = 0
/// ```
/// Polygons of three to six corners are gone around; the corners are Q (1 + H) with a common rotation Q and
/// ‖H‖ ≤ 1 − e^(−strain), so that 0 < det F everywhere between; of an incompressible body their isochoric parts. The size
/// is |∮ P : dF| relative to ∮ |P| |dF|. A circuit that leaves the limits of the law is left out.
///
/// # Accuracy
/// The quadrature error is measured, and reported with the worst circuit.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_constitutive::checks::{Search, Stored, hyperelasticity};
/// use piola_constitutive::solids::MooneyRivlin;
/// let search = Search { samples: 50, ..Search::default() };
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// assert!(hyperelasticity(&Stored(&rubber), &search).passes());
/// // T = B − 1 has the symmetries of a good law, but no energy.
/// let law = |f: &Matrix3<f64>| f * f.transpose() - Matrix3::identity();
/// assert!(!hyperelasticity(&law, &search).passes());
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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
        let [coarse, _] = around(law, &corners, 2)?;
        let [work, scale] = around(law, &corners, 4)?;
        Some((work.abs(), scale, Circuit { corners, work, scale, quadrature: (work - coarse).abs() }))
    });
    Report::of(search, samples)
}

/// An energy found by integration along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Potential {
    /// W(F) − W(1), J per m³ of the reference.
    pub energy: f64,
    /// The change when the quadrature was last made twice as fine.
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
/// The quadrature is refined until it changes by less than 1e-13 of ∫ |P| |dF|, at most to 128 panels.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_constitutive::checks::potential;
/// use piola_continuum::DeformationGradient;
/// // P = F − F⁻ᵀ of W = ½ (F : F − 3) − ln J.
/// let law = |f: &Matrix3<f64>| (f * f.transpose() - Matrix3::identity()) / f.determinant();
/// let found = potential(&law, &DeformationGradient::diagonal([2.0, 1.0, 1.0])?);
/// assert!((found.energy - (1.5 - 2.0_f64.ln())).abs() < 1e-13);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[must_use]
pub fn potential(law: &impl Elastic, deformation: &DeformationGradient) -> Potential {
    let analysis = StretchAnalysis::of(deformation);
    let stretch = analysis.right_stretch().matrix();
    let rotation = Matrix3::from(analysis.rotation()).transpose();
    // By the quaternion: half turns have an axis too.
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(rotation);
    let turn = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis();
    let spin = turn.cross_matrix();
    let once = |panels: u32| {
        let stretched = along(law, &Matrix3::identity(), &stretch, panels)?;
        let turned = integral(panels, |s| {
            let gradient = nalgebra::Rotation3::new(turn * s).into_inner() * stretch;
            power(law, &gradient, &(spin * gradient))
        })?;
        Some([stretched[0] + turned[0], stretched[1] + turned[1]])
    };
    let nowhere = Potential { energy: f64::NAN, error: f64::NAN };
    let mut panels = 2;
    let Some([mut coarse, _]) = once(1) else { return nowhere };
    loop {
        let Some([energy, scale]) = once(panels) else { return nowhere };
        let error = (energy - coarse).abs();
        if error <= 1e-13 * scale || 128 <= panels {
            return Potential { energy, error };
        }
        coarse = energy;
        panels *= 2;
    }
}
