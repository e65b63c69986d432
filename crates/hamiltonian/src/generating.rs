//! Canonical transformations from one function of old and new variables.
//!
//! ```text
//! kind       arguments    relations                          new Hamiltonian
//! the text's W(q, Q, t)   p = −∂W/∂q     P =  ∂W/∂Q          K = H − ∂W/∂t              W(11.7–11.9)
//! first      F₁(q, Q, t)  p =  ∂F₁/∂q    P = −∂F₁/∂Q         K = H + ∂F₁/∂t             F₁ = −W
//! second     F₂(q, P, t)  p =  ∂F₂/∂q    Q =  ∂F₂/∂P         K = H + ∂F₂/∂t
//! third      F₃(p, Q, t)  q = −∂F₃/∂p    P = −∂F₃/∂Q         K = H + ∂F₃/∂t
//! fourth     F₄(p, P, t)  q = −∂F₄/∂p    Q =  ∂F₄/∂P         K = H + ∂F₄/∂t
//! ```
//!
//! Mind the sign of the text's kind: it is the opposite of the first of the classical four.

use piola_numerics::{Dual, Gradient, Real};

use super::canonical::{InvertiblePhaseMap, PhaseMap};
use super::differential::{CHUNK, with_room};
use super::newton;
use crate::HamiltonianError;
use crate::check::check_length;

/// A function of old and new variables, written once for any scalar. Which of them they are, the
/// [kind](GeneratingKind) says.
///
/// # Example
/// See [`Generated`].
///
/// # Source
/// W(11.5).
pub trait GeneratingFunction {
    /// W(old, new, t), J s.
    fn value<T: Real>(&self, old: &[T], new: &[T], t: T) -> T;
}

impl<W: GeneratingFunction> GeneratingFunction for &W {
    fn value<T: Real>(&self, old: &[T], new: &[T], t: T) -> T {
        (**self).value(old, new, t)
    }
}

/// What a generating function depends on, and the signs of its relations.
///
/// # Example
/// See [`Generated`].
///
/// # Source
/// W(11.7) for the text's kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum GeneratingKind {
    /// W(q, Q, t): p = −∂W/∂q, P = ∂W/∂Q.
    Text,
    /// F₁(q, Q, t): p = ∂F₁/∂q, P = −∂F₁/∂Q.
    First,
    /// F₂(q, P, t): p = ∂F₂/∂q, Q = ∂F₂/∂P. The identity is q·P.
    Second,
    /// F₃(p, Q, t): q = −∂F₃/∂p, P = −∂F₃/∂Q.
    Third,
    /// F₄(p, P, t): q = −∂F₄/∂p, Q = ∂F₄/∂P.
    Fourth,
}

/// Which half of a phase point an argument is, and the sign of its relation.
struct Relations {
    /// Whether the old argument is q (else p), and the sign of the derivative by it.
    old: (bool, f64),
    /// Whether the new argument is Q (else P), and the sign of the derivative by it.
    new: (bool, f64),
    /// The sign of ∂/∂t in the excess of the new Hamiltonian.
    time: f64,
}

impl GeneratingKind {
    const fn relations(self) -> Relations {
        match self {
            Self::Text => Relations { old: (true, -1.0), new: (true, 1.0), time: -1.0 },
            Self::First => Relations { old: (true, 1.0), new: (true, -1.0), time: 1.0 },
            Self::Second => Relations { old: (true, 1.0), new: (false, 1.0), time: 1.0 },
            Self::Third => Relations { old: (false, -1.0), new: (true, -1.0), time: 1.0 },
            Self::Fourth => Relations { old: (false, -1.0), new: (false, 1.0), time: 1.0 },
        }
    }
}

pub(super) fn check_lengths<T>(q: &[T], p: &[T], image: &[T]) -> Result<(), HamiltonianError> {
    check_length("p", q.len(), p.len())?;
    check_length("the image", 2 * q.len(), image.len())
}

/// The part of a point that is an argument, and the part that a derivative gives.
fn parts<X>(is_position: bool, q: X, p: X) -> (X, X) {
    if is_position { (q, p) } else { (p, q) }
}

/// Writes ∂W/∂old, or ∂W/∂new, and returns nothing else of W.
pub(super) fn partials_into<T: Real>(
    function: &impl GeneratingFunction,
    (old, new, t): (&[T], &[T], T),
    by_old: bool,
    out: &mut [T],
) {
    let n = old.len();
    with_room(Gradient::<T, CHUNK>::constant(T::zero()), n + new.len(), |seeds| {
        let (from, to) = if by_old { (0, n) } else { (n, n + new.len()) };
        for first in (from..to).step_by(CHUNK) {
            for (i, (seed, &x)) in seeds.iter_mut().zip(old.iter().chain(new)).enumerate() {
                *seed = Gradient::variable(x, i.wrapping_sub(first));
            }
            let (old, new) = seeds.split_at(n);
            let value = function.value(old, new, Gradient::constant(t));
            for (out, partial) in out[first - from..].iter_mut().zip(value.partials) {
                *out = partial;
            }
        }
    });
}

/// ∂W/∂t.
pub(super) fn time_partial<T: Real>(function: &impl GeneratingFunction, old: &[T], new: &[T], t: T) -> T {
    with_room(Dual::constant(T::zero()), old.len() + new.len(), |state| {
        for (x, &value) in state.iter_mut().zip(old.iter().chain(new)) {
            *x = Dual::constant(value);
        }
        let (old, new) = state.split_at(old.len());
        function.value(old, new, Dual::variable(t)).tangent
    })
}

