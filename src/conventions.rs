//! The conventions of signs and indices, fixed once for everything here.
//!
//! Every line of [`ALL`] is shown to hold by one of the tests below. Command line, files and
//! messages count indices from 1, Rust from 0.
//!
//! The tests share one algebra that hides no sign and no order of indices, aff(1) with
//! `[x, y] = y`: it is neither unimodular nor semisimple.
//!
//! *Bracket*: `[e_j, e_k] = c^i_jk e_i`, and `(ad_n)^i_k = c^i_jk n^j` with the upper index as row.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let aff = aff(); // [x, y] = y
//! assert_eq!(aff.structure().get(&[1, 0, 1]), 1.into()); // c^2_12 = 1
//! let ad_x = aff.ad(&[1.into(), 0.into()])?;
//! assert_eq!(ad_x.get(&[1, 1]), 1.into()); // row 2, column 2
//! # Ok::<(), Error>(())
//! ```
//! *Affinities*: `nabla_{e_j} e_k = Lambda^i_jk e_i`, the first lower index is the direction;
//! `plus` is `Lambda = c`. *Torsion* (B10): `tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let plus = Connection::canonical(&aff(), Canonical::Plus);
//! assert_eq!(plus.gamma().get(&[1, 0, 1]), 1.into()); // nabla_x y = y
//! assert_eq!(plus.torsion().get(&[1, 0, 1]), 1.into()); // tau = c
//! # Ok::<(), Error>(())
//! ```
//! *Curvature* (B14): `R(e_k, e_l) e_j = R^i_jkl e_i`. *Ricci*: `Ric_jl = R^i_jil`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let zero = Connection::canonical(&aff(), Canonical::Zero);
//! // R(x, y) x = -1/4 [[x, y], x] = 1/4 y
//! assert_eq!(zero.curvature().get(&[1, 0, 0, 1]), Rational::new(1, 4).unwrap());
//! // Ric(x, x) = trace of v -> R(v, x) x = -1/4
//! assert_eq!(zero.ricci().get(&[0, 0]), Rational::new(-1, 4).unwrap());
//! # Ok::<(), Error>(())
//! ```
//! *nabla of a tensor*: `(nabla_m T)^i_j = e_m(T^i_j) + Lambda^i_mp T^p_j - Lambda^p_mj T^i_p`,
//! the direction is the first lower index. *Nonmetricity*: `Q_kij = (nabla_k g)_ij`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let plus = Connection::canonical(&aff(), Canonical::Plus);
//! let labels = plus.frame().labels().clone();
//! let one = Tensor::from_fn(2, [Down, Down], |[i, j]| i64::from(i == j).into())?;
//! let g = Metric::new(&labels, one)?;
//! assert_eq!(plus.nonmetricity(&g)?.get(&[0, 1, 1]), (-2).into()); // Q_122 = -2 g(nabla_x y, y)
//! # Ok::<(), Error>(())
//! ```
//! *Sectional curvature*: `K(x,y) = g(R(x,y)y, x) / (g(x,x) g(y,y) - g(x,y)^2)`; with
//! *Levi-Civita* by Koszul's formula aff(1) is the hyperbolic plane. *Scalar*: `S = g^jl Ric_jl`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let one = Tensor::from_fn(2, [Down, Down], |[i, j]| i64::from(i == j).into())?;
//! let g = Metric::new(aff().labels(), one)?;
//! let plane = Connection::levi_civita(aff().left_frame(), &g)?;
//! let k = plane.sectional_curvature(&g, &[1.into(), 0.into()], &[0.into(), 1.into()])?;
//! assert_eq!(k, Some((-1).into()));
//! assert_eq!(plane.scalar_curvature(&g)?, (-2).into());
//! # Ok::<(), Error>(())
//! ```
//! *Killing form*: `K_ij = c^m_il c^l_jm = tr(ad_i ad_j)`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! assert_eq!(aff().killing_form().get(&[0, 0]), 1.into());
//! ```
//! *Right frame*: structure `-c`, and `Lambda_right = Lambda - c` for connections invariant
//! under ad; others are refused. `g -> g^-1` exchanges the frames, and `lambda` with `1 - lambda`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let plus = Connection::canonical(&aff(), Canonical::Plus);
//! let right = plus.in_right_frame(&aff())?;
//! assert!(right.gamma().is_empty()); // right-invariant fields are parallel for plus
//! assert_eq!(right.frame().structure().get(&[1, 0, 1]), (-1).into());
//! # Ok::<(), Error>(())
//! ```
//! *Change of basis*: `e'_a = A^i_a e_i`, so `c' = A^-1 c (A, A)`, `g' = A^T g A`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! // e'_1 = x + 2 y, e'_2 = 3 y: columns of A
//! let a = Tensor::from_components(
//!     2, &[Up, Down], [([0, 0], 1), ([1, 0], 2), ([1, 1], 3)].map(|(at, v)| (at, v.into())),
//! )?;
//! let changed = aff().change_basis(&BasisChange::new(a)?)?;
//! assert_eq!(changed.structure().get(&[1, 0, 1]), Rational::from(1)); // [e'_1, e'_2] = e'_2
//! # Ok::<(), Error>(())
//! ```
//! *Change of frame* by functions `A`: affinities follow the inhomogeneous law
//! `Lambda' = A^-1 (Lambda(A, A) + e(A))`, structure functions its antisymmetric part (A6).
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! // the flat plane: e'_1 = d_x, e'_2 = x d_y, so nabla_{e'_1} e'_2 = 1/x e'_2
//! let plane = Connection::new(
//!     Frame::coordinates(&["x", "y"])?, Tensor::zero(2, &[Up, Down, Down])?,
//! )?;
//! let (x, one) = (Symbolic::parameter("x"), Symbolic::from_i64(1));
//! let a = Tensor::from_components(2, &[Up, Down], [([0, 0], one.clone()), ([1, 1], x.clone())])?;
//! let moved = plane.moved(["u", "v"].map(String::from).into(), &BasisChange::new(a)?)?;
//! assert_eq!(moved.gamma().get(&[1, 0, 1]), one.clone() / &x);
//! assert_eq!(moved.frame().structure().get(&[1, 0, 1]), one / &x);
//! # Ok::<(), Error>(())
//! ```
//! *Transport* along the autoparallel of a constant `n`: `du/dt = -Lambda(n) u`, that is `-ad_n`
//! for `plus`.
//! ```
//! # use affinor::*; use affinor_tensors::*;
//! # fn aff() -> LieAlgebra<Rational> {
//! #     Bracket::from_fn(&["x", "y"], |_, _| vec![(1, 1.into())]).unwrap().try_into().unwrap()
//! # }
//! let plus = Connection::canonical(&aff(), Canonical::Plus);
//! let generator = plus.transport_generator(&[1.into(), 0.into()])?;
//! assert_eq!(generator.get(&[1, 1]), (-1).into());
//! # Ok::<(), Error>(())
//! ```

