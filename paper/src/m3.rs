//! Section 4.1: kinematics on M(3), (41)-(61). Many of these equations hold for `plus` on every
//! group, with `A = Ad_p`.

use crate::lab::{
    Lab, ad, apart, distance, epsilon, hat, motion, rate, rotation, spin, symbols, translation,
    vectors, velocity,
};
use crate::{Finding, Row, Section, Status};
use affinor::group::fields::{InvariantField, Side};
use affinor::group::{AnyGroup, LieGroup, So3, Velocity};
use affinor::{CanonicalConnection, Error};
use affinor_tensors::{Tensor, Up, contract};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 4.1: kinematics on M(3)",
        about: "M(3) is the rotation group with the connection `plus` and, as its metric, the inertia `J`. It has torsion and no curvature.",
        rows: vec![
            tangent(lab)?,
            parallel(lab)?,
            autoparallels(lab)?,
            generator(lab)?,
            twenty_seven(lab)?,
            frame(lab)?,
            rays(lab)?,
            images(lab)?,
            carried(lab)?,
            equal_images()?,
            one_parameter()?,
            rodrigues()?,
            rotation_vector()?,
        ],
    })
}

fn tangent(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let (g, slope) =
            (group.matrix(&motion(group)(0.9)), rate(|t| group.matrix(&motion(group)(t)), 0.9));
        let Velocity { body, spatial } = velocity(group, 0.9)?;
        let left = distance(&(&g * hat(group, &body)), &slope);
        Ok(left.max(distance(&(hat(group, &spatial) * &g), &slope)))
    })?;
    Ok(Row::new(
        "(41), (52)-(56), (59)", "Tangent of a motion",
        "w = w^i e_i(p), w = L_{p*} Omega = R_{p*} omega, w^i = Omega^i",
        "The tangent of a motion has the components of the body velocity in the left-invariant frame. Its right image at the identity is `omega`.",
    )
    .by(&["Velocity::of_path"])
    .find(Finding::within("`g' = g Omega~ = omega~ g` for matrices", off, 1e-8)))
}

fn parallel(lab: &Lab) -> Result<Row, Error> {
    let mut row = Row::new(
        "(42)", "Parallel vectors along a motion",
        "vdot^i + Lambda^i_jk w^j v^k = 0",
        "Parallel vectors along a motion. Before (42): `nabla_w v = (vdot^i + Lambda^i_jk w^j v^k) e_i`.",
    )
    .by(&["ParallelTranslation::along_curve"]);
    for (which, share) in [
        (CanonicalConnection::Plus, 1.0),
        (CanonicalConnection::Zero, 0.5),
        (CanonicalConnection::Minus, 0.0),
    ] {
        let off = lab.on_groups(|group| {
            let n = group.dimension();
            let w = |t: f64| velocity(group, t).map_or_else(|_| DVector::zeros(n), |v| v.body);
            let (u, along) = (vectors(group)[1].clone(), translation(group, which)?);
            let at = |t: f64| {
                let there = match along.along_curve(w, &[0.0, t], 1e-12).as_deref() {
                    Ok([_, there]) => there * &u,
                    _ => DVector::zeros(n),
                };
                DMatrix::from_column_slice(n, 1, there.as_slice())
            };
            let v = DVector::from_column_slice(at(0.8).as_slice());
            let turned = group.bracket(&w(0.8), &v) * share;
            Ok((rate(at, 0.8).column(0) + turned).amax())
        })?;
        let claim = format!(
            "`vdot + {} = 0` for {}",
            ["0", "1/2 [w, v]", "[w, v]"][(2.0 * share) as usize],
            which.name()
        );
        row = row.find(Finding::within(&claim, off, 1e-7));
    }
    Ok(row)
}

fn autoparallels(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [x, n, _] = vectors(group);
        let start = group.exp(&x);
        let expected = group.compose(&start, &group.exp(&(&n * 1.5)));
        let mut worst: f64 = 0.0;
        for which in
            [CanonicalConnection::Plus, CanonicalConnection::Zero, CanonicalConnection::Minus]
        {
            for at in translation(group, which)?.autoparallel(&start, &n, &[1.5], 1e-12)? {
                worst = worst.max(apart(&at.left, &n));
                worst = worst.max(distance(&group.matrix(&at.base), &group.matrix(&expected)));
            }
        }
        Ok(worst)
    })?;
    Ok(Row::new(
        "(43)", "Autoparallels of M(3)",
        "n^i(t) = n^i(0)",
        "Autoparallels have constant components. They are the left translates `g exp(t n)` of one-parameter groups, the same curves for all three connections.",
    )
    .by(&["ParallelTranslation::autoparallel"])
    .find(Finding::within("for plus, zero and minus", off, 1e-9)))
}

