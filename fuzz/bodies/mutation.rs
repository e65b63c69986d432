//! Texts that are nearly those of a corpus, from a seeded generator.

use std::path::Path;

/// The files of a folder, in the order of their names.
pub(super) fn corpus(folder: &Path) -> Vec<Vec<u8>> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<_> = entries.filter_map(Result::ok).map(|entry| entry.path()).collect();
    paths.sort();
    paths.into_iter().filter_map(|path| std::fs::read(path).ok()).collect()
}

/// Runs a body over a corpus and over `count` texts made from it. Returns how many of these the body has accepted.
pub(super) fn over(corpus: &[Vec<u8>], count: usize, tokens: &[&str], body: impl Fn(&[u8]) -> bool) -> usize {
    for text in corpus {
        body(text);
    }
    let mut accepted = 0;
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..count {
        let mut text = corpus[random.below(corpus.len())].clone();
        for _ in 0..=random.below(4) {
            random.change(&mut text, corpus, tokens);
        }
        accepted += usize::from(body(&text));
    }
    accepted
}

/// Steele, Lea and Flood's generator of 2014.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() >> 1).unwrap_or_default() % bound.max(1)
    }

    fn change(&mut self, text: &mut Vec<u8>, corpus: &[Vec<u8>], tokens: &[&str]) {
        let at = self.below(text.len() + 1);
        let end = (at + self.below(40)).min(text.len());
        match self.below(7) {
            0 => drop(text.drain(at..end)),
            1 => {
                let copy = text[at..end].to_vec();
                let to = self.below(text.len() + 1);
                text.splice(to..to, copy);
            }
            2 if at < text.len() => text[at] ^= 1 << self.below(7),
            3 => {
                // A piece of another text.
                let other = &corpus[self.below(corpus.len())];
                let from = self.below(other.len() + 1);
                let to = (from + self.below(60)).min(other.len());
                text.splice(at..end, other[from..to].iter().copied());
            }
            4 => text.truncate(at),
            5 => {
                // One number for another.
                let digits: Vec<usize> = (0..text.len()).filter(|i| text[*i].is_ascii_digit()).collect();
                if let Some(&digit) = digits.get(self.below(digits.len())) {
                    let number = ["0", "-1", "1e308", "5e-324", "1e999", "9007199254740993", "nan"][self.below(7)];
                    text.splice(digit..=digit, number.bytes());
                }
            }
            _ => {
                let token = tokens[self.below(tokens.len())];
                text.splice(at..at, token.bytes());
            }
        }
    }
}
