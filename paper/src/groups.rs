//! Section 3: groups, brackets and canonical connections, (17)-(40).

use crate::lab::{Lab, apart, distance, hat, motion, rate, translation, vectors, velocity};
use crate::{Finding, GROUPS, Row, Section, Status};
use affinor::algebra::catalogue;
use affinor::group::LieGroup;
use affinor::group::fields::{InvariantField, Side, right_translate};
use affinor::{CanonicalConnection, Connection, Error, LieAlgebra};
use affinor_tensors::{Rational, contract};
use nalgebra::DVector;

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 3: groups and canonical connections",
        about: GROUPS,
        rows: vec![
            neutral(lab)?,
            translations(lab)?,
            invariant_fields(lab)?,
            one_parameter_groups(lab)?,
            bracket(lab)?,
            connections(lab)?,
            bracket_of_fields(lab)?,
            left_and_right(lab)?,
            right_invariant_fields(lab)?,
            affinities(lab)?,
            torsion(lab)?,
            flat(lab)?,
            halves()?,
            affinities_of_zero(lab)?,
            torsion_of_zero(lab)?,
            antisymmetric(lab)?,
            curvature_of_zero(lab)?,
        ],
    })
}

fn neutral(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let p = group.exp(&vectors(group)[0]);
        let both = [group.compose(&group.identity(), &p), group.compose(&p, &group.identity())];
        Ok(both.iter().map(|g| apart(g, &p)).fold(0.0, f64::max))
    })?;
    let printed = lab.least_on_groups(|group| {
        let p = group.exp(&vectors(group)[0]);
        Ok(apart(&group.compose(&group.identity(), &p), &group.identity()))
    })?;
    Ok(Row::new("in 3.1", "Neutral element", "e p = p e = p", "The axiom of the neutral element.")
        .status(Status::Misprint("The paper prints `e p = p e = e`."))
        .by(&["LieGroup::compose", "LieGroup::identity"])
        .find(Finding::within("`e p = p e = p`", off, 1e-12))
        .find(Finding::within("as printed, `e p = e`", printed, 1e-12).refuted()))
}

fn translations(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [g, h, p] = vectors(group).map(|x| group.exp(&x));
        let one_by_one = group.compose(&group.compose(&p, &h), &g);
        Ok(apart(&one_by_one, &group.compose(&p, &group.compose(&h, &g))))
    })?;
    Ok(Row::new(
        "(17), (18)",
        "Translations",
        "L_g(h) = g h, R_g(h) = h g",
        "Left and right translations. Right translations compose in the other order.",
    )
    .by(&["LieGroup::compose"])
    .find(Finding::within("`R_g R_h = R_{h g}`", off, 1e-11)))
}

fn invariant_fields(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [x, v, _] = vectors(group);
        let p = group.exp(&x);
        let field = InvariantField { side: Side::Left, vector: v.clone() };
        let flow = rate(|t| group.matrix(&field.flow(group, &p, t)), 0.0);
        Ok(distance(&flow, &(group.matrix(&p) * hat(group, &v))))
    })?;
    let same = lab.on_groups(|group| {
        let [x, v, _] = vectors(group);
        let field = InvariantField { side: Side::Left, vector: v.clone() };
        Ok(apart(&field.at(group, &group.exp(&x)), &v))
    })?;
    Ok(Row::new(
        "(19)-(24)", "Left-invariant fields",
        "X_g = L_{g*} X_e",
        "Left-invariant vectors and fields. In the left-invariant frame `e_i(p) = L_{p*} e_i(e)` they have constant components.",
    )
    .by(&["InvariantField"])
    .find(Finding::within("for matrices `L_{g*} A = g A`, from the flow of the field", off, 1e-9))
    .find(Finding::within("`v^i(p) = v^i(e)`", same, 1e-15)))
}

fn one_parameter_groups(lab: &Lab) -> Result<Row, Error> {
    let product = lab.on_groups(|group| {
        let x = vectors(group)[0].clone();
        let g = |t: f64| group.exp(&(&x * t));
        Ok(apart(&group.compose(&g(0.4), &g(0.9)), &g(1.3)))
    })?;
    let tangent = lab.on_groups(|group| {
        let x = vectors(group)[0].clone();
        let g = |t: f64| group.matrix(&group.exp(&(&x * t)));
        let (there, slope, unit) = (g(0.8), rate(g, 0.8), hat(group, &x));
        Ok(distance(&slope, &(&there * &unit)).max(distance(&slope, &(unit * there))))
    })?;
    Ok(Row::new(
        "(25)-(27)", "One-parameter groups",
        "g(t) = exp(t g'(0)), g'(t) = L_{g(t)*} g'(0) = R_{g(t)*} g'(0)",
        "One-parameter groups. Not every element has a logarithm: there are matrices in SL(2) without one.",
    )
    .by(&["LieGroup::exp", "LieGroup::log"])
    .find(Finding::within("`g(t) g(s) = g(t + s)`", product, 1e-12))
    .find(Finding::within("both translations give the same tangent", tangent, 1e-9)))
}

