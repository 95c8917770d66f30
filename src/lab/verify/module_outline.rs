//! The outline of a module of SPIR-V: its entry points, its variables with their bindings, the number of its functions, and what it
//! asks of a device. A module that somebody may have edited is compared by it with what would be written.

use super::outline::Item;
use crate::lab::gpu::spirv::{ENTRY_POINT, instructions, literal, words};

/// Instructions of SPIR-V 1.3, chapter 3.52: <https://registry.khronos.org/SPIR-V/specs/unified1/SPIRV.html>.
const NAME: u32 = 5;
const EXTENSION: u32 = 10;
const EXECUTION_MODE: u32 = 16;
const CAPABILITY: u32 = 17;
const FUNCTION: u32 = 54;
const VARIABLE: u32 = 59;
const DECORATE: u32 = 71;
const MEMBER_DECORATE: u32 = 72;
const LOOP_MERGE: u32 = 246;
/// Decorations, chapter 3.20.
const RELAXED_PRECISION: u32 = 0;
const LOCATION: u32 = 30;
const BINDING: u32 = 33;
const DESCRIPTOR_SET: u32 = 34;
/// The storage class of a function's local variables, chapter 3.7.
const LOCAL: u32 = 7;

/// What a module declares, in words. No item has a line.
pub fn declarations(bytes: &[u8]) -> Vec<Item> {
    let words = words(bytes);
    let declared = instructions(&words).filter_map(|(code, of)| declaration(code, of, &words));
    declared.map(|words| Item { line: 0, words }).collect()
}

/// The loops of a module.
pub fn loops(bytes: &[u8]) -> Vec<Item> {
    let words = words(bytes);
    let found = instructions(&words).filter(|(code, _)| *code == LOOP_MERGE);
    let item = |_| Item {
        line: 0,
        words: "OpLoopMerge".to_owned(),
    };
    found.map(item).collect()
}

/// All debug names of a module; functions are among them.
pub fn names(bytes: &[u8]) -> Vec<String> {
    let words = words(bytes);
    let named = instructions(&words).filter(|(code, _)| *code == NAME);
    named
        .map(|(_, of)| literal(of.get(1..).unwrap_or_default()))
        .collect()
}

/// The entry points of a module, by name.
pub fn entry_points(bytes: &[u8]) -> Vec<String> {
    let words = words(bytes);
    let name = |(code, operands): (u32, &[u32])| match operands {
        [_, _, name @ ..] if code == ENTRY_POINT => Some(literal(name)),
        _ => None,
    };
    instructions(&words).filter_map(name).collect()
}

fn declaration(instruction: u32, operands: &[u32], words: &[u32]) -> Option<String> {
    Some(match (instruction, operands) {
        (CAPABILITY, [which, ..]) => format!("capability {which}"),
        (EXTENSION, name) => format!("extension {}", literal(name)),
        (ENTRY_POINT, [model, _, name @ ..]) => {
            format!(
                "the entry point {} of execution model {model}",
                literal(name)
            )
        }
        (EXECUTION_MODE, [_, mode @ ..]) => format!("execution mode {mode:?}"),
        (FUNCTION, _) => "a function".to_owned(),
        (DECORATE, [_, RELAXED_PRECISION]) | (MEMBER_DECORATE, [_, _, RELAXED_PRECISION]) => {
            "a number of relaxed precision".to_owned()
        }
        (VARIABLE, [_, id, class, ..]) if *class != LOCAL => {
            format!("a variable of storage class {class}{}", place(*id, words))
        }
        _ => return None,
    })
}

/// Where a variable is bound.
fn place(id: u32, words: &[u32]) -> String {
    let named = [
        (DESCRIPTOR_SET, "set"),
        (BINDING, "binding"),
        (LOCATION, "location"),
    ];
    let of = |(decoration, name): (u32, &str)| {
        let is_it = |window: &&[u32]| window[..3] == [4 << 16 | DECORATE, id, decoration];
        let found = words.windows(4).find(is_it)?;
        Some(format!(", {name} {}", found[3]))
    };
    named.into_iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bindings_and_entry_points_are_seen() {
        let name = u32::from_le_bytes(*b"main");
        let words: Vec<u32> = [
            &[0x0723_0203, 0x1_0300, 0, 9, 0][..],
            &[2 << 16 | CAPABILITY, 1],
            &[5 << 16 | ENTRY_POINT, 5, 2, name, 0],
            &[4 << 16 | DECORATE, 3, DESCRIPTOR_SET, 0],
            &[4 << 16 | DECORATE, 3, BINDING, 7],
            &[4 << 16 | VARIABLE, 1, 3, 12],
            &[4 << 16 | VARIABLE, 1, 4, LOCAL],
        ]
        .concat();
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let found: Vec<String> = declarations(&bytes)
            .into_iter()
            .map(|item| item.words)
            .collect();
        let expected = [
            "capability 1",
            "the entry point main of execution model 5",
            "a variable of storage class 12, set 0, binding 7",
        ];
        assert_eq!(found, expected);
        assert_eq!(entry_points(&bytes), ["main"]);
    }
}
