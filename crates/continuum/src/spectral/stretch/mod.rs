//! The polar decomposition F = R U = V R and functions of the stretches, from one analysis of F.
//!
//! ```text
//! C = FᵀF = 1 + 2E = Σ λₖ² qₖ ⊗ qₖ        bₖ = F qₖ,   G = [bₖ · bₗ],   S = √G
//! U = Σ Sₖₗ qₖ ⊗ qₗ        R = Σ (S⁻¹)ₖₗ bₗ ⊗ qₖ        f(U) = Σ f(S)ₖₗ qₖ ⊗ qₗ
//! ```
//! G would be diagonal but for the rounding of the axes and, over differentiable scalars, for derivatives. What is
//! off its diagonal is carried to first order through each function by divided differences, which need no gap
//! between the stretches: results are as accurate as from a singular value decomposition of F although only a
//! symmetric problem is solved. Where the first order does not suffice (stretch ratios above some 10³) one-sided
//! rotations of Jacobi make the bₖ orthogonal first: the slow path, gated by a mask and reported.
//!
//! For small strain everything is computed from 2E of ∇u, as the difference from the rotation alone.

mod in_frame;

use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use self::in_frame::{departure_of, roots_of, skewed};
use super::decomposition::{descending, lifted, turned};
use super::frame::{axes_in_order, components_in, in_order, larger, largest_modulus, separated_frame};
use super::orthogonal_images::{orthogonalise, orthogonalise_apart};
use super::{IsotropicFunction, Logarithm};
use crate::tensor::rows::{Rows, apply, transpose};
use crate::{Deformation, Symmetric};

/// Strains with components up to this size are computed from ∇u and relative to the rotation.
const SMALL: f64 = 0.25;
/// Where the diagonal of 2E is below this, C has more digits.
const SHRUNK: f64 = -0.5;

/// The stretches, axes and rotation of a deformation: computed once, and each thing asked of it when it is asked.
///
/// # Accuracy
/// As a singular value decomposition of F: with the stretches λ₁ ≥ λ₂ ≥ λ₃ and ε = 2⁻⁵², R within a few
/// ε λ₁/(λ₂ + λ₃) and orthogonal within 8 ε, U within a few ε ‖U‖, ln U within a few ε λ₁/λ₃, all norm-wise and
/// whatever the gaps of the stretches. For small strain ln U and U − 1 are within a few ε of their own norm.
///
/// # Derivatives
/// Over scalars with derivatives all tensors have theirs up to the fourth order, finite at coalescence. Single
/// principal values and axes have them where the stretches are distinct.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
/// // Twice as long along 1, then turned by 90° about 3.
/// let f = DeformationGradient::new(Matrix3::new(0.0, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0))?;
/// let stretch = StretchAnalysis::of(&f);
/// assert_eq!(stretch.principal_stretches(), [2.0, 1.0, 1.0]);
/// assert_eq!(stretch.rotation(), [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
/// assert_eq!(stretch.hencky_material().components[0], 2.0_f64.ln());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct StretchAnalysis<T: Real = f64> {
    gradient: Rows<T>,
    displacement: Rows<T>,
    /// 2E.
    twice_green: Symmetric<T>,
    /// 2E, for small strain, or C in the frame of the axes.
    square: [T; 6],
    /// qₖ by rows, without derivatives.
    axes: Rows<T>,
    /// Where the first axis is that of the largest stretch, and not of the smallest.
    first: T::Mask,
    /// bₖ = F qₖ by rows.
    images: Rows<T>,
    /// Where the strain is small, and 1 or 0 accordingly: U is kept as its excess over this.
    small: T::Mask,
    shift: T,
    /// The diagonal of S, without derivatives.
    stretches: [T; 3],
    /// The diagonal of S less the shift, without derivatives.
    excess: [T; 3],
    /// What S has beyond that: rounding and derivatives.
    departure: [T; 6],
    slow: T::Mask,
}

