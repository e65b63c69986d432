//! The usual spellings of units.

use super::{Dimension, Unit, UnitError};

/// Spellings that are not products of names.
const WHOLE: [(&str, &str); 36] = [
    ("%", "%"),
    ("percent", "%"),
    ("Pas", "Pa s"),
    ("mPas", "mPa s"),
    ("kPas", "kPa s"),
    ("Nm", "N m"),
    ("mNm", "mN m"),
    ("uNm", "uN m"),
    ("µNm", "uN m"),
    ("μNm", "uN m"),
    ("nNm", "nN m"),
    ("Ncm", "N cm"),
    ("Nmm", "N mm"),
    ("mNmm", "mN mm"),
    ("sec", "s"),
    ("reciprocal seconds", "1/s"),
    ("reciprocal second", "1/s"),
    ("per second", "1/s"),
    ("cc", "cm^3"),
    ("ccm", "cm^3"),
    ("cc/s", "cm^3/s"),
    ("cc/min", "cm^3/min"),
    ("degrees", "deg"),
    ("degree", "deg"),
    ("r/min", "rpm"),
    ("U/min", "rpm"),
    ("rev/min", "rpm"),
    ("Mpa", "MPa"),
    ("kpa", "kPa"),
    ("KPa", "kPa"),
    ("pa", "Pa"),
    ("PA", "Pa"),
    ("Lbf", "lbf"),
    ("centipoises", "cP"),
    ("cp", "cP"),
    ("dimensionless", ""),
];

/// The unit of a text in one of the spellings that instruments, spreadsheets and people use: `mPa.s`, `mPas`, `s-1`, `dyn/cm2`,
/// `lbf/100 ft²`, `µNm`, `Mpa`.
///
/// # Errors
/// [`UnitError`], as parsing a [`Unit`] from the text.
///
/// # Example
/// ```
/// use piola_document::units::spelled;
/// assert_eq!(spelled("N/mm²")?, "MPa".parse()?);
/// assert!(spelled("MPb").is_err());
/// # Ok::<(), piola_document::units::UnitError>(())
/// ```
pub fn spelled(text: &str) -> Result<Unit, UnitError> {
    let text = text.trim();
    if let Some(unit) = hundred_square_feet(text) {
        return Ok(unit);
    }
    let whole = WHOLE.iter().find(|(spelling, _)| *spelling == text).map_or(text, |(_, standard)| *standard);
    if whole == "%" {
        return Ok(Unit { numerator: 1.0, denominator: 100.0, dimension: Dimension::NONE });
    }
    if whole == "-" {
        return Ok(Unit::ONE);
    }
    let first = whole.parse::<Unit>();
    match first {
        Ok(unit) => Ok(unit),
        Err(error) => rewritten(whole).parse().map_err(|_| error),
    }
}

/// Pounds on a hundred square feet, the unit of oilfield viscometers.
fn hundred_square_feet(text: &str) -> Option<Unit> {
    let rest = text.strip_prefix("lbf").or_else(|| text.strip_prefix("lb"))?.trim_start();
    let rest: String = rest.strip_prefix('/')?.chars().filter(|c| !c.is_whitespace()).collect();
    let is_area =
        matches!(rest.as_str(), "100ft²" | "100ft2" | "100ft^2" | "100sqft" | "(100ft²)" | "(100ft2)" | "(100ft^2)");
    let pound: Unit = "lbf/ft^2".parse().ok()?;
    is_area.then_some(Unit { denominator: 100.0 * pound.denominator, ..pound })
}

/// With signs of products between names, powers after them, and whole spellings for each factor.
fn rewritten(text: &str) -> String {
    let mut out = String::new();
    let mut factor = String::new();
    let flush = |factor: &mut String, out: &mut String| {
        let whole = WHOLE.iter().find(|(spelling, _)| spelling == factor).map_or(factor.as_str(), |(_, unit)| *unit);
        let needs_brackets = whole.contains([' ', '/']) && out.trim_end().ends_with('/');
        let [open, close] = if needs_brackets { ["(", ")"] } else { [""; 2] };
        for part in [open, whole, close] {
            out.push_str(part);
        }
        factor.clear();
    };
    let letters: Vec<char> = text.chars().collect();
    let is_letter = |c: Option<&char>| c.is_some_and(|c| c.is_alphabetic());
    for (k, &c) in letters.iter().enumerate() {
        let (before, after) = (if 0 < k { letters.get(k - 1) } else { None }, letters.get(k + 1));
        match c {
            // Pa.s, Pa-s, Pa·s
            '.' | '-' | '·' | '⋅' | '×' | '*' if is_letter(before) && is_letter(after) => {
                flush(&mut factor, &mut out);
                out.push('*');
            }
            // s-1, and s^-1 as it stands
            '-' | '−' if is_letter(before) => {
                flush(&mut factor, &mut out);
                out.push_str("^-");
            }
            // cm2
            '0'..='9' if is_letter(before) => {
                flush(&mut factor, &mut out);
                out.push('^');
                out.push(c);
            }
            c if c.is_alphabetic() || c == '°' => factor.push(c),
            c => {
                flush(&mut factor, &mut out);
                out.push(c);
            }
        }
    }
    flush(&mut factor, &mut out);
    if out.starts_with('/') { format!("1{out}") } else { out }
}
