//! What the library offers to build scripts: the names that `src/lib.rs` re-exports, with their signatures. Everything else is
//! public for the program and its tests, and may change in any version; so are items of these types with `#[doc(hidden)]`.

use std::fs;
use std::path::{Path, PathBuf};

use quote::ToTokens;
use syn::{Attribute, Fields, ImplItem, Item, UseTree, Visibility};

fn parsed(path: &Path) -> syn::File {
    syn::parse_file(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The re-exported names, each with the path of its module.
fn exported() -> Vec<(Vec<String>, String)> {
    fn visit(tree: &UseTree, above: &[String], found: &mut Vec<(Vec<String>, String)>) {
        match tree {
            UseTree::Path(path) => {
                let inside = [above, &[path.ident.to_string()]].concat();
                visit(&path.tree, &inside, found);
            }
            UseTree::Group(group) => group
                .items
                .iter()
                .for_each(|item| visit(item, above, found)),
            UseTree::Name(name) => found.push((above.to_vec(), name.ident.to_string())),
            UseTree::Rename(_) | UseTree::Glob(_) => panic!("the root re-exports names one by one"),
        }
    }
    let mut found = Vec::new();
    for item in parsed(&super::root().join("src/lib.rs")).items {
        match item {
            Item::Use(one) if is_public(&one.vis) => visit(&one.tree, &[], &mut found),
            _ => {}
        }
    }
    found
}

/// The files of a module: its own, or all those of its folder.
fn files(module: &[String]) -> Vec<PathBuf> {
    let folder = super::root().join("src").join(module.join("/"));
    let own = folder.with_extension("rs");
    if own.is_file() {
        return vec![own];
    }
    let entries = fs::read_dir(&folder).unwrap_or_else(|_| panic!("no module {module:?}"));
    let paths = entries.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.is_file()).collect()
}

fn is_hidden(attributes: &[Attribute]) -> bool {
    attributes
        .iter()
        .any(|one| words(one).replace(' ', "") == "#[doc(hidden)]")
}

fn is_open(attributes: &[Attribute]) -> bool {
    attributes
        .iter()
        .any(|one| one.path().is_ident("non_exhaustive"))
}

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
    let shown = fields.iter().filter(|field| !is_hidden(&field.attrs));
    shown.map(one).collect::<Vec<_>>().join(", ")
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

/// The methods that a block adds to a type of this name.
fn methods(block: &syn::ItemImpl, name: &str) -> Vec<String> {
    if words(&block.self_ty) != name {
        return Vec::new();
    }
    if let Some((_, of, _)) = &block.trait_ {
        return vec![format!("impl {} for {name}", words(of))];
    }
    let method = |item: &ImplItem| match item {
        ImplItem::Fn(one) if is_public(&one.vis) && !is_hidden(&one.attrs) => {
            Some(format!("impl {name}: pub {}", words(&one.sig)))
        }
        ImplItem::Const(one) if is_public(&one.vis) && !is_hidden(&one.attrs) => Some(format!(
            "impl {name}: pub const {}: {}",
            one.ident,
            words(&one.ty)
        )),
        _ => None,
    };
    block.items.iter().filter_map(method).collect()
}

fn variants(one: &syn::ItemEnum) -> Vec<String> {
    if is_open(&one.attrs) {
        return vec![format!("pub enum {} of any variants", one.ident)];
    }
    let line = |each: &syn::Variant| format!("pub enum {} {}", one.ident, variant(each));
    one.variants.iter().map(line).collect()
}

/// What an item says of a name: its definition, or what it has.
fn lines(item: &Item, name: &str) -> Vec<String> {
    match item {
        Item::Fn(one) if one.sig.ident == name => vec![format!("pub {}", words(&one.sig))],
        Item::Struct(one) if one.ident == name && is_open(&one.attrs) => {
            vec![format!("pub struct {name} of any fields")]
        }
        Item::Struct(one) if one.ident == name => {
            vec![format!("pub struct {name} {{ {} }}", fields(&one.fields))]
        }
        Item::Enum(one) if one.ident == name => variants(one),
        Item::Impl(one) => methods(one, name),
        _ => Vec::new(),
    }
}

fn signatures(module: &[String], name: &str) -> Vec<String> {
    let parsed = files(module).into_iter().map(|path| parsed(&path));
    let found: Vec<String> = parsed
        .flat_map(|file| file.items)
        .flat_map(|item| lines(&item, name))
        .collect();
    assert!(!found.is_empty(), "{name} is not defined in {module:?}");
    found
}

#[test]
fn the_library_for_build_scripts_is_the_committed_one() {
    let mut all: Vec<String> = exported()
        .iter()
        .flat_map(|(module, name)| signatures(module, name))
        .collect();
    all.sort();
    super::check("api", &all);
}

/// What documents and examples import from the library is what is listed.
#[test]
fn examples_use_only_the_library_for_build_scripts() {
    let listed: Vec<String> = exported().into_iter().map(|(_, name)| name).collect();
    let head = "use fresnel_gen::";
    for example in [
        "src/lib.rs",
        "docs/builds.md",
        "tests/pipelines/cargo/src/build.rs",
    ] {
        let text = fs::read_to_string(super::root().join(example)).unwrap();
        let imports: Vec<&str> = text
            .lines()
            .filter_map(|line| line.trim_start_matches("//! ").strip_prefix(head))
            .collect();
        assert_eq!(imports.len(), 1, "{example}");
        assert_eq!(text.matches("fresnel_gen::").count(), 1, "{example}");
        for name in imports[0].trim_matches([';', '{', '}']).split(", ") {
            assert!(listed.iter().any(|one| one == name), "{example}: {name}");
        }
    }
}
