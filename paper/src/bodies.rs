//! Section 2: rotating bodies as in courses of mechanics, (1)-(16).

use crate::lab::{Lab, cross, rate, rotation, spin, symbols};
use crate::{Finding, Row, Section};
use affinor::geometry::equations::Equations;
use affinor::group::{LieGroup, So3, Velocity};
use affinor::mechanics::MassProperties;
use affinor::{CanonicalConnection, Error};
use affinor_tensors::Symbolic;
use nalgebra::{DMatrix, Matrix3, Vector3};

/// The time at which the motion is evaluated.
const T: f64 = 0.8;
/// Point masses and their positions in the body. No coordinate axis is a principal axis.
const MASSES: [(f64, [f64; 3]); 4] = [
    (1.0, [0.3, -0.5, 1.0]),
    (2.0, [-1.0, 0.2, 0.4]),
    (0.5, [0.8, 1.5, -0.3]),
    (1.5, [0.1, -0.7, -0.9]),
];

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    Ok(Section {
        title: "Section 2: rotating bodies",
        about: "A motion `R(t)` without symmetry, and a body of four masses without a principal axis among its coordinate axes.",
        rows: vec![
            axes()?,
            orthogonal()?,
            velocities()?,
            images()?,
            momentum()?,
            euler(lab)?,
            energy(lab)?,
        ],
    })
}

fn matrix(t: f64) -> DMatrix<f64> {
    So3.matrix(&rotation(t))
}

fn fixed(matrix: &DMatrix<f64>) -> Matrix3<f64> {
    Matrix3::from_column_slice(matrix.as_slice())
}

fn velocity() -> Result<Velocity<Vector3<f64>>, Error> {
    Velocity::of_path(&So3, rotation, T, 0.02)
}

fn axes() -> Result<Row, Error> {
    let third = So3.exp(&(Vector3::repeat(1.0).normalize() * std::f64::consts::TAU / 3.0));
    let matrix = So3.matrix(&third);
    let columns = So3.basis().into_iter().enumerate().map(|(i, unit)| {
        (third * unit - Vector3::from_column_slice(matrix.column(i).as_slice())).amax()
    });
    let columns = columns.fold(0.0, f64::max);
    let moved = (third * Vector3::new(3.0, 5.0, 7.0) - Vector3::new(7.0, 3.0, 5.0)).amax();
    Ok(Row::new(
        "(1)-(3)",
        "Components in the body and in space",
        "e_i(t) = R(t) E_i, x_i = r_ij X_j",
        "The rotation takes body components to spatial components.",
    )
    .by(&["group::So3", "rotation::matrix"])
    .find(Finding::within("the columns of `R` are the body axes `e_i`", columns, 1e-14))
    .find(Finding::within(
        "a third of a turn about `(1,1,1)` takes `(3,5,7)` to `(7,3,5)`",
        moved,
        1e-13,
    )))
}

fn orthogonal() -> Result<Row, Error> {
    let r = fixed(&matrix(T));
    let off = (r.transpose() * r - Matrix3::identity()).amax().max((r.determinant() - 1.0).abs());
    Ok(Row::new("(4)", "Rotation matrices", "R^T R = I, det R = 1", "Rotation matrices.")
        .by(&["LieGroup::matrix"])
        .find(Finding::within("on the motion", off, 1e-14)))
}

fn velocities() -> Result<Row, Error> {
    let (r, slope) = (fixed(&matrix(T)), fixed(&rate(matrix, T)));
    let Velocity { body, spatial } = velocity()?;
    let body = (r.transpose() * slope - spin(&body)).amax();
    let spatial = (slope * r.transpose() - spin(&spatial)).amax();
    Ok(Row::new(
        "(5)-(8)",
        "Angular velocity in the body and in space",
        "Omega~ = R^T Rdot, omega~ = Rdot R^T, Rdot = omega~ R = R Omega~",
        "The body and the spatial velocity, with `Omega~ = spin(Omega)`.",
    )
    .by(&["Velocity::of_path", "Velocity::of_samples"])
    .find(Finding::within("`R^T Rdot = spin(Omega)`", body, 1e-9))
    .find(Finding::within("`Rdot R^T = spin(omega)`", spatial, 1e-9)))
}

