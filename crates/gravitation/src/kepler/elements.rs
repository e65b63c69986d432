//! From orbital elements to a state.

/// The six elements of an ellipse about the origin.
///
/// # Example
/// ```
/// use piola_gravitation::kepler::Elements;
/// let elements = Elements { semi_major_axis: 2.0, eccentricity: 0.5, ..Elements::CIRCLE };
/// let (position, velocity) = elements.state(1.0);
/// assert_eq!(position, [1.0, 0.0, 0.0]); // pericentre a (1 − e)
/// assert!((velocity[1] - 1.5_f64.sqrt()).abs() < 1e-15); // √(μ/a (1 + e)/(1 − e))
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elements {
    /// a, m.
    pub semi_major_axis: f64,
    /// e, 0 ≤ e < 1.
    pub eccentricity: f64,
    /// i, rad.
    pub inclination: f64,
    /// Ω, rad.
    pub ascending_node: f64,
    /// ω, rad.
    pub argument_of_pericentre: f64,
    /// M, rad.
    pub mean_anomaly: f64,
}

impl Elements {
    /// The unit circle in the x–y plane, from the x axis.
    pub const CIRCLE: Self = Self {
        semi_major_axis: 1.0,
        eccentricity: 0.0,
        inclination: 0.0,
        ascending_node: 0.0,
        argument_of_pericentre: 0.0,
        mean_anomaly: 0.0,
    };

    /// Position (m) and velocity (m/s) for the gravitational parameter μ = `gm` (m³/s²).
    ///
    /// ```text
    /// x = a (cos E − e) P + a √(1 − e²) sin E Q
    /// v = √(μ/a)/(1 − e cos E) [ −sin E P + √(1 − e²) cos E Q ]
    /// ```
    /// with P towards the pericentre and Q a quarter turn on.
    #[must_use]
    pub fn state(&self, gm: f64) -> ([f64; 3], [f64; 3]) {
        let (a, e) = (self.semi_major_axis, self.eccentricity);
        let turn = core::f64::consts::TAU;
        let mean = self.mean_anomaly - turn * (self.mean_anomaly / turn).round();
        let anomaly = super::motion::eccentric_anomaly(mean, e, 1.0 - e);
        let (s, c) = anomaly.sin_cos();
        let minor = ((1.0 - e) * (1.0 + e)).sqrt();
        // cos E − e = (1 − e) − (1 − cos E), without cancellation near the pericentre.
        let half = (0.5 * anomaly).sin();
        let (along, across) = (a * ((1.0 - e) - 2.0 * half * half), a * minor * s);
        let speed = (gm / a).sqrt() / ((1.0 - e) + 2.0 * e * half * half);
        let (p, q) = self.axes();
        let combine = |x: f64, y: f64| [0, 1, 2].map(|i| x * p[i] + y * q[i]);
        (combine(along, across), combine(-speed * s, speed * minor * c))
    }

    /// Unit vectors towards the pericentre and a quarter turn on.
    fn axes(&self) -> ([f64; 3], [f64; 3]) {
        let (si, ci) = self.inclination.sin_cos();
        let (sn, cn) = self.ascending_node.sin_cos();
        let (sw, cw) = self.argument_of_pericentre.sin_cos();
        let p = [cn * cw - sn * sw * ci, sn * cw + cn * sw * ci, sw * si];
        let q = [-cn * sw - sn * cw * ci, -sn * sw + cn * cw * ci, cw * si];
        (p, q)
    }
}
