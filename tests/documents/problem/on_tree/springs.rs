//! Springs and dampers between points, and stiff ones at joints: closed forms, and two methods.

use super::constraints::example;
use super::{GROUND, expect_close, last, single};
use affinor_documents::input::InputError;
use affinor_documents::problem::Problem;

/// Two masses on a line with a spring between them: the distance oscillates about its rest length.
#[test]
fn springs_connect_points() -> Result<(), InputError> {
    let part = |mass: f64, x: f64| {
        format!(
            "inertia.parts = [{{ shape = \"ball\", radius = 0.1, mass = {mass}, position = [{x}, 0, 0] }}]"
        )
    };
    let slide = "type = \"prismatic\", axis = [1, 0, 0]";
    let text = format!(
        "bodies = [{GROUND}, {{ name = \"a\", {} }}, {{ name = \"b\", {} }}]\njoints = [\
         {{ name = \"a\", bodies = [\"ground\", \"a\"], {slide} }}, {{ name = \"b\", bodies = [\"ground\", \"b\"], \
         {slide}, rate = 0.6 }}]\nsprings = [{{ bodies = [\"a\", \"b\"], from = [0, 0, 0], to = [2, 0, 0], \
         stiffness = 9, length = 1.5, damping = 0.4 }}]\nintegrator.tolerance = 1e-12\n\
         output = {{ end = 1, every = 1 }}\n",
        part(1.0, 0.0),
        part(3.0, 2.0)
    );
    let t = 1.3;
    let reduced = 0.75_f64;
    let (decay, square) = (0.4 / (2.0 * reduced), 9.0 / reduced);
    let w = (square - decay * decay).sqrt();
    let (a, b) = (0.5, (0.6 + decay * 0.5) / w);
    let stretch = (-decay * t).exp() * (a * (w * t).cos() + b * (w * t).sin());
    let found = last(&text, t, &["q_a", "q_b", "v_a", "v_b", "potential", "power"])?;
    let centre = 3.0 * 0.6 * t;
    expect_close(
        &[found[1] - found[0], found[0] + 3.0 * found[1]],
        &[stretch - 0.5, centre],
        1e-10,
    );
    expect_close(&[found[4]], &[4.5 * stretch * stretch], 1e-10);
    expect_close(&[found[5]], &[-0.4 * (found[3] - found[2]).powi(2)], 1e-10);
    Ok(())
}

/// An overdamped mass on a stiff spring: `x'' = -1e6 x' - 1e8 x`, whose slow solution is known. The
/// implicit method needs few steps, because it damps the fast one.
#[test]
fn stiff_dampers_need_few_implicit_steps() -> Result<(), InputError> {
    let joint = "name = \"slide\", type = \"prismatic\", axis = [1, 0, 0], coordinate = 1, stiffness = 2e8, \
                 damping = 2e6";
    let text = single("integrator.method = \"radau5\"", joint);
    let problem = Problem::parse("stiff.toml", &text)?.with_columns(&["q_slide", "v_slide"]);
    let t = 0.02;
    let mut ready = problem.at_times(&[t]).motion(0)?;
    while !ready.motion.step(t)? {}
    let root = (1e12 - 4e8_f64).sqrt();
    let [slow, fast] = [2e8 / (-1e6 - root), (-1e6 - root) / 2.0];
    let share = fast / (fast - slow);
    let place = share * (slow * t).exp();
    expect_close(&ready.motion.row(), &[place, slow * place], 1e-8);
    assert!(ready.motion.steps() < 2000, "{}", ready.motion.steps());
    Ok(())
}

/// The implicit and the explicit method agree on a closed loop with a point spring.
#[test]
fn implicit_and_explicit_steps_agree() -> Result<(), InputError> {
    let spring = "[[springs]]\nbodies = [\"ground\", \"rod\"]\nfrom = [0.2, 0.6, 0]\nto = [0.1, \"r\", 0]\n\
                  stiffness = 40\ndamping = 0.5\n[integrator]\n";
    let text = example("slider_crank", 1e-10).replace("[integrator]\n", spring);
    let columns = ["q_main_bearing", "v_guide", "r4_crank_pin", "energy"];
    let explicit = last(&text, 0.3, &columns)?;
    let implicit = text.replace("[integrator]\n", "[integrator]\nmethod = \"radau5\"\n");
    expect_close(&last(&implicit, 0.3, &columns)?, &explicit, 1e-6);
    Ok(())
}
