//! The Baker-Campbell-Hausdorff series, and the inverse tangent operator as a Bernoulli series.

use super::LieAlgebra;
use crate::Error;
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar, TensorError};

impl<S: Field + Scalar> LieAlgebra<S> {
    /// The homogeneous parts `Z_1 ... Z_order` of `log(exp(x) exp(y)) = Z_1 + Z_2 + ...`, where
    /// `Z_n` is a combination of brackets of `n` factors:
    ///
    /// ```text
    /// Z_1 = x + y     Z_2 = [x,y]/2     Z_3 = [x,[x,y]]/12 - [y,[x,y]]/12     Z_4 = -[y,[x,[x,y]]]/24
    /// (n+1) Z_{n+1} = [x - y, Z_n]/2
    ///     + sum_{p >= 1, 2p <= n} B_2p/(2p)! sum_{k_1 + .. + k_2p = n} [Z_{k_1}, [.. [Z_{k_2p}, x + y]]]
    /// ```
    ///
    /// On a nilpotent algebra, the sum is finite and equals the group product. On other algebras,
    /// the series converges near zero. V. S. Varadarajan, *Lie Groups, Lie Algebras, and Their
    /// Representations* (1974), Lemma 2.15.3.
    ///
    /// ```
    /// use affinor::Rational;
    /// use affinor::algebra::catalogue;
    /// // the affine maps of the line: [x, y] = y
    /// let line = catalogue::algebra("aff(1)")?;
    /// let [x, y] = [[1, 0], [0, 1]].map(|v| v.map(Rational::from));
    /// let parts: Vec<String> = line.bch(&x, &y, 6)?.iter().map(|z| z[1].to_string()).collect();
    /// // u/(1 - exp(-u)) at u = 1
    /// assert_eq!(parts, ["1", "1/2", "1/12", "0", "-1/720", "0"]);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::Tensor`] if the scalars have no inverse of an integer up to
    /// `order`.
    #[doc(alias("Baker-Campbell-Hausdorff"))]
    pub fn bch(&self, x: &[S], y: &[S], order: usize) -> Result<Vec<Vec<S>>, Error> {
        let (_, _) = (self.vector(x)?, self.vector(y)?);
        let zeta = bernoulli(order / 2)?;
        let (sum, difference) = (combined(x, y, 1), combined(x, y, -1));
        // nested[q][m]: the sum over k_1 + ... + k_q = m of [Z_{k_1}, [... [Z_{k_q}, x + y]]]
        let mut nested = vec![vec![sum.clone()]];
        let mut parts: Vec<Vec<S>> = Vec::new();
        if order > 0 {
            parts.push(sum);
        }
        for n in 1..order {
            let zero = vec![S::zero(); self.dimension()];
            nested[0].push(zero.clone());
            nested.push(vec![zero.clone(); n]);
            checkpoint();
            for q in 1..=n {
                let mut total = zero.clone();
                // each of the other q - 1 factors has at least degree 1
                for k in 1..=n + 1 - q {
                    let inner = &nested[q - 1][n - k];
                    total = combined(&total, &self.bracket(&parts[k - 1], inner)?, 1);
                }
                nested[q].push(total);
            }
            let mut next = scaled(&self.bracket(&difference, &parts[n - 1])?, &inverse(2)?);
            for p in 1..=n / 2 {
                next = combined(&next, &scaled(&nested[2 * p][n], &zeta[p - 1]), 1);
            }
            parts.push(scaled(&next, &inverse(n as i64 + 1)?));
        }
        Ok(parts)
    }

    /// The series of `T_left(x)^-1 v` up to the power `order` of `ad_x`,
    ///
    /// ```text
    /// sum (-1)^k B_k/k! ad_x^k v = v + [x,v]/2 + [x,[x,v]]/12 - [x,[x,[x,[x,v]]]]/720 + ..
    /// ```
    ///
    /// This is the part of [`bch`](Self::bch) that is linear in `y = v`. The series of
    /// `T_right(x)^-1` is this series at `-x`.
    ///
    /// # Errors
    /// The errors of [`bch`](Self::bch).
    pub fn tangent_left_inverse(&self, x: &[S], v: &[S], order: usize) -> Result<Vec<S>, Error> {
        let _ = self.vector(x)?;
        let zeta = bernoulli(order / 2)?;
        let mut power = v.to_vec();
        let mut sum = v.to_vec();
        for k in 1..=order {
            power = self.bracket(x, &power)?;
            match k {
                1 => sum = combined(&sum, &scaled(&power, &inverse(2)?), 1),
                k if k % 2 == 0 => sum = combined(&sum, &scaled(&power, &zeta[k / 2 - 1]), 1),
                _ => {}
            }
        }
        Ok(sum)
    }
}

/// `B_2p/(2p)!` for `p = 1..=count`, by Euler's recursion `(2p + 1) b_p = -sum b_k b_{p-k}`. All
/// its terms have the same sign, so no cancellation occurs in floats.
fn bernoulli<S: Field + Scalar>(count: usize) -> Result<Vec<S>, Error> {
    let mut numbers: Vec<S> = Vec::new();
    for p in 1..=count {
        let products = (0..p - 1).map(|k| numbers[k].clone() * &numbers[p - 2 - k]);
        let sum = products.fold(S::zero(), |sum, product| sum + &product);
        numbers.push(match p {
            1 => inverse(12)?,
            _ => -sum * &inverse(2 * p as i64 + 1)?,
        });
    }
    Ok(numbers)
}

fn inverse<S: Field + Scalar>(n: i64) -> Result<S, Error> {
    Ok(S::from_i64(n).recip().ok_or(TensorError::NotInvertible(n))?)
}

fn scaled<S: Scalar>(x: &[S], by: &S) -> Vec<S> {
    x.iter().map(|x| x.clone() * by).collect()
}

/// `x + sign y`.
fn combined<S: Scalar>(x: &[S], y: &[S], sign: i64) -> Vec<S> {
    let sign = S::from_i64(sign);
    x.iter().zip(y).map(|(x, y)| x.clone() + &(y.clone() * &sign)).collect()
}
