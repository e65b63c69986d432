//! The systems of the reference data as few types, so that laws are compiled once for all of them.

use nalgebra::Vector3;
use piola_kinematics::Attitude;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential};
use piola_numerics::Real;

use crate::systems::*;

/// A system whose placement does not depend on time.
pub(crate) enum Still {
    DoublePendulum(DoublePendulum),
    SphericalPendulum(SphericalPendulum),
    HeavyTop(HeavyTop),
    ElasticPendulum(ElasticPendulum),
    Torus(Torus),
    HingedBodies(HingedBodies),
    FreeBody(FreeBody),
    Chain(Chain),
}

impl Holonomic for Still {
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        match self {
            Self::DoublePendulum(system) => system.place(q, t, bodies),
            Self::SphericalPendulum(system) => system.place(q, t, bodies),
            Self::HeavyTop(system) => system.place(q, t, bodies),
            Self::ElasticPendulum(system) => system.place(q, t, bodies),
            Self::Torus(system) => system.place(q, t, bodies),
            Self::HingedBodies(system) => system.place(q, t, bodies),
            Self::FreeBody(system) => system.place(q, t, bodies),
            Self::Chain(system) => system.place(q, t, bodies),
        }
    }
}

/// A system whose placement depends on time.
pub(crate) enum Moving {
    BeadOnHoop(BeadOnHoop),
    Foucault(Foucault),
}

impl Holonomic for Moving {
    const TIME_DEPENDENT: bool = true;
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        match self {
            Self::BeadOnHoop(system) => system.place(q, t, bodies),
            Self::Foucault(system) => system.place(q, t, bodies),
        }
    }
}

/// One of their potentials.
pub(crate) enum AnyPotential {
    None,
    Spring(RadialSpring),
    Height(Foucault, f64),
    Torsion(Torsion),
}

impl Potential for AnyPotential {
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        match self {
            Self::None => T::zero(),
            Self::Spring(potential) => potential.potential(q, v, t),
            Self::Height(pendulum, gravity) => Height { pendulum, gravity: *gravity }.potential(q, v, t),
            Self::Torsion(potential) => potential.potential(q, v, t),
        }
    }
}

/// What acts on every part and body, depending on all that it may; or nothing.
pub(crate) struct Everything(pub(crate) bool);

impl Forces for Everything {
    const GENERALISED: bool = true;
    const ON_PARTS: bool = true;
    const MOMENTS: bool = true;

    fn generalised<T: Real>(&self, q: &[T], v: &[T], t: T, q_out: &mut [T]) {
        if self.0 {
            for (i, out) in q_out.iter_mut().enumerate() {
                *out += T::lit(0.25) * (q[i] + t).sin() - T::lit(0.125) * v[i];
            }
        }
    }
    fn on_part<T: Real>(&self, part: usize, x: [T; 3], velocity: [T; 3], t: T) -> [T; 3] {
        if !self.0 {
            return [T::zero(); 3];
        }
        let c = T::lit(0.1 + 0.1 * part as f64);
        [c * x[1] - velocity[0], t.cos() - c * velocity[1], c * x[0] * x[2]]
    }
    fn moment_on_body<T: Real>(&self, _part: usize, attitude: Attitude<T>, omega: [T; 3], t: T) -> [T; 3] {
        if !self.0 {
            return [T::zero(); 3];
        }
        let about_z = attitude.to_body(&Vector3::new(T::zero(), T::zero(), t.sin()));
        [about_z.x - T::lit(0.3) * omega[1], about_z.y + omega[0] * omega[0], about_z.z]
    }
}

/// A law as a function of any system at a state.
pub(crate) trait Law {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    );
}

