//! Vibration without damping: K φ = ω² M φ.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use piola_numerics::sums::CompensatedSum;

use super::Linearisation;
use super::reduction::Reduction;
#[cfg(feature = "serde")]
use crate::check::{check_finite, check_length};
use crate::{LagrangianError, SmallMotionsError};

/// Sweeps of the iteration for eigenvalues, for each row of the matrix.
pub(super) const SWEEPS: usize = 100;

/// The normal modes of M δq̈ + K δq = 0, by rising ω².
///
/// ```text
/// K φ_k = ω_k² M φ_k        φ_kᵀ M φ_l = δ_kl        δq = Σ φ_k (a_k cos ω_k t + b_k sin ω_k t)
/// ```
///
/// # Example
/// Two unit masses between walls, three springs of 1 N/m: ω² = 1 and 3.
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use piola_lagrangian::small_motions::{Linearisation, ModeMotion};
/// let zero = dmatrix![0.0, 0.0; 0.0, 0.0];
/// let masses = Linearisation {
///     acceleration: dvector![0.0, 0.0],
///     mass_matrix: dmatrix![1.0, 0.0; 0.0, 1.0],
///     damping: zero.clone(),
///     gyroscopic: zero.clone(),
///     stiffness: dmatrix![2.0, -1.0; -1.0, 2.0],
///     circulatory: zero,
/// };
/// let modes = masses.normal_modes()?;
/// assert!((modes.squares[0] - 1.0).abs() < 1e-15 && (modes.squares[1] - 3.0).abs() < 1e-15);
/// assert!((modes.shapes[(0, 0)] - modes.shapes[(1, 0)]).abs() < 1e-15); // side by side
/// assert!((modes.shapes[(0, 1)] + modes.shapes[(1, 1)]).abs() < 1e-15); // against each other
/// let Some(ModeMotion::Oscillation { angular_frequency }) = modes.motion(1) else { panic!("it oscillates") };
/// assert!((angular_frequency - 3.0_f64.sqrt()).abs() < 1e-15);
/// assert_eq!((modes.angular_frequencies().len(), modes.motion(2)), (2, None));
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct NormalModes {
    /// ω², 1/s², rising; negative for a motion that runs away.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::column"))]
    pub squares: DVector<f64>,
    /// How far each ω² may be wrong by rounding, 1/s².
    #[cfg_attr(feature = "serde", serde(with = "crate::written::column"))]
    pub uncertainties: DVector<f64>,
    /// φ, one in each column: orthonormal in M, the largest component, measured by √M_ii, being positive.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub shapes: DMatrix<f64>,
}

/// How the amplitude of a normal mode changes with time.
///
/// # Example
/// See [`NormalModes`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ModeMotion {
    /// 0 < ω²: cos ωt and sin ωt.
    Oscillation {
        /// ω, rad/s.
        angular_frequency: f64,
    },
    /// ω² = 0 to rounding: 1 and t, as of a rigid body that nothing holds.
    Drift,
    /// ω² < 0: e^(σt) and e^(−σt).
    Growth {
        /// σ = √(−ω²), 1/s.
        rate: f64,
    },
}

impl NormalModes {
    /// How mode number `mode` moves; `None` beyond the last.
    #[must_use]
    pub fn motion(&self, mode: usize) -> Option<ModeMotion> {
        let (&square, &uncertainty) = (self.squares.get(mode)?, self.uncertainties.get(mode)?);
        Some(if square.abs() <= uncertainty {
            ModeMotion::Drift
        } else if square < 0.0 {
            ModeMotion::Growth { rate: (-square).sqrt() }
        } else {
            ModeMotion::Oscillation { angular_frequency: square.sqrt() }
        })
    }

    /// ω of the modes that oscillate, rad/s, rising.
    #[must_use]
    pub fn angular_frequencies(&self) -> Vec<f64> {
        let oscillating = |mode| match self.motion(mode) {
            Some(ModeMotion::Oscillation { angular_frequency }) => Some(angular_frequency),
            _ => None,
        };
        (0..self.squares.len()).filter_map(oscillating).collect()
    }
}