/// The bracket of the frame.
pub const BRACKET: &str = "[e_j, e_k] = c^i_jk e_i";
/// Affinities.
pub const AFFINITIES: &str = "nabla_{e_j} e_k = Lambda^i_jk e_i";
/// Torsion.
pub const TORSION: &str = "tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk";
/// What curvature does.
pub const CURVATURE: &str = "R(e_k, e_l) e_j = R^i_jkl e_i";
/// Curvature in components.
pub const CURVATURE_COMPONENTS: &str = "R^i_jkl = e_k(Lambda^i_lj) - e_l(Lambda^i_kj) \
     + Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c^m_kl Lambda^i_mj";
/// Ricci tensor.
pub const RICCI: &str = "Ric_jl = R^i_jil";
/// Scalar curvature.
pub const SCALAR_CURVATURE: &str = "S = g^jl Ric_jl";
/// Nonmetricity.
pub const NONMETRICITY: &str =
    "Q_kij = (nabla_k g)_ij = e_k(g_ij) - Lambda^m_ki g_mj - Lambda^m_kj g_im";
/// Killing form.
pub const KILLING: &str = "K_ij = c^m_il c^l_jm";

/// The conventions, as (object, its lines), in the order in which they build on each other.
pub const ALL: &[(&str, &[&str])] = &[
    ("frame", &["e_1..e_n, for an algebra the left-invariant fields through its basis"]),
    ("bracket", &[BRACKET, "for matrices AB - BA"]),
    ("ad", &["(ad_n)^i_k = c^i_jk n^j, the upper index is the row"]),
    ("affinities", &[AFFINITIES, "first lower index = direction, second = differentiated vector"]),
    (
        "nabla",
        &[
            "(nabla_m T)^i_j = e_m(T^i_j) + Lambda^i_mp T^p_j - Lambda^p_mj T^i_p, the direction is \
         the first lower index",
        ],
    ),
    ("torsion (B10)", &[TORSION]),
    ("curvature (B14)", &[CURVATURE_COMPONENTS, CURVATURE]),
    (
        "Bianchi, first",
        &["cyclic sum over j,k,l of R^i_jkl - tau^m_kl tau^i_mj - (nabla_k tau)^i_lj = 0"],
    ),
    ("Bianchi, second", &["cyclic sum over m,k,l of (nabla_m R)^i_jkl + tau^p_mk R^i_jpl = 0"]),
    ("Ricci, scalar", &[RICCI, SCALAR_CURVATURE]),
    ("sectional", &["K(x,y) = g(R(x,y)y, x) / (g(x,x) g(y,y) - g(x,y)^2)"]),
    ("nonmetricity", &[NONMETRICITY]),
    (
        "Levi-Civita",
        &["2 g(nabla_{e_j} e_k, e_i) = g([e_j,e_k],e_i) - g([e_k,e_i],e_j) + g([e_i,e_j],e_k)"],
    ),
    ("Killing form", &[KILLING, "= tr(ad_i ad_j)"]),
    (
        "canonical connections",
        &[
            "Lambda = lambda c in the left frame: plus, lambda = 1 (the paper's (29), left invariant \
         canonical, M(3)); zero, 1/2 ((31), symmetric, SO(3)); minus, 0 ((30), right invariant \
         canonical)",
        ],
    ),
    (
        "right frame",
        &[
            "structure -c; Lambda_right = Lambda - c if Lambda is invariant under ad, else refused; \
         g -> g^-1 exchanges the frames, and lambda with 1 - lambda",
        ],
    ),
    ("change of basis", &["e'_a = A^i_a e_i; c' = A^-1 c (A, A), g' = A^T g A"]),
    (
        "change of frame",
        &["e'_a = A^i_a e_i with functions A: Lambda'^c_ab = B^c_i (Lambda^i_jk A^j_a A^k_b \
         + A^j_a e_j(A^i_b)), B = A^-1; [e'_a, e'_b] = c'^c_ab e'_c (A6)"],
    ),
    ("transport", &["du/dt = -Lambda(n) u along the autoparallel of n: -ad_n for plus"]),
    ("tangent operators", &["T_left(x) = sum (-ad_x)^k/(k+1)!, T_right(x) = sum ad_x^k/(k+1)!"]),
    ("spin", &["spin(w) x = w x x, rows [0,-w3,w2], [w3,0,-w1], [-w2,w1,0]"]),
    (
        "rotation",
        &["R maps body to spatial components; Rdot = R spin(Omega) = spin(omega) R; quaternions \
         w,x,y,z"],
    ),
    (
        "mechanics",
        &[
            "H = J Omega (body covector), h = R H (spatial); Hdot_i = Lambda^j_ki Omega^k H_j + M_i \
         with plus",
        ],
    ),
];
