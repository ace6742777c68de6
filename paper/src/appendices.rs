//! Appendices A and B: derivatives along frames, torsion and curvature, (A1)-(B14).

use crate::lab::Lab;
use crate::{Finding, Row, Section, Status};
use affinor::algebra::catalogue;
use affinor::geometry::chart::{CanonicalCoordinates, Chart, Side};
use affinor::{Connection, Error, Frame, Metric};
use affinor_tensors::{Down, Rational, Symbolic, Tensor, Up, contract};

/// The affine group of the line in canonical coordinates of the second kind, `a` and `b`. The
/// vectors of its frame are not partial derivatives.
struct Line {
    frame: Frame<Symbolic>,
    /// The components `e^a_i`; the frame vectors are the columns.
    fields: Tensor<Symbolic>,
}

impl Line {
    fn new() -> Result<Self, Error> {
        let chart = Chart::new(["a", "b"])?;
        let algebra = catalogue::algebra("aff(1)")?;
        let fields = chart.invariant_fields(&algebra, CanonicalCoordinates::Second, Side::Left)?;
        Ok(Line { frame: fields.frame().clone(), fields: fields.components().clone() })
    }

    /// A connection whose affinities depend on the coordinates and have no symmetry.
    fn connection(&self) -> Result<Connection<Symbolic>, Error> {
        let [a, b] = ["a", "b"].map(Symbolic::parameter);
        let entry = |[i, j, k]: [usize; 3]| match (i + 2 * j + k) % 4 {
            0 => a.clone() * &b,
            1 => b.clone() * &b + &integer(i as i64 + 1),
            2 => a.clone() + &integer(j as i64 + 1),
            _ => integer(0),
        };
        Connection::new(self.frame.clone(), Tensor::from_fn(2, [Up, Down, Down], entry)?)
    }

    /// Two vector fields and a function, all without symmetries.
    fn fields(&self) -> [Vec<Symbolic>; 3] {
        let [a, b] = ["a", "b"].map(Symbolic::parameter);
        [
            vec![a.clone() * &b + &integer(1), b.clone()],
            vec![b.clone() * &b, a.clone() + &integer(2)],
            vec![a.clone() * &a * &b + &b],
        ]
    }

    /// The derivative `X(f) = X^i e_i(f)` (A1).
    fn along(&self, x: &[Symbolic], f: &Symbolic) -> Symbolic {
        (0..2).fold(integer(0), |sum, i| sum + &(x[i].clone() * &self.frame.derive(i, f)))
    }
}

fn integer(value: i64) -> Symbolic {
    Symbolic::constant(Rational::from(value))
}

/// The components `(nabla_X Y)^i` in the frame of the connection.
fn nabla(
    connection: &Connection<Symbolic>,
    x: &[Symbolic],
    y: &[Symbolic],
) -> Result<Vec<Symbolic>, Error> {
    let nabla = connection.nabla(&Tensor::vector(y, Up))?;
    let along = contract("N^i_m x^m -> ^i", &[("N", &nabla), ("x", &Tensor::vector(x, Up))])?;
    Ok((0..x.len()).map(|i| along.get(&[i])).collect())
}

fn difference(a: &[Symbolic], b: &[Symbolic]) -> Vec<Symbolic> {
    a.iter().zip(b).map(|(a, b)| a.clone() - b).collect()
}

pub(crate) fn section(lab: &Lab) -> Result<Section, Error> {
    let line = Line::new()?;
    Ok(Section {
        title: "Appendices",
        about: "Computed with symbols in the left-invariant frame of the affine group of the line, in coordinates `a`, `b`, with affinities that are functions.",
        rows: vec![
            derivatives(&line)?,
            bracket(&line)?,
            coordinate_basis()?,
            antisymmetric(lab)?,
            directions(&line)?,
            parallel(&line)?,
            symmetric_part(&line)?,
            torsion(&line)?,
            torsion_free(lab)?,
            curvature(&line)?,
        ],
    })
}

