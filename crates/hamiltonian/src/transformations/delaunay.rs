//! Delaunay's elements of Kepler's motion.

use piola_numerics::linear::matrix3::{cross, dot};
use piola_numerics::{Gradient, Mask, Real};

use super::check_action_value;
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};
use crate::newton;
use crate::{InvertiblePhaseMap, PhaseFunction, PhaseMap};

/// (x, p) ↦ (l, g, h, L, G, H) of a body bound to a centre by H = p²/2m − m μ/r.
///
/// ```text
/// L = m √(μ a)                         l, the mean anomaly
/// G = |x × p| = L √(1 − e²)            g, the argument of the pericentre
/// H = (x × p)₃ = G cos i               h, the longitude of the node
/// the Hamiltonian is −m³ μ²/(2 L²): l grows evenly, all else stays
/// ```
///
/// | symbol | shape | unit |
/// |---|---|---|
/// | x, p | 3, 3 | m, kg m/s |
/// | l, g, h, in (−π, π] | 3 | rad |
/// | L, G, H | 3 | kg m²/s |
///
/// # Errors
/// [`HamiltonianError::NotBound`] for an energy that is not negative; [`HamiltonianError::DegenerateElements`] on circles and
/// in the plane z = 0, where an angle has no meaning; back, [`HamiltonianError::InvalidAction`] unless 0 < G ≤ L and |H| ≤ G;
/// [`HamiltonianError::WrongLength`].
///
/// # Accuracy
/// Some ulp over e and over sin i.
///
/// # Example
/// A body at the pericentre of an orbit with a = 2, e = ½ that stands upright on the x axis:
/// ```
/// use piola_hamiltonian::{Delaunay, PhaseMap};
/// let map = Delaunay::new(1.0, 1.0)?;
/// let speed = f64::sqrt(2.0 / 1.0 - 1.0 / 2.0);
/// let mut elements = [0.0; 6];
/// map.map(&[1.0, 0.0, 0.0], &[0.0, 0.0, speed], 0.0, &mut elements)?;
/// assert!(elements[..3].iter().all(|angle| angle.abs() < 1e-15));
/// assert!((elements[3] - f64::sqrt(2.0)).abs() < 1e-15 && (elements[4] - speed).abs() < 1e-15);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(10.28), W(10.30) for the Hamiltonian; C.-E. Delaunay, *Théorie du mouvement de la lune* (1860), for the elements.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct Delaunay {
    mass: f64,
    gravitational_parameter: f64,
}

/// What is read before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    mass: f64,
    gravitational_parameter: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Delaunay {
    type Error = HamiltonianError;
    fn try_from(written: Written) -> Result<Self, HamiltonianError> {
        Self::new(written.mass, written.gravitational_parameter)
    }
}

