//! Tables that pixels look up: reflectance over all angles, and its mean over a rough surface.
//!
//! A table has a value at each of 8192 equal steps of angle and is linear between them. Its error is less than 2e-7 times the
//! second derivative in radians. The mean over GGX is linear in F, so what its coarser table leaves out is left out of every
//! function alike.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use super::frame::ScenePixel;
use crate::generator::reference::cosine_of_part;
use crate::physics::num::{each_channel, in_parallel};
use crate::physics::optics::Ggx;

/// Steps of angle between 0 and 90 degrees.
pub const STEPS: usize = 8192;
/// Steps of angle for rough surfaces, and steps of roughness between 0 and 1.
const ROUGH_STEPS: usize = 128;
const LEVELS: usize = 32;

/// The cosines of all steps, from 1 to 0.
pub fn step_cosines() -> Vec<f64> {
    (0..=STEPS)
        .map(|step| cosine_of_part(step, STEPS))
        .collect()
}

/// A place in a table, between a step and the next one.
#[derive(Clone, Copy, Debug)]
struct Place {
    step: u32,
    share: f32,
}

impl Place {
    fn of(cos_theta: f64, steps: usize) -> Place {
        let angle = libm::acos(cos_theta.clamp(0.0, 1.0)) / std::f64::consts::FRAC_PI_2;
        let at = angle * steps as f64;
        let step = (at as usize).min(steps - 1);
        Place {
            step: step as u32,
            share: (at - step as f64) as f32,
        }
    }

    fn of_table(self, table: &[[f64; 3]]) -> [f64; 3] {
        let [one, next] = [0, 1].map(|i| table[self.step as usize + i]);
        let share = f64::from(self.share);
        each_channel(|i| one[i] + share * (next[i] - one[i]))
    }
}

/// Where a pixel looks up a function's values. The place is the same for every function.
#[derive(Clone, Copy, Debug)]
pub struct PixelPlace {
    mirror: Place,
    /// The level of roughness, and the share of the next one; `None` for a mirror.
    rough: Option<(Place, usize, f64)>,
}

impl PixelPlace {
    /// The place of a pixel.
    pub fn of(pixel: &ScenePixel) -> PixelPlace {
        PixelPlace::at(f64::from(pixel.cos_theta), f64::from(pixel.roughness))
    }

    /// The place of a cosine and a perceptual roughness.
    pub fn at(cos_theta: f64, roughness: f64) -> PixelPlace {
        let at = roughness.clamp(0.0, 1.0) * LEVELS as f64;
        let level = (at as usize).min(LEVELS - 1);
        let rough = || (Place::of(cos_theta, ROUGH_STEPS), level, at - level as f64);
        PixelPlace {
            mirror: Place::of(cos_theta, STEPS),
            rough: (at > 0.0).then(rough),
        }
    }

    /// The entries of the rough table that it reads: two steps on two levels. Level 0 is the mirror and has no entries.
    fn entries(&self) -> impl Iterator<Item = usize> + use<> {
        let pair = self.rough.map(|(place, level, _)| {
            let step = place.step as usize;
            [level, level + 1].map(|level| [entry(level, step), entry(level, step + 1)])
        });
        pair.into_iter()
            .flatten()
            .flatten()
            .filter(|entry| *entry >= ROW)
    }
}

/// Entries in a level of the rough table.
const ROW: usize = ROUGH_STEPS + 1;
/// All entries of the rough table, level 0 included.
const ENTRIES: usize = (LEVELS + 1) * ROW;

fn entry(level: usize, step: usize) -> usize {
    level * ROW + step
}

/// The steps that a mean reads, each once, with their weights: those of all half vectors under which a rough surface is seen.
type StepWeights = Vec<(u32, f64)>;

/// The quadrature of the mean: for each entry of a rough table, the weights of the mirror's steps. An entry is computed when it
/// is first needed, and serves every function of every material in every frame.
pub struct RoughRule {
    ggx: Ggx,
    entries: Vec<OnceLock<StepWeights>>,
}

impl RoughRule {
    /// A rule with no entry computed yet.
    pub fn new() -> RoughRule {
        RoughRule {
            ggx: Ggx::default(),
            entries: (0..ENTRIES).map(|_| OnceLock::new()).collect(),
        }
    }

    fn step_weights(&self, entry: usize) -> &StepWeights {
        self.entries[entry].get_or_init(|| {
            let roughness = (entry / ROW) as f64 / LEVELS as f64;
            let cos_v = cosine_of_part(entry % ROW, ROUGH_STEPS);
            let mut weights = vec![0.0; STEPS + 1];
            self.ggx
                .each(cos_v, roughness * roughness, |cos_h, weight| {
                    let place = Place::of(cos_h, STEPS);
                    let (step, share) = (place.step as usize, f64::from(place.share));
                    weights[step] += weight * (1.0 - share);
                    weights[step + 1] += weight * share;
                });
            let mut steps = Vec::new();
            for (step, weight) in weights.iter().enumerate() {
                if *weight != 0.0 {
                    steps.push((step as u32, *weight));
                }
            }
            steps
        })
    }

