//! The stability sheet's bounds hold.

use piola_benches::stability::tables;

#[test]
fn rounding_at_adversarial_inputs_stays_within_the_bounds_of_the_sheet() {
    for table in tables(20_000).expect("no input is refused") {
        let exceeding: Vec<_> = table.exceeding().collect();
        assert!(exceeding.is_empty(), "{}: {exceeding:#?}", table.title);
        assert!(!table.rows.is_empty(), "{}", table.title);
    }
}
