//! Constraints on the velocity and constraints that depend on time: closed forms, and one problem
//! that an independent program integrated.
//!
//! Guards `mechanics::systems::reduced`, `mechanics::systems::constrained` and
//! `mechanics::simulation::classes::constrained`.

use super::references::off;
use super::run::Run;
use affinor::mechanics::simulation::Method;
use affinor_documents::problem::Problem;

fn parse(text: &str) -> Problem {
    Problem::parse("problem.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    match Problem::parse("problem.toml", text).and_then(|problem| problem.motion(0).map(|_| ())) {
        Err(error) => error.to_string(),
        Ok(()) => panic!("{text} is accepted"),
    }
}

/// The values of columns in the last row.
fn last(problem: &Problem, names: &[&str]) -> Vec<f64> {
    let run = Run::new(problem, 0);
    run.values(run.rows.len() - 1, names)
}

/// The same for a problem of bodies and joints, whose columns are not all written by default.
fn last_of_bodies(problem: &Problem, names: &[&str]) -> Vec<f64> {
    last(&problem.with_columns(names), names)
}

/// Checks the values of columns in the last row: for the default method to a tolerance, and for
/// methods with a step by their order of convergence.
fn expect(problem: &Problem, names: &[&str], expected: &[f64], tolerance: f64, step: f64) {
    let error = off(&last(problem, names), expected);
    assert!(error < tolerance, "{error:e}");
    for (method, order) in [(Method::GeneralisedAlpha, 2.0), (Method::MuntheKaas4, 4.0)] {
        let error =
            |h: f64| off(&last(&problem.with_method(method, Some(h), None), names), expected);
        let (whole, half) = (error(step), error(0.5 * step));
        let found = (whole / half).log2();
        assert!(whole < 0.2 && (found - order).abs() < 0.3, "{method}: {whole:e}, order {found}");
    }
}

/// The sleigh of Chaplygin: the centre of mass is at the distance `a` in front of a knife edge.
struct Sleigh {
    m: f64,
    i: f64,
    a: f64,
    spin: f64,
    speed: f64,
}

impl Sleigh {
    /// The angular velocity, the speed and the force of the edge at a time:
    /// `u = U tanh(c (t - t_0))`, `omega = U sqrt(m/K) sech(c (t - t_0))` with `K = I + m a^2`.
    fn at(&self, time: f64) -> [f64; 3] {
        let Sleigh { m, i, a, spin, speed } = self;
        let about = i + m * a * a;
        let top = (speed * speed + about * spin * spin / m).sqrt();
        let c = a * m * top / about;
        let at = c * time + (speed / top).atanh();
        let (u, omega) = (top * at.tanh(), top * (m / about).sqrt() / at.cosh());
        [omega, u, -m * u * omega * i / about]
    }

    /// The integral of `omega`: `sqrt(K/m)/a` times the change of `2 atan(tanh(c (t - t_0)/2))`.
    fn angle(&self, time: f64) -> f64 {
        let Sleigh { m, i, a, spin, speed } = self;
        let about = i + m * a * a;
        let top = (speed * speed + about * spin * spin / m).sqrt();
        let (start, c) = ((speed / top).atanh(), a * m * top / about);
        let turn = |x: f64| 2.0 * (0.5 * x).tanh().atan();
        (about / m).sqrt() / a * (turn(c * time + start) - turn(start))
    }

    fn problem(&self, space: &str) -> Problem {
        let Sleigh { m, i, a, spin, speed } = self;
        parse(&format!(
            "{space}\nparameters = {{ m = {m:?}, I = {i:?}, a = {a:?}, w = {spin:?}, u = {speed:?} }}\n\
             output = {{ end = 4, every = 1 }}\nintegrator.tolerance = 1e-13\n"
        ))
    }
}