    /// How many entries have been computed so far.
    #[cfg(test)]
    pub fn computed(&self) -> usize {
        let computed = |entry: &&OnceLock<StepWeights>| entry.get().is_some();
        self.entries.iter().filter(computed).count()
    }
}

/// A function's values over all angles, and its means over rough surfaces where pixels look them up.
#[derive(Clone, Debug)]
pub struct Curve<'a> {
    mirror: &'a [[f64; 3]],
    /// Indexed by [`entry`]; unset where no pixel looks. Empty where no surface is rough.
    rough: Vec<[f64; 3]>,
}

impl<'a> Curve<'a> {
    /// From values at [`step_cosines`], for pixels at these places.
    pub fn new(mirror: &'a [[f64; 3]], places: &[PixelPlace], rule: &RoughRule) -> Curve<'a> {
        curves(&[mirror], places, rule).remove(0)
    }

    /// The value at a pixel's place.
    pub fn at(&self, place: &PixelPlace) -> [f64; 3] {
        let Some((rough, level, share)) = place.rough else {
            return place.mirror.of_table(self.mirror);
        };
        let value = |level: usize| match level {
            0 => place.mirror.of_table(self.mirror),
            level => rough.of_table(&self.rough[entry(level, 0)..][..ROW]),
        };
        let [one, next] = [value(level), value(level + 1)];
        each_channel(|i| one[i] + share * (next[i] - one[i]))
    }
}

/// The curves of several functions, each from its values at [`step_cosines`]. The means of all functions are taken in one pass,
/// and equal channels are summed only once, because half vectors are many.
pub fn curves<'a>(
    functions: &[&'a [[f64; 3]]],
    places: &[PixelPlace],
    rule: &RoughRule,
) -> Vec<Curve<'a>> {
    let needed: BTreeSet<usize> = places.iter().flat_map(PixelPlace::entries).collect();
    let mut rough = vec![Vec::new(); functions.len()];
    if !needed.is_empty() {
        let columns = Columns::of(functions);
        rough.fill(vec![[0.0; 3]; ENTRIES]);
        for (entry, means) in columns.means(&needed, rule) {
            for (table, columns) in rough.iter_mut().zip(&columns.of_function) {
                table[entry] = columns.map(|column| means[column]);
            }
        }
    }
    let curve = |(mirror, rough): (&&'a [[f64; 3]], _)| Curve { mirror, rough };
    functions.iter().zip(rough).map(curve).collect()
}

/// Columns that are summed together. One row of them fills a cache line, and all rows fit in the cache.
const BLOCK: usize = 8;

/// The distinct channels of all functions, each stored once.
struct Columns {
    /// The values of a block of columns at each step, padded with 0 after the last column.
    blocks: Vec<Vec<[f64; BLOCK]>>,
    /// For each function, the columns of its channels.
    of_function: Vec<[usize; 3]>,
}

impl Columns {
    fn of(functions: &[&[[f64; 3]]]) -> Columns {
        let mut first: Vec<(usize, usize)> = Vec::new();
        let is_equal = |one: (usize, usize), other: (usize, usize)| {
            let mut pairs = functions[one.0].iter().zip(functions[other.0]);
            pairs.all(|(a, b)| a[one.1].to_bits() == b[other.1].to_bits())
        };
        let mut column = |function: usize, channel: usize| {
            let own = (function, channel);
            let known = first.iter().position(|one| is_equal(*one, own));
            known.unwrap_or_else(|| {
                first.push(own);
                first.len() - 1
            })
        };
        let of_function = (0..functions.len())
            .map(|function| [0, 1, 2].map(|channel| column(function, channel)))
            .collect();
        let block = |columns: &[(usize, usize)]| {
            let mut rows = vec![[0.0; BLOCK]; STEPS + 1];
            for (i, (function, channel)) in columns.iter().enumerate() {
                for (step, value) in functions[*function].iter().enumerate() {
                    rows[step][i] = value[*channel];
                }
            }
            rows
        };
        Columns {
            blocks: first.chunks(BLOCK).map(block).collect(),
            of_function,
        }
    }

    /// The means of all columns at these entries.
    fn means(&self, needed: &BTreeSet<usize>, rule: &RoughRule) -> Vec<(usize, Vec<f64>)> {
        let of_level = |level: usize| -> Vec<(usize, Vec<f64>)> {
            let own = needed.range(entry(level, 0)..entry(level + 1, 0));
            own.map(|entry| (*entry, self.mean(rule.step_weights(*entry))))
                .collect()
        };
        let levels = in_parallel(LEVELS + 1, &of_level, &mut |_, _| {});
        levels.into_iter().flatten().collect()
    }

