//! Laminated bodies: isotropic, incompressible, their metric a function of one coordinate, and their universal solutions.
//!
//! ```text
//! plate    M = m² dX² + h_ab dY^a dY^b,  Y = (Y, Z)          functions of X       W(29.27)
//! tube     M = m² dR² + h_ab dY^a dY^b,  Y = (Θ, Z)          functions of R       W(29.31)
//! sphere   M = m² dR² + h² (dΘ² sin²Φ + dΦ²)                 functions of R       W(29.36)
//! ```
//!
//! Each can be deformed by surface tractions alone, whatever its law:
//!
//! | body | family | becomes | make it by |
//! |---|---|---|---|
//! | [`LaminatedPlate`] | 0 | a plate, x = x₀ + ∫√det M dX/Δ | [`flat`](LaminatedPlate::flat) |
//! | | 1 | a part of a tube, r² = r₀² + 2 ∫√det M dX/Δ | [`bent`](LaminatedPlate::bent) |
//! | [`LaminatedTube`] | 2 | a plate | [`straightened`](LaminatedTube::straightened) |
//! | | 3 | a tube: inflated, twisted, extended, everted | [`inflated`](LaminatedTube::inflated) |
//! | [`LaminatedSphere`] | 4 | a sphere: inflated, everted | [`inflated`](LaminatedSphere::inflated) |
//!
//! The other two coordinates are mapped linearly by a matrix with the determinant Δ. Stresses are T = −p 1 + g₁ B + g₋₁ B⁻¹ with
//! `B^ij = x^i_A M^AB x^j_B`, W(29.25); any [`Isochoric`] energy is a law. A body that is left to itself is in
//! [residual stress](LaminatedSphere::at_rest).
//!
//! Parameters may depend on time where the acceleration has a potential, W p. 196: see [`SheetMotion`] and [`LaminatedOscillation`].

mod motion;
mod oscillation;
mod rest;
mod sheet;
mod sphere;

pub use motion::{SheetHistory, SheetMotion};
pub use oscillation::LaminatedOscillation;
pub use rest::RestState;
pub use sheet::{LaminatedPlate, LaminatedTube, SheetLoads, SheetState};
pub use sphere::{LaminatedSphere, SphereState};

use piola_continuum::CauchyStress;
use piola_numerics::Real;
use piola_numerics::quadrature::{self, Ending, GaussKronrod, Growing, Quadpack};
use piola_solids::isochoric::Isochoric;
use piola_tensor::{Rows, Symmetric};

use crate::UniformityError;
use crate::error::check_bound;

/// The natural lengths of one lamina: the metric of a laminated body at a depth.
///
/// # Example
/// A lamina of a homogeneous tube at R = 2, in the coordinates R, Θ, Z.
/// ```
/// use piola_uniformity::laminated::LaminaMetric;
/// let lamina = LaminaMetric { normal: 1.0, in_plane: [4.0, 1.0, 0.0] };
/// assert_eq!(lamina.volume(), 2.0); // √det M = R
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminaMetric<T = f64> {
    /// m: natural length across the laminae for a unit of depth.
    pub normal: T,
    /// h₁₁, h₂₂, h₁₂: natural lengths in the lamina.
    pub in_plane: [T; 3],
}

impl<T: Real> LaminaMetric<T> {
    /// √det M.
    #[must_use]
    pub fn volume(&self) -> T {
        self.normal * self.area_squared().sqrt()
    }

    /// h₁₁ h₂₂ − h₁₂².
    fn area_squared(&self) -> T {
        let [first, second, mixed] = self.in_plane;
        first * second - mixed * mixed
    }
}

/// The metric of a plate or a tube as a function of the depth X or R.
///
/// # Example
/// A plate that has swollen in its plane by 1 + X/10.
/// ```
/// use piola_numerics::Real;
/// use piola_uniformity::laminated::{LaminaMetric, Lamination};
/// struct Swollen;
/// impl Lamination for Swollen {
///     fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
///         let length = T::one() + T::lit(0.1) * depth;
///         LaminaMetric { normal: T::one(), in_plane: [length * length, length * length, T::zero()] }
///     }
/// }
/// assert!((Swollen.metric(1.0).volume() - 1.21_f64).abs() < 1e-15);
/// ```
pub trait Lamination {
    /// The metric at a depth.
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T>;

    /// Depths at which the metric jumps, increasing: the interfaces between layers.
    fn interfaces(&self) -> &[f64] {
        &[]
    }
}

impl<A: Lamination + ?Sized> Lamination for &A {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        (**self).metric(depth)
    }
    fn interfaces(&self) -> &[f64] {
        (**self).interfaces()
    }
}

/// A homogeneous plate: M = 1 in the coordinates X, Y, Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HomogeneousPlate;

impl Lamination for HomogeneousPlate {
    fn metric<T: Real>(&self, _depth: T) -> LaminaMetric<T> {
        LaminaMetric { normal: T::one(), in_plane: [T::one(), T::one(), T::zero()] }
    }
}

/// A homogeneous tube: M = diag(1, R², 1) in the coordinates R, Θ, Z. As a lamination of a sphere: h = R.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HomogeneousTube;

impl Lamination for HomogeneousTube {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        LaminaMetric { normal: T::one(), in_plane: [depth * depth, T::one(), T::zero()] }
    }
}

