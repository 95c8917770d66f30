//! The contents of a format's file: nodes with named numbers.

use super::engine_material::{EngineMaterial, rounded};
use super::model::Model;
use crate::generator::fit::rounded_up;

/// A material in a format.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The nodes: shaders or materials, each complete in itself.
    pub nodes: Vec<Node>,
    /// What was clamped or left out.
    pub remarks: Vec<String>,
}

/// A shader or a material of a format.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its name in the format.
    pub name: &'static str,
    /// Its numbers, by their names in the format.
    pub fields: Vec<Field>,
    /// The model that it computes with them.
    pub model: Model,
}

impl Node {
    /// A node with these numbers, which computes this model.
    pub fn new(name: &'static str, fields: Vec<Field>, model: Model) -> Node {
        Node {
            name,
            fields,
            model,
        }
    }
}

/// A named number.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name in the format.
    pub name: &'static str,
    /// Its value.
    pub value: FieldValue,
}

/// A number or a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldValue {
    /// One number.
    Number(f64),
    /// An integer that switches something.
    Whole(i32),
    /// Three channels of a colour.
    Colour([f64; 3]),
    /// Three channels that are not a colour, and stay the same in every working space.
    Channels([f64; 3]),
    /// The same number along both axes of a surface.
    Both(f64),
}

impl Field {
    /// A number, rounded as it is written.
    pub fn number(name: &'static str, value: f64) -> Field {
        Field {
            name,
            value: FieldValue::Number(rounded(value)),
        }
    }

    /// An integer.
    pub fn whole(name: &'static str, value: i32) -> Field {
        Field {
            name,
            value: FieldValue::Whole(value),
        }
    }

    /// A colour, rounded as it is written.
    pub fn colour(name: &'static str, value: [f64; 3]) -> Field {
        Field {
            name,
            value: FieldValue::Colour(value.map(rounded)),
        }
    }

    /// Three channels that are not a colour, rounded as they are written.
    pub fn channels(name: &'static str, value: [f64; 3]) -> Field {
        Field {
            name,
            value: FieldValue::Channels(value.map(rounded)),
        }
    }

    /// A number along both axes of a surface.
    pub fn both(name: &'static str, value: f64) -> Field {
        Field {
            name,
            value: FieldValue::Both(rounded(value)),
        }
    }
}

impl FieldValue {
    /// The numbers with decimal points, separated by commas.
    pub fn numbers(&self) -> String {
        match self {
            FieldValue::Number(value) => format!("{value:?}"),
            FieldValue::Whole(value) => value.to_string(),
            FieldValue::Colour(values) | FieldValue::Channels(values) => {
                values.map(|value| format!("{value:?}")).join(", ")
            }
            FieldValue::Both(value) => format!("{value:?}, {value:?}"),
        }
    }
}

/// The tint of F82-tint where a format limits it to 1, and the error that this causes.
pub fn capped_tint(material: &EngineMaterial, field: &str) -> ([f64; 3], Option<String>) {
    let (f0, whole) = (material.f0, material.tint);
    let capped = whole.map(|tint| tint.min(1.0));
    if capped == whole {
        return (capped, None);
    }
    let error = |tint| Model::f82_tint(f0, tint).error(material).0;
    let (before, after) = (error(whole), error(capped));
    let [red, green, blue] = whole;
    let (before, after) = (rounded_up(before), rounded_up(after));
    let price = if before == after {
        format!("the error stays {after}")
    } else {
        format!("the error is {after} in place of {before}")
    };
    let remark =
        format!("{field}: the F82 tint ({red:?}, {green:?}, {blue:?}) is limited to 1: {price}");
    (capped, Some(remark))
}

/// The nodes as tables of TOML.
pub fn toml(sheet: &Sheet) -> String {
    let field = |field: &Field| {
        let numbers = field.value.numbers();
        match field.value {
            FieldValue::Colour(_) | FieldValue::Channels(_) | FieldValue::Both(_) => {
                format!("{} = [{numbers}]\n", field.name)
            }
            FieldValue::Number(_) | FieldValue::Whole(_) => format!("{} = {numbers}\n", field.name),
        }
    };
    let node = |node: &Node| {
        let fields: String = node.fields.iter().map(field).collect();
        format!("\n[{}]\n{fields}", node.name)
    };
    sheet.nodes.iter().map(node).collect()
}
