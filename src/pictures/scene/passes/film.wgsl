// A film that has drained: gone at the body's top, thickest at its bottom.

fn thickness_at(position: vec3<f32>) -> f32 {
    return frame.film.x * clamp(0.5 - 0.5 * position.y / frame.eye.w, 0.0, 1.0);
}
