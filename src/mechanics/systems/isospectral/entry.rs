//! Entries of matrices, real or complex.

use nalgebra::{Complex, ComplexField, DMatrix};

/// An entry of a matrix: a real or complex float.
pub trait MatrixEntry: ComplexField<RealField = f64> + Copy {
    /// The product of matrices.
    fn product(a: &DMatrix<Self>, b: &DMatrix<Self>) -> DMatrix<Self>;
}

impl MatrixEntry for f64 {
    fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
        a * b
    }
}

impl MatrixEntry for Complex<f64> {
    // computes four real products, because nalgebra multiplies real matrices faster than complex
    // matrices: for size 129, the real products need a fifth of the time
    fn product(a: &DMatrix<Self>, b: &DMatrix<Self>) -> DMatrix<Self> {
        let [a_re, b_re] = [a, b].map(|m| m.map(|z| z.re));
        let [a_im, b_im] = [a, b].map(|m| m.map(|z| z.im));
        let mut re = &a_re * &b_re;
        re.gemm(-1.0, &a_im, &b_im, 1.0);
        let mut im = a_re * b_im;
        im.gemm(1.0, &a_im, &b_re, 1.0);
        re.zip_map(&im, Complex::new)
    }
}
