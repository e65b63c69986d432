//! Explicit damped motion of nodes, by central differences.

use super::check_length;
use crate::FieldsError;
use crate::error::check_finite;

/// Nodes with masses that move under forces and damping, by central differences.
///
/// ```text
/// M ü + C u̇ = F(u, t),     M, C diagonal                                       B(4.58)
/// (1 + k) v_{n+½} = v_n + h/2 F_n/m,        u_{n+1} = u_n + h v_{n+½},        k = h c/2m
///       v_{n+1}   = (1 − k) v_{n+½} + h/2 F_{n+1}/m
/// ```
///
/// One evaluation of the forces a step. Without damping it is the leapfrog method: symplectic, with the energy
/// bounded. Stable for h < 2/ω with ω the highest frequency, whatever the damping
/// ([`stable_step`](super::TetrahedralElements::stable_step) bounds it).
///
/// # Accuracy
/// Second order in h.
///
/// # Example
/// ```
/// use piola_fields::integral::ExplicitMotion;
/// // A node on a spring along x, released at u = 1: cos t.
/// let mut motion = ExplicitMotion::new(&[1.0], &[0.0])?;
/// motion.set_state(0.0, &[1.0, 0.0, 0.0], &[0.0; 3])?;
/// let spring = |_: f64, u: &[f64], force: &mut [f64]| {
///     force[0] -= u[0];
///     Ok(())
/// };
/// for _ in 0..1000 {
///     motion.step(1e-3, spring)?;
/// }
/// assert!((motion.displacement()[0] - 1.0_f64.cos()).abs() < 1e-7);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// B(4.58).
#[derive(Clone, Debug)]
pub struct ExplicitMotion {
    /// One a node.
    masses: Vec<f64>,
    /// One a node.
    damping: Vec<f64>,
    /// One a component.
    is_held: Vec<bool>,
    time: f64,
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    /// Whether `force` belongs to the state.
    is_current: bool,
}

impl ExplicitMotion {
    /// Nodes at rest with masses m (kg) and damping coefficients c (kg/s).
    ///
    /// # Errors
    /// [`FieldsError::NonPositiveMass`], [`FieldsError::NegativeDamping`], [`FieldsError::NotFinite`],
    /// [`FieldsError::WrongLength`].
    pub fn new(masses: &[f64], damping: &[f64]) -> Result<Self, FieldsError> {
        check_length("damping", damping.len(), masses.len())?;
        check_finite("mass", masses)?;
        check_finite("damping", damping)?;
        if let Some((index, &mass)) = masses.iter().enumerate().find(|(_, mass)| **mass <= 0.0) {
            return Err(FieldsError::NonPositiveMass { index, mass });
        }
        if let Some((node, &damping)) = damping.iter().enumerate().find(|(_, damping)| **damping < 0.0) {
            return Err(FieldsError::NegativeDamping { node, damping });
        }
        let zeros = vec![0.0; 3 * masses.len()];
        Ok(Self {
            masses: masses.to_vec(),
            damping: damping.to_vec(),
            is_held: vec![false; zeros.len()],
            time: 0.0,
            displacement: zeros.clone(),
            velocity: zeros.clone(),
            force: zeros,
            is_current: false,
        })
    }

    /// Holds a component, 3 × node + direction: its velocity is zero from now on.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`] when there is no such component.
    pub fn hold(&mut self, component: usize) -> Result<(), FieldsError> {
        let expected = self.is_held.len();
        let is_held = self.is_held.get_mut(component).ok_or(FieldsError::WrongLength {
            quantity: "components up to the one held",
            found: component.saturating_add(1),
            expected,
        })?;
        *is_held = true;
        self.velocity[component] = 0.0;
        Ok(())
    }

