//! A test whether an ICC profile is sRGB: by the middle of its curve and by its red and green.
//!
//! Source: ICC.1:2022, <https://www.color.org/specification/ICC.1-2022-05.pdf>, sections 7.3 for tags, 10.6 and 10.18 for curves. sRGB by
//! IEC 61966-2-1:1999, its primaries adapted to D50 by Bradford. A profile of another kind, such as one with tables, is not sRGB.

/// The value of .5 as sRGB decodes it. Curves of 2.2, which stand for it in many profiles, give .2176.
const MIDDLE: f64 = 0.214_041;
/// X, Y and Z of red and green.
const RED: [f64; 3] = [0.4361, 0.2225, 0.0139];
const GREEN: [f64; 3] = [0.3851, 0.7169, 0.0971];
const TOLERANCE: f64 = 5e-3;

/// Whether the colours of this profile are sRGB. For a grey profile, whether its curve is.
pub fn is_srgb(profile: &[u8]) -> bool {
    let is_near = |a: f64, b: f64| (a - b).abs() <= TOLERANCE;
    let has_curve = |name| middle(profile, name).is_some_and(|value| is_near(value, MIDDLE));
    let has_place = |name, wanted: [f64; 3]| {
        place(profile, name)
            .is_some_and(|found| found.iter().zip(wanted).all(|(a, b)| is_near(*a, b)))
    };
    match profile.get(16..20) {
        Some(b"GRAY") => has_curve(b"kTRC"),
        Some(b"RGB ") => {
            [b"rTRC", b"gTRC", b"bTRC"].into_iter().all(has_curve)
                && has_place(b"rXYZ", RED)
                && has_place(b"gXYZ", GREEN)
        }
        _ => false,
    }
}

/// The data of a tag.
fn tag<'a>(profile: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let count = whole(profile, 128)?.min(1000) as usize;
    let entry = (0..count)
        .map(|i| 132 + 12 * i)
        .find(|at| profile.get(*at..at + 4) == Some(name))?;
    let from = whole(profile, entry + 4)? as usize;
    let length = whole(profile, entry + 8)? as usize;
    profile.get(from..from.checked_add(length)?)
}

fn whole(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    four.try_into().ok().map(u32::from_be_bytes)
}

fn fixed(bytes: &[u8], at: usize) -> Option<f64> {
    whole(bytes, at).map(|bits| f64::from(bits as i32) / 65536.0)
}

fn place(profile: &[u8], name: &[u8; 4]) -> Option<[f64; 3]> {
    let data = tag(profile, name)?;
    Some([fixed(data, 8)?, fixed(data, 12)?, fixed(data, 16)?])
}

/// The value of a curve at .5.
fn middle(profile: &[u8], name: &[u8; 4]) -> Option<f64> {
    let data = tag(profile, name)?;
    let sample = |at: usize| {
        let two = data.get(at..at.checked_add(2)?)?;
        two.try_into().ok().map(u16::from_be_bytes).map(f64::from)
    };
    match data.get(..4)? {
        b"curv" => match whole(data, 8)? as usize {
            0 => Some(0.5),
            1 => Some(libm::pow(0.5, sample(12)? / 256.0)),
            count => {
                // With an even number of samples the middle lies between two.
                let (low, high) = ((count - 1) / 2, count / 2);
                Some((sample(12 + 2 * low)? + sample(12 + 2 * high)?) / 2.0 / 65535.0)
            }
        },
        b"para" => {
            let parameter = |i: usize| fixed(data, 12 + 4 * i);
            let gamma = parameter(0)?;
            // The middle lies above the linear part of all curves that resemble sRGB.
            let (scale, offset, added) = match sample(8)? as u32 {
                0 => (1.0, 0.0, 0.0),
                1 | 3 => (parameter(1)?, parameter(2)?, 0.0),
                2 => (parameter(1)?, parameter(2)?, parameter(3)?),
                4 => (parameter(1)?, parameter(2)?, parameter(5)?),
                _ => return None,
            };
            Some(libm::pow(scale * 0.5 + offset, gamma) + added)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A profile with one curve for all channels.
    fn profile(curve: &[u8], red: [f64; 3]) -> Vec<u8> {
        let mut bytes = vec![0; 128];
        bytes[16..20].copy_from_slice(b"RGB ");
        let place = |xyz: [f64; 3]| {
            let numbers = xyz.map(|x| ((x * 65536.0) as i32).to_be_bytes());
            [b"XYZ \0\0\0\0".as_slice(), &numbers.concat()].concat()
        };
        let (red, green) = (place(red), place(GREEN));
        let tags: [(&[u8; 4], &[u8]); 5] = [
            (b"rTRC", curve),
            (b"gTRC", curve),
            (b"bTRC", curve),
            (b"rXYZ", &red),
            (b"gXYZ", &green),
        ];
        bytes.extend((tags.len() as u32).to_be_bytes());
        let mut at = (132 + 12 * tags.len()) as u32;
        for (name, data) in tags {
            bytes.extend(*name);
            bytes.extend(at.to_be_bytes());
            bytes.extend((data.len() as u32).to_be_bytes());
            at += data.len() as u32;
        }
        tags.iter().for_each(|(_, data)| bytes.extend(*data));
        bytes
    }

    #[test]
    fn srgb_is_told_by_its_curve_and_its_primaries() {
        let srgb = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045];
        let mut curve = b"para\0\0\0\0\0\x03\0\0".to_vec();
        curve.extend(
            srgb.iter()
                .flat_map(|x| ((x * 65536.0) as i32).to_be_bytes()),
        );
        assert!(is_srgb(&profile(&curve, RED)));
        assert!(
            is_srgb(&profile(b"curv\0\0\0\0\0\0\0\x01\x02\x33", RED)),
            "2.2"
        );
        assert!(!is_srgb(&profile(b"curv\0\0\0\0\0\0\0\0", RED)), "linear");
        // Adobe RGB has another red.
        assert!(!is_srgb(&profile(&curve, [0.6097, 0.3111, 0.0195])));
        let whole = profile(&curve, RED);
        for end in 0..whole.len() {
            let _ = is_srgb(&whole[..end]);
        }
    }
}
