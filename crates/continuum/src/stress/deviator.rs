//! The deviator in five coordinates, in which its invariants are sums of squares.
//!
//! ```text
//! u = (½(T₁₁ − T₂₂), 2T₃₃ − T₁₁ − T₂₂, T₁₂, T₂₃, T₁₃)        weights w = (1, 1/12, 1, 1, 1)
//! J₂ = Σ w u²        9 J₃ = Σ w u v,   v = 6 · coordinates of dev(D²)
//! ```
//! The tensors D and dev(D²) enclose three times the Lode angle in the space of deviators: |dev(D²)| = |D|²/√6 and
//! D : dev(D²) = tr D³ = 3 J₃ = |D|³ cos 3θ/√6. The area of the parallelogram on them, a sum of ten squares, is the
//! sine: it is found without the cancellation in 4 J₂³ − 27 J₃². All coordinates are differences of stresses, so
//! the pressure has no influence on their digits.

use piola_numerics::Real;
use piola_numerics::sums::unit_in_last_place;
use piola_tensor::internal::scale::{largest, power_of_two_scale, square_root};

use crate::Symmetric;

/// Coordinates of a quarter of a deviator, in units of `unscale`: of a quarter, so that no difference overflows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coordinates<T> {
    u: [T; 5],
    /// The unit: a power of two.
    unscale: T,
}

/// The product of two deviators, from their coordinates: half of A : B.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inner<T: Real>(u: [T; 5], v: [T; 5]) -> T {
    (u[0] * v[0] + u[2] * v[2] + (u[3] * v[3] + u[4] * v[4])) + u[1] * v[1] * T::lit(1.0 / 12.0)
}

/// 3 J₂ of unscaled or scaled coordinates; exact for uniaxial stresses of few digits.
#[cfg_attr(not(debug_assertions), inline(always))]
fn three_j2<T: Real>(u: [T; 5]) -> T {
    T::lit(3.0) * ((u[0] * u[0] + u[2] * u[2]) + (u[3] * u[3] + u[4] * u[4])) + T::lit(0.25) * (u[1] * u[1])
}

/// 6 dev(D²).
#[cfg_attr(not(debug_assertions), inline(always))]
fn square<T: Real>([a, c, p, q, r]: [T; 5]) -> [T; 5] {
    let (two, six) = (T::lit(2.0), T::lit(6.0));
    [
        T::lit(3.0) * ((r - q) * (r + q)) - two * (a * c),
        c * c + six * (q * q + r * r) - T::lit(12.0) * (a * a + p * p),
        six * (r * q) - two * (p * c),
        six * (p * r) + q * (c - six * a),
        six * (p * q) + r * (c + six * a),
    ]
}

/// The tensor with some coordinates.
#[cfg_attr(not(debug_assertions), inline(always))]
fn tensor<T: Real>([a, c, p, q, r]: [T; 5]) -> Symmetric<T> {
    let sixth = c / T::lit(6.0);
    Symmetric::new(a - sixth, -a - sixth, c / T::lit(3.0), p, q, r)
}

/// The coordinates of the deviator of a stress.
#[cfg_attr(not(debug_assertions), inline(always))]
fn coordinates<T: Real>(stress: &Symmetric<T>) -> [T; 5] {
    let [xx, yy, zz, xy, yz, xz] = stress.components;
    [T::lit(0.5) * (xx - yy), (zz - xx) + (zz - yy), xy, yz, xz]
}

/// J₂, without scaling.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn j2<T: Real>(stress: &Symmetric<T>) -> T {
    three_j2(coordinates(stress)) / T::lit(3.0)
}

/// J₃, without scaling.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn j3<T: Real>(stress: &Symmetric<T>) -> T {
    let u = coordinates(stress);
    inner(u, square(u)) / T::lit(9.0)
}

/// ∂J₃/∂T = dev(D²), without scaling.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn deviatoric_square<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    tensor(square(coordinates(stress)).map(|v| v / T::lit(6.0)))
}

