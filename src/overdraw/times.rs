//! The record of times: what `fresnel-gen time` measured, and on what. `tests/times` writes it.

static RECORD: &str = include_str!("../../data/records/times.csv");

/// A line of the record.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// The method.
    pub method: &'static str,
    /// The material that it is specialised to; empty for the library.
    pub material: &'static str,
    /// `library`, `scalar` or `specialised`.
    pub form: &'static str,
    /// 1 or 3.
    pub channels: u8,
    /// `f32` or `f16`.
    pub precision: &'static str,
    /// Nanoseconds a pixel of a draw that evaluates it once.
    pub ns_per_pixel: f64,
    /// Its net cost over that of `dielectric_exact`.
    pub share: f64,
    /// How far the middle half of single rounds' shares reaches, over their median.
    pub spread: f64,
    /// The device.
    pub device: &'static str,
    /// Its driver.
    pub driver: &'static str,
}

/// All lines, in the record's order.
pub fn times() -> impl Iterator<Item = Time> {
    let lines = RECORD.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).filter_map(time)
}

/// A line: device and driver come last and in quotes, since names of devices hold commas.
fn time(line: &'static str) -> Option<Time> {
    let mut cells = line.splitn(9, ',');
    let mut next = || cells.next();
    let [method, material, form] = [next()?, next()?, next()?];
    let (channels, precision) = (next()?.parse().ok()?, next()?);
    let [ns_per_pixel, share, spread] = [next()?, next()?, next()?].map(|cell| cell.parse().ok());
    let (device, driver) = next()?.trim_matches('"').split_once("\",\"")?;
    Some(Time {
        method,
        material,
        form,
        channels,
        precision,
        ns_per_pixel: ns_per_pixel?,
        share: share?,
        spread: spread?,
        device,
        driver,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods;

    #[test]
    fn every_line_of_the_record_is_read() {
        let lines = RECORD.lines().filter(|line| !line.starts_with('#'));
        assert_eq!(times().count(), lines.count() - 1);
        for time in times() {
            assert!(methods::find(time.method).is_some(), "{time:?}");
            assert_eq!(time.channels == 1, time.form == "scalar", "{time:?}");
            assert!(time.share > 0.0 && time.spread >= 0.0, "{time:?}");
        }
    }
}