fn derivatives(line: &Line) -> Result<Row, Error> {
    let [_, _, f] = line.fields();
    let partials = ["a", "b"].map(|name| affinor_tensors::Notation::derivative(&f[0], name));
    let along: Vec<_> = (0..2).map(|i| line.frame.derive(i, &f[0])).collect();
    let chain: Vec<_> = (0..2)
        .map(|i| (0..2).fold(integer(0), |sum, a| sum + &(line.fields.get(&[a, i]) * &partials[a])))
        .collect();
    Ok(Row::new("(A1), (A2)", "Derivatives along a frame", "X(f) = X^i e_i(f), e_i(f) = e^a_i df/dtheta^a", "Derivatives of functions along the frame.")
        .status(Status::Misprint(
            "(A2) writes `partial_i f`, which holds in a basis of coordinates only. In (32), (37), (A6) and (B2) the frame is another one, and the derivative is `e_i(f)`.",
        ))
        .by(&["Frame::derivative"])
        .find(Finding::equal("`e_i(f)` by the chain rule", &along, &chain))
        .find(Finding::equal("`e_i(f) = partial_i f`", &along, &partials).refuted()))
}

fn bracket(line: &Line) -> Result<Row, Error> {
    let [x, y, f] = line.fields();
    let commutator =
        line.along(&x, &line.along(&y, &f[0])) - &line.along(&y, &line.along(&x, &f[0]));
    let found = line.along(&line.frame.bracket(&x, &y)?, &f[0]);
    // leaves out the structure constants, which gives a wrong bracket
    let part = |x: &[Symbolic], y: &Symbolic| line.along(x, y);
    let without: Vec<_> = (0..2).map(|i| part(&x, &y[i]) - &part(&y, &x[i])).collect();
    Ok(Row::new("(A3)-(A8)", "Bracket of fields", "L_X Y = [X, Y] = X Y - Y X", "The bracket of fields is the commutator of derivations; in the frame it has the components (32).")
        .status(Status::Convention("The structure \"constants\" are constant in invariant frames only; in others they are functions."))
        .by(&["Frame::bracket", "Frame::structure_functions"])
        .find(Finding::equal("`[X,Y] f = X(Y f) - Y(X f)`", &[found], std::slice::from_ref(&commutator)))
        .find(Finding::equal("without the term in `c^i_jk`", &[line.along(&without, &f[0])], &[commutator]).refuted()))
}

fn coordinate_basis() -> Result<Row, Error> {
    let frame = Frame::<Symbolic>::coordinates(["x", "y", "z"])?;
    Ok(Row::new("(A9)", "Bracket in coordinates", "[e_i, e_j] = 0", "In a basis of coordinates.")
        .by(&["Frame::coordinates"])
        .find(Finding::exact("`c^i_jk = 0`", frame.structure_functions())))
}

fn antisymmetric(lab: &Lab) -> Result<Row, Error> {
    Row::new(
        "(A10)",
        "Antisymmetry of structure constants",
        "c^k_ji = -c^k_ij",
        "Structure constants are antisymmetric.",
    )
    .by(&["Bracket::new"])
    .on_algebras(lab, "", |algebra| {
        Ok(contract("c^k_ij + c^k_ji -> ^k_ij", &[("c", algebra.structure_constants())])?)
    })
}

