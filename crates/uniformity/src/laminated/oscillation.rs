//! Radial oscillation of laminated tubes and spherical shells.
//!
//! ```text
//! sphere  q̇ (1/r_i − 1/r_o) = (ΔT_rr − S)/ρ + ½ q² (r_i⁻⁴ − r_o⁻⁴),     q = r² ṙ
//! tube    u̇ ln(r_o/r_i)     = (ΔT_rr − S)/ρ + ½ u² (r_i⁻² − r_o⁻²),     u = r ṙ
//! ```
//!
//! S is the difference of `T_rr` that holds the state at rest, `ΔT_rr` the given one.

use piola_integrators::Field;
use piola_solids::isochoric::Isochoric;

use super::{LaminatedSphere, LaminatedTube, Lamination, integrate};
use crate::UniformityError;
use crate::error::check_bound;

/// Radial oscillation of a laminated tube or spherical shell under a given difference of normal stresses: an equation for integrators.
///
/// ```text
/// sphere  y = (⅓ r₀³, r₀² ṙ₀)        tube  y = (½ r₀², r₀ ṙ₀)
/// ```
///
/// # Example
/// A shell released from an inflated state swings through its rest.
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance};
/// use piola_solids::isochoric::NeoHookean;
/// use piola_uniformity::laminated::{HomogeneousTube, LaminatedSphere, LaminatedOscillation};
/// let shell = LaminatedSphere::new(HomogeneousTube, [1.0, 1.25])?;
/// let law = NeoHookean::new(1.0)?;
/// let mut swing = LaminatedOscillation::of_sphere(&shell, &law, 1.0, 0.0)?;
/// let mut state = State::new(0.0, swing.at_rest_with_radius(1.2).to_vec())?;
/// let energy = swing.energy([state.values[0], state.values[1]])?;
/// DormandPrince853::new(Tolerance::relative(1e-9)?).integrate_to(&mut swing, &mut state, 1.0)?;
/// let later = swing.energy([state.values[0], state.values[1]])?;
/// assert!((later / energy - 1.0).abs() < 1e-7 && state.values[1] != 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// J. K. Knowles, *Large amplitude oscillations of a tube of incompressible elastic material* (1960), for metrics that vary with R.
#[derive(Clone, Copy, Debug)]
pub struct LaminatedOscillation<'a, A, I> {
    shape: Shape<'a, A>,
    law: &'a I,
    density: f64,
    difference: f64,
}

