//! Residual stress: laminated bodies that are left to themselves.

use nalgebra::{SMatrix, SVector};
use piola_numerics::linear::lu;
use piola_solids::isochoric::Isochoric;

use super::{LaminatedPlate, LaminatedSphere, LaminatedTube, Lamination, SheetState, SphereState};
use crate::UniformityError;

/// A state without loads, and T₁₁ at its inner face.
///
/// # Example
/// See [`LaminatedSphere::at_rest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestState<S> {
    /// The deformation from the reference.
    pub state: S,
    /// T₁₁ at the inner face, Pa: zero unless the body is solid there.
    pub normal_stress: f64,
}

/// The error allowed of the unknowns, relative: differences of quadratures leave no more.
const TOLERANCE: f64 = 1e-11;
const MOST_STEPS: usize = 60;

impl<A: Lamination> LaminatedSphere<A> {
    /// The shell with both faces free: its residual stress.
    ///
    /// # Errors
    /// [`UniformityError::NotConverged`]; what the law refuses.
    ///
    /// # Example
    /// The inner half has grown by 5 % along the sphere: it is compressed there, and its neighbour pulls.
    /// ```
    /// use piola_numerics::Real;
    /// use piola_solids::isochoric::NeoHookean;
    /// use piola_uniformity::laminated::{LaminaMetric, LaminatedSphere, Lamination};
    /// struct Grown;
    /// impl Lamination for Grown {
    ///     fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
    ///         let growth = T::select(depth.less_than(T::lit(1.5)), T::lit(1.05), T::one());
    ///         LaminaMetric { normal: T::one(), in_plane: [(growth * depth).powi(2), T::one(), T::zero()] }
    ///     }
    ///     fn interfaces(&self) -> &[f64] {
    ///         &[1.5]
    ///     }
    /// }
    /// let (law, shell) = (NeoHookean::new(1.0)?, LaminatedSphere::new(Grown, [1.0, 2.0])?);
    /// let rest = shell.at_rest(&law)?;
    /// let hoop = |depth: f64| rest.state.stress(&law, depth, rest.normal_stress).map(|s| s.cauchy.0.components[1]);
    /// assert!(hoop(1.25)? < 0.0 && 0.0 < hoop(1.75)?);
    /// assert!(rest.state.normal_stress_difference(&law)?.abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn at_rest(&self, law: &impl Isochoric) -> Result<RestState<SphereState<&A>>, UniformityError> {
        let natural = self.lamination.metric(self.depths.inner).in_plane[0].sqrt();
        if natural <= 0.0 {
            let state = self.inflated(0.0)?;
            return Ok(RestState { state, normal_stress: -state.normal_stress_difference(law)? });
        }
        let [logarithm] = solve([natural.ln()], |[logarithm]: [f64; 1]| {
            Ok([self.inflated(logarithm.exp())?.normal_stress_difference(law)?])
        })?;
        Ok(RestState { state: self.inflated(logarithm.exp())?, normal_stress: 0.0 })
    }
}

impl<A: Lamination> LaminatedTube<A> {
    /// The closed tube, θ = Θ and z = λ Z, with both faces free and no axial force: its residual stress. Torque and bending moment are
    /// those of [`loads`](SheetState::loads); the torque vanishes where h₁₂ does.
    ///
    /// # Errors
    /// [`UniformityError::NotConverged`]; what the law refuses.
    pub fn at_rest(&self, law: &impl Isochoric) -> Result<RestState<SheetState<&A>>, UniformityError> {
        let tube = |radius: f64, stretch: f64| self.inflated(radius, [[1.0, 0.0], [0.0, stretch]]);
        let middle = self.lamination().metric(f64::midpoint(self.radii()[0], self.radii()[1]));
        let axial = middle.in_plane[1].sqrt().ln();
        let natural = self.lamination().metric(self.radii()[0]).in_plane[0].sqrt();
        if natural <= 0.0 {
            let free =
                |state: &SheetState<&A>| Ok::<_, UniformityError>(-state.loads(law, 0.0)?.normal_stress_difference);
            let [axial] = solve([axial], |[axial]: [f64; 1]| {
                let state = tube(0.0, axial.exp())?;
                Ok([state.loads(law, free(&state)?)?.second_force])
            })?;
            let state = tube(0.0, axial.exp())?;
            return Ok(RestState { state, normal_stress: free(&state)? });
        }
        let [radius, axial] = solve([natural.ln(), axial], |[radius, axial]: [f64; 2]| {
            let loads = tube(radius.exp(), axial.exp())?.loads(law, 0.0)?;
            Ok([loads.normal_stress_difference, loads.second_force])
        })?;
        Ok(RestState { state: tube(radius.exp(), axial.exp())?, normal_stress: 0.0 })
    }
}

