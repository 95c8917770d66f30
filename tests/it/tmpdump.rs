use crate::physics::films::filmed;
use fresnel_gen::physics::materials::{Surface, ViewingConditions};
use fresnel_gen::physics::spectra::Gamut;
#[test]
fn dump() {
    let text = std::fs::read_to_string("/tmp/film/pairs.csv").unwrap();
    let mut out = String::new();
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let c: Vec<&str> = line.split(',').collect();
        let material = filmed(&format!("{}:{}nm", c[1], c[3]), c[2]);
        let viewing = ViewingConditions { gamut: Gamut::Keep, ..ViewingConditions::default() };
        let surface = Surface::new(&material, None, &viewing).unwrap();
        for i in 0..=400 {
            let t = f64::from(i) / 400.0;
            let cos = if i == 400 { 0.0 } else { (t * std::f64::consts::FRAC_PI_2).cos() };
            let r = surface.unpolarised(cos);
            out += &format!("{},{},{},{},{cos},{},{},{}\n", c[0], c[1], c[2], c[3], r.x, r.y, r.z);
        }
    }
    std::fs::write("/tmp/film/curves.csv", out).unwrap();
}
