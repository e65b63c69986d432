//! What may be asked of a law: its tangent, whole, by half, or in one direction.

use nalgebra::Matrix3;
use piola_continuum::batch::{BatchScalar, Destination, Point, Quantity, Refusal, Request};
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{CauchyStress, Deformation, FirstPiola, SecondPiola};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Lanes, Real};

use super::requests::{EnergyOf, answered, flat, quantities};
use crate::solids::Hyperelastic;

/// The entries (r, s) with r ≤ s of the 9×9 array, by rows.
#[inline(always)]
fn upper<T: Real>(tangent: &FirstPiolaTangent<T>) -> [T; 45] {
    let [a, b, c, d, e, f, g, h, i] = tangent.0.components;
    [
        a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], c[2],
        c[3], c[4], c[5], c[6], c[7], c[8], d[3], d[4], d[5], d[6], d[7], d[8], e[4], e[5], e[6], e[7], e[8], f[5],
        f[6], f[7], f[8], g[6], g[7], g[8], h[7], h[8], i[8],
    ]
}

#[inline(always)]
fn square<T: Real>(tangent: &FirstPiolaTangent<T>) -> [T; 81] {
    let mut entries = [T::zero(); 81];
    let mut r = 0;
    while r < 9 {
        let mut s = 0;
        while s < 9 {
            entries[9 * r + s] = tangent.0.components[r][s];
            s += 1;
        }
        r += 1;
    }
    entries
}

quantities! {
    /// The 45 entries of ∂P/∂F that major symmetry leaves: those of row r and column s with r ≤ s, by rows, where the
    /// pair iA has the number r = 3 i + A.
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::batch;
    /// use piola_constitutive::solids::SaintVenantKirchhoff;
    /// use piola_continuum::DeformationGradient;
    /// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
    /// let (f, mut a) = ([DeformationGradient::identity(); 7], [[0.0; 45]; 7]);
    /// batch::evaluate(&f[..], batch::first_piola_tangent(&law, &mut a[..]))?;
    /// assert_eq!(a[6][..5], [5.0, 0.0, 0.0, 0.0, 1.0]); // λ + 2μ at (11, 11), λ at (11, 22)
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
    /// ```
    pub first_piola_tangent FirstPiolaTangentOf [45 knows] FirstPiolaTangentOf<'static, ()>, |law, point| upper(&law.first_piola_tangent(point));
    /// All 81 entries of ∂P/∂F: see [`Hyperelastic::first_piola_tangent`].
    pub first_piola_tangent_square FirstPiolaTangentSquareOf [81 knows] FirstPiolaTangent,
        |law, point| square(&law.first_piola_tangent(point));
    /// The 21 components of ∂S/∂E, the upper triangle by rows of the 6×6 array over the pairs 11, 22, 33, 12, 23, 13 without
    /// factors for shears, as in [`MajorSymmetric`](piola_continuum::tensor::MajorSymmetric): see
    /// [`Hyperelastic::material_tangent`].
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::batch;
    /// use piola_constitutive::solids::SaintVenantKirchhoff;
    /// use piola_continuum::DeformationGradient;
    /// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
    /// let (f, mut c) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [[0.0; 21]; 7]);
    /// batch::evaluate(&f[..], batch::material_tangent(&law, &mut c[..]))?;
    /// assert_eq!(c[6][..4], [5.0, 1.0, 1.0, 0.0]); // λ + 2μ at (11, 11), λ at (11, 22) at every deformation
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub material_tangent MaterialTangentOf [21] MaterialTangentOf<'static, ()>,
        |law, point| law.material_tangent(point).0.components;
    /// The 21 components of c/J, which takes D to the Truesdell rate of T, in the order of [`material_tangent`]: see
    /// [`Hyperelastic::truesdell_tangent`].
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::batch;
    /// use piola_constitutive::solids::SaintVenantKirchhoff;
    /// use piola_continuum::DeformationGradient;
    /// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
    /// let (f, mut c) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [[0.0; 21]; 7]);
    /// batch::evaluate(&f[..], batch::truesdell_tangent(&law, &mut c[..]))?;
    /// assert_eq!(c[6][..2], [40.0, 2.0]); // F₁₁⁴ (λ + 2μ)/J and F₁₁² λ/J
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub truesdell_tangent TruesdellTangentOf [21] TruesdellTangentOf<'static, ()>,
        |law, point| law.truesdell_tangent(point).0.components;
    /// P to the first destination and the 45 entries of [`first_piola_tangent`] to the second: see
    /// [`Hyperelastic::first_piola_and_tangent`].
    shared FirstPiolaAndTangentOf [54 knows] FirstPiolaAndTangentOf<'static, ()>, |law, point| law.first_piola_and_upper_triangle(point);
    /// W to the first destination and P to the second: see [`Hyperelastic::energy_and_first_piola`].
    shared_energy EnergyAndFirstPiolaOf [10] EnergyAndFirstPiolaOf<'static, ()>, |law, point| {
        let (energy, stress) = law.energy_and_first_piola(point);
        let [a, b, c, d, e, f, g, h, i] = flat(&stress);
        [energy, a, b, c, d, e, f, g, h, i]
    };
    /// S to the first destination and ∂S/∂E to the second: see [`Hyperelastic::second_piola_and_tangent`].
    shared_material SecondPiolaAndTangentOf [27] SecondPiolaAndTangentOf<'static, ()>, |law, point| {
        let (stress, tangent) = law.second_piola_and_tangent(point);
        with_tangent(&stress.0.components, &tangent.0.components)
    };
    /// T to the first destination and c/J to the second: see [`Hyperelastic::cauchy_and_tangent`].
    shared_spatial CauchyAndTangentOf [27] CauchyAndTangentOf<'static, ()>, |law, point| {
        let (stress, tangent) = law.cauchy_and_tangent(point);
        with_tangent(&stress.0.components, &tangent.0.components)
    };
    /// W, P and the 45 entries of [`first_piola_tangent`] to three destinations: see
    /// [`Hyperelastic::energy_first_piola_and_tangent`].
    shared_all EnergyFirstPiolaAndTangentOf [55] EnergyFirstPiolaAndTangentOf<'static, ()>, |law, point| {
        let (energy, stress, tangent) = law.energy_first_piola_and_tangent(point);
        energy_before(energy, &flat(&stress), &upper(&tangent))
    };
}

