//! The systems of these tests, as few types so that each law is compiled once.

use nalgebra::{DMatrix, DVector, Vector3};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::small_motions::Linearisation;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential};
use piola_numerics::Real;

pub(crate) const GRAVITY: f64 = 9.75;

/// A symmetric top: transverse moment about the fixed point, axial moment, mass, height of the centre.
pub(crate) const TOP: [f64; 4] = [1.0, 0.25, 2.0, 0.5];

/// A system whose placement does not depend on time.
pub(crate) enum Still {
    /// Masses on a line.
    Masses(Vec<f64>),
    /// A unit mass at x₀ + q.
    Displaced(f64),
    /// Pendulums hung on each other: masses and lengths.
    Pendulums(Vec<f64>, Vec<f64>),
    /// A cart of one mass, and a pendulum of unit length and the other mass above it.
    CartPole(f64, f64),
    /// A unit mass at (q₁ + q₂, δ q₂): tangents that are nearly parallel.
    Sheared(f64),
    /// Tilts about x and y, then the spin.
    Top(RigidBody),
    /// A body that slides along a line.
    Slide(RigidBody),
}

impl Still {
    pub(crate) fn top() -> Self {
        let [transverse, axial, mass, height] = TOP;
        let central = transverse - mass * height * height;
        Self::Top(RigidBody::new(mass, Inertia::principal([central, central, axial]).unwrap()).unwrap())
    }
}

impl Holonomic for Still {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        match self {
            Self::Masses(masses) => {
                for (&mass, &x) in masses.iter().zip(q) {
                    bodies.particle(mass, Vector3::new(x, T::zero(), T::zero()));
                }
            }
            Self::Displaced(place) => {
                bodies.particle(1.0, Vector3::new(T::lit(*place) + q[0], T::zero(), T::zero()));
            }
            Self::Pendulums(masses, lengths) => {
                let mut end = Vector3::new(T::zero(), T::zero(), T::zero());
                for ((&mass, &length), angle) in masses.iter().zip(lengths).zip(q) {
                    let (s, c) = angle.sin_cos();
                    let length = T::lit(length);
                    end += Vector3::new(length * s, T::zero(), -length * c);
                    bodies.particle(mass, end);
                }
            }
            Self::CartPole(cart, mass) => {
                let (s, c) = q[1].sin_cos();
                bodies.particle(*cart, Vector3::new(q[0], T::zero(), T::zero()));
                bodies.particle(*mass, Vector3::new(q[0] + s, T::zero(), c));
            }
            Self::Sheared(delta) => {
                bodies.particle(1.0, Vector3::new(q[0] + q[1], T::zero(), T::lit(*delta) * q[1]));
            }
            Self::Top(body) => {
                let attitude =
                    Attitude::about_x(q[0]).product(Attitude::about_y(q[1])).product(Attitude::about_z(q[2]));
                let centre = attitude.to_space(&Vector3::new(T::zero(), T::zero(), T::lit(TOP[3])));
                bodies.body(body, centre, attitude);
            }
            Self::Slide(body) => {
                bodies.body(body, Vector3::new(q[0], T::zero(), T::zero()), Attitude::about_x(T::zero()));
            }
        }
    }
}

/// A system whose placement depends on time.
pub(crate) enum Turning {
    /// A bead of the given mass on a hoop of the given radius, turned about the vertical at a steady rate; θ
    /// from the lowest point.
    Hoop([f64; 3]),
    /// A pendulum of the given mass and length on a turning earth: rate, latitude; x east, y north.
    Foucault([f64; 4]),
}

impl Holonomic for Turning {
    const TIME_DEPENDENT: bool = true;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        match *self {
            Self::Hoop([mass, radius, rate]) => {
                let ((s, c), (sp, cp)) = (q[0].sin_cos(), (T::lit(rate) * t).sin_cos());
                let r = T::lit(radius);
                bodies.particle(mass, Vector3::new(r * s * cp, r * s * sp, -r * c));
            }
            Self::Foucault([mass, length, rate, latitude]) => {
                let (s, c) = latitude.sin_cos();
                let turn = Attitude::from_rotation_vector(&Vector3::new(0.0, c, s).map(|x| T::lit(rate * x) * t));
                bodies.particle(mass, turn.to_space(&Vector3::new(q[0], q[1], height(length, q))));
            }
        }
    }
}

