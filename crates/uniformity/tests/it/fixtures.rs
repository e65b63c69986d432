//! Bodies that several tests use.

use nalgebra::{Matrix3, Vector3};
use piola_fields::{Field, Motion};
use piola_numerics::Real;
use piola_uniformity::{InverseMap, UniformityMap};
use proptest::prelude::*;

/// A map given by one function of the case's name: those of the reference data.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Golden {
    Constant,
    ScrewLine,
    Screws,
    Edges,
    Gradient,
    Smooth,
    Turning,
}

impl Golden {
    pub(crate) fn named(id: &str) -> Option<Self> {
        Some(match id {
            "constant" => Self::Constant,
            "screw_dislocation_line" | "screw_line_burgers" | "screw_line_burgers_off" => Self::ScrewLine,
            "screw_distribution" | "screw_distribution_burgers" => Self::Screws,
            "edge_distribution" => Self::Edges,
            "gradient_of_deformation" => Self::Gradient,
            "random_smooth" => Self::Smooth,
            "rotation_field" => Self::Turning,
            _ => return None,
        })
    }
}

/// K⁻¹ with the third row (p, q, 1) beside those of the identity.
fn third_row<T: Real>(p: T, q: T) -> Matrix3<T> {
    let (o, l) = (T::zero(), T::one());
    Matrix3::new(l, o, o, o, l, o, p, q, l)
}

impl UniformityMap for Golden {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, z] = (*reference).into();
        let (o, l, n) = (T::zero(), T::one(), T::lit);
        match self {
            Self::Constant => Matrix3::new(n(2.0), n(0.5), o, o, l, n(0.25), n(0.125), o, l),
            Self::ScrewLine => {
                let factor = n(3.0) / (n(8.0 * core::f64::consts::PI) * (x * x + y * y));
                third_row(factor * y, -(factor * x))
            }
            Self::Screws => third_row(n(0.25) * y, n(-0.25) * x),
            Self::Edges => Matrix3::from_diagonal(&Vector3::new(n(2.0) / (y + n(2.0)), l, l)),
            Self::Gradient => InverseMap(GradientOfGolden).at(reference),
            Self::Smooth => Matrix3::new(
                n(0.125) * y.sin() + l,
                n(0.25) * x * z,
                n(0.125) * y,
                n(0.0625) * z * z,
                n(0.25) * x * y + l,
                n(-0.125) * x.cos(),
                n(0.125) * x,
                n(0.0625) * z.sin(),
                n(0.125) * z + l,
            ),
            Self::Turning => {
                let (s, c) = (n(0.5) * x).sin_cos();
                Matrix3::new(c, -s, o, s, c, o, o, o, l)
            }
        }
    }
}

/// The gradient of (X + XY/4, Y + sin(X)/8 + Z²/16, Z + XZ/8), by hand.
struct GradientOfGolden;

impl UniformityMap for GradientOfGolden {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, z] = (*reference).into();
        let (o, l, n) = (T::zero(), T::one(), T::lit);
        let eighth = n(0.125);
        Matrix3::new(l + n(0.25) * y, n(0.25) * x, o, eighth * x.cos(), l, eighth * z, eighth * z, o, l + eighth * x)
    }
}

/// Waves of nine amplitudes and three wave numbers: 1 + A sin(k·X + φ), far from singular.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Waves {
    pub(crate) amplitude: [f64; 9],
    pub(crate) wave: [f64; 3],
    pub(crate) phase: f64,
}

impl Waves {
    fn argument<T: Real>(&self, place: &Vector3<T>, turn: f64) -> T {
        let [a, b, c] = self.wave;
        T::lit(a) * place.x + T::lit(b) * place.y + T::lit(c * turn) * place.z + T::lit(self.phase * turn)
    }
}

impl UniformityMap for Waves {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        Matrix3::from_fn(|i, j| {
            let one = if i == j { T::one() } else { T::zero() };
            let number = 3 * i + j;
            let turn = [1.0, -0.5, 0.75][number % 3];
            let (sine, cosine) = self.argument(reference, turn).sin_cos();
            one + T::lit(self.amplitude[number]) * if number % 2 == 0 { sine } else { cosine }
        })
    }
}

/// A motion x = X + a sin(k·X + φ) with small amplitudes: the homogeneous configuration of a body.
impl Motion for Waves {
    fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        Vector3::from_fn(|i, _| {
            let turn = [1.0, -0.5, 0.75][i];
            let wave = T::lit(self.amplitude[4 * i]) * self.argument(reference, turn).sin();
            reference[i] + wave + T::lit(self.amplitude[i + 1]) * reference[(i + 1) % 3]
        })
    }
}

/// A turn about e₃ by an angle that depends on all coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turned<M> {
    pub(crate) map: M,
    pub(crate) rate: f64,
    pub(crate) axis: [f64; 3],
}

impl<M> Turned<M> {
    /// The rotation by the angle at a place, after Rodrigues.
    pub(crate) fn rotation<T: Real>(&self, place: &Vector3<T>) -> Matrix3<T> {
        let angle = T::lit(self.rate) * (place.x + place.y * place.z);
        let (sine, cosine) = angle.sin_cos();
        let n = Vector3::from(self.axis);
        let cross = n.cross_matrix();
        Matrix3::from_fn(|i, j| {
            let one = if i == j { cosine } else { T::zero() };
            one + T::lit(cross[(i, j)]) * sine + T::lit(n[i] * n[j]) * (T::one() - cosine)
        })
    }
}

impl<M: UniformityMap> UniformityMap for Turned<M> {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        self.map.at(reference) * self.rotation(reference)
    }
}

/// A field of vectors.
pub(crate) struct Vectors;

impl Field for Vectors {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Vector3<T> {
        Vector3::new(place.x * place.y, place.z.sin(), place.x + place.z * place.z)
    }
}

pub(crate) fn waves() -> impl Strategy<Value = Waves> {
    (prop::array::uniform9(-0.15..0.15_f64), prop::array::uniform3(-1.5..1.5_f64), -3.0..3.0_f64)
        .prop_map(|(amplitude, wave, phase)| Waves { amplitude, wave, phase })
}

pub(crate) fn point() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(Vector3::from)
}
