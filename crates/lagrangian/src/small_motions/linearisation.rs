//! The equations of motion to first order about a state.

use nalgebra::{DMatrix, DVector};
use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt::Ldlt;
use piola_numerics::{Dual, Real};

use super::reduction;
use crate::LagrangianError;
use crate::check::{check_finite, check_length};
use crate::{Forces, Lagrangian, Potential, Workspace};

/// The equations of motion to first order about a state (q, q̇, t), split by what does work.
///
/// ```text
/// M δq̈ + (C + G) δq̇ + (K + N) δq = 0
/// C + G = ∂(M q̈₀ − f)/∂q̇        K + N = ∂(M q̈₀ − f)/∂q        q̈₀ = M⁻¹ f
/// ```
///
/// About a state that is no equilibrium they hold for as long as the motion stays near it; about a steady
/// motion, whose coefficients do not change with time, for as long as δq stays small.
///
/// # Example
/// See [`Lagrangian::linearise`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Unchecked<T>",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct Linearisation<T: Real = f64> {
    /// q̈₀, the accelerations at the state; zero at an equilibrium.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::column"))]
    pub acceleration: DVector<T>,
    /// M, symmetric.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub mass_matrix: DMatrix<T>,
    /// C, the symmetric part of −∂f/∂q̇: positive where the motion loses energy.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub damping: DMatrix<T>,
    /// G, the skew part of −∂f/∂q̇.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub gyroscopic: DMatrix<T>,
    /// K, the symmetric part of −∂f/∂q.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub stiffness: DMatrix<T>,
    /// N, the skew part of −∂f/∂q: zero where forces have a potential.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::matrix"))]
    pub circulatory: DMatrix<T>,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Linearises the equations of motion about any state.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇ | `q`, `v` | n | the coordinates' own |
    /// | M | `mass_matrix` | n×n | kg m²/\[q\]² |
    /// | C, G | `damping`, `gyroscopic` | n×n | kg m²/(s \[q\]²) |
    /// | K, N | `stiffness`, `circulatory` | n×n | J/\[q\]² |
    ///
    /// The derivatives are exact: 2n passes of the equations of motion over dual numbers.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Accuracy
    /// A few ulp of the terms summed; about a state with q̈₀ ≠ 0 of ∂M/∂q q̈₀ with the error of q̈₀.
    ///
    /// # Example
    /// A pendulum of 3 kg and 2 m hanging under 10 m/s²: M = m l² = 12, K = m g l = 60.
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_lagrangian::small_motions::Stability;
    /// use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// use piola_numerics::Real;
    /// struct Pendulum;
    /// impl Holonomic for Pendulum {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[0].sin_cos();
    ///         bodies.particle(3.0, Vector3::new(T::lit(2.0) * s, T::zero(), T::lit(-2.0) * c));
    ///     }
    /// }
    /// let hanging = Lagrangian::of(Pendulum).with_gravity(10.0).linearise(&[0.0], &[0.0], 0.0)?;
    /// assert_eq!((hanging.mass_matrix[(0, 0)], hanging.stiffness[(0, 0)]), (12.0, 60.0));
    /// let frequency = hanging.normal_modes()?.angular_frequencies()[0];
    /// assert!((frequency - 5.0_f64.sqrt()).abs() < 1e-15); // √(g/l)
    /// // Blown at by a horizontal force of its own weight it hangs at 45°.
    /// let found = Lagrangian::of(Pendulum).with_uniform_gravity([10.0, 0.0, -10.0]).equilibrium(&[0.0], 0.0)?;
    /// assert!((found.coordinates[0] - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    /// assert_eq!(found.stability, Stability::Stable);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(6.3), differentiated.
    pub fn linearise<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<Linearisation<T>, LagrangianError> {
        let acceleration = self.acceleration(q, v, t)?;
        self.linearise_at(q, v, t, acceleration)
    }

    /// The linearisation where the accelerations are known.
    pub(super) fn linearise_at<T: Real>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        acceleration: DVector<T>,
    ) -> Result<Linearisation<T>, LagrangianError> {
        let n = q.len();
        let mut sweep = Sweep::new(q, v, t);
        let mut position_matrix = DMatrix::from_element(n, n, T::zero());
        let mut velocity_matrix = position_matrix.clone();
        for j in 0..n {
            sweep.along(self, j, &acceleration, position_matrix.column_mut(j).as_mut_slice())?;
        }
        for j in 0..n {
            sweep.along(self, n + j, &acceleration, velocity_matrix.column_mut(j).as_mut_slice())?;
        }
        let mass_matrix = DMatrix::from_fn(n, n, |i, j| sweep.mass_matrix[i + j * n].value);
        let [damping, gyroscopic] = split(&velocity_matrix);
        let [stiffness, circulatory] = split(&position_matrix);
        Ok(Linearisation { acceleration, mass_matrix, damping, gyroscopic, stiffness, circulatory })
    }
}

