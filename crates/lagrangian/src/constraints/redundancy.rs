//! Constraints that depend on others, and the degrees of freedom that are left.

use piola_kinematics::Holonomic;

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::LagrangianError;
use crate::{Forces, Potential};

/// A constraint whose gradient is a combination of others.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dependency {
    /// The constraint.
    pub constraint: usize,
    /// What it is called, if it has a name.
    pub name: Option<String>,
    /// The weights cᵢ of the other constraints in ∂φ/∂q = Σ cᵢ ∂φᵢ/∂q; zero for those that do not take part.
    pub combination: Vec<f64>,
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The constraints that depend on others at a position, each with the combination that it is.
    ///
    /// Of constraints that depend on each other the later ones are named, unless less is left of the earlier
    /// when the others are taken out. The position should be [assembled](Self::assemble): closed loops may be
    /// redundant only where they are closed.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration), except for redundancy.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::constraints::Constraints;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// struct Bead; // q = [x, y]
    /// impl Holonomic for Bead {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(1.0, Vector3::new(q[0], q[1], T::zero()));
    ///     }
    /// }
    /// struct Twice; // x = 1 and 2x = 2
    /// impl Constraints for Twice {
    ///     fn count(&self) -> usize {
    ///         2
    ///     }
    ///     fn residuals<T: Real>(&self, q: &[T], _t: T, out: &mut [T]) {
    ///         out[0] = q[0] - T::one();
    ///         out[1] = T::lit(2.0) * out[0];
    ///     }
    /// }
    /// let bead = Lagrangian::of(Bead).with_constraints(Twice);
    /// let dependencies = bead.dependencies(&[1.0, 0.0], 0.0)?;
    /// assert_eq!((dependencies[0].constraint, &dependencies[0].combination[..]), (1, &[2.0, 0.0][..]));
    /// assert_eq!(bead.degrees_of_freedom(&[1.0, 0.0], 0.0)?, 1);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    pub fn dependencies(&self, q: &[f64], t: f64) -> Result<Vec<Dependency>, LagrangianError> {
        let mut work = Workspace::default();
        self.choose_at(&mut work, q, t)?;
        let independence = &mut work.independence;
        independence.combine();
        let places = independence.rank..independence.order.len();
        Ok(places
            .map(|place| {
                let constraint = independence.order[place];
                let combination = independence.combination(place);
                Dependency { constraint, name: self.name_of(constraint), combination }
            })
            .collect())
    }

    /// The number of independent motions that the constraints leave, n − rank G.
    ///
    /// # Errors
    /// As [`dependencies`](Self::dependencies).
    pub fn degrees_of_freedom(&self, q: &[f64], t: f64) -> Result<usize, LagrangianError> {
        let mut work = Workspace::default();
        self.choose_at(&mut work, q, t)?;
        Ok(q.len() - work.independence.rank)
    }

    fn choose_at(&self, work: &mut Workspace, q: &[f64], t: f64) -> Result<(), LagrangianError> {
        let at_rest = vec![0.0; q.len()];
        self.form(work, q, &at_rest, t)?;
        self.factor(work, false)?;
        work.independence.choose(self.least_share);
        Ok(())
    }
}
