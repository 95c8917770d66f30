//! A rasteriser on the CPU, with a depth buffer: which angles a picture shows, and the error of a method over these angles.
//!
//! ```text
//! error = Σ over bins of cos θ: share of the pixels × mean over channels |f − F| / F
//! ```
//!
//! A reflectance depends on the cosine alone. So the mean of an error over the pixels of a picture is its mean over the
//! histogram of their cosines: objects are drawn once, and every method and material is measured on the histogram.
//! A pixel counts where its centre lies in the silhouette. All is f64, and does not depend on the number of threads.
//!
//! The measure is the thesis's for Tables 4 and 5 (section 5.2). Source: Štetić-Kozić, "Poređenje metoda za računanje
//! koeficijenata Frenelove refleksije u programima za senčenje", diploma thesis, University of Belgrade, 2014.

mod camera;
mod draw;
mod ears;
mod histogram;
mod mesh;
mod obj;
mod rendered_error;

pub use camera::{Camera, Lens, Turntable, rotated};
pub use draw::{Frame, SurfacePoint, draw, surface_points, surface_points_of};
pub use histogram::{BINS, CosineHistogram, Shown, shown};
pub use mesh::{Body, CUBE, Mesh, RELIEF, SPHERE, Vertex};
pub use obj::{MOST_TRIANGLES, ObjFault, mesh_of_obj};
pub use rendered_error::{
    ChannelErrors, Painted, RelativeErrors, RenderedError, SceneErrorRow, mean_relative,
    rendered_error,
};
