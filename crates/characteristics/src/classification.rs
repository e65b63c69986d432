//! How many solutions contain an initial strip manifold, and why.
//!
//! ```text
//! det(Φ_ξ, x_τ) ≠ 0                                        one                         W(A.32), (i)
//! Φ_ξ = aᵅ x_τᵅ,  aᵅ ξ_τᵅ = −(ξΦ_u + Φ_x)                    infinitely many              (iia)
//! Φ_ξ = aᵅ x_τᵅ,  aᵅ ξ_τᵅ ≠ −(ξΦ_u + Φ_x)                    none, twice differentiable   (iib)
//! ```
//!
//! Φ_ξ = 0 is W(A.33) with a = 0. The derivative of Φ(x, u(x), ∇u(x)) = 0 is then ξΦ_u + Φ_x = 0: where that fails, there
//! is no solution that is twice differentiable. Where it holds, the characteristic stands still, and no strip across the
//! manifold can be carried along it as in (iia): the conditions do not tell the number of solutions. Of u = 0 on the line
//! x² = 0, where ξ₁ = 0, ξ·ξ/2 = 0 has the solution u = 0 alone; ξ₁ξ₂ = 0 has all u = g(x²) with g(0) = g′(0) = 0; and
//! ξ₁² + (ξ₂ − x¹)² = 0 has none.

use super::mesh::Walk;
use super::roots::zero_between;
use super::strip::TANGENT;
use super::{CauchyProblem, FirstOrderPde, InitialManifold, InitialPoint, ParameterInterval, StripKind};
use crate::{CharacteristicsError, StripError};

/// A point at which an initial manifold, transversal elsewhere, is not.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DegeneratePoint {
    /// τ.
    pub parameters: Vec<f64>,
    /// det(Φ_ξ, x_τ) there.
    pub determinant: f64,
    /// The sine of the angle between Φ_ξ and the manifold.
    pub transversality: f64,
    /// |Φ_ξ|.
    pub speed: f64,
    /// Φ, at the ξ nearest to a root where there is none.
    pub equation: f64,
    /// What the manifold is there.
    pub kind: StripKind,
}

/// How many solution surfaces contain an initial strip manifold, as far as the points looked at tell.
///
/// # Source
/// W(A.32), W(A.33), W(A.42).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Classification {
    /// Exactly one: the manifold is transversal to the characteristics.
    Unique {
        /// The smallest |sine| of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// τ where it is found.
        parameters: Vec<f64>,
    },
    /// Infinitely many: the manifold is formed by characteristic strips, or its ξ is undetermined.
    InfinitelyMany {
        /// The largest |sine| of the angle between Φ_ξ and the manifold.
        transversality: f64,
        /// The largest relative residual of the characteristic condition on ξ′; zero where ξ is undetermined.
        residual: f64,
        /// Whether the data leave ξ undetermined somewhere.
        undetermined: bool,
    },
    /// Not told by the conditions: Φ_ξ = 0 and ξΦ_u + Φ_x = 0 at points of the manifold, the characteristics of which
    /// stand still, and it is tangent to the characteristics elsewhere. There may be one solution, many or none.
    Stationary {
        /// How many of the points looked at are such.
        stationary: usize,
        /// How many points were looked at.
        points: usize,
        /// τ of the first of them.
        parameters: Vec<f64>,
        /// The largest |Φ_ξ| at them.
        speed: f64,
        /// The largest relative residual of the characteristic condition on ξ′, which is ξΦ_u + Φ_x = 0 at them.
        residual: f64,
    },
    /// None that is twice differentiable: the manifold is formed by Monge strips that are not characteristic, or
    /// Φ_ξ = 0 but ξΦ_u + Φ_x ≠ 0.
    None {
        /// The sine at the worst point.
        transversality: f64,
        /// The largest relative residual of the characteristic condition on ξ′.
        residual: f64,
        /// τ of the worst point.
        parameters: Vec<f64>,
    },
    /// None at all: no ξ satisfies the data and the equation anywhere.
    NoCovector {
        /// τ of the first point.
        parameters: Vec<f64>,
        /// Φ at the nearest ξ.
        residual: f64,
        /// Its derivative along the normal of the manifold.
        slope: f64,
    },
    /// One beside each part between the points named, at which the manifold is not transversal.
    Partial {
        /// Where it is not, in the order of the search.
        points: Vec<DegeneratePoint>,
    },
}

