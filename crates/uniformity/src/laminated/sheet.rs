//! Plates and tubes: bodies whose metric depends on one of three coordinates, and is mapped linearly in the two others.

use piola_solids::isochoric::Isochoric;
use piola_tensor::{Rows, Symmetric};

use super::{
    Depths, LaminaMetric, LaminaStress, Lamination, check_lamina, extra_stress, integrate, sizes, stress_with,
};
use crate::UniformityError;
use crate::error::{check_bound, check_finite};

/// A laminated plate in the coordinates X, Y, Z, its metric a function of X, W(29.27).
///
/// # Example
/// A homogeneous plate of thickness 1 is bent to a quarter ring of inner radius 1; the middle keeps its length.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_uniformity::laminated::{HomogeneousPlate, LaminatedPlate};
/// let plate = LaminatedPlate::new(HomogeneousPlate, [0.0, 1.0])?;
/// // θ = Y/1.5, z = Z: r² = 1 + 2 × 1.5 X
/// let ring = plate.bent(1.0, [[1.0 / 1.5, 0.0], [0.0, 1.0]])?;
/// assert!((ring.place([1.0, 0.0, 0.0])?[0] - 2.0_f64).abs() < 1e-15);
/// let law = NeoHookean::new(1.0)?;
/// let inside = ring.stress(&law, 0.0, 0.0)?.cauchy.0.components;
/// // B_rr = (r'(0))² = 2.25, B_θθ = (r/1.5)² = 1/2.25: the inside is compressed.
/// assert!((inside[1] - (1.0 / 2.25 - 2.25_f64)).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminatedPlate<A> {
    sheet: Sheet<A>,
}

/// A laminated tube in the coordinates R, Θ, Z, its metric a function of R, W(29.31).
///
/// # Example
/// A homogeneous tube, inflated so that its inner radius doubles at fixed length: r² = R² + 3.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_uniformity::laminated::{HomogeneousTube, LaminatedTube};
/// let tube = LaminatedTube::new(HomogeneousTube, [1.0, 2.0])?;
/// let inflated = tube.inflated(2.0, [[1.0, 0.0], [0.0, 1.0]])?;
/// assert!((inflated.place([2.0, 0.0, 0.0])?[0] - 7.0_f64.sqrt()).abs() < 1e-15);
/// let loads = inflated.loads(&NeoHookean::new(1.0)?, 0.0)?;
/// // ΔT_rr = ∫ (r²/R² − R²/r²) dr/r = ln 2 − ½ ln(7/4) + 9/56
/// let by_hand = 2.0_f64.ln() - 0.5 * 1.75_f64.ln() + 9.0 / 56.0;
/// assert!((loads.normal_stress_difference - by_hand).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaminatedTube<A> {
    sheet: Sheet<A>,
}

/// What plates and tubes share: the faces and the metric.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sheet<A> {
    lamination: A,
    depths: Depths,
}

/// What a sheet becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Image {
    Plane,
    Cylinder,
}

impl<A: Lamination> Sheet<A> {
    fn new(lamination: A, [inner, outer]: [f64; 2]) -> Result<Self, UniformityError> {
        let depths = Depths::new(inner, outer)?;
        for depth in [inner, f64::midpoint(inner, outer), outer] {
            // A tube may begin on its axis, where h₁₁ = R² vanishes.
            if inner < depth {
                check_lamina(&lamination.metric(depth))?;
            }
        }
        Ok(Self { lamination, depths })
    }

    fn state(&self, image: Image, origin: f64, matrix: [[f64; 2]; 2]) -> Result<SheetState<&A>, UniformityError> {
        check_bound("origin", origin, "finite", true)?;
        check_finite("matrix", matrix.as_flattened())?;
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        check_bound("Δ", determinant, "Δ ≠ 0", 0.0 < determinant.abs())?;
        let state =
            SheetState { lamination: &self.lamination, depths: self.depths, image, origin, matrix, determinant };
        if image == Image::Cylinder {
            check_bound("radius", origin, "0 ≤ r", 0.0 <= origin)?;
            let square = origin * origin + 2.0 * state.volume_to(self.depths.outer)? / determinant;
            check_bound("square of the radius", square, "0 ≤ r^2", 0.0 <= square)?;
        }
        Ok(state)
    }
}

impl<A: Lamination> LaminatedPlate<A> {
    /// By its metric and the depths X of its faces, m.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] unless the depths increase and the metric is positive definite; [`UniformityError::NotFinite`].
    pub fn new(lamination: A, faces: [f64; 2]) -> Result<Self, UniformityError> {
        Ok(Self { sheet: Sheet::new(lamination, faces)? })
    }

