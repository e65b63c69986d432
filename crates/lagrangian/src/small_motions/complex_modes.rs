//! Small motions with damping, gyroscopic and circulatory forces: (λ² M + λ D + K) φ = 0.

use nalgebra::{DMatrix, DVector, SVD, Schur};
use num_complex::Complex;

use super::reduction::Reduction;
use super::{Linearisation, Stability};
#[cfg(feature = "serde")]
use crate::check::check_finite;
use crate::{LagrangianError, SmallMotionsError};

/// Sweeps of the iterations for eigenvalues and singular values, for each row.
const SWEEPS: usize = 100;
/// How often the iteration for eigenvalues is begun, each time from other coordinates.
const ATTEMPTS: usize = 4;

/// One complex frequency λ with its shape: δq = Re(φ e^λt).
///
/// # Example
/// See [`ComplexModes`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct ComplexMode {
    /// λ, 1/s, with 0 ≤ Im λ: the conjugate, where there is one, belongs to the conjugate shape.
    pub eigenvalue: Complex<f64>,
    /// How far λ may be wrong by rounding, 1/s. Near √ulp of the frequencies where two modes merge.
    pub uncertainty: f64,
    /// φ, of length one in M, the largest component, measured by √M_ii, real and positive.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::column"))]
    pub shape: DVector<Complex<f64>>,
}

impl ComplexMode {
    /// |Im λ|, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.eigenvalue.im
    }
    /// Re λ, 1/s: negative where the motion decays.
    #[must_use]
    pub fn growth_rate(&self) -> f64 {
        self.eigenvalue.re
    }
    /// ζ = −Re λ/|λ|: one at and beyond critical damping, negative for growth, zero for λ = 0.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        let size = self.eigenvalue.norm();
        if 0.0 < size { -self.eigenvalue.re / size } else { 0.0 }
    }
}

/// All complex frequencies with 0 ≤ Im λ, by rising |Im λ|, then by rising Re λ.
///
/// # Example
/// A unit mass on a spring of 25 N/m with a damper of 6 N s/m: λ = −3 ± 4i.
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use piola_lagrangian::small_motions::{Linearisation, Stability};
/// let zero = dmatrix![0.0];
/// let oscillator = Linearisation {
///     acceleration: dvector![0.0],
///     mass_matrix: dmatrix![1.0],
///     damping: dmatrix![6.0],
///     gyroscopic: zero.clone(),
///     stiffness: dmatrix![25.0],
///     circulatory: zero,
/// };
/// let modes = oscillator.complex_modes()?;
/// let mode = &modes.modes[0];
/// assert!((mode.growth_rate() + 3.0).abs() < 1e-14 && (mode.angular_frequency() - 4.0).abs() < 1e-14);
/// assert!((mode.damping_ratio() - 0.6).abs() < 1e-15);
/// assert_eq!(modes.stability(), Stability::Asymptotic);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ComplexModes {
    /// The modes: n of them if all oscillate, one more for each pair that does not.
    pub modes: Vec<ComplexMode>,
}

impl ComplexModes {
    /// The verdict of the real parts, each against its uncertainty; [`Linearisation::stability`] looks at
    /// energies first.
    #[must_use]
    pub fn stability(&self) -> Stability {
        if self.modes.iter().any(|mode| mode.uncertainty < mode.eigenvalue.re) {
            Stability::Unstable
        } else if self.modes.iter().all(|mode| mode.eigenvalue.re < -mode.uncertainty) {
            Stability::Asymptotic
        } else {
            Stability::Marginal
        }
    }
}

/// λ² + λ D + K, in coordinates where M = 1.
struct Pencil {
    velocity_matrix: DMatrix<f64>,
    position_matrix: DMatrix<f64>,
}

impl Pencil {
    fn at(&self, lambda: Complex<f64>) -> DMatrix<Complex<f64>> {
        let n = self.position_matrix.nrows();
        DMatrix::from_fn(n, n, |i, j| {
            let square = if i == j { lambda * lambda } else { Complex::new(0.0, 0.0) };
            square + lambda * self.velocity_matrix[(i, j)] + self.position_matrix[(i, j)]
        })
    }

