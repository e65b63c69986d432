//! What may be asked.

/// What is asked of a mechanism besides its motion.
///
/// # Example
/// See [`Mechanism::answers`](crate::joints::Mechanism::answers).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MechanismQuestions {
    /// Whether the equilibrium near the start is sought, with its stability.
    pub equilibrium: bool,
    /// Whether the modes of small motions about it are.
    pub modes: bool,
    /// Whether the energies of every part are recorded.
    pub energies: bool,
}
