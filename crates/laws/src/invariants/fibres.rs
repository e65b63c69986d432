//! Stress and tangent of an energy with fibres, in the reference configuration.
//!
//! ```text
//! S = Σ wₐ Dₐ        ∂S/∂E = Σ wₐᵦ Dₐ ⊗ Dᵦ + Σ wₐ ∂Dₐ/∂E        Dₐ = ∂Iₐ/∂E:
//! 2 · 1,   2 (I₁ 1 − C),   C⁻¹ of ln J,   2 a ⊗ a,   2 (a ⊗ C a + C a ⊗ a)
//! ```

use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::internal::Lanewise;
use piola_numerics::{Hessian, Real};
use piola_solids::internal::{first_piola_numbers, packed};
use piola_solids::invariant::Invariants;
use piola_tensor::MajorSymmetric;
use piola_tensor::internal::rows::{Rows, cofactor, product, scaled, transpose};

use super::at_deformation::along;
use super::energy::EnergyOfInvariants;
use super::excesses::MOST_FAMILIES;
use super::variables::{FIFTH, FIRST, FOURTH, LOGARITHM, SECOND, Variables};

/// An energy over all variables.
pub(super) type Energy<T> = Hessian<T, 7, 28>;

/// What is asked for at a point: an energy, which may have parameters of the point.
pub(super) trait AtPoint<T: Real> {
    const FIBRES: usize;
    const SECOND: bool;
    fn fibre(&self, family: usize) -> [f64; 3];
    fn energy(&self, at: &Variables<'_, T>) -> Energy<T>;
}

/// An energy with parameters of its own.
struct Plain<'a, L>(&'a L);

impl<T: Real, L: EnergyOfInvariants> AtPoint<T> for Plain<'_, L> {
    const FIBRES: usize = L::FIBRES;
    const SECOND: bool = L::SECOND;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fibre(&self, family: usize) -> [f64; 3] {
        self.0.fibre(family)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy(&self, at: &Variables<'_, T>) -> Energy<T> {
        self.0.energy(at)
    }
}

/// Quantities of F and of the fibres.
struct Kinematics<T> {
    /// C − 1.
    change: Symmetric<T>,
    /// C⁻¹ and 1 − C⁻¹.
    inverse: [Symmetric<T>; 2],
    /// a ⊗ a of each family.
    dyads: [Symmetric<T>; MOST_FAMILIES],
    isotropic: Invariants<T>,
    fibres: [[T; 2]; MOST_FAMILIES],
}

/// F and ∇u, then J and J − 1: what a law of fibres asks a deformation for.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inputs<T: Real>(deformation: &impl Deformation<T>) -> [T; 20] {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = packed::of_deformation(deformation);
    let (jacobian, change) = (deformation.jacobian(), deformation.volume_change());
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, jacobian, change]
}

/// F, ∇u, J and J − 1 of their numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts<T: Real>(n: [T; 20]) -> ([Rows<T>; 2], [T; 2]) {
    let gradients = packed::gradients([
        n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16],
        n[17],
    ]);
    (gradients, [n[18], n[19]])
}

impl<T: Real> Kinematics<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<L: AtPoint<T>>(law: &L, [f, h]: [Rows<T>; 2], [jacobian, volume]: [T; 2]) -> Self {
        let change = kernels::right_cauchy_green_minus_one(h);
        let [a, b, c, d, e, g] = change.components;
        let (two, three, first) = (T::lit(2.0), T::lit(3.0), a + b + c);
        let second =
            if L::SECOND { two * first + ((a * b - d * d) + (b * c - e * e) + (a * c - g * g)) } else { T::zero() };
        let mut dyads = [Symmetric::zero(); MOST_FAMILIES];
        let mut fibres = [[T::zero(); 2]; MOST_FAMILIES];
        let mut family = 0;
        while family < MOST_FAMILIES && family < L::FIBRES {
            let [x, y, z] = law.fibre(family);
            let [x, y, z] = [T::lit(x), T::lit(y), T::lit(z)];
            dyads[family] = Symmetric { components: [x * x, y * y, z * z, x * y, y * z, x * z] };
            fibres[family] = along(&change, law.fibre(family));
            family += 1;
        }
        // F⁻¹, and 1 − F⁻¹ = F⁻¹ ∇u: 1 − C⁻¹ = K + Kᵀ − K Kᵀ.
        let inverse = scaled(transpose(cofactor(f)), jacobian.recip());
        let less = transpose(product(inverse, h));
        Self {
            change,
            inverse: [Symmetric::gram(inverse), kernels::almansi(less) * two],
            dyads,
            isotropic: Invariants {
                first,
                second,
                change: volume,
                jacobian,
                first_whole: first + three,
                second_whole: second + three,
            },
            fibres,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<L: AtPoint<T>>(&self, law: &L) -> Energy<T> {
        law.energy(&Variables {
            isotropic: &self.isotropic,
            fibres: self.fibres,
            families: L::FIBRES,
            second: L::SECOND,
        })
    }

    /// a ⊗ C a + C a ⊗ a of a family.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fifth(&self, family: usize) -> Symmetric<T> {
        let whole = self.change + Symmetric::identity();
        self.dyads[family].anticommutator(&whole)
    }

