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
mod drawn;
mod gbuffer;
mod gltf;
mod ids;
mod metric;
mod planned;
mod proof;
pub mod report;
mod request;
mod row;
mod scene_file;
mod sky;
mod view;

pub use candidate::{Candidate, is_plannable};
pub use curve::{STEPS, step_cosines};
pub use drawn::{DrawnScene, SurfaceLook};
pub use gbuffer::{GREATEST_SIDE, GbufferFault, check_primaries, read_gbuffer};
pub use gltf::{GltfFault, GltfScene, GltfView, Unplanned, constant_index};
pub use ids::{MaterialIds, Shown};
pub use metric::{FramePixels, MappedMaterial, Metric, SHARE, ScenePixel, Screen};
pub use planned::{JudgedCandidate, JudgedMaterial, Judgement, PlanFault, PlannedMaterial, plan};
pub use proof::{ProofCase, prove};
pub use request::{PlanRequest, PlanTruth};
pub use row::{CheaperFunction, PlanFile, PlanFileRow, PlanRow, PlanTotal, Proof, SharedFunction};
pub use scene_file::{MOST_FRAMES, ReadFile, SIDES, SceneFile};
pub use sky::{BlurredEnvironment, SceneLight};
pub use view::{AngleCurve, MaterialView, ViewPicture, material_view};