impl Delaunay {
    /// For a mass m, kg, and a gravitational parameter μ, m³/s².
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::NotPositive`].
    pub fn new(mass: f64, gravitational_parameter: f64) -> Result<Self, HamiltonianError> {
        for (quantity, value) in [("mass", mass), ("gravitational parameter", gravitational_parameter)] {
            check_finite(quantity, &[value])?;
            if value <= 0.0 {
                return Err(HamiltonianError::NotPositive { quantity, value });
            }
        }
        Ok(Self { mass, gravitational_parameter })
    }

    /// The Hamiltonian in these elements.
    #[must_use]
    pub const fn hamiltonian(self) -> KeplerOfActions {
        KeplerOfActions(self)
    }
}

/// An angle brought to (−π, π] from (−2π, 2π].
fn wrapped<T: Real>(angle: T) -> T {
    let (half, turn) = (T::lit(core::f64::consts::PI), T::lit(core::f64::consts::TAU));
    let lowered = T::select(half.less_than(angle), angle - turn, angle);
    T::select(lowered.at_most(-half), lowered + turn, lowered)
}

impl PhaseMap for Delaunay {
    fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check_length("q", 3, q.len())?;
        check_length("p", 3, p.len())?;
        check_length("the elements", 6, new.len())?;
        let (x, p) = ([q[0], q[1], q[2]], [p[0], p[1], p[2]]);
        let (mass, mu) = (T::lit(self.mass), T::lit(self.gravitational_parameter));
        let distance = dot(x, x).sqrt();
        let energy = T::lit(0.5) * dot(p, p) / mass - mass * mu / distance;
        if !energy.less_than(T::zero()).all() {
            let bound = |lane: usize| energy.primal(lane) < 0.0;
            let lane = (0..T::LANES).find(|&lane| !bound(lane)).unwrap_or(0);
            return Err(HamiltonianError::NotBound { energy: energy.primal(lane) });
        }
        let axis = -mass * mu / (energy + energy);
        let first = mass * (mu * axis).sqrt();
        let moment = cross(x, p);
        let second = dot(moment, moment).sqrt();
        // e cos E and e sin E, without e.
        let (cosine, sine) = (T::one() - distance / axis, dot(x, p) / first);
        let square = cosine * cosine + sine * sine;
        let eccentric = sine.atan2(cosine);
        // The node, and the direction at right angles to it in the plane of the motion.
        let node = [-moment[1], moment[0], T::zero()];
        let square_node = node[0] * node[0] + node[1] * node[1];
        if square.at_most(T::zero()).any() || square_node.at_most(T::zero()).any() {
            let worst = |value: T| (0..T::LANES).map(|lane| value.primal(lane)).fold(f64::INFINITY, f64::min);
            return Err(HamiltonianError::DegenerateElements {
                eccentricity: worst(square).sqrt(),
                sine_of_inclination: (worst(square_node) / worst(second * second)).sqrt(),
            });
        }
        let latitude = (dot(cross(moment, node), x) / second).atan2(dot(node, x));
        let anomaly = (second / first * sine).atan2(cosine - square);
        new[0] = eccentric - sine;
        new[1] = wrapped(latitude - anomaly);
        new[2] = node[1].atan2(node[0]);
        new[3] = first;
        new[4] = second;
        new[5] = moment[2];
        Ok(())
    }
}

impl InvertiblePhaseMap for Delaunay {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], _t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        check_length("the angles", 3, new_q.len())?;
        check_length("the actions", 3, new_p.len())?;
        check_length("(q, p)", 6, old.len())?;
        let [mean, pericentre, longitude] = [new_q[0], new_q[1], new_q[2]];
        let [first, second, third] = [new_p[0], new_p[1], new_p[2]];
        // 0 < G < L and |H| < G, lane by lane.
        for lane in 0..T::LANES {
            let (l, g) = (first.primal(lane), second.primal(lane));
            check_action_value(0, l, (f64::MIN_POSITIVE, f64::INFINITY))?;
            check_action_value(1, g, (f64::MIN_POSITIVE, l))?;
            check_action_value(2, third.primal(lane), (-g, g))?;
        }
        let minor = second / first;
        let eccentricity = ((first - second) * (first + second)).sqrt() / first;
        let (s, c) = mean.sin_cos();
        let reduced = s.atan2(c);
        // From here the iteration converges for every e < 1.
        let mut eccentric = [reduced + T::lit(0.85) * eccentricity * T::one().copysign(s)];
        newton::solve("Kepler's equation", &mut eccentric, |x, residual| {
            residual[0] = x[0] - Gradient::constant(eccentricity) * x[0].sin() - Gradient::constant(reduced);
            Ok(())
        })?;
        let (sine, cosine) = eccentric[0].sin_cos();
        let (mass, mu) = (T::lit(self.mass), T::lit(self.gravitational_parameter));
        let axis = first * first / (mass * mass * mu);
        let rate = first / (axis * (T::one() - eccentricity * cosine));
        let plane = [[axis * (cosine - eccentricity), axis * minor * sine], [-rate * sine, rate * minor * cosine]];
        let cosine_i = third / second;
        let sine_i = ((second - third) * (second + third)).sqrt() / second;
        let ((sg, cg), (sh, ch)) = (pericentre.sin_cos(), longitude.sin_cos());
        for ([x, y], out) in plane.into_iter().zip(old.chunks_exact_mut(3)) {
            let (along, across) = (cg * x - sg * y, sg * x + cg * y);
            out[0] = ch * along - sh * cosine_i * across;
            out[1] = sh * along + ch * cosine_i * across;
            out[2] = sine_i * across;
        }
        Ok(())
    }
}

/// Kepler's Hamiltonian in Delaunay's elements, −m³μ²/(2 L²).
///
/// # Example
/// ```
/// use piola_hamiltonian::{Delaunay, PhaseFunction};
/// let hamiltonian = Delaunay::new(1.0, 1.0)?.hamiltonian();
/// assert_eq!(hamiltonian.value(&[0.0; 3], &[2.0, 1.0, 0.5], 0.0), -0.125);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeplerOfActions(Delaunay);

impl PhaseFunction for KeplerOfActions {
    fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
        let (mass, mu) = (self.0.mass, self.0.gravitational_parameter);
        T::lit(-0.5 * mass * mass * mass * mu * mu) / (p[0] * p[0])
    }
}
