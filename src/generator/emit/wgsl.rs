//! naga at work: WGSL parsed and validated in process, and lowered to SPIR-V.

use naga::back::spv;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

/// Parses and validates a module; on failure says what naga said, with the line.
///
/// # Errors
/// The text is not valid WGSL.
pub fn validate(text: &str) -> Result<(naga::Module, ModuleInfo), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    // f16 is there for files that say `enable f16;`, and for no others.
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::SHADER_FLOAT16);
    let info = validator
        .validate(&module)
        .map_err(|error| error.emit_to_string(text))?;
    Ok((module, info))
}

/// Lowers a module to SPIR-V 1.3, with names for people who read it, as little-endian bytes.
pub fn spirv(text: &str) -> Result<Vec<u8>, String> {
    Ok(bytes(&without_storage(&words(text)?)))
}

/// The same for a module that keeps 16-bit numbers in buffers.
///
/// # Errors
/// The text is not valid WGSL, or naga cannot write SPIR-V of it.
pub fn spirv_with_storage(text: &str) -> Result<Vec<u8>, String> {
    Ok(bytes(&words(text)?))
}

fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn words(text: &str) -> Result<Vec<u32>, String> {
    let (module, info) = validate(text)?;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG | spv::WriterFlags::LABEL_VARYINGS,
        use_storage_input_output_16: false,
        ..Default::default()
    };
    spv::write_vec(&module, &info, &options, None).map_err(|error| error.to_string())
}

/// Without the capabilities to hold 16-bit numbers in buffers, which naga adds as soon as anything computes with them: our
/// modules hold them in registers only, and a device that lacks it can run them all the same.
fn without_storage(words: &[u32]) -> Vec<u32> {
    const HEAD: usize = 5;
    const EXTENSION: u32 = 10;
    const CAPABILITY: u32 = 17;
    const STORAGE: [u32; 2] = [4433, 4434];
    let mut kept = words[..HEAD.min(words.len())].to_vec();
    let mut rest = &words[kept.len()..];
    while let Some(first) = rest.first() {
        let length = ((first >> 16) as usize).clamp(1, rest.len());
        let (instruction, after) = rest.split_at(length);
        let is_storage = match first & 0xffff {
            CAPABILITY => STORAGE.contains(&instruction[length - 1]),
            EXTENSION => literal(&instruction[1..]) == "SPV_KHR_16bit_storage",
            _ => false,
        };
        if !is_storage {
            kept.extend(instruction);
        }
        rest = after;
    }
    kept
}

/// A string of SPIR-V, which ends in a zero.
fn literal(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let text = bytes.take_while(|byte| *byte != 0).map(char::from);
    text.collect()
}
