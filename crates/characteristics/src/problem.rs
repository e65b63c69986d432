//! An equation with initial data, and what is known of it along single characteristics.

use piola_integrators::Tolerance;
use piola_numerics::linear::lu;

use super::determinant::norm;
use super::ray::Marcher;
use super::strip::{Data, without_covector};
use super::{CausticPoint, FirstOrderPde, InitialManifold, InitialPoint, Search, StripKind};
use crate::check::{check_finite, check_length};
use crate::{CharacteristicsError, StripError};

/// The local error of the integrations, relative to the magnitudes of x, u and ξ, unless it is set.
const TOLERANCE: f64 = 1e-13;

/// Cauchy's problem: an equation Φ(x, u, ξ) = 0 in m variables, 2 ≤ m, with data on an initial manifold.
///
/// The characteristics that leave the points of the manifold at s = 0 cover the solution surface W(A.43), as long as
/// (s, τ) ↦ x is invertible. This type answers for single characteristics; [`solve`](Self::solve) makes the surface.
///
/// # Example
/// ```
/// use piola_characteristics::{CauchyProblem, FirstOrderPde, InitialManifold};
/// use piola_numerics::Real;
/// struct Eikonal; // (|ξ|² − 1)/2 = 0
/// impl FirstOrderPde for Eikonal {
///     fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
///         T::lit(0.5) * (xi[0] * xi[0] + xi[1] * xi[1] - T::one())
///     }
/// }
/// struct Parabola; // u = 0 on y = x²/2
/// impl InitialManifold for Parabola {
///     fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
///         (x[0], x[1]) = (tau[0], T::lit(0.5) * tau[0] * tau[0]);
///         T::zero()
///     }
/// }
/// let problem = CauchyProblem::new(&Eikonal, &Parabola, 2)?.near(&[0.0, 1.0])?;
/// assert_eq!(problem.initial_point(&[0.0])?.xi[1], 1.0);
/// let ray = problem.characteristic(&[0.0], 0.75)?;
/// assert!((ray.u - 0.75).abs() < 1e-14 && (ray.x[1] - 0.75).abs() < 1e-14);
/// let caustic = problem.caustic_points(&[0.0], 0.0, 2.0)?; // the centre of curvature
/// assert!((caustic[0].s - 1.0).abs() < 1e-13);
/// # Ok::<(), piola_characteristics::CharacteristicsError>(())
/// ```
///
/// # Source
/// W(A.39–A.43).
#[derive(Debug)]
pub struct CauchyProblem<'a, P, M> {
    pub(super) data: Data<'a, P, M>,
    pub(super) guess: Vec<f64>,
    pub(super) tolerance: Tolerance,
}

// Derived, it would ask the same of P and M.
impl<P, M> Clone for CauchyProblem<'_, P, M> {
    fn clone(&self) -> Self {
        Self { data: self.data, guess: self.guess.clone(), tolerance: self.tolerance }
    }
}

/// A point of a characteristic with the ray map about it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RayPoint {
    /// τ, the characteristic.
    pub parameters: Vec<f64>,
    /// s, where on it.
    pub s: f64,
    /// x.
    pub x: Vec<f64>,
    /// u.
    pub u: f64,
    /// ξ = ∇u.
    pub xi: Vec<f64>,
    /// ∂x/∂(s, τ): x_s, then x_τ by rows.
    pub jacobian: Vec<f64>,
    /// Its determinant.
    pub determinant: f64,
    /// Φ(x, u, ξ), which was zero at s = 0: its drift.
    pub equation: f64,
    /// |∇u − ξ|/|ξ| with ∇u from u_s, u_τ and the ray map: what is left of W(A.25). Infinite where the map has no
    /// inverse.
    pub gradient_residual: f64,
}