impl<T: Real> Coordinates<T> {
    /// Of the deviator of a stress, scaled to about one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(stress: &Symmetric<T>) -> Self {
        let u = coordinates(&(*stress * T::lit(0.25)));
        let (scale, unscale) = power_of_two_scale(largest(u));
        Self { u: [u[0] * scale, u[1] * scale, u[2] * scale, u[3] * scale, u[4] * scale], unscale }
    }

    /// √(3 J₂).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn von_mises(&self) -> T {
        square_root(three_j2(self.u)) * self.unscale * T::lit(4.0)
    }

    /// (sin 3θ, cos 3θ) times a common factor that is positive, or (0, 1) for the deviator zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn triple_angle(&self) -> (T, T) {
        let v = square(self.u);
        let square_of_sine = wedge_squared(self.u, v);
        // Rounding has a direction too, which must not become a derivative.
        let apart = are_apart(self.u, v, square_of_sine);
        let sine = square_root(T::select(apart, square_of_sine, square_of_sine.frozen()));
        let cosine = inner(self.u, v);
        let exists = T::zero().less_than(largest(self.u));
        (T::select(exists, sine, T::zero()), T::select(exists, cosine, T::one()))
    }

    /// D/√(3 J₂), zero for the deviator zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn direction(&self) -> Symmetric<T> {
        let size = three_j2(self.u);
        let exists = T::zero().less_than(size);
        let size = T::select(exists, size, T::one()).sqrt();
        let u = self.u;
        let direction = tensor([u[0] / size, u[1] / size, u[2] / size, u[3] / size, u[4] / size]);
        let zero = T::zero();
        let [xx, yy, zz, xy, yz, xz] = direction.components;
        let of = |x: T| T::select(exists, x, zero);
        Symmetric::new(of(xx), of(yy), of(zz), of(xy), of(yz), of(xz))
    }

    /// ∂θ/∂T = −E/(|E| |D|), E the part of dev(D²) that is normal to D; zero where there is none beyond rounding.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn angle_gradient(&self) -> Symmetric<T> {
        let (u, v) = (self.u, square(self.u));
        let weight = T::lit(1.0 / 12.0);
        // E |D|² by the parallelogram's components, each free of the part along D.
        let part = |j: usize| {
            let area = |i: usize| u[i] * (u[i] * v[j] - u[j] * v[i]);
            (area(0) + area(2) + (area(3) + area(4))) + weight * area(1)
        };
        let normal = [part(0), part(1), part(2), part(3), part(4)];
        // E is of the sixth degree in u where it is small, so its square is scaled again.
        let (scale, _) = power_of_two_scale(largest(normal));
        let normal = [normal[0] * scale, normal[1] * scale, normal[2] * scale, normal[3] * scale, normal[4] * scale];
        let size = inner(normal, normal) * inner(u, u);
        let exists = T::zero().less_than(size) & are_apart(u, v, wedge_squared(u, v));
        // |E| |D| = 2 √(…), in units of stress.
        let factor = -T::lit(0.125) / T::select(exists, size, T::one()).sqrt() / self.unscale;
        let factor = T::select(exists, factor, T::zero());
        let gradient = tensor(normal);
        gradient * factor
    }
}

/// Σ wᵢ wⱼ (uᵢ vⱼ − uⱼ vᵢ)² over the ten pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn wedge_squared<T: Real>(u: [T; 5], v: [T; 5]) -> T {
    let area = |i: usize, j: usize| {
        let area = u[i] * v[j] - u[j] * v[i];
        area * area
    };
    let heavy = (area(0, 2) + area(0, 3) + area(0, 4)) + (area(2, 3) + area(2, 4) + area(3, 4));
    let light = (area(1, 0) + area(1, 2)) + (area(1, 3) + area(1, 4));
    heavy + light * T::lit(1.0 / 12.0)
}

/// Where D and dev(D²) are further from parallel than rounding: 32 ulp, sin 3θ, two principal stresses apart.
#[cfg_attr(not(debug_assertions), inline(always))]
fn are_apart<T: Real>(u: [T; 5], v: [T; 5], wedge_squared: T) -> T::Mask {
    let least = 32.0 * unit_in_last_place::<T>();
    (T::lit(least * least) * (inner(u, u) * inner(v, v))).less_than(wedge_squared)
}
