//! New rays where a front spreads.

use std::collections::BTreeMap;

use super::ray::advance_all;
use super::{FrontRay, InitialFront, Mesh, RAYS_TOGETHER, WaveFront};
use crate::PhaseFunction;
use crate::{HamiltonJacobiError, HamiltonianError};

/// Halvings of one interval of parameters in one call.
const MOST_ROUNDS: usize = 24;

fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

impl<H: PhaseFunction + Sync, C: InitialFront<N, M> + Sync, const N: usize, const M: usize> WaveFront<'_, H, C, N, M> {
    /// Inserts rays until no two neighbours are farther from each other than `longest`, and returns how many.
    ///
    /// A new ray starts from the initial curve or surface, half-way between its neighbours, and makes all the steps
    /// that they have made: it is as exact as they are, and knows the caustics it has touched. Edges of triangles are
    /// halved together, so that meshes stay without gaps.
    ///
    /// # Errors
    /// [`HamiltonJacobiError::InvalidLength`] unless 0 < longest < ∞; those of the start of a front and of
    /// [`advance`](Self::advance). The front then stays as it was.
    pub fn refine(&mut self, longest: f64) -> Result<usize, HamiltonianError> {
        if !(0.0 < longest && longest < f64::INFINITY) {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::InvalidLength {
                quantity: "longest edge of a front",
                value: longest,
            }));
        }
        let (mut rays, mut mesh) = (self.rays.clone(), self.mesh.clone());
        for _ in 0..MOST_ROUNDS {
            let inserted = match &mut mesh {
                Mesh::Polyline { period } => self.refine_polyline(&mut rays, *period, longest)?,
                Mesh::Triangles(triangles) => self.refine_triangles(&mut rays, triangles, longest)?,
            };
            if inserted == 0 {
                break;
            }
        }
        let inserted = rays.len() - self.rays.len();
        self.next = rays.clone();
        (self.rays, self.mesh) = (rays, mesh);
        Ok(inserted)
    }

    /// Rays from the start to here.
    fn late(&self, parameters: &[[f64; M]]) -> Result<Vec<FrontRay<N, M>>, HamiltonianError> {
        let source = (self.hamiltonian, self.initial, (self.side, self.energy));
        let some = |parameters: &[[f64; M]]| -> Result<Vec<FrontRay<N, M>>, HamiltonianError> {
            let start = |&at: &[f64; M]| FrontRay::start(source, at);
            let mut rays = parameters.iter().map(start).collect::<Result<Vec<_>, _>>()?;
            for &(step, steps) in &self.steps {
                advance_all(self.hamiltonian, &mut rays, step, steps);
            }
            Ok(rays)
        };
        #[cfg(feature = "rayon")]
        let chunks: Vec<_> = {
            use rayon::prelude::*;
            parameters.par_chunks(RAYS_TOGETHER).map(some).collect::<Result<_, _>>()?
        };
        #[cfg(not(feature = "rayon"))]
        let chunks: Vec<_> = parameters.chunks(RAYS_TOGETHER).map(some).collect::<Result<_, _>>()?;
        let rays = chunks.concat();
        for (index, ray) in rays.iter().enumerate() {
            if let Some(value) = ray.first_non_finite() {
                return Err(HamiltonianError::NotFinite { quantity: "rays inserted into the front", index, value });
            }
        }
        Ok(rays)
    }

    fn refine_polyline(
        &self,
        rays: &mut Vec<FrontRay<N, M>>,
        period: Option<f64>,
        longest: f64,
    ) -> Result<usize, HamiltonianError> {
        let count = rays.len();
        let last = if period.is_some() { count } else { count.saturating_sub(1) };
        let (mut behind, mut parameters) = (Vec::new(), Vec::new());
        for i in 0..last {
            let (a, b) = (&rays[i], &rays[(i + 1) % count]);
            if longest < distance(a.coordinates(), b.coordinates()) {
                let wrapped = if i + 1 == count { period.unwrap_or(0.0) } else { 0.0 };
                let mut middle = a.parameters();
                for (middle, b) in middle.iter_mut().zip(b.parameters()) {
                    *middle = 0.5 * (*middle + b + wrapped);
                }
                behind.push(i);
                parameters.push(middle);
            }
        }
        let new = self.late(&parameters)?;
        let inserted = new.len();
        let mut new = behind.into_iter().zip(new).peekable();
        let mut refined = Vec::with_capacity(count + inserted);
        for (i, ray) in rays.iter().enumerate() {
            refined.push(*ray);
            if let Some((_, new)) = new.next_if(|(behind, _)| *behind == i) {
                refined.push(new);
            }
        }
        *rays = refined;
        Ok(inserted)
    }

    fn refine_triangles(
        &self,
        rays: &mut Vec<FrontRay<N, M>>,
        triangles: &mut Vec<[usize; 3]>,
        longest: f64,
    ) -> Result<usize, HamiltonianError> {
        let mut halved = BTreeMap::<(usize, usize), usize>::new();
        let mut parameters = Vec::new();
        let edge = |a: usize, b: usize| (a.min(b), a.max(b));
        for &[a, b, c] in &*triangles {
            for (i, j) in [edge(a, b), edge(b, c), edge(c, a)] {
                if longest < distance(rays[i].coordinates(), rays[j].coordinates()) && !halved.contains_key(&(i, j)) {
                    halved.insert((i, j), rays.len() + parameters.len());
                    let mut middle = rays[i].parameters();
                    for (middle, other) in middle.iter_mut().zip(rays[j].parameters()) {
                        *middle = 0.5 * (*middle + other);
                    }
                    parameters.push(middle);
                }
            }
        }
        rays.extend(self.late(&parameters)?);
        let mut refined = Vec::with_capacity(triangles.len() + 2 * parameters.len());
        for &[a, b, c] in &*triangles {
            let half = |a: usize, b: usize| halved.get(&edge(a, b)).copied();
            // Turned so that the cases are few: with one halved edge it is ab, with two ab and bc.
            let turns = [[a, b, c], [b, c, a], [c, a, b]];
            let cut = |[a, b, c]: [usize; 3]| (half(a, b), half(b, c), half(c, a));
            match (half(a, b), half(b, c), half(c, a)) {
                (None, None, None) => refined.push([a, b, c]),
                (Some(x), Some(y), Some(z)) => refined.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]),
                _ => {
                    for turn in turns {
                        let [a, b, c] = turn;
                        match cut(turn) {
                            (Some(x), None, None) => refined.extend([[a, x, c], [x, b, c]]),
                            (Some(x), Some(y), None) => refined.extend([[x, b, y], [a, x, y], [a, y, c]]),
                            _ => {}
                        }
                    }
                }
            }
        }
        *triangles = refined;
        Ok(parameters.len())
    }
}
