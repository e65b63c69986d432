//! Finite sums of eigenfunctions, stored by the amplitudes of their components.

use std::f64::consts::PI;

use crate::basis::{Eigenbasis, Polarisation, check_sides, weight};
use crate::error::{SpectralError, check_finite};
use crate::operator::{BoxOperator, LameParameters};
use crate::walls::{Parity, Walls};

/// A finite sum of eigenfunctions: a field between walls, with its gradient, strain, stress and energy at any place.
///
/// ```text
/// u_c(x) = Σ a_c(i) Π_b sc(i_b π x_b/L_b),   0 ≤ i_b ≤ N_b,
/// ```
/// with a sine or a cosine for each axis and component as the walls demand. For each index the D amplitudes `a_c` are
/// the same numbers as the D coefficients of the eigenfunctions φ, turned.
///
/// # Example
/// ```
/// use piola_spectral::{BoxOperator, LameParameters, ModalSeries, Walls};
/// use std::f64::consts::PI;
/// let lame = LameParameters::new(1.5, 0.75)?;
/// let mut force = ModalSeries::zeros([1.0, 1.0], Walls::Sliding, [4, 4])?;
/// force.set_amplitudes([1, 0], [3.0, 0.0])?;
/// let displacement = force.solved(&BoxOperator::elastic(lame));
/// // (λ + 2μ) u″ + f = 0 with λ + 2μ = 3.
/// let middle = displacement.value([0.5, 0.2])?;
/// assert!((middle[0] - 1.0 / (PI * PI)).abs() < 1e-16);
/// // The stress at the wall x = 0 is 3 ∂u/∂x.
/// assert!((displacement.stress(lame, [0.0, 0.2])?[0][0] - 3.0 / PI).abs() < 1e-15);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.96), B(4.100).
#[derive(Clone, Debug, PartialEq)]
pub struct ModalSeries<const D: usize> {
    sides: [f64; D],
    walls: Walls,
    highest: [usize; D],
    pub(crate) amplitudes: [Vec<f64>; D],
}

impl<const D: usize> ModalSeries<D> {
    /// The zero field with room for the indices 0 ≤ i ≤ `highest`.
    ///
    /// # Errors
    /// A side that is not finite and positive; more amplitudes than memory can address.
    pub fn zeros(sides: [f64; D], walls: Walls, highest: [usize; D]) -> Result<Self, SpectralError> {
        const { assert!(D == 2 || D == 3, "a rectangle or a box") };
        check_sides(&sides)?;
        let bytes = highest
            .iter()
            .try_fold(size_of::<f64>(), |product, &index| product.checked_mul(index.checked_add(1)?))
            .filter(|&bytes| bytes <= isize::MAX.unsigned_abs());
        let Some(bytes) = bytes else {
            return Err(SpectralError::TooManyPoints { points: crate::grid::in_space(highest, 1) });
        };
        let amplitudes = std::array::from_fn(|_| vec![0.0; bytes / size_of::<f64>()]);
        Ok(Self { sides, walls, highest, amplitudes })
    }

    /// The projection of a function onto the modes, by Gauss's rule with `nodes` points along each axis.
    ///
    /// The rule is exact for polynomials of degree 2 `nodes` − 1 in each coordinate. A smooth function that need not obey
    /// the walls has exact coefficients with some `highest` + 16 nodes or more.
    ///
    /// # Errors
    /// As of [`zeros`](Self::zeros); no nodes; a value that is not finite.
    pub fn of_function(
        sides: [f64; D],
        walls: Walls,
        highest: [usize; D],
        nodes: usize,
        function: impl Fn([f64; D]) -> [f64; D],
    ) -> Result<Self, SpectralError> {
        let mut series = Self::zeros(sides, walls, highest)?;
        let rule = gauss_rule(nodes)?;
        let strides: [usize; D] = std::array::from_fn(|axis| (axis + 1..D).fold(1, |product, _| product * nodes));
        let count = strides[0] * nodes;
        let mut values: [Vec<f64>; D] = std::array::from_fn(|_| Vec::with_capacity(count));
        for point in 0..count {
            let place = std::array::from_fn(|axis| {
                let index = point / strides[axis] % nodes;
                sides[axis] * rule[index][0]
            });
            let value = function(place);
            for (component, values) in values.iter_mut().enumerate() {
                if !value[component].is_finite() {
                    return Err(SpectralError::NotFinite {
                        quantity: "value of the function",
                        index: component,
                        value: value[component],
                    });
                }
                values.push(value[component]);
            }
        }
        for (component, values) in values.into_iter().enumerate() {
            let mut values = values;
            // From the last axis to the first; each turns the list so that the next one is the last.
            for axis in (0..D).rev() {
                let parity = walls.parity(component, axis);
                let modes = highest[axis] + 1;
                let table: Vec<f64> = (0..modes * nodes)
                    .map(|entry| {
                        let (index, [place, share]) = (entry / nodes, rule[entry % nodes]);
                        let scale = if index == 0 { 1.0 } else { 2.0 };
                        scale * share * entry_of(parity, PI * index as f64 * place)
                    })
                    .collect();
                let rows = values.len() / nodes;
                let mut next = vec![0.0; rows * modes];
                for (index, weights) in table.chunks_exact(nodes).enumerate() {
                    for (row, samples) in values.chunks_exact(nodes).enumerate() {
                        next[index * rows + row] = samples.iter().zip(weights).map(|(x, w)| x * w).sum();
                    }
                }
                values = next;
            }
            series.amplitudes[component] = values;
        }
        Ok(series)
    }

