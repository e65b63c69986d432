//! Positions and velocities in glam's types.

use glam::DVec3;

use super::Gravitation;

impl Gravitation {
    /// [`position`](Self::position) as a `DVec3`. [`state`](Self::state) takes slices of them.
    ///
    /// # Example
    /// ```
    /// use glam::DVec3;
    /// use piola_gravitation::Gravitation;
    /// let pair = Gravitation::new(vec![1.0, 1.0])?;
    /// let state = pair.state(&[DVec3::X, DVec3::NEG_X], &[DVec3::Y, DVec3::NEG_Y])?;
    /// assert_eq!(pair.position_dvec3(&state, 1), DVec3::new(-1.0, 0.0, 0.0));
    /// assert_eq!(pair.velocity_dvec3(&state, 0), DVec3::new(0.0, 1.0, 0.0));
    /// # Ok::<(), piola_gravitation::GravitationError>(())
    /// ```
    ///
    /// # Panics
    /// As [`position`](Self::position).
    #[must_use]
    pub fn position_dvec3(&self, state: &[f64], body: usize) -> DVec3 {
        self.position(state, body).into()
    }

    /// [`velocity`](Self::velocity) as a `DVec3`.
    ///
    /// # Panics
    /// As [`position`](Self::position).
    #[must_use]
    pub fn velocity_dvec3(&self, state: &[f64], body: usize) -> DVec3 {
        self.velocity(state, body).into()
    }
}
