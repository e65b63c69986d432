//! Finds the arcs and what there is to know of each.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use piola_dynamics::DynamicsError;
use piola_dynamics::hamilton_jacobi::{Event, Extremal, GeodeticDistance, KeplerPolar, SeparableMotion};
use piola_dynamics::hamiltonian::{Delaunay, HamiltonianField, PhaseMap};
use piola_integrators::{DormandPrince853, State, Tolerance};
use serde_json::{Value, json};

use super::{Kepler, KeplerArcs, lambert};
use crate::run::Outcome;
use crate::studies::run::Observer;

/// Parts of an arc between the points that are kept of it.
const PARTS: u32 = 400;

/// An arc: one sheet of the geodetic distance.
#[derive(Debug, Clone)]
pub struct Arc {
    /// G, J s.
    pub distance: f64,
    /// The same from the elements of the ellipse, J s; none of an arc that is not bound.
    pub closed_form: Option<f64>,
    /// p₀ = −∂G/∂q₀, kg m/s.
    pub initial_momentum: Vector3<f64>,
    /// p₁ = ∂G/∂q₁, kg m/s.
    pub final_momentum: Vector3<f64>,
    /// H₀ = ∂G/∂t₀, J.
    pub initial_energy: f64,
    /// H₁ = −∂G/∂t₁, J.
    pub final_energy: f64,
    /// Full revolutions.
    pub revolutions: u32,
    /// Whether it goes the short way round, in the sense from the first place to the second.
    pub direct: bool,
    /// Times after the first event of the points conjugate to it in the plane of the arcs, s, and the places.
    pub conjugate: Vec<(f64, [f64; 2])>,
    /// The Morse index of variations in the plane of the arcs. In space it is greater by one for each half turn.
    pub index_in_the_plane: usize,
    /// Delaunay's L, G and H, kg m²/s; none where they have no meaning.
    pub delaunay: Option<[f64; 3]>,
    /// `∮ p_r dr/2π` by quadrature, kg m²/s: L − G.
    pub radial_action: Option<f64>,
    /// |q(t₁) − q₁|, m.
    pub miss: f64,
    /// How far the second event is from being conjugate to the first, relative.
    pub distance_from_conjugate: f64,
    /// Points in the plane of the arcs, m: the first axis points to the first event.
    pub points: Vec<[f64; 2]>,
}

/// What was found.
#[derive(Debug, Clone, Default)]
pub struct Arcs {
    /// The arcs in the order of the distance.
    pub arcs: Vec<Arc>,
    /// How many there are by Lambert's theorem.
    pub expected: usize,
    /// The places of the events in the plane, m.
    pub ends: [[f64; 2]; 2],
}

impl KeplerArcs {
    pub(in crate::studies) fn run(&self, observer: &mut Observer<'_>) -> (Arcs, Outcome) {
        let [first, second] = self.plane();
        let flat = |place: &Vector3<f64>| [first.dot(place), second.dot(place)];
        let mut found =
            Arcs { arcs: Vec::new(), expected: self.seeds().len(), ends: [flat(&self.from), flat(&self.to)] };
        let outcome = match self.find(&mut found, observer) {
            Ok(true) => Outcome::Completed,
            Ok(false) => Outcome::Interrupted,
            Err(error) => Outcome::Failed(error.to_string()),
        };
        (found, outcome)
    }

    /// The arcs of Lambert's theorem, in units of length and time.
    fn seeds(&self) -> Vec<lambert::Seed> {
        let (length, unit) = self.units();
        let chord = (self.to - self.from).norm() / length;
        lambert::arcs(1.0, self.to.norm() / length, chord, self.duration / unit)
    }