    fn mean(&self, weights: &StepWeights) -> Vec<f64> {
        let sums = self
            .blocks
            .iter()
            .flat_map(|rows| block_mean(rows, weights));
        sums.collect()
    }
}

/// The mean over the columns of a block: the innermost loop of a plan. It is written without `zip` and closures, since a release
/// build calls these one by one.
fn block_mean(rows: &[[f64; BLOCK]], weights: &StepWeights) -> [f64; BLOCK] {
    let mut sums = [0.0; BLOCK];
    for (step, weight) in weights {
        let row = &rows[*step as usize];
        for i in 0..BLOCK {
            sums[i] += weight * row[i];
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schlick(c: f64) -> [f64; 3] {
        let x = 1.0 - c;
        [0.0, 0.04, 0.5].map(|f0| f0 + (1.0 - f0) * x.powi(5))
    }

    fn values() -> Vec<[f64; 3]> {
        step_cosines().into_iter().map(schlick).collect()
    }

    #[test]
    fn a_table_is_the_function() {
        let values = values();
        let curve = Curve::new(&values, &[], &RoughRule::new());
        for i in 0..=1000 {
            let c = f64::from(i) / 1000.0;
            let got = curve.at(&PixelPlace::at(c, 0.0));
            let off = each_channel(|i| (got[i] - schlick(c)[i]).abs());
            assert!(off.iter().all(|off| *off < 3e-7), "{c}: {off:?}");
        }
    }

    #[test]
    fn a_rough_surface_takes_the_mean_over_half_vectors() {
        let places: Vec<PixelPlace> = [0.05, 0.3, 0.5, 0.77, 1.0]
            .iter()
            .flat_map(|r| [0.0, 0.1, 0.5, 0.9, 1.0].map(|c| PixelPlace::at(c, *r)))
            .collect();
        let values = values();
        let curve = Curve::new(&values, &places, &RoughRule::new());
        let rule = Ggx::default();
        for (i, place) in places.iter().enumerate() {
            let roughness = [0.05, 0.3, 0.5, 0.77, 1.0][i / 5];
            let cos_v = [0.0, 0.1, 0.5, 0.9, 1.0][i % 5];
            let mut want = 0.0;
            rule.each(cos_v, roughness * roughness, |c, w| {
                want += w * schlick(c)[1]
            });
            let got = curve.at(place)[1];
            // Linear between levels of roughness.
            assert!(
                (got - want).abs() < 0.006,
                "{roughness} {cos_v}: {got} {want}"
            );
        }
    }

    /// Finding half vectors is the main cost: those of an entry are found once, and only where a pixel looks.
    #[test]
    fn a_mean_is_taken_where_a_pixel_looks_and_its_half_vectors_are_found_once() {
        let rule = RoughRule::new();
        let functions: Vec<Vec<[f64; 3]>> = [schlick, |c: f64| [c; 3]]
            .map(|function: fn(f64) -> [f64; 3]| step_cosines().into_iter().map(function).collect())
            .to_vec();
        let functions: Vec<&[[f64; 3]]> = functions.iter().map(Vec::as_slice).collect();
        let one = [PixelPlace::at(0.4, 0.3)];
        curves(&functions, &one, &rule);
        assert_eq!(rule.computed(), 4);
        // The same pixel shows another material, and a pixel beside it is rougher.
        let two = [one[0], PixelPlace::at(0.4, 0.32)];
        curves(&functions[..1], &two, &rule);
        assert_eq!(rule.computed(), 6);
        // A mirror reads no entry, and just above it there is only one level.
        curves(&functions, &[PixelPlace::at(0.4, 0.0)], &rule);
        assert_eq!(rule.computed(), 6);
        curves(&functions, &[PixelPlace::at(0.4, 0.01)], &rule);
        assert_eq!(rule.computed(), 8);
    }

    #[test]
    fn channels_that_are_equal_are_one_column() {
        let coloured: Vec<[f64; 3]> = step_cosines().into_iter().map(schlick).collect();
        let green: Vec<[f64; 3]> = coloured.iter().map(|value| [value[1]; 3]).collect();
        let columns = Columns::of(&[&coloured, &green, &coloured]);
        let first = columns.blocks[0][STEPS / 2];
        assert_eq!(columns.blocks.len(), 1);
        assert!(first[..3].iter().all(|value| *value > 0.0) && first[3..] == [0.0; BLOCK - 3]);
        assert_eq!(columns.of_function, [[0, 1, 2], [1, 1, 1], [0, 1, 2]]);
    }

    #[test]
    fn a_curve_among_others_is_the_curve_alone() {
        let places: Vec<PixelPlace> = (0..50)
            .map(|i| PixelPlace::at(f64::from(i) / 49.0, f64::from(i * 7 % 50) / 49.0))
            .collect();
        let one: Vec<[f64; 3]> = step_cosines().into_iter().map(schlick).collect();
        let other: Vec<[f64; 3]> = one.iter().map(|[r, g, b]| [*b, *r, g * g]).collect();
        let rule = RoughRule::new();
        let both = curves(&[&one, &other], &places, &rule);
        for (values, curve) in [&one, &other].into_iter().zip(both) {
            let alone = Curve::new(values, &places, &RoughRule::new());
            for place in &places {
                assert_eq!(curve.at(place), alone.at(place));
            }
        }
    }
}