fn generator(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let n = vectors(group)[0].clone();
        let generator = translation(group, CanonicalConnection::Plus)?
            .connection()
            .transport_generator(n.as_slice())?;
        let generator = generator.to_dmatrix()?;
        Ok(distance(&-generator, &ad(group, &n)))
    })?;
    let plus = lab.m3.connection();
    let array = contract(
        "L^i_jk n^j -> ^i_k",
        &[("L", plus.affinities()), ("n", &Tensor::vector(&symbols("n", 3), Up))],
    )?;
    Ok(Row::new(
        "(44), (45)", "Parallel transport along an autoparallel",
        "udot = -n~ u, n~^i_k = Lambda^i_jk n^j",
        "Parallel transport along an autoparallel. The upper index is the row, so on the rotations the array is `spin(n)`; on every group it is `ad_n`.",
    )
    .by(&["Connection::transport_generator"])
    .components("n~", &array)
    .find(Finding::within("`udot = -ad_n u`", off, 1e-13)))
}

fn twenty_seven(lab: &Lab) -> Result<Row, Error> {
    let gamma = lab.m3.connection().affinities();
    let epsilon = epsilon()?.map(|value| affinor_tensors::Symbolic::constant(value.clone()));
    let off = contract("L^i_jk - E^i_jk -> ^i_jk", &[("L", gamma), ("E", &epsilon)])?;
    Ok(Row::new(
        "(46)",
        "Affinities of M(3)",
        "Lambda^1_23 = Lambda^2_31 = Lambda^3_12 = 1",
        "The 27 affinities of M(3): the alternating symbol.",
    )
    .by(&["paper::m3"])
    .components("Lambda", gamma)
    .find(Finding::exact("`Lambda^i_jk = eps^i_jk`, all 27", &off)))
}

fn frame(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let n = vectors(group)[1].clone();
        let tangent = Velocity::of_path(group, |t| group.exp(&(&n * t)), 1.4, 0.02)?;
        Ok(apart(&tangent.body, &n))
    })?;
    Ok(Row::new(
        "(47), (48)",
        "Components of left-invariant fields",
        "e_i(p) = L_{p*} e_i(e), n^i_p = n^i_e",
        "Left-invariant fields have the same components everywhere.",
    )
    .by(&["InvariantField::at"])
    .find(Finding::within("the tangent of `exp(t n)` is `n` at every `t`", off, 1e-10)))
}

fn rays(lab: &Lab) -> Result<Row, Error> {
    let along = |group: &AnyGroup| -> Result<_, Error> {
        let n = &vectors(group)[0] * 1.3;
        let b = translation(group, CanonicalConnection::Plus)?.along_subgroup(&n)?;
        Ok((n, b))
    };
    let exponential = lab.on_groups(|group| {
        let (n, b) = along(group)?;
        Ok(distance(&b, &(-ad(group, &n)).exp()))
    })?;
    let adjoint = lab.on_groups(|group| {
        let (n, b) = along(group)?;
        let p = group.exp(&n);
        let ad_p = group.operator_matrix(|v| group.adjoint(&p, v));
        Ok(distance(&(ad_p * b), &DMatrix::identity(n.len(), n.len())))
    })?;
    let psi = Vector3::new(0.4, -1.2, 0.7);
    let b = translation(&So3, CanonicalConnection::Plus)?.along_subgroup(&psi)?;
    let matrix = distance(&b.transpose(), &So3.matrix(&So3.exp(&psi)));
    Ok(Row::new(
        "(49)-(51)",
        "Transport along a ray",
        "u_p = B u_e, u_e = A u_p, A(t) = exp(t n~), B(t) = exp(-t n~)",
        "Transport along a ray from `e` to `p`. On every group `A = Ad_p`.",
    )
    .by(&["ParallelTranslation::along_subgroup"])
    .find(Finding::within("`B = exp(-t ad_n)`", exponential, 1e-12))
    .find(Finding::within("`A = B^{-1} = Ad_p`", adjoint, 1e-12))
    .find(Finding::within("on the rotations `A = R`", matrix, 1e-14)))
}

fn images(lab: &Lab) -> Result<Row, Error> {
    let image = |group: &AnyGroup, which: CanonicalConnection| -> Result<f64, Error> {
        let g = motion(group)(1.3);
        let Velocity { body, spatial } = velocity(group, 1.3)?;
        let b = translation(group, which)?.along_subgroup(&group.log(&g)?)?;
        Ok(apart(&(b * spatial), &body))
    };
    let plus = lab.on_groups(|group| image(group, CanonicalConnection::Plus))?;
    let zero = lab.least_on_groups(|group| image(group, CanonicalConnection::Zero))?;
    Ok(Row::new(
        "(57)", "The two angular velocities as parallel translates",
        "Omega = B omega, omega = A Omega, A = R, B = R^T",
        "The two images of the velocity are parallel translates of each other. It is (10), told by the connection `plus`.",
    )
    .by(&["Velocity", "ParallelTranslation::along_subgroup"])
    .find(Finding::within("`Omega = B omega` with the transport of plus", plus, 1e-8))
    .find(Finding::within("with the transport of zero, (71)", zero, 1e-8).refuted()))
}

