//! The first loss of invertibility of the ray map (s, τ) ↦ x.
//!
//! ```text
//! D(s, τ) = det ∂x/∂(s, τ) = 0 at s = s*(τ),    ∂s*/∂τ = −D_τ/D_s = 0 where s* is least
//! ```

use piola_integrators::DormandPrince853;
use piola_numerics::Dual;

use super::ray::{Marcher, Ray, march};
use super::roots::zero_between;
use super::{CausticPoint, CharacteristicSolution, FirstOrderPde, InitialManifold, RayField};
use crate::CharacteristicsError;

/// The point where the ray map first loses its rank: there the solution ceases to be twice differentiable.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FirstLoss {
    /// Where, and on which characteristic.
    pub point: CausticPoint,
    /// ∂s*/∂τ there: zero, unless at an edge of the intervals or where all rays focus in one place.
    pub slope: Vec<f64>,
    /// Whether τ stands at an end of its interval, beyond which the loss may be earlier.
    pub at_edge: bool,
}

impl<P: FirstOrderPde + Sync, M: InitialManifold + Sync> CharacteristicSolution<'_, P, M> {
    /// The smallest 0 < s at which (s, τ) ↦ x loses its rank on some characteristic of the intervals; `None` when it
    /// does not before the end of the span.
    ///
    /// The characteristic is found, and not chosen among those computed: on a curve (m = 2) by bisection of the exact
    /// ∂s*/∂τ, for more parameters by descent along it.
    ///
    /// # Errors
    /// As [`CauchyProblem::characteristic`](super::CauchyProblem::characteristic).
    ///
    /// # Accuracy
    /// s to that of the tolerance; τ to the tolerance over ∂²s*/∂τ².
    pub fn first_loss_of_invertibility(&self) -> Result<Option<FirstLoss>, CharacteristicsError> {
        self.first_loss(1.0)
    }

    /// The largest s < 0 at which (s, τ) ↦ x loses its rank, as
    /// [`first_loss_of_invertibility`](Self::first_loss_of_invertibility).
    ///
    /// # Errors
    /// As there.
    pub fn first_loss_of_invertibility_backwards(&self) -> Result<Option<FirstLoss>, CharacteristicsError> {
        self.first_loss(-1.0)
    }

    fn first_loss(&self, sign: f64) -> Result<Option<FirstLoss>, CharacteristicsError> {
        let of_ray = |ray: usize| {
            let points = self.rays[ray].caustic.iter().filter(|point| 0.0 < sign * point.s);
            points.min_by(|a, b| (sign * a.s).total_cmp(&(sign * b.s)))
        };
        let hidden = self.hidden_between(sign)?;
        let seen = (0..self.rays.len()).filter_map(|ray| of_ray(ray).map(|point| (ray, point)));
        let all = seen.chain(hidden.iter().map(|(ray, point)| (*ray, point)));
        let best = all.min_by(|(_, a), (_, b)| (sign * a.s).total_cmp(&(sign * b.s)));
        let Some((ray, point)) = best else { return Ok(None) };
        let mut search = Descent::new(self, ray);
        let mut loss = search.at(&point.parameters.clone(), point)?;
        if !point.touching {
            if let [interval] = self.intervals[..] {
                // The neighbours of the least one enclose the least of all.
                let (mut low, mut high) = (interval.from, interval.to);
                for other in &self.rays {
                    let tau = other.parameters[0];
                    if tau < point.parameters[0] {
                        low = low.max(tau);
                    } else if point.parameters[0] < tau {
                        high = high.min(tau);
                    }
                }
                search.bisect(&mut loss, (low, high), sign)?;
            } else {
                search.descend(&mut loss, sign)?;
            }
        }
        let at_end = |(tau, interval): (&f64, &super::ParameterInterval)| {
            let width = 1e-9 * (interval.to - interval.from);
            (tau - interval.from).abs() <= width || (tau - interval.to).abs() <= width
        };
        loss.at_edge = loss.point.parameters.iter().zip(&self.intervals).any(at_end);
        Ok(Some(loss))
    }

    /// Losses near the end of the span that no computed characteristic meets: on a curve, where the determinant at the
    /// end is least between characteristics that have none.
    fn hidden_between(&self, sign: f64) -> Result<Vec<(usize, CausticPoint)>, CharacteristicsError> {
        let end = if 0.0 < sign { self.levels.len() - 1 } else { 0 };
        let mut found = Vec::new();
        if self.intervals.len() != 1 || self.levels[end].abs() <= 0.0 {
            return Ok(found);
        }
        let mut order: Vec<usize> = (0..self.rays.len()).collect();
        order.sort_by(|&a, &b| self.rays[a].parameters[0].total_cmp(&self.rays[b].parameters[0]));
        for three in order.windows(3) {
            let rays = [&self.rays[three[0]], &self.rays[three[1]], &self.rays[three[2]]];
            let at_end = rays.map(|ray| ray.determinants[end]);
            let none = |ray: &Ray| ray.caustic.iter().all(|point| sign * point.s <= 0.0);
            let least = at_end[1].abs() <= at_end[0].abs() && at_end[1].abs() <= at_end[2].abs();
            if !least || !rays.into_iter().all(none) {
                continue;
            }
            let mut search = Descent::new(self, three[1]);
            let s = self.levels[end];
            let mut slope = |tau: f64| search.determinant(&[tau], 0, s).map(|d| (d.value.tangent, f64::NAN));
            let (low, high) = (rays[0].parameters[0], rays[2].parameters[0]);
            let (at_low, at_high) = (slope(low)?.0, slope(high)?.0);
            if (at_low < 0.0) == (at_high < 0.0) {
                continue;
            }
            let tau = [zero_between(&mut slope, (low, at_low), high)?];
            let (_, start) = self.problem.ray_start(&tau, &search.guess)?;
            let levels = if 0.0 < sign { [0.0, s] } else { [s, 0.0] };
            let ray = search.marcher.ray(self.problem.data.equation, (&tau, &start), &levels)?;
            let first = ray.caustic.into_iter().min_by(|a, b| (sign * a.s).total_cmp(&(sign * b.s)));
            found.extend(first.map(|point| (three[1], point)));
        }
        Ok(found)
    }

    /// ξ at s = 0 of a ray.
    pub(super) fn covector_at_zero(&self, ray: usize) -> &[f64] {
        let m = self.problem.data.variables;
        let zero = self.levels.partition_point(|&s| s < 0.0);
        &self.row(&self.rays[ray].states, zero)[m + 1..=2 * m]
    }
}