/// The transformation of phase space that a generating function makes.
///
/// The relation between old variables is solved for the new argument by Newton's iteration from a guess (for the way
/// back: for the old argument); it needs det ∂²W/∂old ∂new ≠ 0.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] for a guess of another length; [`HamiltonianError::Numerics`] where ∂²W/∂old ∂new
/// is singular; [`HamiltonianError::NotSolved`] where the iteration does not converge.
///
/// # Accuracy
/// A few ulp times the condition number of ∂²W/∂old ∂new.
///
/// # Example
/// W = ½ m ω q² cot Q (as F₁) makes action and angle of an oscillator:
/// ```
/// use piola_hamiltonian::{Generated, GeneratingFunction, GeneratingKind, PhaseMap};
/// use piola_numerics::Real;
/// struct ActionAngle; // m = ω = 1
/// impl GeneratingFunction for ActionAngle {
///     fn value<T: Real>(&self, q: &[T], angle: &[T], _t: T) -> T {
///         T::lit(0.5) * q[0] * q[0] / angle[0].tan()
///     }
/// }
/// let map = Generated::new(ActionAngle, GeneratingKind::First, &[1.0]);
/// let mut new = [0.0; 2];
/// map.map(&[3.0], &[4.0], 0.0, &mut new)?;
/// assert!((new[0] - f64::atan2(3.0, 4.0)).abs() < 1e-15 && (new[1] - 12.5).abs() < 1e-13);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(11.7).
#[derive(Clone, Debug, PartialEq)]
pub struct Generated<W> {
    function: W,
    kind: GeneratingKind,
    guess: Vec<f64>,
}

impl<W: GeneratingFunction> Generated<W> {
    /// The transformation of a function of a kind; the argument sought is sought near `guess`.
    pub fn new(function: W, kind: GeneratingKind, guess: &[f64]) -> Self {
        Self { function, kind, guess: guess.to_vec() }
    }

    /// The generating function.
    pub const fn function(&self) -> &W {
        &self.function
    }

    /// Its kind.
    #[must_use]
    pub const fn kind(&self) -> GeneratingKind {
        self.kind
    }

    /// Finds the new argument (or, backwards, the old one) whose partner is `conjugate`, and writes it to `sought`.
    fn find<T: Real>(
        &self,
        (known, conjugate, t): (&[T], &[T], T),
        (forwards, sign): (bool, f64),
        sought: &mut [T],
    ) -> Result<(), HamiltonianError> {
        check_length("guess", known.len(), self.guess.len())?;
        for (sought, &guess) in sought.iter_mut().zip(&self.guess) {
            *sought = T::lit(guess);
        }
        newton::solve("the relations of a generating function", sought, |x, residual| {
            with_room(Gradient::constant(T::zero()), known.len(), |given| {
                for (given, &known) in given.iter_mut().zip(known) {
                    *given = Gradient::constant(known);
                }
                let (old, new) = if forwards { (&*given, x) } else { (x, &*given) };
                partials_into(&self.function, (old, new, Gradient::constant(t)), forwards, residual);
            });
            for (residual, &conjugate) in residual.iter_mut().zip(conjugate) {
                *residual = *residual * Gradient::constant(T::lit(sign)) - Gradient::constant(conjugate);
            }
            Ok(())
        })
    }
}

impl<W: GeneratingFunction> PhaseMap for Generated<W> {
    const TIME_DEPENDENT: bool = true;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check_lengths(q, p, new)?;
        let Relations { old: (old_is_q, sign), new: (new_is_q, new_sign), .. } = self.kind.relations();
        let (known, conjugate) = parts(old_is_q, q, p);
        let (new_q, new_p) = new.split_at_mut(q.len());
        let (sought, partner) = parts(new_is_q, new_q, new_p);
        self.find((known, conjugate, t), (true, sign), sought)?;
        partials_into(&self.function, (known, sought, t), false, partner);
        for partner in partner {
            *partner *= T::lit(new_sign);
        }
        Ok(())
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], t: T) -> Result<T, HamiltonianError> {
        check_length("p", q.len(), p.len())?;
        let Relations { old: (old_is_q, sign), time, .. } = self.kind.relations();
        let (known, conjugate) = parts(old_is_q, q, p);
        with_room(T::zero(), q.len(), |sought| {
            self.find((known, conjugate, t), (true, sign), sought)?;
            Ok(T::lit(time) * time_partial(&self.function, known, sought, t))
        })
    }
}

impl<W: GeneratingFunction> InvertiblePhaseMap for Generated<W> {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        check_lengths(new_q, new_p, old)?;
        let Relations { old: (old_is_q, old_sign), new: (new_is_q, sign), .. } = self.kind.relations();
        let (known, conjugate) = parts(new_is_q, new_q, new_p);
        let (old_q, old_p) = old.split_at_mut(new_q.len());
        let (sought, partner) = parts(old_is_q, old_q, old_p);
        self.find((known, conjugate, t), (false, sign), sought)?;
        partials_into(&self.function, (sought, known, t), true, partner);
        for partner in partner {
            *partner *= T::lit(old_sign);
        }
        Ok(())
    }
}
