//! Section 4.3: the representation `Phi` and canonical coordinates, (72)-(90).

use crate::lab::{Lab, apart, distance, epsilon, hat, rate, rotation, spin, vectors};
use crate::{Finding, Row, Section, Status};
use affinor::geometry::chart::{CanonicalCoordinates, Side};
use affinor::group::{LieGroup, So3, Velocity};
use affinor::{BasisChange, CanonicalConnection, Connection, Error, Frame, LieAlgebra};
use affinor_tensors::{Jet, Tensor, contract};
use nalgebra::{DVector, Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 4.3: canonical coordinates",
        about: "`Phi` takes canonical coordinates, on the rotations the rotation vector, to matrices: the exponential.",
        rows: vec![
            products(lab)?,
            one_to_one()?,
            product(lab)?,
            straight(lab)?,
            pole(lab)?,
            exponential(lab)?,
            derivative_at_identity(lab)?,
            brackets(lab)?,
            left_components(lab)?,
            derivative()?,
            same_structure(lab)?,
        ],
    })
}

fn products(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [p, q, _] = vectors(group).map(|x| group.exp(&(x * 0.6)));
        let x = group.log(&group.compose(&p, &q))?;
        Ok(distance(&group.matrix(&group.exp(&x)), &(group.matrix(&p) * group.matrix(&q))))
    })?;
    Ok(Row::new(
        "(72)",
        "Phi as a representation",
        "Phi(p q) = Phi(p) Phi(q)",
        "`Phi` is a representation.",
    )
    .by(&["LieGroup::matrix"])
    .find(Finding::within("`Phi(p q) = Phi(p) Phi(q)`", off, 1e-12)))
}

fn one_to_one() -> Result<Row, Error> {
    let n = Vector3::new(-1.0, 2.0, 2.0) / 3.0;
    let back = |length: f64| -> Result<f64, Error> {
        Ok((So3.log(&So3.exp(&(n * length)))? - n * length).norm())
    };
    let antipodes = So3.exp(&(n * PI)).angle_to(&So3.exp(&(n * -PI)));
    let across = So3.tangent_left(&(n * TAU), &Vector3::new(2.0, 1.0, 0.0)).norm();
    Ok(Row::new("at (72)", "Phi as one to one", "", "The paper calls `Phi` one to one and onto.")
        .status(Status::TooStrong(
            "This is true of the points of the group. In rotation vectors it is true for lengths below `pi`: at length `pi` antipodes are the \
             same rotation, and at `2 pi` the coordinates are singular.",
        ))
        .by(&["So3::log", "So3::log_near"])
        .find(Finding::within("`log(exp(Psi)) = Psi` at length 3", back(3.0)?, 1e-13))
        .find(Finding::within("`log(exp(Psi)) = Psi` at length 4", back(4.0)?, 1e-13).refuted())
        .find(Finding::within("antipodes at length `pi` are one rotation", antipodes, 1e-14))
        .find(Finding::within("at length `2 pi` the derivative across the axis vanishes", across, 1e-14)))
}

fn product(lab: &Lab) -> Result<Row, Error> {
    let quarter = TAU / 4.0;
    let turns = [Vector3::x(), Vector3::y()].map(|axis| So3.exp(&(axis * quarter)));
    let found = So3.log(&So3.compose(&turns[0], &turns[1]))?;
    let third = (found - Vector3::repeat(1.0).normalize() * (TAU / 3.0)).norm();
    let series = lab.on_groups(|group| {
        let [x, y, _] = vectors(group).map(|x| x * 0.04);
        let parts = group.algebra()?.bch(x.as_slice(), y.as_slice(), 12)?;
        let sum = DVector::from_fn(x.len(), |i, _| parts.iter().map(|part| part[i]).sum());
        Ok(apart(&group.log(&group.compose(&group.exp(&x), &group.exp(&y)))?, &sum))
    })?;
    Ok(Row::new("(73)", "Product in canonical coordinates", "p q = Phi^{-1}(Phi(p) Phi(q))", "The product in canonical coordinates.")
        .status(Status::Convention(
            "It needs a branch of the logarithm. The principal branch has lengths up to `pi`; at length `pi` the first component that is not zero is positive.",
        ))
        .by(&["LieGroup::compose", "LieAlgebra::bch"])
        .find(Finding::within("two quarter turns about `x` and `y` make a third of a turn about `(1,1,1)`", third, 1e-14))
        .find(Finding::within("near the identity it is the series of Baker, Campbell and Hausdorff", series, 1e-13)))
}

fn straight(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let n = vectors(group)[2].clone();
        Ok(apart(&group.log(&group.exp(&(&n * 0.9)))?, &(&n * 0.9)))
    })?;
    Ok(Row::new(
        "(74)",
        "Rays as straight lines",
        "q^i = s n^i",
        "Rays are straight lines in canonical coordinates.",
    )
    .by(&["LieGroup::log"])
    .find(Finding::within("`log(exp(s n)) = s n`", off, 1e-13)))
}

