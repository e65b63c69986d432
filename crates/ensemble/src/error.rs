//! Errors of ensembles.

use std::path::PathBuf;

use piola_charts::ChartsError;
use piola_scene::SceneError;

/// Why an ensemble is not accepted or cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// A variation is not accepted.
    #[error("`{argument}` is not accepted; valid: {valid}")]
    Argument {
        /// The argument.
        argument: String,
        /// The valid arguments in words.
        valid: &'static str,
    },
    /// There are too many members.
    #[error("{members} members are too many; at most {most}")]
    TooMany {
        /// How many were asked for.
        members: f64,
        /// The largest number.
        most: u64,
    },
    /// The first member is not a valid scene; so no other is tried.
    #[error("the scene of member {member} is not valid:\n{cause}")]
    Invalid {
        /// The member, from 0.
        member: u64,
        /// Its mistakes.
        cause: String,
    },
    /// A journal is that of another ensemble.
    #[error("`{}` is the journal of another scene or other variations; remove it, or choose another folder", path.display())]
    OtherEnsemble {
        /// The journal.
        path: PathBuf,
    },
    /// Members are missing from the journals of a folder.
    #[error(
        "{missing} of {members} members are not computed yet, as member {first}; run the missing parts, or continue with --resume"
    )]
    Missing {
        /// How many.
        missing: u64,
        /// Of how many.
        members: u64,
        /// The first of them.
        first: u64,
    },
    /// A journal cannot be read or written.
    #[error("the journal `{}` cannot be used: {cause}", path.display())]
    Journal {
        /// The journal.
        path: PathBuf,
        /// The operating system's word.
        cause: String,
    },
    /// A process of several cannot begin or cannot go on.
    #[error("process {rank} of the run: {cause}")]
    Process {
        /// Which, from 0.
        rank: usize,
        /// Its word.
        cause: String,
    },
    /// The table of members cannot be written as Parquet.
    #[error("the table of members cannot be written as Parquet: {cause}; valid: the table as CSV")]
    Parquet {
        /// The word of the writer.
        cause: String,
    },
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The results cannot be written.
    #[error(transparent)]
    Charts(#[from] ChartsError),
}
