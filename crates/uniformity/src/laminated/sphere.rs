//! Laminated spheres and spherical shells.

use piola_numerics::Real;
use piola_solids::isochoric::Isochoric;
use piola_tensor::Symmetric;

use super::{Depths, LaminaMetric, LaminaStress, Lamination, extra_stress, integrate, sizes, stress_with};
use crate::UniformityError;
use crate::error::check_bound;

/// A laminated spherical shell: M = m(R)² dR² + h(R)² (the metric of the unit sphere), W(29.36).
///
/// Of a [`LaminaMetric`] the shell takes m = `normal` and h² = `in_plane[0]`.
///
/// # Example
/// A homogeneous shell, inflated so that its inner radius doubles: r³ = R³ + 7.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_uniformity::laminated::{HomogeneousTube, LaminatedSphere};
/// let shell = LaminatedSphere::new(HomogeneousTube, [1.0, 2.0])?;
/// let inflated = shell.inflated(2.0)?;
/// assert!((inflated.radius(2.0)? - 15.0_f64.cbrt()).abs() < 1e-14);
/// // p = ∫ 2 (λ² − λ⁻⁴) dr/r = [2/λ + ½ λ⁻⁴] from λ = 2 to λ = 15^⅓/2, μ = 1
/// let primitive = |stretch: f64| 2.0 / stretch + 0.5 * stretch.powi(-4);
/// let by_hand = primitive(15.0_f64.cbrt() / 2.0) - primitive(2.0);
/// assert!((inflated.normal_stress_difference(&NeoHookean::new(1.0)?)? - by_hand).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminatedSphere<A> {
    pub(super) lamination: A,
    pub(super) depths: Depths,
}

impl<A: Lamination> LaminatedSphere<A> {
    /// By its metric and the radii R of its faces, m.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] unless 0 ≤ inner < outer radius and the metric is positive definite; [`UniformityError::NotFinite`].
    pub fn new(lamination: A, [inner, outer]: [f64; 2]) -> Result<Self, UniformityError> {
        check_bound("inner radius", inner, "0 ≤ R", 0.0 <= inner)?;
        let depths = Depths::new(inner, outer)?;
        for depth in [f64::midpoint(inner, outer), outer] {
            let lamina = lamination.metric(depth);
            check_bound("m", lamina.normal, "0 < m", 0.0 < lamina.normal)?;
            check_bound("h11", lamina.in_plane[0], "0 < h11", 0.0 < lamina.in_plane[0])?;
        }
        Ok(Self { lamination, depths })
    }

    /// Family 4: r³ = r₀³ + 3 ∫ m h² dR, W(29.37).
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] for r₀ < 0, [`UniformityError::NotFinite`].
    pub fn inflated(&self, radius: f64) -> Result<SphereState<&A>, UniformityError> {
        self.state(radius, 1.0)
    }

    /// Family 4 turned inside out: r³ = r₀³ − 3 ∫ m h² dR; r₀ is where the inner face of the reference is, outside.
    ///
    /// # Errors
    /// As [`inflated`](Self::inflated), and where r³ < 0.
    pub fn everted(&self, radius: f64) -> Result<SphereState<&A>, UniformityError> {
        self.state(radius, -1.0)
    }

    fn state(&self, radius: f64, sign: f64) -> Result<SphereState<&A>, UniformityError> {
        check_bound("radius", radius, "0 ≤ r", 0.0 <= radius)?;
        let state = SphereState { lamination: &self.lamination, depths: self.depths, radius, sign };
        let cube = radius.powi(3) + 3.0 * sign * state.volume_to(self.depths.outer)?;
        check_bound("cube of the radius", cube, "0 ≤ r^3", 0.0 <= cube)?;
        Ok(state)
    }
}

