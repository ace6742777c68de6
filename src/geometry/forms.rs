//! Differential forms in a frame: the exterior derivative, products, and Cartan's structure
//! equations.
//!
//! A form of degree `p` is stored by its components `w_{i1...ip} = w(e_i1, ..., e_ip)`, which are
//! antisymmetric: `w = 1/p! w_{i1...ip} e^i1 ^ ... ^ e^ip`. The exterior derivative and the wedge
//! product contain no factorials: `(e^1 ^ e^2)(e_1, e_2) = 1` and
//! `dw(x,y) = x(w(y)) - y(w(x)) - w([x,y])`. This is the convention of Spivak and Warner; the
//! exterior derivative of Kobayashi and Nomizu is divided by `p + 1`.

use crate::Error;
use crate::algebra::LETTERS;
use crate::algebra::frame::{Frame, expect_numbers, expect_slots, expect_symmetry};
use crate::geometry::connection::Connection;
use affinor_tensors::{Down, Indices, Scalar, Tensor, TensorError, Up, contract};

/// A differential form: antisymmetric components with lower slots.
#[derive(Clone, Debug, PartialEq)]
pub struct Form<S>(Tensor<S>);

impl<S: Scalar> Form<S> {
    /// A form with these components, which must have lower slots only. A form of degree 0 is a
    /// function.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`Error::NotFinite`]; [`Error::Symmetry`] unless the components are
    /// antisymmetric.
    pub fn new(components: Tensor<S>) -> Result<Self, Error> {
        let degree = components.rank();
        expect_slots("the form", &components, components.dimension(), &vec![Down; degree])?;
        expect_numbers("the form", &components)?;
        // checks neighbouring slots only, because exchanges of neighbours generate all permutations
        for a in 1..degree {
            expect_symmetry("the form", &components, [a - 1, a], -1)?;
        }
        Ok(Form(components))
    }

    /// The form of degree `degree` with these components at increasing indices. The other components
    /// follow by antisymmetry.
    ///
    /// # Errors
    /// [`Error::Tensor`] for indices outside the dimension, and beyond degree 8.
    pub fn from_increasing(
        dimension: usize,
        degree: usize,
        entries: impl IntoIterator<Item = (Vec<usize>, S)>,
    ) -> Result<Self, Error> {
        let mut all = vec![];
        for (at, value) in entries {
            for (permuted, odd) in permutations(&at) {
                all.push((permuted, if odd { -value.clone() } else { value.clone() }));
            }
        }
        Ok(Form(Tensor::from_components(dimension, &vec![Down; degree], all)?))
    }

    /// The components `w_{i1...ip}`.
    pub fn components(&self) -> &Tensor<S> {
        &self.0
    }

    /// The degree `p`.
    pub fn degree(&self) -> usize {
        self.0.rank()
    }

    /// Whether the form is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The exterior product, `a ^ b = (p+q)!/(p! q!) Alt(a b)`. It is the signed sum of
    /// `a_{i...} b_{j...}` over all distributions of the indices among the factors.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let e = so3.left_frame().coframe();
    /// let area = e[0].wedge(&e[1])?;
    /// assert_eq!(area.components().get(&[1, 0]), (-1).into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TensorError::Dimension`] if the dimensions differ; [`TensorError::TooLarge`] beyond
    /// degree 8.
    #[doc(alias("exterior product"))]
    pub fn wedge(&self, other: &Self) -> Result<Self, Error> {
        let (p, degree) = (self.degree(), self.degree() + other.degree());
        let letters = letters(self.0.dimension(), degree)?;
        let mut sum = String::new();
        for chosen in 0..1u32 << degree {
            if chosen.count_ones() as usize != p {
                continue;
            }
            let (mut mine, mut theirs, mut odd) = (String::new(), String::new(), false);
            for (at, letter) in letters.chars().enumerate() {
                if chosen >> at & 1 == 1 {
                    mine.push(letter);
                    odd ^= theirs.len() % 2 == 1;
                } else {
                    theirs.push(letter);
                }
            }
            sum += &format!(" {} a{} b{}", sign(odd), lower(&mine), lower(&theirs));
        }
        let result = antisymmetric(letters);
        Ok(Form(contract(&format!("{sum} -> {result}"), &[("a", &self.0), ("b", &other.0)])?))
    }

