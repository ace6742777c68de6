//! Primality of machine integers, in the place of the crate `machine-prime`.
//!
//! That crate has a table of 512 KiB that does not compress, a quarter of what a browser would load. Its users here ask for
//! [`is_prime`] only.

/// Bases of Miller and Rabin that decide every integer below `2^64`: J. Sinclair (2011), verified by J. Feitsma's list of
/// pseudoprimes.
const BASES: [u64; 7] = [2, 325, 9375, 28178, 450_775, 9_780_504, 1_795_265_022];

/// Whether a number is prime.
///
/// ```
/// use machine_prime::is_prime;
/// let primes: Vec<u64> = (0..30).filter(|n| is_prime(*n)).collect();
/// assert_eq!(primes, [2, 3, 5, 7, 11, 13, 17, 19, 23, 29]);
/// assert!(is_prime((1 << 61) - 1) && !is_prime((1 << 59) - 1));
/// // a strong pseudoprime to the first nine prime bases: G. Jaeschke, Math. Comp. 61 (1993) 915
/// assert!(!is_prime(3_825_123_056_546_413_051));
/// ```
pub const fn is_prime(n: u64) -> bool {
    if n < 4 || n & 1 == 0 {
        return n == 2 || n == 3;
    }
    let odd = (n - 1) >> (n - 1).trailing_zeros();
    let mut at = 0;
    while at < BASES.len() {
        if !passes(n, odd, BASES[at] % n) {
            return false;
        }
        at += 1;
    }
    true
}

/// The test of one base, with the odd part of `n - 1`.
const fn passes(n: u64, odd: u64, base: u64) -> bool {
    let mut power = power(base, odd, n);
    if base == 0 || power == 1 {
        return true;
    }
    let mut exponent = odd;
    while power != n - 1 {
        exponent *= 2;
        if exponent == n - 1 {
            return false;
        }
        power = product(power, power, n);
    }
    true
}

const fn product(a: u64, b: u64, n: u64) -> u64 {
    // less than n
    (a as u128 * b as u128 % n as u128) as u64
}

const fn power(mut base: u64, mut exponent: u64, n: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = product(result, base, n);
        }
        base = product(base, base, n);
        exponent >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::is_prime;

    #[test]
    fn the_sieve_of_eratosthenes() {
        const END: usize = 200_000;
        let mut prime = vec![true; END];
        prime[..2].fill(false);
        for p in 2..END {
            if prime[p] {
                (p * p..END).step_by(p).for_each(|n| prime[n] = false);
            }
        }
        for (n, expected) in prime.into_iter().enumerate() {
            assert_eq!(is_prime(n as u64), expected, "{n}");
        }
    }

    /// The largest primes below 2^64, <https://t5k.org/lists/2small/>: 2^64 - k.
    #[test]
    fn near_the_end() {
        let found: Vec<u64> = (1..=279).filter(|k| is_prime(0u64.wrapping_sub(*k))).collect();
        assert_eq!(found, [59, 83, 95, 179, 189, 257, 279]);
    }
}
