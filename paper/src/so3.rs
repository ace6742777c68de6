//! Section 4.2: the group SO(3) with the connection `zero` and the bi-invariant metric, (62)-(71).

use crate::lab::{
    Lab, ad, apart, cross, distance, epsilon, motion, rate, rotation, spin, symbols, translation,
    vectors, velocity,
};
use crate::{Finding, Row, Section, Status};
use affinor::geometry::equations::Equations;
use affinor::group::{LieGroup, So3, Velocity};
use affinor::{CanonicalConnection, Connection, Error, Metric};
use affinor_tensors::{Rational, Symbolic, contract};
use nalgebra::{DMatrix, Matrix3, Vector3};
use std::f64::consts::TAU;

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 4.2: kinematics on SO(3)",
        about: "\"SO(3)\" is the rotation group with the connection `zero` and the bi-invariant metric `tr(A^T B)`. It has curvature and no torsion.",
        rows: vec![
            basis()?,
            structure(lab)?,
            affinities(lab)?,
            curvature(lab)?,
            frames()?,
            commuting(lab)?,
            transport(lab)?,
            velocity_by_zero(lab)?,
            holonomy()?,
            unsuitable(lab)?,
        ],
    })
}

fn basis() -> Result<Row, Error> {
    let off = So3.basis().into_iter().map(|unit| {
        let slope = rate(|t| So3.matrix(&So3.exp(&(unit * t))), 0.0);
        (Matrix3::from_column_slice(slope.as_slice()) - spin(&unit)).amax()
    });
    Ok(Row::new(
        "(62), (63)",
        "Basis of the algebra of matrices",
        "e~_i(I) = spin(E_i), ehat_i(R) = R e~_i(I)",
        "The basis of the algebra of matrices, and the left-invariant frame.",
    )
    .by(&["LieGroup::basis", "InvariantField"])
    .find(Finding::within(
        "the one-parameter groups of the basis begin with `spin(E_i)`",
        off.fold(0.0, f64::max),
        1e-9,
    )))
}

fn structure(lab: &Lab) -> Result<Row, Error> {
    let c = lab.so3.frame().structure_functions();
    let off = contract("c^i_jk - E^i_jk -> ^i_jk", &[("c", c), ("E", &epsilon()?)])?;
    Ok(Row::new(
        "(64)",
        "Structure constants of SO(3)",
        "c~^i_jk = eps^i_jk",
        "The structure constants, from commutators of the matrices.",
    )
    .by(&["MatrixBasis::bracket"])
    .components("c", c)
    .find(Finding::exact("`c^i_jk = eps^i_jk`", &off)))
}

fn affinities(lab: &Lab) -> Result<Row, Error> {
    let gamma = lab.so3.connection().affinities();
    let off = contract("L^i_jk - 1/2 E^i_jk -> ^i_jk", &[("L", gamma), ("E", &epsilon()?)])?;
    Ok(Row::new(
        "(65)",
        "Affinities of SO(3)",
        "Lambda^i_jk = 1/2 eps^i_jk",
        "The affinities of `zero` in the left-invariant frame.",
    )
    .by(&["paper::so3"])
    .components("Lambda", gamma)
    .find(Finding::exact("`Lambda^i_jk = 1/2 eps^i_jk`", &off)))
}

