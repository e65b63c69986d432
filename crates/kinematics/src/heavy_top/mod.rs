//! The symmetric top about a fixed point, under its weight, in closed form.

mod nutation;
mod turn;

use nalgebra::{Complex, Matrix3, Vector3};

use self::nutation::Nutation;
use self::turn::Turns;
use crate::attitude::products;
use crate::error::finite;
use crate::{Attitude, Inertia, KinematicsError};

/// The part of the largest moment by which an inertia may miss its symmetry.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The top of Lagrange: a rigid body that turns about a fixed point, whose weight acts on its axis of symmetry.
///
/// ```text
/// A u̇² = 2 (T − P(u − u₀)) (1 − u²) − (L − L₃ u)²/A        u = cos θ, a cubic with the roots u₁ ≤ u₂ ≤ 1 ≤ u₃
/// u = u₁ + (u₂ − u₁) sn² v                              v = pt + v₀,  p² = P(u₃ − u₁)/(2A)
/// φ̇ + ψ̇ = (1/C − 1/A) L₃ + (L + L₃)/(A(1 + u))
/// φ̇ − ψ̇ = −(1/C − 1/A) L₃ + (L − L₃)/(A(1 − u))        integrals of the third kind
/// ```
///
/// The motion is evaluated at any time from its start: errors do not add up. Steady precession, nutation through the vertical
/// and the sleeping top are no special cases for the caller. Without weight it is the free rotation of a symmetric body.
///
/// | symbol | name | shape | unit |
/// |---|---|---|---|
/// | A, C | moments of inertia about the fixed point, across and along the axis | – | kg m² |
/// | P | length of `weight_times_arm`: mg times the vector to the centre of mass | 3, body components | N m |
/// | θ, φ, ψ | angles of the axis to the vertical, of precession and of the own turn | – | rad |
/// | L, L₃ | angular momentum about the vertical and about the axis | – | kg m²/s |
/// | T | kinetic energy of the turn across the axis at the start, where u = u₀ | – | J |
///
/// The vertical is the third axis of space; the weight acts against it.
///
/// # Accuracy
/// Some tens of ulps of ω, of 1, and of the angle by which the body has turned, times what the motion itself magnifies: near
/// the limit between a top that passes the vertical and one that does not, a small change of the start becomes a large one.
///
/// It is in `f64` only, as [`FreeRotation`](crate::FreeRotation).
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Attitude, HeavyTop, Inertia};
/// // A rod that hangs and swings as a pendulum: A = P, so that its small swings take 2π s.
/// let inertia = Inertia::principal([1.0, 1.0, 0.01])?;
/// let hanging = Attitude::about_x(core::f64::consts::PI - 1e-5);
/// let motion = HeavyTop::new(&inertia, Vector3::new(0.0, 0.0, 1.0), hanging, Vector3::zeros())?;
/// assert!((motion.period_of_nutation() - core::f64::consts::PI).abs() < 1e-9); // θ returns twice in a swing
/// let (_, omega) = motion.at(0.5 * core::f64::consts::PI); // through the lowest point
/// assert!((omega.norm() - 1e-5).abs() < 1e-15);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(4.9) with G of the weight; E. T. Whittaker, *Analytical Dynamics*, 4th ed. 1937, §§71–73.
#[doc(alias("Lagrange top", "symmetric top", "spinning top", "nutation", "precession"))]
#[derive(Clone, Copy, Debug)]
pub struct HeavyTop {
    /// Columns: two axes across the axis of symmetry, and it, in body components.
    axes: Matrix3<f64>,
    /// The rotation of these axes in the body.
    in_body: Attitude<f64>,
    /// Angular velocity about the axis, rad/s.
    spin: f64,
    nutation: Nutation,
    turns: Turns,
    /// e^{i(φ + ψ)/2} and e^{i(φ − ψ)/2} at the start, less those of the integrals there.
    offsets: [Complex<f64>; 2],
}

