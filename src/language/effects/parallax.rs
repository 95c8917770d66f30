//! `p + t d - centre`: where a ray from inside a room hits its walls, as a look-up direction from the centre of the room's cube map.
//!
//! Source: Lagarde and Zanuttini, *Local Image-based Lighting With Parallax-corrected Cubemaps*, SIGGRAPH 2012,
//! <https://seblagarde.wordpress.com/2012/09/29/image-based-lighting-approaches-and-parallax-corrected-cubemap/>; the search is
//! Szirmay-Kalos, Aszódi, Lazányi, Premecz, *Approximate Ray-Tracing on the GPU with Distance Impostors*, Computer Graphics Forum 24,
//! 2005, <https://doi.org/10.1111/j.1467-8659.2005.0m894.x>.
//! A box is intersected in closed form. Any other room is intersected by steps of a search in a cube map of distances.

use super::*;

const POSITION: Argument = Argument::vector(
    "position",
    "where the ray starts, inside the room, in the world",
    [-1.0, 1.0],
);
const DIRECTION: Argument = Argument::direction(
    "direction",
    "of the ray, of any length for the box, of unit length for the search",
);
const BOX_MIN: Argument = Argument::vector(
    "box_min",
    "the room's corner with the smallest coordinates",
    [-4.0, -1.0],
);
const BOX_MAX: Argument = Argument::vector(
    "box_max",
    "the room's corner with the largest coordinates",
    [1.0, 4.0],
);
const CUBE_CENTRE: Argument =
    Argument::vector("cube_centre", "where the cube map was taken", [-1.0, 1.0]);
const DISTANCE: Argument = Argument::scalar(
    "distance",
    "the estimate so far, in units of the world: begin with the room's size",
    [0.0, 4.0],
);
const DISTANCE_CUBE: Argument = Argument::whole(
    "distance_cube",
    "the distance from cube_centre to the room in each direction, in red",
    Ty::Cube,
);

/// Smaller components of a direction are clamped to this: a hit at 1e20 times the room's size is as good as none.
const STEEPEST: f64 = 1e-20;

/// The record of this effect.
pub static EFFECT: Effect = Effect {
    name: "parallax",
    summary: "Cube maps of near rooms: the look-up's direction, by a box or by a search",
    formula: &[
        "box: t = min over axes of max((box_min - p) / d, (box_max - p) / d);  look up p + t d - centre",
        "search: q = p + distance d - centre;  distance' = |centre + D(q) q / |q| - p|",
    ],
    source: Citation {
        authors: "Lagarde, Zanuttini",
        title: "Local Image-based Lighting With Parallax-corrected Cubemaps",
        place: "SIGGRAPH",
        year: 2012,
        link: "https://seblagarde.wordpress.com/2012/09/29/image-based-lighting-approaches-and-parallax-corrected-cubemap/",
    },
    conventions: &[
        "The result is a direction in a right-handed world. Where cubes are left-handed, negate its z.",
        "Call the search step three or four times, each with the distance that the last one gave; then look up \
         position + distance direction - cube_centre.",
    ],
    fails: &[
        "What stands inside the box is drawn on its walls.",
        "The search may jump over a thin thing, and finds what the cube's centre sees.",
    ],
    functions: &[
        EffectFunction {
            name: "box_parallax",
            gives: "the direction of the look-up, of the length from cube_centre to the wall; zero for a zero direction",
            arguments: &[POSITION, DIRECTION, BOX_MIN, BOX_MAX, CUBE_CENTRE],
            letters: Letters::Xyz,
            build: box_parallax,
            ..EffectFunction::BASE
        },
        EffectFunction {
            name: "cube_search_step",
            gives: "a better distance",
            arguments: &[POSITION, DIRECTION, DISTANCE, CUBE_CENTRE, DISTANCE_CUBE],
            letters: Letters::Xyz,
            build: cube_search_step,
            ..EffectFunction::BASE
        },
    ],
};

fn box_parallax<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (position, direction) = (with.get(POSITION), with.get(DIRECTION));
    let away = |i: usize| {
        let component = direction.channel(i);
        let steep = with.number(STEEPEST);
        component.abs().choose_below(steep, steep, component)
    };
    let slopes = with.vector(away(0), away(1), away(2)).named(
        "slopes",
        "a ray along a wall meets it never, which is far away",
    );
    let to_min = (with.get(BOX_MIN) - position) / slopes;
    let to_max = (with.get(BOX_MAX) - position) / slopes;
    let walls = to_min
        .max(to_max)
        .named("walls", "how far each pair of walls is, ahead");
    let t = walls.channel(0).min(walls.channel(1)).min(walls.channel(2));
    let squared = direction.dot(direction);
    let present = with
        .number(0.0)
        .choose_below(squared, with.number(1.0), with.number(0.0))
        .named("present", "a zero direction gives zero");
    let hit = position + direction * t.named("t", "the nearest wall");
    (hit - with.get(CUBE_CENTRE)) * present
}

fn cube_search_step<'b>(with: &Arguments<'b>) -> Expr<'b> {
    let (position, centre) = (with.get(POSITION), with.get(CUBE_CENTRE));
    let reached = position + with.get(DIRECTION) * with.get(DISTANCE) - centre;
    let reached = reached.named("reached", "as far as the estimate goes, from the centre");
    let seen = with.get(DISTANCE_CUBE).sample_cube(reached).channel(0);
    let seen = seen.named("seen", "from the centre to the room, in that direction");
    let surface = centre + unit_or_zero(reached) * seen;
    length((surface - position).named("to_surface", "to what the centre sees there"))
}
