//! What an analysis of the stretches gives: stretches, axes, R, U, V, their logarithms and functions.

use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::Rows;
use piola_tensor::internal::spectral::{axes_in_order, combination, descending, in_order, lifted, turned};
use piola_tensor::spectral::{IsotropicFunction, Logarithm};

use super::{StretchAnalysis, outer_products};
use crate::Symmetric;

impl<T: Real> StretchAnalysis<T> {
    /// The principal stretches λ₁ ≥ λ₂ ≥ λ₃, W(14.12).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal_stretches(&self) -> [T; 3] {
        if T::ORDER == 0 {
            return descending(self.stretches);
        }
        descending(lifted(self.frame_stretch()).0).map(|excess| self.shift + excess)
    }

    /// ln λₖ, descending, accurate for λ → 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn log_principal_stretches(&self) -> [T; 3] {
        if T::ORDER == 0 {
            return descending(self.values_at_stretches(&Logarithm));
        }
        let excess = descending(lifted(self.frame_stretch()).0);
        excess.map(|x| {
            let beside = if self.small.any() { x.ln_1p() } else { x };
            let plain = if self.small.all() { beside } else { x.ln() };
            T::select(self.small, beside, plain)
        })
    }

    /// The principal values (λₖ² − 1)/2 of Green's strain, descending, accurate for λ → 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal_green_strains(&self) -> [T; 3] {
        let excess = if T::ORDER == 0 { self.excess } else { lifted(self.frame_stretch()).0 };
        let half = T::lit(0.5);
        descending(excess.map(|x| {
            let small = half * (x * (x + T::lit(2.0)));
            T::select(self.small, small, half * ((x - T::one()) * (x + T::one())))
        }))
    }

    /// The principal axes of U and C in the reference body: unit vectors by rows, right-handed, in the order of the
    /// stretches.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material_axes(&self) -> Rows<T> {
        let axes = if T::ORDER == 0 { self.axes } else { turned(&self.axes, lifted(self.frame_stretch()).1) };
        axes_in_order(self.first, axes)
    }

    /// The principal axes of V and B in space: the material axes turned by R, by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spatial_axes(&self) -> Rows<T> {
        let turned_frame = self.turned_frame();
        let axes = if T::ORDER == 0 { turned_frame } else { turned(&turned_frame, lifted(self.frame_stretch()).1) };
        axes_in_order(self.first, axes)
    }

    /// R of F = R U = V R, W(14.11).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rotation(&self) -> Rows<T> {
        let images = self.divided_images();
        let rest = outer_products(&images, &self.axes);
        if !self.small.any() {
            return rest;
        }
        let [a, b, c] = self.gradient;
        let (s, one) = (self.shift, T::one());
        [combination(s, a, one, rest[0]), combination(s, b, one, rest[1]), combination(s, c, one, rest[2])]
    }

    /// U = √C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_stretch(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.material(components, T::one(), self.shift + middle)
    }

    /// U − 1 (Biot's strain), without cancellation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_stretch_less_one(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.material(components, T::one(), (self.shift - T::one()) + middle)
    }

    /// U⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn inverse_right_stretch(&self) -> Symmetric<T> {
        self.material(self.frame_inverse(), T::zero(), self.shift)
    }

    /// V = √B = R U Rᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn left_stretch(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.spatial(components, T::one(), self.shift + middle)
    }

    /// V − 1, without cancellation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn left_stretch_less_one(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.spatial(components, T::one(), (self.shift - T::one()) + middle)
    }

    /// V⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn inverse_left_stretch(&self) -> Symmetric<T> {
        self.spatial(self.frame_inverse(), T::zero(), self.shift)
    }

    /// Hencky's strain ln U, accurate for U → 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn hencky_material(&self) -> Symmetric<T> {
        self.material_function(&Logarithm)
    }

    /// Hencky's strain ln V = R ln U Rᵀ in space.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn hencky_spatial(&self) -> Symmetric<T> {
        self.spatial_function(&Logarithm)
    }

    /// f(U) for a function f of the stretch.
    ///
    /// Near U = 1 it is as accurate as [`IsotropicFunction::value_beside_one`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let (components, slope) = self.frame_function(f);
        self.material(components, slope, T::zero())
    }

    /// f(V) = R f(U) Rᵀ for a function f of the stretch.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spatial_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let (components, slope) = self.frame_function(f);
        self.spatial(components, slope, T::zero())
    }

    /// (qₖ by rows, R qₖ by rows, S): a frame, its image, and U in it, diagonal but for rounding and derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn in_frame(&self) -> (Rows<T>, Rows<T>, [T; 6]) {
        let [xx, yy, zz, xy, yz, xz] = self.frame_stretch();
        let (first, shift) = (self.first, self.shift);
        let [xx, yy, zz] = in_order(first, [xx + shift, yy + shift, zz + shift]);
        // Turned about as the axes are: 12, 23, 31 become 23, 31, 12.
        let [xy, yz, xz] = in_order(first, [xy, yz, xz]);
        (axes_in_order(first, self.axes), axes_in_order(first, self.turned_frame()), [xx, yy, zz, xy, yz, xz])
    }
}