/// The equations of motion over dual numbers, along one direction of the state after the other.
pub(super) struct Sweep<T> {
    work: Workspace<Dual<T>>,
    q: Vec<Dual<T>>,
    v: Vec<Dual<T>>,
    t: Dual<T>,
    pub(super) mass_matrix: Vec<Dual<T>>,
    pub(super) forcing: Vec<Dual<T>>,
}

impl<T: Real> Sweep<T> {
    pub(super) fn new(q: &[T], v: &[T], t: T) -> Self {
        let constants = |x: &[T]| x.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>();
        let zero = Dual::constant(T::zero());
        Self {
            work: Workspace::default(),
            q: constants(q),
            v: constants(v),
            t: Dual::constant(t),
            mass_matrix: vec![zero; q.len() * q.len()],
            forcing: vec![zero; q.len()],
        }
    }

    /// ∂(M a − f) along coordinate number `direction`, or from n on along a velocity, at constant a.
    pub(super) fn along<S: Holonomic, P: Potential, F: Forces>(
        &mut self,
        lagrangian: &Lagrangian<S, P, F>,
        direction: usize,
        a: &DVector<T>,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = self.q.len();
        *self.rate(direction) = T::one();
        let Self { work, q, v, t, mass_matrix, forcing } = &mut *self;
        lagrangian.equations_in_chunks(work, (q, v, *t), mass_matrix, forcing)?;
        for (i, out) in out.iter_mut().enumerate() {
            let inertia = (0..n).fold(T::zero(), |sum, j| sum + mass_matrix[i + j * n].tangent * a[j]);
            *out = inertia - forcing[i].tangent;
        }
        *self.rate(direction) = T::zero();
        Ok(())
    }

    fn rate(&mut self, direction: usize) -> &mut T {
        let n = self.q.len();
        &mut if direction < n { &mut self.q[direction] } else { &mut self.v[direction - n] }.tangent
    }
}

/// The symmetric and the skew part.
fn split<T: Real>(matrix: &DMatrix<T>) -> [DMatrix<T>; 2] {
    let n = matrix.nrows();
    let half = T::lit(0.5);
    [
        DMatrix::from_fn(n, n, |i, j| half * (matrix[(i, j)] + matrix[(j, i)])),
        DMatrix::from_fn(n, n, |i, j| half * (matrix[(i, j)] - matrix[(j, i)])),
    ]
}

impl<T: Real> Linearisation<T> {
    /// Refuses matrices that are not all n×n, and entries that are not finite.
    pub(super) fn check(&self) -> Result<(), LagrangianError> {
        let n = self.coordinates();
        check_length("acceleration", n, self.acceleration.len())?;
        check_finite("acceleration", self.acceleration.as_slice())?;
        let matrices = [
            ("mass matrix", &self.mass_matrix),
            ("damping", &self.damping),
            ("gyroscopic matrix", &self.gyroscopic),
            ("stiffness", &self.stiffness),
            ("circulatory matrix", &self.circulatory),
        ];
        for (quantity, matrix) in matrices {
            check_length(quantity, n, matrix.nrows())?;
            check_length(quantity, n, matrix.ncols())?;
            check_finite(quantity, matrix.as_slice())?;
        }
        Ok(())
    }