impl Linearisation {
    /// The normal modes of the mass matrix and the stiffness alone: damping, gyroscopic and circulatory
    /// forces are left out. For these there are [`complex_modes`](Self::complex_modes).
    ///
    /// M is scaled to unit diagonal and factored, the symmetric matrix that is left diagonalised, and each ω²
    /// computed once more from its shape and the given matrices, ω² = φ·Kφ / φ·Mφ, whose error is of second
    /// order in that of the shape.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`] unless all matrices are n×n; [`LagrangianError::SingularMetric`],
    /// [`LagrangianError::NotFinite`], [`SmallMotionsError::NoEigenvalues`].
    ///
    /// # Accuracy
    /// Each ω² to a few n ulp of Σ|φ_i||K_ij||φ_j|, which `uncertainties` holds; shapes to some n ulp ×
    /// (condition number of M scaled to unit diagonal) × (largest ω²)/(distance to the nearest other ω²).
    pub fn normal_modes(&self) -> Result<NormalModes, LagrangianError> {
        let n = self.coordinates();
        self.check()?;
        if n == 0 {
            let (squares, uncertainties) = (DVector::zeros(0), DVector::zeros(0));
            return Ok(NormalModes { squares, uncertainties, shapes: DMatrix::zeros(0, 0) });
        }
        let reduction = Reduction::of(&self.mass_matrix)?;
        let reduced = reduction.of_form(&self.stiffness);
        let reduced = (&reduced + reduced.transpose()) * 0.5;
        let eigen = SymmetricEigen::try_new(reduced, f64::EPSILON, SWEEPS * n)
            .ok_or(LagrangianError::SmallMotions(SmallMotionsError::NoEigenvalues { rows: n }))?;
        let mut modes: Vec<(f64, f64, DVector<f64>)> = eigen
            .eigenvectors
            .column_iter()
            .map(|y| {
                let shape = oriented(reduction.shape(&y.into_owned()), &self.mass_matrix);
                let (inertia, _) = quadratic_form(&self.mass_matrix, &shape);
                let (stiffness, size) = quadratic_form(&self.stiffness, &shape);
                let rounding = 4.0 * (n as f64 + 1.0) * f64::EPSILON * size;
                (stiffness / inertia, rounding / inertia, shape / inertia.sqrt())
            })
            .collect();
        modes.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(NormalModes {
            squares: DVector::from_fn(n, |k, _| modes[k].0),
            uncertainties: DVector::from_fn(n, |k, _| modes[k].1),
            shapes: DMatrix::from_fn(n, n, |i, k| modes[k].2[i]),
        })
    }
}

/// x·Ax and Σ|x_i||A_ij||x_j|.
fn quadratic_form(matrix: &DMatrix<f64>, x: &DVector<f64>) -> (f64, f64) {
    let (mut sum, mut size) = (CompensatedSum::new(), 0.0);
    for (i, &a) in x.iter().enumerate() {
        for (j, &b) in x.iter().enumerate() {
            let weight = a * b;
            sum.add_product(matrix[(i, j)], weight);
            size += (matrix[(i, j)] * weight).abs();
        }
    }
    (sum.value(), size)
}

/// The shape with the sign that makes its largest component positive, the first of nearly equal ones.
fn oriented(shape: DVector<f64>, mass_matrix: &DMatrix<f64>) -> DVector<f64> {
    let share = |i: usize| shape[i].abs() * mass_matrix[(i, i)].sqrt();
    let largest = (0..shape.len()).map(share).fold(0.0, f64::max);
    match (0..shape.len()).find(|&i| (1.0 - 1e-6) * largest <= share(i)) {
        Some(i) if shape[i] < 0.0 => -shape,
        _ => shape,
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    #[serde(deserialize_with = "crate::written::column::deserialize")]
    squares: DVector<f64>,
    #[serde(deserialize_with = "crate::written::column::deserialize")]
    uncertainties: DVector<f64>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    shapes: DMatrix<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for NormalModes {
    type Error = LagrangianError;

    fn try_from(Unchecked { squares, uncertainties, shapes }: Unchecked) -> Result<Self, LagrangianError> {
        check_length("uncertainties", squares.len(), uncertainties.len())?;
        check_length("shapes", squares.len(), shapes.nrows())?;
        check_length("shapes", squares.len(), shapes.ncols())?;
        check_finite("squares", squares.as_slice())?;
        check_finite("uncertainties", uncertainties.as_slice())?;
        check_finite("shapes", shapes.as_slice())?;
        Ok(Self { squares, uncertainties, shapes })
    }
}
