//! Finite J₂ plasticity and viscoplasticity with a back stress.

use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, identity, product};

use crate::error::check_bound;
use crate::viscoplastic::Hardening;
use crate::{Evolution, InelasticError, flow};

const LAW: &str = "J₂ plasticity with kinematic hardening";

/// The solid of [`Viscoplastic`](crate::Viscoplastic) whose yield surface moves: kinematic hardening of Armstrong and Frederick at finite strain,
/// beside the isotropic one.
///
/// ```text
/// P = Pₑ(F Fᵢ⁻¹) Fᵢ⁻ᵀ        Fᵢ = F̂ Fₖ: the back stress is that of a spring at F̂
/// Ḟᵢ = Dᵢ Fᵢ,   Dᵢ = α̇ (3/2) dev(M − χ)/σ,   σ = √(3/2) |dev(M − χ)|,   χ = τ of the spring at F̂
/// Ḟₖ = Dₖ Fₖ,   Dₖ = α̇ β dev M̂,   M̂ = Mandel's stress of the spring at F̂
/// α̇ = ⟨σ − σ(α)⟩/η,  or  σ ≤ σ(α), 0 ≤ α̇ for η = 0
/// ```
/// β = 0 is Prager's linear hardening. At small strain χ = 2 c (εᵢ − εₖ) with the spring's shear modulus c, which is
/// `χ̇ = 2 c (ε̇ᵢ − β α̇ χ)`. In monotonic loading √(3/2) |χ| tends to 3/(2 β).
///
/// Both laws may be any isotropic energy. The nineteen internal variables are Fᵢ by rows, α, Fₖ by rows.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | σ(α) | `hardening` | Pa | see [`Hardening`] |
/// | β | `recovery` | 1/Pa | 0 ≤ β |
/// | η | `viscosity` | Pa s | 0 ≤ η |
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl); det Fᵢ = det Fₖ = 1 to rounding.
///
/// # Example
/// Prager's hardening in small shear: after yield the slope of the stress is 2 μ c/(μ + c) for a strain ½ k.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{Hardening, InelasticPoint, Kinematic, StepControl};
/// use piola_solids::Hencky;
/// let yield_stress = 1e-6 * 3.0_f64.sqrt();
/// let hardening = Hardening { yield_stress, linear: 0.0, saturation: yield_stress, saturation_exponent: 0.0 };
/// let law = Kinematic::new(Hencky::new(1.0, 1.0)?, Hencky::new(0.0, 0.25)?, hardening, 0.0, 0.0)?;
/// let mut point = InelasticPoint::new(&law);
/// let mut stress = |k: f64| -> Result<f64, Box<dyn std::error::Error>> {
///     let shear = DeformationGradient::simple_shear(k)?;
///     Ok(point.advance(&shear, 1.0, &StepControl::one_step())?.first_piola.0[(0, 1)])
/// };
/// assert!((stress(3e-6)? - 1.4e-6).abs() < 1e-10); // 1e-6 + (3e-6 − 1e-6) μ c/(μ + c)
/// assert!((stress(1e-6)? + 0.6e-6).abs() < 1e-10); // yields in the other sense at 1.4e-6 − 2e-6
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W. Dettmer and S. Reese, Comput. Methods Appl. Mech. Engrg. 193 (2004) 87–116.
#[doc(alias("Armstrong-Frederick", "Prager", "back stress", "Bauschinger"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Kinematic<L, K> {
    pub(crate) elastic: L,
    pub(crate) back: K,
    hardening: Hardening,
    recovery: f64,
    viscosity: f64,
}

/// What a state and the unknowns of a step give the equations.
struct At<T> {
    /// dev(M − χ).
    driving: Symmetric<T>,
    /// √(3/2) |dev(M − χ)|.
    stress: T,
    /// dev M̂.
    back: Symmetric<T>,
}

/// Fₖ of the last nine internal variables.
fn second<T: Real>(state: &[T; 19]) -> [T; 9] {
    let mut nine = [T::zero(); 9];
    for (value, entry) in nine.iter_mut().zip(&state[10..]) {
        *value = *entry;
    }
    nine
}

fn with_second<T: Real>(mut state: [T; 19], nine: &[T; 9]) -> [T; 19] {
    for (entry, value) in state[10..].iter_mut().zip(nine) {
        *entry = *value;
    }
    state
}

/// The increment of Fₖ among the unknowns.
fn second_increment<T: Real>(unknowns: &[T; 13]) -> Symmetric<T> {
    let mut components = [T::zero(); 6];
    for (component, unknown) in components.iter_mut().zip(&unknowns[7..]) {
        *component = *unknown;
    }
    Symmetric { components }
}