    /// The number of coordinates, n.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.mass_matrix.nrows()
    }

    /// C + G, what multiplies δq̇.
    #[must_use]
    pub fn velocity_matrix(&self) -> DMatrix<T> {
        let n = self.coordinates();
        DMatrix::from_fn(n, n, |i, j| self.damping[(i, j)] + self.gyroscopic[(i, j)])
    }

    /// K + N, what multiplies δq.
    #[must_use]
    pub fn position_matrix(&self) -> DMatrix<T> {
        let n = self.coordinates();
        DMatrix::from_fn(n, n, |i, j| self.stiffness[(i, j)] + self.circulatory[(i, j)])
    }

    /// The matrix A of the first-order form.
    ///
    /// ```text
    /// ẋ = A x,    x = (δq, δq̇),    A = [        0           1       ]
    ///                                  [ −M⁻¹(K + N)  −M⁻¹(C + G)  ]
    /// ```
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`] unless all matrices are n×n; [`LagrangianError::NotFinite`];
    /// [`LagrangianError::SingularMetric`].
    ///
    /// # Accuracy
    /// A few n ulp times the condition number of M scaled to unit diagonal, in each column.
    ///
    /// # Example
    /// ```
    /// # use piola_lagrangian::small_motions::Linearisation;
    /// # use nalgebra::{dmatrix, dvector};
    /// let zero = dmatrix![0.0];
    /// let spring_and_damper = Linearisation {
    ///     acceleration: dvector![0.0],
    ///     mass_matrix: dmatrix![2.0],
    ///     damping: dmatrix![6.0],
    ///     gyroscopic: zero.clone(),
    ///     stiffness: dmatrix![8.0],
    ///     circulatory: zero,
    /// };
    /// assert_eq!(spring_and_damper.state_matrix()?, dmatrix![0.0, 1.0; -4.0, -3.0]);
    /// assert_eq!(spring_and_damper.position_matrix(), dmatrix![8.0]);
    /// assert_eq!(spring_and_damper.velocity_matrix(), dmatrix![6.0]);
    /// assert_eq!(spring_and_damper.coordinates(), 1);
    /// // 1 N moves 2 kg with 0.5 m/s².
    /// assert_eq!(spring_and_damper.input_matrix(&dmatrix![1.0])?, dmatrix![0.0; 0.5]);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    pub fn state_matrix(&self) -> Result<DMatrix<T>, LagrangianError> {
        self.check()?;
        let n = self.coordinates();
        let factors = self.mass_factors()?;
        let mut matrix = DMatrix::from_element(2 * n, 2 * n, T::zero());
        let mut column = vec![T::zero(); n];
        for (first, block) in [(0, self.position_matrix()), (n, self.velocity_matrix())] {
            for j in 0..n {
                column.copy_from_slice(block.column(j).as_slice());
                factors.solve_in_place(&mut column)?;
                for (i, &entry) in column.iter().enumerate() {
                    matrix[(n + i, first + j)] = -entry;
                }
            }
        }
        for i in 0..n {
            matrix[(i, n + i)] = T::one();
        }
        Ok(matrix)
    }

    /// The matrix B of generalised forces as inputs.
    ///
    /// ```text
    /// ẋ = A x + B u,    B = [    0   ]
    ///                       [ M⁻¹ W  ]
    /// ```
    ///
    /// Column k of W holds the generalised forces of a unit of input k: for a motor on coordinate Δ the unit
    /// vector of Δ; for a force on a particle the derivatives of its place.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`] unless W has n rows and all matrices are n×n; [`LagrangianError::NotFinite`];
    /// [`LagrangianError::SingularMetric`].
    pub fn input_matrix(&self, inputs: &DMatrix<T>) -> Result<DMatrix<T>, LagrangianError> {
        self.check()?;
        let n = self.coordinates();
        check_length("inputs", n, inputs.nrows())?;
        check_finite("inputs", inputs.as_slice())?;
        let factors = self.mass_factors()?;
        let mut matrix = DMatrix::from_element(2 * n, inputs.ncols(), T::zero());
        for j in 0..inputs.ncols() {
            let mut column: Vec<T> = inputs.column(j).iter().copied().collect();
            factors.solve_in_place(&mut column)?;
            for (i, &entry) in column.iter().enumerate() {
                matrix[(n + i, j)] = entry;
            }
        }
        Ok(matrix)
    }

    fn mass_factors(&self) -> Result<Ldlt<T>, LagrangianError> {
        Ldlt::new(&self.mass_matrix).map_err(|error| reduction::singular(&self.mass_matrix, error))
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "T: Real + serde::Deserialize<'de>"))]
struct Unchecked<T: Real> {
    #[serde(deserialize_with = "crate::written::column::deserialize")]
    acceleration: DVector<T>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    mass_matrix: DMatrix<T>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    damping: DMatrix<T>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    gyroscopic: DMatrix<T>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    stiffness: DMatrix<T>,
    #[serde(deserialize_with = "crate::written::matrix::deserialize")]
    circulatory: DMatrix<T>,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Unchecked<T>> for Linearisation<T> {
    type Error = LagrangianError;

    fn try_from(given: Unchecked<T>) -> Result<Self, LagrangianError> {
        let Unchecked { acceleration, mass_matrix, damping, gyroscopic, stiffness, circulatory } = given;
        let linearisation = Self { acceleration, mass_matrix, damping, gyroscopic, stiffness, circulatory };
        linearisation.check()?;
        Ok(linearisation)
    }
}
