//! The coefficients of Lobatto's pairs.

use piola_integrators::Order;

use crate::variational::rule::{MOST, gauss, lagrange, lobatto};

/// The coefficients of s stages.
///
/// Source: collocation on Lobatto's points, aᵢⱼ = ∫₀^cᵢ ℓⱼ, and symplecticity, bᵢ âᵢⱼ + bⱼ aⱼᵢ = bᵢ bⱼ; Hairer, Lubich & Wanner,
/// *Geometric Numerical Integration*, II.1.4 and VI.4.
#[derive(Clone, Copy, Debug)]
pub struct LobattoTableau {
    /// s.
    pub stages: usize,
    /// c.
    pub nodes: [f64; MOST],
    /// b.
    pub weights: [f64; MOST],
    /// μᵢⱼ = aᵢⱼ/bⱼ of Lobatto IIIA, for the positions.
    pub positions: [[f64; MOST]; MOST],
    /// νᵢⱼ = âᵢⱼ/bⱼ = 1 − μⱼᵢ of Lobatto IIIB, for the momenta: the stored numbers obey it exactly.
    pub momenta: [[f64; MOST]; MOST],
}

impl LobattoTableau {
    /// The coefficients of an order.
    #[must_use]
    pub fn new(order: Order) -> Self {
        let degree = match order {
            Order::Two => 1,
            Order::Four => 2,
            Order::Six => 3,
            Order::Eight => 4,
        };
        let stages = degree + 1;
        let (nodes, weights) = lobatto(degree);
        // Gauss's points that integrate polynomials of this degree exactly.
        let count = stages.div_ceil(2);
        let (times, parts) = gauss(count);
        let (mut positions, mut momenta) = ([[0.0; MOST]; MOST], [[0.0; MOST]; MOST]);
        for i in 0..stages {
            for j in 0..stages {
                let integral: f64 =
                    (0..count).map(|k| parts[k] * lagrange(&nodes[..stages], j, nodes[i] * times[k]).0).sum();
                positions[i][j] = nodes[i] * integral / weights[j];
            }
        }
        // The first row is that of an empty integral, the last one that of b.
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
}
