//! Lie algebras of symmetry groups.

use nalgebra::{DMatrix, Matrix3, Vector3};
use piola_numerics::Real;

use crate::UniformityError;
use crate::error::{check_bound, check_finite};
use crate::indices::{Third, third};

/// The Lie algebra 𝔤 of a symmetry group, by an orthonormal basis of 3×3 matrices.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_uniformity::LieAlgebra;
/// assert_eq!(LieAlgebra::trivial().dimension(), 0); // crystals of all classes
/// assert_eq!(LieAlgebra::rotations_about(Vector3::z())?.dimension(), 1);
/// assert_eq!(LieAlgebra::rotations().dimension(), 3);
/// assert_eq!(LieAlgebra::unimodular().dimension(), 8); // fluids
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LieAlgebra {
    basis: Vec<Matrix3<f64>>,
    correction: Option<Box<Correction>>,
}

/// The linear map from the torsion `Y^c_ab` of a frame to the `ω^c_ab` ∈ 𝔤 that leaves the least torsion.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Correction([[f64; 9]; 27]);

impl Correction {
    /// `ω^c_ab` of `Y^c_ab`.
    #[inline]
    pub(crate) fn of<T: Real>(&self, torsion: &Third<T>) -> Third<T> {
        let independent: [T; 9] = core::array::from_fn(|n| {
            let (c, (a, b)) = (n / 3, PAIRS[n % 3]);
            torsion[c][a][b]
        });
        third(|c, a, b| {
            let row = &self.0[9 * c + 3 * a + b];
            row.iter().zip(independent).fold(T::zero(), |sum, (&factor, y)| sum + T::lit(factor) * y)
        })
    }
}

/// The independent pairs of the antisymmetric indices.
const PAIRS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// The part that must be new, or outside, to count as independent.
const INDEPENDENT: f64 = 1e-9;

impl LieAlgebra {
    /// 𝔤 = 0: discrete groups, the crystals of all classes.
    #[must_use]
    pub const fn trivial() -> Self {
        Self { basis: Vec::new(), correction: None }
    }

    /// Rotations about an axis: a transversely isotropic solid.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`]; [`UniformityError::OutOfBounds`] for an axis without direction.
    pub fn rotations_about(axis: Vector3<f64>) -> Result<Self, UniformityError> {
        check_finite("axis", axis.as_slice())?;
        check_bound("axis", axis.norm(), "0 < |axis|", 0.0 < axis.norm())?;
        Ok(Self::of_orthonormal(vec![axis.normalize().cross_matrix() / core::f64::consts::SQRT_2]))
    }