impl<L: Hyperelastic, K: Hyperelastic> Kinematic<L, K> {
    /// Of the elastic law, the spring of the back stress, its yield stress, β, 1/Pa, and η, Pa s.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(
        elastic: L,
        back: K,
        hardening: Hardening,
        recovery: f64,
        viscosity: f64,
    ) -> Result<Self, InelasticError> {
        check_bound(LAW, "recovery", recovery, "0 ≤ β", 0.0 <= recovery)?;
        check_bound(LAW, "viscosity", viscosity, "0 ≤ η", 0.0 <= viscosity)?;
        Ok(Self { elastic, back, hardening: hardening.checked()?, recovery, viscosity })
    }

    fn at<T: Real>(&self, from: &[T; 19], gradient: &Rows<T>, increments: [&Symmetric<T>; 2]) -> At<T> {
        let elastic = flow::elastic(gradient, &flow::inelastic(from), increments[0]);
        // F̂ = exp(Δ) Fᵢ Fₖ⁻¹ exp(−Δₖ).
        let before = flow::elastic(&flow::inelastic(from), &flow::inelastic(&second(from)), increments[1]);
        let hat = product(flow::exponential(increments[0]), before);
        let chi = self.back.kirchhoff(&DeformationGradient::trusted(hat)).0;
        let driving = (flow::mandel(&self.elastic, &elastic) - chi).deviator();
        let square = flow::square(&driving, self.hardening.yield_stress);
        At { driving, stress: (T::lit(1.5) * square).sqrt(), back: flow::mandel(&self.back, &hat).deviator() }
    }
}

impl<L: Hyperelastic, K: Hyperelastic> Evolution<19, 13> for Kinematic<L, K> {
    fn initial(&self) -> [f64; 19] {
        let mut state = flow::virgin();
        for (entry, value) in state[10..].iter_mut().zip(identity::<f64>().as_flattened()) {
            *entry = *value;
        }
        state
    }

    fn evolves(&self, from: &[f64; 19], gradient: &Rows<f64>, _dt: f64) -> bool {
        let nothing = Symmetric::zero();
        self.hardening.stress(from[9]) < self.at(from, gradient, [&nothing, &nothing]).stress
    }

    fn residual<T: Real>(&self, from: &[T; 19], gradient: &Rows<T>, unknowns: &[T; 13], dt: f64) -> [T; 13] {
        let (increment, strain, second) = (flow::increment(unknowns), unknowns[6], second_increment(unknowns));
        let at = self.at(from, gradient, [&increment, &second]);
        let [a, b, c, d, e, f] = (increment - at.driving * (T::lit(1.5) * strain / at.stress)).components;
        let [g, h, i, j, k, l] = (second - at.back * (T::lit(self.recovery) * strain)).components;
        // σ − σ(α) = η α̇, as a strain: over the yield stress, and free of Δt where that is short.
        let beyond = (at.stress - self.hardening.stress(from[9] + strain)) * T::lit(1.0 / self.hardening.yield_stress);
        let viscous = strain * T::lit(self.viscosity / self.hardening.yield_stress);
        let rate = if 0.0 < self.viscosity { beyond * T::lit(dt) - viscous } else { beyond };
        [a, b, c, d, e, f, rate, g, h, i, j, k, l]
    }

    fn updated<T: Real>(&self, from: &[T; 19], _gradient: &Rows<T>, unknowns: &[T; 13], _dt: f64) -> [T; 19] {
        let after = product(flow::exponential(&flow::increment(unknowns)), flow::inelastic(from));
        let back = product(flow::exponential(&second_increment(unknowns)), flow::inelastic(&second(from)));
        let mut state = with_second(flow::with_inelastic(*from, &after), &flow::with_inelastic([T::zero(); 9], &back));
        state[9] += unknowns[6];
        state
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 19]) -> Rows<T> {
        flow::first_piola(&self.elastic, gradient, &flow::inelastic(state))
    }

    fn coordinates<T: Real>(&self, about: &[T; 19], state: &[T; 19]) -> [T; 19] {
        with_second(flow::coordinates(about, state), &flow::coordinates(&second(about), &second(state)))
    }

    fn at_coordinates<T: Real>(&self, about: &[T; 19], coordinates: &[T; 19]) -> [T; 19] {
        let back = flow::at_coordinates(&second(about), &second(coordinates), true);
        with_second(flow::at_coordinates(about, coordinates, true), &back)
    }

    /// (M − χ) : Δ + M̂ : Δₖ.
    fn dissipated(&self, from: &[f64; 19], gradient: &Rows<f64>, state: &[f64; 19]) -> f64 {
        let nothing = Symmetric::zero();
        let at = self.at(state, gradient, [&nothing, &nothing]);
        let change = |coordinates: Rows<f64>| Symmetric::symmetric_part(coordinates);
        let flown = change(flow::inelastic(&flow::coordinates(from, state)));
        let recovered = change(flow::inelastic(&flow::coordinates(&second(from), &second(state))));
        at.driving.double_contraction(&flown) + at.back.double_contraction(&recovered)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 19]) -> Result<(), SolidsError> {
        let nothing = Symmetric::zero();
        let elastic = flow::elastic(gradient, &flow::inelastic(state), &nothing);
        self.elastic.check(&DeformationGradient::trusted(elastic))?;
        let hat = flow::elastic(&flow::inelastic(state), &flow::inelastic(&second(state)), &nothing);
        self.back.check(&DeformationGradient::trusted(hat))
    }
}
