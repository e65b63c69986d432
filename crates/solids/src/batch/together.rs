//! Requests of several quantities that share work, each with a destination of its own.

use piola_batch::{Point, Quantity, Refusal, Request, Together, together};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, SecondPiola};
use piola_numerics::Real;

use super::requests::{EnergyOf, flat, quantities};
use super::tangents::{FirstPiolaTangentOf, MaterialTangentOf, TruesdellTangentOf, upper};
use crate::Hyperelastic;

quantities! {
    /// P to the first destination and the 45 entries of [`first_piola_tangent`](super::first_piola_tangent) to the second: see
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
    /// W, P and the 45 entries of [`first_piola_tangent`](super::first_piola_tangent) to three destinations: see
    /// [`Hyperelastic::energy_first_piola_and_tangent`].
    shared_all EnergyFirstPiolaAndTangentOf [55] EnergyFirstPiolaAndTangentOf<'static, ()>, |law, point| {
        let (energy, stress, tangent) = law.energy_first_piola_and_tangent(point);
        energy_before(energy, &flat(&stress), &upper(&tangent))
    };
}

/// W, P and 45 entries, one after the other.
#[cfg_attr(not(debug_assertions), inline(always))]
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
#[cfg_attr(not(debug_assertions), inline(always))]
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

/// S and the 21 components of [`material_tangent`](super::material_tangent), their common terms computed once: for total
/// Lagrangian formulations.
#[must_use]
pub fn second_piola_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<SecondPiolaAndTangentOf<'_, L>, (), Together<V, W>, 0, 27> {
    shared_material(law, Together(stress, tangent))
}

/// T and the 21 components of [`truesdell_tangent`](super::truesdell_tangent), their common terms computed once: for updated
/// Lagrangian formulations.
#[must_use]
pub fn cauchy_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<CauchyAndTangentOf<'_, L>, (), Together<V, W>, 0, 27> {
    shared_spatial(law, Together(stress, tangent))
}

/// W(F) − W(1) and P, their common terms computed once: for line searches.
#[must_use]
pub fn energy_and_first_piola<L: Hyperelastic + Sync, V, W>(
    law: &L,
    energy: V,
    stress: W,
) -> Request<EnergyAndFirstPiolaOf<'_, L>, (), Together<V, W>, 0, 10> {
    shared_energy(law, Together(energy, stress))
}

/// W(F) − W(1), P and the 45 entries of [`first_piola_tangent`](super::first_piola_tangent), their common terms computed once: for Newton's
/// method with a line search.
#[must_use]
pub fn energy_first_piola_and_tangent<L: Hyperelastic + Sync, U, V, W>(
    law: &L,
    energy: U,
    stress: V,
    tangent: W,
) -> Request<EnergyFirstPiolaAndTangentOf<'_, L>, (), Together<U, Together<V, W>>, 0, 55> {
    shared_all(law, Together(energy, Together(stress, tangent)))
}

/// P and the 45 entries of [`first_piola_tangent`](super::first_piola_tangent), their common terms computed once: see
/// [`Hyperelastic::first_piola_and_tangent`].
#[must_use]
pub fn first_piola_and_tangent<L: Hyperelastic + Sync, V, W>(
    law: &L,
    stress: V,
    tangent: W,
) -> Request<FirstPiolaAndTangentOf<'_, L>, (), Together<V, W>, 0, 54> {
    shared(law, Together(stress, tangent))
}

together!(FirstPiolaAndTangentOf<'static, ()>, 54 = FirstPiola, 9 + FirstPiolaTangentOf<'static, ()>, 45);
together!(SecondPiolaAndTangentOf<'static, ()>, 27 = SecondPiola, 6 + MaterialTangentOf<'static, ()>, 21);
together!(CauchyAndTangentOf<'static, ()>, 27 = CauchyStress, 6 + TruesdellTangentOf<'static, ()>, 21);
together!(EnergyAndFirstPiolaOf<'static, ()>, 10 = EnergyOf<'static, ()>, 1 + FirstPiola, 9);
together!(EnergyFirstPiolaAndTangentOf<'static, ()>, 55 = EnergyOf<'static, ()>, 1 + FirstPiolaAndTangentOf<'static, ()>, 54);
