//! Journals: each computed member is a line, so that a killed ensemble goes on where it was.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};

use crate::{Ensemble, EnsembleError, Member, Portion};

/// A journal that is open for writing. Its first line tells the ensemble.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
}

/// The beginning and the end of the names of journals.
const NAME: [&str; 2] = ["members-", ".journal"];

/// Where a part of an ensemble writes.
fn path_of(folder: &Path, part: Portion) -> PathBuf {
    folder.join(format!("{}{}-of-{}{}", NAME[0], part.number, part.parts, NAME[1]))
}

fn refused(path: &Path, cause: &std::io::Error) -> EnsembleError {
    EnsembleError::Journal { path: path.to_path_buf(), cause: cause.to_string() }
}

impl Journal {
    /// Opens the journal of a part: anew, or with what a run before wrote.
    pub(crate) fn open(folder: &Path, ensemble: &Ensemble, part: Portion, resume: bool) -> Result<Self, EnsembleError> {
        let path = path_of(folder, part);
        let whole = if resume && path.exists() { whole_lines(&path, ensemble)?.1 } else { 0 };
        let open = || {
            let mut file = OpenOptions::new().create(true).truncate(false).write(true).open(&path)?;
            // What follows is a line that was being written when the program was killed.
            file.set_len(whole)?;
            if whole == 0 {
                file.write_all(format!("{}\n", ensemble.identity()).as_bytes())?;
            }
            drop(file);
            OpenOptions::new().append(true).open(&path)
        };
        let file = open().map_err(|cause| refused(&path, &cause))?;
        Ok(Self { path, file })
    }

    /// Adds a member, in one piece.
    pub(crate) fn add(&mut self, member: &Member) -> Result<(), EnsembleError> {
        let line = serde_json::to_string(member).unwrap_or_default();
        self.file.write_all(format!("{line}\n").as_bytes()).map_err(|cause| refused(&self.path, &cause))
    }
}

/// The members of a journal, and the length of its whole lines in bytes.
fn whole_lines(path: &Path, ensemble: &Ensemble) -> Result<(Vec<Member>, u64), EnsembleError> {
    let read = || {
        let mut lines = Vec::new();
        let (mut reader, mut length) = (BufReader::new(File::open(path)?), 0_u64);
        loop {
            let mut line = String::new();
            let bytes = reader.read_line(&mut line)?;
            if bytes == 0 || !line.ends_with('\n') {
                return Ok((lines, length));
            }
            length += bytes as u64;
            lines.push((line, length));
        }
    };
    let (lines, _) = read().map_err(|cause: std::io::Error| refused(path, &cause))?;
    let mut lines = lines.into_iter();
    let Some((first, mut length)) = lines.next() else { return Ok((Vec::new(), 0)) };
    if first.trim_end() != ensemble.identity() {
        return Err(EnsembleError::OtherEnsemble { path: path.to_path_buf() });
    }
    let mut members = Vec::new();
    for (line, end) in lines {
        // A line that was changed is as one that was never written.
        let Some(member) = serde_json::from_str(&line).ok().filter(|member| ensemble.has(member)) else { break };
        members.push(member);
        length = end;
    }
    Ok((members, length))
}

/// All members that stand in the journals of a folder.
pub(crate) fn collected(folder: &Path, ensemble: &Ensemble) -> Result<BTreeMap<u64, Member>, EnsembleError> {
    let entries = std::fs::read_dir(folder).map_err(|cause| refused(folder, &cause))?;
    let is_journal = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        name.is_some_and(|name| name.starts_with(NAME[0]) && name.ends_with(NAME[1]))
    };
    let mut members = BTreeMap::new();
    for path in entries.flatten().map(|entry| entry.path()).filter(is_journal) {
        members.extend(whole_lines(&path, ensemble)?.0.into_iter().map(|member| (member.member, member)));
    }
    Ok(members)
}