fn bracket(lab: &Lab) -> Result<Row, Error> {
    let commutator = lab.on_groups(|group| {
        let [x, y, _] = vectors(group);
        let (a, b) = (hat(group, &x), hat(group, &y));
        Ok(distance(&hat(group, &group.bracket(&x, &y)), &(&a * &b - &b * &a)))
    })?;
    let right = lab.on_groups(|group| {
        let [x, y, _] = vectors(group);
        let field =
            |vector: &DVector<f64>| InvariantField { side: Side::Right, vector: vector.clone() };
        let found = field(&x).bracket(group, &field(&y)).vector;
        Ok(apart(&found, &-group.bracket(&x, &y)))
    })?;
    Ok(Row::new("(28)", "Bracket of the algebra", "[X_e, Y_e] = [X^L, Y^L]_e", "The bracket of the algebra, by left-invariant extensions.")
        .status(Status::Convention(
            "With left-invariant extensions it is the commutator of matrices. Right-invariant extensions change the sign.",
        ))
        .by(&["LieGroup::bracket", "MatrixBasis::bracket"])
        .find(Finding::within("`[X, Y] = X Y - Y X` for matrices", commutator, 1e-9))
        .find(Finding::within("`[X^R, Y^R] = -[X, Y]^R`", right, 1e-12)))
}

fn connections(lab: &Lab) -> Result<Row, Error> {
    // the parallel fields are right-invariant for plus, and left-invariant for minus
    let parallel = |which: CanonicalConnection, side: Side| {
        lab.on_groups(|group| {
            let [x, v, _] = vectors(group);
            let field = InvariantField { side, vector: v.clone() };
            let carried = translation(group, which)?.along_subgroup(&x)? * &v;
            Ok(apart(&carried, &field.at(group, &group.exp(&x))))
        })
    };
    let (plus, minus) = (
        parallel(CanonicalConnection::Plus, Side::Right)?,
        parallel(CanonicalConnection::Minus, Side::Left)?,
    );
    let mean = lab.on_groups(|group| {
        let algebra = group.algebra()?;
        let gamma = |which| Connection::canonical(&algebra, which).affinities().to_owned();
        let operands = [
            ("P", gamma(CanonicalConnection::Plus)),
            ("M", gamma(CanonicalConnection::Minus)),
            ("Z", gamma(CanonicalConnection::Zero)),
        ];
        let operands = operands.each_ref().map(|(name, tensor)| (*name, tensor));
        let off = contract("1/2 P^i_jk + 1/2 M^i_jk - Z^i_jk -> ^i_jk", &operands)?;
        Ok(off.components().map(|(_, value)| value.abs()).fold(0.0, f64::max))
    })?;
    Ok(Row::new(
        "(29)-(31)", "The three canonical connections",
        "nabla^R_X Y = [X^L, Y], nabla^L_X Y = [X^R, Y], nabla^S_X Y = 1/2 [X^L + X^R, Y]",
        "The three canonical connections: here `plus`, `minus` and `zero`, the connections (+), (-) and (0) of Cartan and Schouten.",
    )
    .status(Status::Convention(
        "`X^L` and `X^R` are the invariant fields through `X(p)`, not through `X(e)`. The superscript R and the words \
         \"left invariant\" name the same connection. All three are invariant on both sides, so these words do not describe them.",
    ))
    .by(&["Connection::canonical"])
    .find(Finding::within("plus: right-invariant fields are parallel", plus, 1e-11))
    .find(Finding::within("minus: left-invariant fields are parallel", minus, 1e-11))
    .find(Finding::within("zero is the mean of both", mean, 1e-15)))
}

fn bracket_of_fields(lab: &Lab) -> Result<Row, Error> {
    Row::new(
        "(32)-(34)", "Bracket of fields in a frame",
        "[X, Y]^i = X^j e_j(Y^i) - Y^j e_j(X^i) + c^i_jk X^j Y^k",
        "The bracket of fields in a frame. Of left-invariant fields only the last term remains.",
    )
    .status(Status::Convention(
        "The paper writes `partial_j` for the derivative `e_j` along the frame. The sign of the last term belongs to the left-invariant \
         frame: in the right-invariant frame of the same basis it is `-c`.",
    ))
    .by(&["Frame::bracket"])
    .on_algebras(lab, "the structure constants of the right-invariant frame are `-c`, ", |algebra| {
        let right = algebra.right_frame();
        let (left, right) = (algebra.structure_constants(), right.structure_functions());
        Ok(contract("a^i_jk + b^i_jk -> ^i_jk", &[("a", left), ("b", right)])?)
    })
}

