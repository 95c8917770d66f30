//! What the library offers to build scripts: the public items of the modules between a request and its files. All other
//! modules are public for the program and its tests, and may change in any version.

use std::fs;

use quote::ToTokens;
use syn::{Fields, ImplItem, Item, Visibility};

/// The modules, as files of `src/app`.
const MODULES: [&str; 9] = [
    "mod",
    "request",
    "generate/mod",
    "artifact",
    "error",
    "tree",
    "check",
    "write",
    "depfile",
];

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Without attributes and documentation.
fn words(tokens: impl ToTokens) -> String {
    tokens.to_token_stream().to_string()
}

fn fields(fields: &Fields) -> String {
    let one = |field: &syn::Field| {
        let name = field
            .ident
            .as_ref()
            .map_or(String::new(), |name| format!("{name}: "));
        let ty = words(&field.ty);
        if is_public(&field.vis) {
            format!("pub {name}{ty}")
        } else {
            "private".to_owned()
        }
    };
    fields.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// An enum's fields are as public as itself.
fn variant(variant: &syn::Variant) -> String {
    let one = |field: &syn::Field| {
        let name = field
            .ident
            .as_ref()
            .map_or(String::new(), |name| format!("{name}: "));
        format!("{name}{}", words(&field.ty))
    };
    let all: Vec<String> = variant.fields.iter().map(one).collect();
    format!("{}({})", variant.ident, all.join(", "))
}

fn methods(block: &syn::ItemImpl) -> Vec<String> {
    let on = words(&block.self_ty);
    if let Some((_, of, _)) = &block.trait_ {
        return vec![format!("impl {} for {on}", words(of))];
    }
    let method = |item: &ImplItem| match item {
        ImplItem::Fn(one) if is_public(&one.vis) => {
            Some(format!("impl {on}: pub {}", words(&one.sig)))
        }
        ImplItem::Const(one) if is_public(&one.vis) => Some(format!(
            "impl {on}: pub const {}: {}",
            one.ident,
            words(&one.ty)
        )),
        _ => None,
    };
    block.items.iter().filter_map(method).collect()
}

fn lines(item: &Item) -> Vec<String> {
    let public = |is: &Visibility, line: String| {
        if is_public(is) {
            vec![line]
        } else {
            Vec::new()
        }
    };
    match item {
        Item::Fn(one) => public(&one.vis, format!("pub {}", words(&one.sig))),
        Item::Struct(one) => public(
            &one.vis,
            format!("pub struct {} {{ {} }}", one.ident, fields(&one.fields)),
        ),
        Item::Enum(one) => one
            .variants
            .iter()
            .flat_map(|each| {
                public(
                    &one.vis,
                    format!("pub enum {} {}", one.ident, variant(each)),
                )
            })
            .collect(),
        Item::Const(one) => public(
            &one.vis,
            format!("pub const {}: {}", one.ident, words(&one.ty)),
        ),
        Item::Type(one) => public(
            &one.vis,
            format!("pub type {} = {}", one.ident, words(&one.ty)),
        ),
        Item::Use(one) => public(&one.vis, format!("pub use {}", words(&one.tree))),
        Item::Trait(one) => public(&one.vis, format!("pub trait {}", one.ident)),
        Item::Impl(one) => methods(one),
        _ => Vec::new(),
    }
}

#[test]
fn the_library_for_build_scripts_is_the_committed_one() {
    let mut all = Vec::new();
    for module in MODULES {
        let path = super::root().join(format!("src/app/{module}.rs"));
        let parsed = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        let name = module.trim_end_matches("/mod");
        let items = parsed.items.iter().flat_map(lines);
        all.extend(items.map(|line| format!("app::{name}: {line}").replace("app::mod", "app")));
    }
    all.sort();
    super::check("api", &all);
}
