//! The Sun and the inner planets with the post-Newtonian term of the Sun.

use piola_numerics::Real;

use super::attraction::Attraction;
use super::reference::{array, numbers, read};
use super::{Accelerations, Equations, LONGEST_RUN, Problem, ReferenceError};

/// N bodies in space that attract each other, and the first post-Newtonian term of body 0 with its reaction:
///
/// ```text
/// Δaᵢ = μ/(c²r³) [(4μ/r − v·v) r + 4 (r·v) v]
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PostNewtonianAttraction<const N: usize> {
    /// The bodies.
    pub bodies: Attraction<N, 3>,
    /// The speed of light.
    pub speed_of_light: f64,
}

impl<const N: usize> Accelerations for PostNewtonianAttraction<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], v: &[T], out: &mut [T]) {
        self.bodies.accelerations(q, v, out);
        let (x, u, f) = (q.as_chunks::<N>().0, v.as_chunks::<N>().0, out.as_chunks_mut::<N>().0);
        let (Some(x), Some(u), Some(f)) = (x.first_chunk::<3>(), u.first_chunk::<3>(), f.first_chunk_mut::<3>()) else {
            return;
        };
        let mu = T::lit(self.bodies.parameters[0]);
        let inverse_square = T::lit(1.0 / (self.speed_of_light * self.speed_of_light));
        let four = T::lit(4.0);
        for i in 1..N {
            let (mut r, mut w) = ([T::zero(); 3], [T::zero(); 3]);
            let (mut r2, mut w2, mut rw) = (T::zero(), T::zero(), T::zero());
            for k in 0..3 {
                r[k] = x[k][i] - x[k][0];
                w[k] = u[k][i] - u[k][0];
                r2 += r[k] * r[k];
                w2 += w[k] * w[k];
                rw += r[k] * w[k];
            }
            let inverse = r2.sqrt().recip();
            let potential = mu * inverse;
            let factor = potential * inverse * inverse * inverse_square;
            let (along_r, along_v) = (factor * (four * potential - w2), factor * four * rw);
            let share = T::lit(self.bodies.parameters[i] / self.bodies.parameters[0]);
            for k in 0..3 {
                let change = along_r * r[k] + along_v * w[k];
                f[k][i] += change;
                f[k][0] -= share * change;
            }
        }
    }
}

impl Equations<30> for PostNewtonianAttraction<5> {
    #[inline]
    fn rate(&self, y: &[f64; 30], rate: &mut [f64; 30]) {
        let (position, velocity) = y.split_at(15);
        let (moving, acceleration) = rate.split_at_mut(15);
        moving.copy_from_slice(velocity);
        self.accelerations(position, velocity, acceleration);
    }
}

/// The Sun, Mercury, Venus, the Earth and Mars, ten years.
///
/// # Errors
/// The reference cannot be read.
pub fn inner_solar_system() -> Result<Problem<PostNewtonianAttraction<5>, 30>, ReferenceError> {
    let data = read("inner_solar_system")?;
    let one = |key: &str| numbers(&data[key]).map(|list| list.first().copied().unwrap_or(f64::NAN));
    Ok(Problem {
        name: "inner-solar-system",
        title: "Sun and inner planets with the post-Newtonian term, 10 years",
        equations: PostNewtonianAttraction {
            bodies: Attraction { parameters: array(&numbers(&data["parameters"])?)? },
            speed_of_light: one("speed_of_light")?,
        },
        start: array(&numbers(&data["initial_state"])?)?,
        end: one("end")?,
        reference: array(&numbers(&data["state"])?)?,
        small: 1e-2,
        longest_run: LONGEST_RUN,
    })
}
