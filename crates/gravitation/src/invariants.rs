//! Energy, momentum and angular momentum of gravitating bodies, in compensated sums.

use piola_numerics::sums::CompensatedSum;

use super::{Gravitation, post_newtonian};

/// What a closed system of gravitating bodies keeps, each multiplied by the gravitational constant G, since
/// only the products Gm are known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GravitationInvariants {
    /// G(E + V) with E = ½Σmv² and V = −½ΣΣ Gmᵢmⱼ/r, m⁵/s⁴.
    pub energy: f64,
    /// The same with the post-Newtonian part of the central body's field; equal to `energy` when it is off.
    pub post_newtonian_energy: f64,
    /// G Σ m v, m⁴/s³.
    pub momentum: [f64; 3],
    /// G Σ m |v|: what the momentum is compared with.
    pub momentum_scale: f64,
    /// G Σ m r × v about the origin, m⁵/s³.
    #[doc(alias = "moment of momentum")]
    pub angular_momentum: [f64; 3],
    /// G Σ m |r × v|: what the angular momentum is compared with.
    pub angular_momentum_scale: f64,
}

impl Gravitation {
    /// The invariants of a state.
    ///
    /// # Accuracy
    /// The sums are compensated: a few ulp of the sum of the magnitudes of the terms.
    ///
    /// # Example
    /// ```
    /// use piola_gravitation::Gravitation;
    /// let pair = Gravitation::new(vec![1.0, 1.0])?;
    /// let state = pair.state(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], &[[0.0, 0.5, 0.0], [0.0, -0.5, 0.0]])?;
    /// let invariants = pair.invariants(&state);
    /// assert_eq!(invariants.energy, -0.25); // 2·½·¼ − ½
    /// assert_eq!(invariants.angular_momentum, [0.0, 0.0, 1.0]);
    /// # Ok::<(), piola_gravitation::GravitationError>(())
    /// ```
    ///
    /// # Source
    /// W(1.15–1.24).
    #[must_use]
    pub fn invariants(&self, state: &[f64]) -> GravitationInvariants {
        let n = self.bodies();
        let mut energy = CompensatedSum::new();
        let mut correction = CompensatedSum::new();
        let mut momentum = [CompensatedSum::new(); 3];
        let mut moment = [CompensatedSum::new(); 3];
        let mut momentum_scale = CompensatedSum::new();
        let mut moment_scale = CompensatedSum::new();
        for i in 0..n {
            let (x, v, m) = (self.position(state, i), self.velocity(state, i), self.parameters[i]);
            for component in v {
                energy.add_product(0.5 * m * component, component);
            }
            for (sum, component) in momentum.iter_mut().zip(v) {
                sum.add_product(m, component);
            }
            momentum_scale.add(m * length(v));
            let mut own = [0.0; 3];
            for k in 0..3 {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                moment[k].add_product(m * x[a], v[b]);
                moment[k].add_product(-(m * x[b]), v[a]);
                own[k] = x[a] * v[b] - x[b] * v[a];
            }
            moment_scale.add(m * length(own));
            for j in i + 1..n {
                let y = self.position(state, j);
                let d = [y[0] - x[0], y[1] - x[1], y[2] - x[2]];
                let r = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + self.softening * self.softening).sqrt();
                let product = m * self.parameters[j];
                if 0.0 < product {
                    energy.add(-product / r);
                }
            }
            if let Some(term) = self.post_newtonian
                && i != term.centre
            {
                let (y, w) = (self.position(state, term.centre), self.velocity(state, term.centre));
                let relative = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
                let mu = self.parameters[term.centre];
                correction.add(m * post_newtonian::energy(relative(x, y), relative(v, w), mu, term.speed_of_light));
            }
        }
        GravitationInvariants {
            energy: energy.value(),
            post_newtonian_energy: energy.value() + correction.value(),
            momentum: momentum.map(CompensatedSum::value),
            momentum_scale: momentum_scale.value(),
            angular_momentum: moment.map(CompensatedSum::value),
            angular_momentum_scale: moment_scale.value(),
        }
    }
}

fn length(a: [f64; 3]) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}