fn left_and_right(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [x, y, z] = vectors(group);
        let p = group.exp(&z);
        // applies both flows in both orders
        let left = InvariantField { side: Side::Left, vector: x * 0.3 };
        let right = InvariantField { side: Side::Right, vector: y * 0.4 };
        let one = right.flow(group, &left.flow(group, &p, 1.0), 1.0);
        let other = left.flow(group, &right.flow(group, &p, 1.0), 1.0);
        Ok(apart(&one, &other))
    })?;
    Ok(Row::new(
        "(35)",
        "Left- and right-invariant fields commute",
        "[X^L, Y^R] = 0",
        "Left- and right-invariant fields commute.",
    )
    .by(&["InvariantField::flow"])
    .find(Finding::within("their flows commute", off, 1e-11)))
}

fn right_invariant_fields(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [_, u, _] = vectors(group);
        let curve = motion(group);
        let plus = translation(group, CanonicalConnection::Plus)?;
        let body = |t: f64| {
            velocity(group, t).map_or_else(|_| DVector::zeros(group.dimension()), |v| v.body)
        };
        let carried = plus.along_curve(body, &[0.0, 0.8], 1e-12)?.swap_remove(1) * &u;
        // along any curve, transport is the right translation from its start to its end
        let between = group.compose(&group.inverse(&curve(0.0)), &curve(0.8));
        Ok(apart(&carried, &right_translate(group, &u, &between)))
    })?;
    Ok(Row::new(
        "(36), (37)", "Fields parallel for plus",
        "nabla^R_X Y^R = 0, nabla^R_X Y = (e_j(Y^i) + c^i_jk Y^k) X^j e_i",
        "Right-invariant fields are parallel for `plus`, so its parallel transport is right translation on every path.",
    )
    .by(&["Connection::nabla", "ParallelTranslation::along_curve"])
    .find(Finding::within("transport along a curved path is the right translation", off, 1e-8)))
}

fn affinities(lab: &Lab) -> Result<Row, Error> {
    let m3 = lab.m3.connection();
    let off = contract(
        "L^i_jk - c^i_jk -> ^i_jk",
        &[("L", m3.affinities()), ("c", m3.frame().structure_functions())],
    )?;
    let right = lab.m3.in_right_frame()?;
    Ok(Row::new(
        "(38)",
        "Affinities of plus",
        "Lambda^i_jk = c^i_jk",
        "The affinities of `plus` in the left-invariant frame.",
    )
    .status(Status::Convention(
        "In the right-invariant frame the same connection has `Lambda = 0`.",
    ))
    .by(&["Connection::affinities", "Geometry::in_right_frame"])
    .find(Finding::exact("`Lambda^i_jk = c^i_jk` of M(3)", &off))
    .find(Finding::exact(
        "`Lambda^i_jk = 0` in the right-invariant frame",
        right.connection().affinities(),
    )))
}

fn torsion(lab: &Lab) -> Result<Row, Error> {
    let m3 = lab.m3.connection();
    let off = contract(
        "t^i_jk - c^i_jk -> ^i_jk",
        &[("t", &m3.torsion()), ("c", m3.frame().structure_functions())],
    )?;
    Ok(Row::new(
        "after (38)",
        "Torsion of plus",
        "tau^i_jk = c^i_jk",
        "The torsion of `plus`, by (B10).",
    )
    .by(&["Connection::torsion"])
    .find(Finding::exact("`tau^i_jk = c^i_jk` of M(3)", &off))
    .components("tau", &m3.torsion()))
}

fn flat(lab: &Lab) -> Result<Row, Error> {
    Row::new(
        "after (38)",
        "Curvature of plus",
        "R^i_jkl = 0",
        "`plus` has no curvature: with (B14) this is the Jacobi identity.",
    )
    .by(&["Connection::curvature"])
    .find(Finding::exact("`R^i_jkl = 0` of M(3)", lab.m3.connection().curvature()))
    .on_algebras(lab, "and of plus ", |algebra| {
        Ok(Connection::canonical(algebra, CanonicalConnection::Plus).curvature().clone())
    })
}