    /// Sets time (s), displacements (m) and velocities (m/s); those of held components are zero.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`], [`FieldsError::NotFinite`].
    pub fn set_state(&mut self, t: f64, displacement: &[f64], velocity: &[f64]) -> Result<(), FieldsError> {
        check_length("displacement", displacement.len(), self.displacement.len())?;
        check_length("velocity", velocity.len(), self.velocity.len())?;
        check_finite("time", &[t])?;
        check_finite("displacement", displacement)?;
        check_finite("velocity", velocity)?;
        self.time = t;
        self.displacement.copy_from_slice(displacement);
        for ((v, &given), &is_held) in self.velocity.iter_mut().zip(velocity).zip(&self.is_held) {
            *v = if is_held { 0.0 } else { given };
        }
        self.is_current = false;
        Ok(())
    }

    /// t, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// u, m.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// u̇, m/s.
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// ½ Σ m v², J.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.square_weighted_by(&self.masses)
    }

    /// Σ c v², the power that the damping takes, W.
    #[must_use]
    pub fn dissipation(&self) -> f64 {
        self.square_weighted_by(&self.damping)
    }

    fn square_weighted_by(&self, weights: &[f64]) -> f64 {
        let square = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        self.velocity.chunks_exact(3).zip(weights).map(|(v, weight)| weight * square(v)).sum()
    }

    /// The accelerations (F − C u̇)/M of a state, with which any integrator can advance it.
    ///
    /// The forces are added by `forces`, as in [`step`](Self::step).
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`]; those of the forces.
    pub fn accelerations_into(
        &self,
        t: f64,
        displacement: &[f64],
        velocity: &[f64],
        mut forces: impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), FieldsError>,
        accelerations: &mut [f64],
    ) -> Result<(), FieldsError> {
        check_length("displacement", displacement.len(), self.displacement.len())?;
        check_length("velocity", velocity.len(), self.displacement.len())?;
        check_length("accelerations", accelerations.len(), self.displacement.len())?;
        accelerations.fill(0.0);
        forces(t, displacement, accelerations)?;
        for (component, (a, v)) in accelerations.iter_mut().zip(velocity).enumerate() {
            let node = component / 3;
            *a = if self.is_held[component] { 0.0 } else { (*a - self.damping[node] * v) / self.masses[node] };
        }
        Ok(())
    }

    /// One step of length h.
    ///
    /// `forces(t, u, F)` adds the forces at displacement u to F, which is zero before.
    ///
    /// # Errors
    /// Those of the forces, and [`FieldsError::NotFinite`] for a component of a force: the displacement is then
    /// that of the end of the step, the velocity that of its middle.
    pub fn step(
        &mut self,
        step: f64,
        mut forces: impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        check_finite("step", &[step])?;
        if !self.is_current {
            self.evaluate(&mut forces)?;
        }
        for component in 0..self.displacement.len() {
            if !self.is_held[component] {
                let (mass, k) = self.ratios(component, step);
                let middle = (self.velocity[component] + 0.5 * step * self.force[component] / mass) / (1.0 + k);
                self.velocity[component] = middle;
                self.displacement[component] += step * middle;
            }
        }
        self.time += step;
        self.evaluate(&mut forces)?;
        for component in 0..self.displacement.len() {
            if !self.is_held[component] {
                let (mass, k) = self.ratios(component, step);
                let middle = self.velocity[component];
                self.velocity[component] = (1.0 - k) * middle + 0.5 * step * self.force[component] / mass;
            }
        }
        Ok(())
    }

    fn evaluate(
        &mut self,
        forces: &mut impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        self.is_current = false;
        self.force.fill(0.0);
        forces(self.time, &self.displacement, &mut self.force)?;
        check_finite("force", &self.force)?;
        self.is_current = true;
        Ok(())
    }

    /// (m, h c/2m) of a component.
    fn ratios(&self, component: usize, step: f64) -> (f64, f64) {
        let (mass, damping) = (self.masses[component / 3], self.damping[component / 3]);
        (mass, 0.5 * step * damping / mass)
    }
}
