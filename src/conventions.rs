//! The conventions of signs and index orders. Only this module fixes them.
//!
//! The tests below verify every line of [`ALL`]. The command line, files and messages count indices
//! from 1, but Rust counts from 0. Most tests use aff(1), `[x, y] = y`. This algebra is neither
//! unimodular nor semisimple, so that each wrong sign or index order fails a test. Numbers such as
//! (B14) are the numbers of the equations in E. Paraskevopoulos and S. Natsiavas (2013); see the
//! [crate documentation](crate).
//!
//! # Algebras
//!
//! - *Bracket*: `[e_j, e_k] = c^i_jk e_i`, and `(ad_n)^i_k = c^i_jk n^j`, where the upper index is
//!   the row.
//! - *Killing form*: `K_ij = c^m_il c^l_jm = tr(ad_i ad_j)`.
//! - *Change of basis*: `e'_a = A^i_a e_i`, so `c' = A^-1 c (A, A)`, `g' = A^T g A`.
//! - *Lie derivative*: `L_X Y = [X, Y]`.
//! - *Forms*: `dw(x,y) = x(w(y)) - y(w(x)) - w([x,y])` and `(a ^ b)(x,y) = a(x) b(y) - a(y) b(x)`,
//!   without factorials.
//! - *Lie-Poisson*: `{mu_i, mu_j} = -c^k_ij mu_k` for left-invariant systems, and the opposite sign
//!   for right-invariant systems.
//!
//! ```
//! # use affinor::*;
//! let aff = algebra::catalogue::algebra::<Rational>("aff(1)")?; // [x, y] = y
//! assert_eq!(aff.structure_constants().get(&[1, 0, 1]), 1.into()); // c^2_12 = 1
//! let ad_x = aff.ad(&[1.into(), 0.into()])?;
//! assert_eq!(ad_x.get(&[1, 1]), 1.into()); // row 2, column 2
//! assert_eq!(aff.killing_form().get(&[0, 0]), 1.into());
//! // e'_1 = x + 2 y, e'_2 = 3 y: columns of A
//! let a = Tensor::from_components(
//!     2, &[Up, Down], [([0, 0], 1), ([1, 0], 2), ([1, 1], 3)].map(|(at, v)| (at, v.into())),
//! )?;
//! let changed = aff.change_basis(&BasisChange::new(a)?)?;
//! assert_eq!(changed.structure_constants().get(&[1, 0, 1]), Rational::from(1)); // [e'_1, e'_2] = e'_2
//! let frame = aff.left_frame();
//! let [x, y] = [[1, 0], [0, 1]].map(|v| Tensor::vector(&v.map(Rational::from), Up));
//! assert_eq!(frame.lie_derivative(&x, &y)?, y);
//! let [dx, dy] = &frame.coframe()[..] else { unreachable!() };
//! assert_eq!(frame.exterior_derivative(dy)?.components().get(&[0, 1]), (-1).into());
//! assert_eq!(dx.wedge(dy)?.components().get(&[0, 1]), 1.into());
//! let dual = LiePoisson::left(&aff.map(|v| Symbolic::constant(v.clone()))?)?;
//! let [mu1, mu2] = dual.coordinates() else { unreachable!() };
//! assert_eq!(dual.bracket(mu1, mu2)?, -mu2.clone());
//! # Ok::<(), Error>(())
//! ```
//!
//! # Connections
//!
//! - *Affinities*: `nabla_{e_j} e_k = Lambda^i_jk e_i`. The first lower index is the direction. The
//!   connection `plus` is `Lambda = c`.
//! - *Torsion* (B10): `tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk`.
//! - *Curvature* (B14): `R(e_k, e_l) e_j = R^i_jkl e_i`. *Ricci*: `Ric_jl = R^i_jil`. Its parts
//!   `symRic` and `altRic` contain the factor 1/2.
//! - *Right frame*: the structure is `-c`. Connections that are invariant under ad have the
//!   affinities `Lambda_right = Lambda - c`; other connections are rejected. The map `g -> g^-1`
//!   exchanges the frames, and exchanges `lambda` with `1 - lambda`.
//! - *Transport* along the autoparallel of a constant `n`: `du/dt = -Lambda(n) u`. The generator is
//!   `-ad_n` for `plus`.
//! - *Change of frame* by functions `A`: affinities follow the inhomogeneous law
//!   `Lambda' = A^-1 (Lambda(A, A) + e(A))`, and structure functions follow the antisymmetric part
//!   of this law (A6).
//! - *Homogeneous spaces* G/H with `g = m + h`: the curvature `R(x,y)` on `m` has the additional
//!   term `-[[x,y]_h, .]`.
//!
//! ```
//! # use affinor::*;
//! let aff = algebra::catalogue::algebra::<Rational>("aff(1)")?;
//! let [plus, zero] = [CanonicalConnection::Plus, CanonicalConnection::Zero].map(|which| Connection::canonical(&aff, which));
//! assert_eq!(plus.affinities().get(&[1, 0, 1]), 1.into()); // nabla_x y = y
//! assert_eq!(plus.torsion().get(&[1, 0, 1]), 1.into()); // tau = c
//! // R(x, y) x = -1/4 [[x, y], x] = 1/4 y
//! assert_eq!(zero.curvature().get(&[1, 0, 0, 1]), Rational::new(1, 4).unwrap());
//! // Ric(x, x) = trace of v -> R(v, x) x = -1/4
//! assert_eq!(zero.ricci().get(&[0, 0]), Rational::new(-1, 4).unwrap());
//! // nabla_y y = y and nothing else: R(x,y) y = -nabla_[x,y] y = -y, so Ric(y,x) = 1
//! let gamma = Tensor::from_components(2, &[Up, Down, Down], [([1, 1, 1], 1.into())])?;
//! let skew = Connection::new(aff.left_frame().clone(), gamma)?;
//! assert_eq!(skew.ricci_symmetric()?.get(&[0, 1]), Rational::new(1, 2).unwrap());
//! assert_eq!(skew.ricci_antisymmetric()?.get(&[1, 0]), Rational::new(1, 2).unwrap());
//! let right = plus.in_right_frame(&aff)?;
//! assert!(right.affinities().is_empty()); // right-invariant fields are parallel for plus
//! assert_eq!(right.frame().structure_functions().get(&[1, 0, 1]), (-1).into());
//! let generator = plus.transport_generator(&[1.into(), 0.into()])?;
//! assert_eq!(generator.get(&[1, 1]), (-1).into());
//! // the flat plane: e'_1 = d_x, e'_2 = x d_y, so nabla_{e'_1} e'_2 = 1/x e'_2
//! let plane = Connection::new(
//!     Frame::coordinates(&["x", "y"])?, Tensor::zero(2, &[Up, Down, Down])?,
//! )?;
//! let (x, one) = (Symbolic::parameter("x"), Symbolic::from_i64(1));
//! let a = Tensor::from_components(2, &[Up, Down], [([0, 0], one.clone()), ([1, 1], x.clone())])?;
//! let moved = plane.moved(["u", "v"], &BasisChange::new(a)?)?;
//! assert_eq!(moved.affinities().get(&[1, 0, 1]), one.clone() / &x);
//! assert_eq!(moved.frame().structure_functions().get(&[1, 0, 1]), one / &x);
//! // the sphere: [e_1, e_2] = e_3 and cyclic, rotations about the third axis
//! let so3 = algebra::catalogue::algebra::<Rational>("so(3)")?;
//! let h = [0, 0, 1].map(Rational::from).to_vec();
//! let sphere = ReductivePair::orthogonal(&so3, &[h])?;
//! assert_eq!(sphere.canonical().curvature().get(&[0, 1, 0, 1]), 1.into());
//! # Ok::<(), Error>(())
//! ```
//!
//! # Metrics
//!
//! - *nabla of a tensor*: `(nabla_m T)^i_j = e_m(T^i_j) + Lambda^i_mp T^p_j - Lambda^p_mj T^i_p`,
//!   where the direction is the first lower index. *Nonmetricity*: `Q_kij = (nabla_k g)_ij`.
//! - *Sectional curvature*: `K(x,y) = g(R(x,y)y, x) / (g(x,x) g(y,y) - g(x,y)^2)`. With the
//!   *Levi-Civita* connection, from Koszul's formula, aff(1) is the hyperbolic plane. *Scalar*:
//!   `S = g^jl Ric_jl`.
//! - *Einstein*: `G_jl = Ric_jl - 1/2 S g_jl`. *Trace-free Ricci*: `tfRic_jl = Ric_jl - S/n g_jl`.
//!   *Kretschmann*: `Kr = R_ijkl R^ijkl`.
//! - *Contorsion* `K_ijk = (tau_ijk + tau_jik + tau_kij)/2` and *disformation*
//!   `L_ijk = (Q_ijk - Q_jki - Q_kij)/2`, where the metric lowers the first index:
//!   `Lambda = LeviCivita + K + L`.
//! - *Schouten*: `P_jl = (Ric_jl - S/(2(n-1)) g_jl)/(n-2)`. *Weyl*: `W^i_jkl = R^i_jkl - delta^i_k
//!   P_jl + delta^i_l P_jk - g_jl P^i_k + g_jk P^i_l`. *Cotton*: `C_jkl = (nabla_k P)_jl - (nabla_l
//!   P)_jk`.
//!
//! ```
//! # use affinor::*;
//! let aff = algebra::catalogue::algebra::<Rational>("aff(1)")?;
//! let (plus, g) = (Connection::canonical(&aff, CanonicalConnection::Plus), Metric::identity(2)?);
//! assert_eq!(plus.nonmetricity(&g)?.get(&[0, 1, 1]), (-2).into()); // Q_122 = -2 g(nabla_x y, y)
//! // the hyperbolic plane: R_1212 = -1 and its mirror images; G = 0 as on every surface
//! let plane = Connection::levi_civita(aff.left_frame(), &g)?;
//! let k = plane.sectional_curvature(&g, &[1.into(), 0.into()], &[0.into(), 1.into()])?;
//! assert_eq!(k, Some((-1).into()));
//! assert_eq!(plane.scalar_curvature(&g)?, (-2).into());
//! assert_eq!(plane.kretschmann(&g)?, 4.into());
//! assert!(plane.einstein(&g)?.is_empty());
//! let at = [0, 1, 1]; // the part of nabla_y y along x: 0 for plus, 1 for Levi-Civita
//! assert_eq!(plane.affinities().get(&at), 1.into());
//! assert_eq!(plus.contorsion(&g)?.get(&at), 1.into());
//! assert_eq!(plus.disformation(&g)?.get(&at), (-2).into());
//! // the Heisenberg group, [x1, y1] = z: Ric = diag(-1/2, -1/2, 1/2), S = -1/2
//! let (algebra, g) = (algebra::catalogue::algebra::<Rational>("heisenberg(3)")?, Metric::identity(3)?);
//! let nil = Connection::levi_civita(algebra.left_frame(), &g)?;
//! let p = nil.schouten(&g)?;
//! assert_eq!(p.get(&[0, 0]), Rational::new(-3, 8).unwrap());
//! assert_eq!(p.get(&[2, 2]), Rational::new(5, 8).unwrap());
//! // nabla_x y = z/2, nabla_x z = -y/2: (nabla_x P)(z,y) = P(y,y)/2 - P(z,z)/2 = -1/2, and
//! // (nabla_y P)(z,x) = 1/2
//! assert_eq!(nil.cotton(&g)?.get(&[2, 0, 1]), Rational::from(-1));
//! assert!(nil.weyl(&g)?.is_empty()); // in dimension 3
//! # Ok::<(), Error>(())
//! ```

