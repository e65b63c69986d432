//! Wave fronts: the levels of a solution of H(q, ∂S/∂q) = E, carried along its transversals.
//!
//! ```text
//! S(q) = c,   dq/dS = H_p/(p·H_p),   dp/dS = −H_q/(p·H_p)                                  W(13.26–13.28)
//! ```
//!
//! H must not depend on time; for others see [`Transversals::level_point`](super::Transversals::level_point). The manifolds U = S(q) − E t = const move over these fronts, and the transversals of
//! W(13.13) are their rays with λ = 1. Of waves of the speed v(q), H = v |p| and E = 1,
//! the action is the time of travel.
//!
//! Fronts are polylines in the plane and triangle meshes in space, over the parameters of the curve or surface from
//! which they start. Behind a caustic they fold over and are kept with all their sheets; what has arrived first can be
//! cut out of them.

mod first_arrival;
mod huygens;
mod initial;
mod mesh_arrival;
mod ray;
mod refine;
mod step;

pub use first_arrival::ArrivedPiece;
pub use initial::InitialFront;
pub use ray::FrontRay;

use self::ray::advance_all;
use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::check::check_finite;

/// How the points of a front belong together.
///
/// # Example
/// See [`WaveFront`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mesh {
    /// Each point with the next.
    Polyline {
        /// And the last with the first, one period of the parameter later.
        period: Option<f64>,
    },
    /// Three points each.
    Triangles(Vec<[usize; 3]>),
}

/// What a front met on its way.
///
/// # Example
/// See [`WaveFront`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrontReport {
    /// The largest difference between the results of order six and four in one step, over the largest coordinate: a
    /// bound of the error of a step.
    pub error: f64,
    /// The number of rays that touched a caustic.
    pub caustics: usize,
}

/// A wave front with its rays, in the plane (N = 2, M = 1) or in space (N = 3, M = 2).
///
/// Rays are advanced in lanes, and with feature `rayon` on all cores; the result does not depend on their number nor on
/// the width of the lanes. No step
/// allocates (the first 256 changes of its length have room); [`refine`](Self::refine) does.
///
/// # Accuracy
/// Order six in the step of the action, as measured by [`FrontReport::error`].
///
/// # Example
/// A circle of radius 1 in an even medium, moving inwards through its focus:
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{InitialFront, WaveFront};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Even; // H = |p|
/// impl PhaseFunction for Even {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         (p[0] * p[0] + p[1] * p[1]).sqrt()
///     }
/// }
/// struct Circle;
/// impl InitialFront<2, 1> for Circle {
///     fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
///         [a.cos(), a.sin()]
///     }
/// }
/// let turn = std::f64::consts::TAU;
/// let mut front = WaveFront::closed(&Even, &Circle, -1.0, 1.0, (0.0, turn), 16)?; // against the normal
/// front.advance(0.75, 3)?;
/// let [x, y] = front.rays()[0].coordinates();
/// assert!((x - 0.25).abs() < 1e-14 && y.abs() < 1e-14);
/// assert_eq!(front.advance(0.75, 3)?.caustics, 16);
/// assert!((front.rays()[0].coordinates()[0] + 0.5).abs() < 1e-14);
/// // Everywhere there the front has been before.
/// assert!(front.first_arrival().is_empty());
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(13.26–13.28).
#[derive(Clone, Debug)]
pub struct WaveFront<'a, H, C, const N: usize, const M: usize> {
    hamiltonian: &'a H,
    initial: &'a C,
    side: f64,
    energy: f64,
    level: f64,
    /// The steps made, and how many of each.
    steps: Vec<(f64, usize)>,
    rays: Vec<FrontRay<N, M>>,
    next: Vec<FrontRay<N, M>>,
    mesh: Mesh,
}