fn curvature(lab: &Lab) -> Result<Row, Error> {
    let connection = lab.so3.connection();
    let delta = affinor_tensors::Tensor::<Rational>::identity(3);
    let lower = delta.map(Clone::clone);
    let metric = lab.so3.metric().ok_or(Error::NoMetric)?;
    // the metric g = 2 delta multiplies lowered components by 2
    let operands = [("R", connection.curvature()), ("d", &lower), ("g", metric.components())];
    let off = contract("R^i_jkl - 1/8 d^i_k g_jl + 1/8 d^i_l g_jk -> ^i_jkl", &operands)?;
    let ricci = contract(
        "r_jl - 1/4 g_jl -> _jl",
        &[("r", &connection.ricci()), ("g", metric.components())],
    )?;
    let scalar = metric.trace(&connection.ricci())?;
    Ok(Row::new(
        "after (65)",
        "Curvature of SO(3)",
        "R^i_jkl = Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c~^m_kl Lambda^i_mj",
        "The curvature: twelve components, the other 69 vanish.",
    )
    .status(Status::Misprint("The text refers to (B4). It must be (B14)."))
    .by(&["Connection::curvature", "Connection::ricci", "Metric::trace"])
    .components("R", connection.curvature())
    .find(Finding::exact("`R^i_jkl = 1/4 (delta^i_k delta_jl - delta^i_l delta_jk)`", &off))
    .find(Finding::exact("`Ric_jl = 1/2 delta_jl`", &ricci))
    .find(Finding::statement(&format!("`S = {scalar}` with the metric (102)"))))
}

fn frames() -> Result<Row, Error> {
    let t = 0.8;
    let matrix = |t: f64| So3.matrix(&rotation(t));
    let (r, slope) = (matrix(t), rate(matrix, t));
    let [r, slope] = [r, slope].map(|m| Matrix3::from_column_slice(m.as_slice()));
    let Velocity { body, spatial } = Velocity::of_path(&So3, rotation, t, 0.02)?;
    let (left, right) = ((slope - r * spin(&body)).amax(), (slope - spin(&spatial) * r).amax());
    Ok(Row::new(
        "(66)-(69)",
        "Velocity in two frames",
        "Rdot = Omega^i ehat_i(R) = omega^i ebar_i(R), ebar_i(R) = e~_i(I) R",
        "The velocity in the left- and in the right-invariant frame.",
    )
    .by(&["Velocity"])
    .find(Finding::within("`Rdot = R Omega~`", left, 1e-9))
    .find(Finding::within("`Rdot = omega~ R`", right, 1e-9)))
}

fn commuting(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let n = vectors(group)[2].clone();
        let g = group.exp(&(&n * 0.7));
        Ok(apart(&group.adjoint(&g, &n), &n))
    })?;
    Ok(Row::new(
        "(70)",
        "Generator of a one-parameter group",
        "Q' = Q n~ = n~ Q",
        "A one-parameter group has the same generator on both sides.",
    )
    .by(&["LieGroup::exp"])
    .find(Finding::within("`Ad_{exp(s n)} n = n`", off, 1e-13)))
}

fn transport(lab: &Lab) -> Result<Row, Error> {
    let half = lab.on_groups(|group| {
        let x = vectors(group)[0].clone();
        let b = translation(group, CanonicalConnection::Zero)?.along_subgroup(&x)?;
        Ok(distance(&b, &(ad(group, &x) * -0.5).exp()))
    })?;
    let roots = lab.on_groups(|group| {
        let [x, u, _] = vectors(group);
        let carried = translation(group, CanonicalConnection::Zero)?.along_subgroup(&x)? * &u;
        // the left components of sqrt(p) u sqrt(p): Ad of the inverse root, applied to u
        let root = group.exp(&(&x * -0.5));
        Ok(apart(&carried, &group.adjoint(&root, &u)))
    })?;
    Ok(Row::new(
        "(71)", "Transport along a ray by zero",
        "A(t) = exp(t n~/2)",
        "Transport by `zero` along a ray turns by half as much. On every group it is left translation by the square root of `p`, then right translation by it.",
    )
    .by(&["ParallelTranslation::along_subgroup"])
    .find(Finding::within("`B = exp(-1/2 ad_x)`", half, 1e-12))
    .find(Finding::within("it is the translation by square roots on both sides", roots, 1e-12)))
}