    /// 2λ + D.
    fn derivative_at(&self, lambda: Complex<f64>) -> DMatrix<Complex<f64>> {
        let n = self.position_matrix.nrows();
        DMatrix::from_fn(n, n, |i, j| {
            let twice = if i == j { lambda + lambda } else { Complex::new(0.0, 0.0) };
            twice + self.velocity_matrix[(i, j)]
        })
    }

    /// The size of the terms of λ² + λ D + K.
    fn size_at(&self, lambda: Complex<f64>) -> f64 {
        let size = lambda.norm();
        size * size + size * self.velocity_matrix.norm() + self.position_matrix.norm()
    }

    /// The eigenvalues, by the Schur form of the first-order system in units of time that balance it.
    fn eigenvalues(&self) -> Option<Vec<Complex<f64>>> {
        let n = self.position_matrix.nrows();
        let unit = self.position_matrix.norm().sqrt().max(self.velocity_matrix.norm());
        if unit <= 0.0 {
            return Some(vec![Complex::new(0.0, 0.0); 2 * n]);
        }
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            matrix[(i, n + i)] = unit;
            for j in 0..n {
                matrix[(n + i, j)] = -self.position_matrix[(i, j)] / unit;
                matrix[(n + i, n + j)] = -self.velocity_matrix[(i, j)];
            }
        }
        for attempt in 0..ATTEMPTS {
            if let Some(schur) = Schur::try_new(matrix.clone(), f64::EPSILON, SWEEPS * 2 * n) {
                let eigenvalues = schur.complex_eigenvalues();
                if eigenvalues.iter().all(|x| x.re.is_finite() && x.im.is_finite()) {
                    return Some(eigenvalues.iter().copied().collect());
                }
            }
            // Symmetric spectra can hold the iteration up: the same matrix seen in a mirror.
            let mirror = DVector::from_fn(2 * n, |i, _| (1.0 + (i * (attempt + 3)) as f64).sin()).normalize();
            let reflection = DMatrix::identity(2 * n, 2 * n) - &mirror * mirror.transpose() * 2.0;
            matrix = &reflection * matrix * &reflection;
        }
        None
    }

    /// The mode that belongs to an approximate eigenvalue, the `repetition`-th of several equal ones.
    fn mode(&self, mut lambda: Complex<f64>, repetition: usize) -> Option<(Complex<f64>, f64, DVector<Complex<f64>>)> {
        let n = self.position_matrix.nrows();
        let real = lambda.im == 0.0;
        for pass in 0.. {
            let svd = SVD::try_new(self.at(lambda), true, true, f64::EPSILON, SWEEPS * n)?;
            let (left, right) = (svd.u?, svd.v_t?.adjoint());
            let rounding = 8.0 * n as f64 * f64::EPSILON * self.size_at(lambda);
            // Singular values fall: those of rounding size are the last ones.
            let multiplicity = svd.singular_values.iter().filter(|&&x| x <= rounding).count().max(1);
            let slope = left.columns(n - multiplicity, multiplicity).adjoint()
                * self.derivative_at(lambda)
                * right.columns(n - multiplicity, multiplicity);
            let slope_size = if multiplicity == 1 {
                slope[(0, 0)].norm()
            } else {
                SVD::try_new(slope.clone(), false, false, f64::EPSILON, SWEEPS * n)?.singular_values.min()
            };
            // The root x of x² + |slope| x = rounding: merging modes are known to the square root of rounding.
            let uncertainty = 2.0 * rounding / (slope_size + (slope_size * slope_size + 4.0 * rounding).sqrt());
            let shape = right.column(n - 1 - repetition.min(multiplicity - 1)).into_owned();
            if multiplicity == 1 && pass < 2 {
                // Newton: u*(P + δλ P′)φ = 0.
                let remainder = (left.column(n - 1).adjoint() * self.at(lambda) * right.column(n - 1))[(0, 0)];
                let mut step = -remainder / slope[(0, 0)];
                if real {
                    step.im = 0.0;
                }
                if step.norm() <= 1e-6 * self.size_at(lambda).sqrt() {
                    lambda += step;
                    continue;
                }
            }
            return Some((lambda, uncertainty, shape));
        }
        None
    }
}

