//! Numbers of about 31 digits, as unevaluated sums of two floats, with elementary functions.
//!
//! T. J. Dekker, Numer. Math. 18 (1971) 224; Y. Hida, X. S. Li, D. H. Bailey, ARITH-15 (2001) 155.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The value `high + low`, and the sum of the sizes of all terms that contributed to it.
#[derive(Clone, Copy, Debug)]
pub struct DoubleDouble {
    pub high: f64,
    pub low: f64,
    /// A bound for the terms whose cancellation left this value: its error is about `1e-31 * size`.
    pub size: f64,
}

const PI: DoubleDouble = DoubleDouble::pair(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);
const LN_2: DoubleDouble = DoubleDouble::pair(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

impl DoubleDouble {
    const fn pair(high: f64, low: f64) -> Self {
        DoubleDouble { high, low, size: high.abs() }
    }

    pub fn new(x: f64) -> Self {
        Self::pair(x, 0.0)
    }

    pub fn pi() -> Self {
        PI
    }

    fn normalized(high: f64, low: f64, size: f64) -> Self {
        let (high, low) = two_sum(high, low);
        DoubleDouble { high, low, size: size.max(high.abs()) }
    }

    fn with_size(self, size: f64) -> Self {
        DoubleDouble { size: size.max(self.high.abs()), ..self }
    }

    /// The value without the sizes of its terms.
    fn plain(self) -> Self {
        Self::pair(self.high, self.low)
    }

    fn scaled(self, power_of_two: f64) -> Self {
        let DoubleDouble { high, low, size } = self;
        DoubleDouble {
            high: high * power_of_two,
            low: low * power_of_two,
            size: size * power_of_two.abs(),
        }
    }

    /// An integer or a decimal, such as `12`, `0.25` or `1e-3`.
    pub fn parse(text: &str) -> Option<Self> {
        let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let mut exponent: i32 = exponent.parse().ok()?;
        let (digits, negative) = match digits.strip_prefix('-') {
            Some(digits) => (digits, true),
            None => (digits, false),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        exponent -= i32::try_from(fraction.len()).ok()?;
        let mut value = Self::new(0.0);
        for digit in whole.chars().chain(fraction.chars()) {
            let digit = Self::new(f64::from(digit.to_digit(10)?));
            value = (value * Self::new(10.0) + digit).plain();
        }
        let power = Self::new(10.0).integer_power(exponent.unsigned_abs());
        let value = if exponent < 0 { value / power } else { value * power }.plain();
        Some(if negative { -value } else { value })
    }

    fn integer_power(self, mut n: u32) -> Self {
        let (mut base, mut result) = (self, Self::new(1.0));
        while n > 0 {
            if n & 1 == 1 {
                result = result * base;
            }
            base = base * base;
            n >>= 1;
        }
        result
    }

    /// The power: an integer power of any base, otherwise a power of a positive base.
    pub fn power(self, exponent: Self) -> Self {
        if exponent.low == 0.0 && exponent.high.fract() == 0.0 && exponent.high.abs() < 1e6 {
            let power = self.integer_power(exponent.high.abs() as u32);
            return if exponent.high < 0.0 { Self::new(1.0) / power } else { power };
        }
        (exponent * self.log()).exp()
    }

    pub fn exp(self) -> Self {
        let x = self.plain();
        let times = (x.high / LN_2.high).round();
        let rest = (x - LN_2 * Self::new(times)).scaled(1.0 / 256.0);
        let (mut sum, mut term) = (Self::new(0.0), Self::new(1.0));
        for n in 1..14 {
            term = (term * rest / Self::new(f64::from(n))).plain();
            sum = (sum + term).plain();
        }
        // exp(2 x) - 1 = (exp(x) - 1) (exp(x) - 1 + 2) is accurate for small values
        for _ in 0..8 {
            sum = (sum * (sum + Self::new(2.0))).plain();
        }
        let value = (sum + Self::new(1.0)).plain().scaled(2f64.powi(times as i32));
        value.with_size(value.high * (1.0 + self.size))
    }

    pub fn log(self) -> Self {
        let x = self.plain();
        let mut y = Self::new(x.high.ln());
        for _ in 0..2 {
            y = (y + (x * (-y).exp() - Self::new(1.0))).plain();
        }
        y.with_size(self.size / x.high.abs())
    }

    pub fn sqrt(self) -> Self {
        let x = self.plain();
        if x.high == 0.0 {
            return x;
        }
        let root = Self::new(x.high.sqrt());
        let root = (root + (x - root * root) / root.scaled(2.0)).plain();
        root.with_size(self.size / root.high)
    }

    /// The sine and the cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let x = self.plain();
        let quarter = PI.scaled(0.5);
        let turns = (x.high / quarter.high).round();
        let rest = (x - quarter * Self::new(turns)).plain();
        let mut term = Self::new(1.0);
        let mut sums = [Self::new(0.0); 2];
        for n in 0..30 {
            let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
            sums[n % 2] = (sums[n % 2] + term.scaled(sign)).plain();
            term = (term * rest / Self::new(n as f64 + 1.0)).plain();
        }
        let [cos, sin] = sums;
        let (sin, cos) = match (turns as i64).rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        };
        (sin.with_size(self.size), cos.with_size(self.size))
    }

    /// An elementary function by its name.
    pub fn function(self, name: &str) -> Option<Self> {
        let one = Self::new(1.0);
        let both = || (self.exp(), (-self).exp());
        let (sin, cos) = (|| self.sin_cos().0, || self.sin_cos().1);
        let sinh = || (both().0 - both().1).scaled(0.5);
        let cosh = || (both().0 + both().1).scaled(0.5);
        Some(match name {
            "exp" => self.exp(),
            "log" | "ln" => self.log(),
            "sqrt" => self.sqrt(),
            "sin" => sin(),
            "cos" => cos(),
            "tan" => sin() / cos(),
            "cot" => cos() / sin(),
            "sec" => one / cos(),
            "csc" => one / sin(),
            "sinh" => sinh(),
            "cosh" => cosh(),
            "tanh" => sinh() / cosh(),
            "coth" => cosh() / sinh(),
            "sech" => one / cosh(),
            "csch" => one / sinh(),
            _ => return None,
        })
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        DoubleDouble { high: -self.high, low: -self.low, size: self.size }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = two_sum(self.high, other.high);
        let (tail, rest) = two_sum(self.low, other.low);
        let (high, low) = two_sum(high, low + tail);
        Self::normalized(high, low + rest, self.size + other.size)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        let low = low + (self.high * other.low + self.low * other.high);
        Self::normalized(high, low, self.size * other.size)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = Self::new(self.high / other.high);
        let rest = self.plain() - other.plain() * first;
        let second = Self::new(rest.high / other.high);
        let rest = rest - other.plain() * second;
        let third = Self::new(rest.high / other.high);
        let value = (first + second + third).plain();
        value.with_size((self.size + value.high.abs() * other.size) / other.high.abs())
    }
}

