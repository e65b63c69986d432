//! The rotation of a rigid body on which no moment acts, in closed form.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::products;
use crate::elliptic::{first_kind, jacobi, third_kind};
use crate::error::finite;
use crate::{Attitude, Inertia, KinematicsError};

/// Free rotation of a rigid body from an attitude and an angular velocity.
///
/// ```text
/// H_a = A cn u    H_b = B sn u    H_c = C dn u    u = pt + u₀          body components of H = Iω in principal axes
/// A² = H_a² + H_b² I_a(I_c − I_b)/(I_b(I_c − I_a))     …              c: the axis about which H circulates
/// ψ̇ = |H| (H_b²/I_b + H_c²/I_c)/(H_b² + H_c²)                        turn of axis a about H, an integral of the third kind
/// ```
///
/// The motion is evaluated at any time from its start: errors do not add up. Near the middle axis, for symmetric and for
/// spherical bodies the same formulas hold, and no digits are lost by differences of energies.
///
/// | symbol | name | shape | unit |
/// |---|---|---|---|
/// | attitude | `attitude` | unit quaternion | – |
/// | ω | `angular_velocity` | 3, body components | rad/s |
///
/// # Accuracy
/// Some ulps of ω, of 1, and of the angle by which the body has turned.
///
/// It is in `f64` only: where the body spins about a principal axis, the amplitudes have no derivatives, though the motion has.
/// For derivatives integrate Euler's equations over `Dual`.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Attitude, FreeRotation, Inertia};
/// // A spin about the middle axis, a little disturbed, turns over again and again.
/// let inertia = Inertia::principal([1.0, 2.0, 3.0])?;
/// let motion = FreeRotation::new(&inertia, Attitude::identity(), Vector3::new(1e-3, 1.0, 0.0))?;
/// let (_, later) = motion.at(0.5 * motion.period());
/// assert!((later.y + 1.0).abs() < 1e-12);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(4.9) with G = 0; E. T. Whittaker, *Analytical Dynamics*, 4th ed. 1937, §69; R. van Zon & J. Schofield, J. Comput. Phys.
/// 225 (2007) 145.
#[doc(alias("Euler top", "Poinsot", "torque-free rotation"))]
#[derive(Clone, Copy, Debug)]
pub struct FreeRotation {
    attitude: Attitude<f64>,
    /// Columns: principal axes in body components.
    axes: Matrix3<f64>,
    moments: [f64; 3],
    /// H at the start, in principal axes.
    start: [f64; 3],
    /// |H|.
    size: f64,
    path: Path,
}

/// How H moves in the body.
#[derive(Clone, Copy, Debug)]
enum Path {
    /// It rests: the body is spherical, does not turn, or turns about its middle axis.
    Resting,
    Circulating(Circulation),
}

/// H circulates about the axis c.
#[derive(Clone, Copy, Debug)]
struct Circulation {
    /// The axes a, b and c.
    order: [usize; 3],
    /// A, B and C.
    amplitudes: [f64; 3],
    /// p, rad/s.
    rate: f64,
    /// 1 − m.
    complement: f64,
    /// K(m).
    quarter: f64,
    start: Phase,
    /// u₀.
    argument: f64,
    turn: Turn,
}

/// u, as half periods and what is left.
#[derive(Clone, Copy, Debug)]
struct Phase {
    half_periods: f64,
    /// sn, cn and dn of what is left.
    functions: [f64; 3],
}

/// The turn of a principal axis about H.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// The axis, which H keeps away from.
    axis: usize,
    /// Its mean rate, and the factor of ∫ sn²/(1 − n sn²) dt.
    rates: [f64; 2],
    /// n ≤ 0.
    characteristic: f64,
    /// ∫ sn²/(1 − n sn²) du over a quarter period.
    over_quarter: f64,
}

