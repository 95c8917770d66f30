//! The cheapest function of each material whose error nobody sees in pictures of a scene.
//!
//! ```text
//! pixel = F L + (1 - F) O        L: light that comes along the mirrored direction; O: all other light of the pixel
//! error of a function: the least e so that pixels with difference(pixel with f, pixel with F) <= e hold 99.9 % of the coverage
//! plan: the functions within the budget with the least Σ cost × pixels + price × number of different functions
//! ```
//!
//! Incoming light is held fixed: what is reflected twice is reflected with the exact law the first time. A rough surface takes the
//! mean of F over the half vectors of GGX ([`crate::optics::Ggx`]) in the place of F.

mod drawn;
mod gltf;
mod pixels;
mod scene_file;
mod sky;

pub use drawn::{DrawnScene, SurfaceLook};
pub use gltf::{GltfFault, GltfScene, GltfView, Unplanned, constant_index};
pub use pixels::{FramePixels, MappedMaterial, ScenePixel};
pub use scene_file::{MOST_FRAMES, ReadFile, SIDES, SceneFile};
pub use sky::{BlurredEnvironment, SceneLight};
