//! Parses a number in a table: decimal, with a point, finite. Errors name what was found, and what was probably meant.

/// The unit of the wavelengths in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Micrometres, as on refractiveindex.info.
    Um,
    /// Nanometres.
    Nm,
}

/// A finite number, or what is wrong with its text.
pub fn finite(token: &str) -> Result<f64, String> {
    match token.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(format!("`{}` is not a finite number", clipped(token))),
        Err(_) => {
            let suggestion = likely_number(token)
                .map(|number| format!("; did you mean {}?", clipped(&number)))
                .unwrap_or_default();
            Err(format!("`{}` is no number{suggestion}", clipped(token)))
        }
    }
}

/// A wavelength in nanometres, above 0. Micrometres are converted in decimal: 0.2261 becomes 226.1, which
/// 0.2261 * 1000.0 is not.
pub fn nm(token: &str, unit: Unit) -> Result<f64, String> {
    let number = finite(token)?;
    let nm = match unit {
        Unit::Nm => number,
        Unit::Um => thousandfold(token).unwrap_or(number * 1000.0),
    };
    if nm > 0.0 && nm.is_finite() {
        Ok(nm)
    } else {
        Err(format!(
            "the wavelength is {}; it must be above 0",
            clipped(token)
        ))
    }
}

/// A number's text with its exponent raised by three.
fn thousandfold(token: &str) -> Option<f64> {
    let shifted = match token.split_once(['e', 'E']) {
        None => format!("{token}e3"),
        Some((digits, exponent)) => {
            let exponent: i32 = exponent.parse().ok()?;
            format!("{digits}e{}", exponent.saturating_add(3))
        }
    };
    shifted.parse().ok()
}

/// The number that was probably meant: with a comma for a point, or an exponent without its letter or with Fortran's.
fn likely_number(token: &str) -> Option<String> {
    let is_number = |text: &String| text.parse::<f64>().is_ok_and(f64::is_finite);
    let sign = token
        .char_indices()
        .skip(1)
        .find(|(_, c)| ['+', '-'].contains(c))
        .map(|(at, _)| at);
    let candidates = [
        Some(token.trim_matches([',', ';']).to_owned()),
        Some(token.replace(',', ".")),
        Some(token.replace(['d', 'D'], "e")),
        sign.map(|at| format!("{}e{}", &token[..at], &token[at..])),
    ];
    candidates.into_iter().flatten().find(is_number)
}

/// The beginning of an untrusted text, for a message.
pub fn clipped(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut start: String = text.chars().take(LONGEST).collect();
    if start.len() < text.len() {
        start.push_str("...");
    }
    start
}

/// A number for a message: five digits, with an exponent if it is small or large.
pub fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.4e}").parse().unwrap_or(number);
    if rounded != 0.0 && !(1e-4..1e15).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(token: &str, nanometres: f64) {
        assert_eq!(nm(token, Unit::Um), Ok(nanometres), "{token}");
    }

    #[test]
    fn micrometres_become_nanometres_in_their_decimals() {
        check("0.2261", 226.1);
        check("2.261E-01", 226.1);
        check("2.261e-1", 226.1);
        check(".3", 300.0);
        check("1", 1000.0);
        check("+1.", 1000.0);
        check("1e-5", 0.01);
        check("10000000", 1e10);
        assert_eq!(nm("226.1", Unit::Nm), Ok(226.1));
    }

    #[track_caller]
    fn refused(token: &str, says: &str) {
        let fault = nm(token, Unit::Um).expect_err("it is refused");
        assert_eq!(fault, says);
    }

    #[test]
    fn what_is_no_wavelength_says_what_was_meant() {
        refused("1.80-17", "`1.80-17` is no number; did you mean 1.80e-17?");
        refused("1.8D-17", "`1.8D-17` is no number; did you mean 1.8e-17?");
        refused("0,5", "`0,5` is no number; did you mean 0.5?");
        refused("0.5,", "`0.5,` is no number; did you mean 0.5?");
        refused("0.5x", "`0.5x` is no number");
        refused("", "`` is no number");
        refused("é-5", "`é-5` is no number");
        refused("nan", "`nan` is not a finite number");
        refused("-inf", "`-inf` is not a finite number");
        refused("1e999", "`1e999` is not a finite number");
        refused("0", "the wavelength is 0; it must be above 0");
        refused("-0.5", "the wavelength is -0.5; it must be above 0");
        refused("1e307", "the wavelength is 1e307; it must be above 0");
        refused(
            "1e-99999999999",
            "the wavelength is 1e-99999999999; it must be above 0",
        );
        let long = "x".repeat(100);
        refused(&long, &format!("`{}...` is no number", "x".repeat(40)));
    }

    #[test]
    fn messages_have_few_digits() {
        for (number, text) in [
            (2.834_567, "2.8346"),
            (-3.22e-17, "-3.22e-17"),
            (0.0, "0"),
            (400.0, "400"),
            (-1.0e155, "-1e155"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}