    /// The interior product with a vector: `(i_X w)_{j...} = X^i w_{ij...}`. It is zero for
    /// functions.
    ///
    /// # Errors
    /// [`Error::Shape`] unless `X` has the slots `^i` in the dimension of the form.
    pub fn interior(&self, vector: &Tensor<S>) -> Result<Self, Error> {
        let n = self.0.dimension();
        expect_slots("the vector", vector, n, &[Up])?;
        if self.degree() == 0 {
            return Ok(Form(Tensor::zero(n, &[])?));
        }
        let rest = letters(n, self.degree() - 1)?;
        let text = format!("X^p w{} -> {}", lower(&format!("p{rest}")), antisymmetric(rest));
        Ok(Form(contract(&text, &[("X", vector), ("w", &self.0)])?))
    }
}

impl<S: Scalar> Frame<S> {
    /// The dual forms `e^1 ... e^n`, which satisfy `e^i(e_j) = delta^i_j`. The dual forms of an
    /// algebra are its Maurer-Cartan forms, with `de^i = -1/2 c^i_jk e^j ^ e^k`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::Rational;
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let frame = so3.left_frame();
    /// // de^3 = -e^1 ^ e^2
    /// let form = frame.exterior_derivative(&frame.coframe()[2])?;
    /// assert_eq!(form.components().get(&[0, 1]), (-1).into());
    /// # Ok::<(), affinor::Error>(())
    /// ```
    #[doc(alias("Maurer-Cartan", "dual basis"))]
    pub fn coframe(&self) -> Vec<Form<S>> {
        let unit = |i: usize| {
            let mut components = vec![S::zero(); self.dimension()];
            components[i] = S::one();
            Form(
                Tensor::vector(&components, Down)
                    .with_tolerance(self.structure_functions().tolerance()),
            )
        };
        (0..self.dimension()).map(unit).collect()
    }

    /// The exterior derivative of a form,
    ///
    /// ```text
    /// (dw)_{i0..ip} = sum_a     (-1)^a     e_ia(w_{.. no ia ..})
    ///               + sum_{a<b} (-1)^(a+b) c^m_{ia ib} w_{m .. no ia, ib ..}
    /// ```
    ///
    /// On left-invariant forms, only the second sum remains. It is the differential of C. Chevalley
    /// and S. Eilenberg, *Trans. Amer. Math. Soc.* 63 (1948) 85-124. The Jacobi identity implies
    /// `d d = 0`. On a homogeneous space, the method computes the differential of invariant forms.
    ///
    /// # Errors
    /// [`Error::Shape`]; [`TensorError::TooLarge`] beyond degree 8.
    #[doc(alias("differential"))]
    pub fn exterior_derivative(&self, form: &Form<S>) -> Result<Form<S>, Error> {
        let letters = letters(self.dimension(), form.degree() + 1)?;
        let derivative = self.derivative(&form.0)?;
        let mut sum = String::new();
        for (a, first) in letters.chars().enumerate() {
            let rest = letters.replace(first, "");
            sum += &format!(" {} d{}", sign(a % 2 == 1), lower(&format!("{first}{rest}")));
            for (b, second) in letters.chars().enumerate().skip(a + 1) {
                let rest = lower(&format!("m{}", rest.replace(second, "")));
                sum += &format!(" {} c^m_{first}{second} w{rest}", sign((a + b) % 2 == 1));
            }
        }
        let text = format!("{sum} -> {}", antisymmetric(letters));
        let operands = [("d", &derivative), ("c", self.structure_functions()), ("w", &form.0)];
        Ok(Form(contract(&text, &operands)?))
    }
}

impl<S: Scalar> Connection<S> {
    /// The connection forms `w^i_j = Lambda^i_kj e^k`, defined by `nabla e_j = w^i_j e_i`. The
    /// first index of the list is `i`, and the second is `j`.
    pub fn connection_forms(&self) -> Vec<Vec<Form<S>>> {
        let n = self.frame().dimension();
        let mut forms = vec![vec![vec![S::zero(); n]; n]; n];
        for (at, value) in self.affinities().components() {
            forms[at[0]][at[2]][at[1]] = value.clone();
        }
        let tolerance = self.affinities().tolerance();
        let form = |w: Vec<S>| Form(Tensor::vector(&w, Down).with_tolerance(tolerance));
        forms.into_iter().map(|row| row.into_iter().map(form).collect()).collect()
    }

