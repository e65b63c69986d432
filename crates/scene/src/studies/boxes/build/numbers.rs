//! Lists of numbers with one for each axis.

use crate::model::Builder;
use crate::studies::boxes::AXES;
use piola_document::{Record, words};

/// More points or modes than this along an axis have no use.
const MOST: f64 = 1e9;

impl Builder<'_> {
    /// The numbers of a key, one for each side.
    pub(super) fn each_axis<const D: usize>(&mut self, record: &Record, key: &str) -> Option<[f64; D]> {
        let numbers = record.numbers(key)?;
        let found: Option<[f64; D]> = numbers.try_into().ok();
        if found.is_none() {
            let count = numbers.len();
            self.refuse(
                record.place_of(key),
                format!("`{key}` has {count} numbers in a [box] of {D} sides"),
                format!("a list of {D} numbers"),
            );
        }
        found
    }

    /// The whole numbers of a key, one for each side.
    pub(super) fn whole<const D: usize>(&mut self, record: &Record, key: &str) -> Option<[usize; D]> {
        let numbers: [f64; D] = self.each_axis(record, key)?;
        let is_whole = |x: &f64| (0.0..=MOST).contains(x) && x.fract().abs() <= 0.0;
        if numbers.iter().all(is_whole) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, from 0 to 1e9")]
            return Some(numbers.map(|x| x as usize));
        }
        self.refused(
            record.place_of(key),
            format!("`{key}` is {}", words::numbers(&numbers)),
            "whole numbers that are not negative",
        )
    }

    /// The place `at` of a table, which must be in the box.
    pub(super) fn place_in_box<const D: usize>(&mut self, record: &Record, sides: [f64; D]) -> Option<[f64; D]> {
        let place: [f64; D] = self.each_axis(record, "at")?;
        let Some(axis) = (0..D).find(|&axis| !(0.0..=sides[axis]).contains(&place[axis])) else {
            return Some(place);
        };
        self.refused(
            record.place_of("at"),
            format!("{} = {} m is outside of the box", AXES[axis], words::number(place[axis])),
            format!("from 0 m to {} m along {}", words::number(sides[axis]), AXES[axis]),
        )
    }
}

/// Indices or numbers of points: `[3, 4]`.
pub(super) fn in_words(numbers: &[usize]) -> String {
    format!("{numbers:?}")
}