/// The stress of a lamina, in physical components of the present coordinates: see [`LaminatedPlate`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LaminaStress {
    /// T, Pa: of a plate in x, y, z; of a tube in r, θ, z; of a sphere in r and the two angles.
    pub cauchy: CauchyStress,
    /// p of T = −p 1 + g₁ B + g₋₁ B⁻¹, Pa.
    pub pressure: f64,
}

/// The depths of the faces of a laminated body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Depths {
    inner: f64,
    outer: f64,
}

impl Depths {
    fn new(inner: f64, outer: f64) -> Result<Self, UniformityError> {
        check_bound("inner depth", inner, "finite", true)?;
        check_bound("outer depth", outer, "inner depth < outer depth", inner < outer)?;
        Ok(Self { inner, outer })
    }

    const fn middle(self) -> f64 {
        f64::midpoint(self.inner, self.outer)
    }

    fn check(self, depth: f64) -> Result<(), UniformityError> {
        check_bound("depth", depth, "inner depth ≤ depth ≤ outer depth", self.inner <= depth && depth <= self.outer)
    }
}

/// Refuses a lamina whose metric is not positive definite.
fn check_lamina(lamina: &LaminaMetric) -> Result<(), UniformityError> {
    check_bound("m", lamina.normal, "0 < m", 0.0 < lamina.normal)?;
    check_bound("h11", lamina.in_plane[0], "0 < h11", 0.0 < lamina.in_plane[0])?;
    let square = lamina.area_squared();
    check_bound("h11 h22 - h12^2", square, "0 < h11 h22 - h12^2", 0.0 < square)
}

/// Panels of a quadrature through the depth.
const PANELS: usize = 1024;
/// The error allowed of a quadrature, of the size of its terms: what rounding of the sums leaves.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// The error that is accepted where halving panels helps no more.
const ACCEPTED: f64 = 1e-10;

/// ∫ f dX from one depth to another, layer by layer. Errors are relative to ∫ |f| dX or to `terms`, the size of what f is a difference of.
fn integrate<const N: usize>(
    interfaces: &[f64],
    (from, to): (f64, f64),
    terms: [f64; N],
    f: impl FnMut(f64) -> Result<[f64; N], UniformityError>,
) -> Result<[f64; N], UniformityError> {
    let mut f = f;
    let (low, high) = (from.min(to), from.max(to));
    let mut ends = vec![low];
    ends.extend(interfaces.iter().copied().filter(|depth| low < *depth && *depth < high));
    ends.push(high);
    let parts = ends.windows(2).map(|pair| (pair[0], pair[1]));
    let scale = |sizes: &[f64; N]| -> [f64; N] { core::array::from_fn(|i| sizes[i].max(terms[i])) };
    let allowed = |_values: &[f64; N], sizes: &[f64; N]| scale(sizes).map(|size| ROUNDING * size);
    let mut panels = Growing::up_to(PANELS);
    let method = (&GaussKronrod::POINTS_21, &Quadpack);
    let found = quadrature::integrate(&mut panels, parts, method, &allowed, |_, depth| f(depth))?;
    if let Ending::NotFinite { value, component: index, .. } = found.ending {
        return Err(UniformityError::NotFinite { quantity: "integral over the depth", index, value });
    }
    for (&error, size) in found.errors.iter().zip(scale(&found.sizes)) {
        let (quantity, allowed) = ("integral over the depth", ACCEPTED * size);
        let is_small = error <= allowed;
        if !is_small {
            return Err(UniformityError::NotConverged { quantity, error, allowed });
        }
    }
    let sign = if from <= to { 1.0 } else { -1.0 };
    Ok(found.values.map(|value| sign * value))
}

/// N = g₁ B + g₋₁ B⁻¹, the stress up to a pressure, of B in two blocks: `normal`, and [b₂₂, b₃₃, b₂₃] in the lamina.
fn extra_stress(law: &impl Isochoric, normal: f64, in_plane: [f64; 3]) -> Result<Rows<f64>, UniformityError> {
    let [b22, b33, b23] = in_plane;
    let area = b22 * b33 - b23 * b23;
    let inverse = [normal.recip(), b33 / area, b22 / area, -b23 / area];
    let first = normal + b22 + b33;
    let second = inverse[0] + inverse[1] + inverse[2];
    law.check(first - 3.0, second - 3.0)?;
    let [w1, w2] = law.slopes(first - 3.0, second - 3.0);
    let (g1, g2) = (2.0 * w1, -2.0 * w2);
    let n23 = g1 * b23 + g2 * inverse[3];
    Ok([
        [g1 * normal + g2 * inverse[0], 0.0, 0.0],
        [0.0, g1 * b22 + g2 * inverse[1], n23],
        [0.0, n23, g1 * b33 + g2 * inverse[2]],
    ])
}

/// |N₁₁| + |N₂₂| + |N₃₃|: what stresses are differences of.
fn sizes(extra: &Rows<f64>) -> f64 {
    extra[0][0].abs() + extra[1][1].abs() + extra[2][2].abs()
}

/// T = N − p 1 with a given T₁₁.
fn stress_with(extra: &Rows<f64>, normal_stress: f64) -> LaminaStress {
    let pressure = extra[0][0] - normal_stress;
    let cauchy = CauchyStress(Symmetric {
        components: [
            normal_stress,
            extra[1][1] - pressure,
            extra[2][2] - pressure,
            extra[0][1],
            extra[1][2],
            extra[0][2],
        ],
    });
    LaminaStress { cauchy, pressure }
}
