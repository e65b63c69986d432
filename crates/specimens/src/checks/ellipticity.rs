//! Ellipticity: whether plane waves have real speeds.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{cross, dot};
use piola_solids::Hyperelastic;
use piola_tensor::internal::rows::{Rows, apply, transpose};
use piola_tensor::spectral::decompose;

use super::{Sampler, Search};

/// Which motions the material allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kinematics {
    /// All.
    Free,
    /// Those that keep the volume: amplitudes m with m · F⁻ᵀ N = 0. The pressure drops out.
    Isochoric,
}

impl Kinematics {
    /// Kinematics of the body.
    pub(super) fn of(self, law: &impl Hyperelastic) -> Self {
        if law.is_incompressible() { Self::Isochoric } else { self }
    }
}

/// The acoustic tensor `Q_ij = A_iAjB N_A N_B` of ∂P/∂F in the direction N of the reference, Pa.
#[must_use]
pub fn acoustic_tensor<T: Real>(tangent: &FirstPiolaTangent<T>, normal: [T; 3]) -> Rows<T> {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let mut sum = T::zero();
            for a in 0..3 {
                for b in 0..3 {
                    sum += tangent.entry(i, a, j, b) * normal[a] * normal[b];
                }
            }
            sum
        })
    })
}

/// The least of the acoustic tensor over all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipticity {
    /// min m · Q(N) m over unit N and m, Pa: ρ₀ times the square of the smallest speed of a plane wave.
    pub modulus: f64,
    /// N of it, in the reference.
    pub normal: [f64; 3],
    /// m of it.
    pub amplitude: [f64; 3],
    /// min det Q(N), Pa³ (Pa² of the plane of allowed amplitudes).
    pub determinant: f64,
    /// N of that.
    pub determinant_normal: [f64; 3],
}

impl Ellipticity {
    /// Strong ellipticity: m · Q(N) m is positive for all N and m.
    #[must_use]
    pub fn is_strong(&self) -> bool {
        0.0 < self.modulus
    }

    /// The condition of Legendre and Hadamard: m · Q(N) m is nowhere negative, up to rounding of the moduli `scale`.
    #[must_use]
    pub fn is_semistable(&self, scale: f64) -> bool {
        -16.0 * f64::EPSILON * scale <= self.modulus
    }
}

