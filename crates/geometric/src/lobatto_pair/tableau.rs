//! The coefficients of Lobatto's pairs and of Gauss's collocation.

use piola_integrators::Order;

use crate::variational::rule::{MOST, gauss, lagrange, lobatto};

/// The coefficients of s stages.
///
/// Source: collocation on Lobatto's points, aᵢⱼ = ∫₀^cᵢ ℓⱼ, and symplecticity, bᵢ âᵢⱼ + bⱼ aⱼᵢ = bᵢ bⱼ; Hairer, Lubich & Wanner,
/// *Geometric Numerical Integration*, II.1.4 and VI.4.
#[derive(Clone, Copy, Debug)]
pub struct PairTableau {
    /// s.
    pub stages: usize,
    /// c.
    pub nodes: [f64; MOST],
    /// b.
    pub weights: [f64; MOST],
    /// μᵢⱼ = aᵢⱼ/bⱼ, of Lobatto IIIA for the positions.
    pub positions: [[f64; MOST]; MOST],
    /// νᵢⱼ = âᵢⱼ/bⱼ = 1 − μⱼᵢ, of Lobatto IIIB for the momenta: the stored numbers obey it exactly. Gauss's are μ themselves.
    pub momenta: [[f64; MOST]; MOST],
}

impl PairTableau {
    /// Lobatto's coefficients of an order.
    #[must_use]
    pub fn lobatto(order: Order) -> Self {
        let degree = degree_of(order);
        let stages = degree + 1;
        let (nodes, weights) = lobatto(degree);
        let mut positions = couplings(&nodes[..stages], &weights);
        // The first row is that of an empty integral, the last one that of b.
        let mut momenta = [[0.0; MOST]; MOST];
        positions[0] = [0.0; MOST];
        positions[degree] = [1.0; MOST];
        for i in 0..stages {
            for j in 0..stages {
                // 1 − x is exact for x between ½ and 2, and one of the two coefficients is.
                momenta[i][j] = 1.0 - positions[j][i];
                if 0.5 <= momenta[i][j] {
                    positions[j][i] = 1.0 - momenta[i][j];
                }
            }
        }
        Self { stages, nodes, weights, positions, momenta }
    }

    /// Gauss's coefficients of an order, the same for positions and momenta: μᵢⱼ + μⱼᵢ = 1.
    #[must_use]
    pub fn gauss(order: Order) -> Self {
        let stages = degree_of(order);
        let (nodes, weights) = gauss(stages);
        let mut couplings = couplings(&nodes[..stages], &weights);
        for i in 0..stages {
            couplings[i][i] = 0.5;
            for j in 0..i {
                // 1 − x is exact for x between ½ and 2, and one of the two coefficients is.
                let (large, small) =
                    if couplings[i][j] < couplings[j][i] { ((j, i), (i, j)) } else { ((i, j), (j, i)) };
                couplings[small.0][small.1] = 1.0 - couplings[large.0][large.1];
            }
        }
        Self { stages, nodes, weights, positions: couplings, momenta: couplings }
    }
}

/// The degree of the polynomials in time: half the order.
const fn degree_of(order: Order) -> usize {
    match order {
        Order::Two => 1,
        Order::Four => 2,
        Order::Six => 3,
        Order::Eight => 4,
    }
}

/// ∫₀^cᵢ ℓⱼ / bⱼ.
fn couplings(nodes: &[f64], weights: &[f64; MOST]) -> [[f64; MOST]; MOST] {
    // Gauss's points that integrate polynomials of this degree exactly.
    let count = nodes.len().div_ceil(2);
    let (times, parts) = gauss(count);
    let mut couplings = [[0.0; MOST]; MOST];
    for (i, row) in couplings.iter_mut().enumerate().take(nodes.len()) {
        for j in 0..nodes.len() {
            let integral: f64 = (0..count).map(|k| parts[k] * lagrange(nodes, j, nodes[i] * times[k]).0).sum();
            row[j] = nodes[i] * integral / weights[j];
        }
    }
    couplings
}