impl<'a, H: PhaseFunction + Sync, C: InitialFront<N, M> + Sync, const N: usize, const M: usize>
    WaveFront<'a, H, C, N, M>
{
    fn new(
        (hamiltonian, initial): (&'a H, &'a C),
        (side, energy): (f64, f64),
        parameters: impl Iterator<Item = [f64; M]>,
        mesh: Mesh,
    ) -> Result<Self, HamiltonianError> {
        check_finite("E", &[energy])?;
        let side = 1.0_f64.copysign(side);
        let source = (hamiltonian, initial, (side, energy));
        let rays = parameters.map(|at| FrontRay::start(source, at)).collect::<Result<Vec<_>, _>>()?;
        let next = rays.clone();
        let steps = Vec::with_capacity(ROOM);
        Ok(Self { hamiltonian, initial, side, energy, level: 0.0, steps, rays, next, mesh })
    }

    /// The rays, in the order of the mesh.
    #[must_use]
    pub fn rays(&self) -> &[FrontRay<N, M>] {
        &self.rays
    }
    /// How the rays belong together.
    #[must_use]
    pub const fn mesh(&self) -> &Mesh {
        &self.mesh
    }
    /// The action S since the start, J s.
    #[must_use]
    pub const fn level(&self) -> f64 {
        self.level
    }
    /// E.
    #[must_use]
    pub const fn energy(&self) -> f64 {
        self.energy
    }

    /// Where the front touches its caustic now: the pairs of neighbouring rays of which one has touched more caustics than
    /// the other. In the plane they lie on either side of the cusps of the front, in space along its edges of regression.
    ///
    /// # Example
    /// ```
    /// # use piola_hamiltonian::hamilton_jacobi::{InitialFront, WaveFront};
    /// # use piola_hamiltonian::PhaseFunction;
    /// # use piola_numerics::Real;
    /// # struct Even; // H = |p|
    /// # impl PhaseFunction for Even {
    /// #     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
    /// #         (p[0] * p[0] + p[1] * p[1]).sqrt()
    /// #     }
    /// # }
    /// struct Parabola; // y = x²/2
    /// impl InitialFront<2, 1> for Parabola {
    ///     fn at<T: Real>(&self, [x]: [T; 1]) -> [T; 2] {
    ///         [x, T::lit(0.5) * x * x]
    ///     }
    /// }
    /// let mut front = WaveFront::open(&Even, &Parabola, -1.0, 1.0, (-1.0, 1.0), 21)?;
    /// // A ray touches the caustic after the radius of curvature (1 + x²)^(3/2) at its start: x = ±0.361 for 1.2.
    /// front.advance(1.2, 12)?;
    /// assert_eq!(front.caustic_edges(), [(6, 7), (13, 14)]); // −0.4 … −0.3 and 0.3 … 0.4
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    #[must_use]
    pub fn caustic_edges(&self) -> Vec<(usize, usize)> {
        let count = self.rays.len();
        let mut edges: Vec<(usize, usize)> = match &self.mesh {
            Mesh::Polyline { period } => {
                let last = if period.is_some() { count } else { count.saturating_sub(1) };
                (0..last).map(|i| (i, (i + 1) % count)).collect()
            }
            Mesh::Triangles(triangles) => {
                let edge = |a: usize, b: usize| (a.min(b), a.max(b));
                let of = |&[a, b, c]: &[usize; 3]| [edge(a, b), edge(b, c), edge(c, a)];
                let mut all: Vec<_> = triangles.iter().flat_map(of).collect();
                all.sort_unstable();
                all.dedup();
                all
            }
        };
        edges.retain(|&(i, j)| self.rays[i].caustics() != self.rays[j].caustics());
        edges
    }

    /// Advances the front by an action ΔS (backwards if negative) in so many equal steps, at least one.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`] with the number of a ray that cannot go on, as one that runs along a singularity
    /// of H; the front then stays where it was.
    pub fn advance(&mut self, action: f64, steps: usize) -> Result<FrontReport, HamiltonianError> {
        check_finite("ΔS", &[action])?;
        let steps = steps.max(1);
        let step = action / steps as f64;
        let Self { hamiltonian, rays, next, .. } = &mut *self;
        let some = |(next, rays): (&mut [FrontRay<N, M>], &[FrontRay<N, M>])| {
            next.copy_from_slice(rays);
            advance_all(*hamiltonian, next, step, steps);
        };
        #[cfg(feature = "rayon")]
        {
            use rayon::prelude::*;
            next.par_chunks_mut(RAYS_TOGETHER).zip(rays.par_chunks(RAYS_TOGETHER)).for_each(some);
        }
        #[cfg(not(feature = "rayon"))]
        next.chunks_mut(RAYS_TOGETHER).zip(rays.chunks(RAYS_TOGETHER)).for_each(some);
        let mut report = FrontReport { error: 0.0, caustics: 0 };
        let mut size = 0.0_f64;
        for (index, (next, ray)) in next.iter().zip(&*rays).enumerate() {
            if let Some(value) = next.first_non_finite() {
                return Err(HamiltonianError::NotFinite { quantity: "rays of the front", index, value });
            }
            report.error = report.error.max(next.error());
            report.caustics += usize::from(ray.caustics() < next.caustics());
            size = next.coordinates().iter().fold(size, |m, q| m.max(q.abs()));
        }
        report.error = if 0.0 < size { report.error / size } else { report.error };
        core::mem::swap(&mut self.rays, &mut self.next);
        self.level += action;
        match self.steps.last_mut() {
            Some((last, count)) if last.to_bits() == step.to_bits() => *count += steps,
            _ => self.steps.push((step, steps)),
        }
        Ok(report)
    }
}