    /// Family 0: x = x₀ + ∫√det M dX/Δ, (y, z) = `matrix` (Y, Z), W(29.28).
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] for Δ = 0, [`UniformityError::NotFinite`].
    pub fn flat(&self, origin: f64, matrix: [[f64; 2]; 2]) -> Result<SheetState<&A>, UniformityError> {
        self.sheet.state(Image::Plane, origin, matrix)
    }

    /// Family 1: r² = r₀² + 2 ∫√det M dX/Δ, (θ, z) = `matrix` (Y, Z), W(29.30).
    ///
    /// # Errors
    /// As [`flat`](Self::flat), and where r² < 0.
    pub fn bent(&self, radius: f64, matrix: [[f64; 2]; 2]) -> Result<SheetState<&A>, UniformityError> {
        self.sheet.state(Image::Cylinder, radius, matrix)
    }
}

impl<A: Lamination> LaminatedTube<A> {
    /// By its metric in the coordinates R, Θ, Z and the radii R of its faces, m.
    ///
    /// # Errors
    /// As [`LaminatedPlate::new`]; [`UniformityError::OutOfBounds`] for a negative radius.
    pub fn new(lamination: A, radii: [f64; 2]) -> Result<Self, UniformityError> {
        check_bound("inner radius", radii[0], "0 ≤ R", 0.0 <= radii[0])?;
        Ok(Self { sheet: Sheet::new(lamination, radii)? })
    }

    /// Family 2: x = x₀ + ∫√det M dR/Δ, (y, z) = `matrix` (Θ, Z), W(29.32).
    ///
    /// # Errors
    /// As [`LaminatedPlate::flat`].
    pub fn straightened(&self, origin: f64, matrix: [[f64; 2]; 2]) -> Result<SheetState<&A>, UniformityError> {
        self.sheet.state(Image::Plane, origin, matrix)
    }

    /// Family 3: r² = r₀² + 2 ∫√det M dR/Δ, (θ, z) = `matrix` (Θ, Z), W(29.34). Everted where Δ < 0; r₀ is then the outer radius.
    ///
    /// # Errors
    /// As [`LaminatedPlate::bent`].
    pub fn inflated(&self, radius: f64, matrix: [[f64; 2]; 2]) -> Result<SheetState<&A>, UniformityError> {
        self.sheet.state(Image::Cylinder, radius, matrix)
    }
}

/// Parts that other files of this folder need.
impl<A> LaminatedPlate<A> {
    pub(super) const fn faces(&self) -> [f64; 2] {
        [self.sheet.depths.inner, self.sheet.depths.outer]
    }
    pub(super) const fn lamination(&self) -> &A {
        &self.sheet.lamination
    }
}

/// Parts that other files of this folder need.
impl<A> LaminatedTube<A> {
    pub(super) const fn radii(&self) -> [f64; 2] {
        [self.sheet.depths.inner, self.sheet.depths.outer]
    }
    pub(super) const fn lamination(&self) -> &A {
        &self.sheet.lamination
    }
}

/// A laminated plate or tube in one of its universal deformations: places, strains, stresses and loads.
///
/// Physical components stand in the order x, y, z of a plane image and r, θ, z of a cylindrical one. The stress depends on the depth alone.
///
/// # Accuracy
/// Integrals through the depth to 256 ulp of their terms for smooth metrics; stresses to a few ulp of the moduli beyond that.
///
/// # Example
/// See [`LaminatedPlate`] and [`LaminatedTube`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetState<A> {
    pub(super) lamination: A,
    pub(super) depths: Depths,
    pub(super) image: Image,
    pub(super) origin: f64,
    pub(super) matrix: [[f64; 2]; 2],
    pub(super) determinant: f64,
}

/// What an experimenter measures on a laminated plate or tube, for a unit of the two coordinates along the laminae.
///
/// Of a plane image: forces in N/m and moments in N for a unit of length. Of a cylindrical image: for a radian and a unit of length.
///
/// # Example
/// See [`LaminatedTube`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SheetLoads {
    /// T₁₁ at the outer face less T₁₁ at the inner face, Pa: an inflating pressure of a tube. Zero of a plane image.
    pub normal_stress_difference: f64,
    /// Plane: ∫ `T_yy` dx, N/m. Cylinder: ∫ `T_θθ` dr, N/m, the hoop force.
    pub first_force: f64,
    /// Plane: ∫ `T_zz` dx, N/m. Cylinder: ∫ `T_zz` r dr, N/rad, the axial force.
    pub second_force: f64,
    /// Plane: ∫ `T_yz` dx, N/m. Cylinder: ∫ `T_θz` r² dr, N m/rad, the torque.
    pub shear: f64,
    /// Plane: ∫ `T_yy` x dx, N. Cylinder: ∫ `T_θθ` r dr, N, the bending moment.
    pub first_moment: f64,
    /// Plane: ∫ `T_zz` x dx, N. Cylinder: zero.
    pub second_moment: f64,
}