    /// All rotations: an isotropic solid in an undistorted reference.
    #[must_use]
    pub fn rotations() -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        Self::of_orthonormal(axes.map(|axis| axis.cross_matrix() / core::f64::consts::SQRT_2).to_vec())
    }

    /// All matrices without trace: a fluid.
    #[must_use]
    pub fn unimodular() -> Self {
        let unit = |i: usize, j: usize| {
            let mut unit = Matrix3::zeros();
            unit[(i, j)] = 1.0;
            unit
        };
        let mut basis: Vec<Matrix3<f64>> =
            [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)].map(|(i, j)| unit(i, j)).to_vec();
        basis.push((unit(0, 0) - unit(1, 1)) / core::f64::consts::SQRT_2);
        basis.push((unit(0, 0) + unit(1, 1) - unit(2, 2) * 2.0) / 6.0_f64.sqrt());
        Self::of_orthonormal(basis)
    }

    /// Spanned by given matrices, as of a group K 𝒢 K⁻¹ whose reference is distorted, or of a fluid crystal.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`], [`UniformityError::DependentBasis`], [`UniformityError::NotAnAlgebra`] when a bracket
    /// AB − BA leaves the span.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_uniformity::{LieAlgebra, UniformityError};
    /// let (x, y) = (Vector3::x().cross_matrix(), Vector3::y().cross_matrix());
    /// let error = LieAlgebra::spanned_by(&[x, y]); // [x, y] turns about e₃
    /// assert!(matches!(error, Err(UniformityError::NotAnAlgebra { first: 0, second: 1, .. })));
    /// ```
    pub fn spanned_by(matrices: &[Matrix3<f64>]) -> Result<Self, UniformityError> {
        let mut basis: Vec<Matrix3<f64>> = Vec::new();
        for (index, matrix) in matrices.iter().enumerate() {
            check_finite("basis", matrix.as_slice())?;
            // Twice: the second pass removes what rounding of the first has left.
            let outside = without(&basis, &without(&basis, matrix));
            let share = outside.norm() / matrix.norm();
            let is_independent = INDEPENDENT < share;
            if !is_independent {
                return Err(UniformityError::DependentBasis { index, share });
            }
            basis.push(outside / outside.norm());
        }
        for (first, a) in matrices.iter().enumerate() {
            for (second, b) in matrices.iter().enumerate().skip(first + 1) {
                let bracket = a * b - b * a;
                let share = without(&basis, &bracket).norm() / (a.norm() * b.norm());
                if INDEPENDENT < share {
                    return Err(UniformityError::NotAnAlgebra { first, second, share });
                }
            }
        }
        Ok(Self::of_orthonormal(basis))
    }

    /// The dimension of 𝔤.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// An orthonormal basis, A : B = δ.
    #[must_use]
    pub fn basis(&self) -> &[Matrix3<f64>] {
        &self.basis
    }

    /// The part of a matrix in 𝔤.
    #[must_use]
    pub fn projection<T: Real>(&self, matrix: &Matrix3<T>) -> Matrix3<T> {
        self.basis.iter().fold(Matrix3::from_element(T::zero()), |sum, unit| {
            let share = unit.iter().zip(matrix.iter()).fold(T::zero(), |sum, (&u, &m)| sum + T::lit(u) * m);
            sum + unit.map(|u| T::lit(u) * share)
        })
    }

    pub(crate) fn correction(&self) -> Option<&Correction> {
        self.correction.as_deref()
    }

    fn of_orthonormal(basis: Vec<Matrix3<f64>>) -> Self {
        let correction = least_torsion(&basis);
        Self { basis, correction }
    }
}

/// A matrix without its part in the span of orthonormal ones.
fn without(basis: &[Matrix3<f64>], matrix: &Matrix3<f64>) -> Matrix3<f64> {
    basis.iter().fold(*matrix, |rest, unit| rest - unit * unit.dot(&rest))
}

/// Least squares of `Y^c_ab + ω^c_ab − ω^c_ba = 0` over `ω_b = Σᵢ wᵢ_b Eᵢ`: the pseudo-inverse, for it is the same at all points.
fn least_torsion(basis: &[Matrix3<f64>]) -> Option<Box<Correction>> {
    if basis.is_empty() {
        return None;
    }
    let unknowns = 3 * basis.len();
    let system = DMatrix::from_fn(9, unknowns, |row, column| {
        let (c, (a, b)) = (row / 3, PAIRS[row % 3]);
        let (unit, direction) = (&basis[column / 3], column % 3);
        let entry = |a: usize, b: usize| if b == direction { unit[(c, a)] } else { 0.0 };
        entry(a, b) - entry(b, a)
    });
    // Singular values of these systems are either zero or of order one.
    let inverse = system.pseudo_inverse(1e-9).ok()?;
    let entry = |place: usize, equation: usize| {
        let (c, a, b) = (place / 9, place / 3 % 3, place % 3);
        -basis.iter().enumerate().map(|(i, unit)| unit[(c, a)] * inverse[(3 * i + b, equation)]).sum::<f64>()
    };
    Some(Box::new(Correction(core::array::from_fn(|place| core::array::from_fn(|equation| entry(place, equation))))))
}
