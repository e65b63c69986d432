//! Mechanisms with constraints, M ẏ = f(t, y) with a singular M: Andrews' squeezer and the car axis.

use core::convert::Infallible;

use piola_integrators::{Field, IntegratorsError};
use piola_numerics::Real;
use piola_stiff::{ExactJacobian, WithMass};

/// A diagonal mass matrix by its entries.
fn diagonal(masses: impl IntoIterator<Item = f64>) -> Vec<(usize, usize, f64)> {
    masses.into_iter().enumerate().filter(|(_, mass)| 0.0 < *mass).map(|(k, mass)| (k, k, mass)).collect()
}

/// Makes the error of each component relative to the largest of its group.
pub(crate) fn magnitudes_of_groups<T: Real>(lengths: &[usize], mut y: &[T], mut magnitudes: &mut [f64]) {
    for &length in lengths {
        let (group, others) = y.split_at(length);
        let (of_group, of_others) = magnitudes.split_at_mut(length);
        of_group.fill(group.iter().map(|y| y.primal(0).abs()).fold(0.0, f64::max));
        (y, magnitudes) = (others, of_others);
    }
}

/// Andrews' squeezing mechanism, to t = 0.03: seven bodies in the plane, three loops.
///
/// y = (q, v, w, λ) with the angles q = (β, Θ, γ, Φ, δ, Ω, ε), their rates v, accelerations w and six reactions:
///
/// ```text
/// q̇ = v     v̇ = w     0 = M(q) w − f(q, v) + Gᵀ(q) λ     0 = G w + Ġ v  (index 1)   or   0 = G v  (index 2)
/// ```
///
/// Hairer & Wanner, *Solving Ordinary Differential Equations II*, VII.7.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Squeezer {
    /// Whether the constraints stand as they are on velocities: index 2. Else on accelerations.
    pub(crate) on_velocities: bool,
}

/// A bar of a closed loop: a length along the direction of an angle, or turned from it by −90°.
struct Bar {
    length: f64,
    /// The angle is the sum of these coordinates.
    angles: [usize; 2],
    turned: bool,
}

const fn bar(length: f64, angles: [usize; 2], turned: bool) -> Bar {
    Bar { length, angles, turned }
}

/// No second angle.
const NONE: usize = usize::MAX;
/// The bars from the crank's axis to E, where the chains meet; then those of each chain, backwards.
const CRANK: [Bar; 2] = [bar(0.007, [0, NONE], false), bar(-0.028, [0, 1], false)];
const CHAINS: [&[Bar]; 3] = [
    &[bar(-0.035, [2, NONE], true)],
    &[bar(-0.04, [4, NONE], false), bar(-0.02, [3, 4], true)],
    &[bar(-0.04, [6, NONE], true), bar(-0.02, [5, 6], false)],
];
const MOMENT: f64 = 0.033;

/// The sum of some components at the angles of a bar.
fn sum<T: Real>(bar: &Bar, x: &[T]) -> T {
    bar.angles.iter().filter_map(|&k| x.get(k)).fold(T::zero(), |sum, &x| sum + x)
}

impl Squeezer {
    pub(crate) const DIMENSION: usize = 27;

    /// With its exact Jacobian and its mass matrix.
    pub(crate) fn system(self) -> Result<WithMass<ExactJacobian<Self>>, IntegratorsError> {
        let masses = diagonal(core::iter::repeat_n(1.0, 14));
        let system = WithMass::from_entries(ExactJacobian::new(self), masses)?;
        Ok(if self.on_velocities { system.with_index_two_from(14) } else { system })
    }

    /// The nonzero entries of the mass matrix on and above its diagonal: (row, column, entry).
    fn masses<T: Real>(q: &[T]) -> [(usize, usize, T); 10] {
        let (rr_da, zt_e, u_zf) = (0.007 * 0.0115, 0.04 * 0.00579, 0.04 * 0.00579);
        let c = T::lit;
        let slider = c(0.00365) * (c(0.0115 * 0.0115) - c(rr_da) * q[1].cos()) + c(4.41e-7);
        let (k4, k6) = (c(0.00706 * zt_e) * q[3].sin(), c(0.00706 * u_zf) * q[5].sin());
        let (own4, own6) = (c(0.00706 * 0.00579 * 0.00579 + 5.667e-7), c(0.00706 * 0.00579 * 0.00579 + 5.667e-7));
        let crank = 0.04325 * 0.00092 * 0.00092 + 2.194e-6 + 0.00365 * 0.007 * 0.007;
        let k5 = 0.0705 * (0.02308 * 0.02308 + 0.00916 * 0.00916) + 1.169e-5 + 0.00706 * 0.04 * 0.04;
        let k7 = 0.05498 * (0.01228 * 0.01228 + 0.00449 * 0.00449) + 1.912e-5 + 0.00706 * 0.04 * 0.04;
        [
            (0, 0, c(crank) + slider - c(0.00365 * rr_da) * q[1].cos()),
            (0, 1, slider),
            (1, 1, c(0.00365 * 0.0115 * 0.0115 + 4.41e-7)),
            (2, 2, c(0.02373 * (0.01874 * 0.01874 + 0.01043 * 0.01043) + 5.255e-6)),
            (3, 3, own4),
            (3, 4, own4 + k4),
            (4, 4, c(k5) + own4 + k4 + k4),
            (5, 5, own6),
            (5, 6, own6 - k6),
            (6, 6, c(k7) + own6 - k6 - k6),
        ]
    }