    /// The sides of the box, m.
    #[must_use]
    pub fn sides(&self) -> [f64; D] {
        self.sides
    }

    /// What the walls hold.
    #[must_use]
    pub fn walls(&self) -> Walls {
        self.walls
    }

    /// The highest indices.
    #[must_use]
    pub fn highest(&self) -> [usize; D] {
        self.highest
    }

    /// The amplitudes of the components for these indices: zeros beyond the highest.
    #[must_use]
    pub fn amplitudes(&self, indices: [usize; D]) -> [f64; D] {
        let position = self.position(indices);
        std::array::from_fn(|component| position.map_or(0.0, |position| self.amplitudes[component][position]))
    }

    /// Sets the amplitudes of the components for these indices. Those whose sine has the index zero stay zero.
    ///
    /// # Errors
    /// An index above the highest; an amplitude that is not finite.
    pub fn set_amplitudes(&mut self, indices: [usize; D], amplitudes: [f64; D]) -> Result<(), SpectralError> {
        check_finite("amplitude", &amplitudes)?;
        let Some(position) = self.position(indices) else {
            let axis = (0..D).find(|&axis| self.highest[axis] < indices[axis]).unwrap_or(0);
            return Err(SpectralError::OutOfBounds { quantity: "index", value: indices[axis] as f64, bound: "i <= N" });
        };
        for component in 0..D {
            if !self.is_zero(component, indices) {
                self.amplitudes[component][position] = amplitudes[component];
            }
        }
        Ok(())
    }

    /// The coefficient ⟨u, φ⟩ of an eigenfunction between sliding walls.
    ///
    /// # Errors
    /// An eigenfunction that vanishes; other walls or sides than those of the basis.
    pub fn coefficient(
        &self,
        basis: &Eigenbasis<D>,
        polarisation: Polarisation,
        indices: [usize; D],
    ) -> Result<f64, SpectralError> {
        if self.walls != Walls::Sliding || !is_same_box(&self.sides, &basis.sides()) {
            return Err(SpectralError::OtherGrid { quantity: "basis" });
        }
        let unit = basis.amplitudes(polarisation, indices)?;
        let own = self.amplitudes(indices);
        Ok(weight(&self.sides, indices) * own.iter().zip(unit).map(|(a, b)| a * b).sum::<f64>())
    }

    /// The solution of Lu + f = 0 for this force f: each part is divided by −κ.
    ///
    /// # Source
    /// B(4.100).
    #[must_use]
    pub fn solved(&self, operator: &BoxOperator) -> Self {
        let mut solution = self.clone();
        solution.for_each_mode(|q, amplitudes| {
            let squared: f64 = q.iter().map(|q| q * q).sum();
            let [along, across] = operator.eigenvalues(squared).map(|kappa| -1.0 / kappa);
            let projected: f64 = q.iter().zip(&*amplitudes).map(|(q, a)| q * a).sum::<f64>() / squared;
            for component in 0..D {
                let part = projected * q[component];
                amplitudes[component] = along * part + across * (amplitudes[component] - part);
            }
        });
        solution
    }

    /// The field at a place in the box, m.
    ///
    /// # Errors
    /// A place that is not finite.
    pub fn value(&self, place: [f64; D]) -> Result<[f64; D], SpectralError> {
        check_finite("place", &place)?;
        Ok(std::array::from_fn(|component| self.sum(component, place, None)))
    }

    /// The derivative of component c along axis b in row c, column b.
    ///
    /// # Errors
    /// A place that is not finite.
    pub fn gradient(&self, place: [f64; D]) -> Result<[[f64; D]; D], SpectralError> {
        check_finite("place", &place)?;
        Ok(std::array::from_fn(|component| std::array::from_fn(|axis| self.sum(component, place, Some(axis)))))
    }