/// 2E = H + Hᵀ + Hᵀ H, each rounding proportional to what it rounds also near pure rotations.
#[inline(always)]
fn twice_green<T: Real>(h: &Rows<T>) -> Symmetric<T> {
    let two = T::lit(2.0);
    let along = |i: usize, j: usize, k: usize| h[i][i] * (two + h[i][i]) + (h[j][i] * h[j][i] + h[k][i] * h[k][i]);
    let across = |i: usize, j: usize, k: usize| {
        (h[i][j] + h[j][i]) + ((h[i][i] * h[i][j] + h[j][i] * h[j][j]) + h[k][i] * h[k][j])
    };
    Symmetric {
        components: [along(0, 1, 2), along(1, 2, 0), along(2, 0, 1), across(0, 1, 2), across(1, 2, 0), across(0, 2, 1)],
    }
}

/// Gₖₗ = bₖ · bₗ for 11, 22, 33, 12, 23, 13.
#[inline(always)]
pub(super) fn gram<T: Real>([a, b, c]: &Rows<T>) -> [T; 6] {
    [dot(*a, *a), dot(*b, *b), dot(*c, *c), dot(*a, *b), dot(*b, *c), dot(*a, *c)]
}

/// Lane by lane and component by component.
#[inline(always)]
fn choose<T: Real>(mask: T::Mask, a: [T; 6], b: [T; 6]) -> [T; 6] {
    [
        T::select(mask, a[0], b[0]),
        T::select(mask, a[1], b[1]),
        T::select(mask, a[2], b[2]),
        T::select(mask, a[3], b[3]),
        T::select(mask, a[4], b[4]),
        T::select(mask, a[5], b[5]),
    ]
}

/// F qₖ by rows.
#[inline(always)]
fn images_of<T: Real>(gradient: Rows<T>, axes: &Rows<T>) -> Rows<T> {
    [apply(gradient, axes[0]), apply(gradient, axes[1]), apply(gradient, axes[2])]
}

#[inline(always)]
fn freeze<T: Real>(rows: Rows<T>) -> Rows<T> {
    if T::ORDER == 0 { rows } else { rows.map(|row| row.map(T::frozen)) }
}

impl<T: Real> StretchAnalysis<T> {
    /// Of F or ∇u.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DisplacementGradient, spectral::StretchAnalysis};
    /// let tiny = StretchAnalysis::of(&DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?);
    /// assert_eq!(tiny.right_stretch_less_one().components[0], 1e-20);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        let (gradient, displacement) = (deformation.gradient_rows(), deformation.displacement_rows());
        let twice_green = twice_green(&displacement);
        let green =
            if T::ORDER == 0 { twice_green } else { Symmetric { components: twice_green.components.map(T::frozen) } };
        let small = largest_modulus(green.components).at_most(T::lit(SMALL));
        // The frame of 2E or, where that is nearly −1 and a small stretch would be lost in it, of C.
        let [x, y, z, ..] = green.components;
        let shrunk = larger(larger(x, y), z).less_than(T::lit(SHRUNK));
        let measure = if shrunk.any() {
            let cauchy_green = gram(&freeze(transpose(gradient)));
            Symmetric { components: choose(shrunk, cauchy_green, green.components) }
        } else {
            green
        };

        let (mut axes, mut first) = separated_frame(&measure);
        if T::ORDER != 0 {
            (axes, first) = (freeze(axes_in_order(first, axes)), Mask::splat(true));
        }
        let mut images = images_of(gradient, &axes);
        // For small strain 2E in the frame, otherwise C.
        let mut square = if small.all() {
            components_in(&axes, &twice_green)
        } else if small.any() {
            choose(small, components_in(&axes, &twice_green), gram(&images))
        } else {
            gram(&images)
        };

