//! Mechanisms with closed loops, in too many coordinates and in one: few types, so that the equations are compiled
//! once for all of them.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::constraints::Constraints;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential};
use piola_numerics::Real;

use crate::andrews::Squeezer;

pub(crate) fn body(mass: f64, moment: f64) -> RigidBody {
    let inertia = Inertia::principal([moment; 3]).expect("moments of a body");
    RigidBody::new(mass, inertia).expect("a mass")
}

/// What moves.
#[derive(Clone, Copy)]
pub(crate) enum System {
    /// Crank, coupler and rocker, each at its own angle from x.
    FourBar,
    /// The same by the crank's angle, the others by the closed triangle.
    FourBarCrank,
    /// Bricard's loop in its six joint angles; unless the sixth link, which is fixed, is given a mass, nothing that
    /// the last angle moves has inertia.
    Bricard { sixth: bool },
    /// The same by the one parameter of its symmetric motion.
    BricardSymmetric,
    /// Andrews' squeezing mechanism.
    Squeezer(&'static Squeezer),
    /// N parallelograms side by side: N + 1 posts that stand on the ground, and N rungs that join their tips; all rods of 1 kg
    /// and 1 m. Posts and rungs have their angles in turn; the ground is turned by an angle.
    Ladder { turn: f64 },
    /// A crank and a rod of 1 kg and 1 m each, and a slider of 2 kg on the line of the crank's axis: the angles of crank and rod from
    /// x, and the place of the slider. With crank and rod along each other across the rail, two motions meet.
    SliderCrank,
    /// The same without the rod's angle and mass: the angle of the crank, the place of the slider.
    SliderOnRod,
    /// Particles of 1 kg, 2 kg, … at (q₀, q₁, q₂), …; without the last coordinate's inertia.
    Particles { last_has_mass: bool },
    /// A bead of 2 kg in polar coordinates (r, φ).
    Polar,
}

/// Crank, coupler, rocker and frame, m: the crank turns round, the rocker swings.
pub(crate) const BARS: [f64; 4] = [0.1, 0.35, 0.3, 0.4];
/// The length of Bricard's links, m.
pub(crate) const LINK: f64 = 0.5;

impl Holonomic for System {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        match self {
            Self::FourBar => place_bars([q[0], q[1], q[2]], bodies),
            Self::FourBarCrank => place_bars(bar_angles(q[0]), bodies),
            Self::Bricard { sixth } => place_loop(q, if *sixth { 6 } else { 5 }, bodies),
            Self::BricardSymmetric => place_loop(&loop_angles(q[0]), 5, bodies),
            Self::Squeezer(squeezer) => squeezer.place(q, bodies),
            Self::Ladder { turn } => {
                let half = T::lit(0.5);
                let mut post = unit(q[0]);
                for (k, &angle) in q.iter().enumerate() {
                    let foot = unit(T::lit(*turn)) * T::lit((k / 2) as f64);
                    let along = unit(angle);
                    let start = if k % 2 == 0 { foot } else { foot + post };
                    bodies.body(&body(1.0, 1.0 / 12.0), start + along * half, Attitude::about_z(angle));
                    post = along;
                }
            }
            Self::SliderCrank | Self::SliderOnRod => {
                let (half, zero) = (T::lit(0.5), T::zero());
                bodies.body(&body(1.0, 1.0 / 12.0), unit(q[0]) * half, Attitude::about_z(q[0]));
                if let Self::SliderCrank = self {
                    bodies.body(&body(1.0, 1.0 / 12.0), unit(q[0]) + unit(q[1]) * half, Attitude::about_z(q[1]));
                }
                bodies.particle(2.0, Vector3::new(q[q.len() - 1], zero, zero));
            }
            Self::Particles { last_has_mass } => {
                let count = q.len().div_ceil(3);
                for (k, x) in q.chunks(3).enumerate() {
                    let mut at = [T::zero(); 3];
                    at[..x.len()].copy_from_slice(x);
                    if k + 1 == count && !last_has_mass {
                        at[x.len() - 1] = T::zero();
                    }
                    bodies.particle((k + 1) as f64, at.into());
                }
            }
            Self::Polar => {
                let (s, c) = q[1].sin_cos();
                bodies.particle(2.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
            }
        }
    }
}

fn unit<T: Real>(angle: T) -> Vector3<T> {
    let (s, c) = angle.sin_cos();
    Vector3::new(c, s, T::zero())
}

/// Bars of 1, 3 and 2 kg, their centres of mass half way; the crank carries a flywheel.
fn place_bars<T: Real>(angles: [T; 3], bodies: &mut impl Placement<T>) {
    let [a, b, c, d] = BARS.map(T::lit);
    let half = T::lit(0.5);
    let along = |length: T, angle: T| {
        let (s, c) = angle.sin_cos();
        Vector3::new(length * c, length * s, T::zero())
    };
    let [crank, coupler, rocker] = angles;
    bodies.body(&body(1.0, 0.2), along(a * half, crank), Attitude::about_z(crank));
    bodies.body(&body(3.0, 0.03), along(a, crank) + along(b * half, coupler), Attitude::about_z(coupler));
    let pivot = Vector3::new(d, T::zero(), T::zero());
    bodies.body(&body(2.0, 0.015), pivot + along(c * half, rocker), Attitude::about_z(rocker));
}

/// The angles of crank, coupler and rocker: the triangle of coupler, rocker and diagonal, coupler above.
pub(crate) fn bar_angles<T: Real>(crank: T) -> [T; 3] {
    let [a, b, c, d] = BARS.map(T::lit);
    let (sine, cosine) = crank.sin_cos();
    let (x, y) = (d - a * cosine, -(a * sine));
    let squared = x * x + y * y;
    let diagonal = squared.sqrt();
    let beside = ((squared + b * b - c * c) / (T::lit(2.0) * b * diagonal)).acos();
    let coupler = y.atan2(x) + beside;
    let (s, k) = coupler.sin_cos();
    let rocker = (b * s - y).atan2(b * k - x);
    [crank, coupler, rocker]
}

/// Walks round the loop: link i turns by qᵢ about z, has its length along x, and ends with z turned by ±90° about x.
/// `visit` sees the start and the attitude of each link; returns where the loop ends.
fn walk<T: Real>(q: &[T], mut visit: impl FnMut(usize, Vector3<T>, Attitude<T>)) -> (Vector3<T>, Attitude<T>) {
    let zero = T::zero();
    let mut place = Vector3::new(zero, zero, zero);
    let mut attitude = Attitude::identity();
    let half = T::lit(core::f64::consts::FRAC_1_SQRT_2);
    for (i, &angle) in q.iter().enumerate() {
        attitude = attitude.product(Attitude::about_z(angle));
        visit(i, place, attitude);
        place += attitude.to_space(&Vector3::new(T::lit(LINK), zero, zero));
        let twist = if i % 2 == 0 { half } else { -half };
        attitude = attitude.product(Attitude { w: half, x: twist, y: zero, z: zero });
    }
    (place, attitude)
}

/// The first links, of different masses.
fn place_loop<T: Real>(q: &[T], links: usize, bodies: &mut impl Placement<T>) {
    walk(q, |i, start, attitude| {
        if i < links {
            let mass = 1.0 + 0.25 * i as f64;
            let centre = Vector3::new(T::lit(0.5 * LINK), T::lit(0.05), T::lit(-0.02));
            bodies.body(&body(mass, 0.02 * mass), start + attitude.to_space(&centre), attitude);
        }
    });
}

/// The six joint angles (θ, φ, θ, φ, θ, φ) of the symmetric motion: cos θ/2 cos φ/2 = 1/2.
pub(crate) fn loop_angles<T: Real>(psi: T) -> [T; 6] {
    let (s, c) = psi.sin_cos();
    let (root, two) = (T::lit(3.0_f64.sqrt()), T::lit(2.0));
    let theta = two * (root * c).atan();
    let phi = two * (root * s / (T::one() + T::lit(3.0) * c * c).sqrt()).atan();
    [theta, phi, theta, phi, theta, phi]
}

/// The spring of the squeezer.
#[derive(Clone)]
pub(crate) struct Spring(pub(crate) System);

impl Potential for Spring {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        if let System::Squeezer(squeezer) = &self.0 { squeezer.potential(q) } else { T::zero() }
    }
}