/// The frame at the knife edge, in which the inertia is not diagonal.
const AT_EDGE: &str = "space = \"se2\"\nvelocity_constraints = [\"Omega3\"]\n\
     metric = [[\"I + m*a^2\", 0, \"m*a\"], [0, \"m\", 0], [\"m*a\", 0, \"m\"]]\n\
     initial.velocity = [\"w\", \"u\", 0]\n";

/// The same as a body on a planar joint and a knife edge. The second translation of the joint is along
/// the negative first axis.
const ON_JOINT: &str = "bodies = [{ name = \"ground\", fixed = true }, { name = \"sleigh\", inertia.parts = [{ \
     shape = \"inertia\", mass = \"m\", position = [\"a\", 0, 0], matrix = [[\"I\", 0, 0], [0, \"I\", 0], [0, 0, \"I\"]] }] }]\n\
     joints = [{ name = \"J\", type = \"planar\", bodies = [\"ground\", \"sleigh\"], at = [0, 0, 0], axis = [0, 0, 1], \
     rate = [\"w\", 0, \"-u\"] }]\n\
     contacts = [{ type = \"edge\", body = \"sleigh\", at = [0, 0, 0], axis = [1, 0, 0] }]\n";

#[test]
fn the_sleigh_of_chaplygin() {
    let sleigh = Sleigh { m: 2.0, i: 0.5, a: 0.3, spin: 1.2, speed: 0.1 };
    let problem = sleigh.problem(AT_EDGE);
    expect(&problem, &["Omega1", "Omega2", "lambda1"], &sleigh.at(4.0), 1e-11, 0.2);
    let run = Run::new(&problem, 0);
    run.keeps(&["energy"], 1e-12);
    assert!(run.column("violation").iter().all(|off| off.abs() < 1e-14));
    let ready = problem.motion(0).unwrap();
    assert_eq!(ready.method, Method::MuntheKaas853);
    assert!(ready.columns.iter().any(|column| column.name == "energy" && column.conserved));
    // the frame at the centre of mass
    let centred = sleigh.problem(
        "space = \"se2\"\nmetric = \"diag(I, m, m)\"\nvelocity_constraints = [\"Omega3 - a*Omega1\"]\n\
         initial.velocity = [\"w\", \"u\", \"a*w\"]\n",
    );
    let found = last(&centred, &["Omega1", "Omega2", "lambda1"]);
    assert!(off(&found, &sleigh.at(4.0)) < 1e-11, "{found:?}");
    // bodies and joints
    let found = last_of_bodies(&sleigh.problem(ON_JOINT), &["Omega3", "Omega4", "lambda2", "q1_J"]);
    let expected = [&sleigh.at(4.0)[..], &[sleigh.angle(4.0)]].concat();
    assert!(off(&found, &expected) < 1e-11, "{found:?}");
    // millimetres and grams
    let small = Sleigh { m: 2e3, i: 5e8, a: 300.0, spin: 1.2, speed: 100.0 };
    let ([omega, u, force], expected) = (small.at(4.0), sleigh.at(4.0));
    assert!(off(&[omega, u / 1e3, force / 1e6], &expected) < 1e-12);
    let found = last(&small.problem(AT_EDGE), &["Omega1", "Omega2", "lambda1"]);
    assert!(off(&[found[0], found[1] / 1e3, found[2] / 1e6], &expected) < 1e-11, "{found:?}");
}