impl FreeRotation {
    /// The motion of a body of this inertia from an attitude and an angular velocity (rad/s, body components).
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`].
    pub fn new(
        inertia: &Inertia,
        attitude: Attitude<f64>,
        angular_velocity: Vector3<f64>,
    ) -> Result<Self, KinematicsError> {
        let principal = inertia.principal_axes();
        Self::in_axes(principal.axes, principal.moments, attitude, angular_velocity)
    }

    /// The motion of the same body from another state: the part of a splitting that turns freely.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`].
    pub fn restarted(&self, attitude: Attitude<f64>, angular_velocity: Vector3<f64>) -> Result<Self, KinematicsError> {
        Self::in_axes(self.axes, self.moments, attitude, angular_velocity)
    }

    fn in_axes(
        axes: Matrix3<f64>,
        moments: [f64; 3],
        attitude: Attitude<f64>,
        angular_velocity: Vector3<f64>,
    ) -> Result<Self, KinematicsError> {
        finite("attitude", &[attitude.w, attitude.x, attitude.y, attitude.z])?;
        finite("angular velocity", angular_velocity.as_slice())?;
        let in_axes = axes.transpose() * angular_velocity;
        let start = [0, 1, 2].map(|i| moments[i] * in_axes[i]);
        let size = start.iter().map(|h| h * h).sum::<f64>().sqrt();
        let path = Path::new(moments, start, size);
        Ok(Self { attitude, axes, moments, start, size, path })
    }

    /// The attitude and the angular velocity (rad/s, body components) after `t` seconds.
    #[must_use]
    pub fn at(&self, t: f64) -> (Attitude<f64>, Vector3<f64>) {
        let (momentum, turned) = match &self.path {
            Path::Resting => {
                let rate = Vector3::from([0, 1, 2].map(|i| self.start[i] / self.moments[i]));
                (self.start, Attitude::from_rotation_vector(&(rate * t)))
            }
            Path::Circulating(circulation) => {
                let phase = circulation.phase(circulation.argument + circulation.rate * t);
                let momentum = circulation.momentum(&phase);
                let angle = circulation.turned(&phase, t);
                let axis = circulation.turn.axis;
                let (before, after) = (self.towards(self.start, axis), self.towards(momentum, axis));
                (momentum, before.product(Attitude::about_z(angle)).product(after.conjugate()))
            }
        };
        let in_axes = Vector3::from([0, 1, 2].map(|i| momentum[i] / self.moments[i]));
        (self.attitude.product(self.in_body(turned)), self.axes * in_axes)
    }

    /// The period of H and ω in the body, s: infinite where the body is spherical, rests, or turns about its middle axis or
    /// towards it. Of a spin about the first or the third axis it is the period of a small disturbance.
    #[must_use]
    pub fn period(&self) -> f64 {
        match &self.path {
            Path::Resting => f64::INFINITY,
            Path::Circulating(circulation) => 4.0 * circulation.quarter / circulation.rate.abs(),
        }
    }

    /// A rotation that is given in principal axes.
    fn in_body(&self, rotation: Attitude<f64>) -> Attitude<f64> {
        let vector = self.axes * Vector3::new(rotation.x, rotation.y, rotation.z);
        Attitude { w: rotation.w, x: vector.x, y: vector.y, z: vector.z }
    }

    /// The rotation that carries e₃ to the direction of H and e₁ as near as can be to a principal axis, in these axes.
    fn towards(&self, momentum: [f64; 3], axis: usize) -> Attitude<f64> {
        let third = Vector3::from(momentum) / self.size;
        let mut first = -third[axis] * third;
        first[axis] = (0..3).filter(|&other| other != axis).map(|other| third[other] * third[other]).sum();
        let first = first.normalize();
        let second = third.cross(&first);
        let [w, x, y, z] = products(&Matrix3::from_columns(&[first, second, third]));
        Attitude { w, x, y, z }.normalise()
    }
}

impl Path {
    fn new(moments: [f64; 3], start: [f64; 3], size: f64) -> Self {
        let [least, middle, most] = moments;
        if most <= least || size <= 0.0 {
            return Self::Resting;
        }
        let [first, _, third] = start;
        // H² − 2E I₂: positive where H circulates about the third axis, negative about the first.
        let excess = third * third * (most - middle) / most - first * first * (middle - least) / least;
        let about_third = 0.0 < excess || (0.0 <= excess && middle < most);
        let circulation = Circulation::new(moments, start, size, about_third, excess);
        let [_, cn, dn] = circulation.start.functions;
        // Along the middle axis H rests.
        if 0.0 < cn * cn + dn * dn { Self::Circulating(circulation) } else { Self::Resting }
    }
}