    /// The torsion forms, computed by Cartan's first structure equation,
    /// `T^i = de^i + w^i_j ^ e^j`. Their components are the [`torsion`](Self::torsion),
    /// `T^i(e_j, e_k) = tau^i_jk`.
    ///
    /// # Errors
    /// [`Error::Tensor`] if the dimension is too large for the indices of a tensor, 64 bits.
    pub fn torsion_forms(&self) -> Result<Vec<Form<S>>, Error> {
        let (frame, coframe) = (self.frame(), self.frame().coframe());
        let equation = |(e, w): (&Form<S>, Vec<Form<S>>)| {
            let products = w.iter().zip(&coframe).map(|(w, e)| w.wedge(e));
            total(frame.exterior_derivative(e)?, products)
        };
        coframe.iter().zip(self.connection_forms()).map(equation).collect()
    }

    /// The curvature forms, computed by Cartan's second structure equation,
    /// `W^i_j = dw^i_j + w^i_k ^ w^k_j`. The first index of the list is `i`, and the second is `j`.
    /// Their components are the [`curvature`](Self::curvature), `W^i_j(e_k, e_l) = R^i_jkl`.
    ///
    /// ```
    /// use affinor::algebra::catalogue;
    /// use affinor::{Connection, Metric, Rational};
    /// let so3 = catalogue::algebra::<Rational>("so(3)")?;
    /// let round = Metric::identity(3)?;
    /// let connection = Connection::levi_civita(so3.left_frame(), &round)?;
    /// let forms = connection.curvature_forms()?;
    /// assert_eq!(Some(forms[0][1].components().get(&[0, 1])), Rational::new(1, 4));
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unsupported`] on a homogeneous space, where the connection forms are defined on the
    /// group and not on `m`; [`Error::Tensor`] if the dimension is too large.
    #[doc(alias("structure equations", "Cartan"))]
    pub fn curvature_forms(&self) -> Result<Vec<Vec<Form<S>>>, Error> {
        if !self.frame().isotropy()?.is_empty() {
            return Err(Error::Unsupported(
                "the connection forms of a homogeneous space are defined on G, not on m".into(),
            ));
        }
        let (n, w) = (self.frame().dimension(), self.connection_forms());
        let equation = |i: usize, j: usize| {
            let products = (0..n).map(|k| w[i][k].wedge(&w[k][j]));
            total(self.frame().exterior_derivative(&w[i][j])?, products)
        };
        (0..n).map(|i| (0..n).map(|j| equation(i, j)).collect()).collect()
    }
}

/// All orders of the indices, each with whether it is odd.
fn permutations(at: &[usize]) -> Vec<(Vec<usize>, bool)> {
    let Some((first, rest)) = at.split_first() else { return vec![(vec![], false)] };
    let inserted = |(order, odd): (Vec<usize>, bool)| {
        (0..=order.len()).map(move |place| {
            let mut next = order.clone();
            next.insert(place, *first);
            (next, odd ^ (place % 2 == 1))
        })
    };
    permutations(rest).into_iter().flat_map(inserted).collect()
}

/// The sum of several 2-forms.
fn total<S: Scalar>(
    first: Form<S>,
    others: impl Iterator<Item = Result<Form<S>, Error>>,
) -> Result<Form<S>, Error> {
    others.into_iter().try_fold(first, |sum, other| {
        let operands = [("a", &sum.0), ("b", &other?.0)];
        Ok(Form(contract("a_jk + b_jk -> _[jk]", &operands)?))
    })
}

/// The index letters of a form of degree `degree`.
fn letters(dimension: usize, degree: usize) -> Result<&'static str, Error> {
    let fits = degree <= Indices::MAX;
    let letters = fits.then(|| &LETTERS[..degree]);
    Ok(letters.ok_or(TensorError::TooLarge { dimension, rank: degree })?)
}

fn lower(letters: &str) -> String {
    if letters.is_empty() { String::new() } else { format!("_{letters}") }
}

/// The index notation of an antisymmetric result with these letters.
fn antisymmetric(letters: &str) -> String {
    if letters.len() < 2 { lower(letters) } else { format!("_[{letters}]") }
}

fn sign(odd: bool) -> &'static str {
    if odd { "-" } else { "+" }
}