    /// S.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress(&self, energy: &Energy<T>) -> Symmetric<T> {
        let (two, four, slopes) = (T::lit(2.0), T::lit(4.0), energy.partials());
        let [inverse, less_inverse] = self.inverse;
        let mut stress = inverse * slopes[LOGARITHM];
        if energy.depends_on(SECOND) {
            stress += less_inverse * (two * slopes[FIRST] + four * slopes[SECOND]);
            stress += (Symmetric::identity() * self.isotropic.first - self.change) * (two * slopes[SECOND]);
        } else if energy.depends_on(FIRST) {
            stress += less_inverse * (two * slopes[FIRST]);
        }
        let mut family = 0;
        while family < MOST_FAMILIES {
            if energy.depends_on(FOURTH + family) {
                stress += self.dyads[family] * (two * slopes[FOURTH + family]);
            }
            if energy.depends_on(FIFTH + family) {
                stress += self.fifth(family) * (two * slopes[FIFTH + family]);
            }
            family += 1;
        }
        stress
    }

    /// D of a variable, ln J at fixed I₁ and I₂.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn direction(&self, variable: usize) -> Symmetric<T> {
        let two = T::lit(2.0);
        if variable == FIRST {
            Symmetric::identity() * two
        } else if variable == SECOND {
            (Symmetric::identity() * (self.isotropic.first + two) - self.change) * two
        } else if variable == LOGARITHM {
            self.inverse[0]
        } else if variable < FIFTH {
            self.dyads[variable - FOURTH] * two
        } else {
            self.fifth(variable - FIFTH) * two
        }
    }

    /// ∂S/∂E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tangent(&self, energy: &Energy<T>) -> MajorSymmetric<T> {
        let (two, four, slopes) = (T::lit(2.0), T::lit(4.0), energy.partials());
        let mut volume = slopes[LOGARITHM];
        if energy.depends_on(FIRST) {
            volume -= two * slopes[FIRST];
        }
        if energy.depends_on(SECOND) {
            volume -= four * slopes[SECOND];
        }
        let mut tangent = MajorSymmetric::square_dyad(&self.inverse[0]) * (-two * volume);
        if energy.depends_on(SECOND) {
            let change = MajorSymmetric::spherical() * T::lit(3.0) - MajorSymmetric::identity();
            tangent += change * (four * slopes[SECOND]);
        }
        let mut family = 0;
        while family < MOST_FAMILIES {
            if energy.depends_on(FIFTH + family) {
                let dyad = MajorSymmetric::symmetric_square_dyad(&self.dyads[family], &Symmetric::identity());
                tangent += dyad * (T::lit(8.0) * slopes[FIFTH + family]);
            }
            family += 1;
        }
        let curvature = at_fixed_invariants(energy);
        // Written out: which terms there are is known to the compiler.
        macro_rules! terms {
            ($($i:literal: $($j:literal)*;)*) => { $(
                if curvature.is_curved_in($i, $i) {
                    tangent += MajorSymmetric::dyad(&self.direction($i)) * curvature.second_partial($i, $i);
                }
                $(
                    if curvature.is_curved_in($i, $j) {
                        let dyad = MajorSymmetric::symmetric_dyad(&self.direction($i), &self.direction($j));
                        tangent += dyad * (two * curvature.second_partial($i, $j));
                    }
                )*
            )* };
        }
        terms! { 0: 1 2 3 4 5 6; 1: 2 3 4 5 6; 2: 3 4 5 6; 3: 4 5 6; 4: 5 6; 5: 6; 6: ; }
        tangent
    }
}

