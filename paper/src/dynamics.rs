//! Section 5: momenta and Euler's equations, (91)-(109).

use crate::lab::{Lab, cross, symbols};
use crate::{Finding, Row, Section, Status};
use affinor::geometry::conditions::conditions;
use affinor::geometry::equations::Equations;
use affinor::{BasisChange, CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 5: dynamics",
        about: "`Omega`, `H`, `M` and the inertia `J` are symbols here, so that the statements hold for all bodies, velocities and torques.",
        rows: vec![
            covectors(lab)?,
            inertia(lab)?,
            bases(lab)?,
            bi_invariant(lab)?,
            compatible(lab)?,
            momentum(lab)?,
            balance(lab)?,
            dual_frame(lab)?,
            on_any_algebra(lab)?,
            array(lab)?,
            euler(lab)?,
            half(lab)?,
            power(lab)?,
            index(lab)?,
            incompatible(lab)?,
        ],
    })
}

fn covectors(lab: &Lab) -> Result<Row, Error> {
    let metric = lab.inertia()?;
    let (v, u) = (symbols("v", 3), symbols("u", 3));
    let lowered = Tensor::vector(&metric.lower(&v)?, Down);
    let operands = [
        ("l", &lowered),
        ("u", &Tensor::vector(&u, Up)),
        ("v", &Tensor::vector(&v, Up)),
        ("g", metric.components()),
    ];
    let off = contract("l_i u^i - g_ij v^i u^j ->", &operands)?;
    Ok(Row::new(
        "(91)-(98)",
        "Covectors",
        "v^*(u) = v_i u^i = g_ij v^i u^j, v_i = g_ij v^j, e^i(e_j) = delta^i_j",
        "Covectors, and the metric that lowers indices.",
    )
    .by(&["Metric::lower", "Form::interior", "Frame::coframe"])
    .find(Finding::exact("`v_i u^i = g_ij v^i u^j`", &off)))
}

fn inertia(lab: &Lab) -> Result<Row, Error> {
    Ok(Row::new("(99)", "Metric of M(3)", "g_ij = J_ij", "The metric of M(3) is the inertia.")
        .by(&["Metric", "paper::m3"])
        .components("g", lab.inertia()?.components()))
}

fn constant(value: i64) -> Symbolic {
    Symbolic::constant(Rational::from(value))
}

fn bases(lab: &Lab) -> Result<Row, Error> {
    let matrix = |rows: [[i64; 3]; 3], below: i64| -> Result<_, Error> {
        let entry = |[i, j]: [usize; 2]| {
            Symbolic::constant(Rational::from(rows[i][j]) / &Rational::from(below))
        };
        BasisChange::new(Tensor::from_fn(3, [Up, Down], entry)?)
    };
    let turned = matrix([[3, -4, 0], [4, 3, 0], [0, 0, 5]], 5)?;
    let scaled = matrix([[2, 0, 0], [0, 1, 0], [0, 0, 1]], 1)?;
    let moved = |change: &BasisChange<Symbolic>| -> Result<_, Error> {
        let after = lab.rotations.change_basis(change)?;
        Ok(contract(
            "a^i_jk - b^i_jk -> ^i_jk",
            &[("a", after.structure_constants()), ("b", lab.rotations.structure_constants())],
        )?)
    };
    let invariance = lab.m3.frame().derivative(lab.inertia()?.components())?;
    Ok(Row::new("(100), (101)", "Invariance of the metric", "<e_i(p), e_j(p)> = J_ij", "The metric is left-invariant.")
        .status(Status::TooStrong(
            "The text chooses the basis by (100). The basis is fixed by (46) and (88) already, and only the metric is chosen: `c` and `J` change together, \
             and only rotations keep `c = eps`.",
        ))
        .by(&["LieAlgebra::change_basis", "Frame::derivative"])
        .find(Finding::exact("`e_k(J_ij) = 0`", &invariance))
        .find(Finding::exact("`c = eps` in a rotated basis", &moved(&turned)?))
        .find(Finding::exact("`c = eps` in the basis `2 e_1, e_2, e_3`", &moved(&scaled)?).refuted()))
}

fn bi_invariant(lab: &Lab) -> Result<Row, Error> {
    let metric = lab.so3.metric().ok_or(Error::NoMetric)?;
    let algebra = lab.so3.algebra().ok_or(Error::NoMetric)?;
    Ok(Row::new(
        "(102)",
        "Bi-invariant metric",
        "ghat_ij = 2 delta_ij",
        "The bi-invariant metric `tr(A^T B)` of the matrices.",
    )
    .by(&["MatrixBasis::frobenius", "Metric::ad_invariance_defect"])
    .components("ghat", metric.components())
    .find(Finding::exact(
        "`g([z,x], y) + g(x, [z,y]) = 0`",
        &metric.ad_invariance_defect(algebra)?,
    )))
}