fn velocity_by_zero(lab: &Lab) -> Result<Row, Error> {
    let miss = |which: CanonicalConnection| {
        lab.least_on_groups(|group| {
            let g = motion(group)(1.3);
            let Velocity { body, spatial } = velocity(group, 1.3)?;
            let there = translation(group, which)?.along_subgroup(&group.log(&g)?)?;
            let back = there.try_inverse().ok_or(Error::SingularBasis)?;
            Ok(apart(&(back * body), &spatial))
        })
    };
    Ok(Row::new(
        "after (71)",
        "Velocity carried by zero",
        "exp(t n~/2) Omega != omega",
        "The velocity, carried to the identity by `zero`, is not the spatial velocity.",
    )
    .by(&["ParallelTranslation::along_subgroup"])
    .find(
        Finding::within("carried by zero it is `omega`", miss(CanonicalConnection::Zero)?, 1e-8)
            .refuted(),
    )
    .find(Finding::within(
        "carried by plus it is `omega`",
        miss(CanonicalConnection::Plus)?,
        1e-8,
    )))
}

fn holonomy() -> Result<Row, Error> {
    let n = Vector3::new(0.0, 0.6, -0.8);
    let corners: Vec<_> = (0..=12).map(|i| So3.exp(&(n * (TAU * f64::from(i) / 12.0)))).collect();
    let around = |which| translation(&So3, which)?.along_samples(&corners);
    let half_turn = So3.matrix(&So3.exp(&(n * (TAU / 2.0))));
    let identity = DMatrix::identity(3, 3);
    Ok(Row::new(
        "after (71)",
        "Holonomy of a closed one-parameter group",
        "A_e = A(2 pi)",
        "Transport once around a closed one-parameter group.",
    )
    .by(&["ParallelTranslation::along_samples"])
    .find(Finding::within(
        "plus: the identity",
        distance(&around(CanonicalConnection::Plus)?, &identity),
        1e-13,
    ))
    .find(Finding::within(
        "zero: a half turn about `n`",
        distance(&around(CanonicalConnection::Zero)?, &half_turn),
        1e-13,
    ))
    .find(
        Finding::within(
            "zero: the identity",
            distance(&around(CanonicalConnection::Zero)?, &identity),
            1e-13,
        )
        .refuted(),
    ))
}

fn unsuitable(lab: &Lab) -> Result<Row, Error> {
    let metric = lab.inertia()?;
    let omega = symbols("Omega", 3);
    let free = vec![Symbolic::constant(Rational::from(0)); 3];
    // J Omegadot along the geodesics of J, from its Levi-Civita connection
    let body = Connection::levi_civita(lab.rotations.left_frame(), metric)?;
    let kind = affinor::geometry::equations::EquationKind::Autoparallel;
    let geodesic = metric.lower(&Equations::new(kind, &body, None)?.rate(&omega, &[])?)?;
    let by = |which, metric: &Metric<Symbolic>| -> Result<_, Error> {
        let equations = Equations::euler_poincare(&lab.canonical(which), metric)?;
        let found = metric.lower(&equations.rate(&omega, &free)?)?;
        let gyroscopic = cross(&omega, &metric.lower(&omega)?);
        Ok([found, gyroscopic.into_iter().map(|value| -value).collect()])
    };
    let [plus, of_plus] = by(CanonicalConnection::Plus, metric)?;
    let principal = Metric::diagonal((0..3).map(|i| metric.components().get(&[i, i])))?;
    let [zero, of_zero] = by(CanonicalConnection::Zero, &principal)?;
    Ok(Row::new(
        "after (71)", "The claim that SO(3) is unsuited",
        "",
        "The paper concludes that SO(3) cannot describe the motion of a rigid body.",
    )
    .status(Status::TooStrong(
        "A group has no connection and no metric of its own. With `plus`, or with the Levi-Civita connection of `J`, the same SO(3) gives (10) and \
         (108). Only the pair of `zero` and the bi-invariant metric does not. M(3) is SO(3) with another structure.",
    ))
    .by(&["Connection::levi_civita", "Equations"])
    .find(Finding::equal("the geodesics of `J` on SO(3) are `J dOmega/dt = -Omega x H`", &geodesic, &of_plus))
    .find(Finding::equal("so are the equations with plus", &plus, &of_plus))
    .find(Finding::equal("and those with zero, in principal axes", &zero, &of_zero).refuted()))
}
