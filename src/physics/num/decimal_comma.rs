//! Numbers with a decimal comma, as many languages write them. Here a comma separates numbers.

/// The message for a refused word such as `1,5`, or `0,9,0,8,0,7` where three numbers are wanted.
pub const POINT_NOT_COMMA: &str = "decimals stand behind a point, not a comma: 1.5, not 1,5";

/// Whether a word reads as one or three numbers with decimal commas, with digits on both sides of each comma.
pub fn has_decimal_commas(word: &str) -> bool {
    let parts: Vec<&str> = word.trim_start_matches('-').split(',').collect();
    let is_whole = |part: &&str| !part.is_empty() && part.bytes().all(|c| c.is_ascii_digit());
    [2, 6].contains(&parts.len()) && parts.iter().all(is_whole)
}

#[cfg(test)]
mod tests {
    use super::has_decimal_commas;

    #[test]
    fn a_comma_between_digits_is_one() {
        for word in ["1,5", "-0,25", "0,9,0,8,0,7"] {
            assert!(has_decimal_commas(word), "{word}");
        }
        for word in [
            "1.5",
            "1,5,2",
            ",5",
            "1,",
            "a,5",
            "1.0,5",
            "0.9,0.8,0.7",
            "",
        ] {
            assert!(!has_decimal_commas(word), "{word}");
        }
    }
}