/// The functions agree with values of mpmath in 40 digits.
#[test]
fn functions_have_thirty_digits() {
    let x = DoubleDouble::parse("1.37").unwrap();
    for (name, expected) in [
        ("exp", "3.935350695470472898921077222378672"),
        ("log", "0.314810739840033547279207218611137"),
        ("sin", "0.9799080613986142228876885048919309"),
        ("cos", "0.199449720997572965688198389645307"),
        ("tanh", "0.8786921933686957422754020559171998"),
        ("sqrt", "1.170469991071962510910209827422862"),
    ] {
        let expected = DoubleDouble::parse(expected).unwrap();
        let found = x.function(name).unwrap();
        let error = (found - expected).high.abs();
        assert!(error < 1e-30, "{name}: {found:?}");
    }
    let large = DoubleDouble::parse("-41.25").unwrap();
    let (sin, cos) = large.sin_cos();
    let unit = sin * sin + cos * cos - DoubleDouble::new(1.0);
    assert!(unit.high.abs() < 1e-30, "{unit:?}");
    let back = large.exp().log() - large;
    assert!(back.high.abs() < 1e-29, "{back:?}");
    let cube = x.power(DoubleDouble::new(1.0) / DoubleDouble::new(3.0));
    assert!((cube * cube * cube - x).high.abs() < 1e-30);
}
