//! Laws of one's own beside the built-in ones of the same formula.

use core::error::Error;

use piola_continuum::Symmetric;
use piola_laws::{
    EnergyOfInvariants, EnergyOfStrain, EnergyOfStretches, Excesses, OfInvariants, OfStrain, OfStretches,
};
use piola_numerics::Real;
use piola_solids::stretch::Volume;
use piola_solids::{
    Compressible, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, MooneyRivlin, NeoHookeanLogarithmic,
    ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness, isochoric, volumetric,
};

/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)².
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnNeoHookean {
    mu: f64,
    lambda: f64,
}

impl EnergyOfInvariants for OwnNeoHookean {
    const SECOND: bool = false;
    const CURVED: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let volume = at.ln_jacobian();
        T::lit(0.5 * self.mu) * at.first_excess() + T::lit(0.5 * self.lambda) * volume * volume
    }
}

/// W = C₁₀ (I₁ − 3 − 2 ln J) + C₀₁ (I₂ − 3 − 4 ln J) + c (J² − 1 − 2 ln J).
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMooneyRivlin {
    c10: f64,
    c01: f64,
    c: f64,
}

impl EnergyOfInvariants for OwnMooneyRivlin {
    const CURVED: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let change = at.volume_change();
        T::lit(self.c10) * at.first_excess()
            + T::lit(self.c01) * at.second_excess()
            + T::lit(self.c) * (change * change + T::lit(2.0) * at.volume_excess())
    }
}

/// W = −½ μ m ln(1 − (Ī₁ − 3)/m) + ½ κ (J − 1)².
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnGent {
    mu: f64,
    limit: f64,
    kappa: f64,
}

impl EnergyOfInvariants for OwnGent {
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let change = at.volume_change();
        let share = at.isochoric_first() * T::lit(-1.0 / self.limit);
        T::lit(-0.5 * self.mu * self.limit) * share.ln_1p() + T::lit(0.5 * self.kappa) * change * change
    }
}

/// W = c₁ x + c₂ x² + c₃ x³ + ½ κ (J − 1)², x = Ī₁ − 3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnYeoh {
    c: [f64; 3],
    kappa: f64,
}

impl EnergyOfInvariants for OwnYeoh {
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let (x, change) = (at.isochoric_first(), at.volume_change());
        let [a, b, c] = [T::lit(self.c[0]), T::lit(self.c[1]), T::lit(self.c[2])];
        x * (a + x * (b + x * c)) + T::lit(0.5 * self.kappa) * change * change
    }
}

/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² + ½ k (I₄ − 1)².
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnReinforced {
    mu: f64,
    lambda: f64,
    k: f64,
    fibre: [f64; 3],
}

impl EnergyOfInvariants for OwnReinforced {
    const FIBRES: usize = 1;
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let (volume, stretch) = (at.ln_jacobian(), at.fourth(0));
        T::lit(0.5 * self.mu) * at.first_excess()
            + T::lit(0.5 * self.lambda) * volume * volume
            + T::lit(0.5 * self.k) * stretch * stretch
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fibre(&self, _family: usize) -> [f64; 3] {
        self.fibre
    }
}

/// Holzapfel, Gasser and Ogden's artery.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnArtery {
    mu: f64,
    kappa: f64,
    k1: f64,
    k2: f64,
    dispersion: f64,
    fibres: [[f64; 3]; 2],
}

impl OwnArtery {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn family<T: Real>(&self, at: &impl Excesses<T>, first: T, family: usize) -> T {
        let along = T::lit(1.0 - 3.0 * self.dispersion) * at.isochoric_fourth(family);
        let strain = T::lit(self.dispersion) * first + along;
        let tension = T::select(T::zero().less_than(strain), strain, T::zero());
        T::lit(0.5 * self.k1 / self.k2) * (T::lit(self.k2) * tension * tension).exp_m1()
    }
}

impl EnergyOfInvariants for OwnArtery {
    const FIBRES: usize = 2;
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let (first, change) = (at.isochoric_first(), at.volume_change());
        T::lit(0.5 * self.mu) * first
            + T::lit(0.5 * self.kappa) * change * change
            + self.family(at, first, 0)
            + self.family(at, first, 1)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fibre(&self, family: usize) -> [f64; 3] {
        self.fibres[family]
    }
}

/// W = ½ λ (tr E)² + μ E : E.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnKirchhoff {
    lambda: f64,
    mu: f64,
}

impl EnergyOfStrain for OwnKirchhoff {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T {
        let trace = strain.trace();
        T::lit(0.5 * self.lambda) * trace * trace + T::lit(self.mu) * strain.double_contraction(strain)
    }
}

/// W = ½ c (e^(λ (tr E)² + 2 μ E : E) − 1).
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnFung {
    c: f64,
    lambda: f64,
    mu: f64,
}