fn compatible(lab: &Lab) -> Result<Row, Error> {
    let metric = lab.so3.metric().ok_or(Error::NoMetric)?;
    let algebra = lab.so3.algebra().ok_or(Error::NoMetric)?;
    let mut row = Row::new(
        "after (102)",
        "Compatibility of zero and its metric",
        "nabla_k ghat_ij = 0",
        "The metric (102) is compatible with `zero`.",
    )
    .by(&["Connection::nonmetricity"]);
    for which in [CanonicalConnection::Zero, CanonicalConnection::Plus, CanonicalConnection::Minus]
    {
        let q = Connection::canonical(algebra, which).nonmetricity(metric)?;
        let also = if which == CanonicalConnection::Zero { "" } else { "also " };
        row = row.find(Finding::exact(&format!("{also}with {}", which.name()), &q));
    }
    Ok(row)
}

fn momentum(lab: &Lab) -> Result<Row, Error> {
    let h = lab.inertia()?.lower(&symbols("Omega", 3))?;
    let values = h.iter().zip(1..).map(|(h, i)| Finding::value(&format!("H_{i} = {h}")));
    let row = Row::new(
        "(103)",
        "Angular momentum as a covector",
        "H_i = J_ij Omega^j",
        "The angular momentum is the covector of the velocity.",
    )
    .by(&["Metric::lower"]);
    Ok(values.fold(row, Row::find))
}

/// The term `DH/Dt - dH/dt = (nabla_Omega H)_i`, for constant components of `H`.
fn gyroscopic(
    connection: &Connection<Symbolic>,
    omega: &[Symbolic],
    h: &[Symbolic],
) -> Result<Vec<Symbolic>, Error> {
    let nabla = connection.nabla(&Tensor::vector(h, Down))?;
    let along = contract("D_ki O^k -> _i", &[("D", &nabla), ("O", &Tensor::vector(omega, Up))])?;
    Ok((0..omega.len()).map(|i| along.get(&[i])).collect())
}

fn balance(lab: &Lab) -> Result<Row, Error> {
    let plus = lab.canonical(CanonicalConnection::Plus);
    let omega = symbols("Omega", 3);
    let metric = lab.inertia()?;
    let h = metric.lower(&omega)?;
    let covector = gyroscopic(&plus, &omega, &h)?;
    let nabla = plus.nabla(&Tensor::vector(&omega, Up))?;
    let vector = contract("D^i_k O^k -> ^i", &[("D", &nabla), ("O", &Tensor::vector(&omega, Up))])?;
    let zero = vec![constant(0); 3];
    Ok(Row::new("(104)", "Law of motion", "DH/Dt = M", "The law of motion.")
        .status(Status::Convention(
            "It must be written for the covector `H`. `plus` does not preserve the metric `J`, so lowering an index does not commute with `D/Dt`.",
        ))
        .by(&["Equations::euler_poincare"])
        .find(Finding::equal("`DH/Dt - Hdot = Omega x H` for the covector", &covector, &cross(&omega, &h)))
        .find(Finding::exact("`D Omega/Dt - Omegadot = 0` for the vector: no gyroscopic term", &vector))
        .find(Finding::equal("`J D Omega/Dt = D(J Omega)/Dt`", &zero, &covector).refuted()))
}

fn dual_frame(lab: &Lab) -> Result<Row, Error> {
    Row::new("(105)", "Derivative of the dual frame", "nabla_{e_k} e^j = -Lambda^j_ki e^i", "The derivative of the dual frame.")
        .status(Status::Convention(
            "`Theta^k` are quasi-coordinates: `dTheta^k = Omega^k dt` cannot be integrated. Only the covariant derivative is meant.",
        ))
        .by(&["Connection::nabla"])
        .on_algebras(lab, "with plus ", |algebra| {
            let plus = Connection::canonical(algebra, CanonicalConnection::Plus);
            let n = algebra.dimension();
            let mut off = Tensor::zero(n, &[Up, Down, Down])?;
            for j in 0..n {
                let unit: Vec<_> = (0..n).map(|i| Rational::from(i64::from(i == j))).collect();
                let [e, f] = [Up, Down].map(|slot| Tensor::vector(&unit, slot));
                let operands = [("S", &off), ("N", &plus.nabla(&f)?), ("L", plus.affinities()), ("e", &e), ("f", &f)];
                off = contract("S^j_ki + e^j N_ki + e^j f_m L^m_ki -> ^j_ki", &operands)?;
            }
            Ok(off)
        })
}

