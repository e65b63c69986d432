//! Bodies that attract each other, in the plane or in space.

use std::time::Duration;

use super::reference::{array, numbers, read};
use super::{Accelerations, Equations, Force, LONGEST_RUN, Problem, ReferenceError};
use piola_numerics::Real;

/// N bodies with C coordinates each; a state lists all x, all y, …, then the velocities.
#[derive(Clone, Copy, Debug)]
pub struct Attraction<const N: usize, const C: usize> {
    /// The parameters Gm.
    pub parameters: [f64; N],
}

impl<const N: usize, const C: usize> Force for Attraction<N, C> {
    #[inline]
    fn force(&self, position: &[f64], force: &mut [f64]) {
        let (x, f) = (position.as_chunks::<N>().0, force.as_chunks_mut::<N>().0);
        let (Some(x), Some(f)) = (x.first_chunk::<C>(), f.first_chunk_mut::<C>()) else { return };
        *f = [[0.0; N]; C];
        for i in 0..N {
            for j in i + 1..N {
                let mut distance = [0.0; C];
                let mut square = 0.0_f64;
                for c in 0..C {
                    distance[c] = x[c][j] - x[c][i];
                    square += distance[c] * distance[c];
                }
                let inverse_cube = 1.0 / (square * square.sqrt());
                let (on_i, on_j) = (self.parameters[j] * inverse_cube, self.parameters[i] * inverse_cube);
                for c in 0..C {
                    f[c][i] += on_i * distance[c];
                    f[c][j] -= on_j * distance[c];
                }
            }
        }
    }
}

impl<const N: usize, const C: usize> Accelerations for Attraction<N, C> {
    const VELOCITY_DEPENDENT: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], _v: &[T], out: &mut [T]) {
        let (x, f) = (q.as_chunks::<N>().0, out.as_chunks_mut::<N>().0);
        let (Some(x), Some(f)) = (x.first_chunk::<C>(), f.first_chunk_mut::<C>()) else { return };
        *f = [[T::zero(); N]; C];
        for i in 0..N {
            for j in i + 1..N {
                let mut distance = [T::zero(); C];
                let mut square = T::zero();
                for c in 0..C {
                    distance[c] = x[c][j] - x[c][i];
                    square += distance[c] * distance[c];
                }
                let inverse_cube = (square * square.sqrt()).recip();
                let on_i = T::lit(self.parameters[j]) * inverse_cube;
                let on_j = T::lit(self.parameters[i]) * inverse_cube;
                for c in 0..C {
                    f[c][i] += on_i * distance[c];
                    f[c][j] -= on_j * distance[c];
                }
            }
        }
    }
}

impl<const N: usize, const C: usize, const D: usize> Equations<D> for Attraction<N, C> {
    #[inline]
    fn rate(&self, y: &[f64; D], rate: &mut [f64; D]) {
        let (position, velocity) = y.split_at(D / 2);
        let (moving, force) = rate.split_at_mut(D / 2);
        moving.copy_from_slice(velocity);
        self.force(position, force);
    }
}

/// The Pleiades problem: seven bodies in the plane with close encounters.
///
/// # Errors
/// The reference cannot be read.
pub fn pleiades() -> Result<Problem<Attraction<7, 2>, 28>, ReferenceError> {
    let data = read("pleiades")?;
    Ok(Problem {
        name: "pleiades",
        title: "Pleiades: seven bodies with close encounters, to t = 3",
        equations: Attraction { parameters: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0] },
        start: array(&numbers(&data["initial_state"])?)?,
        end: 3.0,
        reference: array(&numbers(&data["own_reference_t3"]["state"])?)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}

/// The Sun with the outer planets, 548 years.
///
/// # Errors
/// The reference cannot be read.
pub fn outer_solar_system() -> Result<Problem<Attraction<6, 3>, 36>, ReferenceError> {
    let data = read("outer_solar_system")?;
    let constant = numbers(&data["G"])?.first().copied().unwrap_or(f64::NAN);
    let masses: [f64; 6] = array(&numbers(&data["masses"])?)?;
    let start = [numbers(&data["positions"])?, numbers(&data["velocities"])?].concat();
    let reference = numbers(&data["own_reference_T200000days"]["state"])?;
    Ok(Problem {
        name: "outer-solar-system",
        title: "Sun and outer planets, 200 000 days",
        equations: Attraction { parameters: masses.map(|mass| constant * mass) },
        start: array(&by_components(&start))?,
        end: 200_000.0,
        reference: array(&by_components(&reference))?,
        small: 1e-3,
        longest_run: LONGEST_RUN,
    })
}

/// The Sun with the outer planets about their centre of mass, ten thousand years.
///
/// # Errors
/// The reference cannot be read.
pub fn outer_solar_system_long() -> Result<Problem<Attraction<6, 3>, 36>, ReferenceError> {
    let data = read("outer_solar_system_long")?;
    Ok(Problem {
        name: "outer-solar-system-long",
        title: "Sun and outer planets, 10 000 years",
        equations: Attraction { parameters: array(&numbers(&data["parameters"])?)? },
        start: array(&numbers(&data["initial_state"])?)?,
        end: numbers(&data["end"])?.first().copied().unwrap_or(f64::NAN),
        reference: array(&numbers(&data["state"])?)?,
        small: 1e-3,
        longest_run: Duration::from_millis(500),
    })
}

/// A hundred bodies of one mass from Plummer's model, to t = 1/2.
///
/// # Errors
/// The reference cannot be read.
pub fn cluster() -> Result<Problem<Attraction<100, 3>, 600>, ReferenceError> {
    let data = read("cluster")?;
    Ok(Problem {
        name: "cluster",
        title: "Cluster of 100 bodies, to t = 1/2",
        equations: Attraction { parameters: array(&numbers(&data["parameters"])?)? },
        start: array(&numbers(&data["initial_state"])?)?,
        end: numbers(&data["end"])?.first().copied().unwrap_or(f64::NAN),
        reference: array(&numbers(&data["state"])?)?,
        small: 1.0,
        longest_run: Duration::from_millis(500),
    })
}

/// A state of triples, body after body, as one of components.
fn by_components(triples: &[f64]) -> Vec<f64> {
    let half = triples.len() / 2;
    let blocks = triples.chunks(half.max(1));
    blocks.flat_map(|block| (0..3).flat_map(move |c| block.iter().skip(c).step_by(3).copied())).collect()
}
