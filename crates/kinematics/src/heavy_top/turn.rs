//! The turn of a symmetric top: half the sum and half the difference of its angles of precession and of its own turn.
//!
//! Where the axis passes near the vertical, these integrals of the third kind are split,
//!
//! ```text
//! ∫ ε/(A(1 + u)) dt = 2 arctan(√(y₂(u₃ + 1)/(y₁(u₃ − u₁))) sn v/(cn v dn v)) + an integral without a peak
//! ```
//!
//! so that nothing is lost where y₁ = 1 + u₁ is small, or zero.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Complex;

use super::nutation::{Nutation, Phase};
use crate::elliptic::third_kind;

/// Both turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turns {
    /// Half of (1/C − 1/A) L₃, rad/s.
    own: f64,
    sum: Part,
    difference: Part,
}

/// One integral, as rate · t + factor · J(v), and the direction of its arctangent.
#[derive(Clone, Copy, Debug)]
struct Part {
    rate: f64,
    factor: f64,
    /// The argument of `R_J` is 1 + bend · sn².
    bend: f64,
    /// J over a half period.
    over_half_period: f64,
    /// The direction is (along · cn dn, across · sn).
    arc: Option<[f64; 2]>,
    /// Whether v is counted from u₂.
    is_from_highest: bool,
}

impl Turns {
    pub(super) fn new(nutation: &Nutation, own: f64) -> Self {
        Self { own: 0.5 * own, sum: Part::sum(nutation), difference: Part::difference(nutation) }
    }

    /// The directions of (φ + ψ)/2 and (φ − ψ)/2.
    pub(super) fn at(&self, nutation: &Nutation, phase: &Phase, t: f64) -> [Complex<f64>; 2] {
        [self.sum.at(nutation, phase, t, self.own), self.difference.at(nutation, phase, t, -self.own)]
    }

    /// (φ + ψ)/2 and (φ − ψ)/2, rad, each but for a constant.
    pub(super) fn angles(&self, nutation: &Nutation, phase: &Phase, t: f64) -> [f64; 2] {
        [self.sum.angle(nutation, phase, t, self.own), self.difference.angle(nutation, phase, t, -self.own)]
    }
}

impl Part {
    const NONE: Self =
        Self { rate: 0.0, factor: 0.0, bend: 0.0, over_half_period: 0.0, arc: None, is_from_highest: false };

    /// That of (φ + ψ)/2.
    fn sum(nutation: &Nutation) -> Self {
        let &Nutation { across, weight, sums: [sum, _], below: [y1, y2], width, .. } = nutation;
        let ([whole, ..], rate) = (nutation.heights_to_third, nutation.rate);
        let part = if width <= y1 {
            let steady = if 0.0 < y1 { 0.5 * sum / (across * y1) } else { 0.0 };
            let factor = if 0.0 < width { -steady * width / (rate * y1) } else { 0.0 };
            Self { rate: steady, factor, bend: if 0.0 < y1 { width / y1 } else { 0.0 }, ..Self::NONE }
        } else {
            let bend = weight * y1 / whole;
            let across_arc = (y2 * (1.0 + bend)).sqrt().copysign(sum);
            let factor = 0.5 * sum * weight / (across * rate * whole);
            Self { factor, bend, arc: Some([y1.sqrt(), across_arc]), ..Self::NONE }
        };
        part.with_half_period(nutation)
    }