/// Changes of the step that need no new memory.
const ROOM: usize = 256;

/// Rays that one core takes at a time; a multiple of all numbers of lanes.
const RAYS_TOGETHER: usize = 128;

impl<'a, H: PhaseFunction + Sync, C: InitialFront<2, 1> + Sync> WaveFront<'a, H, C, 2, 1> {
    /// A front from an open curve over a range of its parameter, with `count` rays, at least two.
    ///
    /// `side` is positive for rays along the [normal](InitialFront::normal) and negative for rays against it.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::NotFound`](crate::HamiltonJacobiError::NotFound) where no momentum along the normal has the energy.
    pub fn open(
        hamiltonian: &'a H,
        curve: &'a C,
        side: f64,
        energy: f64,
        (from, to): (f64, f64),
        count: usize,
    ) -> Result<Self, HamiltonianError> {
        let count = count.max(2);
        let at = (0..count).map(|i| [from + (to - from) * i as f64 / (count - 1) as f64]);
        Self::new((hamiltonian, curve), (side, energy), at, Mesh::Polyline { period: None })
    }

    /// A front from a closed curve whose parameter runs through one period.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn closed(
        hamiltonian: &'a H,
        curve: &'a C,
        side: f64,
        energy: f64,
        (from, to): (f64, f64),
        count: usize,
    ) -> Result<Self, HamiltonianError> {
        let count = count.max(3);
        let at = (0..count).map(|i| [from + (to - from) * i as f64 / count as f64]);
        Self::new((hamiltonian, curve), (side, energy), at, Mesh::Polyline { period: Some(to - from) })
    }
}

impl<'a, H: PhaseFunction + Sync, C: InitialFront<3, 2> + Sync> WaveFront<'a, H, C, 3, 2> {
    /// A front from a surface over a rectangle of its parameters, with so many rays along each side, at least two.
    ///
    /// `side` is positive for rays along the [normal](InitialFront::normal) and negative for rays against it.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::NotFound`](crate::HamiltonJacobiError::NotFound) where no momentum along the normal has the energy.
    pub fn surface(
        hamiltonian: &'a H,
        surface: &'a C,
        (side, energy): (f64, f64),
        ranges: [(f64, f64); 2],
        counts: [usize; 2],
    ) -> Result<Self, HamiltonianError> {
        let [m, n] = counts.map(|count| count.max(2));
        let place = |k: usize, i: usize, count: usize| {
            let (from, to) = ranges[k];
            from + (to - from) * i as f64 / (count - 1) as f64
        };
        let at = (0..m * n).map(|i| [place(0, i % m, m), place(1, i / m, n)]);
        let corners = (0..n - 1).flat_map(|j| (0..m - 1).map(move |i| i + j * m));
        let triangles = corners.flat_map(|c| [[c, c + 1, c + m + 1], [c, c + m + 1, c + m]]).collect();
        Self::new((hamiltonian, surface), (side, energy), at, Mesh::Triangles(triangles))
    }
}
