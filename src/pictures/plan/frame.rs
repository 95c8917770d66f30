//! The pixels of a frame that show a scene's materials, whichever renderer drew them.

/// A pixel that shows a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScenePixel {
    /// Its index in the frame, row by row from the top left.
    pub place: u32,
    /// The cosine between the normal and the direction to the camera, in [0, 1].
    pub cos_theta: f32,
    /// Perceptual roughness in [0, 1]: α is its square.
    pub roughness: f32,
    /// The share of the pixel that the material covers, above 0 to 1.
    pub coverage: f32,
    /// Incoming light along the mirrored direction, which F multiplies. It is linear, in the working space, and not negative.
    pub light: [f32; 3],
    /// All other light of the pixel, before 1 - F multiplies it: the body's own lit colour, or what is seen through it.
    pub other: [f32; 3],
}

impl ScenePixel {
    /// A mirror seen straight on in white light.
    pub const MIRROR_IN_WHITE: ScenePixel = ScenePixel {
        place: 0,
        cos_theta: 1.0,
        roughness: 0.0,
        coverage: 1.0,
        light: [1.0; 3],
        other: [0.0; 3],
    };
}

/// The pixels of a frame, by material, whichever renderer drew them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePixels {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The pixels of each material, in the order of the scene's materials; each in scan order.
    pub of_material: Vec<Vec<ScenePixel>>,
}

impl FramePixels {
    /// A frame of this many materials that shows nothing yet.
    pub fn new(size: [u32; 2], materials: usize) -> FramePixels {
        FramePixels {
            size,
            of_material: vec![Vec::new(); materials],
        }
    }
}

/// A material of a scene, and the catalogue material that stands for it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MappedMaterial {
    /// What the scene calls it.
    pub name: String,
    /// A name of the catalogue, or the path of a material's file as the scene's file states it.
    pub material: String,
}
