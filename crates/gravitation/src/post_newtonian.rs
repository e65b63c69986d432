//! The first post-Newtonian term of one central body.

use piola_numerics::Real;

/// The speed of light in vacuum, m/s (exact).
pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;

/// The first post-Newtonian term of one body, acting on all others.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PostNewtonian {
    /// The index of the central body.
    pub centre: usize,
    /// The speed of light, m/s: [`SPEED_OF_LIGHT`] unless the scene has other units.
    pub speed_of_light: f64,
}

impl PostNewtonian {
    /// The term of one central body, in SI units.
    #[must_use]
    pub const fn of(centre: usize) -> Self {
        Self { centre, speed_of_light: SPEED_OF_LIGHT }
    }
}

/// The post-Newtonian part of the acceleration of a body about a centre.
///
/// ```text
/// Δa = μ/(c²r³) [(4μ/r − v·v) r + 4 (r·v) v]
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | r, v | `position`, `velocity`, relative to the centre | 3 | m, m/s |
/// | μ | `parameter` Gm of the centre | scalar | m³/s² |
/// | c | `speed_of_light` | scalar | m/s |
/// | Δa | returned | 3 | m/s² |
///
/// Valid for μ/(c²r) ≪ 1 and |v| ≪ c; the neglected terms are smaller by these ratios.
///
/// # Example
/// ```
/// use piola_gravitation::post_newtonian_acceleration;
/// // At rest: 4μ²/(c²r³) outwards.
/// let a = post_newtonian_acceleration([2.0, 0.0, 0.0], [0.0; 3], 2.0, 1.0);
/// assert_eq!(a, [2.0, 0.0, 0.0]);
/// ```
///
/// # Source
/// The term of a point mass in harmonic coordinates (Einstein, Infeld & Hoffmann 1938, test-body limit).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn post_newtonian_acceleration<T: Real>(
    position: [T; 3],
    velocity: [T; 3],
    parameter: T,
    speed_of_light: T,
) -> [T; 3] {
    let dot = |a: [T; 3], b: [T; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let r2 = dot(position, position);
    let r = r2.sqrt();
    let along_r = T::lit(4.0) * parameter / r - dot(velocity, velocity);
    let along_v = T::lit(4.0) * dot(position, velocity);
    let factor = parameter / (speed_of_light * speed_of_light * r2 * r);
    core::array::from_fn(|k| factor * (along_r * position[k] + along_v * velocity[k]))
}

/// Adds the term to the accelerations, with the reaction on the centre so that Σ m Δa = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn add<T: Real>(
    parameters: &[f64],
    term: PostNewtonian,
    [positions, velocities]: [&[T]; 2],
    accelerations: &mut [T],
) {
    let (n, centre) = (parameters.len(), term.centre);
    let mut reaction = [T::zero(); 3];
    for (body, &parameter) in parameters.iter().enumerate() {
        if body == centre {
            continue;
        }
        let (mut position, mut velocity) = ([T::zero(); 3], [T::zero(); 3]);
        for k in 0..3 {
            position[k] = positions[k * n + body] - positions[k * n + centre];
            velocity[k] = velocities[k * n + body] - velocities[k * n + centre];
        }
        let mu = T::lit(parameters[centre]);
        let change = post_newtonian_acceleration(position, velocity, mu, T::lit(term.speed_of_light));
        for k in 0..3 {
            accelerations[k * n + body] += change[k];
            reaction[k] += T::lit(parameter) * change[k];
        }
    }
    for (k, reaction) in reaction.into_iter().enumerate() {
        accelerations[k * n + centre] -= reaction / T::lit(parameters[centre]);
    }
}

/// The post-Newtonian part of the energy of a body about a centre, per unit mass.
///
/// ```text
/// Δe = (1/c²) [ ⅜ (v·v)² + (3/2) (μ/r) v·v + ½ (μ/r)² ]
/// ```
pub(super) fn energy(position: [f64; 3], velocity: [f64; 3], parameter: f64, speed_of_light: f64) -> f64 {
    let square = |a: [f64; 3]| a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    let v2 = square(velocity);
    let potential = parameter / square(position).sqrt();
    (0.375 * v2 * v2 + 1.5 * potential * v2 + 0.5 * potential * potential) / (speed_of_light * speed_of_light)
}
