//! The record of costs: it is of today's shaders, of many GPUs, and the document is written from it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use crate::tables::costs::cost_document;
use fresnel_gen::generator::request::{Materials, Request, Source};
use fresnel_gen::lab::cost::{
    CostBasis, CostFigures, CostRow, CostSource, CostedFunction, FAMILIES, KnownCost, cost_rows,
    find, functions, functions_of_effect, known_cost, records,
};
use fresnel_gen::language::effects::{self, USUAL_METHOD};
use fresnel_gen::language::methods;
use fresnel_gen::physics::num::Precision;
use fresnel_gen::pictures::cost_page::cost_page;

/// The materials whose functions are recorded: those that `tests/costs` names.
const MATERIALS: [&str; 7] = [
    "anodised_titanium_purple",
    "bk7",
    "diamond",
    "gold",
    "platinum",
    "silver",
    "water",
];

/// What is recorded: all methods, these materials, both precisions, and the effects.
static FUNCTIONS: LazyLock<Vec<CostedFunction>> = LazyLock::new(|| {
    let sources = MATERIALS.map(|name| Source::Named(name.to_owned()));
    let request = Request {
        materials: Materials::These(sources.to_vec()),
        ..Request::default()
    };
    let subjects = request.subjects().unwrap().materials();
    let mut functions = functions(methods::ALL, &subjects, &Precision::ALL).unwrap();
    let usual = methods::find(USUAL_METHOD).unwrap();
    for effect in effects::ALL {
        functions.extend(functions_of_effect(effect, usual).unwrap());
    }
    functions
});

/// The rows of all families, from the record.
static TABLE: LazyLock<Vec<Vec<CostRow>>> = LazyLock::new(|| {
    let of = |family| cost_rows(family, None, &records(family.name), &FUNCTIONS);
    FAMILIES.iter().map(of).collect()
});

/// Functions that a GPU cannot hold: no record of it has them.
const TOO_LONG: [(&str, &str); 1] = [("gc2000", "conductor_from_f0_f82")];

/// A row of another shader than today's is false. One that is missing is said: the compilers of other vendors' GPUs than AMD's take Mesa
/// to be built.
#[test]
fn the_record_is_of_todays_shaders() {
    let (mut faults, mut missing) = (Vec::new(), Vec::new());
    for row in TABLE.iter().flatten() {
        let too_long = TOO_LONG
            .contains(&(row.family.name, row.id.method_name().unwrap_or_default()))
            && row.id.material.is_none();
        let cannot = row.id.precision.is_half() && !row.family.half;
        let is_asked = row.family.compiler.dialect().is_some();
        if !is_asked || too_long || cannot || row.source == Some(CostSource::Record) {
            continue;
        }
        if row.source == Some(CostSource::Graph) {
            missing.push(format!("{}, {}\n", row.family.name, row.id.label()));
            continue;
        }
        let why = row.figures.as_ref().err().map_or("", String::as_str);
        let said = format!("{}, {}: {why}\n", row.family.name, row.id.label());
        if why.ends_with("it is not recorded") && row.family.vendor != "AMD" {
            missing.push(said)
        } else {
            faults.push(said)
        }
    }
    if !missing.is_empty() {
        println!(
            "not checked: {} costs are not recorded; tests/mesa-compilers and tests/costs record them:\n{}",
            missing.len(),
            missing.concat()
        );
    }
    assert!(
        faults.is_empty(),
        "run tests/costs, and tests/mesa-compilers before it for others than AMD's:\n{}",
        faults.concat()
    );
}

/// The column `shape` follows from our own text, so that it is written anew without a compiler.
#[test]
fn shapes_are_those_of_todays_shaders() {
    for rows in TABLE.iter() {
        let name = format!("data/records/costs/{}.csv", rows[0].family.name);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
        let Ok(record) = fs::read_to_string(&path) else {
            continue;
        };
        let own = |row: &CostRow| {
            let (shader, shape) = (row.shader.clone()?, row.shape.clone()?);
            Some((format!("{},{shader}", row.id), shape))
        };
        let shapes: BTreeMap<String, String> = rows.iter().filter_map(own).collect();
        let (head, lines): (Vec<&str>, Vec<&str>) = record
            .lines()
            .partition(|line| line.starts_with("# ") || line.starts_with("effect,"));
        let mut text = head.join("\n") + "\n";
        for line in lines {
            let cells: Vec<&str> = line.splitn(10, ',').collect();
            let shape = shapes.get(&cells[..8].join(","));
            let shape = shape.unwrap_or_else(|| panic!("run tests/costs: {line}"));
            text += &format!("{},{shape},{}\n", cells[..8].join(","), cells[9]);
        }
        super::bless::check(&path, text.as_bytes());
    }
}