fn on_any_algebra(lab: &Lab) -> Result<Row, Error> {
    let findings = lab.named().map(|(name, algebra)| {
        let n = algebra.dimension();
        let (omega, h) = (symbols("Omega", n), symbols("H", n));
        let symbolic = affinor::algebra::catalogue::algebra::<Symbolic>(name)?;
        let found =
            gyroscopic(&Connection::canonical(&symbolic, CanonicalConnection::Plus), &omega, &h)?;
        let operands = [
            ("c", symbolic.structure_constants()),
            ("O", &Tensor::vector(&omega, Up)),
            ("H", &Tensor::vector(&h, Down)),
        ];
        let expected = contract("-1 c^j_ki O^k H_j -> _i", &operands)?;
        let expected: Vec<_> = (0..n).map(|i| expected.get(&[i])).collect();
        Ok((name, Finding::equal("", &found, &expected)))
    });
    let findings = findings.collect::<Result<Vec<_>, Error>>()?;
    Ok(Row::new(
        "(106)", "Law of motion in components",
        "DH/Dt = (Hdot_i - Lambda^j_ki Omega^k H_j) e^i",
        "Written out. On every algebra `DH/Dt = M` is the Euler-Poincare equation `Hdot_i = c^j_ki Omega^k H_j + M_i` of a left-invariant system.",
    )
    .by(&["Connection::nabla", "Equations::euler_poincare"])
    .find(Finding::everywhere("for all `Omega` and `H` ", findings)))
}

fn array(lab: &Lab) -> Result<Row, Error> {
    let operands =
        [("L", lab.m3.connection().affinities()), ("O", &Tensor::vector(&symbols("Omega", 3), Up))];
    let below = contract("-1 L^j_ki O^k -> _i^j", &operands)?;
    let above = contract("-1 L^j_ki O^k -> ^j_i", &operands)?;
    // spin(Omega)^i_k = Lambda^i_jk Omega^j, (44)
    let spin = contract("L^i_jk O^j -> ^i_k", &operands)?;
    let with = |slots| Tensor::from_fn(3, slots, |at| spin.get(&at));
    let below = contract("a_i^j - b_i^j -> _i^j", &[("a", &below), ("b", &with([Down, Up])?)])?;
    let above = contract("a^j_i - b^j_i -> ^j_i", &[("a", &above), ("b", &with([Up, Down])?)])?;
    Ok(Row::new("(107)", "Gyroscopic array", "-Lambda^j_ki Omega^k = Omega~_i^j", "The array of the gyroscopic term.")
        .status(Status::Misprint(
            "Its lower index is the row, unlike in (44). With the index order of (44) the array is `-spin(Omega)`.",
        ))
        .by(&["Connection::affinities"])
        .find(Finding::exact("`spin(Omega)`, with the lower index as the row", &below))
        .find(Finding::exact("`spin(Omega)`, with the upper index as the row", &above).refuted()))
}

fn principal(metric: &Tensor<Symbolic>) -> Result<Metric<Symbolic>, Error> {
    Metric::diagonal((0..3).map(|i| metric.get(&[i, i])))
}

fn euler(lab: &Lab) -> Result<Row, Error> {
    let metric = principal(lab.inertia()?.components())?;
    let (omega, torque) = (symbols("Omega", 3), symbols("M", 3));
    let rates = Equations::euler_poincare(&lab.canonical(CanonicalConnection::Plus), &metric)?
        .rate(&omega, &torque)?;
    let lines = metric.lower(&rates)?.into_iter().zip(1..);
    let lines = lines.map(|(value, i)| Finding::value(&format!("J{i}{i} dOmega{i}/dt = {value}")));
    let row = Row::new(
        "(108)",
        "Euler's equations on M(3)",
        "J_ij dOmega^j/dt + Omega~_i^j J_jk Omega^k = M_i",
        "Euler's equations. In principal axes:",
    )
    .status(Status::Misprint("Read `Omega~_i^j` with the lower index as the row, as in (107)."))
    .by(&["Equations::euler_poincare"]);
    Ok(lines.fold(row, Row::find))
}