    /// That of (φ − ψ)/2.
    fn difference(nutation: &Nutation) -> Self {
        let &Nutation { across, weight, sums: [_, sum], above: [x1, x2], width, .. } = nutation;
        let ([whole, between, third], rate) = (nutation.heights_to_third, nutation.rate);
        let half = 0.5 * sum / across;
        let part = if width <= x2 {
            let steady = if 0.0 < x1 { half / x1 } else { 0.0 };
            let factor = if 0.0 < width { steady * width / (rate * x1) } else { 0.0 };
            Self { rate: steady, factor, bend: if 0.0 < x1 { -width / x1 } else { 0.0 }, ..Self::NONE }
        } else if between <= 0.0 {
            // It rises to the vertical for ever: then L = L₃.
            Self::NONE
        } else if third < weight * x2 {
            let (m, complement) = (nutation.parameters[0], nutation.parameters[1]);
            let factor = -half / x2 * (width * complement / x2) / rate;
            Self { rate: half / x2, factor, bend: m * third / (weight * x2), is_from_highest: true, ..Self::NONE }
        } else {
            let bend = weight * x2 / third;
            let across_arc = (between * (x1 / (third * whole)).sqrt()).copysign(sum);
            Self {
                rate: -half * weight / third,
                factor: half * weight * between / (rate * third * third),
                bend,
                arc: Some([x2.sqrt(), across_arc]),
                is_from_highest: true,
                ..Self::NONE
            }
        };
        part.with_half_period(nutation)
    }

    fn with_half_period(self, nutation: &Nutation) -> Self {
        let complement = nutation.parameters[1];
        let over_quarter = if 0.0 < complement { self.integral([1.0, 0.0, complement.sqrt()]) } else { 0.0 };
        Self { over_half_period: 2.0 * over_quarter, ..self }
    }

    /// J = ∫ sn²/(1 + bend · sn²) dv from 0.
    fn integral(&self, [sn, cn, dn]: [f64; 3]) -> f64 {
        let cube = sn * sn * sn;
        if cube.abs() <= 0.0 || self.factor.abs() <= 0.0 {
            return 0.0;
        }
        cube / 3.0 * third_kind([cn * cn, dn * dn, 1.0], 1.0 + self.bend * (sn * sn))
    }

    /// The angle of the integral without a peak, and v as half periods and functions, counted from where the peak is.
    fn counted(&self, nutation: &Nutation, phase: &Phase, t: f64, own: f64) -> (f64, Phase) {
        let &Phase { mut half_periods, mut functions } = phase;
        if self.is_from_highest {
            let [sn, cn, dn] = functions;
            // v − K, within ±K of a highest place.
            let root = nutation.parameters[1].sqrt();
            if sn.is_sign_negative() {
                half_periods -= 1.0;
            }
            functions = [-(cn / dn).copysign(sn), root * sn.abs() / dn, root / dn];
        }
        let whole = if 0.0 < half_periods.abs() { half_periods * self.over_half_period } else { 0.0 };
        let angle = (own + self.rate) * t + self.factor * (whole + self.integral(functions));
        (angle, Phase { half_periods, functions })
    }

    /// The angle itself, continuous in time, to some tens of ulps of it.
    fn angle(&self, nutation: &Nutation, phase: &Phase, t: f64, own: f64) -> f64 {
        let (angle, Phase { half_periods, functions: [sn, cn, dn] }) = self.counted(nutation, phase, t, own);
        let Some([along, across]) = self.arc else { return angle };
        // Half a turn in each half period.
        let half_turns = PI * half_periods * 1.0_f64.copysign(across);
        let (along, across) = (along * (cn * dn), across * sn);
        // In the vertical itself as in `at`.
        angle + half_turns + if 0.0 < along { across.atan2(along) } else { FRAC_PI_2.copysign(across) }
    }

    fn at(&self, nutation: &Nutation, phase: &Phase, t: f64, own: f64) -> Complex<f64> {
        let (angle, Phase { half_periods, functions }) = self.counted(nutation, phase, t, own);
        let (sine, cosine) = angle.sin_cos();
        let direction = Complex::new(cosine, sine);
        let Some([along, across]) = self.arc else { return direction };
        let [sn, cn, dn] = functions;
        let arc = Complex::new(along * (cn * dn), across * sn);
        let size = arc.re.hypot(arc.im);
        // In the vertical the direction is the one after it, or before it where sn is −0.
        let arc =
            if 0.0 < size { arc / size } else { Complex::new(0.0, 1.0_f64.copysign(across) * 1.0_f64.copysign(sn)) };
        if 0.5 < half_periods.rem_euclid(2.0) { -direction * arc } else { direction * arc }
    }
}