/// W, P and 45 entries, one after the other.
#[inline(always)]
fn energy_before<T: Real>(energy: T, stress: &[T; 9], tangent: &[T; 45]) -> [T; 55] {
    let mut all = [energy; 55];
    let mut k = 0;
    while k < 9 {
        all[k + 1] = stress[k];
        k += 1;
    }
    while k < 54 {
        all[k + 1] = tangent[k - 9];
        k += 1;
    }
    all
}

/// Six components and 21, one after the other.
#[inline(always)]
fn with_tangent<T: Real>(stress: &[T; 6], tangent: &[T; 21]) -> [T; 27] {
    let mut all = [stress[0]; 27];
    let mut k = 1;
    while k < 6 {
        all[k] = stress[k];
        k += 1;
    }
    while k < 27 {
        all[k] = tangent[k - 6];
        k += 1;
    }
    all
}

/// S and the 21 components of [`material_tangent`], what they share computed once: what a total Lagrangian formulation asks
/// for.
///
/// # Example
/// ```
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{DeformationGradient, SecondPiola};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let (f, mut s, mut c) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [SecondPiola::zero(); 7], [[0.0; 21]; 7]);
/// batch::evaluate(&f[..], batch::second_piola_and_tangent(&law, &mut s[..], &mut c[..]))?;
/// assert_eq!((s[6].0.components[0], c[6][0]), (7.5, 5.0)); // (λ + 2μ) E₁₁, λ + 2μ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn second_piola_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<SecondPiolaAndTangentOf<'_, L>, (), Together<V, W>, 0, 27> {
    shared_material(law, Together(stress, tangent))
}

