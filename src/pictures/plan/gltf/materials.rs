//! The catalogue materials that stand for the materials of a file.
//!
//! ```text
//! dielectrics: other light = base colour × light from around; coverage = alpha where it blends
//! ```
//!
//! What is seen through a material (KHR_materials_transmission) is assumed to be as bright as its surroundings, so its share does
//! not matter. Source of the default index: Khronos, KHR_materials_ior, 2020,
//! <https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_materials_ior>.

use std::collections::HashMap;

use gltf_json::material::AlphaMode;
use gltf_json::validation::Checked;
use gltf_json::{Index, Material as GltfMaterial, Root};
use serde::Serialize;

use super::super::frame::MappedMaterial;
use super::super::sky::SceneLight;
use super::container::GltfFault;
use crate::physics::foreign::{Foreign, one_line};
use crate::physics::materials::{self, Material, MaterialKind};
use crate::physics::names::UnknownName;
use crate::pictures::plan::frame::SurfaceLook;

/// The index of glTF's dielectrics.
const USUAL_INDEX: f32 = 1.5;
/// How the name of a material with a constant index begins: `ior_1_5`.
const CONSTANT: &str = "ior_";
/// The key in a material's extras.
const KEY: &str = "fresnel_gen";

/// Ratified material extensions that are not read and do not change the reflection of a surface. Dispersion, by its
/// specification, bends what is seen through a material and does not change the index of its reflection.
const HARMLESS: [&str; 6] = [
    "KHR_materials_volume",
    "KHR_materials_volume_scatter",
    "KHR_materials_dispersion",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_emissive_strength",
    "KHR_materials_variants",
];

/// All other ratified material extensions that are not read, and two deprecated ones: the factor that does nothing where it is 0
/// in all its channels or not given, if there is one, and how the extension changes the reflection. Those that are read are
/// `KHR_materials_ior`, `KHR_materials_specular` and `KHR_materials_transmission`.
const CHANGES: [(&str, Option<&str>, &str); 7] = [
    (
        "KHR_materials_clearcoat",
        Some("clearcoatFactor"),
        "a coat over it reflects too, and takes light from it",
    ),
    (
        "KHR_materials_iridescence",
        Some("iridescenceFactor"),
        "a film on it colours what it reflects",
    ),
    (
        "KHR_materials_sheen",
        Some("sheenColorFactor"),
        "fibres on it reflect too, and take light from it",
    ),
    (
        "KHR_materials_anisotropy",
        Some("anisotropyStrength"),
        "it is rougher in one direction than in the other, and a plan knows one roughness",
    ),
    (
        "KHR_materials_unlit",
        None,
        "it is not lit, so that it reflects nothing",
    ),
    (
        "KHR_materials_pbrSpecularGlossiness",
        None,
        "it states the colour that it reflects head-on, and no index",
    ),
    ("KHR_techniques_webgl", None, "a shader of its own draws it"),
];

/// A material that is seen but not planned.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Unplanned {
    /// What the file calls it.
    pub name: String,
    /// Why it is not planned.
    pub reason: String,
}

/// A dielectric of the same index at all wavelengths, by the name that [`super::GltfScene::materials`] gives it: `ior_1_5` for
/// 1.5. `None` for all other names.
pub fn constant_index(name: &str) -> Option<Material> {
    let index = name.strip_prefix(CONSTANT)?.replacen('_', ".", 1);
    let is_number = index
        .bytes()
        .all(|byte| byte.is_ascii_digit() || byte == b'.');
    let number: f32 = index.parse().ok().filter(|_| is_number)?;
    if name != name_of(number) {
        return None;
    }
    let text = format!(
        "name = \"{name}\"\nsummary = \"A dielectric with an index of {index}\"\nclass = \"dielectric\"\nlicence = \"CC0-1.0\"\nreference = \"a constant\"\nlink = \"https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_materials_ior\"\nn = [[200, {index}], [2500, {index}]]\n"
    );
    Material::parse(name, &text).ok()
}

fn name_of(index: f32) -> String {
    format!("{CONSTANT}{index}").replace('.', "_")
}

/// The looks of a file's materials, resolved as they are met.
pub struct Looks<'a> {
    pub materials: Vec<MappedMaterial>,
    pub unplanned: Vec<Unplanned>,
    /// What is not read of planned materials although it changes the picture.
    pub remarks: Vec<String>,
    root: &'a Root,
    /// The other light of a white pixel.
    around: [f32; 3],
    /// By the index of the file's material; the default one has none.
    known: HashMap<Option<usize>, Option<SurfaceLook>>,
}