    /// The linear strain ½(∇u + ∇uᵀ).
    ///
    /// # Errors
    /// A place that is not finite.
    ///
    /// # Source
    /// B(4.71).
    pub fn strain(&self, place: [f64; D]) -> Result<[[f64; D]; D], SpectralError> {
        let gradient = self.gradient(place)?;
        Ok(std::array::from_fn(|row| {
            std::array::from_fn(|column| 0.5 * (gradient[row][column] + gradient[column][row]))
        }))
    }

    /// The stress λ tr ε 1 + 2μ ε, Pa. In a rectangle: plane strain.
    ///
    /// # Errors
    /// A place that is not finite.
    pub fn stress(&self, lame: LameParameters, place: [f64; D]) -> Result<[[f64; D]; D], SpectralError> {
        Ok(stress_of(lame, &self.strain(place)?))
    }

    /// The elastic energy ∫ ½λ(tr ε)² + μ ε:ε dV, J (in a rectangle: J/m), by Parseval's equation.
    ///
    /// # Source
    /// B(4.72).
    #[must_use]
    pub fn elastic_energy(&self, lame: LameParameters) -> f64 {
        let mut energy = 0.0;
        let sides = self.sides;
        self.each_mode(|indices, q, amplitudes| {
            let squared: f64 = q.iter().map(|q| q * q).sum();
            let along: f64 = q.iter().zip(amplitudes).map(|(q, a)| q * a).sum();
            let size: f64 = amplitudes.iter().map(|a| a * a).sum();
            let density = lame.longitudinal_modulus() * along * along
                + lame.shear_modulus() * (squared * size - along * along).max(0.0);
            energy += 0.5 * weight(&sides, indices) * density;
        });
        energy
    }

    /// ∫ u² dV.
    #[must_use]
    pub fn squared_norm(&self) -> f64 {
        let mut sum = 0.0;
        let sides = self.sides;
        self.each_mode(|indices, _, amplitudes| {
            sum += weight(&sides, indices) * amplitudes.iter().map(|a| a * a).sum::<f64>();
        });
        sum
    }

    /// ∫ u dV for each component; of a force field, its resultant, N.
    #[must_use]
    pub fn integral(&self) -> [f64; D] {
        let sides = self.sides;
        let mut total = [0.0; D];
        let walls = self.walls;
        self.each_mode(|indices, _, amplitudes| {
            for component in 0..D {
                // A cosine has an integral when its index is zero, a sine when it is odd: 2L/(iπ).
                let factor = (0..D).fold(1.0, |product, axis| {
                    product
                        * match (walls.parity(component, axis), indices[axis]) {
                            (Parity::Cosine, 0) => sides[axis],
                            (Parity::Sine, index) if index % 2 == 1 => 2.0 * sides[axis] / (PI * index as f64),
                            _ => 0.0,
                        }
                });
                total[component] += factor * amplitudes[component];
            }
        });
        total
    }

    /// The resultant of the normal pressures between the body and a sliding wall: the force that the wall at x = 0, or with
    /// `is_far` at x = L, of an axis exerts on the body along this axis, N.
    ///
    /// # Errors
    /// Walls that do not slide.
    pub fn wall_force(&self, lame: LameParameters, axis: usize, is_far: bool) -> Result<f64, SpectralError> {
        if self.walls != Walls::Sliding || D <= axis {
            return Err(SpectralError::OtherGrid { quantity: "wall" });
        }
        let area: f64 = (0..D).filter(|&other| other != axis).map(|other| self.sides[other]).product();
        let mut traction = 0.0;
        for index in 1..=self.highest[axis] {
            let mut indices = [0; D];
            indices[axis] = index;
            let slope = PI * index as f64 / self.sides[axis] * self.amplitudes(indices)[axis];
            let sign = if is_far && index % 2 == 1 { -1.0 } else { 1.0 };
            traction += sign * lame.longitudinal_modulus() * slope;
        }
        Ok(if is_far { area * traction } else { -area * traction })
    }

    /// Where the amplitudes of these indices are stored.
    pub(crate) fn position(&self, indices: [usize; D]) -> Option<usize> {
        let mut position = 0;
        for axis in 0..D {
            if self.highest[axis] < indices[axis] {
                return None;
            }
            position = position * (self.highest[axis] + 1) + indices[axis];
        }
        Some(position)
    }

    /// The indices of the amplitudes at a position.
    pub(crate) fn indices(&self, position: usize) -> [usize; D] {
        let mut rest = position;
        let mut indices = [0; D];
        for axis in (0..D).rev() {
            indices[axis] = rest % (self.highest[axis] + 1);
            rest /= self.highest[axis] + 1;
        }
        indices
    }

    /// Whether a component has a sine of index zero.
    pub(crate) fn is_zero(&self, component: usize, indices: [usize; D]) -> bool {
        (0..D).any(|axis| indices[axis] == 0 && self.walls.parity(component, axis) == Parity::Sine)
    }

