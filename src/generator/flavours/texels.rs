//! A split-sum table as a text of a script: a letter for each number, which compresses to a seventh of its half floats.
//!
//! Each channel is a plane, row by row, of whole numbers of steps. A letter says by how many steps a number differs from left + above -
//! above left, its prediction from neighbours: the code [`NONE`] says 0. Differences without a letter of ASCII are beyond [`FAR`].
//! JavaScript reads them back in `templates/flavours/materials.js.tera`.
//!
//! Source of the prediction: Weinberger, Seroussi and Sapiro, "The LOCO-I lossless image compression algorithm", IEEE Transactions on
//! Image Processing 9, 2000, <https://doi.org/10.1109/83.855427>, of which it is the plane without edges.

/// The code of a difference of 0.
const NONE: i32 = 76;
/// The code of a difference of 0 that is not between -44 and 50.
const FAR: i32 = 0x5000;

/// How many steps there are from 0 to 1. With 2048 a number errs by at most 1/4096, as half precision does from .5 on. Materials' numbers
/// for orthogonal functions are larger, so that these have finer steps: half precision from .5 on, and within 1/8192 below.
pub(super) fn steps_of_one(is_orthogonal: bool) -> u32 {
    if is_orthogonal { 4096 } else { 2048 }
}

/// A value in steps, where half precision has it: it has 11 significant bits.
fn in_steps(value: f64, of_one: u32) -> i32 {
    let near = (value * f64::from(of_one)).round();
    match near.abs() > 2048.0 {
        true => 2 * (value * f64::from(of_one / 2)).round() as i32,
        false => near as i32,
    }
}

/// Planes of a width, one after the other.
pub(super) fn table_text(planes: &[Vec<f64>], width: usize, of_one: u32) -> String {
    let letters = planes.iter().flat_map(|plane| {
        let steps: Vec<i32> = plane.iter().map(|value| in_steps(*value, of_one)).collect();
        let letter = |i: usize| {
            let near = near(&steps, i, width);
            letter(steps[i] - near)
        };
        (0..plane.len()).map(letter).collect::<Vec<char>>()
    });
    letters.collect()
}

/// What the neighbours before a place say.
fn near(steps: &[i32], i: usize, width: usize) -> i32 {
    let at = |is_there: bool, back: usize| if is_there { steps[i - back] } else { 0 };
    let (left, above) = (!i.is_multiple_of(width), i >= width);
    at(left, 1) + at(above, width) - at(left && above, width + 1)
}

fn letter(difference: i32) -> char {
    let code = match difference {
        -44..=50 => NONE + difference,
        _ => FAR + difference,
    };
    // Differences are at most 4 times 4096, from -1 to 1 three times.
    u32::try_from(code)
        .ok()
        .and_then(char::from_u32)
        .unwrap_or(char::REPLACEMENT_CHARACTER)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As materials.js has it.
    fn read(text: &str, width: usize, size: usize) -> Vec<Vec<i32>> {
        let codes: Vec<i32> = text.chars().map(|letter| letter as i32).collect();
        let plane = |codes: &[i32]| {
            let mut plane: Vec<i32> = Vec::new();
            for code in codes {
                let i = plane.len();
                let base = if *code < 128 { NONE } else { FAR };
                plane.push(near(&plane, i, width) + code - base);
            }
            plane
        };
        codes.chunks(size).map(plane).collect()
    }

    #[test]
    fn a_text_is_read_back() {
        let planes = vec![
            vec![1.0, 0.25, -1.0, 0.0, -0.3, 1.0],
            vec![-1.0, 1.0, -1.0, 1.0, -1.0, 1.0],
        ];
        let text = table_text(&planes, 3, 4096);
        assert_eq!(text.chars().count(), 12);
        let steps = |plane: &Vec<f64>| plane.iter().map(|value| in_steps(*value, 4096)).collect();
        let want: Vec<Vec<i32>> = planes.iter().map(steps).collect();
        assert_eq!(read(&text, 3, 6), want);
        assert_eq!(want[0][..3], [4096, 1024, -4096]);
    }
}