impl<'a, P: FirstOrderPde, M: InitialManifold> CauchyProblem<'a, P, M> {
    /// The problem of an equation in m variables with data on a manifold of m − 1 parameters.
    ///
    /// ξ is completed from the guess zero, which serves equations that are linear in ξ or in one component of it;
    /// otherwise see [`near`](Self::near).
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`] when m < 2; tolerances are those of rounding.
    pub fn new(equation: &'a P, manifold: &'a M, variables: usize) -> Result<Self, CharacteristicsError> {
        if variables < 2 {
            return Err(CharacteristicsError::WrongLength { quantity: "x", expected: 2, found: variables });
        }
        let tolerance = Tolerance::relative(TOLERANCE)
            .map_err(|source| CharacteristicsError::Run { time: 0.0, source: Box::new(source.with_field_error()) })?;
        Ok(Self { data: Data { equation, manifold, variables }, guess: vec![0.0; variables], tolerance })
    }

    /// Sets the guess from which ξ is completed at the first point of the manifold; the others follow from point to
    /// point.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`], [`CharacteristicsError::NotFinite`].
    pub fn near(mut self, guess: &[f64]) -> Result<Self, CharacteristicsError> {
        check_length("guess of ξ", self.data.variables, guess.len())?;
        check_finite("guess of ξ", guess)?;
        self.guess.copy_from_slice(guess);
        Ok(self)
    }

    /// Sets the local error of the integrations; by default it is 1e-13, relative.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The equation.
    #[must_use]
    pub const fn equation(&self) -> &'a P {
        self.data.equation
    }

    /// The number of variables m.
    #[must_use]
    pub const fn variables(&self) -> usize {
        self.data.variables
    }

    /// The point of the initial strip manifold at τ: ξ completed, strip conditions, transversality.
    ///
    /// ```text
    /// u_τ = ξ·x_τ,    Φ(x, u, ξ) = 0                                                    W(A.40)
    /// ```
    ///
    /// The m − 1 linear conditions leave ξ = ξ₀ + c n with n normal to the manifold; c is found by Newton's iteration
    /// on Φ from the guess. Where the manifold is tangent to a characteristic, Φ has a double zero in c, which is found
    /// to rounding as the zero of its derivative.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`], [`CharacteristicsError::NotFinite`], [`StripError::DependentParameters`],
    /// [`StripError::NoInitialCovector`]; [`StripError::NotAStrip`] for a given ξ.
    ///
    /// # Source
    /// W(A.21), W(A.32), W(A.40).
    pub fn initial_point(&self, tau: &[f64]) -> Result<InitialPoint, CharacteristicsError> {
        self.check_parameters(tau)?;
        self.data.point(tau, &self.guess)
    }

    /// All points of initial strip manifolds over x(τ), u(τ): every ξ = ξ₀ + c n with c in the search, in the order of
    /// c. Without one the list is empty.
    ///
    /// # Errors
    /// As [`initial_point`](Self::initial_point); [`CharacteristicsError::TooFewSamples`] for a search in no parts.
    pub fn initial_points(&self, tau: &[f64], search: Search) -> Result<Vec<InitialPoint>, CharacteristicsError> {
        self.check_parameters(tau)?;
        self.data.points(tau, search)
    }

    pub(super) fn check_parameters(&self, tau: &[f64]) -> Result<(), CharacteristicsError> {
        check_length("τ", self.data.variables - 1, tau.len())
    }

    /// The state of the ray at s = 0, where the manifold is transversal.
    pub(super) fn ray_start(
        &self,
        tau: &[f64],
        guess: &[f64],
    ) -> Result<(InitialPoint, Vec<f64>), CharacteristicsError> {
        let point = self.data.point(tau, guess)?;
        refuse_degenerate(&point)?;
        let m = self.data.variables;
        let mut start: Vec<f64> = point.x.iter().copied().chain([point.u]).chain(point.xi.iter().copied()).collect();
        for a in 0..m - 1 {
            start.extend_from_slice(&point.x_tau[a * m..(a + 1) * m]);
            start.push(point.u_tau[a]);
            start.extend_from_slice(&point.xi_tau[a * m..(a + 1) * m]);
        }
        if P::QUASILINEAR {
            without_covector(m, &mut start);
        }
        Ok((point, start))
    }

    /// The point s of the characteristic that leaves the manifold at τ, with the ray map and the residuals there.
    ///
    /// ```text
    /// x′ = Φ_ξ,    u′ = ξ·Φ_ξ,    ξ′ = −(ξ Φ_u + Φ_x)                                    W(A.38)
    /// ```
    ///
    /// # Errors
    /// As [`initial_point`](Self::initial_point); [`StripError::Characteristic`],
    /// [`StripError::Monge`] or [`StripError::Degenerate`] where the manifold is not transversal;
    /// [`CharacteristicsError::Run`].
    ///
    /// # Accuracy
    /// That of the [tolerance](Self::with_tolerance); `equation` and `gradient_residual` tell.
    pub fn characteristic(&self, tau: &[f64], s: f64) -> Result<RayPoint, CharacteristicsError> {
        self.check_parameters(tau)?;
        check_finite("s", &[s])?;
        let (_, start) = self.ray_start(tau, &self.guess)?;
        let mut marcher = Marcher::new(self.data.equation, self.data.variables, self.tolerance);
        let y = marcher.state_at(&start, s)?;
        Ok(self.ray_point(&mut marcher, tau, s, &y))
    }

    pub(super) fn ray_point(&self, marcher: &mut Marcher<'a, P>, tau: &[f64], s: f64, y: &[f64]) -> RayPoint {
        let (m, n) = (self.data.variables, 2 * self.data.variables + 1);
        let mut rate = vec![0.0; y.len()];
        let mut equation = marcher.field.rate_into(y, &mut rate);
        let mut jacobian = rate[..m].to_vec();
        let mut gradient = vec![rate[m]];
        for tangent in y[n..].chunks(n) {
            jacobian.extend_from_slice(&tangent[..m]);
            gradient.push(tangent[m]);
        }
        let mut matrix = vec![0.0; m * m];
        for (row, values) in jacobian.chunks(m).enumerate() {
            for (i, value) in values.iter().enumerate() {
                matrix[row + i * m] = *value;
            }
        }
        let mut xi = y[m + 1..n].to_vec();
        if P::QUASILINEAR {
            xi = marcher.field.covector(y);
            equation = self.data.equation.value(&y[..m], y[m], &xi);
        }
        let mut exchanges = vec![0; m];
        let solved = lu::factor_in_place(&mut matrix, &mut exchanges)
            .and_then(|()| lu::solve_in_place(&matrix, &exchanges, &mut gradient));
        let gradient_residual = if solved.is_ok() {
            let scale = norm(&xi);
            let difference: Vec<f64> = gradient.iter().zip(&xi).map(|(g, xi)| g - xi).collect();
            if 0.0 < scale { norm(&difference) / scale } else { norm(&difference) }
        } else {
            f64::INFINITY
        };
        RayPoint {
            parameters: tau.to_vec(),
            s,
            x: y[..m].to_vec(),
            u: y[m],
            xi,
            jacobian,
            determinant: marcher.field.determinant(y),
            equation,
            gradient_residual,
        }
    }

    /// The points of the caustic on the characteristic of τ for s between `from` ≤ 0 and 0 ≤ `to`, in the order of s.
    ///
    /// # Errors
    /// As [`characteristic`](Self::characteristic); [`CharacteristicsError::InvalidSpan`] unless `from` ≤ 0 ≤ `to`.
    ///
    /// # Accuracy
    /// s to that of the tolerance where the determinant crosses zero; where it touches zero, to its order on dense
    /// output.
    pub fn caustic_points(&self, tau: &[f64], from: f64, to: f64) -> Result<Vec<CausticPoint>, CharacteristicsError> {
        self.check_parameters(tau)?;
        check_span(from, to)?;
        let (_, start) = self.ray_start(tau, &self.guess)?;
        let mut marcher = Marcher::new(self.data.equation, self.data.variables, self.tolerance);
        let mut levels = vec![from, 0.0, to];
        levels.dedup_by(|a, b| (*a - *b).abs() <= 0.0);
        let mut caustic = marcher.ray(self.data.equation, (tau, &start), &levels)?.caustic;
        for point in &mut caustic {
            marcher.polish(&start, point)?;
        }
        Ok(caustic)
    }
}

/// from ≤ 0 ≤ to, both finite.
pub(super) fn check_span(from: f64, to: f64) -> Result<(), CharacteristicsError> {
    if from <= 0.0 && 0.0 <= to && from.is_finite() && to.is_finite() {
        Ok(())
    } else {
        Err(CharacteristicsError::InvalidSpan { from, to })
    }
}

/// Refuses points from which no characteristic leaves the manifold.
pub(super) fn refuse_degenerate(point: &InitialPoint) -> Result<(), CharacteristicsError> {
    let (parameters, transversality, residual) = (point.parameters.clone(), point.transversality, point.characteristic);
    match point.kind {
        StripKind::Transversal => Ok(()),
        StripKind::Characteristic => {
            Err(CharacteristicsError::Strip(StripError::Characteristic { parameters, transversality, residual }))
        }
        StripKind::Monge => {
            Err(CharacteristicsError::Strip(StripError::Monge { parameters, transversality, residual }))
        }
        kind @ (StripKind::Undetermined | StripKind::Stationary | StripKind::NoCovector | StripKind::Jump) => {
            Err(CharacteristicsError::Strip(StripError::Degenerate { parameters, transversality, kind }))
        }
    }
}