impl Linearisation {
    /// The complex frequencies and shapes of M δq̈ + (C + G) δq̇ + (K + N) δq = 0.
    ///
    /// ```text
    /// (λ² M + λ (C + G) + K + N) φ = 0        δq = Re(φ e^λt)
    /// ```
    ///
    /// In coordinates where M = 1: the eigenvalues of the first-order form, then for each the null vectors of
    /// λ² + λD + K by singular values, and one or two Newton steps for λ with them.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`] unless all matrices are n×n; [`LagrangianError::SingularMetric`],
    /// [`LagrangianError::NotFinite`], [`SmallMotionsError::NoEigenvalues`].
    ///
    /// # Accuracy
    /// Each λ to its `uncertainty`: 8n ulp of |λ|² + |λ||D| + |K| over the rate at which the pencil changes
    /// with λ, and no better than the square root of that where two modes merge.
    pub fn complex_modes(&self) -> Result<ComplexModes, LagrangianError> {
        let n = self.coordinates();
        self.check()?;
        if n == 0 {
            return Ok(ComplexModes { modes: Vec::new() });
        }
        let reduction = Reduction::of(&self.mass_matrix)?;
        let pencil = Pencil {
            velocity_matrix: reduction.of_form(&self.velocity_matrix()),
            position_matrix: reduction.of_form(&self.position_matrix()),
        };
        let failed = || LagrangianError::SmallMotions(SmallMotionsError::NoEigenvalues { rows: 2 * n });
        let mut eigenvalues = pencil.eigenvalues().ok_or_else(failed)?;
        eigenvalues.retain(|x| 0.0 <= x.im);
        eigenvalues.sort_by(|a, b| a.im.total_cmp(&b.im).then(a.re.total_cmp(&b.re)));
        let mut modes = Vec::with_capacity(eigenvalues.len());
        for (k, &eigenvalue) in eigenvalues.iter().enumerate() {
            let near = 32.0 * n as f64 * f64::EPSILON * pencil.size_at(eigenvalue).sqrt();
            let equal = |other: &&Complex<f64>| (**other - eigenvalue).norm() <= near;
            let repetition = eigenvalues[..k].iter().filter(equal).count();
            let (eigenvalue, uncertainty, y) = pencil.mode(eigenvalue, repetition).ok_or_else(failed)?;
            modes.push(ComplexMode { eigenvalue, uncertainty, shape: self.oriented(reduction.shape(&y)) });
        }
        modes.sort_by(|a, b| {
            let (a, b) = (a.eigenvalue, b.eigenvalue);
            a.im.total_cmp(&b.im).then(a.re.total_cmp(&b.re))
        });
        Ok(ComplexModes { modes })
    }

    /// The shape with the phase that makes its largest component real and positive, the first of nearly equal
    /// ones.
    fn oriented(&self, shape: DVector<Complex<f64>>) -> DVector<Complex<f64>> {
        let share = |i: usize| shape[i].norm() * self.mass_matrix[(i, i)].sqrt();
        let largest = (0..shape.len()).map(share).fold(0.0, f64::max);
        let Some(first) = (0..shape.len()).find(|&i| (1.0 - 1e-6) * largest <= share(i)) else { return shape };
        let phase = shape[first].conj() / shape[first].norm();
        let mut turned = shape.map(|x| x * phase);
        turned[first].im = 0.0;
        turned
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    eigenvalue: Complex<f64>,
    uncertainty: f64,
    #[serde(deserialize_with = "crate::written::column::deserialize")]
    shape: DVector<Complex<f64>>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for ComplexMode {
    type Error = LagrangianError;

    fn try_from(Unchecked { eigenvalue, uncertainty, shape }: Unchecked) -> Result<Self, LagrangianError> {
        check_finite("eigenvalue", &[eigenvalue.re, eigenvalue.im])?;
        check_finite("uncertainty", &[uncertainty])?;
        for component in &shape {
            check_finite("shape", &[component.re, component.im])?;
        }
        Ok(Self { eigenvalue, uncertainty, shape })
    }
}