/// The bracket of the frame.
pub const BRACKET: &str = "[e_j, e_k] = c^i_jk e_i";
/// The affinities.
pub const AFFINITIES: &str = "nabla_{e_j} e_k = Lambda^i_jk e_i";
/// The torsion.
pub const TORSION: &str = "tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk";
/// The curvature as an operator.
pub const CURVATURE: &str = "R(e_k, e_l) e_j = R^i_jkl e_i";
/// The curvature in components.
pub const CURVATURE_COMPONENTS: &str = "R^i_jkl = e_k(Lambda^i_lj) - e_l(Lambda^i_kj) \
     + Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c^m_kl Lambda^i_mj";
/// The Ricci tensor.
pub const RICCI: &str = "Ric_jl = R^i_jil";
/// The scalar curvature.
pub const SCALAR_CURVATURE: &str = "S = g^jl Ric_jl";
/// The nonmetricity.
pub const NONMETRICITY: &str =
    "Q_kij = (nabla_k g)_ij = e_k(g_ij) - Lambda^m_ki g_mj - Lambda^m_kj g_im";
/// The metric.
pub const METRIC: &str = "g_ij = g(e_i, e_j)";
/// The inverse metric.
pub const INVERSE_METRIC: &str = "g^ij g_jk = delta^i_k";
/// The derivative of the torsion.
pub const NABLA_TORSION: &str = "(nabla tau)^i_mjk = (nabla_m tau)^i_jk";
/// The derivative of the curvature.
pub const NABLA_CURVATURE: &str = "(nabla R)^i_mjkl = (nabla_m R)^i_jkl";
/// The symmetric part of the Ricci tensor.
pub const RICCI_SYMMETRIC: &str = "symRic_jl = 1/2 (Ric_jl + Ric_lj)";
/// The antisymmetric part of the Ricci tensor.
pub const RICCI_ANTISYMMETRIC: &str = "altRic_jl = 1/2 (Ric_jl - Ric_lj)";
/// The trace-free part of the Ricci tensor.
pub const RICCI_TRACE_FREE: &str = "tfRic_jl = Ric_jl - S/n g_jl";
/// The Einstein tensor.
pub const EINSTEIN: &str = "G_jl = Ric_jl - 1/2 S g_jl";
/// The Schouten tensor.
pub const SCHOUTEN: &str = "P_jl = (Ric_jl - S/(2(n-1)) g_jl)/(n-2)";
/// The Weyl tensor.
pub const WEYL: &str =
    "W^i_jkl = R^i_jkl - delta^i_k P_jl + delta^i_l P_jk - g_jl P^i_k + g_jk P^i_l";