/// The affinities of a canonical connection in canonical coordinates, at a point.
fn in_coordinates(
    algebra: &LieAlgebra<f64>,
    which: CanonicalConnection,
    point: &[f64],
) -> Result<Tensor<Jet>, Error> {
    let (kind, side) = (CanonicalCoordinates::First, Side::Left);
    let frame = Frame::canonical_at_point(algebra, kind, side, point)?;
    let gamma = frame.structure_functions().scale(&Jet::constant(which.lambda()));
    // changes from the left-invariant frame to the coordinate frame
    let forms = BasisChange::new(algebra.canonical_forms(kind, side, point)?)?;
    let labels = frame.labels().to_vec();
    Ok(Connection::new(frame, gamma)?.moved(labels, &forms)?.affinities().clone())
}

fn pole(lab: &Lab) -> Result<Row, Error> {
    let algebra = lab.groups[0].algebra()?;
    let psi = [0.7, -0.4, 1.1];
    let off = |which, point: &[f64]| -> Result<f64, Error> {
        let gamma = in_coordinates(&algebra, which, point)?;
        let sum = contract("G^i_jk + G^i_kj -> ^i_jk", &[("G", &gamma)])?;
        Ok(sum.components().map(|(_, value)| value.value().abs()).fold(0.0, f64::max))
    };
    let mut row = Row::new(
        "(75)", "Pole condition",
        "Gamma^i_(jk)(e) = 0",
        "The pole condition: in canonical coordinates the symmetric part of the affinities vanishes at the identity. Elsewhere only its contraction `Gamma^i_jk q^j q^k` along the ray vanishes.",
    )
    .status(Status::Convention(
        "These are affinities of the coordinates, not those of the left-invariant frame in (46). Their antisymmetric part is half the torsion.",
    ))
    .by(&["Frame::canonical_at_point", "Connection::moved"]);
    for which in [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
    {
        let claim = format!("at the identity, for {}", which.name());
        row = row.find(Finding::within(&claim, off(which, &[0.0; 3])?, 1e-13));
    }
    let on_ray = in_coordinates(&algebra, CanonicalConnection::Zero, &psi)?;
    let along = on_ray.components().fold([0.0; 3], |mut sum, (at, value)| {
        sum[at[0]] += value.value() * psi[at[1]] * psi[at[2]];
        sum
    });
    let along = along.iter().fold(0.0, |worst: f64, x| worst.max(x.abs()));
    Ok(row
        .find(
            Finding::within(
                "away from the identity, for zero",
                off(CanonicalConnection::Zero, &psi)?,
                1e-13,
            )
            .refuted(),
        )
        .find(Finding::within("`Gamma^i_jk q^j q^k = 0` on the ray", along, 1e-12)))
}

fn exponential(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let q = vectors(group)[0].clone();
        Ok(distance(&group.matrix(&group.exp(&q)), &hat(group, &q).exp()))
    })?;
    Ok(Row::new(
        "(76)-(79)",
        "Phi as the exponential",
        "Phi(q) = exp(q~), Phi(e) = I",
        "`Phi` is the exponential of matrices; `e_i(q) = q e_i(e)` stands for left translation.",
    )
    .by(&["LieGroup::exp", "LieGroup::matrix"])
    .find(Finding::within("`Phi(q) = exp(q~)`", off, 1e-9)))
}

fn derivative_at_identity(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [x, bend, _] = vectors(group);
        let y = rate(|t| group.matrix(&group.exp(&(&x * t + &bend * (t * t)))), 0.0);
        Ok(distance(&y, &hat(group, &x)))
    })?;
    let x = Vector3::new(1.0, -2.0, 3.0);
    let y = rate(|t| So3.matrix(&So3.exp(&(x * t))), 0.0);
    let spin = (Matrix3::from_column_slice(y.as_slice()) - spin(&x)).amax();
    Ok(Row::new(
        "(80)-(83)",
        "Derivative of Phi at the identity",
        "Y(I) = Phi(e)_* X(e) = spin(X(e))",
        "The derivative of `Phi` at the identity.",
    )
    .by(&["Velocity::in_coordinates"])
    .find(Finding::within("any curve with the tangent `X` gives `X~`", off, 1e-8))
    .find(Finding::within("on the rotations `X~ = spin(X)`", spin, 1e-8)))
}

