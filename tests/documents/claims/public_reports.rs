//! Definitions that users reported, with the values that they expect.
//!
//! Guards `Definition`, `Computation` and `Info`.

use super::statement::{self, LineElement, file};
use affinor_documents::report::{Computation, Format, Info, Quantity, Report, Selection};
use affinor_documents::space::{Request, ScalarChoice, Space};
use serde_json::Value;

const FOLDER: &str = "tests/data/public_reports";

/// A definition of `tests/data/public_reports/` and a claim about it, in the notation of [`statement`].
#[rustfmt::skip]
const CLAIMS: &[(&str, &str)] = &[
    ("static_star", "ricci[1,1] = exp(2*Phi(r) - 2*Lambda(r))*(Phi_r_r(r) + Phi_r(r)^2 - Phi_r(r)*Lambda_r(r) + 2*Phi_r(r)/r)"),
    ("static_star", "ricci[2,2] = -Phi_r_r(r) - Phi_r(r)^2 + Phi_r(r)*Lambda_r(r) + 2*Lambda_r(r)/r"),
    ("static_star", "ricci[3,3] = exp(-2*Lambda(r))*(r*Lambda_r(r) - r*Phi_r(r) - 1) + 1"),
    ("static_star", "ricci[4,4] = sin(theta)^2*(exp(-2*Lambda(r))*(r*Lambda_r(r) - r*Phi_r(r) - 1) + 1)"),
    ("hedgehog", "ricci[1,1] = sin(2*alpha(r))*(-2*r^2*alpha_r_r(r) + 2*r*alpha_r(r) + sin(4*alpha(r))/2)/(2*r^2)"),
    ("hedgehog", "ricci[1,2] = cos(2*alpha(r))*(2*r^2*alpha_r_r(r) + 2*r*alpha_r(r) - sin(4*alpha(r))/2)/(2*r)"),
    ("hedgehog", "ricci[2,2] = sin(2*alpha(r))*(2*r^2*alpha_r_r(r) + 6*r*alpha_r(r) - sin(4*alpha(r))/2)/2"),
    ("hedgehog", "ricci[3,3] = 2*alpha_r(r)^2 + sin(2*alpha(r))^2/(2*r^2)"),
    ("weyl_static", "ricci[1,1] = exp(4*U(rho,z) - 2*k(rho,z))*(U_rho_rho(rho,z) + U_z_z(rho,z) + U_rho(rho,z)/rho)"),
    ("weyl_static", "ricci[2,3] = k_z(rho,z)/rho - 2*U_rho(rho,z)*U_z(rho,z)"),
    ("lemaitre", "ricci = 0"),
    ("kasner_symbolic", "ricci[1,1] = (p + q + s - p^2 - q^2 - s^2)/t^2"),
    ("kasner_symbolic", "ricci[2,2] = p*(p + q + s - 1)*t^(2*p - 2)"),
    ("kasner_symbolic", "ricci[3,3] = q*(p + q + s - 1)*t^(2*q - 2)"),
    ("kasner_symbolic", "ricci[4,4] = s*(p + q + s - 1)*t^(2*s - 2)"),
    ("ads_radius", "ricci[1,1] = -1/L^2"),
    ("ads_radius", "ricci[2,2] = -exp(2*z/L)/L^2"),
    ("ads_radius", "scalar_curvature = -2/L^2"),
    ("exp_fifth", "scalar_curvature = 12*H^2"),
    ("self_similar", "affinities[1,1,1] = A_r(r/t)/(2*t*A(r/t))"),
    ("self_similar", "affinities[4,1,1] = -r*A_r(r/t)/(2*t^2)"),
    ("self_similar", "ricci[1,4] = -A_r(r/t)/(t^2*A(r/t))"),
    ("greek_names", "ricci = 0"),
    ("greek_names", "curvature[1,2,1,2] = rs/(r^2*(r - rs))"),
    ("hyperbolic_text", "ricci[3,3] = sinh(theta)^2*(A_t(t)*(A(t)*W_t(t) + A_t(t)*W(t)) + W(t)*(A(t)*A_t_t(t) - 1))/W(t)"),
    ("sum_of_positives", "metric[2,2] = sqrt(r + 2*M)*sqrt(r - 2*M)"),
    ("sum_of_positives", "scalar_curvature = (r^2 + 8*M^2)/(2*(r^2 - 4*M^2)^2)"),
    ("kruskal", "ricci = 0"),
    ("sphere_ten", "sectional = 1"),
    ("sphere_ten", "scalar_curvature = 90"),
    ("einstein_rosen", "ricci[3,3] = exp(4*psi(t,rho) - 2*g(t,rho))*(psi_t_t(t,rho) - psi_rho_rho(t,rho) - psi_rho(t,rho)/rho)"),
    ("einstein_rosen", "ricci[1,2] = g_t(t,rho)/rho - 2*psi_t(t,rho)*psi_rho(t,rho)"),
    ("exp_constant", "ricci = 0"),
];