/// The problem of Suslov: a body that cannot rotate about its axis 3. With
/// `Omega1 = sqrt(2 T/I1) cos(psi + d)` and `Omega2 = sqrt(2 T/I2) sin(psi + d)`, `sin(psi)` is a
/// hyperbolic tangent. The constraint may have any factor, which may depend on the pose; in this
/// case, the constraint is not left-invariant in form.
#[test]
fn the_problem_of_suslov() {
    let expected = suslov([1.0, 2.0, 0.3, 0.4]);
    for constraint in ["Omega3", "-3*Omega3", "(2 + g11)*Omega3", "exp(t)*Omega3"] {
        let problem = parse(&format!(
            "space = \"so3\"\nmetric = [[1, 0, \"3/10\"], [0, 2, \"2/5\"], [\"3/10\", \"2/5\", 3]]\n\
             velocity_constraints = [\"{constraint}\"]\ninitial.velocity = [0.5, 1, 0]\n\
             output = {{ end = 5, every = 1 }}\nintegrator.tolerance = 1e-13\n"
        ));
        let found = last(&problem, &["Omega1", "Omega2"]);
        assert!(off(&found, &expected) < 1e-11, "{constraint}: {found:?}");
        Run::new(&problem, 0).keeps(&["energy"], 1e-11);
    }
    // a body on a spherical joint; its moments satisfy the triangle inequality
    let expected = suslov([2.0, 2.5, 0.3, 0.4]);
    for constraint in ["v3_J", "(2 + qx_J)*v3_J"] {
        let problem = parse(&format!(
            "bodies = [{{ name = \"ground\", fixed = true }}, {{ name = \"body\", inertia.parts = [{{ shape = \"inertia\", \
             mass = 2, position = [0, 0, 0], matrix = [[2, 0, 0.3], [0, 2.5, 0.4], [0.3, 0.4, 3]] }}] }}]\njoints = [{{ \
             name = \"J\", type = \"spherical\", bodies = [\"ground\", \"body\"], at = [0, 0, 0], rate = [0.5, 1, 0] }}]\n\
             velocity_constraints = [\"{constraint}\"]\n\
             output = {{ end = 5, every = 1 }}\nintegrator.tolerance = 1e-13\n"
        ));
        let found = last_of_bodies(&problem, &["Omega1", "Omega2"]);
        assert!(off(&found, &expected) < 1e-11, "{constraint}: {found:?}");
    }
}

/// The first two components of the angular velocity at `t = 5`, for the moments `I1`, `I2` and the
/// products `I13`, `I23`, from `(0.5, 1)`.
fn suslov([i1, i2, i13, i23]: [f64; 4]) -> [f64; 2] {
    let (start, time) = ([0.5f64, 1.0f64], 5.0);
    let double = i1 * start[0].powi(2) + i2 * start[1].powi(2);
    let (c, s) = (i13 * (double / i1).sqrt(), i23 * (double / i2).sqrt());
    let (rate, d) = (c.hypot(s) / (i1 * i2).sqrt(), s.atan2(c));
    let psi = (start[1] * i2.sqrt()).atan2(start[0] * i1.sqrt()) - d;
    let psi = (rate * time + psi.sin().atanh()).tanh().asin();
    [(double / i1).sqrt() * (psi + d).cos(), (double / i2).sqrt() * (psi + d).sin()]
}

/// A component of the spatial velocity is a combination of components of the body velocity, with
/// entries of the element as coefficients.
#[test]
fn spatial_and_body_components_agree() {
    let problem = |constraint: &str| {
        parse(&format!(
            "space = \"so3\"\nmetric = [[1, 0, \"3/10\"], [0, 2, \"2/5\"], [\"3/10\", \"2/5\", 3]]\n\
             velocity_constraints = [\"{constraint}\"]\ninitial.velocity = [0.5, 1, 0]\n\
             forces.potential = \"g13 + g31\"\noutput = {{ end = 3, every = 1 }}\n\
             integrator.tolerance = 1e-13\n"
        ))
    };
    let names = ["qw", "qx", "qy", "qz", "Omega1", "Omega2", "Omega3", "lambda1"];
    let spatial = last(&problem("omega3"), &names);
    let body = last(&problem("g31*Omega1 + g32*Omega2 + g33*Omega3"), &names);
    assert!(off(&spatial, &body) < 1e-11, "{spatial:?} {body:?}");
    Run::new(&problem("omega3"), 0).keeps(&["energy"], 1e-11);
}