    /// The drive, the spring and what the velocities do.
    fn force<T: Real>(q: &[T], v: &[T]) -> [T; 7] {
        let c = T::lit;
        let (s, e) = q[2].sin_cos();
        // The spring's end on K3 less its fixed end, and the derivative of that by γ.
        let at = [c(-0.03635 - 0.014) + c(0.018) * s + c(0.02) * e, c(0.03273 - 0.072) - c(0.018) * e + c(0.02) * s];
        let along = [c(0.018) * e - c(0.02) * s, c(0.018) * s + c(0.02) * e];
        let length = (at[0] * at[0] + at[1] * at[1]).sqrt();
        let spring = c(4530.0) * (length - c(0.07785)) / length;
        let slider = c(0.00365 * 0.007 * 0.0115) * q[1].sin();
        let k4 = c(0.00706 * 0.04 * 0.00579) * q[3].cos();
        let k6 = c(0.00706 * 0.04 * 0.00579) * q[5].cos();
        [
            c(MOMENT) - slider * v[1] * (v[0] + v[0] + v[1]),
            slider * v[0] * v[0],
            -spring * (at[0] * along[0] + at[1] * along[1]),
            k4 * v[4] * v[4],
            -k4 * v[3] * (v[3] + v[4] + v[4]),
            -k6 * v[6] * v[6],
            k6 * v[5] * (v[5] + v[6] + v[6]),
        ]
    }
}

impl<T: Real> Field<T> for Squeezer {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        Self::DIMENSION
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (q, rest) = y.split_at(7);
        let (v, rest) = rest.split_at(7);
        let (w, reactions) = rest.split_at(7);
        rate[..7].copy_from_slice(v);
        rate[7..14].copy_from_slice(w);
        let (balance, closure) = rate[14..].split_at_mut(7);
        for (balance, force) in balance.iter_mut().zip(Self::force(q, v)) {
            *balance = -force;
        }
        for (row, column, mass) in Self::masses(q) {
            balance[row] += mass * w[column];
            if row != column {
                balance[column] += mass * w[row];
            }
        }
        closure.fill(T::zero());
        for ((chain, closure), reaction) in
            CHAINS.iter().zip(closure.chunks_exact_mut(2)).zip(reactions.chunks_exact(2))
        {
            for bar in CRANK.iter().chain(*chain) {
                let (s, c) = sum(bar, q).sin_cos();
                let direction = if bar.turned { [s, -c] } else { [c, s] };
                let [x, y] = direction.map(|along| T::lit(bar.length) * along);
                // The derivative of (x, y) by the angle is (−y, x).
                let (turning, growing) = (sum(bar, v), sum(bar, w));
                if self.on_velocities {
                    closure[0] -= y * turning;
                    closure[1] += x * turning;
                } else {
                    closure[0] -= y * growing + x * turning * turning;
                    closure[1] += x * growing - y * turning * turning;
                }
                let moment = x * reaction[1] - y * reaction[0];
                for &k in &bar.angles {
                    if let Some(balance) = balance.get_mut(k) {
                        *balance += moment;
                    }
                }
            }
        }
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_groups(&[7, 7, 7, 6], y, magnitudes);
    }
}

/// The car axis, to t = 3: an axis of length 1 on two springs, its left wheel at rest, its right wheel on a bumpy road.
///
/// y = (xl, yl, xr, yr, their velocities, λ₁, λ₂); the constraints stand on velocities, so that the index is 2:
///
/// ```text
/// ṗ = q     M ε²/2 q̇ = f(t, p) + Gᵀ λ     0 = d/dt (x_b xl + y_b yl)     0 = d/dt ((xl − xr)² + (yl − yr)² − 1)
/// ```
///
/// Mazzia & Magherini, *Test Set for Initial Value Problem Solvers*, caraxis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CarAxis;

/// M ε²/2.
const INERTIA: f64 = 5e-4;

impl CarAxis {
    pub(crate) const START: [f64; 10] = [0.0, 0.5, 1.0, 0.5, -0.5, 0.0, -0.5, 0.0, 0.0, 0.0];

    /// With its exact Jacobian and its mass matrix.
    pub(crate) fn system(self) -> Result<WithMass<ExactJacobian<Self>>, IntegratorsError> {
        let masses = diagonal([1.0, 1.0, 1.0, 1.0, INERTIA, INERTIA, INERTIA, INERTIA]);
        Ok(WithMass::from_entries(ExactJacobian::new(self), masses)?.with_index_two_from(8))
    }
}

impl<T: Real> Field<T> for CarAxis {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        10
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let [xl, yl, xr, yr, vxl, vyl, vxr, vyr, along, across] = core::array::from_fn(|k| y[k]);
        let (s, c) = (10.0 * t).sin_cos();
        let (yb, vyb) = (0.1 * s, c);
        let xb = (1.0 - yb * yb).sqrt();
        let vxb = -yb * vyb / xb;
        let [xb, yb, vxb, vyb] = [xb, yb, vxb, vyb].map(T::lit);
        let pull = |x: T, y: T| {
            let length = (x * x + y * y).sqrt();
            let part = (T::lit(0.5) - length) / length;
            [part * x, part * y - T::lit(INERTIA)]
        };
        let (left, right) = (pull(xl, yl), pull(xr - xb, yr - yb));
        let (dx, dy) = (xl - xr, yl - yr);
        let twice = across + across;
        rate[..4].copy_from_slice(&[vxl, vyl, vxr, vyr]);
        rate[4] = left[0] + along * xb + twice * dx;
        rate[5] = left[1] + along * yb + twice * dy;
        rate[6] = right[0] - twice * dx;
        rate[7] = right[1] - twice * dy;
        rate[8] = vxb * xl + xb * vxl + vyb * yl + yb * vyl;
        rate[9] = dx * (vxl - vxr) + dy * (vyl - vyr);
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_groups(&[4, 4, 2], y, magnitudes);
    }
}