/// Runs a law for each system at a random state: six numbers in (−1, 1) and (−2, 2).
pub(crate) fn for_all_systems(law: &impl Law, q: &[f64], v: &[f64], t: f64) {
    let still = |system: Still, gravity: [f64; 3], potential: AnyPotential, driven: bool| {
        Lagrangian::of(system).with_uniform_gravity(gravity).with_potential(potential).with_forces(Everything(driven))
    };
    let along_y = [0.0, -9.8, 0.0];
    let along_z = [0.0, 0.0, -9.8];
    let none = || AnyPotential::None;
    let (q2, v2) = (&q[..2], &v[..2]);
    for driven in [false, true] {
        let double = Still::DoublePendulum(DoublePendulum { mass: [1.0, 2.0], length: [1.0, 0.5] });
        law.check("double pendulum", &still(double, along_y, none(), driven), q2, v2, t);
        let angles = [1.5 + q[0], q[1]]; // away from the poles of the chart
        let spherical = Still::SphericalPendulum(SphericalPendulum { mass: 2.0, length: 0.75 });
        law.check("spherical pendulum", &still(spherical, along_z, none(), driven), &angles, v2, t);
        let euler = [q[0], 1.5 + q[1], q[2]];
        let top = Still::HeavyTop(HeavyTop::new(1.0, 0.5, 1.0, 0.25));
        law.check("heavy top", &still(top, along_z, none(), driven), &euler, &v[..3], t);
        let spring = AnyPotential::Spring(RadialSpring { stiffness: 40.0, rest: 1.0 });
        let elastic = still(Still::ElasticPendulum(ElasticPendulum { mass: 1.5 }), along_z, spring, driven);
        law.check("elastic pendulum", &elastic, &[1.5 + 0.5 * q[0], q[1]], v2, t);
        let torus = Still::Torus(Torus { mass: 1.0, large: 2.0, small: 0.5 });
        law.check("torus", &still(torus, along_z, none(), driven), q2, v2, t);
        let hinged = Still::HingedBodies(HingedBodies::new([1.0, 3.0], [0.5, 0.25], [0.5, 0.75]));
        let torsion = AnyPotential::Torsion(Torsion { stiffness: 2.0 });
        law.check("hinged bodies", &still(hinged, along_y, torsion, driven), &q[..4], &v[..4], t);
        let free = Still::FreeBody(FreeBody::new(2.0, uneven_inertia()));
        let pose = [q[0], q[1], q[2], q[3], 1.5 + q[4], q[5]];
        law.check("free body", &still(free, along_z, none(), driven), &pose, v, t);
        let angles: Vec<f64> = (0..11).map(|i| q[i % 6] + 0.1 * i as f64).collect();
        let rates: Vec<f64> = (0..11).map(|i| v[(i + 2) % 6]).collect();
        let chain = Still::Chain(Chain { links: 11 });
        law.check("chain of 11", &still(chain, along_z, none(), driven), &angles, &rates, t);

        let moving = |system: Moving, gravity: [f64; 3], potential: AnyPotential| {
            let moved = Lagrangian::of(system).with_uniform_gravity(gravity);
            moved.with_potential(potential).with_forces(Everything(driven))
        };
        let bead = BeadOnHoop { mass: 0.5, radius: 2.0, rate: 1.5, wobble: 0.25, frequency: 3.0 };
        law.check("bead on a hoop", &moving(Moving::BeadOnHoop(bead), along_z, none()), &q[..1], &v[..1], t);
        let pendulum = Foucault { mass: 1.0, length: 4.0, rate: 0.5, latitude: 0.75 };
        let turning = moving(Moving::Foucault(pendulum), [0.0; 3], AnyPotential::Height(pendulum, 9.8));
        law.check("pendulum of Foucault", &turning, q2, v2, t);

        let field = Lorentz { charge: 2.0, electric: [0.5, -0.25, 0.125], magnetic: [1.0, -2.0, 0.5] };
        let charged = Lagrangian::of(Cylindrical { mass: 1.5 }).with_potential(field).with_forces(Everything(driven));
        law.check("charged particle", &charged, &[1.5 + 0.5 * q[0], q[1], q[2]], &v[..3], t);
    }
}