/// A moment on the first coordinate.
#[derive(Clone)]
pub(crate) struct Drive(pub(crate) f64);

impl Forces for Drive {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, q_out: &mut [T]) {
        q_out[0] += T::lit(self.0);
    }
}

pub(crate) type Mechanism = Lagrangian<System, Spring, Drive>;

pub(crate) fn mechanism(system: System, gravity: [f64; 3], drive: f64) -> Mechanism {
    Lagrangian::of(system).with_uniform_gravity(gravity).with_potential(Spring(system)).with_forces(Drive(drive))
}

/// What ties the coordinates together.
#[derive(Clone)]
pub(crate) enum Ties {
    /// The loop of the four bars.
    FourBar,
    /// The same, its second equation given twice, and the sum of both.
    FourBarThrice,
    /// Bricard's loop: three components of place, three of attitude.
    Bricard,
    Squeezer(&'static Squeezer),
    /// Σ aᵢ qᵢ = b + c t for each row [b, c, a…].
    Linear(Vec<Vec<f64>>),
    /// Distances between particles, squared, over twice the distance: (first, second, distance).
    Distances(Vec<(usize, usize, f64)>),
    /// r = l.
    Radius(f64),
    /// The loops of a ladder of N, its ground turned by an angle.
    Ladder {
        n: usize,
        turn: f64,
    },
    /// The rod of a slider-crank ends at the slider.
    SliderCrank,
    /// The pin of the crank and the slider are 1 m apart.
    SliderOnRod,
    /// The same at a distance l, and the slider is driven so that the crank turns at 1 rad/s: x = cos t + √(l² − sin² t). At dead
    /// centre, where crank and rod lie along the rail, the rod and the drive hold the same.
    DrivenSlider {
        rod: f64,
    },
}

impl Constraints for Ties {
    const TIME_DEPENDENT: bool = true;
    fn count(&self) -> usize {
        match self {
            Self::FourBar | Self::SliderCrank | Self::DrivenSlider { .. } => 2,
            Self::FourBarThrice => 4,
            Self::Bricard | Self::Squeezer(_) => 6,
            Self::Linear(rows) => rows.len(),
            Self::Distances(pairs) => pairs.len(),
            Self::Radius(_) | Self::SliderOnRod => 1,
            Self::Ladder { n, .. } => 2 * n,
        }
    }
    fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]) {
        match self {
            Self::FourBar => close_bars(q, out),
            Self::FourBarThrice => {
                close_bars(q, out);
                out[2] = T::lit(-2.0) * out[1];
                out[3] = out[0] + T::lit(0.5) * out[1];
            }
            Self::Bricard => {
                let (place, attitude) = walk(q, |_, _, _| {});
                out[..3].copy_from_slice(place.as_slice());
                out[3..].copy_from_slice(&[attitude.x, attitude.y, attitude.z]);
            }
            Self::Squeezer(squeezer) => squeezer.close(q, out),
            Self::Linear(rows) => {
                for (row, out) in rows.iter().zip(out) {
                    *out = T::lit(-row[0]) - T::lit(row[1]) * t;
                    for (&a, &q) in row[2..].iter().zip(q) {
                        *out += T::lit(a) * q;
                    }
                }
            }
            Self::Distances(pairs) => {
                for (&(i, j, distance), out) in pairs.iter().zip(out) {
                    *out = T::lit(-0.5 * distance);
                    for k in 0..3 {
                        let difference = q[3 * i + k] - q[3 * j + k];
                        *out += difference * difference * T::lit(0.5 / distance);
                    }
                }
            }
            Self::Ladder { turn, .. } => {
                let ground = unit(T::lit(*turn));
                for (angles, out) in q.windows(3).step_by(2).zip(out.chunks_exact_mut(2)) {
                    let gap = unit(angles[0]) + unit(angles[1]) - unit(angles[2]) - ground;
                    out.copy_from_slice(&[gap.x, gap.y]);
                }
            }
            Self::SliderCrank => {
                let end = unit(q[0]) + unit(q[1]);
                out.copy_from_slice(&[end.x - q[2], end.y]);
            }
            Self::SliderOnRod => {
                let pin = unit(q[0]);
                out[0] = T::lit(0.5) * ((pin.x - q[1]) * (pin.x - q[1]) + pin.y * pin.y - T::one());
            }
            Self::DrivenSlider { rod } => {
                let (pin, turned) = (unit(q[0]), unit(t));
                let squared = T::lit(rod * rod);
                out[0] = T::lit(0.5) * ((pin.x - q[1]) * (pin.x - q[1]) + pin.y * pin.y - squared);
                out[1] = q[1] - turned.x - (squared - turned.y * turned.y).sqrt();
            }
            Self::Radius(length) => out[0] = q[0] - T::lit(*length),
        }
    }
    fn name(&self, constraint: usize) -> Option<&str> {
        match self {
            Self::FourBarThrice => Some(["closure along x", "closure along y", "closure again", "sum"][constraint]),
            Self::Ladder { .. } => Some(["loop along x", "loop along y"][constraint % 2]),
            _ => None,
        }
    }
}

fn close_bars<T: Real>(q: &[T], out: &mut [T]) {
    let [a, b, c, d] = BARS.map(T::lit);
    let [(s0, c0), (s1, c1), (s2, c2)] = [q[0].sin_cos(), q[1].sin_cos(), q[2].sin_cos()];
    out[0] = a * c0 + b * c1 - c * c2 - d;
    out[1] = a * s0 + b * s1 - c * s2;
}