    fn find(&self, found: &mut Arcs, observer: &mut Observer<'_>) -> Result<bool, DynamicsError> {
        let (length, unit) = self.units();
        let [from, to] = found.ends.map(|end| end.map(|x| x / length));
        let (from, to) = (Event::new(&from, 0.0), Event::new(&to, self.duration / unit));
        let distance = GeodeticDistance::new(&Kepler);
        let seeds = self.seeds();
        let count = seeds.len() as f64;
        for (number, seed) in (1_u32..).zip(&seeds) {
            let transverse = if seed.direct { seed.transverse } else { -seed.transverse };
            let sheet = distance.between(&from, &to, &[seed.radial, transverse])?;
            found.arcs.push(self.arc(&from, &to, &sheet)?);
            if observer(f64::from(number) / count).is_break() {
                return Ok(false);
            }
        }
        found.arcs.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Ok(true)
    }

    fn arc(&self, from: &Event, to: &Event, sheet: &Extremal) -> Result<Arc, DynamicsError> {
        let (length, unit) = self.units();
        let action = self.mass * length * length / unit;
        let energy = action / unit;
        let [first, second] = self.plane();
        let lifted = |v: &[f64]| (first * v[0] + second * v[1]) * (self.mass * length / unit);
        let [x, y] = [from.coordinates[0], from.coordinates[1]];
        let [u, v] = [sheet.initial_momenta[0], sheet.initial_momenta[1]];
        let moment = x * v - y * u;
        let bound = sheet.initial_energy < 0.0;
        let elements = |q: &[f64], p: &[f64]| (q[0] * p[0] + q[1] * p[1], -0.5 / sheet.initial_energy);
        // ∫ L dt = E t + 2√(μa) ΔE, by ΔE = n t + (q·p)|₀¹/√(μa)
        let (along, axis) = elements(&from.coordinates, &sheet.initial_momenta);
        let (along_end, _) = elements(&to.coordinates, &sheet.final_momenta);
        let swept = to.time / axis.powf(1.5) + (along_end - along) / axis.sqrt();
        let closed = sheet.initial_energy * to.time + 2.0 * axis.sqrt() * swept;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of turns")]
        let revolutions = if bound { (swept / TAU).max(0.0) as u32 } else { 0 };
        let times: Vec<f64> = sheet.conjugate_points.iter().map(|point| point.time).collect();
        let (points, conjugate) = trace(from, to, &sheet.initial_momenta, &times)?;
        let start = (first * x + second * y) * length;
        let momentum = lifted(&sheet.initial_momenta);
        Ok(Arc {
            distance: sheet.distance * action,
            closed_form: bound.then_some(closed * action),
            initial_momentum: momentum,
            final_momentum: lifted(&sheet.final_momenta),
            initial_energy: sheet.initial_energy * energy,
            final_energy: sheet.final_energy * energy,
            revolutions,
            direct: 0.0 < moment,
            conjugate: times
                .iter()
                .map(|time| time * unit)
                .zip(conjugate.into_iter().map(|q| q.map(|x| x * length)))
                .collect(),
            index_in_the_plane: sheet.morse_index(),
            delaunay: self.delaunay(&start, &momentum),
            radial_action: radial_action(x.hypot(y), (x * u + y * v) / x.hypot(y), moment)?.map(|j| j * action),
            miss: sheet.miss * length,
            distance_from_conjugate: sheet.distance_from_conjugate,
            points: points.into_iter().map(|q| q.map(|x| x * length)).collect(),
        })
    }

    /// L, G and H; none of an arc that is not bound or a plane z = 0, where the elements degenerate.
    fn delaunay(&self, place: &Vector3<f64>, momentum: &Vector3<f64>) -> Option<[f64; 3]> {
        let map = Delaunay::new(self.mass, self.gm).ok()?;
        let mut elements = [0.0; 6];
        map.map(place.as_slice(), momentum.as_slice(), 0.0, &mut elements).ok()?;
        Some([elements[3], elements[4], elements[5]])
    }
}