/// What differs in constants alone has one shape, and what is recorded of it costs at most what is known of the shape.
#[test]
fn a_shape_stands_for_functions_that_are_not_recorded() {
    let family = find("rdna2").unwrap();
    let record = records(family.name);
    let subjects = |name: &str| {
        let request = Request {
            materials: Materials::These(vec![Source::Named(name.to_owned())]),
            ..Request::default()
        };
        request.subjects().unwrap().materials()
    };
    let known = |material: &str, method: &str, precision: Precision| {
        let method = methods::find(method).unwrap();
        let functions = functions(&[method], &subjects(material), &[precision]).unwrap();
        let own = |function: &&CostedFunction| function.id.material.is_some();
        let function = functions.iter().find(own).unwrap();
        known_cost(&function.graph, precision, family, &record)
    };
    let copper = known("copper", "schlick_rescaled", Precision::F32).unwrap();
    assert_eq!(copper.basis, CostBasis::Shape);
    let silver = known("silver", "schlick_rescaled", Precision::F32).unwrap();
    assert_eq!(silver.basis, CostBasis::Function);
    assert!(silver.cost <= copper.cost, "{silver:?} {copper:?}");
    let half = known("silver", "schlick", Precision::F16).unwrap();
    assert_eq!(half.basis, CostBasis::Function);
    let nothing = KnownCost {
        cost: 0.0,
        basis: CostBasis::Nothing,
    };
    for (material, precision) in [("copper", Precision::F32), ("silver", Precision::F16)] {
        assert_eq!(known(material, "constant_f0", precision), Some(nothing));
    }
}

/// Compilers leave out a chain of what computes nothing; the record says 0 and not the chain's own price.
#[test]
fn what_computes_nothing_costs_nothing() {
    let nothing = |function: &&CostedFunction| function.graph.computes_nothing();
    assert!(FUNCTIONS.iter().any(|function| nothing(&function)));
    for rows in TABLE.iter() {
        for (row, _) in rows.iter().zip(&*FUNCTIONS).filter(|(_, f)| nothing(f)) {
            let costs = row.figures.as_ref().map(CostFigures::cost);
            assert!(costs.is_err() || costs == Ok(0.0), "{}", row.id.label());
        }
    }
}

#[test]
fn many_families_of_many_vendors_are_recorded_and_powervr_says_why_not() {
    let known = TABLE.iter().filter(|rows| {
        rows.iter()
            .any(|row| row.source == Some(CostSource::Record))
    });
    let families: Vec<_> = known.map(|rows| rows[0].family).collect();
    let vendors: BTreeSet<&str> = families.iter().map(|family| family.vendor).collect();
    assert!(families.len() >= 9, "{families:?}");
    for vendor in ["AMD", "Qualcomm", "Arm", "Intel", "NVIDIA"] {
        assert!(vendors.contains(vendor), "{vendor}");
    }
    let powervr = TABLE
        .iter()
        .flatten()
        .find(|row| row.family.name == "powervr");
    assert!(
        powervr
            .unwrap()
            .figures
            .as_ref()
            .unwrap_err()
            .contains("PowerVR")
    );
}

#[test]
fn costs_are_in_the_order_that_formulas_suggest() {
    for family in FAMILIES
        .iter()
        .filter(|family| family.compiler.dialect().is_some())
    {
        let record = records(family.name);
        let cost = |method: &str| {
            record
                .library(methods::find(method).unwrap())
                .unwrap()
                .cost()
        };
        // Adreno's counts include waits: Schlick's steps follow one another, and a chain has no other work to fill them.
        assert!(cost("schlick") <= cost("schlick_ior"), "{}", family.name);
        assert!(
            cost("schlick_ior") < cost("dielectric_exact"),
            "{}",
            family.name
        );
        assert!(
            cost("dielectric_exact") < cost("conductor_exact"),
            "{}",
            family.name
        );
    }
}

#[test]
fn the_document_is_what_is_recorded() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/cost.md");
    super::bless::check(&path, cost_document(&TABLE).as_bytes());
}

#[test]
fn the_page_shows_every_family() {
    let page = cost_page(&TABLE, "cost").unwrap();
    for family in FAMILIES {
        assert!(
            page.contains(&format!("id=\"{}\"", family.name)),
            "{}",
            family.name
        );
    }
    assert!(page.contains("Not measured: Mesa has no compiler"));
}
