//! Chains of pendulums in a vertical plane: by placement, by hand, and by the dual numbers of `num-dual`.

use nalgebra::{Const, SMatrix, SVector, U1, Vector3};
use num_dual::{Derivative, Dual2_64, DualSVec64};
use piola_kinematics::{Attitude, RigidBody};
use piola_lagrangian::{Holonomic, Placement};
use piola_numerics::Real;
use piola_numerics::linear::ldlt;

/// The crate `num-dual`, with the version that these benches ask for.
pub const NUM_DUAL: &str = "num-dual 0.15";
/// The strength of gravity in all benches of chains, m/s².
pub const GRAVITY: f64 = 9.80665;

/// N point masses, each hung on the one before by a rod; angles from the downward vertical.
///
/// `DECLARED` says that the placement depends on time, which it does not: for measuring what saying so costs.
#[derive(Clone, Copy, Debug)]
pub struct Chain<const N: usize, const DECLARED: bool = false> {
    /// Masses, kg.
    pub masses: [f64; N],
    /// Lengths of the rods, m.
    pub lengths: [f64; N],
}

impl<const N: usize, const DECLARED: bool> Chain<N, DECLARED> {
    /// A chain of different masses and lengths.
    #[must_use]
    pub fn varied() -> Self {
        let vary = |i: usize, by: f64| 1.0 - by * i as f64 / N as f64;
        Self { masses: core::array::from_fn(|i| vary(i, 0.4)), lengths: core::array::from_fn(|i| vary(i, 0.3)) }
    }
}

impl<const N: usize, const DECLARED: bool> Holonomic for Chain<N, DECLARED> {
    const TIME_DEPENDENT: bool = DECLARED;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (mut x, mut z) = (T::zero(), T::zero());
        for (&angle, (&mass, &length)) in q.iter().zip(self.masses.iter().zip(&self.lengths)) {
            let (sine, cosine) = angle.sin_cos();
            x += T::lit(length) * sine;
            z -= T::lit(length) * cosine;
            bodies.particle(mass, Vector3::new(x, T::zero(), z));
        }
    }
}

/// The same with a number of links that is known at run time only.
#[derive(Clone, Debug)]
pub struct Links {
    masses: Vec<f64>,
    lengths: Vec<f64>,
}

impl Links {
    /// A chain of `n` different masses and lengths.
    #[must_use]
    pub fn varied(n: usize) -> Self {
        let vary = |by: f64| (0..n).map(|i| 1.0 - by * i as f64 / n as f64).collect();
        Self { masses: vary(0.4), lengths: vary(0.3) }
    }

    /// The accelerations from the closed form, into `out`, with the memory of `work` and the factorisation that
    /// Piola uses.
    ///
    /// # Errors
    /// Never, in a chain of positive masses.
    pub fn acceleration_by_hand(
        &self,
        work: &mut LinksWork,
        q: &[f64],
        v: &[f64],
        out: &mut [f64],
    ) -> Result<(), piola_numerics::NumericsError> {
        let n = q.len();
        let LinksWork { sin_cos, below, metric } = work;
        sin_cos.clear();
        sin_cos.extend(q.iter().map(|q| q.sin_cos()));
        below.clear();
        below.extend_from_slice(&self.masses);
        for i in (1..n).rev() {
            below[i - 1] += below[i];
        }
        metric.resize(n * n, 0.0);
        out.fill(0.0);
        for i in 0..n {
            let (si, ci) = sin_cos[i];
            out[i] -= below[i] * GRAVITY * self.lengths[i] * si;
            let column = &mut metric[i * n..(i + 1) * n];
            column[i] = below[i] * self.lengths[i] * self.lengths[i];
            for j in i + 1..n {
                let weight = below[j] * self.lengths[i] * self.lengths[j];
                let (sj, cj) = sin_cos[j];
                column[j] = weight * (ci * cj + si * sj);
                let coupling = weight * (si * cj - ci * sj);
                out[i] -= coupling * v[j] * v[j];
                out[j] += coupling * v[i] * v[i];
            }
        }
        ldlt::factor_in_place(metric, n)?;
        ldlt::solve_in_place(metric, n, out)
    }
}

/// The memory of [`Links::acceleration_by_hand`].
#[derive(Clone, Debug, Default)]
pub struct LinksWork {
    sin_cos: Vec<(f64, f64)>,
    below: Vec<f64>,
    metric: Vec<f64>,
}

impl Holonomic for Links {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (mut x, mut z) = (T::zero(), T::zero());
        for (&angle, (&mass, &length)) in q.iter().zip(self.masses.iter().zip(&self.lengths)) {
            let (sine, cosine) = angle.sin_cos();
            x += T::lit(length) * sine;
            z -= T::lit(length) * cosine;
            bodies.particle(mass, Vector3::new(x, T::zero(), z));
        }
    }
}

/// A metric and generalised forces.
#[derive(Clone, Copy, Debug)]
pub struct Equations<const N: usize> {
    /// Its lower triangle.
    pub metric: SMatrix<f64, N, N>,
    /// The forces.
    pub force: SVector<f64, N>,
}

impl<const N: usize> Equations<N> {
    /// Nothing yet.
    #[must_use]
    pub fn zero() -> Self {
        Self { metric: SMatrix::zeros(), force: SVector::zeros() }
    }