fn directions(line: &Line) -> Result<Row, Error> {
    let (connection, [x, y, _]) = (line.connection()?, line.fields());
    let found = nabla(&connection, &x, &y)?;
    let gamma = connection.affinities();
    let by_hand = |swap: bool| -> Vec<Symbolic> {
        let term = |k: usize, i: usize, j: usize| {
            if swap { gamma.get(&[k, j, i]) } else { gamma.get(&[k, i, j]) }
        };
        (0..2)
            .map(|k| {
                let pairs = (0..4).map(|at| (at / 2, at % 2));
                pairs.fold(line.along(&x, &y[k]), |sum, (i, j)| {
                    sum + &(term(k, i, j) * &x[i] * &y[j])
                })
            })
            .collect()
    };
    Ok(Row::new(
        "(B1)-(B3)",
        "Order of the lower indices",
        "nabla_{e_j} e_k = Lambda^i_jk e_i, nabla_w v = (e_i(v^k) + Lambda^k_ij v^j) w^i e_k",
        "The first lower index is the direction.",
    )
    .by(&["Connection::nabla"])
    .find(Finding::equal("`nabla_w v` by (B2)", &found, &by_hand(false)))
    .find(Finding::equal("with the lower indices exchanged", &found, &by_hand(true)).refuted()))
}

fn parallel(line: &Line) -> Result<Row, Error> {
    // checks that the right-invariant fields are parallel for the connection plus
    let plus = Connection::new(line.frame.clone(), line.frame.structure_functions().clone())?;
    let chart = Chart::new(["a", "b"])?;
    let right = chart.invariant_fields(
        &catalogue::algebra("aff(1)")?,
        CanonicalCoordinates::Second,
        Side::Right,
    )?;
    let to_left = affinor::BasisChange::new(line.fields.clone())?;
    let mut row = Row::new(
        "(B4), (B5)",
        "Parallel fields",
        "nabla_w v = 0, vdot^i + Lambda^i_jk w^j v^k = 0",
        "Parallel fields.",
    )
    .by(&["Connection::nabla", "Connection::transport_along"]);
    for i in 0..2 {
        let column: Vec<_> = (0..2).map(|a| right.components().get(&[a, i])).collect();
        let left: Vec<_> = (0..2)
            .map(|j| {
                (0..2)
                    .fold(integer(0), |sum, a| sum + &(to_left.inverse().get(&[j, a]) * &column[a]))
            })
            .collect();
        let claim =
            format!("with plus the right-invariant field through `e_{}` is parallel", i + 1);
        row = row.find(Finding::exact(&claim, &plus.nabla(&Tensor::vector(&left, Up))?));
    }
    Ok(row)
}

fn symmetric_part(line: &Line) -> Result<Row, Error> {
    let gamma = line.connection()?.affinities().clone();
    let n = Tensor::vector(&["n1", "n2"].map(Symbolic::parameter), Up);
    let turned = |text: &str| contract(text, &[("L", &gamma), ("n", &n)]);
    let all = turned("L^i_jk n^j n^k -> ^i")?;
    let symmetric = turned("1/2 L^i_jk n^j n^k + 1/2 L^i_kj n^j n^k -> ^i")?;
    let off = contract("a^i - b^i -> ^i", &[("a", &all), ("b", &symmetric)])?;
    let antisymmetric = turned("L^i_jk n^j n^k - L^i_kj n^j n^k -> ^i")?;
    Ok(Row::new("(B6)-(B8)", "Autoparallels", "nabla_n n = 0, ndot^i + Lambda^i_jk n^j n^k = 0", "Autoparallels. Where the affinities are antisymmetric, `ndot = 0`.")
        .status(Status::TooStrong(
            "Geodesics are autoparallels if the connection is metric and has no torsion. This is sufficient, not necessary: a totally antisymmetric torsion does no harm.",
        ))
        .by(&["Connection::transport_generator"])
        .find(Finding::exact("only the symmetric part enters", &off))
        .find(Finding::exact("the antisymmetric part gives nothing", &antisymmetric)))
}