/// Checks that the right translate of `e_j(e)` is not the right-invariant field through `e_j(p)`.
fn halves() -> Result<Row, Error> {
    use affinor::group::So3;
    use nalgebra::Vector3;
    let (p, unit) = (So3.exp(&Vector3::new(0.4, -1.2, 0.7)), Vector3::x());
    let printed = right_translate(&So3, &unit, &p);
    let through = right_translate(&So3, &So3.adjoint(&p, &unit), &p);
    Ok(Row::new(
        "before (39)", "Construction of zero",
        "nabla^S_{e_j} e_k = 1/2 [e_j^L, e_k^L] + 1/2 [e_j^R, e_k^L]",
        "The connection `zero` on the left-invariant frame.",
    )
    .status(Status::Misprint(
        "`e_j^R` must be the right-invariant field through `e_j(p)`. The paper takes the right translation of `e_j(e)`, and then \
         `1/2 (e_j^L + e_j^R)` is not `e_j` at `p`. The result (39) does not change, because the second bracket vanishes.",
    ))
    .by(&["Chart::invariant_fields", "right_translate"])
    .find(Finding::within("`e_j^R(p) = e_j(p)` for the field through `e_j(p)`", (through - unit).norm(), 1e-14))
    .find(Finding::within("as printed: `e_j^R(p) = e_j(p)`", (printed - unit).norm(), 1e-14).refuted()))
}

fn affinities_of_zero(lab: &Lab) -> Result<Row, Error> {
    let so3 = lab.so3.connection();
    let off = contract(
        "c^i_jk - 2 L^i_jk -> ^i_jk",
        &[("L", so3.affinities()), ("c", so3.frame().structure_functions())],
    )?;
    Ok(Row::new(
        "(39)",
        "Affinities of zero",
        "c^i_jk = 2 Lambda^i_jk",
        "The affinities of `zero` in the left-invariant frame.",
    )
    .by(&["Connection::canonical"])
    .find(Finding::exact("`c^i_jk = 2 Lambda^i_jk` of SO(3)", &off)))
}

fn torsion_of_zero(lab: &Lab) -> Result<Row, Error> {
    Row::new("after (39)", "Torsion of zero", "tau^i_jk = 0", "`zero` has no torsion.")
        .by(&["Connection::torsion"])
        .find(Finding::exact("`tau^i_jk = 0` of SO(3)", &lab.so3.connection().torsion()))
        .on_algebras(lab, "and of zero ", |algebra| {
            Ok(Connection::canonical(algebra, CanonicalConnection::Zero).torsion())
        })
}

fn antisymmetric(lab: &Lab) -> Result<Row, Error> {
    let sum = |gamma| contract("L^i_jk + L^i_kj -> ^i_jk", &[("L", gamma)]);
    let right = lab.so3.in_right_frame()?;
    Ok(Row::new(
        "(40)",
        "Antisymmetry of the affinities",
        "Lambda^i_jk = -Lambda^i_kj",
        "The affinities of `plus` and `zero` are antisymmetric.",
    )
    .by(&["Connection::affinities"])
    .find(Finding::exact(
        "`plus`",
        &contract("L^i_jk + L^i_kj -> ^i_jk", &[("L", lab.m3.connection().affinities())])?,
    ))
    .find(Finding::exact("`zero`", &sum(lab.so3.connection().affinities())?))
    .find(Finding::exact(
        "`zero` in the right-invariant frame",
        &sum(right.connection().affinities())?,
    )))
}

fn curvature_of_zero(lab: &Lab) -> Result<Row, Error> {
    let heisenberg: LieAlgebra<Rational> = catalogue::algebra("heisenberg(3)")?;
    let step_two = Connection::canonical(&heisenberg, CanonicalConnection::Zero);
    let row = Row::new(
        "after (40)", "Curvature of zero",
        "R^i_jkl = -1/4 c^m_kl c^i_mj",
        "The curvature of `zero`, which the paper does not print: `R(X,Y) Z = -1/4 [[X,Y],Z]`. It vanishes exactly on algebras that are nilpotent of step two, or abelian.",
    )
    .by(&["Connection::curvature"])
    .on_algebras(lab, "`R^i_jkl = -1/4 c^m_kl c^i_mj` ", |algebra| {
        let zero = Connection::canonical(algebra, CanonicalConnection::Zero);
        let operands = [("R", zero.curvature()), ("c", algebra.structure_constants())];
        Ok(contract("R^i_jkl + 1/4 c^m_kl c^i_mj -> ^i_jkl", &operands)?)
    })?;
    Ok(row
        .find(Finding::exact("`R^i_jkl = 0` on heisenberg(3)", step_two.curvature()))
        .find(Finding::exact("`R^i_jkl = 0` on so(3)", lab.so3.connection().curvature()).refuted()))
}
