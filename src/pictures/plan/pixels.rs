//! What a frame shows, pixel by pixel, whoever drew it.

/// A pixel that shows a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScenePixel {
    /// Its place in the frame, row by row from the top left.
    pub place: u32,
    /// The cosine between the normal and the direction to the camera, in [0, 1].
    pub cos_theta: f32,
    /// Perceptual roughness in [0, 1]: α is its square.
    pub roughness: f32,
    /// How much of the pixel the material covers, above 0 to 1.
    pub coverage: f32,
    /// Incoming light along the mirrored direction, in the working space, linear, not negative: what F multiplies.
    pub light: [f32; 3],
    /// All other light of the pixel, before 1 - F multiplies it: the body's own colour under its light, or what is seen through it.
    pub other: [f32; 3],
}

/// A frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePixels {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The pixels of each material, in the order of the scene's materials; each in scan order.
    pub of_material: Vec<Vec<ScenePixel>>,
}

impl FramePixels {
    /// A frame that shows nothing yet of so many materials.
    pub fn new(size: [u32; 2], materials: usize) -> FramePixels {
        FramePixels {
            size,
            of_material: vec![Vec::new(); materials],
        }
    }
}

/// A material of a scene, and what stands for it in the catalogue.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MappedMaterial {
    /// What the scene calls it.
    pub name: String,
    /// A name of the catalogue, or the path of a material's file as the scene's file gives it.
    pub material: String,
}
