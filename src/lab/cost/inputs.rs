//! How many numbers a material takes by a method: what an engine stores for it, and hands to each call.

use crate::language::ir::Ty;
use crate::language::methods::Method;

/// The numbers that a call of a method's library function takes beside the cosine: three of each colour or index. A texture is none.
pub fn input_numbers(method: &Method) -> usize {
    let numbers = |ty| match ty {
        Ty::Rgb => 3,
        Ty::Scalar => 1,
        _ => 0,
    };
    method.inputs.iter().map(|input| numbers(input.ty)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    #[test]
    fn colours_and_indices_are_three_numbers() {
        for (method, numbers) in [
            ("schlick", 3),
            ("schlick_f90", 4),
            ("f82_tint", 6),
            ("fitted", 12),
            ("dielectric_exact", 3),
            ("conductor_exact", 6),
        ] {
            assert_eq!(find(method).map(input_numbers), Some(numbers), "{method}");
        }
    }
}