#[derive(Clone, Copy, Debug)]
enum Shape<'a, A> {
    Sphere(&'a LaminatedSphere<A>),
    Tube(&'a LaminatedTube<A>, [[f64; 2]; 2]),
}

impl<'a, A: Lamination, I: Isochoric> LaminatedOscillation<'a, A, I> {
    /// Of a shell of density ρ, kg/m³, with `T_rr` at the outer less at the inner face given, Pa.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] unless 0 < ρ; [`UniformityError::NotFinite`].
    pub fn of_sphere(
        sphere: &'a LaminatedSphere<A>,
        law: &'a I,
        density: f64,
        difference: f64,
    ) -> Result<Self, UniformityError> {
        Self::of(Shape::Sphere(sphere), law, density, difference)
    }

    /// Of a tube, (θ, z) = `matrix` (Θ, Z) at rest.
    ///
    /// # Errors
    /// As [`of_sphere`](Self::of_sphere); [`UniformityError::OutOfBounds`] unless 0 < Δ.
    pub fn of_tube(
        tube: &'a LaminatedTube<A>,
        matrix: [[f64; 2]; 2],
        law: &'a I,
        density: f64,
        difference: f64,
    ) -> Result<Self, UniformityError> {
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        check_bound("Δ", determinant, "0 < Δ", 0.0 < determinant)?;
        Self::of(Shape::Tube(tube, matrix), law, density, difference)
    }

    fn of(shape: Shape<'a, A>, law: &'a I, density: f64, difference: f64) -> Result<Self, UniformityError> {
        check_bound("density", density, "0 < ρ", 0.0 < density)?;
        check_bound("difference of normal stresses", difference, "finite", true)?;
        Ok(Self { shape, law, density, difference })
    }

    /// y at rest with the inner radius r₀, m.
    #[must_use]
    pub fn at_rest_with_radius(&self, radius: f64) -> [f64; 2] {
        match self.shape {
            Shape::Sphere(_) => [radius.powi(3) / 3.0, 0.0],
            Shape::Tube(..) => [0.5 * radius * radius, 0.0],
        }
    }

    /// The inner radius r₀ of y, m.
    #[must_use]
    pub fn radius(&self, [volume, _]: [f64; 2]) -> f64 {
        match self.shape {
            Shape::Sphere(_) => (3.0 * volume).cbrt(),
            Shape::Tube(..) => (2.0 * volume).sqrt(),
        }
    }

    /// Kinetic and stored energy, J for a unit of solid angle of a sphere, of Θ and Z of a tube; constant without a difference of normal
    /// stresses.
    ///
    /// # Errors
    /// What the state refuses.
    pub fn energy(&self, y: [f64; 2]) -> Result<f64, UniformityError> {
        let radius = self.radius(y);
        let speed = y[1];
        match self.shape {
            Shape::Sphere(sphere) => {
                let state = sphere.inflated(radius)?;
                let outer = state.radius(sphere.depths.outer)?;
                let kinetic = 0.5 * self.density * speed * speed * (radius.recip() - outer.recip());
                let faces = (sphere.depths.inner, sphere.depths.outer);
                let [stored] = integrate(sphere.lamination.interfaces(), faces, [0.0], |depth| {
                    let strain = state.left_cauchy_green(depth)?.components;
                    let lamina = sphere.lamination.metric(depth);
                    Ok([self.stored(strain) * lamina.normal * lamina.in_plane[0]])
                })?;
                Ok(kinetic + stored)
            }
            Shape::Tube(tube, matrix) => {
                let state = tube.inflated(radius, matrix)?;
                let outer = state.place([tube.radii()[1], 0.0, 0.0])?[0];
                let kinetic = 0.5 * self.density * speed * speed * (outer / radius).ln() * state.determinant;
                let faces = (tube.radii()[0], tube.radii()[1]);
                let [stored] = integrate(tube.lamination().interfaces(), faces, [0.0], |depth| {
                    let strain = state.left_cauchy_green(depth)?.components;
                    Ok([self.stored(strain) * tube.lamination().metric(depth).volume()])
                })?;
                Ok(kinetic + stored)
            }
        }
    }

    /// W of B, whose determinant is one.
    fn stored(&self, [b11, b22, b33, _, b23, _]: [f64; 6]) -> f64 {
        let area = b22 * b33 - b23 * b23;
        let (first, second) = (b11 + b22 + b33, b11.recip() + (b22 + b33) / area);
        self.law.energy(first - 3.0, second - 3.0)
    }
}

impl<A: Lamination, I: Isochoric> Field for LaminatedOscillation<'_, A, I> {
    type Error = UniformityError;

    fn dimension(&self) -> usize {
        2
    }

    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), UniformityError> {
        let (radius, speed) = (self.radius([y[0], y[1]]), y[1]);
        let square = 0.5 * speed * speed;
        rate[0] = speed;
        rate[1] = match self.shape {
            Shape::Sphere(sphere) => {
                let state = sphere.inflated(radius)?;
                let outer = state.radius(sphere.depths.outer)?;
                let drive = (self.difference - state.normal_stress_difference(self.law)?) / self.density;
                (drive + square * (radius.powi(-4) - outer.powi(-4))) / (radius.recip() - outer.recip())
            }
            Shape::Tube(tube, matrix) => {
                let state = tube.inflated(radius, matrix)?;
                let outer = state.place([tube.radii()[1], 0.0, 0.0])?[0];
                let drive = (self.difference - state.loads(self.law, 0.0)?.normal_stress_difference) / self.density;
                (drive + square * (radius.powi(-2) - outer.powi(-2))) / (outer / radius).ln()
            }
        };
        Ok(())
    }
}
