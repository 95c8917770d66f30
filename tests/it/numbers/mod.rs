//! The number types, held against each other and against double-double.

mod dd;

pub use dd::Dd;

use fresnel_gen::physics::num::{Complex, Half, Interval, Num, Truth};

#[track_caller]
fn check_near<N: Num>(got: Complex<N>, want: Complex<N>, tolerance: f64) {
    let error = (got - want).modulus().to_f64() / want.modulus().to_f64();
    assert!(error <= tolerance, "{got:?} is {error:e} from {want:?}");
}

fn check_parts<N: Num>(tolerance: f64) {
    let parts = [-1e150, -3.0, -1e-8, 0.0, 2e-100, 0.7, 4.0, 1e149];
    for (re, im) in parts.iter().flat_map(|&re| parts.map(|im| (re, im))) {
        if re == 0.0 && im == 0.0 {
            continue;
        }
        let z = Complex::new(N::from_f64(re), N::from_f64(im));
        let root = z.sqrt();
        check_near(root * root, z, tolerance);
        assert!(root.re.to_f64() >= 0.0, "√{z:?} = {root:?}");
    }
}

#[test]
fn the_root_undoes_the_product() {
    check_parts::<f64>(1e-15);
    check_parts::<Dd>(1e-30);
}

fn check_exact_values<N: Num + PartialEq>() {
    let number = N::from_f64;
    assert_eq!(number(3.0).exp2(), number(8.0));
    assert_eq!(number(0.25).log2(), number(-2.0));
    assert_eq!(number(4.0).inverse_sqrt(), number(0.5));
    assert_eq!(number(-3.0).saturate(), number(0.0));
    assert_eq!(number(7.0).saturate(), number(1.0));
    assert_eq!(number(f64::NAN).saturate(), number(0.0));
    assert_eq!(number(f64::NAN).max(number(2.0)), number(2.0));
    assert_eq!(number(1.0).less(number(f64::NAN)), Truth::No);
    assert_eq!(number(1.0).less(number(2.0)), Truth::Yes);
}

#[test]
fn exact_values_in_every_point_format() {
    check_exact_values::<f32>();
    check_exact_values::<f64>();
    check_exact_values::<Half>();
    check_exact_values::<Dd>();
}

/// A fixed sequence of numbers in [0, 1): the 48-bit generator of POSIX `drand48`.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(0x5_DEEC_E66D) + 11) & 0xffff_ffff_ffff;
        self.0 as f64 / 48f64.exp2()
    }

    fn signed(&mut self) -> f64 {
        let sign = if self.unit() < 0.5 { -1.0 } else { 1.0 };
        sign * (40.0 * self.unit() - 20.0).exp2()
    }

    fn interval_and_member(&mut self) -> (Interval, Dd) {
        let interval = Interval::new(self.signed(), self.signed());
        let member = interval.lo() + self.unit() * (interval.hi() - interval.lo());
        (
            interval,
            Dd::from(member.clamp(interval.lo(), interval.hi())),
        )
    }
}

#[track_caller]
fn check_contains(interval: Interval, exact: Dd) {
    assert!(
        Dd::from(interval.lo()) <= exact && exact <= Dd::from(interval.hi()),
        "{exact:?} is not in {interval:?}"
    );
}

#[test]
fn results_contain_the_exact_ones() {
    let mut random = Random(2014);
    for _ in 0..20_000 {
        let (a, x) = random.interval_and_member();
        let (b, y) = random.interval_and_member();
        check_contains(a + b, x + y);
        check_contains(a - b, x - y);
        check_contains(a * b, x * y);
        check_contains(a / b, x / y);
        check_contains(a.squared(), x * x);
        check_contains(a.min(b), x.min(y));
        check_contains(a.max(b), x.max(y));
        check_contains(a.abs().sqrt(), x.abs().sqrt());
        check_contains(a.abs().inverse_sqrt(), x.abs().inverse_sqrt());
        check_contains(a.abs().log2(), x.abs().log2());
        let exponent = Interval::from_f64(1e-4) * a;
        check_contains(exponent.exp2(), (Dd::from(1e-4) * x).exp2());
    }
}

#[test]
fn points_contain_the_exact_result_of_a_rounded_operation() {
    let mut random = Random(2017);
    for _ in 0..20_000 {
        let (x, y) = (random.signed(), random.signed());
        let (a, b) = (Interval::from_f64(x), Interval::from_f64(y));
        check_contains(a + b, Dd::from(x) + Dd::from(y));
        check_contains(a * b, Dd::from(x) * Dd::from(y));
        check_contains(a / b, Dd::from(x) / Dd::from(y));
        check_contains(a.abs().sqrt(), Dd::from(x).abs().sqrt());
    }
}
