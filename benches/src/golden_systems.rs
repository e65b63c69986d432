//! The systems of the reference data beside their equations, derived and coded by hand.
//!
//! The closed forms use what a placement cannot know: symmetries, coordinates that do not appear, the inverse of
//! the metric written out.

use nalgebra::Vector3;
use serde_json::Value;

use crate::chain::Equations;

/// The parameters and the state of a case of `lagrange.json`.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// The name of its system.
    pub system: String,
    /// t, s.
    pub time: f64,
    /// q.
    pub q: Vec<f64>,
    /// q̇.
    pub v: Vec<f64>,
    parameters: Value,
}

impl Case {
    /// A case from its JSON.
    #[must_use]
    pub fn of(case: &Value) -> Option<Self> {
        let numbers = |key: &str| case[key].as_array().map(|list| list.iter().filter_map(Value::as_f64).collect());
        Some(Self {
            name: case["name"].as_str()?.to_owned(),
            system: case["system"].as_str()?.to_owned(),
            time: case["t"].as_f64()?,
            q: numbers("q")?,
            v: numbers("qdot")?,
            parameters: case["parameters"].clone(),
        })
    }

    /// A parameter; NaN where there is none.
    #[must_use]
    pub fn parameter(&self, name: &str) -> f64 {
        self.parameters[name].as_f64().unwrap_or(f64::NAN)
    }
}

/// Two masses and two lengths, and gravity.
#[inline]
#[must_use]
pub fn double_pendulum([m1, m2, l1, l2, g]: [f64; 5], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), q[1].sin_cos());
    let (s, c) = (s1 * c2 - c1 * s2, c1 * c2 + s1 * s2);
    let (a, b) = (l1 * v[0] * v[0], l2 * v[1] * v[1]);
    let denominator = m1 + m2 * s * s;
    [
        (m2 * g * s2 * c - (m1 + m2) * g * s1 - m2 * s * (b + a * c)) / (l1 * denominator),
        ((m1 + m2) * (g * s1 * c - g * s2 + a * s) + m2 * b * s * c) / (l2 * denominator),
    ]
}

/// Length and gravity.
#[inline]
#[must_use]
pub fn spherical_pendulum([l, g]: [f64; 2], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let (s, c) = q[0].sin_cos();
    [s * (v[1] * v[1] * c - g / l), -2.0 * v[0] * v[1] * c / s]
}

/// Masses of the cart and the pole, length, gravity.
#[inline]
#[must_use]
pub fn cart_pole([cart, m, l, g]: [f64; 4], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let (s, c) = q[1].sin_cos();
    let x = m * s * (l * v[1] * v[1] - g * c) / (cart + m * s * s);
    [x, (g * s - c * x) / l]
}

/// Radius, gravity, rate of turn, amplitude and frequency of its wobble.
#[inline]
#[must_use]
pub fn bead_on_hoop([r, g, rate, wobble, frequency]: [f64; 5], q: &[f64; 1], t: f64) -> [f64; 1] {
    let (s, c) = q[0].sin_cos();
    let turn = rate + wobble * frequency * (frequency * t).cos();
    [s * (turn * turn * c - g / r)]
}

/// Mass, height of the centre, transverse moment about the fixed point, axial moment, gravity.
#[inline]
#[must_use]
pub fn heavy_top([m, h, transverse, axial, g]: [f64; 5], q: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    let (s, c) = q[1].sin_cos();
    let spin = axial * (v[2] + v[0] * c);
    let nutation = ((transverse * v[0] * c - spin) * v[0] * s + m * g * h * s) / transverse;
    let precession = (spin - 2.0 * transverse * v[0] * c) * v[1] / (transverse * s);
    [precession, nutation, v[0] * v[1] * s - precession * c]
}

/// Mass, stiffness, rest length, gravity.
#[inline]
#[must_use]
pub fn elastic_pendulum([m, k, rest, g]: [f64; 4], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let (s, c) = q[1].sin_cos();
    [q[0] * v[1] * v[1] + g * c - k / m * (q[0] - rest), -(g * s + 2.0 * v[0] * v[1]) / q[0]]
}

/// Radii of the circle and of its tube, gravity.
#[inline]
#[must_use]
pub fn torus([large, small, g]: [f64; 3], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let (s, c) = q[1].sin_cos();
    let r = large + small * c;
    [2.0 * small * s * v[0] * v[1] / r, -(r * s * v[0] * v[0] + g * c) / small]
}

/// Charge over mass, electric and magnetic field.
#[inline]
#[must_use]
pub fn charged_particle(ratio: f64, fields: [Vector3<f64>; 2], q: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
    let (s, c) = q[1].sin_cos();
    let around = q[0] * v[1];
    let velocity = Vector3::new(v[0] * c - around * s, v[0] * s + around * c, v[2]);
    let a = ratio * (fields[0] + velocity.cross(&fields[1]));
    [a.x * c + a.y * s + around * v[1], (a.y * c - a.x * s - 2.0 * v[0] * v[1]) / q[0], a.z]
}

/// Length, gravity, rate of turn, latitude's sine and cosine.
#[inline]
#[must_use]
pub fn foucault([l, g, rate, sine, cosine]: [f64; 5], q: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    let height = -(l * l - q[0] * q[0] - q[1] * q[1]).sqrt();
    let r = Vector3::new(q[0], q[1], height);
    let velocity = Vector3::new(v[0], v[1], -(q[0] * v[0] + q[1] * v[1]) / height);
    let axis = Vector3::new(0.0, rate * cosine, rate * sine);
    let force = Vector3::new(0.0, 0.0, -g) - 2.0 * axis.cross(&velocity) - axis.cross(&axis.cross(&r));
    let tension = -(velocity.norm_squared() + r.dot(&force)) / (l * l);
    [force.x + tension * q[0], force.y + tension * q[1]]
}

/// Masses, moments, arms, gravity, stiffness of the hinge.
#[inline]
#[must_use]
pub fn hinge_planar([m1, m2, i1, i2, a1, a2, g, k]: [f64; 8], q: &[f64; 4], v: &[f64; 4]) -> [f64; 4] {
    let ((s1, c1), (s2, c2)) = (q[2].sin_cos(), q[3].sin_cos());
    let (w1, w2) = (v[2] * v[2], v[3] * v[3]);
    let (p1, p2) = (m2 * a1, m2 * a2);
    let mut equations = Equations::<4>::zero();
    let metric = &mut equations.metric;
    metric[(0, 0)] = m1 + m2;
    metric[(1, 1)] = m1 + m2;
    metric[(2, 0)] = -p1 * s1;
    metric[(3, 0)] = -p2 * s2;
    metric[(2, 1)] = p1 * c1;
    metric[(3, 1)] = p2 * c2;
    metric[(2, 2)] = i1 + p1 * a1;
    metric[(3, 3)] = i2 + p2 * a2;
    metric[(3, 2)] = p1 * a2 * (c1 * c2 + s1 * s2);
    let (coupling, turn) = (p1 * a2 * (s1 * c2 - c1 * s2), k * (q[3] - q[2]));
    equations.force[0] = p1 * c1 * w1 + p2 * c2 * w2;
    equations.force[1] = p1 * s1 * w1 + p2 * s2 * w2 - (m1 + m2) * g;
    equations.force[2] = turn - p1 * g * c1 - coupling * w2;
    equations.force[3] = coupling * w1 - p2 * g * c2 - turn;
    equations.solve().into()
}