fn images() -> Result<Row, Error> {
    let r = fixed(&matrix(T));
    let Velocity { body, spatial } = velocity()?;
    let place = Vector3::new(0.3, -0.5, 1.0);
    let moving = rate(|t| DMatrix::from_column_slice(3, 1, (rotation(t) * place).as_slice()), T);
    let point =
        (Vector3::from_column_slice(moving.as_slice()) - spatial.cross(&(r * place))).amax();
    Ok(Row::new(
        "(9), (10)",
        "Velocity of a point",
        "xdot = omega x x, omega = R Omega",
        "The velocity of a point, and the two images of the angular velocity.",
    )
    .by(&["Velocity", "LieGroup::adjoint"])
    .find(Finding::within("`xdot = omega x x`", point, 1e-9))
    .find(Finding::within("`omega = R Omega`", (spatial - r * body).amax(), 1e-13))
    .find(
        Finding::within(
            "the other way round, `Omega = R omega`",
            (body - r * spatial).amax(),
            1e-13,
        )
        .refuted(),
    ))
}

/// The inertia matrix `J` of the point masses about the origin, computed by the library.
fn inertia() -> Result<Matrix3<f64>, Error> {
    let masses = MASSES.map(|(mass, place)| (mass, Vector3::from(place)));
    let body = MassProperties::points(&masses)?;
    Ok(body.inertia_matrix_about(&Vector3::zeros()))
}

fn momentum() -> Result<Row, Error> {
    let (r, j, Velocity { body, spatial }) = (fixed(&matrix(T)), inertia()?, velocity()?);
    let sum = MASSES.iter().fold(Vector3::zeros(), |sum, (mass, place)| {
        let x = r * Vector3::from(*place);
        sum + x.cross(&spatial.cross(&x)) * *mass
    });
    let off = (sum - r * j * body).amax().max((sum - r * j * r.transpose() * spatial).amax());
    Ok(Row::new(
        "(11)-(14)",
        "Angular momentum and inertia",
        "h = R J R^T omega = R H, H = J Omega",
        "The angular momentum `h`, the sum of `m r x v` over the masses at `r`, and the inertia.",
    )
    .by(&["MassProperties::inertia_matrix_about", "Metric::lower"])
    .find(Finding::within(
        "the sum over the masses is `R J R^T omega = R J Omega`",
        off,
        1e-12,
    )))
}

fn euler(lab: &Lab) -> Result<Row, Error> {
    let (omega, torque) = (symbols("Omega", 3), symbols("M", 3));
    let metric = lab.inertia()?;
    let equations = Equations::euler_poincare(&lab.canonical(CanonicalConnection::Plus), metric)?;
    let found = metric.lower(&equations.rate(&omega, &torque)?)?;
    let gyroscopic = cross(&omega, &metric.lower(&omega)?);
    let expected: Vec<Symbolic> =
        torque.iter().zip(&gyroscopic).map(|(m, g)| m.clone() - g).collect();
    Ok(Row::new(
        "(15)",
        "Euler's equations",
        "J dOmega/dt + Omega x H = M",
        "Euler's equations, in body components.",
    )
    .by(&["Equations::euler_poincare"])
    .find(Finding::equal(
        "`J dOmega/dt = M - Omega x H` for all `J`, `Omega`, `M`",
        &found,
        &expected,
    )))
}

fn energy(lab: &Lab) -> Result<Row, Error> {
    let (j, Velocity { body, spatial }, r) = (inertia()?, velocity()?, fixed(&matrix(T)));
    let sum: f64 = MASSES
        .iter()
        .map(|(mass, place)| {
            0.5 * mass * spatial.cross(&(r * Vector3::from(*place))).norm_squared()
        })
        .sum();
    let form = 0.5 * body.dot(&(j * body));
    let omega = symbols("Omega", 3);
    let h = lab.inertia()?.lower(&omega)?;
    Ok(Row::new(
        "(16)",
        "Kinetic energy",
        "T = 1/2 Omega^T J Omega = 1/2 H Omega",
        "The kinetic energy.",
    )
    .by(&["Metric::lower"])
    .find(Finding::within("the sum over the masses", (sum - form).abs(), 1e-13))
    .find(Finding::value(&format!("H_1 = {}", h[0]))))
}