/// Second derivatives by I₁, I₂, ln J at fixed I₁ and I₂, I₄, …: D = ∂/∂θ − 2 ∂/∂a − 4 ∂/∂b instead of ∂/∂θ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn at_fixed_invariants<T: Real>(energy: &Energy<T>) -> Energy<T> {
    let mut turned = *energy;
    let (two, four) = (T::lit(2.0), T::lit(4.0));
    // D of the first derivative by each variable, then D of D W.
    macro_rules! turn {
        ($of:ident, $i:literal) => {
            let mut bends = $of.is_curved_in($i, LOGARITHM);
            let mut rate = $of.second_partial($i, LOGARITHM);
            for (variable, factor) in [(FIRST, two), (SECOND, four)] {
                if energy.is_curved_in($i, variable) {
                    rate -= factor * energy.second_partial($i, variable);
                    bends = true;
                }
            }
            if bends {
                turned = turned.with_second_partial(($i, LOGARITHM), rate);
            }
        };
    }
    turn!(energy, 0);
    turn!(energy, 1);
    turn!(energy, 3);
    turn!(energy, 4);
    turn!(energy, 5);
    turn!(energy, 6);
    let mut bends = energy.is_curved_in(LOGARITHM, LOGARITHM);
    let mut rate = energy.second_partial(LOGARITHM, LOGARITHM);
    for (variable, factor) in [(FIRST, two), (SECOND, four)] {
        // ∂_θ D W = W_θθ − 2 W_aθ − 4 W_bθ, less 2 and 4 times ∂_a D W and ∂_b D W.
        if energy.is_curved_in(variable, LOGARITHM) {
            rate -= factor * energy.second_partial(variable, LOGARITHM);
            bends = true;
        }
        if turned.is_curved_in(variable, LOGARITHM) {
            rate -= factor * turned.second_partial(variable, LOGARITHM);
            bends = true;
        }
    }
    if bends {
        turned = turned.with_second_partial((LOGARITHM, LOGARITHM), rate);
    }
    turned
}

/// P of F, ∇u, J and J − 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn stress_numbers<T: Real, L: AtPoint<T>>(law: &L, inputs: [T; 20]) -> [T; 9] {
    let (gradients, volume) = parts(inputs);
    let kinematics = Kinematics::of(law, gradients, volume);
    packed::of_stress(product(gradients[0], kinematics.stress(&kinematics.energy(law)).rows()))
}

/// P and the upper triangle of ∂P/∂F of F, ∇u, J and J − 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn both_numbers<T: Real, L: AtPoint<T>>(law: &L, inputs: [T; 20]) -> [T; 54] {
    let (gradients, volume) = parts(inputs);
    let kinematics = Kinematics::of(law, gradients, volume);
    let energy = kinematics.energy(law);
    first_piola_numbers(gradients[0], &kinematics.stress(&energy), &kinematics.tangent(&energy))
}

/// Answers of F, ∇u, J and J − 1.
struct OfFibres<L>(L);

impl<L: EnergyOfInvariants> Lanewise<20, 9> for OfFibres<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 20]) -> [T; 9] {
        stress_numbers(&Plain(&self.0), inputs)
    }
}

impl<L: EnergyOfInvariants> Lanewise<20, 54> for OfFibres<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 20]) -> [T; 54] {
        both_numbers(&Plain(&self.0), inputs)
    }
}

/// P by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola<T: Real, L: EnergyOfInvariants>(law: &L, deformation: &impl Deformation<T>) -> [T; 9] {
    T::lanewise(&OfFibres(law.clone()), inputs(deformation))
}

/// P and the upper triangle of ∂P/∂F.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola_and_upper_triangle<T: Real, L: EnergyOfInvariants>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> [T; 54] {
    T::lanewise(&OfFibres(law.clone()), inputs(deformation))
}

/// S and ∂S/∂E.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn stress_and_tangent<T: Real, L: EnergyOfInvariants>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (Symmetric<T>, MajorSymmetric<T>) {
    let (gradients, volume) = parts(inputs(deformation));
    let law = Plain(law);
    let kinematics = Kinematics::of(&law, gradients, volume);
    let energy = kinematics.energy(&law);
    (kinematics.stress(&energy), kinematics.tangent(&energy))
}