impl Circulation {
    fn new(moments: [f64; 3], start: [f64; 3], size: f64, about_third: bool, excess: f64) -> Self {
        let order = if about_third { [0, 1, 2] } else { [2, 1, 0] };
        let [a, b, c] = order.map(|axis| moments[axis]);
        let [h_a, h_b, h_c] = order.map(|axis| start[axis]);
        let squares = [
            h_a * h_a + h_b * h_b * (a * (c - b) / (b * (c - a))),
            h_b * h_b + h_a * h_a * (b * (c - a) / (a * (c - b))),
            h_c * h_c + h_b * h_b * (c * (b - a) / (b * (c - a))),
        ];
        let [along_a, along_b, along_c] = squares.map(f64::sqrt);
        let amplitudes = [along_a, along_b, along_c.copysign(h_c)];
        // Ḣ = H × ω turns about c one way or the other.
        let sense = if about_third { 1.0 } else { -1.0 };
        let rate = sense * (c - a).signum() * amplitudes[2] * ((c - a) * (c - b) / (a * b)).sqrt() / c;
        // m = (b − a) A² c/((c − b) C² a).
        let (parameter, complement) = if 0.0 < squares[2] {
            let parameter = (b - a) * c / ((c - b) * a) * (squares[0] / squares[2]);
            let complement = excess * c / ((c - b) * squares[2]);
            (parameter.clamp(0.0, 1.0), complement.clamp(0.0, 1.0))
        } else {
            (0.0, 1.0)
        };
        let quarter = if 0.0 < complement { first_kind([0.0, complement, 1.0]) } else { f64::INFINITY };
        let (sine, cosine) = if 0.0 < along_a { (h_b / along_b, h_a / along_a) } else { (0.0, 1.0) };
        let is_behind = cosine < 0.0;
        let sine = if is_behind { -sine } else { sine };
        let dn = (complement + parameter * cosine * cosine).sqrt();
        let half_periods = if is_behind { 1.0 } else { 0.0 };
        let functions = [sine, cosine.abs(), dn];
        let incomplete = sine * first_kind([cosine * cosine, dn * dn, 1.0]);
        let argument = incomplete + if is_behind { 2.0 * quarter } else { 0.0 };
        let turn = Turn::new([a, b, c], order, squares, size, complement);
        let start = Phase { half_periods, functions };
        Self { order, amplitudes, rate, complement, quarter, start, argument, turn }
    }

    fn phase(&self, argument: f64) -> Phase {
        let half_periods = (argument / (2.0 * self.quarter)).round();
        let rest = if 0.0 < half_periods.abs() { argument - 2.0 * self.quarter * half_periods } else { argument };
        Phase { half_periods, functions: jacobi(rest, self.complement) }
    }

    /// H in principal axes.
    fn momentum(&self, phase: &Phase) -> [f64; 3] {
        let sign = if phase.half_periods.rem_euclid(2.0) < 0.5 { 1.0 } else { -1.0 };
        let [sn, cn, dn] = phase.functions;
        let along = [sign * cn, sign * sn, dn];
        let mut momentum = [0.0; 3];
        for (place, (amplitude, along)) in self.order.iter().zip(self.amplitudes.iter().zip(along)) {
            momentum[*place] = amplitude * along;
        }
        momentum
    }

    /// The angle by which the axis has turned about H in so many seconds.
    fn turned(&self, phase: &Phase, t: f64) -> f64 {
        let turn = &self.turn;
        let [mean, factor] = turn.rates;
        let integral = if 0.0 < self.rate.abs() {
            let quarters = 2.0 * (phase.half_periods - self.start.half_periods);
            let whole = if 0.0 < quarters.abs() { quarters * turn.over_quarter } else { 0.0 };
            (whole + turn.integral(phase.functions) - turn.integral(self.start.functions)) / self.rate
        } else {
            let square = self.start.functions[0] * self.start.functions[0];
            t * square / (1.0 - turn.characteristic * square)
        };
        mean * t + factor * integral
    }
}

impl Turn {
    fn new([a, b, c]: [f64; 3], order: [usize; 3], squares: [f64; 3], size: f64, complement: f64) -> Self {
        let [along_a, along_b, along_c] = squares;
        // H stays away from a by √(1 − A²/H²) = C/H at least, and from c by A/H.
        let (axis, rates, characteristic) = if along_a <= along_c {
            let characteristic = -(along_a / along_c);
            (order[0], [size / c, size * ((a - c) / (a * c)) * characteristic], characteristic)
        } else {
            let characteristic = (along_a - along_b) / along_a;
            (order[2], [size / a, -size * ((b - a) / (a * b)) * (along_b / along_a)], characteristic)
        };
        let mut turn = Self { axis, rates, characteristic, over_quarter: 0.0 };
        if 0.0 < complement {
            turn.over_quarter = turn.integral([1.0, 0.0, complement.sqrt()]);
        }
        turn
    }

    /// ∫ sn²/(1 − n sn²) du from 0.
    fn integral(&self, [sn, cn, dn]: [f64; 3]) -> f64 {
        let cube = sn * sn * sn;
        if cube.abs() <= 0.0 {
            return 0.0;
        }
        cube / 3.0 * third_kind([cn * cn, dn * dn, 1.0], 1.0 - self.characteristic * sn * sn)
    }
}
