//! Solves the eikonal equation and looks at its solution.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use piola_characteristics::CharacteristicsError;
use piola_characteristics::{CauchyProblem, CharacteristicSolution, Grid, Overlap, ParameterInterval, Refinement};
use piola_numerics::Dual;

use super::{Outline, Room, Speed};
use crate::observer::outcome;
use crate::{Observer, Outcome, PlaneSamples};

/// Where the parameter of a closed curve begins: away from the ends of the axes, where caustics have their tips.
const SEAM: f64 = 0.3;
/// Parts of the curve to begin with.
const PARTS: usize = 96;
/// Times at which characteristics are kept, at least.
const LEVELS: usize = 32;
/// Characteristics that are drawn.
const DRAWN: usize = 120;
/// Points of the grid at which the characteristic through them is computed and compared.
const CHECKED: usize = 40;

/// Where characteristics first cross.
///
/// # Example
/// See [`Room`](super::Room).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LossOfInvertibility {
    /// The time, s.
    pub time: f64,
    /// The place, m.
    pub place: [f64; 2],
    /// The angle of its characteristic on the curve where the signal starts, rad.
    pub angle: f64,
}

/// The arrivals in a room.
///
/// # Example
/// See [`Room`](super::Room).
#[derive(Debug, Clone, Default)]
pub struct Arrivals {
    /// Points of the grid and their times, s; none outside of the room.
    pub arrival: Vec<([f64; 2], Option<f64>)>,
    /// Points of the grid along x.
    pub across: usize,
    /// The same points, with what characteristics bring to places outside when they start on a circle.
    pub field: Option<PlaneSamples>,
    /// Characteristics until they are no longer the first.
    pub characteristics: Vec<Vec<[f64; 2]>>,
    /// Caustics, piece by piece.
    pub caustic: Vec<Vec<[f64; 2]>>,
    /// The first loss of invertibility.
    pub first_loss: Option<LossOfInvertibility>,
    /// The first loss in closed form, s, where there is one.
    pub closed_form_of_first_loss: Option<f64>,
    /// Number of characteristics.
    pub rays: usize,
    /// Points of the grid in the room that no characteristic reaches.
    pub uncovered: usize,
    /// The largest |v²ξ·ξ − 1|/2 on characteristics.
    pub drift: f64,
    /// The largest residual on the grid, away from caustics.
    pub residual: f64,
    /// The largest difference of the grid from characteristics through some of its points, s.
    pub difference: f64,
}

type Solution<'a> = CharacteristicSolution<'a, Speed, Outline>;