/// A vertical disk of radius `r` that rolls with the rate `p` and turns with the rate `w`. The centre
/// of the disk describes a circle of radius `r p/w`, and the ground pulls the disk to the centre.
#[test]
fn the_vertical_rolling_disk() {
    let (m, r, p, w, time) = (3.0, 0.4, 2.5, 0.7, 4.0);
    let problem = parse(
        "space = \"se2+R^1\"\nmetric = \"diag(1/5, 3, 3, 1/3)\"\n\
         velocity_constraints = [\"Omega2 - 0.4*Omega4\", \"Omega3\"]\n\
         initial.velocity = [0.7, \"0.4*2.5\", 0, 2.5]\n\
         output = { end = 4, every = 1 }\nintegrator.tolerance = 1e-13\n",
    );
    let (radius, angle) = (r * p / w, w * time);
    let found = last(&problem, &["angle_1", "x_1", "y_1", "x1_2", "lambda1", "lambda2"]);
    let (x, y) = (radius * f64::sin(angle), radius * (1.0 - f64::cos(angle)));
    let expected = [angle, x, y, p * time, 0.0, -m * r * p * w];
    assert!(off(&found, &expected) < 1e-11, "{found:?} {expected:?}");
}

/// A homogeneous ball that rolls on a turntable with the rate `W` describes circles with the rate
/// `2 W/7`. The table does work, so the energy is not a conserved quantity.
#[test]
fn a_ball_on_a_turntable() {
    let table = |rate: f64| {
        parse(&format!(
            r#"
space = "se3"
parameters = {{ m = 1.5, r = 0.2, W = {rate:?}, J = "2/5*m*r^2" }}
metric = "diag(J, J, J, m, m, m)"
constraints = ["z - r"]
velocity_constraints = [
    "g11*Omega4 + g12*Omega5 + g13*Omega6 - r*omega2 + W*y",
    "g21*Omega4 + g22*Omega5 + g23*Omega6 + r*omega1 - W*x",
]
initial.position = [1, 0, "r"]
initial.velocity = [0.5, 0, 0.3, 0, "W - r*0.5", 0]
output = {{ end = 7, every = 1 }}
integrator.tolerance = 1e-13
"#
        ))
    };
    let circle = |rate: f64| {
        let (k, speed) = (2.0 / 7.0 * rate, rate - 0.2 * 0.5);
        let (sin, cos) = f64::sin_cos(k * 7.0);
        [1.0 + speed / k * (cos - 1.0), speed / k * sin, 0.2]
    };
    expect(&table(0.5), &["x", "y", "z"], &circle(0.5), 1e-11, 0.1);
    let found = last(&table(3.0), &["x", "y", "z"]);
    assert!(off(&found, &circle(3.0)) < 1e-10, "{found:?}");
    let ready = table(3.0).motion(0).unwrap();
    assert!(ready.columns.iter().all(|column| column.name != "energy" || !column.conserved));
}

/// The same with a turntable that a motor drives, which may be tilted: the centre of the circles drifts
/// sideways. With `b = 1/(1 + m r^2/I)` and the acceleration `h` along the table, the velocity satisfies
/// `v' = b W e_z x v + (1 - b) h`.
#[test]
fn a_ball_on_a_tilted_turntable() {
    let text = include_str!("../../../../examples/mechanisms/turntable.toml")
        .replace("tolerance = 1e-10", "tolerance = 1e-13");
    for (rate, tilt, share) in [(2.0, 0.0, 0.4), (2.0, 0.02, 0.4), (-1.5, 0.05, 2.0 / 3.0)] {
        let mut problem = parse(&text);
        problem.set(&format!("W={rate},tilt={tilt},share={share}")).unwrap();
        let b = share / (1.0 + share);
        let (k, time) = (b * rate, 20.0);
        let drift = [0.0, (1.0 - b) * 9.81 * f64::sin(tilt) / k];
        let velocity = [0.06, rate - 0.1];
        let [u, v] = [0, 1].map(|i| velocity[i] - drift[i]);
        let (sin, cos) = f64::sin_cos(k * time);
        let x = (u * sin - v * (1.0 - cos)) / k;
        let y = drift[1] * time + (u * (1.0 - cos) + v * sin) / k;
        let found = last_of_bodies(&problem, &["q1_ball", "q2_ball", "q_table", "q3_ball"]);
        assert!(off(&found, &[x, y, rate * time, 0.0]) < 1e-10, "{found:?} {x} {y}");
    }
}

