//! Pictures of the effects beside their truth: what a row of the table draws with the functions that users import, and what a
//! tracer in f64 sees. The two share no code.

mod body;
mod caustics;
mod draw;
mod environment;
mod frame;
mod gem;
mod icc;
mod light;
mod light_file;
mod material;
mod mesh;
mod picture;
mod pool;
mod room;
mod table;
mod texels;
mod text;
mod trace;
mod window;

pub use body::Body;
pub use caustics::{
    Gathering, Photons, TRIANGLES, Window, caustic_error, caustics, exact_caustics,
};
pub use draw::{Scenery, draw};
pub use environment::{Environment, sky};
pub use frame::{
    ABSORPTION_AT, BACK, Camera, FILM_AT, INDEX_AT, INPUTS_AT, LightBlock, MARGIN, PHOTONS,
    PIXEL_AT, frame,
};
pub use light::{Around, Paths};
pub use light_file::is_deep;
pub use material::OpticalMaterial;
pub use mesh::{Vertex, vertex_numbers};
pub use picture::{
    Difference, Display, Picture, PictureRequest, RenderedRow, TONE_CURVES, ToneCurve, compare,
    render,
};
pub use room::{ROOM_MAX, ROOM_MIN, Relief, room_cube, room_radiance};
pub use table::{ALL, DrawnSurface, FRONT, METAL, PassRow, RenderRow, SKY, View, find, hangs_free};
pub use texels::{Slot, Texels};
pub use text::{FRAME, GLES_CALLS, INPUTS, RowText, WGSL_CALLS};
pub use trace::{Things, trace};

/// Samples of a pixel along each side, in the drawn picture and in its truth.
pub const SAMPLES: u32 = 2;
