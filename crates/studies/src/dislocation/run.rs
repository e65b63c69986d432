//! Circuits, their development, torsion and flatness.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use nalgebra::{Matrix3, Vector3};
use piola_integrators::Tolerance;
use piola_numerics::Real;
use piola_uniformity::{
    AffineConnection, BurgersVector, DislocationDensity, Flatness, InverseMap, LieAlgebra, MaterialConnection,
    ReferenceCurve, RoundCircuit, TransportedFrame, UniformityError, UniformityMap,
};

use super::{ScrewDislocations, Screws};
use crate::observer::{Observer, outcome};
use piola_simulation::Outcome;

/// Arcs in which the largest circuit is developed.
const ARCS: u32 = 96;
/// Places along a radius at which the torsion is computed.
const PLACES: u32 = 60;
/// Tolerance of quadratures and of transport.
const TOLERANCE: f64 = 1e-12;

/// A circle and its Burgers vector.
///
/// # Example
/// See [`ScrewDislocations`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BurgersCircuit {
    /// Radius, m.
    pub radius: f64,
    /// b, m, in components of the crystal.
    pub burgers: [f64; 3],
    /// Estimated error of each component, m.
    pub error: [f64; 3],
    /// b₃ in closed form, m, where there is one.
    pub closed_form: Option<f64>,
}

/// Density of dislocations and torsion at a place.
///
/// # Example
/// See [`ScrewDislocations`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorsionAt {
    /// Distance from the axis, m.
    pub distance: f64,
    /// Burgers vector of screws per area, 1/m.
    pub screw: f64,
    /// The size of that of edges, 1/m.
    pub edge: f64,
    /// The largest component of the torsion of the crystal's connection, 1/m.
    pub torsion: f64,
}

/// Circuits in a crystal with screws.
///
/// # Example
/// See [`ScrewDislocations`].
#[derive(Debug, Clone, Default)]
pub struct BurgersCircuits {
    /// The circuits, in the order of `radii`.
    pub circuits: Vec<BurgersCircuit>,
    /// The largest circuit in the body, m.
    pub in_body: Vec<[f64; 3]>,
    /// The same circuit as it runs in the crystal, m: it ends at the Burgers vector.
    pub in_crystal: Vec<[f64; 3]>,
    /// The largest |holonomy − 1| of its arcs: zero where parallel directions do not depend on the way.
    pub holonomy: f64,
    /// Along a radius from the axis.
    pub torsion: Vec<TorsionAt>,
    /// Whether the crystal is locally homogeneous.
    pub of_crystal: Option<Flatness>,
    /// Whether an isotropic solid with the same K is.
    pub of_isotropic_solid: Option<Flatness>,
}

/// A part of a circle about the z axis, from one share of it to another.
struct Arc {
    centre: [f64; 2],
    radius: f64,
    shares: [f64; 2],
}

impl ReferenceCurve for Arc {
    fn place<T: Real>(&self, _piece: usize, s: T) -> Vector3<T> {
        let [from, to] = self.shares;
        let (sine, cosine) = (T::lit(TAU) * (T::lit(from) + s * T::lit(to - from))).sin_cos();
        let [x, y] = self.centre;
        let radius = T::lit(self.radius);
        Vector3::new(T::lit(x) + radius * cosine, T::lit(y) + radius * sine, T::zero())
    }
}

impl ScrewDislocations {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (BurgersCircuits, Outcome) {
        let mut found = BurgersCircuits::default();
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn solve(&self, found: &mut BurgersCircuits, observer: &mut Observer<'_>) -> Result<bool, UniformityError> {
        let lattice = InverseMap(self.spread);
        let centre = Vector3::new(self.centre[0], self.centre[1], 0.0);
        for radius in &self.radii {
            let circle = RoundCircuit::new(centre, Vector3::z(), *radius)?;
            let burgers = BurgersVector::of(&lattice, &circle, TOLERANCE)?;
            found.circuits.push(BurgersCircuit {
                radius: *radius,
                burgers: burgers.value.into(),
                error: burgers.error.into(),
                closed_form: self.closed_form(*radius),
            });
        }
        if observer(0.2) == ControlFlow::Break(()) || !self.develop(&lattice, found, observer)? {
            return Ok(false);
        }
        let connection = MaterialConnection::of_crystal(lattice);
        for index in 0..=PLACES {
            let distance = 1.2 * self.reach() * f64::from(index) / f64::from(PLACES);
            let place = Vector3::new(distance, 0.0, 0.0);
            let density = DislocationDensity::of(&lattice, &place)?;
            found.torsion.push(TorsionAt {
                distance,
                screw: density.screw(&Vector3::z()),
                edge: density.edge(&Vector3::z()).norm(),
                torsion: connection.torsion(&place)?.largest(),
            });
        }
        if observer(0.8) == ControlFlow::Break(()) {
            return Ok(false);
        }
        let places: Vec<Vector3<f64>> = (0..9)
            .map(|i| {
                let (sine, cosine) = (TAU * 0.11 * f64::from(i)).sin_cos();
                let radius = self.reach() * f64::from(i) / 8.0;
                centre + Vector3::new(radius * cosine, radius * sine, 0.3 * radius)
            })
            .collect();
        let flatness =
            |algebra: LieAlgebra| Flatness::of_body(&lattice, algebra, &places, self.reach(), self.tolerance);
        found.of_crystal = Some(flatness(LieAlgebra::trivial())?);
        found.of_isotropic_solid = Some(flatness(LieAlgebra::rotations())?);
        Ok(observer(1.0) == ControlFlow::Continue(()))
    }

    /// The largest circuit, arc by arc: each begins with the frame that the one before it ends with.
    fn develop(
        &self,
        lattice: &InverseMap<Screws>,
        found: &mut BurgersCircuits,
        observer: &mut Observer<'_>,
    ) -> Result<bool, UniformityError> {
        let connection = MaterialConnection::of_crystal(*lattice);
        let tolerance = Tolerance::relative(TOLERANCE)?;
        let arc = |shares: [f64; 2]| Arc { centre: self.centre, radius: self.reach(), shares };
        let start: Vector3<f64> = arc([0.0, 1.0]).place(0, 0.0);
        let first = lattice.value(&start)?;
        let (mut frame, mut developed) = (first, Vector3::zeros());
        found.in_body.push(start.into());
        found.in_crystal.push(developed.into());
        for index in 0..ARCS {
            let shares = [index, index + 1].map(|i| f64::from(i) / f64::from(ARCS));
            let carried = TransportedFrame::along(&connection, &arc(shares), &frame, tolerance)?;
            developed += carried.development;
            frame = carried.end;
            found.in_body.push(arc(shares).place(0, 1.0_f64).into());
            found.in_crystal.push(developed.into());
            if observer(0.2 + 0.5 * shares[1]) == ControlFlow::Break(()) {
                return Ok(false);
            }
        }
        // P₀⁻¹ P − 1, with P₀ = K at the start.
        let inverse = self.spread.at(&start);
        found.holonomy = (inverse * frame - Matrix3::identity()).norm();
        Ok(true)
    }
}

impl BurgersCircuits {
    /// The largest |b₃ − closed form| over the closed form.
    #[must_use]
    pub fn largest_difference(&self) -> Option<f64> {
        let difference = |circuit: &BurgersCircuit| {
            let known = circuit.closed_form?;
            Some((circuit.burgers[2] - known).abs() / known.abs().max(f64::MIN_POSITIVE))
        };
        self.circuits.iter().filter_map(difference).reduce(f64::max)
    }
}