/// T and the 21 components of [`truesdell_tangent`], what they share computed once: what an updated Lagrangian formulation asks
/// for.
///
/// # Example
/// ```
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{CauchyStress, DeformationGradient};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let (f, mut t, mut c) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [CauchyStress::zero(); 7], [[0.0; 21]; 7]);
/// batch::evaluate(&f[..], batch::cauchy_and_tangent(&law, &mut t[..], &mut c[..]))?;
/// assert_eq!((t[6].0.components[0], c[6][0]), (15.0, 40.0)); // F₁₁² S₁₁/J, F₁₁⁴ (λ + 2μ)/J
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn cauchy_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<CauchyAndTangentOf<'_, L>, (), Together<V, W>, 0, 27> {
    shared_spatial(law, Together(stress, tangent))
}

/// W(F) − W(1) and P, what they share computed once: what a line search asks for.
///
/// # Example
/// ```
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let (f, mut w, mut p) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [0.0; 7], [FirstPiola::zero(); 7]);
/// batch::evaluate(&f[..], batch::energy_and_first_piola(&law, &mut w[..], &mut p[..]))?;
/// assert_eq!((w[6], p[6].0[(0, 0)]), (5.625, 15.0)); // ½ (λ + 2μ) E₁₁², 2 (λ + 2μ) E₁₁
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn energy_and_first_piola<L: Hyperelastic + Sync, V, W>(
    law: &L,
    energy: V,
    stress: W,
) -> Request<EnergyAndFirstPiolaOf<'_, L>, (), Together<V, W>, 0, 10> {
    shared_energy(law, Together(energy, stress))
}

/// W(F) − W(1), P and the 45 entries of [`first_piola_tangent`], what they share computed once: what a step of Newton's method
/// with a line search asks for.
///
/// # Example
/// ```
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7];
/// let (mut w, mut p, mut a) = ([0.0; 7], [FirstPiola::zero(); 7], [[0.0; 45]; 7]);
/// batch::evaluate(&f[..], batch::energy_first_piola_and_tangent(&law, &mut w[..], &mut p[..], &mut a[..]))?;
/// assert_eq!((w[6], p[6].0[(0, 0)], a[6][0]), (5.625, 15.0, 27.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn energy_first_piola_and_tangent<L: Hyperelastic + Sync, U, V, W>(
    law: &L,
    energy: U,
    stress: V,
    tangent: W,
) -> Request<EnergyFirstPiolaAndTangentOf<'_, L>, (), Together<U, Together<V, W>>, 0, 55> {
    shared_all(law, Together(energy, Together(stress, tangent)))
}

/// P and the 45 entries of [`first_piola_tangent`], what they share computed once: see
/// [`Hyperelastic::first_piola_and_tangent`].
///
/// # Example
/// ```
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let (f, mut p, mut a) = ([DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 7], [FirstPiola::zero(); 7], [[0.0; 45]; 7]);
/// batch::evaluate(&f[..], batch::first_piola_and_tangent(&law, &mut p[..], &mut a[..]))?;
/// assert_eq!((p[6].0[(0, 0)], a[6][0]), (15.0, 27.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn first_piola_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<FirstPiolaAndTangentOf<'_, L>, (), Together<V, W>, 0, 54> {
    shared(law, Together(stress, tangent))
}

/// Two destinations of one request.
#[derive(Clone, Copy, Debug)]
pub struct Together<V, W>(V, W);

