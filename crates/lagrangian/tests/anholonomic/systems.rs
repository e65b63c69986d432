//! The systems of the reference data: few types, so that the equations are compiled once for all of them.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::anholonomic::{AnholonomicFrame, BodyAngularVelocity, Coframe};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential};
use piola_numerics::Real;

/// Three coordinates each.
#[derive(Clone, Copy, Debug)]
pub(crate) enum System {
    /// A body that turns about its centre of mass: Eulerian angles.
    Top(RigidBody),
    /// A body in the plane: blade at x, y, its centre of mass ahead.
    Sleigh { body: RigidBody, ahead: f64 },
    /// A particle in Cartesian coordinates.
    Particle(f64),
    /// A particle in coordinates that change with their place: x = q + a quadratic part.
    Bent(f64),
}

impl Holonomic for System {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let zero = T::zero();
        match self {
            Self::Top(body) => {
                let attitude = Attitude::from_euler_zyz([q[0], q[1], q[2]]);
                bodies.body(body, Vector3::new(zero, zero, zero), attitude);
            }
            Self::Sleigh { body, ahead } => {
                let (s, c) = q[2].sin_cos();
                let a = T::lit(*ahead);
                bodies.body(body, Vector3::new(q[0] + a * c, q[1] + a * s, zero), Attitude::about_z(q[2]));
            }
            Self::Particle(mass) => bodies.particle(*mass, Vector3::new(q[0], q[1], q[2])),
            Self::Bent(mass) => {
                let c = T::lit(0.25);
                let bent = Vector3::new(q[0] + c * q[1] * q[2], q[1] - c * q[0] * q[0], q[2] + c * q[1] * q[0]);
                bodies.particle(*mass, bent);
            }
        }
    }
}

/// V = m g h cos θ².
#[derive(Clone, Copy, Debug)]
pub(crate) struct Height(pub(crate) f64);

impl Potential for Height {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        T::lit(self.0) * q[1].cos()
    }
}

/// Constant forces along the coordinates, and a drag.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Applied {
    pub(crate) constant: [f64; 3],
    pub(crate) drag: f64,
}

impl Forces for Applied {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, _q: &[T], v: &[T], _t: T, q_out: &mut [T]) {
        for i in 0..3 {
            q_out[i] += T::lit(self.constant[i]) - T::lit(self.drag) * v[i];
        }
    }
}

/// Frames of three vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Frame {
    /// Along a blade, across it, and its turning.
    Blade,
    /// The smooth frame of the reference data.
    Smooth,
    /// A smooth frame of random weights, near the unit matrix.
    Random([f64; 9]),
    /// No vectors at all.
    Nothing,
    /// Two vectors that are one, and a third.
    Equal,
}

impl AnholonomicFrame for Frame {
    fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let (zero, one) = (T::zero(), T::one());
        let lit = T::lit;
        match self {
            Self::Blade => {
                let (s, c) = q[2].sin_cos();
                rows.copy_from_slice(&[c, s, zero, -s, c, zero, zero, zero, one]);
            }
            Self::Smooth => {
                let [x, y, z] = [q[0], q[1], q[2]];
                rows.copy_from_slice(&[
                    one + y.sin() / lit(4.0),
                    z / lit(8.0),
                    (x * z).cos() / lit(5.0),
                    x * y / lit(6.0),
                    lit(2.0) + z.cos() / lit(3.0),
                    x.sin() / lit(4.0),
                    (-x).exp() / lit(7.0),
                    y * y / lit(9.0),
                    lit(1.5) + (x + y).sin() / lit(5.0),
                ]);
            }
            Self::Random(weights) => {
                for (k, row) in rows.iter_mut().enumerate() {
                    let unit = if k % 4 == 0 { 2.0 } else { 0.0 };
                    *row = lit(unit) + lit(weights[k]) * (q[k % 3] + lit(weights[(k + 4) % 9]) * q[(k + 1) % 3]).sin();
                }
            }
            Self::Nothing => rows.fill(zero),
            Self::Equal => rows.copy_from_slice(&[one, one, zero, one, one, zero, zero, zero, one]),
        }
    }
}