fn torsion(line: &Line) -> Result<Row, Error> {
    let (connection, [x, y, _]) = (line.connection()?, line.fields());
    let operands = [
        ("t", &connection.torsion()),
        ("x", &Tensor::vector(&x, Up)),
        ("y", &Tensor::vector(&y, Up)),
    ];
    let found = contract("t^i_jk x^j y^k -> ^i", &operands)?;
    let found: Vec<_> = (0..2).map(|i| found.get(&[i])).collect();
    let expected = difference(&nabla(&connection, &x, &y)?, &nabla(&connection, &y, &x)?);
    let expected = difference(&expected, &line.frame.bracket(&x, &y)?);
    Ok(Row::new(
        "(B9), (B10)",
        "Torsion",
        "tau(X,Y) = nabla_X Y - nabla_Y X - [X,Y], tau^i_jk = Lambda^i_jk - Lambda^i_kj - c^i_jk",
        "The torsion.",
    )
    .by(&["Connection::torsion"])
    .find(Finding::equal("(B10) gives (B9) for fields that are functions", &found, &expected)))
}

fn torsion_free(lab: &Lab) -> Result<Row, Error> {
    Row::new(
        "(B11), (B12)",
        "Connections without torsion",
        "c^i_jk = Lambda^i_jk - Lambda^i_kj",
        "Without torsion. In a basis of coordinates the affinities are symmetric.",
    )
    .by(&["Connection::levi_civita"])
    .on_algebras(lab, "Levi-Civita of a metric that is not diagonal, ", |algebra| {
        let n = algebra.dimension();
        let entry = |[i, j]: [usize; 2]| {
            Rational::from(if i == j { 2 + i as i64 } else { i64::from(i.abs_diff(j) == 1) })
        };
        let metric = Metric::new(algebra.labels(), Tensor::from_fn(n, [Down, Down], entry)?)?;
        let connection = Connection::levi_civita(algebra.left_frame(), &metric)?;
        let operands = [("L", connection.affinities()), ("c", algebra.structure_constants())];
        Ok(contract("L^i_jk - L^i_kj - c^i_jk -> ^i_jk", &operands)?)
    })
}

fn curvature(line: &Line) -> Result<Row, Error> {
    let (connection, [x, y, _]) = (line.connection()?, line.fields());
    let v = difference(&x, &y);
    let of = |x: &[Symbolic], v: &[Symbolic]| nabla(&connection, x, v);
    let twice = difference(&of(&x, &of(&y, &v)?)?, &of(&y, &of(&x, &v)?)?);
    let expected = difference(&twice, &of(&line.frame.bracket(&x, &y)?, &v)?);
    let vectors = [&x, &y, &v].map(|v| Tensor::vector(v, Up));
    let operands =
        [("R", connection.curvature()), ("x", &vectors[0]), ("y", &vectors[1]), ("v", &vectors[2])];
    let found = contract("R^i_jkl v^j x^k y^l -> ^i", &operands)?;
    let found: Vec<_> = (0..2).map(|i| found.get(&[i])).collect();
    // the three products of the curvature that contain no derivatives of the affinities
    let products = [("L", connection.affinities()), ("c", line.frame.structure_functions())];
    let products = contract("L^i_km L^m_lj - L^i_lm L^m_kj - c^m_kl L^i_mj -> ^i_jkl", &products)?;
    let missing = contract(
        "a^i_jkl - b^i_jkl -> ^i_jkl",
        &[("a", connection.curvature()), ("b", &products)],
    )?;
    Ok(Row::new(
        "(B13), (B14)", "Curvature",
        "R(X,Y) v = nabla_X nabla_Y v - nabla_Y nabla_X v - nabla_{[X,Y]} v",
        "The curvature: `R^i_jkl = e_k(Lambda^i_lj) - e_l(Lambda^i_kj) + Lambda^i_km Lambda^m_lj - Lambda^i_lm Lambda^m_kj - c^m_kl Lambda^i_mj`.",
    )
    .status(Status::Convention("The order of the indices is `i` (covector), `j` (`v`), `k` (`X`), `l` (`Y`). The commas are derivatives along the frame."))
    .by(&["Connection::curvature"])
    .find(Finding::equal("(B14) gives (B13) for fields and affinities that are functions", &found, &expected))
    .find(Finding::exact("the products of (B14) alone are the curvature", &missing).refuted()))
}