impl<P: FirstOrderPde, M: InitialManifold> CauchyProblem<'_, P, M> {
    /// Looks at the ends of all parts of the intervals of τ and says how many solutions there are.
    ///
    /// Between neighbours whose determinants have opposite signs the zero is found to rounding, and on a curve (m = 2)
    /// also zeros that are touched between them. Where the sign changes without a zero, since ξ goes over to another
    /// root or does not exist in between, the [kind](DegeneratePoint::kind) of the point says so.
    ///
    /// # Errors
    /// As [`initial_point`](Self::initial_point), where ξ exists at some points but not at others;
    /// [`CharacteristicsError::InvalidInterval`], [`CharacteristicsError::TooFewSamples`].
    ///
    /// # Accuracy
    /// Tangency is decided at a sine of 1e-6, since a double root of Φ is known to the root of rounding only.
    ///
    /// # Example
    /// ```
    /// use piola_characteristics::*;
    /// use piola_numerics::Real;
    /// struct Eikonal;
    /// impl FirstOrderPde for Eikonal {
    ///     fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
    ///         T::lit(0.5) * (xi[0] * xi[0] + xi[1] * xi[1] - T::one())
    ///     }
    /// }
    /// struct Ray; // u = x on the line y = 0: a characteristic strip
    /// impl InitialManifold for Ray {
    ///     fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
    ///         (x[0], x[1]) = (tau[0], T::zero());
    ///         tau[0]
    ///     }
    /// }
    /// let problem = CauchyProblem::new(&Eikonal, &Ray, 2)?.near(&[1.0, 0.5])?;
    /// let line = [ParameterInterval { from: 0.0, to: 1.0, parts: 4 }];
    /// assert!(matches!(problem.classify(&line)?, Classification::InfinitelyMany { .. }));
    /// assert!(matches!(problem.characteristic(&[0.5], 1.0), Err(CharacteristicsError::Strip(StripError::Characteristic { .. }))));
    /// # Ok::<(), piola_characteristics::CharacteristicsError>(())
    /// ```
    ///
    /// # Source
    /// W(A.32), W(A.33), W(A.42).
    pub fn classify(&self, intervals: &[ParameterInterval]) -> Result<Classification, CharacteristicsError> {
        self.check_intervals(intervals)?;
        let walk = Walk::new(intervals);
        let mut points: Vec<Option<InitialPoint>> = Vec::with_capacity(walk.len());
        let (mut refusal, mut found) = (None, 0);
        for index in 0..walk.len() {
            let guess = walk.before(index).and_then(|before| points[before].as_ref()).map(|point| point.xi.clone());
            match self.data.point(&walk.parameters(index), guess.as_deref().unwrap_or(&self.guess)) {
                Ok(point) => {
                    found += 1;
                    points.push(Some(point));
                }
                Err(error @ CharacteristicsError::Strip(StripError::NoInitialCovector { .. })) => {
                    refusal.get_or_insert(error);
                    points.push(None);
                }
                Err(error) => return Err(error),
            }
        }
        match refusal {
            Some(CharacteristicsError::Strip(StripError::NoInitialCovector {
                parameters, residual, slope, ..
            })) if found == 0 => {
                return Ok(Classification::NoCovector { parameters, residual, slope });
            }
            Some(error) => return Err(error),
            None => {}
        }
        let points: Vec<InitialPoint> = points.into_iter().flatten().collect();
        if points.iter().all(|point| point.kind != StripKind::Transversal) {
            return Ok(nowhere_transversal(&points));
        }
        let degenerate = self.degenerate_points(&walk, &points)?;
        if !degenerate.is_empty() {
            return Ok(Classification::Partial { points: degenerate });
        }
        let least = points.iter().fold(&points[0], |least, point| {
            if point.transversality.abs() < least.transversality.abs() { point } else { least }
        });
        Ok(Classification::Unique { transversality: least.transversality, parameters: least.parameters.clone() })
    }

    fn degenerate_points(
        &self,
        walk: &Walk<'_>,
        points: &[InitialPoint],
    ) -> Result<Vec<DegeneratePoint>, CharacteristicsError> {
        let mut found: Vec<DegeneratePoint> = Vec::new();
        for (index, point) in points.iter().enumerate() {
            if point.kind != StripKind::Transversal {
                found.push(degenerate(point));
            }
            for before in walk.all_before(index) {
                let before = &points[before];
                let both = before.kind == StripKind::Transversal && point.kind == StripKind::Transversal;
                if both && (before.determinant < 0.0) != (point.determinant < 0.0) {
                    found.push(self.crossing(before, point)?);
                }
            }
        }
        if points[0].parameters.len() == 1 {
            for three in points.windows(3) {
                let sine = |i: usize| three[i].transversality.abs();
                let same = three.iter().all(|p| (p.determinant < 0.0) == (three[0].determinant < 0.0));
                if same && three.iter().all(|p| p.kind == StripKind::Transversal) && sine(1) <= sine(0).min(sine(2)) {
                    let near = |a: &DegeneratePoint, b: &DegeneratePoint| {
                        let width = three[2].parameters[0] - three[0].parameters[0];
                        (a.parameters[0] - b.parameters[0]).abs() <= 1e-4 * width.abs()
                    };
                    if let Some(point) = self.touching(three)?
                        && !found.iter().any(|known| near(known, &point))
                    {
                        found.push(point);
                    }
                }
            }
        }
        Ok(found)
    }

    /// Where the determinant vanishes between two neighbours of opposite sign.
    fn crossing(&self, before: &InitialPoint, after: &InitialPoint) -> Result<DegeneratePoint, CharacteristicsError> {
        let at = |share: f64| -> Vec<f64> {
            before.parameters.iter().zip(&after.parameters).map(|(a, b)| a + share * (b - a)).collect()
        };
        let guess = |share: f64| if share < 0.5 { &before.xi } else { &after.xi };
        let mut last = degenerate(after);
        zero_between(
            &mut |share| match self.data.point(&at(share), guess(share)) {
                Ok(point) => {
                    last = degenerate(&point);
                    Ok((point.determinant, f64::NAN))
                }
                // Nothing is to be found beyond a point without ξ.
                Err(CharacteristicsError::Strip(StripError::NoInitialCovector { covector, .. })) => {
                    last = degenerate(&self.data.point_without_covector(&at(share), covector)?);
                    Ok((0.0, f64::NAN))
                }
                Err(error) => Err(error),
            },
            (0.0, before.determinant),
            1.0,
        )?;
        if last.kind == StripKind::Transversal {
            // The determinant has the sign of the sine: one of its factors vanishes, or it jumps.
            let still = last.speed <= TANGENT * before.speed.min(after.speed);
            last.kind = if still { StripKind::Stationary } else { StripKind::Jump };
        }
        Ok(last)
    }

    /// The least |sine| between three points, if it is that of a tangent.
    fn touching(&self, three: &[InitialPoint]) -> Result<Option<DegeneratePoint>, CharacteristicsError> {
        const SHARE: f64 = 0.381_966_011_250_105_1;
        let (mut a, mut b) = (three[0].parameters[0], three[2].parameters[0]);
        let sine = |tau: f64| self.data.point(&[tau], &three[1].xi).map(|p| p.transversality.abs());
        let (mut c, mut d) = (a + SHARE * (b - a), b - SHARE * (b - a));
        let (mut at_c, mut at_d) = (sine(c)?, sine(d)?);
        for _ in 0..50 {
            if at_c < at_d {
                (b, d, at_d) = (d, c, at_c);
                c = a + SHARE * (b - a);
                at_c = sine(c)?;
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = b - SHARE * (b - a);
                at_d = sine(d)?;
            }
        }
        if at_c.min(at_d) <= TANGENT {
            let point = self.data.point(&[if at_c < at_d { c } else { d }], &three[1].xi)?;
            return Ok(Some(degenerate(&point)));
        }
        Ok(None)
    }

    /// Refuses what is not unique.
    pub(super) fn refuse_unless_unique(&self, intervals: &[ParameterInterval]) -> Result<(), CharacteristicsError> {
        match self.classify(intervals)? {
            Classification::Unique { .. } => Ok(()),
            Classification::InfinitelyMany { transversality, residual, undetermined } => {
                let parameters = intervals.iter().map(|interval| interval.from).collect();
                Err(if undetermined {
                    CharacteristicsError::Strip(StripError::Degenerate {
                        parameters,
                        transversality,
                        kind: StripKind::Undetermined,
                    })
                } else {
                    CharacteristicsError::Strip(StripError::Characteristic { parameters, transversality, residual })
                })
            }
            Classification::Stationary { parameters, .. } => Err(CharacteristicsError::Strip(StripError::Degenerate {
                parameters,
                transversality: 0.0,
                kind: StripKind::Stationary,
            })),
            Classification::None { transversality, residual, parameters } => {
                Err(CharacteristicsError::Strip(StripError::Monge { parameters, transversality, residual }))
            }
            Classification::NoCovector { parameters, residual, slope } => {
                Err(CharacteristicsError::Strip(StripError::NoInitialCovector {
                    parameters,
                    covector: self.guess.clone(),
                    residual,
                    slope,
                }))
            }
            Classification::Partial { points } => {
                let DegeneratePoint { parameters, transversality, kind, .. } = points[0].clone();
                Err(CharacteristicsError::Strip(StripError::Degenerate { parameters, transversality, kind }))
            }
        }
    }
}