/// A laminated spherical shell, inflated or everted.
///
/// Physical components stand in the order r and the two angles.
///
/// # Accuracy
/// As [`SheetState`](super::SheetState).
///
/// # Example
/// See [`LaminatedSphere`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereState<A> {
    pub(super) lamination: A,
    pub(super) depths: Depths,
    pub(super) radius: f64,
    pub(super) sign: f64,
}

/// m h², the volume of a unit of solid angle and depth.
fn volume<T: Real>(lamina: &LaminaMetric<T>) -> T {
    lamina.normal * lamina.in_plane[0]
}

impl<A: Lamination> SphereState<A> {
    /// ∫ m h² dR from the inner face.
    pub(super) fn volume_to(&self, depth: f64) -> Result<f64, UniformityError> {
        let interfaces = self.lamination.interfaces();
        let [sum] =
            integrate(interfaces, (self.depths.inner, depth), [0.0], |x| Ok([volume(&self.lamination.metric(x))]))?;
        Ok(sum)
    }

    /// r at a depth R, m.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] for a depth outside the faces.
    pub fn radius(&self, depth: f64) -> Result<f64, UniformityError> {
        self.depths.check(depth)?;
        Ok((self.radius.powi(3) + 3.0 * self.sign * self.volume_to(depth)?).cbrt())
    }

    /// B, the strain from the natural state: diag(h⁴/r⁴, r²/h², r²/h²).
    ///
    /// # Errors
    /// As [`radius`](Self::radius).
    pub fn left_cauchy_green(&self, depth: f64) -> Result<Symmetric, UniformityError> {
        let stretch = self.stretch_squared(depth, self.radius(depth)?);
        Ok(Symmetric::diagonal([(stretch * stretch).recip(), stretch, stretch]))
    }

    /// T at a depth, with `T_rr` given at the inner face of the reference, Pa.
    ///
    /// # Errors
    /// As [`radius`](Self::radius), and what the law refuses.
    pub fn stress(
        &self,
        law: &impl Isochoric,
        depth: f64,
        normal_stress: f64,
    ) -> Result<LaminaStress, UniformityError> {
        check_bound("T11", normal_stress, "finite", true)?;
        let radius = self.radius(depth)?;
        let change = self.change_to(law, depth)?;
        let stretch = self.stretch_squared(depth, radius);
        let extra = extra_stress(law, (stretch * stretch).recip(), [stretch, stretch, 0.0])?;
        Ok(stress_with(&extra, normal_stress + change))
    }

    /// `T_rr` at the outer less at the inner face of the reference, Pa: the pressure that inflates the shell.
    ///
    /// # Errors
    /// What the law refuses at some depth; [`UniformityError::NotConverged`].
    pub fn normal_stress_difference(&self, law: &impl Isochoric) -> Result<f64, UniformityError> {
        self.change_to(law, self.depths.outer)
    }

    /// r²/h².
    fn stretch_squared(&self, depth: f64, radius: f64) -> f64 {
        radius * radius / self.lamination.metric(depth).in_plane[0]
    }

    /// ∫ 2 (`T_θθ` − `T_rr`) dr/r from the inner face.
    fn change_to(&self, law: &impl Isochoric, depth: f64) -> Result<f64, UniformityError> {
        let interfaces = self.lamination.interfaces();
        let rate = |depth: f64| {
            let (lamina, radius) = (self.lamination.metric(depth), self.radius(depth)?);
            let stretch = self.stretch_squared(depth, radius);
            let extra = extra_stress(law, (stretch * stretch).recip(), [stretch, stretch, 0.0])?;
            Ok::<_, UniformityError>((extra, 2.0 * self.sign * volume(&lamina) / radius.powi(3)))
        };
        let (extra, slope) = rate(self.depths.middle())?;
        let terms = sizes(&extra) * slope.abs() * (self.depths.outer - self.depths.inner);
        let [change] = integrate(interfaces, (self.depths.inner, depth), [terms], |x| {
            let (extra, slope) = rate(x)?;
            Ok([(extra[1][1] - extra[0][0]) * slope])
        })?;
        Ok(change)
    }
}
