//! Curves of a load over a parameter: limit points, branches, and all states that carry a load.

use crate::SolutionsError;
use crate::error::{check_bound, check_finite};
use crate::roots::{bracketed, places};

/// Intervals of a range that are searched one by one.
const INTERVALS: usize = 256;

/// A state on a [`LoadCurve`].
///
/// # Example
/// See [`LoadCurve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The parameter.
    pub parameter: f64,
    /// The load.
    pub load: f64,
    /// The derivative of the load with respect to the parameter: where it is negative the state is unstable under a
    /// prescribed load.
    pub slope: f64,
}

/// A load as a function of a parameter of the deformation, such as the pressure of a balloon over its stretch.
///
/// Slopes are exact derivatives. A range is searched in 256 intervals, in proportion where both ends are positive: two limit
/// points within one interval are not seen.
///
/// # Errors
/// [`SolutionsError::OutOfBounds`] for a range that is not one; what the law and the deformation refuse within it.
///
/// # Example
/// A curve of one's own, 2 x³ − 9 x² + 12 x, with a maximum 5 at 1 and a minimum 4 at 2.
/// ```
/// use piola_solutions::{LoadCurve, SolutionsError};
/// struct Cubic;
/// impl LoadCurve for Cubic {
///     const LOAD: &'static str = "load";
///     const PARAMETER: &'static str = "x";
///     fn load_and_slope(&self, x: f64) -> Result<[f64; 2], SolutionsError> {
///         Ok([x * (12.0 + x * (2.0 * x - 9.0)), 6.0 * (x - 1.0) * (x - 2.0)])
///     }
/// }
/// assert_eq!(Cubic.limit_points((0.0, 3.5))?.iter().map(|point| point.load).collect::<Vec<_>>(), [5.0, 4.0]);
/// assert_eq!(Cubic.states_at(4.5, (0.0, 3.5))?.len(), 3);
/// let beyond = Cubic.states_at(6.0, (0.0, 2.0));
/// let Err(SolutionsError::BeyondLimitPoint { limit, .. }) = beyond else { panic!("{beyond:?}") };
/// assert!((limit - 5.0).abs() < 1e-12);
/// # Ok::<(), SolutionsError>(())
/// ```
pub trait LoadCurve {
    /// What the load is called.
    const LOAD: &'static str;
    /// What the parameter is called.
    const PARAMETER: &'static str;

    /// The load and its derivative.
    ///
    /// # Errors
    /// What the law and the deformation refuse.
    fn load_and_slope(&self, parameter: f64) -> Result<[f64; 2], SolutionsError>;

    /// The state at a parameter.
    ///
    /// # Errors
    /// See [the trait](LoadCurve#errors).
    fn point(&self, parameter: f64) -> Result<CurvePoint, SolutionsError> {
        check_finite(Self::PARAMETER, &[parameter])?;
        let [load, slope] = self.load_and_slope(parameter)?;
        check_finite(Self::LOAD, &[load, slope])?;
        Ok(CurvePoint { parameter, load, slope })
    }

    /// States evenly spaced over a range, for a figure.
    ///
    /// # Errors
    /// See [the trait](LoadCurve#errors).
    fn trace(&self, range: (f64, f64), intervals: usize) -> Result<Vec<CurvePoint>, SolutionsError> {
        check_range(Self::PARAMETER, range)?;
        places(range, intervals.max(1)).map(|parameter| self.point(parameter)).collect()
    }

    /// The limit points of a range, in order: where the slope changes its sign.
    ///
    /// # Errors
    /// See [the trait](LoadCurve#errors).
    #[doc(alias("turning point", "limit load", "snap-through"))]
    fn limit_points(&self, range: (f64, f64)) -> Result<Vec<CurvePoint>, SolutionsError> {
        limits_among(self, &self.trace(range, INTERVALS)?)
    }

    /// All states of a range that carry a load, in order of the parameter.
    ///
    /// # Errors
    /// See [the trait](LoadCurve#errors). If no state carries the load: [`SolutionsError::BeyondLimitPoint`] with the
    /// nearest limit point, or [`SolutionsError::NotReached`] if the nearest load is at an end of the range.
    fn states_at(&self, load: f64, range: (f64, f64)) -> Result<Vec<CurvePoint>, SolutionsError> {
        check_finite(Self::LOAD, &[load])?;
        let trace = self.trace(range, INTERVALS)?;
        let limits = limits_among(self, &trace)?;
        // Between neighbouring nodes, limit points among them, the curve is monotone.
        let mut nodes = trace.clone();
        nodes.extend(limits.iter().copied());
        nodes.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
        let mut found: Vec<CurvePoint> = Vec::new();
        for pair in nodes.windows(2) {
            let [low, high] = [pair[0].load - load, pair[1].load - load];
            if low.abs() <= 0.0 {
                found.push(pair[0]);
            } else if low * high < 0.0 {
                let miss = |x: f64| Ok(self.load_and_slope(x)?[0] - load);
                let root = bracketed(miss, (pair[0].parameter, low), (pair[1].parameter, high))?;
                found.push(self.point(root)?);
            }
        }
        found.extend(nodes.last().filter(|last| (last.load - load).abs() <= 0.0));
        found.dedup_by(|a, b| (a.parameter - b.parameter).abs() <= 0.0);
        if !found.is_empty() {
            return Ok(found);
        }
        let miss = |point: &CurvePoint| (point.load - load).abs();
        let nearest = |points: &[CurvePoint]| points.iter().copied().min_by(|a, b| miss(a).total_cmp(&miss(b)));
        let ends = [trace[0], trace[trace.len() - 1]];
        let (low, high) = range;
        let end = nearest(&ends).unwrap_or(trace[0]);
        let not_reached = SolutionsError::NotReached {
            load: Self::LOAD,
            value: load,
            nearest: end.load,
            parameter: Self::PARAMETER,
            low,
            high,
        };
        Err(match nearest(&limits) {
            Some(limit) if miss(&limit) <= miss(&end) => SolutionsError::BeyondLimitPoint {
                load: Self::LOAD,
                value: load,
                limit: limit.load,
                parameter: Self::PARAMETER,
                at: limit.parameter,
            },
            _ => not_reached,
        })
    }
}

/// Refuses ends that are not finite or not in order.
fn check_range(parameter: &'static str, (low, high): (f64, f64)) -> Result<(), SolutionsError> {
    check_finite(parameter, &[low, high])?;
    check_bound(parameter, high, "low end < high end", low < high)
}

/// The limit points between the points of a trace, and those that a point of the trace meets exactly.
fn limits_among<C: LoadCurve + ?Sized>(curve: &C, trace: &[CurvePoint]) -> Result<Vec<CurvePoint>, SolutionsError> {
    let mut limits = Vec::new();
    for (index, pair) in trace.windows(2).enumerate() {
        let [low, high] = [pair[0].slope, pair[1].slope];
        let before = if 0 < index { trace[index - 1].slope } else { 0.0 };
        if low.abs() <= 0.0 && before * high < 0.0 {
            limits.push(pair[0]);
        } else if low * high < 0.0 {
            let slope = |x: f64| Ok(curve.load_and_slope(x)?[1]);
            let root = bracketed(slope, (pair[0].parameter, low), (pair[1].parameter, high))?;
            limits.push(curve.point(root)?);
        }
    }
    Ok(limits)
}
