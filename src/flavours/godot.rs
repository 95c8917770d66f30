//! Godot 4: functions for its shading language, as files to be included.

use super::flavour::{Flavour, FlavourPage};

/// The record of this flavour.
pub static FLAVOUR: Flavour = Flavour {
    name: "godot",
    summary: "include files of the shading language",
    host: "Godot 4",
    source: "https://docs.godotengine.org/en/stable/tutorials/shaders/shader_reference/shading_language.html",
    proof: "compiled by glslang in a program with Godot's rules, not run",
    languages: &["gles"],
    table: None,
    pages: &[FlavourPage {
        name: "{material}.gdshaderinc",
        template: include_str!("../../templates/flavours/godot/material.gdshaderinc.tera"),
    }],
};