#[test]
fn reported_charts_have_the_expected_values() {
    statement::assert_all(FOLDER, CLAIMS);
}

fn space(text: String, set: Option<&str>) -> Space {
    let definition = Some(("reported.toml".into(), text));
    let set = set.map(str::to_string);
    Space::open(&Request { definition, set, ..Request::default() }).unwrap()
}

/// A table as text in a format.
fn table(space: &Space, show: &str, format: Format) -> String {
    let selection = Selection { quantities: Quantity::list(show).unwrap(), ..Selection::default() };
    let mut text = vec![];
    let tabulated = Computation::of(space).table(&selection).unwrap();
    tabulated.report.write(format, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

/// The Hubble constant may be any number, and arguments may have any coefficients.
#[test]
fn arguments_have_any_coefficients() {
    let text = file(FOLDER, "exp_fifth");
    for (set, expected) in [("H=1/5", "S = 12/25"), ("H=0.07", "S = 147/2500")] {
        let shown = table(&space(text.clone(), Some(set)), "scalar_curvature", Format::Text);
        assert!(shown.contains(expected), "{set}: {shown}");
    }
    let plain = text.replace("parameters = [\"H\"]\n", "").replace("2*H*t", "t/5");
    let shown = table(&space(plain, None), "scalar_curvature", Format::Text);
    assert!(shown.contains("S = 3/25"), "{shown}");
    // diag(1, f^2) has S = -2 f''/f
    for (f, expected) in [("sin(0.1*t)", "1/50"), ("sin(20*t)", "800"), ("cosh(0.1*t)", "-1/50")] {
        let text = format!(
            "[chart]\ncoordinates = [\"t\", \"x\"]\n[metric]\ncomponents = \"diag(1, {f}^2)\"\n"
        );
        let claim = format!("scalar_curvature = {expected}");
        assert_eq!(LineElement::read(&text).unwrap().holds(&claim), Ok(true), "{f}");
    }
}

/// The gamma metric is a vacuum solution for two values of its exponent, which `--set` gives.
#[test]
fn exponents_are_set() {
    let space = space(file(FOLDER, "gamma_metric"), Some("delta=gamma^2-1,epsilon=gamma^2"));
    let shown = table(&space, "ricci", Format::Text);
    assert!(shown.contains("Ric_jl = 0"), "{shown}");
}

#[test]
fn hyperbolic_functions_are_printed_as_such() {
    let space = space(file(FOLDER, "hyperbolic_text"), None);
    let shown = table(&space, "metric,ricci", Format::Text);
    assert!(shown.contains("sinh(theta)^2") && !shown.contains("exp("), "{shown}");
}

/// A function `d` has the derivative `d_x`, which is also the coordinate field of `x`.
#[test]
fn a_function_with_the_name_of_the_coordinate_fields_is_read_or_explained() {
    let definition = Some(("reported.toml".into(), file(FOLDER, "function_d")));
    if let Err(error) = Space::open(&Request { definition, ..Request::default() }) {
        assert!(error.to_string().contains("coordinate field"), "{error}");
    }
}

/// Gell-Mann's basis of su(3) has structure constants with the root of 3.
#[test]
fn su3_in_the_basis_of_gell_mann() {
    let space = space(file(FOLDER, "su3_gell_mann"), None);
    let info = Info::of(&space.definition, &|_| {}).unwrap();
    let mut text = vec![];
    info.write(Format::Json, &mut text).unwrap();
    let info: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(info["dimension"], 8);
    assert_eq!(info["simple"], true);
    assert_eq!(info["dynkin_type"], "A2");
    let killing = table(&space, "killing", Format::Csv);
    let rows: Vec<&str> = killing.lines().skip(1).collect();
    let expected: Vec<String> = (1..=8).map(|i| format!("killing,{i},{i},,,-3")).collect();
    assert_eq!(rows, expected);
    let computation = Computation { scalar: ScalarChoice::Float, ..Computation::of(&space) };
    let checks = computation.checks().unwrap();
    assert!(checks.iter().all(|check| check.ok));
}