    pub(crate) fn wave_vector(&self, indices: [usize; D]) -> [f64; D] {
        std::array::from_fn(|axis| PI * indices[axis] as f64 / self.sides[axis])
    }

    /// Calls with indices, wave vector and amplitudes of each mode.
    fn each_mode(&self, mut visit: impl FnMut([usize; D], [f64; D], [f64; D])) {
        for position in 0..self.amplitudes[0].len() {
            let indices = self.indices(position);
            let amplitudes = self.amplitudes.each_ref().map(|amplitudes| amplitudes[position]);
            visit(indices, self.wave_vector(indices), amplitudes);
        }
    }

    /// Changes the amplitudes of each mode; those of vanishing components stay zero.
    pub(crate) fn for_each_mode(&mut self, mut change: impl FnMut([f64; D], &mut [f64; D])) {
        for position in 1..self.amplitudes[0].len() {
            let indices = self.indices(position);
            let mut amplitudes = self.amplitudes.each_ref().map(|amplitudes| amplitudes[position]);
            for (component, amplitude) in amplitudes.iter_mut().enumerate() {
                if self.is_zero(component, indices) {
                    *amplitude = 0.0;
                }
            }
            change(self.wave_vector(indices), &mut amplitudes);
            for component in 0..D {
                self.amplitudes[component][position] =
                    if self.is_zero(component, indices) { 0.0 } else { amplitudes[component] };
            }
        }
        // No field between walls is uniform.
        for amplitudes in &mut self.amplitudes {
            amplitudes[0] = 0.0;
        }
    }

    /// The sum of one component, or of its derivative along an axis.
    fn sum(&self, component: usize, place: [f64; D], derivative: Option<usize>) -> f64 {
        let tables: [Vec<f64>; D] = std::array::from_fn(|axis| {
            let parity = self.walls.parity(component, axis);
            (0..=self.highest[axis])
                .map(|index| {
                    let q = PI * index as f64 / self.sides[axis];
                    match (derivative == Some(axis), parity) {
                        (false, parity) => entry_of(parity, q * place[axis]),
                        (true, Parity::Sine) => q * (q * place[axis]).cos(),
                        (true, Parity::Cosine) => -q * (q * place[axis]).sin(),
                    }
                })
                .collect()
        });
        let mut values = self.amplitudes[component].clone();
        for axis in (0..D).rev() {
            let table = &tables[axis];
            values =
                values.chunks_exact(table.len()).map(|row| row.iter().zip(table).map(|(a, b)| a * b).sum()).collect();
        }
        values[0]
    }
}

/// Whether two boxes have the same sides, but for the rounding of points times spacing.
pub(crate) fn is_same_box(one: &[f64], other: &[f64]) -> bool {
    one.iter().zip(other).all(|(one, other)| (one - other).abs() <= 8.0 * f64::EPSILON * one)
}

/// λ tr ε 1 + 2μ ε.
pub(crate) fn stress_of<const D: usize>(lame: LameParameters, strain: &[[f64; D]; D]) -> [[f64; D]; D] {
    let dilatation: f64 = (0..D).map(|axis| strain[axis][axis]).sum();
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let isotropic = if row == column { lame.first() * dilatation } else { 0.0 };
            isotropic + 2.0 * lame.shear_modulus() * strain[row][column]
        })
    })
}

fn entry_of(parity: Parity, angle: f64) -> f64 {
    match parity {
        Parity::Sine => angle.sin(),
        Parity::Cosine => angle.cos(),
    }
}

/// Places and weights of Gauss's rule on [0, 1].
fn gauss_rule(nodes: usize) -> Result<Vec<[f64; 2]>, SpectralError> {
    if nodes == 0 {
        return Err(SpectralError::TooFewPoints { axis: 0, points: 0, least: 1 });
    }
    let n = nodes as f64;
    let mut rule = vec![[0.0; 2]; nodes];
    for k in 0..nodes.div_ceil(2) {
        // Newton's method on Legendre's polynomial, from Tricomi's approximation.
        let mut x = (PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..16 {
            let (mut below, mut value) = (1.0, x);
            for degree in 2..=nodes {
                let m = degree as f64;
                (below, value) = (value, ((2.0 * m - 1.0) * x * value - (m - 1.0) * below) / m);
            }
            slope = n * (below - x * value) / ((1.0 - x) * (1.0 + x));
            let step = value / slope;
            x -= step;
            if step.abs() <= f64::EPSILON * x.abs() {
                break;
            }
        }
        let weight = 1.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
        rule[k] = [0.5 * (1.0 - x), weight];
        rule[nodes - 1 - k] = [0.5 * (1.0 + x), weight];
    }
    Ok(rule)
}
