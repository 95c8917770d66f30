//! The words and the instructions of a module of SPIR-V. Source: Khronos Group, *SPIR-V Specification*, version 1.6, 2021, sections
//! 2.3, 3.3 and 3.42.5, <https://registry.khronos.org/SPIR-V/specs/unified1/SPIRV.html>.

/// The first word of every module.
pub(super) const MAGIC: u32 = 0x0723_0203;
/// The number of words before the first instruction.
pub(super) const HEADER: usize = 5;
/// The instruction that names an entry point: execution model, function, name, variables.
pub const ENTRY_POINT: u32 = 15;
const GL_COMPUTE: u32 = 5;

/// The words of a module's bytes.
pub fn words(bytes: &[u8]) -> Vec<u32> {
    bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

/// Each instruction with its operands. Each states its own length.
pub fn instructions(words: &[u32]) -> impl Iterator<Item = (u32, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let first = *words.get(at)?;
        let length = (first >> 16).max(1) as usize;
        let operands = words.get(at + 1..at + length).unwrap_or_default();
        at += length;
        Some((first & 0xFFFF, operands))
    })
}

/// A string: four bytes a word, up to a zero.
pub fn literal(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let name: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&name).into_owned()
}

/// The names of the compute entry points.
pub(super) fn compute_entries(words: &[u32]) -> Vec<String> {
    let name = |(code, operands): (u32, &[u32])| match operands {
        [GL_COMPUTE, _, name @ ..] if code == ENTRY_POINT => Some(literal(name)),
        _ => None,
    };
    instructions(words).filter_map(name).collect()
}