fn half(lab: &Lab) -> Result<Row, Error> {
    let metric = principal(lab.inertia()?.components())?;
    let omega = symbols("Omega", 3);
    let h = metric.lower(&omega)?;
    let zero = gyroscopic(&lab.canonical(CanonicalConnection::Zero), &omega, &h)?;
    let half = Symbolic::constant(Rational::from(1) / &Rational::from(2));
    let halved: Vec<_> = cross(&omega, &h).into_iter().map(|value| value * &half).collect();
    // the work of the gyroscopic term, and its contribution to the change of |H|^2
    let product = |a: &[Symbolic], b: &[Symbolic]| {
        a.iter().zip(b).fold(constant(0), |sum, (a, b)| sum + &(a.clone() * b))
    };
    let blind = [product(&zero, &omega), product(&zero, &h)];
    Ok(Row::new("after (108)", "The gyroscopic term by zero", "J dOmega/dt + 1/2 Omega x J Omega = M", "With `zero` the gyroscopic term is half of what it should be; here in principal axes.")
        .by(&["Equations::euler_poincare"])
        .find(Finding::equal("with zero `DH/Dt - Hdot = 1/2 Omega x H`", &zero, &halved))
        .find(Finding::equal("with zero it is `Omega x H`", &zero, &cross(&omega, &h)).refuted())
        .find(Finding::equal("energy and `norm(H)` do not notice it: the term does no work and does not change `norm(H)`", &blind, &[constant(0), constant(0)])))
}

fn power(lab: &Lab) -> Result<Row, Error> {
    let findings = lab.named().map(|(name, algebra)| {
        let n = algebra.dimension();
        let gamma = algebra.structure_constants().map(|value| Symbolic::constant(value.clone()));
        let [omega, h] = [("Omega", Up), ("H", Down)]
            .map(|(name, slot)| Tensor::vector(&symbols(name, n), slot));
        let work = contract("L^j_mi O^i O^m H_j ->", &[("L", &gamma), ("O", &omega), ("H", &h)])?;
        Ok((name, Finding::exact("", &work)))
    });
    let findings = findings.collect::<Result<Vec<_>, Error>>()?;
    let row = Row::new("(109)", "Power", "dT/dt = Omega^i J_ij dOmega^j/dt = M_i Omega^i", "Torques alone do work: `Lambda^j_mi Omega^i Omega^m H_j = 0`, because the affinities are antisymmetric.")
        .by(&["Connection::affinities"])
        .find(Finding::everywhere("with plus ", findings));
    let body = Connection::levi_civita(
        lab.rotations.left_frame(),
        &Metric::diagonal([constant(1), constant(1), Symbolic::parameter("J")])?,
    )?;
    let operands = [
        ("L", body.affinities()),
        ("O", &Tensor::vector(&symbols("Omega", 3), Up)),
        ("H", &Tensor::vector(&symbols("H", 3), Down)),
    ];
    let work = contract("L^j_mi O^i O^m H_j ->", &operands)?;
    Ok(row.find(
        Finding::exact("with the Levi-Civita connection of `diag(1, 1, J)`, for every `H`", &work)
            .refuted(),
    ))
}

fn index(lab: &Lab) -> Result<Row, Error> {
    let omega = Tensor::vector(&symbols("Omega", 3), Up);
    let metric = lab.inertia()?;
    let operands =
        [("L", lab.m3.connection().affinities()), ("O", &omega), ("J", metric.components())];
    let work = contract("L^j_ki O^k J_jm O^m O^i ->", &operands)?;
    Ok(Row::new(
        "after (109)",
        "Work of the gyroscopic term",
        "Omega^i Omega~_i^j J_jk Omega^k = 0",
        "The gyroscopic term does no work.",
    )
    .status(Status::Misprint(
        "The paper prints `Omega~^j_k J_jk Omega^k`, with one index three times.",
    ))
    .by(&["Connection::affinities"])
    .find(Finding::exact("for all `J` and `Omega`", &work)))
}

fn incompatible(lab: &Lab) -> Result<Row, Error> {
    let q = lab.m3.connection().nonmetricity(lab.inertia()?)?;
    let mut vanish: Vec<String> =
        conditions(&q).iter().map(|condition| format!("`{condition}`")).collect();
    vanish.sort();
    let ball = Metric::diagonal(vec![Symbolic::parameter("J"); 3])?;
    let of_ball = lab.m3.connection().nonmetricity(&ball)?;
    let mut row = Row::new("after (109)", "Compatibility of plus and the inertia", "nabla_k J_ij != 0", "`plus` is not compatible with the inertia.")
        .status(Status::TooStrong("It is compatible exactly with the ad-invariant inertias; on so(3) these are the multiples of the identity."))
        .by(&["Connection::nonmetricity"])
        .find(Finding::exact("`nabla_k J_ij = 0`", &q).refuted())
        .find(Finding::exact("`nabla_k J_ij = 0` for `J_ij = J delta_ij`", &of_ball));
    row.findings.push(Finding::statement(&format!(
        "it is compatible if these vanish: {}",
        vanish.join(", ")
    )));
    Ok(row)
}