impl<A: Lamination> LaminatedPlate<A> {
    /// The plate held flat by moments alone: no forces in its plane, its faces free. The moments are those of
    /// [`loads`](SheetState::loads).
    ///
    /// # Errors
    /// [`UniformityError::NotConverged`]; what the law refuses.
    ///
    /// # Example
    /// Two halves of a plate, one grown by 10 % in both directions, share the stretch.
    /// ```
    /// use piola_numerics::Real;
    /// use piola_solids::isochoric::NeoHookean;
    /// use piola_uniformity::laminated::{LaminaMetric, LaminatedPlate, Lamination};
    /// struct Grown;
    /// impl Lamination for Grown {
    ///     fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
    ///         let square = T::select(depth.less_than(T::zero()), T::one(), T::lit(1.21));
    ///         LaminaMetric { normal: T::one(), in_plane: [square, square, T::zero()] }
    ///     }
    ///     fn interfaces(&self) -> &[f64] {
    ///         &[0.0]
    ///     }
    /// }
    /// let (law, plate) = (NeoHookean::new(1.0)?, LaminatedPlate::new(Grown, [-1.0, 1.0])?);
    /// let rest = plate.held_flat(&law)?;
    /// let stretch = rest.state.place([0.0, 1.0, 0.0])?[1];
    /// assert!(1.0 < stretch && stretch < 1.1);
    /// assert!(rest.state.loads(&law, 0.0)?.first_force.abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn held_flat(&self, law: &impl Isochoric) -> Result<RestState<SheetState<&A>>, UniformityError> {
        let [inner, outer] = self.faces();
        let [first, second, _] = self.lamination().metric(f64::midpoint(inner, outer)).in_plane;
        // The symmetric matrix exp(first), exp(second) on its diagonal.
        let plate = |[a, b, c]: [f64; 3]| self.flat(0.0, [[a.exp(), c], [c, b.exp()]]);
        let unknowns = solve([0.5 * first.ln(), 0.5 * second.ln(), 0.0], |unknowns| {
            let loads = plate(unknowns)?.loads(law, 0.0)?;
            Ok([loads.first_force, loads.second_force, loads.shear])
        })?;
        Ok(RestState { state: plate(unknowns)?, normal_stress: 0.0 })
    }
}

/// Newton's method with slopes by central differences; a step is halved until |f| falls.
fn solve<const N: usize>(
    start: [f64; N],
    mut f: impl FnMut([f64; N]) -> Result<[f64; N], UniformityError>,
) -> Result<[f64; N], UniformityError> {
    /// The cube root of an ulp: differences of the second order.
    const STEP: f64 = 6e-6;
    let size = |values: &SVector<f64, N>| values.amax();
    let mut unknowns = SVector::<f64, N>::from(start);
    let mut values = SVector::<f64, N>::from(f(start)?);
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let mut slopes = SMatrix::<f64, N, N>::zeros();
        for direction in 0..N {
            let [mut low, mut high] = [unknowns; 2];
            (low[direction], high[direction]) = (unknowns[direction] - STEP, unknowns[direction] + STEP);
            let (before, after) = (f(low.into())?, f(high.into())?);
            let column = SVector::<f64, N>::from(after) - SVector::<f64, N>::from(before);
            slopes.set_column(direction, &(column / (2.0 * STEP)));
        }
        let singular = |_| UniformityError::NotConverged {
            quantity: "state without loads",
            error: size(&values),
            allowed: TOLERANCE,
        };
        let step = -lu::solve(slopes, values).map_err(singular)?;
        let mut share = 1.0;
        loop {
            let trial = unknowns + step * share;
            if let Ok(found) = f(trial.into()) {
                let found = SVector::<f64, N>::from(found);
                if size(&found) <= size(&values) {
                    (unknowns, values) = (trial, found);
                    break;
                }
            }
            share *= 0.5;
            if share < 1e-6 {
                break;
            }
        }
        last = size(&step);
        // Unknowns are logarithms: their steps are relative.
        if last <= TOLERANCE {
            return Ok(unknowns.into());
        }
    }
    Err(UniformityError::NotConverged { quantity: "state without loads", error: last, allowed: TOLERANCE })
}