/// Follows s*(τ) with its exact gradient.
struct Descent<'s, 'a, P, M> {
    solution: &'s CharacteristicSolution<'a, P, M>,
    marcher: Marcher<'a, P>,
    guess: Vec<f64>,
}

impl<'s, 'a, P: FirstOrderPde + Sync, M: InitialManifold + Sync> Descent<'s, 'a, P, M> {
    fn new(solution: &'s CharacteristicSolution<'a, P, M>, ray: usize) -> Self {
        let problem = &solution.problem;
        let marcher = Marcher::new(problem.data.equation, problem.data.variables, problem.tolerance);
        Self { solution, marcher, guess: solution.covector_at_zero(ray).to_vec() }
    }

    /// s* and its gradient at τ, from a caustic point nearby.
    fn at(&mut self, tau: &[f64], near: &CausticPoint) -> Result<FirstLoss, CharacteristicsError> {
        let problem = &self.solution.problem;
        let (_, start) = problem.ray_start(tau, &self.guess)?;
        let mut point = CausticPoint { parameters: tau.to_vec(), ..near.clone() };
        self.marcher.polish(&start, &mut point)?;
        let mut slope = vec![0.0; tau.len()];
        if !point.touching {
            for (a, slope) in slope.iter_mut().enumerate() {
                let determinant = self.determinant(tau, a, point.s)?;
                *slope = -determinant.value.tangent / determinant.tangent.value;
            }
        }
        Ok(FirstLoss { point, slope, at_edge: false })
    }

    /// D(s, τ) with its derivative along s, and the derivatives of both along one parameter.
    fn determinant(&self, tau: &[f64], parameter: usize, s: f64) -> Result<Dual<Dual<f64>>, CharacteristicsError> {
        let problem = &self.solution.problem;
        let m = problem.data.variables;
        let initial = problem.data.point(tau, &self.guess)?;
        let one = |i| if i == parameter { 1.0 } else { 0.0 };
        let dual: Vec<Dual<f64>> = tau.iter().enumerate().map(|(i, &tau)| Dual::new(tau, one(i))).collect();
        let start = problem.data.ray_state(&dual, &initial.xi)?;
        let mut field = RayField::<P, Dual<f64>>::new(problem.data.equation, m, m - 1);
        let y = march(&mut field, &mut DormandPrince853::new(problem.tolerance), start, s)?;
        Ok(field.determinant_and_slope(&y))
    }