        let mut roots = roots_of(small, &square);
        let mut slow = Mask::splat(false);
        if !small.all() {
            let enough = T::lit((0.125 * unit_in_last_place::<T>()).sqrt());
            let tilted = |i: usize, j: usize, place: usize| {
                (enough * (roots.0[i] * roots.0[j])).less_than(square[place].abs().frozen())
            };
            let skew =
                if T::ORDER == 0 { tilted(0, 1, 3) | tilted(1, 2, 4) | tilted(0, 2, 5) } else { skewed(&images) };
            slow = !small & skew;
            if slow.any() {
                // In lanes within, or it would not have their width.
                (axes, images) = if T::LANES == 1 {
                    orthogonalise_apart(slow, gradient, axes, images)
                } else {
                    orthogonalise(slow, gradient, axes, images)
                };
                square = choose(small, square, gram(&images));
                roots = roots_of(small, &square);
            }
        }
        let shift = T::select(small, T::one(), T::zero());
        let departure = departure_of(shift, &square, &roots.0, &roots.1);
        Self {
            gradient,
            displacement,
            twice_green,
            square,
            axes,
            first,
            images,
            small,
            shift,
            stretches: roots.0,
            excess: roots.1,
            departure,
            slow,
        }
    }

    /// Where the slow path was taken: about where λ₁² > 10⁸ λ₂ λ₃.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// assert!(!StretchAnalysis::<f64>::of(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?).slow_path());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn slow_path(&self) -> T::Mask {
        self.slow
    }

    /// The principal stretches λ₁ ≥ λ₂ ≥ λ₃, W(14.12).
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let stretches = StretchAnalysis::of(&DeformationGradient::diagonal([2.0, 1.0, 4.0])?).principal_stretches();
    /// assert!((stretches[0] - 4.0_f64).abs() < 1e-14 && (stretches[2] - 1.0).abs() < 1e-14);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn principal_stretches(&self) -> [T; 3] {
        if T::ORDER == 0 {
            return descending(self.stretches);
        }
        in_order(self.first, lifted(self.frame_stretch()).0).map(|excess| self.shift + excess)
    }

    /// ln λₖ, descending, accurate for λ → 1.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DisplacementGradient, spectral::StretchAnalysis};
    /// let tiny = DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?;
    /// let logarithms = StretchAnalysis::of(&tiny).log_principal_stretches();
    /// assert!((logarithms[0] / 1e-20 - 1.0_f64).abs() < 1e-15);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn log_principal_stretches(&self) -> [T; 3] {
        if T::ORDER == 0 {
            return descending(self.values_at_stretches(&Logarithm));
        }
        let excess = in_order(self.first, lifted(self.frame_stretch()).0);
        excess.map(|x| {
            let beside = if self.small.any() { x.ln_1p() } else { x };
            let plain = if self.small.all() { beside } else { x.ln() };
            T::select(self.small, beside, plain)
        })
    }

    /// The principal values (λₖ² − 1)/2 of Green's strain, descending, accurate for λ → 1.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let strains = StretchAnalysis::of(&DeformationGradient::diagonal([1.0, 2.0, 1.0])?).principal_green_strains();
    /// assert!((strains[0] - 1.5_f64).abs() < 1e-15); // ½ (2² − 1)
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
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
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let axes = StretchAnalysis::<f64>::of(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?).material_axes();
    /// assert!((axes[0][2].abs() - 1.0_f64).abs() < 1e-15); // the largest stretch is along 3
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn material_axes(&self) -> Rows<T> {
        let axes = if T::ORDER == 0 { self.axes } else { turned(&self.axes, lifted(self.frame_stretch()).1) };
        axes_in_order(self.first, axes)
    }

    /// The principal axes of V and B in space: the material axes turned by R, by rows.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// let axes = StretchAnalysis::<f64>::of(&turned).spatial_axes();
    /// assert!((axes[0][1].abs() - 1.0_f64).abs() < 1e-15); // from 1, turned to 2
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn spatial_axes(&self) -> Rows<T> {
        let turned_frame = self.turned_frame();
        let axes = if T::ORDER == 0 { turned_frame } else { turned(&turned_frame, lifted(self.frame_stretch()).1) };
        axes_in_order(self.first, axes)
    }

    /// R of F = R U = V R, W(14.11).
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(StretchAnalysis::of(&turned).rotation()[1], [1.0, 0.0, 0.0]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn rotation(&self) -> Rows<T> {
        let images = self.divided_images();
        let f = self.gradient;
        let beyond = self.small.any();
        let entry = |i: usize, j: usize| {
            let sum = images[0][i] * self.axes[0][j] + images[1][i] * self.axes[1][j] + images[2][i] * self.axes[2][j];
            if beyond { self.shift * f[i][j] + sum } else { sum }
        };
        [
            [entry(0, 0), entry(0, 1), entry(0, 2)],
            [entry(1, 0), entry(1, 1), entry(1, 2)],
            [entry(2, 0), entry(2, 1), entry(2, 2)],
        ]
    }

    /// U = √C.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(StretchAnalysis::of(&turned).right_stretch().components[..3], [2.0, 1.0, 1.0]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn right_stretch(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.material(components, T::one(), self.shift + middle)
    }

    /// U − 1 (Biot's strain), without cancellation.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DisplacementGradient, spectral::StretchAnalysis};
    /// let tiny = DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?;
    /// assert_eq!(StretchAnalysis::of(&tiny).right_stretch_less_one().components[0], 1e-20);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn right_stretch_less_one(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.material(components, T::one(), (self.shift - T::one()) + middle)
    }

    /// U⁻¹.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let inverse = StretchAnalysis::of(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).inverse_right_stretch();
    /// assert!((inverse.components[0] - 0.5_f64).abs() < 1e-15);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn inverse_right_stretch(&self) -> Symmetric<T> {
        self.material(self.frame_inverse(), T::zero(), self.shift)
    }

    /// V = √B = R U Rᵀ.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(StretchAnalysis::of(&turned).left_stretch().components[..3], [1.0, 2.0, 1.0]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn left_stretch(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.spatial(components, T::one(), self.shift + middle)
    }

    /// V − 1, without cancellation.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DisplacementGradient, spectral::StretchAnalysis};
    /// let tiny = DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?;
    /// assert_eq!(StretchAnalysis::of(&tiny).left_stretch_less_one().components[0], 1e-20);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn left_stretch_less_one(&self) -> Symmetric<T> {
        let (components, middle) = self.beyond_green();
        self.spatial(components, T::one(), (self.shift - T::one()) + middle)
    }

    /// V⁻¹.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert!((StretchAnalysis::of(&turned).inverse_left_stretch().components[1] - 0.5_f64).abs() < 1e-15);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn inverse_left_stretch(&self) -> Symmetric<T> {
        self.spatial(self.frame_inverse(), T::zero(), self.shift)
    }

    /// Hencky's strain ln U, accurate for U → 1.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(StretchAnalysis::of(&turned).hencky_material().components[0], 2.0_f64.ln());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn hencky_material(&self) -> Symmetric<T> {
        self.material_function(&Logarithm)
    }

    /// Hencky's strain ln V = R ln U Rᵀ in space.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::StretchAnalysis};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(StretchAnalysis::of(&turned).hencky_spatial().components[1], 2.0_f64.ln());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn hencky_spatial(&self) -> Symmetric<T> {
        self.spatial_function(&Logarithm)
    }

    /// f(U) for a function f of the stretch.
    ///
    /// Near U = 1 it is as accurate as [`IsotropicFunction::value_beside_one`].
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::{Power, StretchAnalysis}};
    /// let cube = StretchAnalysis::of(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).material_function(&Power(3.0));
    /// assert!((cube.components[0] - 8.0_f64).abs() < 1e-14);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn material_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let (components, slope) = self.frame_function(f);
        self.material(components, slope, T::zero())
    }

    /// f(V) = R f(U) Rᵀ for a function f of the stretch.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, spectral::{Power, StretchAnalysis}};
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// let cube = StretchAnalysis::of(&turned).spatial_function(&Power(3.0));
    /// assert!((cube.components[1] - 8.0_f64).abs() < 1e-14);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn spatial_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> Symmetric<T> {
        let (components, slope) = self.frame_function(f);
        self.spatial(components, slope, T::zero())
    }

    /// (qₖ by rows, R qₖ by rows, S): a frame, its image, and U in it, diagonal but for rounding and derivatives.
    #[inline(always)]
    pub(crate) fn in_frame(&self) -> (Rows<T>, Rows<T>, [T; 6]) {
        let [xx, yy, zz, xy, yz, xz] = self.frame_stretch();
        let (first, shift) = (self.first, self.shift);
        let [xx, yy, zz] = in_order(first, [xx + shift, yy + shift, zz + shift]);
        // Turned about as the axes are: 12, 23, 31 become 23, 31, 12.
        let [xy, yz, xz] = in_order(first, [xy, yz, xz]);
        (axes_in_order(first, self.axes), axes_in_order(first, self.turned_frame()), [xx, yy, zz, xy, yz, xz])
    }
}
