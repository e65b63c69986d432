//! Jacobi's coordinates: each body from the mass centre of all before it.

use piola_numerics::Lanes;

use crate::attraction::{Block, LANES};

type Numbers = Lanes<f64, LANES>;

/// As many planets as there are lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// x′, m, and what rounding left of it.
    pub(super) position: Block,
    pub(super) position_carry: Block,
    /// v′, m/s, and what rounding left of it.
    pub(super) velocity: Block,
    pub(super) velocity_carry: Block,
}

/// What does not change in a run.
#[derive(Clone, Debug)]
pub(super) struct Masses {
    /// Gm of the central body.
    pub(super) centre: f64,
    /// Gm of the planets.
    pub(super) planets: Vec<f64>,
    /// Gm of all bodies up to the one before each planet, and one more: of all bodies.
    pub(super) before: Vec<f64>,
    /// What draws each planet in its Kepler's motion: Gm of all bodies up to itself; none where there is no planet.
    pub(super) drawing: Vec<Numbers>,
    /// The same, and Gm of the central body, but none for the first planet, whose attraction Kepler's motion has whole.
    pub(super) drawing_but_first: Vec<Numbers>,
    pub(super) centre_but_first: Vec<Numbers>,
}

impl Masses {
    pub(super) fn new(parameters: &[f64]) -> Self {
        let (centre, planets) = parameters.split_first().map_or((0.0, &[][..]), |(first, rest)| (*first, rest));
        let mut before = vec![centre];
        for planet in planets {
            before.push(before[before.len() - 1] + planet);
        }
        let drawing: Vec<_> = before[1..].chunks(LANES).map(|chunk| Lanes::load(chunk, 0.0)).collect();
        let centres = vec![centre; planets.len()];
        let mut centre_but_first: Vec<_> = centres.chunks(LANES).map(|chunk| Lanes::load(chunk, 0.0)).collect();
        let mut drawing_but_first = drawing.clone();
        if let (Some(drawing), Some(centre)) = (drawing_but_first.first_mut(), centre_but_first.first_mut()) {
            (drawing.0[0], centre.0[0]) = (0.0, 0.0);
        }
        let planets = planets.to_vec();
        Self { centre, planets, before, drawing, drawing_but_first, centre_but_first }
    }
}

/// A state in Jacobi's coordinates.
#[derive(Clone, Debug)]
pub(super) struct Coordinates {
    pub(super) groups: Vec<Group>,
    /// The mass centre of all bodies: where it was at the start of the run, and its velocity.
    centre_of_mass: [[f64; 3]; 2],
}

impl Coordinates {
    pub(super) fn new(masses: &Masses, state: &[f64]) -> Self {
        let bodies = masses.before.len();
        // Where there is no planet a body rests beside a centre that does not draw it.
        let resting = [Lanes::splat(1.0), Lanes::splat(0.0), Lanes::splat(0.0)];
        let zero = [Lanes::splat(0.0); 3];
        let group = Group { position: resting, position_carry: zero, velocity: zero, velocity_carry: zero };
        let mut groups = vec![group; masses.drawing.len()];
        let mut centre_of_mass = [[0.0; 3]; 2];
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &state[component * bodies..(component + 1) * bodies];
            let mut centre = values[0];
            for (planet, (&parameter, &value)) in masses.planets.iter().zip(&values[1..]).enumerate() {
                let relative = value - centre;
                centre += parameter / masses.before[planet + 1] * relative;
                let group = &mut groups[planet / LANES];
                let block = if kind == 0 { &mut group.position } else { &mut group.velocity };
                block[axis].0[planet % LANES] = relative;
            }
            centre_of_mass[kind][axis] = centre;
        }
        Self { groups, centre_of_mass }
    }

    /// Becomes `other`, of the same bodies, without a new allocation.
    pub(super) fn copy(&mut self, other: &Self) {
        self.groups.copy_from_slice(&other.groups);
        self.centre_of_mass = other.centre_of_mass;
    }

    /// The first number that is not finite, with its index in the state.
    pub(super) fn not_finite(&self, masses: &Masses) -> Option<(usize, f64)> {
        let bodies = masses.before.len();
        (0..6).find_map(|component| {
            let (kind, axis) = (component / 3, component % 3);
            let values = (0..masses.planets.len()).map(|planet| {
                let group = &self.groups[planet / LANES];
                let block = if kind == 0 { &group.position } else { &group.velocity };
                (component * bodies + planet + 1, block[axis].0[planet % LANES])
            });
            values.into_iter().find(|(_, value)| !value.is_finite())
        })
    }

    /// Writes the state, so many seconds after the start of the run.
    pub(super) fn write(&self, masses: &Masses, elapsed: f64, state: &mut [f64]) {
        let bodies = masses.before.len();
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &mut state[component * bodies..(component + 1) * bodies];
            let relative = |planet: usize| {
                let group = &self.groups[planet / LANES];
                let block = if kind == 0 { group.position } else { group.velocity };
                block[axis].0[planet % LANES]
            };
            // The mass centre of the bodies before each planet, seen from the central body.
            let mut before = 0.0;
            values[0] = 0.0;
            for (planet, &parameter) in masses.planets.iter().enumerate() {
                values[planet + 1] = before + relative(planet);
                before += parameter / masses.before[planet + 1] * relative(planet);
            }
            let [place, velocity] = self.centre_of_mass.map(|of| of[axis]);
            let shift = if kind == 0 { (place - before) + velocity * elapsed } else { velocity - before };
            for value in values {
                *value += shift;
            }
        }
    }
}
