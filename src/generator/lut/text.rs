//! Text formats: the bits of binary16 as arrays, for engines that cannot read a float texture. RGBA with an alpha of 1, ready for
//! upload as RGBA16F, one texel per line.

use super::picture::Picture;
use crate::generator::emit::comment_lines;

/// A C header, for C99 and C++.
pub fn c(picture: &Picture) -> String {
    let (name, loud, length) = names(picture);
    format!(
        "{}#ifndef {loud}_H\n#define {loud}_H\n\n#include <stdint.h>\n\n#define {loud}_WIDTH {}\n#define {loud}_HEIGHT {}\n\n\
         static const uint16_t {name}[{length}] = {{\n{}}};\n\n#endif\n",
        comments(picture),
        picture.width,
        picture.height(),
        texels(picture)
    )
}

/// Rust.
pub fn rust(picture: &Picture) -> String {
    let (_, loud, length) = names(picture);
    format!(
        "{}\npub const {loud}_WIDTH: usize = {};\npub const {loud}_HEIGHT: usize = {};\n\n\
         #[rustfmt::skip]\npub static {loud}: [u16; {length}] = [\n{}];\n",
        comments(picture),
        picture.width,
        picture.height(),
        texels(picture)
    )
}

/// A JavaScript module.
pub fn js(picture: &Picture) -> String {
    let (name, _, _) = names(picture);
    format!(
        "{}\nexport const {name}_width = {};\nexport const {name}_height = {};\n\n\
         export const {name} = new Uint16Array([\n{}]);\n",
        comments(picture),
        picture.width,
        picture.height(),
        texels(picture)
    )
}

/// The array's name, its name in capitals, and its length.
fn names(picture: &Picture) -> (String, String, usize) {
    let name = format!("fresnel_table_{}", picture.name);
    let loud = name.to_uppercase();
    (name, loud, 4 * picture.texels.len())
}

fn comments(picture: &Picture) -> String {
    let lines = comment_lines(picture.about.clone());
    lines.iter().map(|line| format!("// {line}\n")).collect()
}

fn texels(picture: &Picture) -> String {
    let line = |bits: [u16; 4]| {
        let [r, g, b, a] = bits.map(|bits| format!("0x{bits:04x}"));
        format!("    {r}, {g}, {b}, {a},\n")
    };
    picture.half_bits().map(line).collect()
}