impl HeavyTop {
    /// The motion from an attitude and an angular velocity (rad/s, body components) of a body with this inertia about the
    /// fixed point, on which its weight acts with `weight_times_arm`: mg times the vector from the fixed point to the centre
    /// of mass, in body components (N m).
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NoDirection`] for an attitude of length zero;
    /// [`KinematicsError::NotSymmetricAbout`] where the inertia is not symmetric about the arm.
    pub fn new(
        inertia: &Inertia,
        weight_times_arm: Vector3<f64>,
        attitude: Attitude<f64>,
        angular_velocity: Vector3<f64>,
    ) -> Result<Self, KinematicsError> {
        finite("weight times arm", weight_times_arm.as_slice())?;
        finite("attitude", &[attitude.w, attitude.x, attitude.y, attitude.z])?;
        finite("angular velocity", angular_velocity.as_slice())?;
        let length = attitude.squared_length().sqrt();
        if length <= 0.0 {
            return Err(KinematicsError::NoDirection { quantity: "attitude", length });
        }
        let weight = weight_times_arm.norm();
        let axes = axes_about(axis_of_symmetry(inertia, weight_times_arm));
        let [across, along] = symmetric_moments(inertia, &axes)?;
        let [w, x, y, z] = products(&axes);
        let in_body = Attitude { w, x, y, z }.normalise();
        let start = attitude.product(in_body).normalise();
        let omega = axes.transpose() * angular_velocity;
        let halves = [Complex::new(start.w, start.z), Complex::new(start.x, start.y)];
        let nutation = Nutation::new([across, along], weight, halves, omega.into());
        let turns = Turns::new(&nutation, (1.0 / along - 1.0 / across) * along * omega.z);
        let mut motion = Self { axes, in_body, spin: omega.z, nutation, turns, offsets: [Complex::new(1.0, 0.0); 2] };
        motion.offsets = motion.offsets_of(halves, omega);
        Ok(motion)
    }

    /// The directions that turn the motion as it is into the one with this start: of its places, and of its velocities too,
    /// because near the vertical a place has hardly a direction.
    fn offsets_of(&self, halves: [Complex<f64>; 2], omega: Vector3<f64>) -> [Complex<f64>; 2] {
        let (found, across) = self.halves_and_rate(0.0);
        let rates = rates_of_halves(halves, Complex::new(omega.x, omega.y), omega.z);
        let found_rates = rates_of_halves(found, across, omega.z);
        let scale = omega.norm_squared() + self.nutation.rate * self.nutation.rate;
        [0, 1].map(|i| {
            let mut along = halves[i] * found[i].conj();
            if 0.0 < scale {
                along += rates[i] * found_rates[i].conj() / scale;
            }
            let size = along.re.hypot(along.im);
            if 0.0 < size { along / size } else { Complex::new(1.0, 0.0) }
        })
    }

    /// q₀ + i q₃, q₁ + i q₂ and ω₁ + i ω₂ in the axes.
    fn halves_and_rate(&self, t: f64) -> ([Complex<f64>; 2], Complex<f64>) {
        let phase = self.nutation.phase(t);
        let [below, above] = self.nutation.heights(&phase);
        let turns = self.turns.at(&self.nutation, &phase, t);
        let [a, b] = [self.offsets[0] * turns[0], self.offsets[1] * turns[1]];
        let [along, falling] = self.nutation.rates(&phase);
        let across = Complex::new(0.0, 1.0) * a.conj() * b * Complex::new(along, falling);
        ([a * (0.5 * below).sqrt(), b * (0.5 * above).sqrt()], across)
    }

    /// The attitude and the angular velocity (rad/s, body components) after `t` seconds.
    #[must_use]
    pub fn at(&self, t: f64) -> (Attitude<f64>, Vector3<f64>) {
        let ([alpha, beta], across) = self.halves_and_rate(t);
        let turned = Attitude { w: alpha.re, x: beta.re, y: beta.im, z: alpha.im };
        let attitude = turned.product(self.in_body.conjugate()).normalise();
        (attitude, self.axes * Vector3::new(across.re, across.im, self.spin))
    }

    /// The turns since the start in `t` seconds, rad: how far (φ + ψ)/2 and (φ − ψ)/2 have grown, with all whole turns.
    ///
    /// An attitude has its angles but for whole turns. These tell how many there were. φ is that of precession, ψ that of the own
    /// turn, about the arm.
    ///
    /// # Accuracy
    /// Some tens of ulps of the turns.
    ///
    /// Where the arm passes exactly through the vertical, φ and ψ have no limit. The first turn jumps by π where the arm points
    /// down, the second where it points up, so that φ and ψ each jump by π. In that instant the turn is the one before or after
    /// the jump.
    ///
    /// # Example
    /// A top that sleeps turns about the vertical alone.
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{Attitude, HeavyTop, Inertia};
    /// let inertia = Inertia::principal([1.0, 1.0, 0.5])?;
    /// let (arm, omega) = (Vector3::new(0.0, 0.0, 1.0), Vector3::new(0.0, 0.0, 20.0));
    /// let sleeping = HeavyTop::new(&inertia, arm, Attitude::identity(), omega)?;
    /// assert!((sleeping.turns(3.0)[0] - 30.0).abs() < 1e-12); // half of 20 rad/s
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    #[must_use]
    pub fn turns(&self, t: f64) -> [f64; 2] {
        let at = |t: f64| self.turns.angles(&self.nutation, &self.nutation.phase(t), t);
        let (now, start) = (at(t), at(0.0));
        [now[0] - start[0], now[1] - start[1]]
    }

    /// The period of the angle θ between the axis and the vertical, s: infinite for the top that rises for ever towards the
    /// vertical. Of steady precession it is the period of a small disturbance.
    #[must_use]
    pub fn period_of_nutation(&self) -> f64 {
        self.nutation.period()
    }

    /// The least and the largest cos θ, u₁ and u₂.
    #[must_use]
    pub fn range_of_nutation(&self) -> [f64; 2] {
        self.nutation.range()
    }
}

/// The direction of the arm; without weight, the axis of symmetry.
fn axis_of_symmetry(inertia: &Inertia, weight_times_arm: Vector3<f64>) -> Vector3<f64> {
    if let Some(axis) = weight_times_arm.try_normalize(0.0) {
        return axis;
    }
    let principal = inertia.principal_axes();
    let [least, middle, most] = principal.moments;
    let place = if middle - least < most - middle { 2 } else { 0 };
    principal.axes.column(place).into()
}

/// A right-handed frame with this third axis.
fn axes_about(third: Vector3<f64>) -> Matrix3<f64> {
    let first = if third.z.abs() < 0.75 { Vector3::z() } else { Vector3::x() };
    let first = (first - third * third.dot(&first)).normalize();
    let second = third.cross(&first);
    Matrix3::from_columns(&[first, second, third])
}

/// The moments across the third axis and along it.
fn symmetric_moments(inertia: &Inertia, axes: &Matrix3<f64>) -> Result<[f64; 2], KinematicsError> {
    let moments = axes.transpose() * inertia.matrix() * axes;
    let across = 0.5 * (moments[(0, 0)] + moments[(1, 1)]);
    let difference = [moments[(0, 0)] - across, moments[(0, 1)], moments[(0, 2)], moments[(1, 2)]]
        .into_iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    if ROUNDING * across.max(moments[(2, 2)]) < difference {
        let axis = axes.column(2);
        return Err(KinematicsError::NotSymmetricAbout { axis: [axis[0], axis[1], axis[2]], difference });
    }
    Ok([across, moments[(2, 2)]])
}

/// The rates of q₀ + i q₃ and q₁ + i q₂, with ω₁ + i ω₂ and ω₃.
fn rates_of_halves([alpha, beta]: [Complex<f64>; 2], across: Complex<f64>, spin: f64) -> [Complex<f64>; 2] {
    let spin = Complex::new(0.0, spin);
    [(spin * alpha - beta * across.conj()) * 0.5, (alpha * across - spin * beta) * 0.5]
}
