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

use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::decomposition::{descending, lifted, turned};
use super::expansion::expand;
use super::frame::{combination, components_in, from_frame, largest_modulus, principal_frame};
use super::orthogonal_images::orthogonalise;
use super::{IsotropicFunction, Logarithm};
use crate::tensor::rows::{Rows, apply, transpose};
use crate::{Deformation, Symmetric};

/// Strains with components up to this size are computed from ∇u and relative to the rotation.
const SMALL: f64 = 0.25;

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
        // The frame of 2E or, where a small stretch would be lost in it, of C.
        let measure = if small.all() {
            green
        } else {
            let cauchy_green = gram(&freeze(transpose(gradient)));
            Symmetric { components: choose(small, green.components, cauchy_green) }
        };

        let mut axes = freeze(principal_frame(&measure));
        let mut images = images_of(gradient, &axes);
        // For small strain 2E in the frame, otherwise C.
        let mut square = if small.all() {
            components_in(&axes, &twice_green)
        } else if small.any() {
            choose(small, components_in(&axes, &twice_green), gram(&images))
        } else {
            gram(&images)
        };

        let enough = T::lit((0.125 * unit_in_last_place::<T>()).sqrt());
        let mut roots = roots_of(small, &square);
        let tilted = |i: usize, j: usize, place: usize| {
            (enough * (roots.0[i] * roots.0[j])).less_than(square[place].abs().frozen())
        };
        let skew = if T::ORDER == 0 { tilted(0, 1, 3) | tilted(1, 2, 4) | tilted(0, 2, 5) } else { skewed(&images) };
        let slow = !small & skew;
        if slow.any() {
            (axes, images) = orthogonalise(slow, gradient, axes, images);
            square = choose(small, square, gram(&images));
            roots = roots_of(small, &square);
        }
        let shift = T::select(small, T::one(), T::zero());
        let departure = departure_of(shift, &square, &roots.0, &roots.1);
        Self {
            gradient,
            displacement,
            twice_green,
            square,
            axes,
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
        lifted(self.frame_stretch()).0.map(|excess| self.shift + excess)
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
        let excess = lifted(self.frame_stretch()).0;
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
        if T::ORDER == 0 { self.axes } else { turned(&self.axes, lifted(self.frame_stretch()).1) }
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
        if T::ORDER == 0 { turned_frame } else { turned(&turned_frame, lifted(self.frame_stretch()).1) }
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
        let entry = |i: usize, j: usize| {
            self.shift * f[i][j]
                + (images[0][i] * self.axes[0][j] + images[1][i] * self.axes[1][j] + images[2][i] * self.axes[2][j])
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
        let shift = self.shift;
        (self.axes, self.turned_frame(), [xx + shift, yy + shift, zz + shift, xy, yz, xz])
    }

    /// Σ Mₖₗ qₖ ⊗ qₗ + s 1, and for small strain the multiple of E that was left out of M.
    #[inline(always)]
    fn material(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.axes, components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        shifted(rest + self.twice_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// Σ Mₖₗ R qₖ ⊗ R qₗ + s 1, and for small strain the multiple of R E Rᵀ = ½ (B − 1) that was left out of M.
    #[inline(always)]
    fn spatial(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.turned_frame(), components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        let twice_left_green = twice_green(&transpose(self.displacement));
        shifted(rest + twice_left_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// f at the diagonal of S.
    #[inline(always)]
    fn values_at_stretches<F: IsotropicFunction + ?Sized>(&self, f: &F) -> [T; 3] {
        let beside = |k: usize| f.value_beside_one(self.excess[k]);
        let plain = |k: usize| f.value(self.stretches[k]);
        if self.small.all() {
            [beside(0), beside(1), beside(2)]
        } else if self.small.any() {
            [
                T::select(self.small, beside(0), plain(0)),
                T::select(self.small, beside(1), plain(1)),
                T::select(self.small, beside(2), plain(2)),
            ]
        } else {
            [plain(0), plain(1), plain(2)]
        }
    }

    /// f(S), less f′(1) E for small strain, and f′(1): what is left out then is added without a rotation.
    #[inline(always)]
    fn frame_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> ([T; 6], T) {
        let function = expand(f, self.stretches, self.values_at_stretches(f), self.departure);
        if !self.small.any() {
            return (function, T::zero());
        }
        let slope = f.slope_at_one::<T>();
        let part = T::lit(0.5) * self.shift * slope;
        let e = self.square;
        let less = |k: usize| function[k] - part * e[k];
        ([less(0), less(1), less(2), less(3), less(4), less(5)], slope)
    }

    /// S less the shift.
    #[inline(always)]
    fn frame_stretch(&self) -> [T; 6] {
        let ([x, y, z], d) = (self.excess, self.departure);
        if T::ORDER == 0 {
            return [x, y, z, d[3], d[4], d[5]];
        }
        [x + d[0], y + d[1], z + d[2], d[3], d[4], d[5]]
    }

    /// (S − m 1, m) with the middle stretch m, or for small strain (S − 1 − E, 0) = (−½ (S − 1)², 0): what remains
    /// to be put through the rounding of a change of frame.
    #[inline(always)]
    fn beyond_green(&self) -> ([T; 6], T) {
        let k = self.frame_stretch();
        let middle = self.stretches[1];
        let less_middle = [k[0] - middle, k[1] - middle, k[2] - middle, k[3], k[4], k[5]];
        if !self.small.any() {
            return (less_middle, middle);
        }
        let [x, y, z, xy, yz, xz] = k;
        let half = T::lit(-0.5);
        // Products of two shears matter only where they are more than rounding.
        let shears = |a: T, b: T| if T::ORDER == 0 { T::zero() } else { a * b };
        let square = [
            half * (x * x + (shears(xy, xy) + shears(xz, xz))),
            half * (y * y + (shears(xy, xy) + shears(yz, yz))),
            half * (z * z + (shears(yz, yz) + shears(xz, xz))),
            half * (xy * (x + y) + shears(xz, yz)),
            half * (yz * (y + z) + shears(xy, xz)),
            half * (xz * (x + z) + shears(xy, yz)),
        ];
        if self.small.all() {
            return (square, T::zero());
        }
        (choose(self.small, square, less_middle), T::select(self.small, T::zero(), middle))
    }

    /// S⁻¹ less the shift.
    #[inline(always)]
    fn frame_inverse(&self) -> [T; 6] {
        let d = self.departure;
        let reciprocal = [self.stretches[0].recip(), self.stretches[1].recip(), self.stretches[2].recip()];
        let less = |k: usize| {
            if self.small.any() {
                T::select(self.small, -(self.excess[k] * reciprocal[k]), reciprocal[k])
            } else {
                reciprocal[k]
            }
        };
        let start = [
            less(0),
            less(1),
            less(2),
            -(d[3] * (reciprocal[0] * reciprocal[1])),
            -(d[4] * (reciprocal[1] * reciprocal[2])),
            -(d[5] * (reciprocal[0] * reciprocal[2])),
        ];
        if T::ORDER == 0 {
            return start;
        }
        // S₀⁻¹ (1 − N S⁻¹), order by order, for the part beyond S₀⁻¹.
        let mut beyond = [T::zero(); 6];
        for _ in 0..T::ORDER {
            let y = |i: usize, j: usize| {
                let rest = beyond[PLACE[i][j]];
                if i == j { reciprocal[i] + rest } else { rest }
            };
            let entry = |i: usize, j: usize| {
                let row = |k: usize| d[PLACE[i][k]];
                -(reciprocal[i] * (row(0) * y(0, j) + row(1) * y(1, j) + row(2) * y(2, j)))
            };
            beyond = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)];
        }
        [start[0] + beyond[0], start[1] + beyond[1], start[2] + beyond[2], beyond[3], beyond[4], beyond[5]]
    }

    /// Σₗ (S⁻¹ − shift)ₖₗ bₗ by rows.
    #[inline(always)]
    fn divided_images(&self) -> Rows<T> {
        let [xx, yy, zz, xy, yz, xz] = self.frame_inverse();
        let [a, b, c] = self.images;
        let row = |x: T, y: T, z: T| combination(T::one(), combination(x, a, y, b), z, c);
        [row(xx, xy, xz), row(xy, yy, yz), row(xz, yz, zz)]
    }

    /// R qₖ by rows.
    #[inline(always)]
    fn turned_frame(&self) -> Rows<T> {
        let divided = self.divided_images();
        let row = |k: usize| combination(self.shift, self.images[k], T::one(), divided[k]);
        [row(0), row(1), row(2)]
    }
}

const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// A + s 1.
#[inline(always)]
fn shifted<T: Real>(a: Symmetric<T>, s: T) -> Symmetric<T> {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    Symmetric::new(xx + s, yy + s, zz + s, xy, yz, xz)
}

/// Whether images are not orthogonal enough for the first order to suffice.
#[inline(always)]
fn skewed<T: Real>(images: &Rows<T>) -> T::Mask {
    let enough = T::lit((0.125 * unit_in_last_place::<T>()).sqrt());
    let g = gram(&freeze(*images));
    let length = [g[0].sqrt(), g[1].sqrt(), g[2].sqrt()];
    let tilted = |i: usize, j: usize, place: usize| (enough * (length[i] * length[j])).less_than(g[place].abs());
    tilted(0, 1, 3) | tilted(1, 2, 4) | tilted(0, 2, 5)
}

/// (λₖ, λₖ − shift) from the diagonal, 2eₖ for small strain and λₖ² otherwise, without derivatives.
#[inline(always)]
fn roots_of<T: Real>(small: T::Mask, square: &[T; 6]) -> ([T; 3], [T; 3]) {
    let root = |k: usize| {
        let x = if T::ORDER == 0 { square[k] } else { square[k].frozen() };
        let root = T::select(small, T::one() + x, x).sqrt();
        (root, if small.any() { T::select(small, x / (T::one() + root), root) } else { root })
    };
    let (a, b, c) = (root(0), root(1), root(2));
    ([a.0, b.0, c.0], [a.1, b.1, c.1])
}

/// What S has beyond its frozen diagonal: Sᵢⱼ = Gᵢⱼ/(λᵢ + λⱼ) off the diagonal, and the orders of derivatives.
#[inline(always)]
fn departure_of<T: Real>(shift: T, square: &[T; 6], stretches: &[T; 3], excess: &[T; 3]) -> [T; 6] {
    let [a, b, c] = *stretches;
    let reciprocal = [(a + b).recip(), (b + c).recip(), (a + c).recip()];
    if T::ORDER == 0 {
        let o = T::zero();
        return [o, o, o, square[3] * reciprocal[0], square[4] * reciprocal[1], square[5] * reciprocal[2]];
    }
    // (shift + K)² = shift + square, K = excess + departure: each pass brings in one order.
    let weights = [(a + a).recip(), (b + b).recip(), (c + c).recip(), reciprocal[0], reciprocal[1], reciprocal[2]];
    let mut departure = [T::zero(); 6];
    for _ in 0..T::ORDER {
        let k = |i: usize, j: usize| {
            let rest = departure[PLACE[i][j]];
            if i == j { excess[i] + rest } else { rest }
        };
        let residual = |place: usize, i: usize, j: usize| {
            let doubled = (shift + shift) * k(i, j);
            square[place] - (doubled + (k(i, 0) * k(0, j) + k(i, 1) * k(1, j) + k(i, 2) * k(2, j)))
        };
        let step = [
            residual(0, 0, 0) * weights[0],
            residual(1, 1, 1) * weights[1],
            residual(2, 2, 2) * weights[2],
            residual(3, 0, 1) * weights[3],
            residual(4, 1, 2) * weights[4],
            residual(5, 0, 2) * weights[5],
        ];
        departure = core::array::from_fn(|place| departure[place] + step[place]);
    }
    departure
}
