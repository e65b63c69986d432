//! Universal deformations of incompressible isotropic solids.

use nalgebra::Vector3;
use piola_fields::Motion;
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant};
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::Rows;

use super::kernels::{gradient, values, variables};
use super::{Refutation, check};
use crate::error::{check_bound, check_finite};
use crate::{LocalDeformation, ResponseFunctions, SolutionsError};

/// A stored energy of I and II: a product of powers about the invariants of a particle.
///
/// ```text
/// W = (I − I⁰)ⁱ (II − II⁰)ʲ,   1 ≤ i + j ≤ 3
/// ```
/// # Example
/// See [`incompressible`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncompressibleEnergy {
    /// I⁰ − 3 and II⁰ − 3.
    pub about: [f64; 2],
    /// i and j.
    pub powers: [u8; 2],
}

impl IncompressibleEnergy {
    /// The nine energies about the invariants of a particle.
    fn all(about: [f64; 2]) -> impl Iterator<Item = Self> {
        let powers = (0..=3_u8).flat_map(|i| (0..=3 - i).map(move |j| [i, j]));
        powers.filter(|powers| *powers != [0, 0]).map(move |powers| Self { about, powers })
    }
}

impl ResponseFunctions for IncompressibleEnergy {
    fn response<T: Real>(&self, first: T, second: T) -> [T; 2] {
        let (x, y) = (first - T::lit(self.about[0]), second - T::lit(self.about[1]));
        let [i, j] = self.powers.map(i32::from);
        let slope = |power: i32, base: T| {
            if power == 0 { T::zero() } else { T::lit(f64::from(power)) * base.powi(power - 1) }
        };
        let two = T::lit(2.0);
        [two * slope(i, x) * y.powi(j), -(two * x.powi(i) * slope(j, y))]
    }
}

/// div (g₁ B + g₋₁ B⁻¹) at a particle, in Cartesian components.
fn force<T: Real>(motion: &impl Motion, law: &impl ResponseFunctions, reference: &Vector3<T>, t: f64) -> [T; 3] {
    let f: Rows<Gradient<T, 3>> = gradient(motion, &variables(reference), t);
    let stress = LocalDeformation::of(f).extra_stress(law).rows();
    let back = inverse_and_determinant(values(f)).0;
    core::array::from_fn(|i| {
        let mut sum = T::zero();
        for (a, row) in back.iter().enumerate() {
            for (j, back) in row.iter().enumerate() {
                sum += stress[i][j].partials[a] * *back;
            }
        }
        sum
    })
}

/// The stored energy of an incompressible isotropic solid for which no pressure balances the deformation: of nine, the one for
/// which curl div (g₁ B + g₋₁ B⁻¹) is largest.
///
/// The curl depends on the first three derivatives of W at the invariants of the particle: nine numbers, each of which one
/// energy has for itself.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | X | `particles` | m |
/// | | `size` of the body: a residual is compared with the stress over its square | m |
///
/// # Errors
/// What the motion refuses; [`SolutionsError::OutOfBounds`] for no particle, unless 0 < size, and where |det F − 1| exceeds 1e-9.
///
/// # Accuracy
/// Exact derivatives: a few ulp × powers of the condition number of F.
///
/// # Example
/// Torsion passes; a shear with an amount that varies does not.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_numerics::Real;
/// use piola_solutions::families::{AsMotion, TubeDeformation};
/// use piola_solutions::universality::incompressible;
/// let particles = [Vector3::new(1.0, 0.5, 0.25), Vector3::new(0.5, -1.0, 0.0)];
/// let twist = AsMotion(TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 1.0])?);
/// assert!(!incompressible(&twist, &particles, 0.0, 1.0)?.refutes(1e-10));
/// struct Bow;
/// impl Motion for Bow {
///     fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
///         Vector3::new(x[0], x[1] + x[0] * x[0] * x[0], x[2])
///     }
/// }
/// assert!(incompressible(&Bow, &particles, 0.0, 1.0)?.refutes(1e-3));
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// J. L. Ericksen, Z. angew. Math. Phys. 5 (1954) 466; W §25.
pub fn incompressible(
    motion: &impl Motion,
    particles: &[Vector3<f64>],
    t: f64,
    size: f64,
) -> Result<Refutation<IncompressibleEnergy>, SolutionsError> {
    check(particles, size)?;
    let mut worst: Option<Refutation<IncompressibleEnergy>> = None;
    for particle in particles {
        motion.deformation_gradient(particle, t)?;
        let f: Rows<f64> = gradient(motion, particle, t);
        let change = determinant(f) - 1.0;
        check_bound("det F − 1", change, "|det F − 1| ≤ 1e-9", change.abs() <= 1e-9)?;
        let local = LocalDeformation::of(f);
        let back = inverse_and_determinant(f).0;
        let about = [local.first_minus_three, local.second_minus_three];
        let stretch = local.left_cauchy_green.norm() + local.inverse.norm();
        for law in IncompressibleEnergy::all(about) {
            let force = force::<Gradient<f64, 3>>(motion, &law, &variables(particle), t);
            let slope = |i: usize, j: usize| (0..3).map(|a| force[i].partials[a] * back[a][j]).sum::<f64>();
            let residual = [slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1)];
            check_finite("curl of the force", &residual)?;
            // The stress at invariants as far from I⁰ as the stretches are from zero.
            let degree = i32::from(law.powers[0] + law.powers[1]);
            let scale = f64::from(degree) * stretch.powi(degree);
            let relative = Vector3::from(residual).norm() * size * size / scale;
            if worst.is_none_or(|worst| worst.relative < relative) {
                worst = Some(Refutation { law, reference: (*particle).into(), residual, relative });
            }
        }
    }
    worst.ok_or(SolutionsError::OutOfBounds { quantity: "number of particles", value: 0.0, bound: "1 ≤ number" })
}