impl Room {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (Arrivals, Outcome) {
        let mut found = Arrivals { closed_form_of_first_loss: self.closed_form_of_first_loss(), ..Arrivals::default() };
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn grid(&self) -> Grid {
        let [a, b] = self.outline.semi_axes;
        let spacing = 2.0 * a.max(b) / f64::from(self.grid - 1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 400")]
        let points = [a, b].map(|axis| (2.0 * axis / spacing).round() as usize + 3);
        // Symmetric about the centre, and one point beyond the wall.
        let origin = core::array::from_fn(|k| -0.5 * spacing * (points[k] - 1) as f64);
        Grid { origin, spacing: [spacing; 2], points }
    }

    /// The sides along the outward normal, each with the longest time that a first arrival can take there, s.
    ///
    /// ```text
    /// from the wall, along ∇v:         t ≤ ln(v_max/v_min)/|∇v|  and  t ≤ l/v_min
    /// from a circle, straight:         t ≤ l ln(v_c/v_min)/(v_c − v_min),    v_c the least speed on it
    /// ```
    fn sides(&self) -> Vec<(f64, f64)> {
        let [a, b] = self.outline.semi_axes;
        let [g, h] = self.speed.gradient;
        let (slow, change) = (self.least_speed(), g.abs() * a + h.abs() * b);
        match self.circle {
            None => {
                // The logarithm of a ratio near one, exactly: the speed may be the same everywhere.
                let along = (2.0 * change / slow).ln_1p() / g.hypot(h);
                vec![(-1.0, (a.min(b) / slow).min(if along.is_finite() { along } else { f64::INFINITY }))]
            }
            Some(circle) => {
                let ([x, y], radius) = (circle.centre, circle.semi_axes[0]);
                let start = self.speed.at([x, y]) - g.hypot(h) * radius;
                let more = start - slow;
                let mean = if 0.0 < more { more / (more / slow).ln_1p() } else { slow };
                vec![(1.0, (x.hypot(y) + a.hypot(b)) / mean), (-1.0, radius / start)]
            }
        }
    }

    fn solve(&self, found: &mut Arrivals, observer: &mut Observer<'_>) -> Result<bool, CharacteristicsError> {
        let start = self.circle.unwrap_or(self.outline);
        let [a, b] = self.outline.semi_axes;
        let sides = self.sides();
        let grid = self.grid();
        let mut values = vec![f64::NAN; grid.points[0] * grid.points[1]];
        let mut progress = Progress { done: 0.0, whole: 4.0 * sides.len() as f64, observer };
        for (side, longest) in sides {
            let guess = self.covector(&start, side);
            let problem = CauchyProblem::new(&self.speed, &start, 2)?.near(&guess)?;
            let interval = ParameterInterval { from: SEAM, to: SEAM + TAU, parts: PARTS };
            let refinement = Refinement { levels: LEVELS, ..Refinement::to(self.resolution) };
            let span = (0.0, 1.02 * longest);
            let watched = problem.solve_observed(&[interval], span, refinement, &mut |rays| progress.between(rays));
            let solution = match watched {
                Err(CharacteristicsError::Stopped { .. }) => return Ok(false),
                solved => solved?,
            };
            found.rays += solution.rays().len();
            found.drift = found.drift.max(solution.drift());
            if progress.stopped() {
                return Ok(false);
            }
            let loss = solution.first_loss_of_invertibility()?.map(|loss| LossOfInvertibility {
                time: loss.point.s,
                place: [loss.point.x[0], loss.point.x[1]],
                angle: loss.point.parameters[0],
            });
            if let Some(loss) = loss.filter(|loss| found.first_loss.is_none_or(|first| loss.time < first.time)) {
                found.first_loss = Some(loss);
            }
            found.caustic.append(&mut caustic(&solution));
            if progress.stopped() {
                return Ok(false);
            }
            let sheet = solution.onto_grid(grid, Overlap::FirstArrival)?;
            found.residual = found.residual.max(sheet.largest_residual(0.05 * a.min(b) * self.speed.at_origin));
            for (value, sheet) in values.iter_mut().zip(&sheet.values) {
                if let Some(sheet) = sheet
                    && (value.is_nan() || sheet.u < *value)
                {
                    *value = sheet.u;
                }
            }
            // At the tip of a caustic no cell of the interpolation may hold a point: then its characteristic is sought.
            for (index, value) in values.iter_mut().enumerate().filter(|(_, value)| value.is_nan()) {
                let place = grid.point(index % grid.points[0], index / grid.points[0]);
                if self.outline.level(place) < 1.0
                    && 0.0 < side * (start.level(place) - 1.0)
                    && let Ok(sheet) = solution.first_arrival(&place)
                {
                    *value = sheet.point.u;
                }
            }
            found.fill(self, grid, &values);
            if progress.stopped() {
                return Ok(false);
            }
            found.compare(&solution, side, self);
            found.follow(&solution, 1.5 * grid.spacing[0] / self.least_speed());
            if progress.stopped() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// ξ where the parameter begins.
    fn covector(&self, start: &Outline, side: f64) -> [f64; 2] {
        let [x, y] = start.place(Dual::variable(SEAM));
        let size = side / x.tangent.hypot(y.tangent) / self.speed.at([x.value, y.value]);
        [y.tangent * size, -x.tangent * size]
    }
}

struct Progress<'p, 'o> {
    done: f64,
    whole: f64,
    observer: &'p mut Observer<'o>,
}

impl Progress<'_, '_> {
    /// Within a part of unknown length: the more characteristics, the nearer to its end.
    fn between(&mut self, rays: usize) -> ControlFlow<()> {
        /// Characteristics after which half of the part is thought to be done.
        const HALF: f64 = 1000.0;
        let part = rays as f64 / (rays as f64 + HALF);
        (self.observer)((self.done + part) / self.whole)
    }

    fn stopped(&mut self) -> bool {
        self.done += 1.0;
        (self.observer)(self.done / self.whole).is_break()
    }
}

/// The caustic as curves over neighbouring characteristics.
fn caustic(solution: &Solution<'_>) -> Vec<Vec<[f64; 2]>> {
    let mut rays: Vec<_> = solution.rays().iter().collect();
    rays.sort_by(|a, b| a.parameters[0].total_cmp(&b.parameters[0]));
    let first = |ray: &&piola_characteristics::Ray| ray.caustic.first().map(|point| [point.x[0], point.x[1]]);
    let together =
        |a: &&piola_characteristics::Ray, b: &&piola_characteristics::Ray| first(a).is_some() == first(b).is_some();
    let pieces = rays.chunk_by(together).map(|piece| piece.iter().filter_map(first).collect::<Vec<_>>());
    pieces.filter(|piece| !piece.is_empty()).collect()
}

impl Arrivals {
    /// Takes over the times of the grid.
    fn fill(&mut self, room: &Room, grid: Grid, values: &[f64]) {
        let [across, up] = grid.points;
        let places = (0..across * up).map(|k| grid.point(k % across, k / across));
        self.across = across;
        self.arrival = places
            .zip(values)
            .map(|(place, time)| (place, (room.outline.level(place) < 1.0 && time.is_finite()).then_some(*time)))
            .collect();
        self.uncovered = self.arrival.iter().filter(|(x, time)| room.outline.level(*x) < 1.0 && time.is_none()).count();
        // Behind the wall from which it starts the signal is a continuation below zero.
        let shown = self.arrival.iter().zip(values).map(|((place, time), value)| match time {
            None if room.circle.is_none() && 1.0 <= room.outline.level(*place) => 0.0,
            _ => *value,
        });
        self.field = Some(PlaneSamples {
            origin: grid.origin,
            spacing: grid.spacing,
            points: grid.points,
            values: shown.collect(),
        });
    }

    /// Compares some points with the characteristics through them.
    fn compare(&mut self, solution: &Solution<'_>, side: f64, room: &Room) {
        let start = room.circle.unwrap_or(room.outline);
        let known: Vec<_> = self
            .arrival
            .iter()
            .filter(|(place, time)| time.is_some() && 0.0 < side * (start.level(*place) - 1.0))
            .collect();
        for (place, time) in known.iter().step_by((known.len() / CHECKED).max(1)) {
            // Where all characteristics meet none of them can be followed to the point: it is passed over.
            let Ok(sheet) = solution.first_arrival(place) else { continue };
            self.difference = self.difference.max((sheet.point.u - time.unwrap_or(sheet.point.u)).abs());
        }
    }

    /// Characteristics until another one has been there before.
    fn follow(&mut self, solution: &Solution<'_>, late: f64) {
        let mut rays: Vec<usize> = (0..solution.rays().len()).collect();
        rays.sort_by(|a, b| solution.rays()[*a].parameters[0].total_cmp(&solution.rays()[*b].parameters[0]));
        let mut wanted = SEAM;
        for ray in rays {
            if solution.rays()[ray].parameters[0] < wanted {
                continue;
            }
            wanted += TAU / DRAWN as f64;
            let mut curve = Vec::new();
            for (level, time) in solution.levels().iter().enumerate() {
                let Some((x, ..)) = solution.strip(ray, level) else { break };
                let place = [x[0], x[1]];
                let before = self.field.as_ref().and_then(|field| field.at(place));
                if 0.0 < *time && before.is_none_or(|before| before + late < *time) {
                    break;
                }
                curve.push(place);
            }
            self.characteristics.push(curve);
        }
    }
}
