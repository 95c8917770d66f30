//! Plans: for each material, the cheapest function whose error is not visible in pictures of a scene.
//!
//! ```text
//! pixel = F L + (1 - F) O        L: light that comes along the mirrored direction; O: all other light of the pixel
//! error of a function: the least e so that pixels with difference(pixel with f, pixel with F) <= e hold 99.9 % of the coverage
//! plan: the functions within the budget with the least Σ cost × pixels + price × number of different functions
//! ```
//!
//! The error is that of the frame where it is worst; below 1000 pixels it is the largest difference. Incoming light is held
//! fixed: for light that is reflected twice, the first reflection follows the exact law. For a rough surface, the mean of F over
//! the half vectors of GGX ([`crate::physics::optics::Ggx`]) takes the place of F.

mod candidate;
mod choice;
mod curve;
mod frame;
mod gbuffer;
mod gltf;
mod ids;
mod judge;
mod metric;
mod page;
mod planned;
mod proof;
mod report;
mod request;
mod scene_file;
mod sky;

pub use candidate::PLANNED_FORMS;
pub use frame::{FramePixels, MappedMaterial, ScenePixel};
pub use gbuffer::{check_primaries, read_gbuffer};
pub use gltf::{GltfFault, GltfScene, GltfView, Unplanned, constant_index};
pub use ids::MaterialIds;
pub use metric::Metric;
pub use page::{material_view, plan_page};
pub use planned::{JudgedMaterial, PlanFault, plan};
pub use proof::prove;
pub use report::{PlanFile, PlanFileRow, PlanReport};
pub use request::{PlanRequest, PlanTruth, PlannedMaterial};
pub use scene_file::SceneFile;
pub use sky::SceneLight;
