//! Quadratures of the action and the polynomials between them.

use piola_integrators::Order;

/// The largest number of nodes of a polynomial, and of points of a quadrature.
pub(crate) const MOST: usize = 5;

/// The points at which the Lagrangian of one step is evaluated.
///
/// The motion within a step is a polynomial of degree s; both rules have order 2s.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ActionRule {
    /// Gauss's s points, inside the step: the midpoint rule for order 2.
    Gauss,
    /// Lobatto's s + 1 points, the ends among them: the trapezoidal rule for order 2, which is the Störmer–Verlet method
    /// where the kinetic energy does not depend on q.
    Lobatto,
}

/// A polynomial of degree s through s + 1 nodes, of which the first is 0 and the last 1, and a quadrature.
#[derive(Clone, Copy, Debug)]
pub struct ActionTableau {
    /// s.
    pub degree: usize,
    /// The number of points of the quadrature.
    pub points: usize,
    /// cᵢ.
    pub times: [f64; MOST],
    /// bᵢ.
    pub weights: [f64; MOST],
    /// ℓⱼ(cᵢ) of the nodes j = 1 … s, at `[i][j − 1]`.
    pub values: [[f64; MOST]; MOST],
    /// ℓⱼ′(cᵢ).
    pub slopes: [[f64; MOST]; MOST],
}

impl ActionTableau {
    /// The polynomial and the quadrature of a rule and an order.
    ///
    /// Source: the zeros of Pₛ and of Pₛ′ with their weights in closed form; M. Abramowitz, I. A. Stegun, *Handbook of
    /// Mathematical Functions*, 25.4.29 and 25.4.32.
    #[must_use]
    pub fn new(rule: ActionRule, order: Order) -> Self {
        let degree = match order {
            Order::Two => 1,
            Order::Four => 2,
            Order::Six => 3,
            Order::Eight => 4,
        };
        let (nodes, lobatto_weights) = lobatto(degree);
        let (points, times, weights) = match rule {
            ActionRule::Gauss => {
                let (times, weights) = gauss(degree);
                (degree, times, weights)
            }
            ActionRule::Lobatto => (degree + 1, nodes, lobatto_weights),
        };
        let (mut values, mut slopes) = ([[0.0; MOST]; MOST], [[0.0; MOST]; MOST]);
        for i in 0..points {
            for j in 1..=degree {
                let (value, slope) = lagrange(&nodes[..=degree], j, times[i]);
                (values[i][j - 1], slopes[i][j - 1]) = (value, slope);
            }
        }
        Self { degree, points, times, weights, values, slopes }
    }
}

/// ℓⱼ(x) and ℓⱼ′(x).
pub(crate) fn lagrange(nodes: &[f64], j: usize, x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (1.0, 0.0);
    for (k, &node) in nodes.iter().enumerate() {
        if k != j {
            let width = nodes[j] - node;
            slope = (slope * (x - node) + value) / width;
            value *= (x - node) / width;
        }
    }
    (value, slope)
}

/// Points and weights on [0, 1], symmetric, from the half-widths and weights of the points above the middle.
fn symmetric(middle: Option<f64>, above: &[(f64, f64)]) -> ([f64; MOST], [f64; MOST]) {
    let (mut times, mut weights) = ([0.0; MOST], [0.0; MOST]);
    let count = 2 * above.len() + usize::from(middle.is_some());
    for (k, &(x, weight)) in above.iter().enumerate() {
        // From the ends inwards.
        (times[k], times[count - 1 - k]) = (0.5 - 0.5 * x, 0.5 + 0.5 * x);
        (weights[k], weights[count - 1 - k]) = (0.5 * weight, 0.5 * weight);
    }
    if let Some(weight) = middle {
        (times[above.len()], weights[above.len()]) = (0.5, 0.5 * weight);
    }
    (times, weights)
}

/// Gauss's s points.
pub(crate) fn gauss(s: usize) -> ([f64; MOST], [f64; MOST]) {
    match s {
        1 => symmetric(Some(2.0), &[]),
        2 => symmetric(None, &[((1.0_f64 / 3.0).sqrt(), 1.0)]),
        3 => symmetric(Some(8.0 / 9.0), &[(0.6_f64.sqrt(), 5.0 / 9.0)]),
        _ => {
            let (root, thirty) = (2.0 / 7.0 * 1.2_f64.sqrt(), 30.0_f64.sqrt());
            symmetric(
                None,
                &[
                    ((3.0 / 7.0 + root).sqrt(), (18.0 - thirty) / 36.0),
                    ((3.0 / 7.0 - root).sqrt(), (18.0 + thirty) / 36.0),
                ],
            )
        }
    }
}

/// Lobatto's s + 1 points.
pub(crate) fn lobatto(s: usize) -> ([f64; MOST], [f64; MOST]) {
    match s {
        1 => symmetric(None, &[(1.0, 1.0)]),
        2 => symmetric(Some(4.0 / 3.0), &[(1.0, 1.0 / 3.0)]),
        3 => symmetric(None, &[(1.0, 1.0 / 6.0), (0.2_f64.sqrt(), 5.0 / 6.0)]),
        _ => symmetric(Some(32.0 / 45.0), &[(1.0, 0.1), ((3.0_f64 / 7.0).sqrt(), 49.0 / 90.0)]),
    }
}
