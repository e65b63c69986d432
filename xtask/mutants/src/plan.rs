//! Which operators are changed, and how.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::draw::shuffle;
use crate::files::read;
use crate::sites::{Bytes, Change, Site, of_crate};

/// The mutants of one crate.
pub(crate) struct Plan {
    /// `kinematics`
    pub(crate) folder: String,
    /// `piola-kinematics`
    pub(crate) package: String,
    /// The numbers of its mutants begin after it, whatever the other crates draw.
    first: u32,
    /// In the order of the draw.
    candidates: Vec<Candidate>,
}

struct Candidate {
    site: Site,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Waiting,
    Chosen(Change),
    Refused,
}

/// A change that compiles.
#[derive(Clone)]
pub(crate) struct Mutant {
    pub(crate) number: u32,
    pub(crate) site: Site,
    pub(crate) change: Change,
}

/// Numbers of one crate.
const BLOCK: u32 = 1 << 16;

impl Plan {
    /// The draw; `index` is the crate's among all of the project.
    pub(crate) fn new(root: &Path, folder: &str, package: &str, index: u32, seed: u64) -> Result<Self, String> {
        let sites = shuffle(of_crate(root, &format!("crates/{folder}/src"))?, seed);
        if BLOCK as usize <= sites.len() {
            return Err(format!("{folder} has too many operators for their numbers"));
        }
        let candidates = sites.into_iter().map(|site| Candidate { site, state: State::Waiting }).collect();
        Ok(Self { folder: folder.to_owned(), package: package.to_owned(), first: (index + 1) * BLOCK, candidates })
    }

    /// How many operators the crate has.
    pub(crate) fn operators(&self) -> usize {
        self.candidates.len()
    }

    /// Chooses the next candidates until there are `sample`; none within another.
    pub(crate) fn fill(&mut self, sample: usize) {
        let mut chosen = self.mutants();
        for candidate in &mut self.candidates {
            if sample <= chosen.len() {
                break;
            }
            let site = &candidate.site;
            let is_free = chosen
                .iter()
                .all(|other| other.site.file != site.file || !other.site.expression.overlaps(site.expression));
            if candidate.state == State::Waiting && is_free {
                candidate.state = State::Chosen(Change::Inverse);
                chosen.push(Mutant { number: 0, site: site.clone(), change: Change::Inverse });
            }
        }
    }

    /// In order of the text.
    pub(crate) fn mutants(&self) -> Vec<Mutant> {
        let mut mutants: Vec<_> = (self.first..)
            .zip(&self.candidates)
            .filter_map(|(number, candidate)| match candidate.state {
                State::Chosen(change) => Some(Mutant { number, site: candidate.site.clone(), change }),
                State::Waiting | State::Refused => None,
            })
            .collect();
        mutants.sort_by(|a, b| a.site.cmp(&b.site));
        mutants
    }

    /// Whether the number is of a candidate of this crate.
    pub(crate) fn holds(&self, number: u32) -> bool {
        self.index(number) < self.candidates.len()
    }

    /// Takes note that a change does not compile: another is tried, or none.
    pub(crate) fn refuse(&mut self, number: u32) {
        let index = self.index(number);
        let Some(candidate) = self.candidates.get_mut(index) else { return };
        if let State::Chosen(change) = candidate.state {
            candidate.state = candidate.site.sign.after(change).map_or(State::Refused, State::Chosen);
        }
    }

    fn index(&self, number: u32) -> usize {
        number.checked_sub(self.first).map_or(usize::MAX, |index| index as usize)
    }
}

/// Texts with all mutants in them, and where each one stands in its text.
pub(crate) struct Rendered {
    pub(crate) texts: BTreeMap<String, String>,
    pub(crate) places: BTreeMap<String, Vec<(u32, Bytes)>>,
}

const SWITCH: &str = include_str!("../switch.rs");

impl Rendered {
    pub(crate) fn new(root: &Path, plans: &[Plan]) -> Result<Self, String> {
        let (mut texts, mut places) = (BTreeMap::new(), BTreeMap::new());
        for plan in plans {
            let library = format!("crates/{}/src/lib.rs", plan.folder);
            let mutants = plan.mutants();
            let mut files: BTreeSet<_> = mutants.iter().map(|mutant| mutant.site.file.clone()).collect();
            files.insert(library.clone());
            for file in files {
                let text = read(&root.join(&file))?;
                let inside: Vec<_> = mutants.iter().filter(|mutant| mutant.site.file == file).collect();
                let (mut text, found) = switched(&text, &inside);
                if file == library {
                    text.push_str("\nmod mutant_switch;\n");
                }
                texts.insert(file.clone(), text);
                places.insert(file, found);
            }
            texts.insert(format!("crates/{}/src/mutant_switch.rs", plan.folder), SWITCH.to_owned());
        }
        Ok(Self { texts, places })
    }
}

/// The text with mutants, which are in its order, and the place of each.
fn switched(text: &str, mutants: &[&Mutant]) -> (String, Vec<(u32, Bytes)>) {
    let (mut out, mut places, mut at) = (String::with_capacity(text.len()), Vec::new(), 0);
    for mutant in mutants {
        out.push_str(&text[at..mutant.site.expression.start]);
        let start = out.len();
        out.push_str(&mutant.site.switched(text, mutant.number, mutant.change));
        places.push((mutant.number, Bytes { start, end: out.len() }));
        at = mutant.site.expression.end;
    }
    out.push_str(&text[at..]);
    (out, places)
}