/// The height of a pendulum's bob in the turning frame.
fn height<T: Real>(length: f64, q: &[T]) -> T {
    -(T::lit(length * length) - q[0] * q[0] - q[1] * q[1]).sqrt()
}

/// A potential.
pub(crate) enum Acts {
    Nothing,
    /// ½ q·K q − b·q.
    Springs(DMatrix<f64>, Vec<f64>),
    /// Between a mass at x₀ + q and the origin: stiffness, x₀ and length at rest.
    Spring([f64; 3]),
    /// Weight along the vertical that turns with the earth.
    Weight([f64; 4]),
    /// e^q: a force without end.
    Exponential,
}

impl Potential for Acts {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        match self {
            Self::Nothing => T::zero(),
            Self::Springs(stiffness, load) => {
                let mut sum = T::zero();
                for (i, &a) in q.iter().enumerate() {
                    for (j, &b) in q.iter().enumerate() {
                        sum += T::lit(0.5 * stiffness[(i, j)]) * a * b;
                    }
                    sum -= T::lit(load[i]) * a;
                }
                sum
            }
            Self::Spring([stiffness, place, rest]) => {
                let stretch = T::lit(*place) + q[0] - T::lit(*rest);
                T::lit(0.5 * stiffness) * stretch * stretch
            }
            Self::Weight([mass, length, ..]) => T::lit(mass * GRAVITY) * height(*length, q),
            Self::Exponential => q[0].exp(),
        }
    }
}

/// Forces −D q̇ − N q.
#[derive(Default)]
pub(crate) struct Linear {
    pub(crate) velocity: Option<DMatrix<f64>>,
    pub(crate) position: Option<DMatrix<f64>>,
}

impl Forces for Linear {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, q: &[T], v: &[T], _t: T, q_out: &mut [T]) {
        for (matrix, x) in [(&self.velocity, v), (&self.position, q)] {
            let Some(matrix) = matrix else { continue };
            for (i, out) in q_out.iter_mut().enumerate() {
                for (j, &x) in x.iter().enumerate() {
                    *out -= T::lit(matrix[(i, j)]) * x;
                }
            }
        }
    }
}

pub(crate) type Standing = Lagrangian<Still, Acts, Linear>;
pub(crate) type Rotating = Lagrangian<Turning, Acts>;

pub(crate) fn standing(system: Still) -> Standing {
    Lagrangian::of(system).with_gravity(GRAVITY).with_potential(Acts::Nothing).with_forces(Linear::default())
}

/// Masses on a line, with springs.
pub(crate) fn sprung(masses: Vec<f64>, stiffness: DMatrix<f64>, forces: Linear) -> Standing {
    let load = vec![0.0; masses.len()];
    Lagrangian::of(Still::Masses(masses)).with_potential(Acts::Springs(stiffness, load)).with_forces(forces)
}

pub(crate) fn hoop(mass: f64, radius: f64, rate: f64) -> Rotating {
    Lagrangian::of(Turning::Hoop([mass, radius, rate])).with_gravity(GRAVITY).with_potential(Acts::Nothing)
}

pub(crate) fn foucault(parameters: [f64; 4]) -> Rotating {
    Lagrangian::of(Turning::Foucault(parameters)).with_potential(Acts::Weight(parameters))
}

/// The stiffness of n equal springs of strength k in a row, held at the given number of ends.
pub(crate) fn row_of_springs(n: usize, k: f64, held: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| {
        let free = usize::from(i == 0 && held < 1) + usize::from(i + 1 == n && held < 2);
        if i == j {
            k * (2.0 - free as f64)
        } else if i.abs_diff(j) == 1 {
            -k
        } else {
            0.0
        }
    })
}

/// A linearisation given by its matrices D and K.
pub(crate) fn linear(mass_matrix: DMatrix<f64>, velocity: &DMatrix<f64>, position: &DMatrix<f64>) -> Linearisation {
    let even = |a: &DMatrix<f64>| (a + a.transpose()) * 0.5;
    let odd = |a: &DMatrix<f64>| (a - a.transpose()) * 0.5;
    Linearisation {
        acceleration: DVector::zeros(mass_matrix.nrows()),
        mass_matrix,
        damping: even(velocity),
        gyroscopic: odd(velocity),
        stiffness: even(position),
        circulatory: odd(position),
    }
}