impl EnergyOfStrain for OwnFung {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T {
        let trace = strain.trace();
        let square = T::lit(self.lambda) * trace * trace + T::lit(2.0 * self.mu) * strain.double_contraction(strain);
        T::lit(0.5 * self.c) * square.exp_m1()
    }
}

/// The neo-Hookean law by E alone: I₁ − 3 = 2 tr E, J² = det(1 + 2 E).
impl EnergyOfStrain for OwnNeoHookean {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T {
        let [a, b, c, d, e, f] = strain.components;
        let (two, four) = (T::lit(2.0), T::lit(4.0));
        let trace = a + b + c;
        let minors = (a * b - d * d) + (b * c - e * e) + (a * c - f * f);
        let determinant = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f);
        let growth = two * trace + four * minors + T::lit(8.0) * determinant;
        let volume = T::lit(0.5) * growth.ln_1p();
        T::lit(self.mu) * (trace - volume) + T::lit(0.5 * self.lambda) * volume * volume
    }
}

/// W = μ Σ (ln λₐ)² + ½ λ (ln J)².
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnHencky {
    mu: f64,
    lambda: f64,
}

impl EnergyOfStretches for OwnHencky {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, logarithm: T) -> T {
        T::lit(self.mu) * logarithm * logarithm
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(0.5 * self.lambda) * volume.logarithm * volume.logarithm
    }
}

/// Something done with a law of one's own and the built-in one.
pub(crate) trait Visit {
    /// Called with the name of the law, the way it is stated, one's own and the built-in one.
    ///
    /// # Errors
    /// Its own.
    fn pair<O: Hyperelastic + Sync, B: Hyperelastic + Sync>(
        &mut self,
        name: &'static str,
        way: &'static str,
        own: &O,
        built_in: &B,
    ) -> Result<(), Box<dyn Error>>;
}

/// Visits all laws.
///
/// # Errors
/// Those of the visitor.
pub(crate) fn each(visit: &mut impl Visit) -> Result<(), Box<dyn Error>> {
    let bulk = volumetric::Quadratic::new(20.0)?;
    let own = OwnNeoHookean { mu: 0.8, lambda: 3.0 };
    let built_in = NeoHookeanLogarithmic::with_constants(0.8, 3.0)?;
    visit.pair("neo_hookean", "invariants", &OfInvariants(own), &built_in)?;
    visit.pair("neo_hookean", "general", &OfStrain(own), &built_in)?;
    let own = OwnMooneyRivlin { c10: 0.5, c01: 0.25, c: 1.25 };
    visit.pair("mooney_rivlin", "invariants", &OfInvariants(own), &MooneyRivlin::stress_free(0.5, 0.25, 1.25)?)?;
    let own = OwnGent { mu: 1.0, limit: 50.0, kappa: 20.0 };
    let built_in = Compressible::new(isochoric::Gent::new(1.0, 50.0)?, bulk);
    visit.pair("gent", "invariants", &OfInvariants(own), &built_in)?;
    let own = OwnYeoh { c: [0.5, -0.02, 0.001], kappa: 20.0 };
    let built_in = Compressible::new(isochoric::Yeoh::new(0.5, -0.02, 0.001)?, bulk);
    visit.pair("yeoh", "invariants", &OfInvariants(own), &built_in)?;
    let own = OwnReinforced { mu: 1.0, lambda: 2.0, k: 3.0, fibre: [0.6, 0.8, 0.0] };
    let built_in = ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([0.6, 0.8, 0.0])?)?;
    visit.pair("reinforced_neo_hookean", "invariants", &OfInvariants(own), &built_in)?;
    let fibres = [[0.6, 0.8, 0.0], [0.6, -0.8, 0.0]];
    let own = OwnArtery { mu: 1.0, kappa: 20.0, k1: 2.0, k2: 0.8, dispersion: 0.1, fibres };
    let [a, b] = [Fibre::new(fibres[0])?, Fibre::new(fibres[1])?];
    let built_in = HolzapfelGasserOgden::new(1.0, 20.0, 2.0, 0.8, 0.1, [a, b])?;
    visit.pair("holzapfel_gasser_ogden", "invariants", &OfInvariants(own), &built_in)?;
    let own = OwnKirchhoff { lambda: 1.5, mu: 0.75 };
    visit.pair("saint_venant_kirchhoff", "general", &OfStrain(own), &SaintVenantKirchhoff::new(1.5, 0.75)?)?;
    let own = OwnFung { c: 1.0, lambda: 1.0, mu: 2.0 };
    visit.pair("fung", "general", &OfStrain(own), &Fung::new(1.0, Stiffness::isotropic(1.0, 2.0)?)?)?;
    let built_in = Hencky::new(2.0, 0.9)?;
    let own = OwnHencky { mu: 0.9, lambda: 2.0 };
    visit.pair("hencky", "stretches", &OfStretches(own), &built_in)
}