/// Coframes of three quasi-velocities.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Forms {
    /// The angular velocity in body axes.
    Body(BodyAngularVelocity),
    /// Along a blade, across it, and its turning.
    Blade,
    /// A smooth coframe of random weights, near the unit matrix.
    Random([f64; 9]),
    /// Rates of functions of the coordinates: u^A = d/dt f^A(q).
    Rates,
}

impl Coframe for Forms {
    fn coframe<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        match self {
            Self::Body(angles) => angles.coframe(q, t, rows),
            Self::Blade => Frame::Blade.frame(q, t, rows),
            Self::Random(weights) => Frame::Random(*weights).frame(q, t, rows),
            Self::Rates => {
                // f = (q₀ + sin q₁, q₁ + q₀ q₂ / 4, q₂ + cos q₀ / 2)
                let (zero, one, c) = (T::zero(), T::one(), T::lit(0.25));
                let across = T::lit(-0.5) * q[0].sin();
                rows.copy_from_slice(&[one, q[1].cos(), zero, c * q[2], one, c * q[0], across, zero, one]);
            }
        }
    }
}

/// A frame that changes with time and drifts; the same numbers as a coframe.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving(pub(crate) [f64; 9]);

impl Moving {
    fn rows<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        Frame::Random(self.0).frame(q, t, rows);
        for (k, row) in rows.iter_mut().enumerate() {
            *row += T::lit(0.25 * self.0[k]) * (t + q[(k + 2) % 3]).cos();
        }
    }
    fn slip<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        for (k, drift) in drift.iter_mut().enumerate() {
            *drift = T::lit(self.0[k]) * t.sin() + T::lit(self.0[k + 3]) * q[k] * q[(k + 1) % 3];
        }
    }
}

impl AnholonomicFrame for Moving {
    const TIME_DEPENDENT: bool = true;
    const DRIFT: bool = true;
    fn frame<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        self.rows(q, t, rows);
    }
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        self.slip(q, t, drift);
    }
}

impl Coframe for Moving {
    const TIME_DEPENDENT: bool = true;
    const DRIFT: bool = true;
    fn coframe<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        self.rows(q, t, rows);
    }
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        self.slip(q, t, drift);
    }
}

/// The coframe of a moving frame, inverted by cofactors; u = A q̇ − A d.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inverted(pub(crate) Moving);

impl Coframe for Inverted {
    const TIME_DEPENDENT: bool = true;
    const DRIFT: bool = true;
    fn coframe<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        let mut k = [T::zero(); 9];
        self.0.rows(q, t, &mut k);
        let minor = |i: usize, j: usize| {
            let [a, b] = [(i + 1) % 3, (i + 2) % 3];
            let [c, d] = [(j + 1) % 3, (j + 2) % 3];
            k[3 * a + c] * k[3 * b + d] - k[3 * a + d] * k[3 * b + c]
        };
        let determinant = k[0] * minor(0, 0) + k[1] * minor(0, 1) + k[2] * minor(0, 2);
        for i in 0..3 {
            for j in 0..3 {
                rows[3 * i + j] = minor(i, j) / determinant; // A^A_C k_B^C = δ^A_B
            }
        }
    }
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        let mut rows = [T::zero(); 9];
        let mut slip = [T::zero(); 3];
        self.coframe(q, t, &mut rows);
        self.0.slip(q, t, &mut slip);
        for (row, drift) in rows.chunks_exact(3).zip(drift) {
            *drift = -(row[0] * slip[0] + row[1] * slip[1] + row[2] * slip[2]);
        }
    }
}

/// The Lagrangian of every test.
pub(crate) type All = Lagrangian<System, Height, Applied>;

pub(crate) fn all(system: System, gravity: [f64; 3], height: f64, applied: Applied) -> All {
    Lagrangian::of(system).with_uniform_gravity(gravity).with_potential(Height(height)).with_forces(applied)
}

/// A body with principal moments of inertia.
pub(crate) fn body(mass: f64, moments: [f64; 3]) -> RigidBody {
    let inertia = Inertia::principal(moments).expect("moments of a body");
    RigidBody::new(mass, inertia).expect("a mass")
}