/// A bead on a wire that rotates with the rate `w`: its distance from the axis is
/// `r_0 cosh(w t) + v_0 sinh(w t)/w`, and the wire pushes it with twice `w r'`.
#[test]
fn a_bead_on_a_rotating_wire() {
    let (w, r, v, time) = (2.0f64, 1.0f64, 0.5f64, 1.0f64);
    let problem = parse(
        "space = \"R^2\"\nmetric = \"identity\"\nparameters = { w = 2 }\n\
         constraints = [\"x2*cos(w*t) - x1*sin(w*t)\"]\n\
         initial = { coordinates = [1, 0], velocity = [0.5, \"w\"] }\n\
         output = { end = 1, every = 1 }\nintegrator.tolerance = 1e-13\n",
    );
    let (sinh, cosh) = ((w * time).sinh(), (w * time).cosh());
    let (along, rate) = (r * cosh + v * sinh / w, r * w * sinh + v * cosh);
    let (sin, cos) = (w * time).sin_cos();
    let expected = [along * cos, along * sin, -2.0 * w * rate];
    expect(&problem, &["x1", "x2", "lambda1"], &expected, 1e-11, 0.05);
    let ready = problem.motion(0).unwrap();
    assert!(ready.columns.iter().all(|column| column.name != "energy" || !column.conserved));
}

/// A slider that a crank of radius 1 and rate `w` moves by a rod of length `l`:
/// `x = cos(w t) + sqrt(l^2 - sin(w t)^2)`. The force of the constraint is the mass times `x''`.
#[test]
fn a_driven_slider_crank() {
    let (w, l, time) = (2.0f64, 2.0f64, 5.0f64);
    let problem = parse(
        "space = \"R^2\"\nmetric = \"identity\"\nparameters = { w = 2, l = 2 }\n\
         constraints = [\"x1 - cos(w*t) - sqrt(l^2 - sin(w*t)^2)\", \"x2\"]\n\
         initial = { coordinates = [3, 0], velocity = [0, 0] }\n\
         output = { end = 5, every = 1 }\nintegrator.tolerance = 1e-12\n",
    );
    let (sin, cos) = (w * time).sin_cos();
    let root = (l * l - sin * sin).sqrt();
    let velocity = -w * sin - w * sin * cos / root;
    // (sin cos/root)' = w ((cos^2 - sin^2)/root + sin^2 cos^2/root^3)
    let bend = (cos * cos - sin * sin) / root + (sin * cos).powi(2) / root.powi(3);
    let acceleration = -w * w * (cos + bend);
    let expected = [cos + root, velocity, -acceleration, 0.0];
    let found = last(&problem, &["x1", "Omega1", "lambda1", "lambda2"]);
    assert!(off(&found, &expected) < 1e-11, "{found:?} {expected:?}");
}

