//! Ericksen's theorem for compressible isotropic solids.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_fields::Motion;
use piola_numerics::linear::matrix3::determinant;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::{Rows, cofactor, double_contraction, product, transposed_product};

use super::kernels::{gradient, values, variables};
use super::{Refutation, check};
use crate::SolutionsError;
use crate::error::check_finite;

/// A stored energy of the invariants (I, II, III) of B, in J/m³ of the reference: a polynomial about the invariants of a
/// particle.
///
/// ```text
/// W = Iₐ − Iₐ⁰        or        W = (Iₐ − Iₐ⁰)(I_b − I_b⁰)
/// ```
/// # Example
/// See [`compressible`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompressibleEnergy {
    /// I⁰, II⁰, III⁰.
    pub about: [f64; 3],
    /// a, from 0.
    pub first: usize,
    /// b, from 0; none for the linear energy.
    pub second: Option<usize>,
}

impl CompressibleEnergy {
    /// W at F, by rows, J/m³.
    #[must_use]
    pub fn energy<T: Real>(&self, gradient: Rows<T>) -> T {
        let invariants = invariants(gradient);
        let excess = |a: usize| invariants[a] - T::lit(self.about[a]);
        self.second.map_or_else(|| excess(self.first), |b| excess(self.first) * excess(b))
    }

    /// P = ∂W/∂F, Pa, at F, by rows.
    #[must_use]
    pub fn first_piola<T: Real>(&self, gradient: Rows<T>) -> FirstPiola<T> {
        let slopes = slopes(gradient);
        let invariants = invariants(gradient);
        let excess = |a: usize| invariants[a] - T::lit(self.about[a]);
        let a = self.first;
        FirstPiola(Matrix3::from_fn(|i, j| match self.second {
            None => slopes[a][i][j],
            Some(b) => slopes[a][i][j] * excess(b) + slopes[b][i][j] * excess(a),
        }))
    }
}

/// I, II, III of B.
fn invariants<T: Real>(f: Rows<T>) -> [T; 3] {
    let cof = cofactor(f);
    let jacobian = determinant(f);
    [double_contraction(f, f), double_contraction(cof, cof), jacobian * jacobian]
}

/// ∂I/∂F = 2 F, ∂II/∂F = 2 (I F − F C), ∂III/∂F = 2 J Cof F.
fn slopes<T: Real>(f: Rows<T>) -> [Rows<T>; 3] {
    let two = T::lit(2.0);
    let first = double_contraction(f, f);
    let (fc, cof, jacobian) = (product(f, transposed_product(f, f)), cofactor(f), determinant(f));
    let each = |entry: &dyn Fn(usize, usize) -> T| [0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| entry(i, j)));
    [
        each(&|i, j| two * f[i][j]),
        each(&|i, j| two * (first * f[i][j] - fc[i][j])),
        each(&|i, j| two * jacobian * cof[i][j]),
    ]
}

/// The stored energy of a compressible isotropic solid that leaves most of Div P = 0 in a deformation: by Ericksen's theorem
/// there is one, unless the deformation is homogeneous.
///
/// ```text
/// P = Σ Wₐ ∂Iₐ/∂F        Div P = Σ Wₐ Div ∂Iₐ/∂F + Σ W_ab (∂Iₐ/∂F) Grad I_b
/// ```
/// The nine first and second derivatives Wₐ and `W_ab` at a particle are independent.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | X | `particles` | m |
/// | | `size` of the body: a residual is compared with the stress over it | m |
///
/// # Errors
/// What the motion refuses; [`SolutionsError::OutOfBounds`] for no particle and unless 0 < size.
///
/// # Accuracy
/// Exact derivatives: a few ulp × the condition number of F.
///
/// # Example
/// A cylinder is twisted: in equilibrium in a neo-Hookean solid without change of volume, but not in all.
/// ```
/// use nalgebra::Vector3;
/// use piola_solutions::families::{AsMotion, TubeDeformation};
/// use piola_solutions::universality::compressible;
/// let twist = AsMotion(TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 1.0])?);
/// let refutation = compressible(&twist, &[Vector3::new(1.0, 0.5, 0.0)], 0.0, 1.0)?;
/// assert!(refutation.refutes(1e-10));
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(24.25–24.36).
#[doc(alias("Ericksen", "universal deformation"))]
pub fn compressible(
    motion: &impl Motion,
    particles: &[Vector3<f64>],
    t: f64,
    size: f64,
) -> Result<Refutation<CompressibleEnergy>, SolutionsError> {
    check(particles, size)?;
    let mut worst: Option<Refutation<CompressibleEnergy>> = None;
    for particle in particles {
        motion.deformation_gradient(particle, t)?;
        let f: Rows<Gradient<f64, 3>> = gradient(motion, &variables(particle), t);
        let (stresses, all) = (slopes(f), invariants(f));
        let about = all.map(|invariant| invariant.value);
        let mut consider = |first: usize, second: Option<usize>, residual: [f64; 3], stress: f64| {
            check_finite("Div P", &residual)?;
            let relative = Vector3::from(residual).norm() * size / stress;
            if worst.is_none_or(|worst| worst.relative < relative) {
                let law = CompressibleEnergy { about, first, second };
                worst = Some(Refutation { law, reference: (*particle).into(), residual, relative });
            }
            Ok::<(), SolutionsError>(())
        };
        let norm = |a: usize| double_contraction(values(stresses[a]), values(stresses[a])).sqrt();
        for a in 0..3 {
            let divergence: [f64; 3] = core::array::from_fn(|i| (0..3).map(|j| stresses[a][i][j].partials[j]).sum());
            consider(a, None, divergence, norm(a))?;
            for b in 0..=a {
                let residual: [f64; 3] = core::array::from_fn(|i| {
                    let term = |j: usize| {
                        stresses[a][i][j].value * all[b].partials[j] + stresses[b][i][j].value * all[a].partials[j]
                    };
                    (0..3).map(term).sum()
                });
                // P vanishes at the particle: its size is that at invariants as far from I⁰ as I⁰ is from zero.
                consider(a, Some(b), residual, norm(a) * about[b] + norm(b) * about[a])?;
            }
        }
    }
    worst.ok_or(SolutionsError::OutOfBounds { quantity: "number of particles", value: 0.0, bound: "1 ≤ number" })
}