impl<'a> Looks<'a> {
    pub fn new(root: &'a Root, light: &SceneLight) -> Looks<'a> {
        Looks {
            materials: Vec::new(),
            unplanned: Vec::new(),
            remarks: Vec::new(),
            root,
            around: light.mean(),
            known: HashMap::new(),
        }
    }

    /// The look of a primitive; `None` where it is not seen at all.
    pub fn of(
        &mut self,
        material: Option<Index<GltfMaterial>>,
    ) -> Result<Option<SurfaceLook>, GltfFault> {
        let key = material.map(|material| material.value());
        if let Some(known) = self.known.get(&key) {
            return Ok(*known);
        }
        let (root, default) = (self.root, GltfMaterial::default());
        let material = key.map_or(&default, |key| &root.materials[key]);
        let look = self.look(material, key)?;
        self.known.insert(key, look);
        Ok(look)
    }

    fn look(
        &mut self,
        material: &GltfMaterial,
        key: Option<usize>,
    ) -> Result<Option<SurfaceLook>, GltfFault> {
        let factors = Factors::of(material, key)?;
        if factors.coverage == 0.0 {
            return Ok(None);
        }
        let name = self.free_name(material, key);
        let index = match stands_for(material, &factors, key)? {
            Ok(found) => {
                self.remarks.extend(not_read(material, &name));
                self.remarks.extend(left_out(material, &name, &found));
                self.materials.push(MappedMaterial {
                    name,
                    material: found,
                });
                Some(self.materials.len() - 1)
            }
            Err(reason) => {
                self.unplanned.push(Unplanned { name, reason });
                None
            }
        };
        let reflects_apart = index.is_some_and(|i| is_dielectric(&self.materials[i].material));
        let around = if reflects_apart {
            self.around
        } else {
            [0.0; 3]
        };
        Ok(Some(SurfaceLook {
            material: index,
            roughness: factors.roughness,
            other: [0, 1, 2].map(|i| factors.colour[i] * around[i]),
            coverage: factors.coverage,
            is_one_sided: !material.double_sided,
        }))
    }

    /// The file's name for a material, made distinct from others of the same name.
    fn free_name(&self, material: &GltfMaterial, key: Option<usize>) -> String {
        let place = key.map_or("the default material".to_owned(), place_of);
        let own = material.name.as_deref().map(one_line);
        let Some(own) = own.filter(|name| !name.trim().is_empty()) else {
            return place;
        };
        let planned = self.materials.iter().map(|known| &known.name);
        let mut all = planned.chain(self.unplanned.iter().map(|known| &known.name));
        if all.any(|known| *known == own) {
            format!("{own} ({place})")
        } else {
            own
        }
    }
}

fn place_of(material: usize) -> String {
    format!("materials[{material}]")
}

fn is_dielectric(name: &str) -> bool {
    let found = materials::find(name)
        .and_then(Result::ok)
        .or_else(|| constant_index(name));
    found.is_some_and(|material| material.kind == MaterialKind::Dielectric)
}

/// The factors of a material.
struct Factors {
    roughness: f32,
    metallic: f32,
    colour: [f32; 3],
    coverage: f32,
}

impl Factors {
    fn of(material: &GltfMaterial, key: Option<usize>) -> Result<Factors, GltfFault> {
        let pbr = &material.pbr_metallic_roughness;
        let check = |value: f32, what: &str| {
            if (0.0..=1.0).contains(&value) {
                Ok(value)
            } else {
                let place = place_of(key.unwrap_or(0)) + ".pbrMetallicRoughness." + what;
                let what = format!("it is {value}; it must lie between 0 and 1");
                Err(GltfFault::new(place, what))
            }
        };
        let [red, green, blue, alpha] = pbr.base_color_factor.0;
        for channel in [red, green, blue, alpha] {
            check(channel, "baseColorFactor")?;
        }
        let cutoff = material.alpha_cutoff.unwrap_or_default().0;
        let coverage = match material.alpha_mode {
            Checked::Valid(AlphaMode::Blend) => alpha,
            Checked::Valid(AlphaMode::Mask) if alpha < cutoff => 0.0,
            _ => 1.0,
        };
        Ok(Factors {
            roughness: check(pbr.roughness_factor.0, "roughnessFactor")?,
            metallic: check(pbr.metallic_factor.0, "metallicFactor")?,
            colour: [red, green, blue],
            coverage,
        })
    }
}

/// The catalogue material that stands for one of the file's, or why there is none.
fn stands_for(
    material: &GltfMaterial,
    factors: &Factors,
    key: Option<usize>,
) -> Result<Result<String, String>, GltfFault> {
    if let Some(named) = named(material, key)? {
        return Ok(Ok(named));
    }
    let own = material.name.as_deref().unwrap_or("");
    let own = own.to_lowercase().replace(' ', "_");
    if materials::source(&own).is_some() {
        return Ok(Ok(own));
    }
    if factors.metallic > 0.0 {
        let why = format!(
            "glTF defines its metals by Schlick's approximation, so that there is no other truth; name a material of the catalogue in its extras: {{\"{KEY}\": \"gold\"}}"
        );
        return Ok(Err(why));
    }
    Ok(by_index(material))
}

/// The name in the extras.
fn named(material: &GltfMaterial, key: Option<usize>) -> Result<Option<String>, GltfFault> {
    let Some(extras) = &material.extras else {
        return Ok(None);
    };
    let extras: serde_json::Value = serde_json::from_str(extras.get()).unwrap_or_default();
    let Some(name) = extras.get(KEY) else {
        return Ok(None);
    };
    let fault = |what: String| {
        let place = place_of(key.unwrap_or(0)) + ".extras." + KEY;
        Err(GltfFault::new(place, what))
    };
    match name.as_str() {
        None => fault("it wants the name of a material of the catalogue".to_owned()),
        Some(name) if materials::source(name).is_none() => {
            fault(UnknownName::new("material", name, &materials::names()).to_string())
        }
        Some(name) => Ok(Some(name.to_owned())),
    }
}

/// A dielectric, by its index alone.
fn by_index(material: &GltfMaterial) -> Result<String, String> {
    let extensions = material.extensions.as_ref();
    if let Some(reason) = first_change(material) {
        return Err(reason);
    }
    if let Some(specular) = extensions.and_then(|all| all.specular.as_ref()) {
        let textures =
            specular.specular_texture.is_some() || specular.specular_color_texture.is_some();
        let is_usual =
            specular.specular_factor.0 == 1.0 && specular.specular_color_factor.0 == [1.0; 3];
        if textures || !is_usual {
            return Err("KHR_materials_specular changes what it reflects head-on".to_owned());
        }
    }
    let index = extensions
        .and_then(|all| all.ior.as_ref())
        .map_or(USUAL_INDEX, |ior| ior.ior.0);
    let name = name_of(index);
    if index > 1.0 && constant_index(&name).is_some() {
        return Ok(name);
    }
    Err(match index {
        0.0 => "KHR_materials_ior says that an index of 0 reflects everything at every angle: F is 1, and no function is needed".to_owned(),
        1.0 => "an index of 1 reflects nothing at any angle: F is 0, and no function is needed".to_owned(),
        _ => format!("an index of {index}: KHR_materials_ior allows 0, and 1 or more"),
    })
}

/// A remark on the parts of a material that are not read.
fn not_read(material: &GltfMaterial, name: &str) -> Option<String> {
    let pbr = &material.pbr_metallic_roughness;
    let emits = material.emissive_factor.0 != [0.0; 3];
    let parts = [
        (pbr.base_color_texture.is_some(), "baseColorTexture"),
        (
            pbr.metallic_roughness_texture.is_some(),
            "metallicRoughnessTexture",
        ),
        (material.normal_texture.is_some(), "normalTexture"),
        (material.occlusion_texture.is_some(), "occlusionTexture"),
        (
            emits && material.emissive_texture.is_some(),
            "emissiveTexture",
        ),
        (
            emits && material.emissive_texture.is_none(),
            "emissiveFactor",
        ),
    ];
    let parts = parts.iter().filter(|(is_there, _)| *is_there);
    let parts: Vec<&str> = parts.map(|(_, part)| *part).collect();
    let list = parts.join(", ");
    (!parts.is_empty()).then(|| format!("{name}: not read: {list}"))
}

/// A remark on the extensions that change a material which a catalogue material stands for, since only the latter is planned.
fn left_out(material: &GltfMaterial, name: &str, found: &str) -> Option<String> {
    let reason = first_change(material)?;
    Some(format!("{name}: planned as {found} alone; {reason}"))
}

/// The first change of the reflection by an extension that is not read, in words.
fn first_change(material: &GltfMaterial) -> Option<String> {
    let extensions = material.extensions.iter();
    let mut others = extensions.flat_map(|extensions| &extensions.others);
    others.find_map(|(name, value)| change(name, value))
}

/// The change of the reflection by an extension, in words; `None` where it changes nothing.
fn change(name: &str, value: &serde_json::Value) -> Option<String> {
    if HARMLESS.contains(&name) {
        return None;
    }
    let is_zero = |factor: &serde_json::Value| match factor.as_array() {
        Some(channels) => channels.iter().all(|channel| channel.as_f64() == Some(0.0)),
        None => factor.as_f64() == Some(0.0),
    };
    let known = CHANGES.iter().find(|(known, ..)| *known == name);
    let name = Foreign(name);
    match known {
        Some((_, Some(factor), _)) if value.get(factor).is_none_or(is_zero) => None,
        Some((_, Some(factor), why)) => {
            Some(format!("{name}: {why}; a {factor} of 0 does nothing"))
        }
        Some((_, None, why)) => Some(format!("{name}: {why}")),
        None => Some(format!("{name} changes what it reflects")),
    }
}