/// A disk that rolls and leans. The reference integrates the equations of Newton and Euler about the
/// centre. The force at the point of contact is eliminated from them. DOP853 of SciPy integrates them
/// with the tolerances 1e-12 and 3e-14, and the common digits of the two results are given. The data
/// of the first disk are the data of the test problem `rolling_disk` of S. Hante.
#[test]
fn a_rolling_disk_that_leans() {
    let disk = |keys: &str| {
        parse(&format!(
            r#"
space = "se3"
metric = "diag(A, A, C, m, m, m)"
constraints = ["z^2/2 - r^2*(1 - g33^2)/2"]
velocity_constraints = [
    "z*(g11*Omega4 + g12*Omega5 + g13*Omega6) - r^2*(omega2 - g33*(omega2*g33 - omega3*g23))",
    "z*(g21*Omega4 + g22*Omega5 + g23*Omega6) - r^2*(-omega1 - g33*(omega3*g13 - omega1*g33))",
]
forces.potential = "m*9.81*z"
integrator.tolerance = 1e-13
{keys}
"#
        ))
    };
    let names = ["x", "y", "z", "Omega1", "Omega2", "Omega3"];
    let upright = disk(
        "parameters = { m = 15, r = 1, A = 3.75, C = 7.5 }\noutput = { end = 2, every = 1 }\n\
         [initial]\nelement = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 1], [0, 0, 0, 1]]\n\
         velocity = [0, 15, 5, -5, 0, 0]\n",
    );
    let expected =
        [0.88976451932, -5.41445916605, 0.99999999868, 11.4319061328, 9.7110945384, 4.99948617927];
    let found = last(&upright, &names);
    assert!(off(&found, &expected) < 1e-10, "{found:?}");
    Run::new(&upright, 0).keeps(&["energy"], 1e-11);
    // the axis of the second disk is inclined: g33 = sin(0.4). In axes of the disk, the point of
    // contact is c = (0, -r, 0), and the velocity of the disk is c x omega
    let leaning = disk(
        "parameters = { m = 2, r = 0.3, A = 0.05, C = 0.09 }\noutput = { end = 1.5, every = 0.5 }\n\
         [initial]\nvelocity = [0.3, 1, 8, \"-0.3*8\", 0, \"0.3*0.3\"]\n\
         element = [[1, 0, 0, 0.1], [0, \"sin(0.4)\", \"-cos(0.4)\", -0.2], \
         [0, \"cos(0.4)\", \"sin(0.4)\", \"0.3*cos(0.4)\"], [0, 0, 0, 1]]\n",
    );
    let expected = [
        -0.820274657010,
        2.37823819428,
        0.254402422237,
        -0.84267786702,
        -2.09531018394,
        8.01394310546,
    ];
    let found = last(&leaning, &names);
    assert!(off(&found, &expected) < 1e-10, "{found:?}");
}

const BODY: &str = "space = \"so3\"\nmetric = \"diag(1, 2, 3)\"\noutput.end = 1\n";

#[test]
fn bad_constraints_are_refused_with_their_place() {
    let with = |keys: &str| refused(&format!("{keys}\n{BODY}"));
    let velocity = "initial.velocity = [1, 2, 0]";
    let at =
        |constraint: &str| with(&format!("velocity_constraints = [\"{constraint}\"]\n{velocity}"));
    assert!(at("Omega3 + Omega1*Omega2").contains("a product of velocities"));
    assert!(at("sin(Omega3)").contains("a function of a velocity"));
    assert!(at("1/Omega3").contains("a quotient by a velocity"));
    assert!(at("g11").contains("does not contain the velocity"));
    assert!(at("Omega3 + H1").contains("`H1` is not a known name"));
    assert!(with(&format!("velocity_constraints = []\n{velocity}")).contains("is empty"));
    let off = at("Omega1 - Omega3");
    assert!(off.contains("constraint 1 on the velocity has the value 1, not 0"), "{off}");
    // (1, 2, 0) - J^-1 A/(A J^-1 A) = (1, 2, 0) - (1, 0, -1/3)/(4/3)
    let nearest = off.split('[').nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    let nearest: Vec<f64> = nearest.split(", ").map(|x| x.parse().unwrap()).collect();
    assert!(super::off(&nearest, &[0.25, 2.0, 0.25]) < 1e-15, "{off}");
    let twice = with(&format!("velocity_constraints = [\"Omega3\", \"2*Omega3\"]\n{velocity}"));
    assert!(twice.contains("constraint 2 is dependent"), "{twice}");
    let moving = with("constraints = [\"t + g12\"]\ninitial.velocity = [0, 0, 0]\n");
    assert!(moving.contains("constraint 1 changes at the rate 1"), "{moving}");
}