/// The Cotton tensor.
pub const COTTON: &str = "C_jkl = (nabla_k P)_jl - (nabla_l P)_jk";
/// The Kretschmann scalar.
pub const KRETSCHMANN: &str = "Kr = R_ijkl R^ijkl";
/// The Killing form.
pub const KILLING: &str = "K_ij = c^m_il c^l_jm";

/// All conventions, as pairs of an object and its lines. They are listed in the order in which they
/// build on each other.
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
    ("Ricci, parts", &[RICCI_SYMMETRIC, RICCI_ANTISYMMETRIC]),
    ("Ricci, trace-free", &[RICCI_TRACE_FREE]),
    ("Einstein", &[EINSTEIN]),
    ("Schouten, Weyl, Cotton", &[SCHOUTEN, WEYL, COTTON, "of Levi-Civita, in dimension n >= 3"]),
    ("Kretschmann", &[KRETSCHMANN]),
    ("nonmetricity", &[NONMETRICITY]),
    (
        "Levi-Civita",
        &["2 g(nabla_{e_j} e_k, e_i) = g([e_j,e_k],e_i) - g([e_k,e_i],e_j) + g([e_i,e_j],e_k)"],
    ),
    ("contorsion", &["K_ijk = (tau_ijk + tau_jik + tau_kij)/2, the first index lowered"]),
    (
        "disformation",
        &["L_ijk = (Q_ijk - Q_jki - Q_kij)/2; Lambda = Levi-Civita + contorsion + disformation"],
    ),
    ("Lie derivative", &["L_X Y = [X, Y]"]),
    (
        "forms",
        &["dw(x,y) = x(w(y)) - y(w(x)) - w([x,y]); (a ^ b)(x,y) = a(x) b(y) - a(y) b(x), \
         without factorials"],
    ),
    (
        "homogeneous spaces",
        &["g = m + h: (B10) with [x,y]_m, (B14) with [x,y]_m and the further term -[[x,y]_h, z]"],
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
            "structure -c; Lambda_right = Lambda - c if Lambda is invariant under ad, else an error; \
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
    ("Lie-Poisson", &["{mu_i, mu_j} = -c^k_ij mu_k for left-invariant systems, + for right ones"]),
];