    /// Solves with L D Lᵀ; only the lower triangle of the metric is used.
    #[inline]
    #[must_use]
    pub fn solve(self) -> SVector<f64, N> {
        let Self { metric: mut a, force: mut b } = self;
        for j in 0..N {
            let inverse = 1.0 / a[(j, j)];
            for i in j + 1..N {
                let factor = a[(i, j)] * inverse;
                for k in i..N {
                    let x = a[(k, j)];
                    a[(k, i)] -= factor * x;
                }
            }
            for i in j + 1..N {
                a[(i, j)] *= inverse;
                let x = b[j];
                b[i] -= a[(i, j)] * x;
            }
        }
        for j in (0..N).rev() {
            b[j] /= a[(j, j)];
            for i in j + 1..N {
                let x = b[i];
                b[j] -= a[(i, j)] * x;
            }
        }
        b
    }
}

impl<const N: usize> Chain<N> {
    /// The accelerations from the closed form of the chain's metric and forces, solved without pivoting.
    #[inline]
    #[must_use]
    pub fn acceleration_by_hand(&self, q: &[f64; N], v: &[f64; N]) -> SVector<f64, N> {
        let sin_cos: [(f64, f64); N] = q.map(f64::sin_cos);
        let mut below = self.masses;
        for i in (1..N).rev() {
            below[i - 1] += below[i];
        }
        let mut equations = Equations::zero();
        for i in 0..N {
            let (si, ci) = sin_cos[i];
            equations.force[i] -= below[i] * GRAVITY * self.lengths[i] * si;
            equations.metric[(i, i)] = below[i] * self.lengths[i] * self.lengths[i];
            for j in i + 1..N {
                let weight = below[j] * self.lengths[i] * self.lengths[j];
                let (sj, cj) = sin_cos[j];
                equations.metric[(j, i)] = weight * (ci * cj + si * sj);
                let coupling = weight * (si * cj - ci * sj);
                equations.force[i] -= coupling * v[j] * v[j];
                equations.force[j] += coupling * v[i] * v[i];
            }
        }
        equations.solve()
    }

    /// The accelerations from the placement by the dual numbers of `num-dual`: one pass for the directions,
    /// one for the second derivative along the motion.
    #[inline]
    #[must_use]
    pub fn acceleration_by_num_dual(&self, q: &[f64; N], v: &[f64; N]) -> SVector<f64, N> {
        let moving: [Dual2_64; N] = core::array::from_fn(|i| Dual2_64::new(q[i], v[i], 0.0));
        let mut along = Along { accelerations: [[0.0; 3]; N], next: 0 };
        self.place(&moving, Dual2_64::from(0.0), &mut along);
        let directions: [DualSVec64<N>; N] =
            core::array::from_fn(|i| DualSVec64::new(q[i], Derivative::derivative_generic(Const::<N>, U1, i)));
        let mut across = Across { equations: Equations::zero(), accelerations: along.accelerations, next: 0 };
        self.place(&directions, DualSVec64::from(0.0), &mut across);
        across.equations.solve()
    }
}

/// Collects what gravity and inertia at q̈ = 0 leave for each particle.
struct Along<const N: usize> {
    accelerations: [[f64; 3]; N],
    next: usize,
}

impl<const N: usize> Placement<Dual2_64> for Along<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn particle(&mut self, _mass: f64, x: Vector3<Dual2_64>) {
        self.accelerations[self.next] = [-x.x.v2, -x.y.v2, -GRAVITY - x.z.v2];
        self.next += 1;
    }
    fn body(&mut self, _body: &RigidBody, _centre: Vector3<Dual2_64>, _attitude: Attitude<Dual2_64>) {}
}

/// Collects the metric and the forces.
struct Across<const N: usize> {
    equations: Equations<N>,
    accelerations: [[f64; 3]; N],
    next: usize,
}

impl<const N: usize> Placement<DualSVec64<N>> for Across<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn particle(&mut self, mass: f64, x: Vector3<DualSVec64<N>>) {
        let acceleration = self.accelerations[self.next];
        self.next += 1;
        for (x, acceleration) in x.iter().zip(acceleration) {
            let Some(partials) = x.eps.0 else { continue };
            for i in 0..N {
                let weighted = mass * partials[i];
                self.equations.force[i] += weighted * acceleration;
                for j in i..N {
                    self.equations.metric[(j, i)] += weighted * partials[j];
                }
            }
        }
    }
    fn body(&mut self, _body: &RigidBody, _centre: Vector3<DualSVec64<N>>, _attitude: Attitude<DualSVec64<N>>) {}
}

#[cfg(test)]
mod tests {
    use piola_lagrangian::Lagrangian;

    use super::{Chain, GRAVITY};

    #[test]
    fn a_chain_three_ways_is_one() -> Result<(), piola_lagrangian::LagrangianError> {
        let chain = Chain::<4>::varied();
        let (q, v) = ([0.3, -1.2, 2.0, 0.7], [1.0, -0.5, 0.25, 2.0]);
        let by_hand = chain.acceleration_by_hand(&q, &v);
        let by_num_dual = chain.acceleration_by_num_dual(&q, &v);
        let by_placement = Lagrangian::of(chain).with_gravity(GRAVITY).acceleration(&q, &v, 0.0)?;
        // A condition number below 100 and a few dozen operations.
        let bound = 1e-13 * by_hand.amax();
        for i in 0..4 {
            assert!((by_num_dual[i] - by_hand[i]).abs() < bound);
            assert!((by_placement[i] - by_hand[i]).abs() < bound);
        }
        Ok(())
    }
}
