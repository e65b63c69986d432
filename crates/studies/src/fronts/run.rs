//! Follows the rays and reads their fronts.

use std::collections::BTreeMap;

use piola_hamiltonian::HamiltonianError;
use piola_hamiltonian::hamilton_jacobi::{FrontRay, WaveFront};

use super::{Medium, MediumPart, Source, Wavefront};
use crate::observer::outcome;
use crate::{Observer, Outcome};

/// Parts of the length between which caustics are looked for and rays are drawn, at least.
const PARTS: u32 = 240;
/// Steps of the integration in each part.
const STEPS: u32 = 4;
/// The same where the gradient of the index jumps: the step that crosses the jump is of order one.
const STEPS_OVER_RIMS: u32 = 16;
/// Rays that are kept as curves, about.
const DRAWN: usize = 48;
/// Rays are not added beyond this many.
pub const MOST_RAYS: usize = 40_000;

/// A front: the places of one optical length.
///
/// # Example
/// See [`Wavefront`].
#[derive(Debug, Clone)]
pub struct Front {
    /// The optical length, m.
    pub length: f64,
    /// Its connected pieces; the first point of a closed front is also its last.
    pub pieces: Vec<Vec<[f64; 2]>>,
    /// Number of its rays that have touched a caustic, kept or not.
    pub beyond_caustic: usize,
}

/// A place where a ray touches a caustic.
///
/// # Example
/// See [`Wavefront`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CausticMark {
    /// The ray: its parameter at the source.
    pub parameter: f64,
    /// How many caustics it has touched, this one included.
    pub order: u32,
    /// The optical length there, m.
    pub length: f64,
    /// The place, m.
    pub place: [f64; 2],
}

/// The fronts, rays and caustic of a medium.
///
/// # Example
/// See [`Wavefront`].
#[derive(Debug, Clone, Default)]
pub struct Fronts {
    /// The fronts, the source not among them.
    pub fronts: Vec<Front>,
    /// Some of the rays.
    pub rays: Vec<Vec<[f64; 2]>>,
    /// Places on caustics.
    pub caustic: Vec<CausticMark>,
    /// Number of rays at the end.
    pub count: usize,
    /// The largest distance of neighbours on a front, m.
    pub widest: f64,
    /// Number of fronts on which it is larger than was asked, for want of rays.
    pub too_wide: usize,
    /// The largest relative error of a step.
    pub error: f64,
    /// The largest change of |p|/n on a ray: what is left of H = 1.
    pub residual: f64,
}

impl Wavefront {
    /// Parts between two fronts.
    fn parts(&self) -> u32 {
        PARTS.div_ceil(self.fronts.max(1))
    }

    fn steps_of_part(&self) -> u32 {
        let rim = |part: &MediumPart| matches!(part, MediumPart::Luneburg { .. });
        if self.medium.parts.iter().any(rim) { STEPS_OVER_RIMS } else { STEPS }
    }

    /// Steps of the integration along each ray.
    #[must_use]
    pub fn steps(&self) -> u32 {
        self.steps_of_part() * self.parts() * self.fronts
    }

    /// The fronts of the source. The observer gets the finished part of the run, from 0 to 1, and may stop the run.
    ///
    /// A run that fails or is stopped returns the fronts that it found until then. It fails where the data of the source or of the
    /// medium are not valid, or give an index that is not a positive number.
    pub fn run(&self, observer: &mut Observer<'_>) -> (Fronts, Outcome) {
        let mut found = Fronts::default();
        let result = self.follow(&mut found, observer);
        (found, outcome(result))
    }

    fn follow(&self, found: &mut Fronts, observer: &mut Observer<'_>) -> Result<bool, HamiltonianError> {
        let start = if self.source.closed() { WaveFront::closed } else { WaveFront::open };
        let mut front = start(&self.medium, &self.source, 1.0, 1.0, self.source.range(), self.rays as usize)?;
        let every = (self.rays as usize / DRAWN).max(1);
        let mut curves = BTreeMap::new();
        for (number, ray) in front.rays().iter().step_by(every).enumerate() {
            curves.insert(ray.parameters()[0].to_bits(), number);
            found.rays.push(vec![ray.coordinates()]);
        }
        let parts = self.parts();
        let total = f64::from(self.fronts * parts);
        for number in 1..=self.fronts {
            for part in 0..parts {
                let before = front.rays().to_vec();
                let (from, step) = (front.level(), self.length / total);
                let report = front.advance(step, self.steps_of_part() as usize)?;
                found.error = found.error.max(report.error);
                for (before, after) in before.iter().zip(front.rays()) {
                    if before.caustics() < after.caustics() {
                        found.caustic.push(caustic(before, after, (from, step)));
                    }
                    if let Some(&curve) = curves.get(&after.parameters()[0].to_bits()) {
                        found.rays[curve].push(after.coordinates());
                    }
                }
                if observer(f64::from((number - 1) * parts + part + 1) / total).is_break() {
                    return Ok(false);
                }
            }
            let widest = refine(&mut front, self.source.closed(), self.spacing, MOST_RAYS)?;
            found.widest = found.widest.max(widest);
            found.too_wide += usize::from(self.spacing < widest);
            found.count = front.rays().len();
            found.fronts.push(self.front(&front));
            for ray in front.rays() {
                let [p, q] = [ray.momenta(), ray.coordinates()];
                found.residual = found.residual.max((p[0].hypot(p[1]) / self.medium.index(q) - 1.0).abs());
            }
        }
        Ok(true)
    }

