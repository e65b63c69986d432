//! Motion of an elastic body between walls, each mode by its exact solution.

mod oscillator;

use crate::basis::{ModalSeries, is_same_box};
use crate::error::{SpectralError, check_bound};
use crate::operator::{BoxOperator, LameParameters};

use oscillator::{DEGREE, Propagator};

/// The motion of ρü + cu̇ = Lu + f by modes: every step is exact, whatever its length.
///
/// Each mode is a damped oscillator of stiffness −κ. Its step is a closed form for weak, critical and strong damping, and for
/// forces that are polynomials in time, up to degree 3, during the step. There is no limit of stability and no error of
/// discretisation in time; with c = 0 and no force, the energy of each mode keeps its value to rounding.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | ρ | `density` | kg/m³ |
/// | c | `drag` | kg/(m³ s) |
/// | u, u̇ | `displacement`, `velocity` | m, m/s |
///
/// # Example
/// An undamped bar in its first mode: ω = π √((λ + 2μ)/ρ), and half a period turns the displacement over.
/// ```
/// use piola_spectral::{BoxOperator, LameParameters, ModalMotion, ModalSeries, Walls};
/// let lame = LameParameters::new(2.0, 1.0)?;
/// let mut start = ModalSeries::zeros([1.0, 1.0], Walls::Sliding, [2, 2])?;
/// start.set_amplitudes([1, 0], [1.0, 0.0])?;
/// let rest = ModalSeries::zeros([1.0, 1.0], Walls::Sliding, [2, 2])?;
/// let mut motion = ModalMotion::new(BoxOperator::elastic(lame), 1.0, 0.0, start, rest)?;
/// motion.step(0.5, &[])?; // ω = 2π: half a period
/// assert!((motion.displacement().amplitudes([1, 0])[0] + 1.0).abs() < 1e-15);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.58) with B(4.91).
#[derive(Clone, Debug, PartialEq)]
pub struct ModalMotion<const D: usize> {
    operator: BoxOperator,
    density: f64,
    drag: f64,
    time: f64,
    displacement: ModalSeries<D>,
    velocity: ModalSeries<D>,
}

impl<const D: usize> ModalMotion<D> {
    /// A motion from its displacement and velocity at t = 0.
    ///
    /// # Errors
    /// 0 < ρ or 0 ≤ c violated; displacement and velocity on other boxes, between other walls or with other indices.
    pub fn new(
        operator: BoxOperator,
        density: f64,
        drag: f64,
        displacement: ModalSeries<D>,
        velocity: ModalSeries<D>,
    ) -> Result<Self, SpectralError> {
        check_bound("ρ", density, "0 < ρ", 0.0 < density)?;
        check_bound("c", drag, "0 <= c", 0.0 <= drag)?;
        check_same(&displacement, &velocity, "velocity")?;
        Ok(Self { operator, density, drag, time: 0.0, displacement, velocity })
    }

    /// The time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The displacement, m.
    #[must_use]
    pub fn displacement(&self) -> &ModalSeries<D> {
        &self.displacement
    }

    /// The velocity, m/s.
    #[must_use]
    pub fn velocity(&self) -> &ModalSeries<D> {
        &self.velocity
    }

    /// Advances by h under the force f₀ + f₁ s + f₂ s² + f₃ s³, s the time since the start of the step.
    ///
    /// `force` has the modes of f₀, f₁, …, N/m³, N/(m³ s), …: none for a free motion, at most four.
    ///
    /// # Errors
    /// h not finite, or 0 ≤ h violated; more than four forces; forces on another box, between other walls or with other
    /// indices.
    ///
    /// # Accuracy
    /// Some 32 ulp of the amplitudes for each step, and the rounding of the phase, ωh ulp.
    pub fn step(&mut self, h: f64, force: &[ModalSeries<D>]) -> Result<(), SpectralError> {
        check_bound("h", h, "0 <= h", 0.0 <= h)?;
        if DEGREE + 1 < force.len() {
            return Err(SpectralError::WrongLength { quantity: "force", found: force.len(), expected: DEGREE + 1 });
        }
        for force in force {
            check_same(&self.displacement, force, "force")?;
        }
        let mut last: Option<(f64, [Propagator; 2])> = None;
        for position in 1..self.displacement.amplitudes[0].len() {
            let indices = self.displacement.indices(position);
            let q = self.displacement.wave_vector(indices);
            let squared: f64 = q.iter().map(|q| q * q).sum();
            let propagators = match last {
                Some((before, propagators)) if before.to_bits() == squared.to_bits() => propagators,
                _ => {
                    let propagator =
                        |kappa: f64| Propagator::new(self.density, self.drag, -kappa, h, !force.is_empty());
                    self.operator.eigenvalues(squared).map(propagator)
                }
            };
            last = Some((squared, propagators));
            let at = |series: &ModalSeries<D>| -> [f64; D] {
                std::array::from_fn(|component| {
                    let is_zero = self.displacement.is_zero(component, indices);
                    if is_zero { 0.0 } else { series.amplitudes[component][position] }
                })
            };
            let split = |vector: [f64; D]| {
                let projected: f64 = q.iter().zip(&vector).map(|(q, a)| q * a).sum::<f64>() / squared;
                let along = q.map(|q| projected * q);
                [along, std::array::from_fn(|component| vector[component] - along[component])]
            };
            let (u, v) = (split(at(&self.displacement)), split(at(&self.velocity)));
            let (mut displacement, mut velocity) = ([0.0; D], [0.0; D]);
            for (part, Propagator { transfer, forced }) in propagators.iter().enumerate() {
                for component in 0..D {
                    let (u, v) = (u[part][component], v[part][component]);
                    displacement[component] += transfer[0][0] * u + transfer[0][1] * v;
                    velocity[component] += transfer[1][0] * u + transfer[1][1] * v;
                }
                for (power, force) in force.iter().enumerate() {
                    let f = split(at(force))[part];
                    for component in 0..D {
                        displacement[component] += forced[power][0] * f[component];
                        velocity[component] += forced[power][1] * f[component];
                    }
                }
            }
            for component in 0..D {
                let is_zero = self.displacement.is_zero(component, indices);
                self.displacement.amplitudes[component][position] = if is_zero { 0.0 } else { displacement[component] };
                self.velocity.amplitudes[component][position] = if is_zero { 0.0 } else { velocity[component] };
            }
        }
        self.time += h;
        Ok(())
    }

    /// The kinetic energy ½∫ρ u̇² dV, J (in a rectangle: J/m).
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.density * self.velocity.squared_norm()
    }

    /// The elastic energy, J (in a rectangle: J/m): see [`ModalSeries::elastic_energy`].
    #[must_use]
    pub fn elastic_energy(&self, lame: LameParameters) -> f64 {
        self.displacement.elastic_energy(lame)
    }
}

fn check_same<const D: usize>(
    one: &ModalSeries<D>,
    other: &ModalSeries<D>,
    quantity: &'static str,
) -> Result<(), SpectralError> {
    let is_same =
        is_same_box(&one.sides(), &other.sides()) && one.walls() == other.walls() && one.highest() == other.highest();
    if is_same { Ok(()) } else { Err(SpectralError::OtherGrid { quantity }) }
}