/// Of `$whole` numbers `$first` go to the first destination, `$second` to the second.
macro_rules! together {
    ($output:ty, $whole:literal = $first_output:ty, $first:literal + $second_output:ty, $second:literal) => {
        impl<T, V, W> Destination<$output, T, $whole> for Together<V, W>
        where
            T: BatchScalar,
            V: Destination<$first_output, T, $first>,
            W: Destination<$second_output, T, $second>,
        {
            const IN_LANES: bool = V::IN_LANES && W::IN_LANES;
            const RECORDS: bool = V::RECORDS && W::RECORDS;
            fn count(&self) -> usize {
                // Both are checked: no batch is as long as a pair of unlike lengths.
                let (first, second) = (self.0.count(), self.1.count());
                if first == second { first } else { usize::MAX }
            }
            #[inline(always)]
            fn split(self, middle: usize) -> (Self, Self) {
                let ((a, b), (c, d)) = (self.0.split(middle), self.1.split(middle));
                (Self(a, c), Self(b, d))
            }
            #[inline(always)]
            fn put(&mut self, index: usize, components: [T; $whole]) {
                let (mut first, mut second) = ([components[0]; $first], [components[0]; $second]);
                let mut k = 0;
                while k < $first {
                    first[k] = components[k];
                    k += 1;
                }
                while k < $whole {
                    second[k - $first] = components[k];
                    k += 1;
                }
                self.0.put(index, first);
                self.1.put(index, second);
            }
            #[inline(always)]
            fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; $whole]) {
                if let (Some(head), Some(tail)) = (values.first_chunk(), values.last_chunk()) {
                    self.0.store(first, count, head);
                    self.1.store(first, count, tail);
                }
            }
            #[inline(always)]
            fn scatter<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; $whole]) {
                if let (Some(head), Some(tail)) = (values.first_chunk(), values.last_chunk()) {
                    self.0.scatter(first, count, head);
                    self.1.scatter(first, count, tail);
                }
            }
        }
    };
}

together!(FirstPiolaAndTangentOf<'static, ()>, 54 = FirstPiola, 9 + FirstPiolaTangentOf<'static, ()>, 45);
together!(SecondPiolaAndTangentOf<'static, ()>, 27 = SecondPiola, 6 + MaterialTangentOf<'static, ()>, 21);
together!(CauchyAndTangentOf<'static, ()>, 27 = CauchyStress, 6 + TruesdellTangentOf<'static, ()>, 21);
together!(EnergyAndFirstPiolaOf<'static, ()>, 10 = EnergyOf<'static, ()>, 1 + FirstPiola, 9);
together!(EnergyFirstPiolaAndTangentOf<'static, ()>, 55 = EnergyOf<'static, ()>, 1 + FirstPiolaAndTangentOf<'static, ()>, 54);

/// (∂P/∂F) : δF of a direction δF at each point: see [`Hyperelastic::first_piola_derivative`].
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_constitutive::batch;
/// use piola_constitutive::solids::SaintVenantKirchhoff;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// let law = SaintVenantKirchhoff::new(1.0, 2.0)?;
/// let (f, mut q) = ([DeformationGradient::identity(); 7], [FirstPiola::zero(); 7]);
/// let direction = [Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0); 7];
/// batch::evaluate(&f[..], batch::first_piola_derivative(&law, &direction[..], &mut q[..]))?;
/// assert_eq!((q[6].0[(0, 1)], q[6].0[(1, 0)]), (2.0, 2.0)); // μ (δF + δFᵀ)
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
#[must_use]
pub fn first_piola_derivative<L: Hyperelastic + Sync, S, V>(
    law: &L,
    direction: S,
    to: V,
) -> Request<FirstPiolaDerivativeOf<'_, L>, S, V, 9, 9> {
    Request::new(FirstPiolaDerivativeOf(law), direction, to)
}

/// The output of [`first_piola_derivative`].
#[derive(Debug)]
pub struct FirstPiolaDerivativeOf<'a, L>(&'a L);

impl<L> Clone for FirstPiolaDerivativeOf<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L> Copy for FirstPiolaDerivativeOf<'_, L> {}

impl<L: Hyperelastic + Sync> Quantity<9, 9> for FirstPiolaDerivativeOf<'_, L> {
    type Input = Matrix3<f64>;
    type Output = FirstPiola;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "direction of the derivative";

    #[inline(always)]
    fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, direction: [T; 9]) -> [T; 9] {
        let [a, b, c, d, e, f, g, h, i] = direction;
        flat(&self.0.first_piola_derivative(point, &from_rows([[a, b, c], [d, e, f], [g, h, i]])))
    }

    #[inline(always)]
    fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, value: &[T; 9]) -> T::Mask {
        answered(self.0, point, value)
    }

    fn check<T: Real, D: Deformation<T>>(&self, deformation: &D) -> Result<(), Refusal> {
        self.0.check(deformation).map_err(Refusal::new)
    }
}
