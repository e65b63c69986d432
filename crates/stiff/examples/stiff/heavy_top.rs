//! A heavy top by its three directors, whose orthonormality is a constraint, in steady precession.

use core::convert::Infallible;

use piola_integrators::{Field, IntegratorsError};
use piola_numerics::Real;
use piola_stiff::{ExactJacobian, WithMass};

/// A cone of radius r = 0.05 m and height a = 0.1 m, density 2700 kg/m³, that turns about its tip, to t = 0.3.
///
/// y = (d, v, Λ) with the directors d = (d₁, d₂, d₃), their velocities and the reactions of dᵢ·dⱼ = δᵢⱼ, in the order 11, 22,
/// 33, 12, 13, 23. The constraints stand on velocities, so that the index is 2:
///
/// ```text
/// ḋᵢ = vᵢ     Eᵢ v̇ᵢ = Fᵢ − Σⱼ Λᵢⱼ dⱼ     0 = vᵢ·dⱼ + dᵢ·vⱼ
/// E₁ = E₂ = J₃/2     E₃ = J₁ − J₃/2 + m l²     F₃ = −m g l e_z
/// ```
///
/// Betsch & Leyendecker, *The discrete null space method*, Int. J. Numer. Meth. Engng 67 (2006) 499, have directors and top.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeavyTop;

const RADIUS: f64 = 0.05;
const HEIGHT: f64 = 0.1;
const MASS: f64 = 2700.0 * core::f64::consts::PI * RADIUS * RADIUS * HEIGHT / 3.0;
/// From the tip to the centre of mass.
const ARM: f64 = 0.75 * HEIGHT;
/// The moments of inertia about the centre of mass, across the axis and along it.
const ACROSS: f64 = 3.0 / 80.0 * MASS * (4.0 * RADIUS * RADIUS + HEIGHT * HEIGHT);
const ALONG: f64 = 0.3 * MASS * RADIUS * RADIUS;
const WEIGHT: f64 = MASS * 9.81;
/// E₁ = E₂ and E₃.
const EULER: [f64; 3] = [0.5 * ALONG, 0.5 * ALONG, ACROSS - 0.5 * ALONG + MASS * ARM * ARM];
/// Λ's pairs of directors.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
/// The rate of precession, rad/s.
const PRECESSION: f64 = 10.0;

fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (&a, &b)| sum + a * b)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

impl HeavyTop {
    pub(crate) const END: f64 = 0.3;

    /// With its exact Jacobian and its mass matrix.
    pub(crate) fn system(self) -> Result<WithMass<ExactJacobian<Self>>, IntegratorsError> {
        let masses = (0..18).map(|k| (k, k, if k < 9 { 1.0 } else { EULER[k / 3 - 3] })).collect();
        Ok(WithMass::from_entries(ExactJacobian::new(self), masses)?.with_index_two_from(18))
    }

    /// Steady precession at an angle of 60° to the vertical, in closed form: the axis turns about the vertical with 10 rad/s,
    /// the top about its axis with m g l/(J₃ ω) + (J₁ + m l² − J₃)/J₃ ω cos 60°.
    pub(crate) fn at(t: f64) -> Vec<f64> {
        let (tilt_sine, tilt_cosine) = (0.75_f64.sqrt(), 0.5);
        let spin = WEIGHT * ARM / (ALONG * PRECESSION)
            + (ACROSS + MASS * ARM * ARM - ALONG) / ALONG * PRECESSION * tilt_cosine;
        let ((s, c), (e, f)) = ((PRECESSION * t).sin_cos(), (spin * t).sin_cos());
        // A turn about z, one about x, one about the axis.
        let node = [c, s, 0.0];
        let beside = [-s * tilt_cosine, c * tilt_cosine, tilt_sine];
        let axis = [s * tilt_sine, -c * tilt_sine, tilt_cosine];
        let directors = [
            core::array::from_fn(|k| f * node[k] + e * beside[k]),
            core::array::from_fn(|k| f * beside[k] - e * node[k]),
            axis,
        ];
        let vertical = [0.0, 0.0, PRECESSION];
        let omega = core::array::from_fn(|k| vertical[k] + spin * axis[k]);
        let change = cross(vertical, axis).map(|x| spin * x);
        let velocities = directors.map(|d| cross(omega, d));
        // Λᵢⱼ = (Fᵢ − Eᵢ d̈ᵢ)·dⱼ.
        let reactions = PAIRS.map(|[i, j]| {
            let (turning, centripetal) = (cross(change, directors[i]), cross(omega, velocities[i]));
            let inertia: [f64; 3] = core::array::from_fn(|k| EULER[i] * (turning[k] + centripetal[k]));
            let force = if i == 2 { -WEIGHT * ARM * directors[j][2] } else { 0.0 };
            force - dot(&inertia, &directors[j])
        });
        [directors.as_flattened(), velocities.as_flattened(), &reactions].concat()
    }
}

impl<T: Real> Field<T> for HeavyTop {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        24
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (d, rest) = y.split_at(9);
        let (v, reactions) = rest.split_at(9);
        let of = |vectors: &[T], i: usize| -> [T; 3] { core::array::from_fn(|k| vectors[3 * i + k]) };
        rate.fill(T::zero());
        rate[..9].copy_from_slice(v);
        rate[17] = T::lit(-WEIGHT * ARM);
        for (pair, ([i, j], &reaction)) in PAIRS.into_iter().zip(reactions).enumerate() {
            for k in 0..3 {
                rate[9 + 3 * i + k] -= reaction * d[3 * j + k];
                if i != j {
                    rate[9 + 3 * j + k] -= reaction * d[3 * i + k];
                }
            }
            rate[18 + pair] = dot(&of(v, i), &of(d, j)) + dot(&of(d, i), &of(v, j));
        }
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        super::mechanisms::magnitudes_of_groups(&[9, 9, 6], y, magnitudes);
    }
}