    fn front(&self, front: &WaveFront<'_, Medium, Source, 2, 1>) -> Front {
        let pieces = if self.first_only {
            front.first_arrival().into_iter().map(|piece| piece.points).collect()
        } else {
            let mut points: Vec<[f64; 2]> = front.rays().iter().map(FrontRay::coordinates).collect();
            if self.source.closed() {
                points.extend(points.first().copied());
            }
            vec![points]
        };
        let beyond_caustic = front.rays().iter().filter(|ray| 0 < ray.caustics()).count();
        Front { length: front.level(), pieces, beyond_caustic }
    }
}

/// Distances of neighbours on a front.
fn distances(front: &WaveFront<'_, Medium, Source, 2, 1>, closed: bool) -> impl Iterator<Item = f64> {
    let rays = front.rays();
    let last = if closed { rays.first() } else { None };
    rays.iter().zip(rays.iter().skip(1).chain(last)).map(|(a, b)| {
        let ([x, y], [u, v]) = (a.coordinates(), b.coordinates());
        (u - x).hypot(v - y)
    })
}

/// Adds rays until no neighbours are farther apart than `spacing` or there would be more than `most`; how far they then are.
///
/// It goes by parts of the largest distance, in each of which an interval is halved once unless its halves are very unlike.
fn refine(
    front: &mut WaveFront<'_, Medium, Source, 2, 1>,
    closed: bool,
    spacing: f64,
    most: usize,
) -> Result<f64, HamiltonianError> {
    let mut widest = distances(front, closed).fold(0.0, f64::max);
    while spacing < widest {
        let goal = spacing.max(0.75 * widest);
        let more = distances(front, closed).filter(|distance| goal < *distance).count();
        if most < front.rays().len() + more {
            break;
        }
        front.refine(goal)?;
        widest = distances(front, closed).fold(0.0, f64::max);
        if goal < widest {
            break;
        }
    }
    Ok(widest)
}

/// The zero of the Jacobian between two places of a ray; its place by the cubic through both with their directions.
fn caustic(before: &FrontRay<2, 1>, after: &FrontRay<2, 1>, (from, step): (f64, f64)) -> CausticMark {
    let (a, b) = (before.jacobian(), after.jacobian());
    let share = if a * b < 0.0 { a / (a - b) } else { 0.5 };
    // dq/dS = p/|p|² where |p| = n.
    let rate = |ray: &FrontRay<2, 1>| {
        let [x, y] = ray.momenta();
        [x, y].map(|p| step * p / (x * x + y * y))
    };
    let (q, v, r, w) = (before.coordinates(), rate(before), after.coordinates(), rate(after));
    let rest = 1.0 - share;
    let place = core::array::from_fn(|k| {
        rest * rest * ((1.0 + 2.0 * share) * q[k] + share * v[k])
            + share * share * ((3.0 - 2.0 * share) * r[k] - rest * w[k])
    });
    CausticMark { parameter: after.parameters()[0], order: after.caustics(), length: from + share * step, place }
}

impl Fronts {
    /// The place of a caustic that is reached first.
    #[must_use]
    pub fn first_caustic(&self) -> Option<&CausticMark> {
        self.caustic.iter().min_by(|a, b| a.length.total_cmp(&b.length))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Medium, MediumPart, Source};
    use super::{WaveFront, refine};
    use piola_testkit::{Tol, assert_close};

    #[test]
    fn rays_are_added_up_to_the_spacing_or_to_their_greatest_number() {
        let medium = Medium { parts: vec![MediumPart::Uniform { index: 1.0 }] };
        let source = Source::Point { place: [0.0; 2], from: 0.0, to: 1.0 };
        let chord = |parts: f64| 2.0 * (0.5 / parts).sin();
        // Three rays of an arc of one radian are halved to 5, 9, 17, 33, 65, 129.
        for (most, count) in [(100, 65), (1000, 129), (128, 65), (129, 129)] {
            let Ok(mut front) = WaveFront::open(&medium, &source, 1.0, 1.0, source.range(), 3) else { panic!() };
            let Ok(_) = front.advance(1.0, 8) else { panic!() };
            let Ok(widest) = refine(&mut front, false, 0.01, most) else { panic!() };
            assert_eq!(front.rays().len(), count);
            assert_close("chord", &[widest], &[chord(count as f64 - 1.0)], Tol::stated(1e-10, "rounding of the rays"));
        }
    }
}