/// The radial action from the separated integral; none without two turning points.
fn radial_action(distance: f64, radial: f64, moment: f64) -> Result<Option<f64>, DynamicsError> {
    let kepler = KeplerPolar { mass: 1.0, strength: 1.0 };
    let motion = SeparableMotion::through(&kepler, (&[distance, 0.0], &[radial, moment], 0.0))?;
    Ok(motion.loop_integral(0)?.map(|loops| loops / TAU))
}

/// Places along an arc, evenly spread in time, and at some times.
type Traced = (Vec<[f64; 2]>, Vec<[f64; 2]>);

fn trace(from: &Event, to: &Event, momenta: &[f64], times: &[f64]) -> Result<Traced, DynamicsError> {
    let refused = |source| DynamicsError::Run { time: from.time, source: Box::new(source) };
    let tolerance = Tolerance::relative(1e-12).map_err(|error| refused(error.with_field_error()))?;
    let mut places = Vec::with_capacity(PARTS as usize + 1);
    let mut field = HamiltonianField::new(&Kepler, 2);
    let mut method = DormandPrince853::new(tolerance);
    let start = || State::new(from.time, [&from.coordinates[..], momenta].concat());
    let mut state = start().map_err(|error| refused(error.with_field_error()))?;
    places.push([state.values[0], state.values[1]]);
    let instants = (1..=PARTS).map(|i| from.time + (to.time - from.time) * f64::from(i) / f64::from(PARTS));
    for time in instants {
        method.integrate_to(&mut field, &mut state, time).map_err(refused)?;
        places.push([state.values[0], state.values[1]]);
    }
    let mut state = start().map_err(|error| refused(error.with_field_error()))?;
    let mut conjugate = Vec::with_capacity(times.len());
    for &time in times {
        method.integrate_to(&mut field, &mut state, time).map_err(refused)?;
        conjugate.push([state.values[0], state.values[1]]);
    }
    Ok((places, conjugate))
}

impl Arcs {
    pub(in crate::studies) fn results(&self) -> Value {
        let worst = |pick: &dyn Fn(&Arc) -> Option<f64>| {
            self.arcs.iter().filter_map(pick).fold(None, |worst: Option<f64>, x| Some(worst.unwrap_or(0.0).max(x)))
        };
        let sheets: Vec<Value> = self
            .arcs
            .iter()
            .map(|arc| {
                json!({
                    "distance_J_s": arc.distance,
                    "initial_momentum_kg_m_per_s": arc.initial_momentum.as_slice(),
                    "final_momentum_kg_m_per_s": arc.final_momentum.as_slice(),
                    "initial_energy_J": arc.initial_energy,
                    "final_energy_J": arc.final_energy,
                    "revolutions": arc.revolutions,
                    "direct": arc.direct,
                    "conjugate_points_s": arc.conjugate.iter().map(|point| point.0).collect::<Vec<_>>(),
                    "index_in_the_plane": arc.index_in_the_plane,
                    "delaunay_actions_kg_m2_per_s": arc.delaunay,
                    "radial_action_kg_m2_per_s": arc.radial_action,
                    "distance_from_conjugate": arc.distance_from_conjugate,
                })
            })
            .collect();
        json!({
            "arcs": self.arcs.len(),
            "arcs_by_lambert": self.expected,
            "least_distance_J_s": self.arcs.first().map(|arc| arc.distance),
            "largest_miss_m": worst(&|arc| Some(arc.miss)),
            "largest_relative_difference_from_closed_form":
                worst(&|arc| Some((arc.distance / arc.closed_form? - 1.0).abs())),
            "largest_relative_change_of_energy":
                worst(&|arc| Some((arc.final_energy / arc.initial_energy - 1.0).abs())),
            "largest_relative_difference_of_radial_action": worst(&|arc| {
                let [l, g, _] = arc.delaunay?;
                Some((arc.radial_action? - (l - g)).abs() / l)
            }),
            "sheets": sheets,
        })
    }
}