fn brackets(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [x, y, _] = vectors(group);
        let (a, b) = (hat(group, &x), hat(group, &y));
        Ok(distance(&(&a * &b - &b * &a), &hat(group, &group.bracket(&x, &y))))
    })?;
    let (x, y) = (Vector3::new(1.0, -2.0, 3.0), Vector3::new(-4.0, 5.0, 6.0));
    let cross = (So3.bracket(&x, &y) - x.cross(&y)).amax();
    Ok(Row::new(
        "(84), (85)",
        "Brackets and commutators",
        "[X_1, X_2] = vect([Y_1, Y_2]) = X_1 x X_2",
        "`Phi_*` takes brackets to commutators.",
    )
    .status(Status::Convention(
        "Brackets of vectors at `e` are those of their left-invariant extensions, (28).",
    ))
    .by(&["LieGroup::bracket"])
    .find(Finding::within("`[Phi_* X, Phi_* Y] = Phi_* [X, Y]`", off, 1e-9))
    .find(Finding::within("on the rotations `[X, Y] = X x Y`", cross, 1e-15)))
}

fn left_components(lab: &Lab) -> Result<Row, Error> {
    let left = lab.on_groups(|group| {
        let [x, v, _] = vectors(group);
        let slope = rate(|t| group.matrix(&group.exp(&(&x + &v * t))), 0.0);
        let inverse = group.matrix(&group.inverse(&group.exp(&x)));
        Ok(distance(&(inverse * slope), &hat(group, &group.tangent_left(&x, &v))))
    })?;
    let wrong = lab.least_on_groups(|group| {
        let [x, v, _] = vectors(group);
        Ok(apart(&group.tangent_left(&x, &v), &v))
    })?;
    let psi = Vector3::new(0.7, -0.4, 1.1);
    let (theta, s) = (psi.norm(), spin(&psi));
    let closed = Matrix3::identity() - s * ((1.0 - theta.cos()) / theta.powi(2))
        + s * s * ((theta - theta.sin()) / theta.powi(3));
    let operator = Matrix3::from_columns(
        &So3.basis().iter().map(|e| So3.tangent_left(&psi, e)).collect::<Vec<_>>(),
    );
    let determinant = operator.determinant() - 2.0 * (1.0 - theta.cos()) / theta.powi(2);
    Ok(Row::new("(86)", "Vectors in both pictures", "Y(Q) = Q X~(e)", "A vector at `q` has the same left components in both pictures.")
        .status(Status::Convention(
            "`X(e)` are components in the left-invariant frame, not rates of the coordinates. For those, `Q^T dQ = spin(T dq)` with an operator \
             `T` that the paper does not write down: `T = I - (1 - cos theta)/theta^2 q~ + (theta - sin theta)/theta^3 q~^2` on the rotations.",
        ))
        .by(&["LieGroup::tangent_left", "LieGroup::tangent_right"])
        .find(Finding::within("`g^{-1} dg = T dq` on every group", left, 1e-8))
        .find(Finding::within("with `dq` for the left components", wrong, 1e-8).refuted())
        .find(Finding::within("the closed form on the rotations", (operator - closed).amax(), 1e-13))
        .find(Finding::within("`det T = 2 (1 - cos theta)/theta^2`", determinant.abs(), 1e-13)))
}

fn derivative() -> Result<Row, Error> {
    let (t, h) = (0.8, 0.02);
    let body = Velocity::of_path(&So3, rotation, t, h)?.body;
    let q = |t: f64| So3.log(&rotation(t)).unwrap_or_default();
    let dq = (q(t + 1e-5) - q(t - 1e-5)) / 2e-5;
    let right = (So3.tangent_left(&q(t), &dq) - body).norm();
    Ok(Row::new("after (86)", "Derivative of Phi anywhere", "Phi(q)_* = L_{Q*} Phi(e)_* L_{q^{-1}*}", "The derivative of `Phi` anywhere.")
        .status(Status::Misprint(
            "The paper prints `Phi(q)_* = Phi(q) Phi(e)_*`, whose domains do not fit: `Phi(e)_*` takes vectors at `e`.",
        ))
        .by(&["LieGroup::tangent_left"])
        .find(Finding::within("`spin` of `T dq` is `Q^T dQ` along a motion", right, 1e-8))
        .find(Finding::within("as printed, with `dq` at `q`", (dq - body).norm(), 1e-8).refuted()))
}

fn same_structure(lab: &Lab) -> Result<Row, Error> {
    let off = contract(
        "c^i_jk - E^i_jk -> ^i_jk",
        &[("c", lab.so3.frame().structure_functions()), ("E", &epsilon()?)],
    )?;
    Ok(Row::new(
        "(87)-(90)", "Structure constants in both pictures",
        "[e_i, e_j] = c^k_ij e_k, [e~_i, e~_j] = c~^k_ij e~_k, c = c~",
        "Both algebras have the same structure constants: those of the matrices, and the cross product.",
    )
    .by(&["LieGroup::algebra", "MatrixBasis::bracket"])
    .find(Finding::exact("`c~^i_jk = eps^i_jk` from the matrices", &off)))
}