impl<A: Lamination> SheetState<A> {
    /// ∫√det M from the inner face to a depth.
    pub(super) fn volume_to(&self, depth: f64) -> Result<f64, UniformityError> {
        let interfaces = self.lamination.interfaces();
        let [volume] =
            integrate(interfaces, (self.depths.inner, depth), [0.0], |x| Ok([self.lamination.metric(x).volume()]))?;
        Ok(volume)
    }

    /// x or r at a depth.
    fn across(&self, depth: f64) -> Result<f64, UniformityError> {
        let advance = self.volume_to(depth)? / self.determinant;
        Ok(match self.image {
            Image::Plane => self.origin + advance,
            Image::Cylinder => (self.origin * self.origin + 2.0 * advance).sqrt(),
        })
    }

    /// The present coordinates (x, y, z) or (r, θ, z) of the particle with coordinates (X, Y, Z) or (R, Θ, Z).
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] for a depth outside the faces; [`UniformityError::NotFinite`].
    pub fn place(&self, [depth, first, second]: [f64; 3]) -> Result<[f64; 3], UniformityError> {
        self.depths.check(depth)?;
        let [[b, c], [d, e]] = self.matrix;
        Ok([self.across(depth)?, b * first + c * second, d * first + e * second])
    }

    /// F with physical components in the present, and coordinate components in the reference.
    ///
    /// # Errors
    /// As [`place`](Self::place).
    pub fn gradient(&self, depth: f64) -> Result<Rows<f64>, UniformityError> {
        self.depths.check(depth)?;
        let (lamina, across) = (self.lamination.metric(depth), self.across(depth)?);
        let radius = self.radius_at(across);
        let [[b, c], [d, e]] = self.matrix;
        let normal = lamina.volume() / (self.determinant * radius);
        Ok([[normal, 0.0, 0.0], [0.0, radius * b, radius * c], [0.0, d, e]])
    }

    /// `B^ij = x^i_A M^AB x^j_B` in physical components: the strain from the natural state, det B = 1.
    ///
    /// # Errors
    /// As [`place`](Self::place); [`UniformityError::OutOfBounds`] where the metric is not positive definite.
    pub fn left_cauchy_green(&self, depth: f64) -> Result<Symmetric, UniformityError> {
        self.depths.check(depth)?;
        let lamina = self.lamination.metric(depth);
        check_lamina(&lamina)?;
        let (normal, [b22, b33, b23]) = self.strain(&lamina, self.across(depth)?);
        Ok(Symmetric { components: [normal, b22, b33, 0.0, b23, 0.0] })
    }

    /// T at a depth, with T₁₁ given at the inner face, Pa.
    ///
    /// # Errors
    /// As [`left_cauchy_green`](Self::left_cauchy_green), and what the law refuses.
    pub fn stress(
        &self,
        law: &impl Isochoric,
        depth: f64,
        normal_stress: f64,
    ) -> Result<LaminaStress, UniformityError> {
        self.depths.check(depth)?;
        check_bound("T11", normal_stress, "finite", true)?;
        let change = match self.image {
            Image::Plane => 0.0,
            Image::Cylinder => {
                let interfaces = self.lamination.interfaces();
                let [terms, ..] = self.terms(law)?;
                let range = (self.depths.inner, depth);
                let [change] = integrate(interfaces, range, [terms], |x| Ok([self.rates(law, x)?.normal_stress]))?;
                change
            }
        };
        check_lamina(&self.lamination.metric(depth))?;
        let extra = self.extra_stress_at(law, depth)?.0;
        Ok(stress_with(&extra, normal_stress + change))
    }

    /// Forces and moments with T₁₁ given at the inner face, Pa.
    ///
    /// # Errors
    /// What the law refuses at some depth; [`UniformityError::NotConverged`].
    pub fn loads(&self, law: &impl Isochoric, normal_stress: f64) -> Result<SheetLoads, UniformityError> {
        check_bound("T11", normal_stress, "finite", true)?;
        let (interfaces, faces) = (self.lamination.interfaces(), (self.depths.inner, self.depths.outer));
        match self.image {
            Image::Plane => {
                let (extra, across, slope) = self.extra_stress_at(law, self.depths.middle())?;
                let size = sizes(&extra) * (self.depths.outer - self.depths.inner) * slope.abs();
                let moment = size * across.abs();
                let terms = [size, size, size, moment, moment];
                let [first_force, second_force, shear, first_moment, second_moment] =
                    integrate(interfaces, faces, terms, |depth| {
                        let (extra, across, slope) = self.extra_stress_at(law, depth)?;
                        let [t22, t33] = [1, 2].map(|i: usize| extra[i][i] - extra[0][0] + normal_stress);
                        Ok([t22, t33, extra[1][2], t22 * across, t33 * across].map(|x| x * slope.abs()))
                    })?;
                let normal_stress_difference = 0.0;
                Ok(SheetLoads {
                    normal_stress_difference,
                    first_force,
                    second_force,
                    shear,
                    first_moment,
                    second_moment,
                })
            }
            Image::Cylinder => {
                let terms = self.terms(law)?;
                let [difference, axial, torque, hoop] = integrate(interfaces, faces, terms, |depth| {
                    let rates = self.rates(law, depth)?;
                    Ok([rates.normal_stress, rates.axial, rates.torque, rates.hoop])
                })?;
                let (inner, outer) = (self.origin, self.across(self.depths.outer)?);
                let outer_stress = normal_stress + difference;
                // ∫ T_rr r dr by parts; dr is counted from the inner face, and an everted tube runs inwards.
                let ends = 0.5 * (outer * outer * outer_stress - inner * inner * normal_stress);
                let sign = self.determinant.signum();
                Ok(SheetLoads {
                    normal_stress_difference: difference,
                    first_force: sign * (outer * outer_stress - inner * normal_stress),
                    second_force: sign * (ends + axial),
                    shear: sign * torque,
                    first_moment: sign * (ends + 0.5 * hoop),
                    second_moment: 0.0,
                })
            }
        }
    }

    /// r of a cylindrical image, 1 of a plane one.
    fn radius_at(&self, across: f64) -> f64 {
        match self.image {
            Image::Plane => 1.0,
            Image::Cylinder => across,
        }
    }

    /// B₁₁, [B₂₂, B₃₃, B₂₃].
    fn strain(&self, lamina: &LaminaMetric, across: f64) -> (f64, [f64; 3]) {
        let [h11, h22, h12] = lamina.in_plane;
        let square = lamina.area_squared();
        let radius = self.radius_at(across);
        let [[b, c], [d, e]] = self.matrix;
        // h⁻¹ = [[h22, −h12], [−h12, h11]]/square
        let form = |[p, q]: [f64; 2], [r, s]: [f64; 2]| (p * r * h22 - (p * s + q * r) * h12 + q * s * h11) / square;
        let (first, second) = ([radius * b, radius * c], [d, e]);
        let normal = square / (self.determinant * radius).powi(2);
        (normal, [form(first, first), form(second, second), form(first, second)])
    }

    /// N, x or r, and d(x or r)/dX.
    fn extra_stress_at(&self, law: &impl Isochoric, depth: f64) -> Result<(Rows<f64>, f64, f64), UniformityError> {
        let (lamina, across) = (self.lamination.metric(depth), self.across(depth)?);
        let (normal, in_plane) = self.strain(&lamina, across);
        let slope = lamina.volume() / (self.determinant * self.radius_at(across));
        Ok((extra_stress(law, normal, in_plane)?, across, slope))
    }

    /// The sizes of the terms of the integrals of a cylindrical image, by the middle of the wall.
    fn terms(&self, law: &impl Isochoric) -> Result<[f64; 4], UniformityError> {
        let (extra, radius, slope) = self.extra_stress_at(law, self.depths.middle())?;
        let size = sizes(&extra) * (self.depths.outer - self.depths.inner) * slope.abs();
        Ok([size / radius, size * radius, size * radius * radius, size * radius])
    }

    /// Integrands over the depth of a cylindrical image.
    fn rates(&self, law: &impl Isochoric, depth: f64) -> Result<CylinderRates, UniformityError> {
        let (extra, radius, slope) = self.extra_stress_at(law, depth)?;
        let hoop = extra[1][1] - extra[0][0];
        Ok(CylinderRates {
            normal_stress: hoop / radius * slope,
            axial: (extra[2][2] - extra[0][0] - 0.5 * hoop) * radius * slope,
            torque: extra[1][2] * radius * radius * slope,
            hoop: hoop * radius * slope,
        })
    }
}

/// Equilibrium, `dT_rr/dr` = (`T_θθ` − `T_rr`)/r, and the loads that follow by parts.
struct CylinderRates {
    normal_stress: f64,
    axial: f64,
    torque: f64,
    hoop: f64,
}