    /// The zero of ∂s*/∂τ between two parameters about that of `loss`.
    fn bisect(&mut self, loss: &mut FirstLoss, (low, high): (f64, f64), sign: f64) -> Result<(), CharacteristicsError> {
        let middle = loss.point.parameters[0];
        // Towards the side to which s* falls.
        let downhill = -sign * loss.slope[0];
        let end = if downhill < 0.0 { low } else { high };
        if downhill.abs() <= 0.0 || (end - middle).abs() <= 0.0 {
            return Ok(());
        }
        let near = loss.point.clone();
        let mut best = loss.clone();
        let mut value = |tau: f64| {
            let found = self.at(&[tau], &near)?;
            let slope = found.slope[0];
            // A ray without a loss near that of its neighbour lies beyond the least.
            let usable = slope.is_finite() && 0.0 < sign * found.point.s;
            if usable && sign * found.point.s <= sign * best.point.s {
                best = found;
            }
            Ok::<_, CharacteristicsError>((if usable { sign * slope } else { downhill }, f64::NAN))
        };
        if (value(end)?.0 < 0.0) != (sign * loss.slope[0] < 0.0) {
            let tau = zero_between(&mut value, (middle, sign * loss.slope[0]), end)?;
            value(tau)?;
        }
        if (best.point.parameters[0] - middle).abs() > 0.0 {
            *loss = best;
        }
        Ok(())
    }

    /// Descent to the least s* in several parameters, by steps whose curvature is learnt from the gradients (BFGS).
    fn descend(&mut self, loss: &mut FirstLoss, sign: f64) -> Result<(), CharacteristicsError> {
        const STEPS: usize = 60;
        const HALVINGS: usize = 30;
        let intervals = &self.solution.intervals;
        let k = intervals.len();
        let scale: Vec<f64> = intervals.iter().map(|i| (i.to - i.from) / (4.0 * i.parts as f64)).collect();
        // The inverse Hessian, in the scales of the parameters; the first step is a part of a cell long.
        let mut inverse = vec![0.0; k * k];
        let steepest = loss.slope.iter().zip(&scale).map(|(g, h)| (g * h).abs()).fold(0.0, f64::max);
        if steepest <= f64::EPSILON * loss.point.s.abs() {
            return Ok(());
        }
        for i in 0..k {
            inverse[i * k + i] = scale[i] * scale[i] / steepest;
        }
        for _ in 0..STEPS {
            let gradient: Vec<f64> = loss.slope.iter().map(|g| sign * g).collect();
            let step: Vec<f64> =
                (0..k).map(|i| -(0..k).map(|j| inverse[i * k + j] * gradient[j]).sum::<f64>()).collect();
            let (mut share, mut next) = (1.0, None);
            for _ in 0..HALVINGS {
                let moved = loss.point.parameters.iter().zip(&step).zip(intervals);
                let tau: Vec<f64> = moved.map(|((tau, step), i)| (tau + share * step).clamp(i.from, i.to)).collect();
                let trial = self.at(&tau, &loss.point)?;
                let usable = trial.slope.iter().all(|g| g.is_finite()) && 0.0 < sign * trial.point.s;
                if usable && sign * trial.point.s < sign * loss.point.s {
                    next = Some(trial);
                    break;
                }
                share *= 0.5;
            }
            let Some(next) = next else { break };
            let dx: Vec<f64> = next.point.parameters.iter().zip(&loss.point.parameters).map(|(a, b)| a - b).collect();
            let dg: Vec<f64> = next.slope.iter().zip(&loss.slope).map(|(a, b)| sign * (a - b)).collect();
            update_inverse(&mut inverse, &dx, &dg);
            *loss = next;
        }
        Ok(())
    }
}

/// H ← (1 − ρ dx dgᵀ) H (1 − ρ dg dxᵀ) + ρ dx dxᵀ,  ρ = 1/(dx·dg), where the curvature dx·dg is positive.
fn update_inverse(inverse: &mut [f64], dx: &[f64], dg: &[f64]) {
    let k = dx.len();
    let curvature: f64 = dx.iter().zip(dg).map(|(x, g)| x * g).sum();
    let inverse_dg: Vec<f64> = (0..k).map(|i| (0..k).map(|j| inverse[i * k + j] * dg[j]).sum()).collect();
    let quadratic: f64 = dg.iter().zip(&inverse_dg).map(|(g, h)| g * h).sum();
    if curvature.is_nan() || curvature <= 0.0 {
        return;
    }
    for i in 0..k {
        for j in 0..k {
            inverse[i * k + j] += (1.0 + quadratic / curvature) * dx[i] * dx[j] / curvature
                - (dx[i] * inverse_dg[j] + inverse_dg[i] * dx[j]) / curvature;
        }
    }
}
