//! The inertia metric and its Christoffel symbols.

use nalgebra::DMatrix;
use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt;
use piola_numerics::{Dual, Gradient, Real};

use super::collect::Metric;
use super::directions::with_directions;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::check_length;

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The inertia metric g.
    ///
    /// ```text
    /// g_ΔΓ = Σ m ∂x/∂q^Δ·∂x/∂q^Γ + Σ M ∂ξ/∂q^Δ·∂ξ/∂q^Γ + Σ ω_Δ·I ω_Γ
    /// ```
    ///
    /// It is symmetric and positive semidefinite, and definite where the coordinates are independent. The
    /// unit of an entry is kg m² over the units of its two coordinates.
    ///
    /// # Errors
    /// [`LagrangianError::NoParts`] where a system has none, as one
    /// [given by its Lagrangian function](Lagrangian::from_function): its mass matrix is that of
    /// [`equations_into`](Self::equations_into).
    ///
    /// # Accuracy
    /// A few ulp of √(g_ΔΔ g_ΓΓ).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// struct Polar; // q = [r, φ], mass 4
    /// impl Holonomic for Polar {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[1].sin_cos();
    ///         bodies.particle(4.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// let (polar, q) = (Lagrangian::of(Polar), [2.0, 0.0]);
    /// let g = polar.inertia_metric(&q, 0.0)?;
    /// assert_eq!((g[(0, 0)], g[(1, 1)], g[(0, 1)]), (4.0, 16.0, 0.0)); // m dr² + m r² dφ²
    /// let (first, second) = (polar.christoffel_first(&q, 0.0)?, polar.christoffel_second(&q, 0.0)?);
    /// assert_eq!((first[0][(1, 1)], first[1][(0, 1)]), (-8.0, 8.0)); // [φφ,r] = −m r and [rφ,φ] = m r
    /// assert_eq!((second[0][(1, 1)], second[1][(0, 1)]), (-2.0, 0.5)); // Γ^r_φφ = −r and Γ^φ_rφ = 1/r
    /// // Once around with 3 rad/s: r̈ − r φ̇² = −18 m/s²; and a moment of 32 N m turns with 2 rad/s².
    /// assert_eq!(polar.covariant_acceleration(&q, &[0.0, 3.0], &[0.0, 0.0], 0.0)?.as_slice(), [-18.0, 0.0]);
    /// assert_eq!(polar.raise(&q, &[8.0, 32.0], 0.0)?.as_slice(), [2.0, 2.0]);
    /// assert_eq!(polar.lower(&q, &[2.0, 2.0], 0.0)?.as_slice(), [8.0, 32.0]);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(3.16).
    pub fn inertia_metric<T: Real>(&self, q: &[T], t: T) -> Result<DMatrix<T>, LagrangianError> {
        let mut work = Workspace::default();
        self.form_inertia_metric(&mut work, q, t);
        self.refuse_without_parts(q, t, &work.metric)?;
        Ok(DMatrix::from_column_slice(q.len(), q.len(), &work.metric))
    }

    /// [`inertia_metric`](Self::inertia_metric) to the caller's memory, entry (i, j) at `i + j n`, without
    /// allocation once `work` has been used.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`]; those of [`inertia_metric`](Self::inertia_metric).
    pub fn inertia_metric_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("metric", q.len() * q.len(), out.len())?;
        self.form_inertia_metric(work, q, t);
        self.refuse_without_parts(q, t, &work.metric)?;
        out.copy_from_slice(&work.metric);
        Ok(())
    }

    /// Refuses a metric that is zero because there is nothing that has inertia.
    pub(super) fn refuse_without_parts<T: Real>(&self, q: &[T], t: T, metric: &[T]) -> Result<(), LagrangianError> {
        let nothing = !q.is_empty() && metric.iter().all(T::is_zero) && self.parts(q, t) == 0;
        if nothing { Err(LagrangianError::NoParts) } else { Ok(()) }
    }

    /// Leaves the metric in `work.metric`.
    pub(super) fn form_inertia_metric<T: Real>(&self, work: &mut Workspace<T>, q: &[T], t: T) {
        with_directions!(q.len(), N => self.form_inertia_metric_in_one_pass::<T, N>(work, q, t), beyond => {
            work.rows.clear();
            self.collect_rows_from(work, q, t, 0);
            work.form_metric(q.len());
            work.complete_metric(q.len());
        });
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn form_inertia_metric_in_one_pass<T: Real, const N: usize>(&self, work: &mut Workspace<T>, q: &[T], t: T) {
        let n = q.len();
        let mut coordinates = [Gradient::<T, N>::constant(T::zero()); N];
        for (i, (coordinate, &q)) in coordinates.iter_mut().zip(q).enumerate() {
            *coordinate = Gradient::variable(q, i);
        }
        let mut metric = Metric([[T::zero(); N]; N]);
        self.system.place(&coordinates[..n], Gradient::constant(t), &mut metric);
        for j in 0..N {
            for i in 0..j {
                metric.0[j][i] = metric.0[i][j];
            }
        }
        work.metric.clear();
        for column in metric.0.iter().take(n) {
            work.metric.extend_from_slice(&column[..n]);
        }
    }

    /// The Christoffel symbols of the first kind, entry [ΔΘ, Σ] at `[Σ](Δ, Θ)`.
    ///
    /// ```text
    /// [ΔΘ,Σ] = ½ (∂g_ΘΣ/∂q^Δ + ∂g_ΔΣ/∂q^Θ − ∂g_ΔΘ/∂q^Σ)
    /// ```
    ///
    /// # Errors
    /// Those of [`inertia_metric`](Self::inertia_metric).
    ///
    /// # Accuracy
    /// The metric is differentiated exactly: a few ulp of the largest of the three terms.
    ///
    /// # Source
    /// W(6.5).
    pub fn christoffel_first<T: Real>(&self, q: &[T], t: T) -> Result<Vec<DMatrix<T>>, LagrangianError> {
        let n = q.len();
        let mut work = Workspace::<Dual<T>>::default();
        let mut coordinates: Vec<Dual<T>> = q.iter().map(|&q| Dual::constant(q)).collect();
        let mut rates = Vec::with_capacity(n);
        for i in 0..n {
            coordinates[i] = Dual::variable(q[i]);
            self.form_inertia_metric(&mut work, &coordinates, Dual::constant(t));
            coordinates[i] = Dual::constant(q[i]);
            self.refuse_without_parts(&coordinates, Dual::constant(t), &work.metric)?;
            rates.push(DMatrix::from_fn(n, n, |row, column| work.metric[row + column * n].tangent));
        }
        let half = T::lit(0.5);
        let symbol = |s: usize, a: usize, b: usize| half * (rates[a][(b, s)] + rates[b][(a, s)] - rates[s][(a, b)]);
        Ok((0..n).map(|s| DMatrix::from_fn(n, n, |a, b| symbol(s, a, b))).collect())
    }

    /// The Christoffel symbols of the second kind, entry Γ^Γ_ΔΘ at `[Γ](Δ, Θ)`.
    ///
    /// ```text
    /// Γ^Γ_ΔΘ = g^ΓΣ [ΔΘ,Σ]
    /// ```
    ///
    /// # Errors
    /// [`LagrangianError::Numerics`] when the metric is singular; those of [`inertia_metric`](Self::inertia_metric).
    ///
    /// # Accuracy
    /// A few ulp times the condition number of the metric.
    ///
    /// # Source
    /// W(6.6).
    pub fn christoffel_second<T: Real>(&self, q: &[T], t: T) -> Result<Vec<DMatrix<T>>, LagrangianError> {
        let n = q.len();
        let first = self.christoffel_first(q, t)?;
        let factors = ldlt::Ldlt::new(&self.inertia_metric(q, t)?)?;
        let mut second = vec![DMatrix::from_element(n, n, T::zero()); n];
        let mut column = vec![T::zero(); n];
        for a in 0..n {
            for b in 0..n {
                for (entry, first) in column.iter_mut().zip(&first) {
                    *entry = first[(a, b)];
                }
                factors.solve_in_place(&mut column)?;
                for (second, &entry) in second.iter_mut().zip(&column) {
                    second[(a, b)] = entry;
                }
            }
        }
        Ok(second)
    }
}