fn degenerate(point: &InitialPoint) -> DegeneratePoint {
    DegeneratePoint {
        parameters: point.parameters.clone(),
        determinant: point.determinant,
        transversality: point.transversality,
        speed: point.speed,
        equation: point.equation,
        kind: point.kind,
    }
}

/// The manifold is tangent to characteristics, or they stand still, at every point.
fn nowhere_transversal(points: &[InitialPoint]) -> Classification {
    let undetermined = points.iter().any(|point| point.kind == StripKind::Undetermined);
    let still = |point: &&InitialPoint| point.kind == StripKind::Stationary;
    let (mut worst, mut transversality, mut residual) = (&points[0], 0.0_f64, 0.0_f64);
    for point in points {
        transversality = transversality.max(point.transversality.abs());
        if point.kind == StripKind::Undetermined {
            continue;
        }
        residual = residual.max(point.characteristic);
        if worst.kind == StripKind::Undetermined || worst.characteristic < point.characteristic {
            worst = point;
        }
    }
    if TANGENT < residual {
        let parameters = worst.parameters.clone();
        return Classification::None { transversality: worst.transversality, residual, parameters };
    }
    if let Some(first) = points.iter().find(still) {
        return Classification::Stationary {
            stationary: points.iter().filter(still).count(),
            points: points.len(),
            parameters: first.parameters.clone(),
            speed: points.iter().filter(still).fold(0.0, |speed, point| speed.max(point.speed)),
            residual,
        };
    }
    Classification::InfinitelyMany { transversality, residual, undetermined }
}