/// (least eigenvalue, its vector, determinant) of the acoustic tensor.
fn least(tangent: &FirstPiolaTangent, normal: [f64; 3], spatial: Option<Rows<f64>>) -> (f64, [f64; 3], f64) {
    let q = Symmetric::symmetric_part(acoustic_tensor(tangent, normal));
    let Some(inverse_transpose) = spatial else {
        let decomposition = decompose(&q);
        let [a, b, c] = decomposition.values;
        return (c, decomposition.vectors[2], a * b * c);
    };
    // Q in the plane of amplitudes that keep the volume.
    let n = unit(apply(inverse_transpose, normal));
    let helper = if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let u = unit(cross(n, helper));
    let v = cross(n, u);
    let (a, b, c) = (dot(u, q.apply(u)), dot(v, q.apply(v)), dot(u, q.apply(v)));
    let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
    let radius = half.hypot(c);
    // The smaller eigenvalue has its vector at the angle π/2 + ½ atan2(c, half).
    let (sine, cosine) = (0.5 * c.atan2(half)).sin_cos();
    let amplitude = core::array::from_fn(|i| cosine * v[i] - sine * u[i]);
    (mean - radius, amplitude, (mean - radius) * (mean + radius))
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

/// Directions of the lattice.
const DIRECTIONS: u32 = 240;

/// The k-th direction of a lattice that covers half the sphere evenly (Fibonacci's), the axes first.
fn direction(k: u32) -> [f64; 3] {
    let axis = match k {
        0 => Some([1.0, 0.0, 0.0]),
        1 => Some([0.0, 1.0, 0.0]),
        2 => Some([0.0, 0.0, 1.0]),
        _ => None,
    };
    if let Some(axis) = axis {
        return axis;
    }
    let k = f64::from(k - 3);
    let height = (k + 0.5) / f64::from(DIRECTIONS - 3);
    // The golden angle.
    let (sine, cosine) = (2.399_963_229_728_653 * k).sin_cos();
    let radius = ((1.0 - height) * (1.0 + height)).sqrt();
    [radius * cosine, radius * sine, height]
}

/// The smallest value near a direction, by steps across it that are halved where none helps.
fn refined(mut normal: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> ([f64; 3], f64) {
    let mut value = f(normal);
    let mut step = 0.1;
    while 1e-9 < step {
        let helper = if normal[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let u = unit(cross(normal, helper));
        let v = cross(normal, u);
        let mut moved = false;
        for (a, b) in
            [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)]
        {
            let trial = unit(core::array::from_fn(|i| normal[i] + step * (a * u[i] + b * v[i])));
            let there = f(trial);
            if there < value {
                (normal, value, moved) = (trial, there, true);
                break;
            }
        }
        if !moved {
            step *= 0.5;
        }
    }
    (normal, value)
}

/// The least of the acoustic tensor of a law at a deformation, over all directions.
///
/// ```text
/// strong ellipticity: 0 < m · Q(N) m      Legendre–Hadamard: 0 ≤ m · Q(N) m      ellipticity: det Q(N) ≠ 0
/// ```
/// A lattice of 240 directions is searched and its three best refined to 1e-9 rad. An incompressible law is asked about
/// isochoric motions only.
///
/// # Accuracy
/// The value within a few ulp of the moduli, if the least lies in the basin of a lattice direction (6° apart).
///
/// # Example
/// ```
/// use piola_specimens::checks::{Kinematics, ellipticity};
/// use piola_solids::MooneyRivlin;
/// use piola_continuum::DeformationGradient;
/// let solid = MooneyRivlin::stress_free(0.5, 0.0, 1.0)?; // μ = 1, λ = 4
/// let least = ellipticity(&solid, &DeformationGradient::<f64>::identity(), Kinematics::Free);
/// assert!((least.modulus - 1.0).abs() < 1e-14); // shear waves
/// assert!((least.determinant - 6.0).abs() < 1e-13);
/// # Ok::<(), piola_specimens::SpecimensError>(())
/// ```
#[must_use]
pub fn ellipticity(
    law: &impl Hyperelastic,
    deformation: &impl Deformation<f64>,
    kinematics: Kinematics,
) -> Ellipticity {
    let tangent = law.first_piola_tangent(deformation);
    let spatial = (kinematics.of(law) == Kinematics::Isochoric).then(|| transpose(deformation.inverse_rows()));
    let modulus_of = |normal: [f64; 3]| least(&tangent, normal, spatial).0;
    let determinant_of = |normal: [f64; 3]| least(&tangent, normal, spatial).2;
    let (normal, modulus) = minimum(modulus_of);
    let (determinant_normal, determinant) = minimum(determinant_of);
    let amplitude = least(&tangent, normal, spatial).1;
    Ellipticity { modulus, normal, amplitude, determinant, determinant_normal }
}

/// The minimum over the sphere: the best of the lattice refined.
fn minimum(f: impl Fn([f64; 3]) -> f64) -> ([f64; 3], f64) {
    let mut best = [([0.0, 0.0, 1.0], f64::INFINITY); 3];
    for k in 0..DIRECTIONS {
        let normal = direction(k);
        let value = f(normal);
        // NaN comes first: it is the worst that can be said of a law.
        if let Some(place) = best.iter().position(|(_, known)| value < *known || value.is_nan()) {
            best[place..].rotate_right(1);
            best[place] = (normal, value);
        }
    }
    let mut least = best[0];
    for (normal, _) in best {
        let found = refined(normal, &f);
        if found.1 < least.1 {
            least = found;
        }
    }
    least
}

/// The worst of random deformations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticityScan {
    /// Number of deformations scanned, beside the reference.
    pub samples: usize,
    /// Number of further samples that the law refused.
    pub refused: usize,
    /// The deformation with the least modulus.
    pub gradient: DeformationGradient,
    /// Ellipticity there.
    pub worst: Ellipticity,
}

impl EllipticityScan {
    /// True if something was scanned and all was strongly elliptic.
    #[must_use]
    pub fn passes(&self) -> bool {
        0 < self.samples && self.worst.is_strong()
    }
}

/// Tries to refute strong ellipticity over random deformations; isochoric ones where the kinematics or the law are.
#[must_use]
pub fn ellipticity_scan(law: &impl Hyperelastic, search: &Search, kinematics: Kinematics) -> EllipticityScan {
    let mut sampler = Sampler::new(search.seed);
    let gradient = DeformationGradient::identity();
    let kinematics = kinematics.of(law);
    let worst = ellipticity(law, &gradient, kinematics);
    let mut scan = EllipticityScan { samples: 0, refused: 0, gradient, worst };
    for _ in 0..search.samples {
        let mut matrix = sampler.gradient(search.strain);
        if kinematics == Kinematics::Isochoric {
            matrix = super::law::isochoric(matrix);
        }
        let answered = DeformationGradient::new(matrix).ok().filter(|gradient| law.check(gradient).is_ok());
        let Some(gradient) = answered else {
            scan.refused += 1;
            continue;
        };
        let found = ellipticity(law, &gradient, kinematics);
        scan.samples += 1;
        if found.modulus < scan.worst.modulus || found.modulus.is_nan() {
            (scan.gradient, scan.worst) = (gradient, found);
        }
    }
    scan
}

/// The point where a path leaves strong ellipticity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// The parameter of the path.
    pub parameter: f64,
    /// Ellipticity there.
    pub ellipticity: Ellipticity,
}

/// The first loss of strong ellipticity along a path from `from` to `to`, looked at in `steps` steps and then bisected; none
/// if there is none, or if the path ends before it (where `path` has no deformation or the law no answer).
#[must_use]
pub fn first_loss<D: Deformation<f64>>(
    law: &impl Hyperelastic,
    path: impl Fn(f64) -> Option<D>,
    from: f64,
    to: f64,
    steps: u32,
    kinematics: Kinematics,
) -> Option<Loss> {
    let at = |parameter: f64| {
        let deformation = path(parameter).filter(|deformation| law.check(deformation).is_ok())?;
        Some(Loss { parameter, ellipticity: ellipticity(law, &deformation, kinematics) })
    };
    let mut good = from;
    for step in 0..=steps {
        let parameter = from + (to - from) * f64::from(step) / f64::from(steps.max(1));
        let mut loss = at(parameter)?;
        if loss.ellipticity.is_strong() {
            good = parameter;
            continue;
        }
        if step == 0 {
            return Some(loss);
        }
        for _ in 0..48 {
            let middle = at(0.5 * (good + loss.parameter))?;
            if middle.ellipticity.is_strong() {
                good = middle.parameter;
            } else {
                loss = middle;
            }
        }
        return Some(loss);
    }
    None
}