fn carried(lab: &Lab) -> Result<Row, Error> {
    let off = lab.on_groups(|group| {
        let [n, omega, _] = vectors(group);
        let right = InvariantField { side: Side::Right, vector: omega.clone() };
        let carried = translation(group, CanonicalConnection::Plus)?.along_subgroup(&n)? * &omega;
        Ok(apart(&carried, &right.at(group, &group.exp(&n))))
    })?;
    Ok(Row::new(
        "(58)",
        "The field that carries the spatial velocity",
        "nabla_n omegahat = 0",
        "The field that carries `omega` along the rays is the right-invariant one.",
    )
    .by(&["InvariantField"])
    .find(Finding::within("`B(q) omega` is the right-invariant field", off, 1e-12)))
}

/// Checks at which rotation vectors the two images of a velocity perpendicular to the axis are
/// equal.
fn equal_images() -> Result<Row, Error> {
    let n = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    let across = Vector3::new(1.0, 2.0, 0.0);
    let differ = |angle: f64, w: Vector3<f64>| {
        let Velocity { body, spatial } = Velocity::from_body(&So3, &So3.exp(&(n * angle)), w);
        (body - spatial).norm()
    };
    Ok(Row::new(
        "after (59)", "Equality of the two angular velocities",
        "Omega = omega",
        "The paper concludes that both are parallel to `n`.",
    )
    .status(Status::TooStrong(
        "This needs `R != I`. At the identity, and after whole turns, the two images of every velocity are equal.",
    ))
    .by(&["Velocity::from_body"])
    .find(Finding::within("along the axis, at two radians", differ(2.0, n), 1e-14))
    .find(Finding::within("across the axis, at two radians", differ(2.0, across), 1e-14).refuted())
    .find(Finding::within("across the axis, at the identity and after a whole turn", differ(0.0, across).max(differ(TAU, across)), 1e-14)))
}

fn one_parameter() -> Result<Row, Error> {
    let psi = So3.log(&rotation(0.9))?;
    let reached = So3.exp(&(psi / 0.9 * 0.9)).angle_to(&rotation(0.9));
    let n = psi / 0.9;
    let body = Velocity::of_path(&So3, rotation, 0.9, 0.02)?.body;
    let around = psi - psi.normalize() * TAU;
    Ok(Row::new("(60)", "Motion by rays", "Q(s, n) = exp(s n~), Q(t, n(t)) = R(t)", "A motion by its rays.")
        .status(Status::TooStrong(
            "`n(t) = Psi(t)/t` is not a velocity, it is undefined at `t = 0`, and beyond half a turn it is not unique. The library uses `Psi`.",
        ))
        .by(&["So3::exp", "LieGroup::log"])
        .find(Finding::within("`Q(t, n(t)) = R(t)`", reached, 1e-14))
        .find(Finding::within("`n` is the body velocity", (n - body).norm(), 1e-8).refuted())
        .find(Finding::within("the ray the other way round reaches the same rotation", So3.exp(&around).angle_to(&rotation(0.9)), 1e-14)))
}

fn rodrigues() -> Result<Row, Error> {
    let n = Vector3::new(1.0, -2.0, 2.0) / 3.0;
    let off = [0.0, 1e-9, 1e-3, 0.5, PI, 6.0, TAU, 100.0].map(|angle: f64| {
        let (s, half) = (spin(&n), (angle / 2.0).sin());
        let expected = Matrix3::identity() + s * angle.sin() + s * s * (2.0 * half * half);
        let found = So3.matrix(&So3.exp(&(n * angle)));
        (Matrix3::from_column_slice(found.as_slice()) - expected).amax()
    });
    Ok(Row::new(
        "after (60)", "Formula of Rodrigues",
        "A = I + sin theta/theta Psi~ + 1/2 (sin(theta/2)/(theta/2))^2 Psi~^2, theta = norm(Psi)",
        "The formula of Rodrigues, with half angles, which keeps the digits that `1 - cos theta` loses.",
    )
    .by(&["So3::exp"])
    .find(Finding::within("at angles from 0 to 100", off.into_iter().fold(0.0, f64::max), 1e-13)))
}

fn rotation_vector() -> Result<Row, Error> {
    let psi = Vector3::new(0.4, -1.2, 0.7);
    let off = (So3.log(&So3.exp(&psi))? - psi).norm();
    Ok(Row::new(
        "(61)",
        "Rotation vector",
        "Psi = t n",
        "The rotation vector: canonical coordinates.",
    )
    .by(&["LieGroup::log", "So3::log_near"])
    .find(Finding::within("`log(exp(Psi)) = Psi` within half a turn", off, 1e-14)))
}
