//! Line elements of the literature have their published properties.
//!
//! The files are in `tests/data/line_elements/`, each with its source.
//!
//! Guards `Definition` over charts, and the tensors of `Quantity`.

use super::statement;
use crate::common::root;

/// Pairs of a line element and a claim about it, in the notation of [`statement`].
#[rustfmt::skip]
const CLAIMS: &[(&str, &str)] = &[
    ("weyl_static", "ricci = 0"),
    ("weyl_conditions", "ricci[1,1] = exp(4*U(rho,z) - 2*k(rho,z))*(U_rho_rho(rho,z) + U_z_z(rho,z) + U_rho(rho,z)/rho)"),
    ("weyl_conditions", "ricci[2,3] = k_z(rho,z)/rho - 2*U_rho(rho,z)*U_z(rho,z)"),
    ("curzon", "ricci = 0"),
    ("einstein_rosen", "ricci = 0"),
    ("kasner", "ricci[1,1] = (p + q + s - p^2 - q^2 - s^2)/t^2"),
    ("kasner", "ricci[2,2] = p*(p + q + s - 1)*t^(2*p - 2)"),
    ("kasner", "scalar_curvature = (p^2 + q^2 + s^2 + (p + q + s)^2 - 2*(p + q + s))/t^2"),
    ("kasner_vacuum", "ricci = 0"),
    ("kasner_vacuum", "kretschmann = 16*u^2*(1 + u)^2/((1 + u + u^2)^3*t^4)"),
    ("lemaitre", "ricci = 0"),
    ("lemaitre", "kretschmann = 64/(27*(rho - tau)^4)"),
    ("kruskal", "ricci = 0"),
    ("kruskal", "kretschmann = 48*m^2/r(u,v)^6"),
    ("static_star", "einstein[1,1] = 2*m_r(r)*exp(2*Phi(r))/r^2"),
    ("static_star", "einstein[2,2] = 2*Phi_r(r)/r - 2*m(r)/(r^2*(r - 2*m(r)))"),
    ("oppenheimer_volkoff", "einstein[1,1] = 8*pi*rho(r)*exp(2*Phi(r))"),
    ("oppenheimer_volkoff", "einstein[2,2] = 8*pi*P(r)/(1 - 2*m(r)/r)"),
    ("oppenheimer_volkoff", "einstein[3,3] = 8*pi*P(r)*r^2"),
    ("vaidya", "ricci[1,1] = 2*m*sech(v/L)^2/(L*r^2)"),
    ("vaidya", "scalar_curvature = 0"),
    ("vaidya_function", "ricci[1,1] = 2*M_v(v - w)/r^2"),
    ("vaidya_function", "kretschmann = 48*M(v - w)^2/r^6"),
    ("alcubierre", "einstein(1, X_t(t)*f(sqrt((x - X(t))^2 + y^2 + z^2)), 0, 0) = -X_t(t)^2*(y^2 + z^2)*f_x(sqrt((x - X(t))^2 + y^2 + z^2))^2/(4*((x - X(t))^2 + y^2 + z^2))"),
    ("tolman_bondi", "einstein[1,1] = 2*M_r(r)/(R(t,r)^2*R_r(t,r))"),
    ("tolman_bondi", "einstein[2,2] = 0"),
    ("tolman_bondi", "einstein[3,3] = 0"),
    ("tolman_bondi_flat", "einstein[2,2] = 0"),
    ("tolman_bondi_flat", "einstein[3,3] = 0"),
    ("tolman_bondi_flat", "einstein[1,1] = 4/((t - b(r))*(3*(t - b(r)) - 2*r*b_r(r)))"),
    ("szekeres", "einstein[2,2] = 0"),
    ("szekeres", "einstein[3,3] = 0"),
    ("szekeres", "einstein[2,3] = 0"),
    ("szekeres", "einstein[1,3] = 0"),
    ("brinkmann", "ricci = 0"),
    ("brinkmann", "kretschmann = 0"),
    ("brinkmann", "curvature[2,3,1,3] = -1/2*H_x_x(u,x,y)"),
    ("plane_wave_pulse", "ricci = 0"),
    ("plane_wave_pulse", "curvature[2,3,1,4] = exp(-u^2/L^2)"),
    ("rosen", "ricci = 0"),
    ("khan_penrose", "ricci = 0"),
    ("bonnor_dust", "einstein[2,2] = 0"),
    ("bonnor_dust", "einstein[2,3] = 0"),
    ("bonnor_dust", "einstein[1,1] = 4*h^2*(r^2 + 4*z^2)/(r^2 + z^2)^4*exp(-h^2*r^2*(r^2 - 8*z^2)/(2*(r^2 + z^2)^4))"),
    ("van_stockum", "einstein[1,1] = 4*a^2*exp(a^2*r^2)"),
    ("van_stockum", "einstein[2,2] = 0"),
    ("van_stockum", "scalar_curvature = 4*a^2*exp(a^2*r^2)"),
    ("friedmann_conformal", "weyl = 0"),
    ("friedmann_conformal", "einstein[2,2] = 0"),
    ("friedmann_conformal", "scalar_curvature = 6/(A^2*(1 - cos(eta))^3)"),
    ("conformal_factor", "weyl = 0"),
    ("conformal_factor", "einstein[1,1] = 3*a_eta(eta)^2 - 3"),
    ("einstein_de_sitter", "einstein[1,1] = 4/(3*t^2)"),
    ("einstein_de_sitter", "einstein[2,2] = 0"),
    ("einstein_de_sitter", "weyl = 0"),
    ("radiation_universe", "scalar_curvature = 0"),
    ("radiation_universe", "weyl = 0"),
    ("radiation_universe", "einstein[1,1] = 3*B/(t^2 + 2*sqrt(B)*t)^2"),
    ("power_law", "scalar_curvature = 6*p*(2*p - 1)/t^2"),
    ("power_law", "weyl = 0"),
    ("de_sitter_flat", "sectional = 1/L^2"),
    ("de_sitter_closed", "sectional = 1/L^2"),
    ("de_sitter_open", "sectional = 1/L^2"),
    ("anti_de_sitter_global", "sectional = -1/L^2"),
    ("anti_de_sitter_global", "ricci = -3/L^2*metric"),
    ("anti_de_sitter_poincare", "sectional = -1/L^2"),
    ("rindler", "curvature = 0"),
    ("rindler", "affinities[2,1,1] = 1/L"),
    ("goedel", "scalar_curvature = -1/a^2"),
    ("goedel", "einstein[4,4] = 2"),
    ("goedel", "ricci[1,1] = 4"),
    ("nariai", "ricci = Lambda*metric"),
    ("nariai", "kretschmann = 8*Lambda^2"),
    ("bertotti_robinson", "weyl = 0"),
    ("bertotti_robinson", "scalar_curvature = 0"),
    ("bertotti_robinson", "kretschmann = 8/b^4"),
    ("levi_civita", "ricci = 0"),
    ("levi_civita", "kretschmann = 64*sigma^2*(2*sigma - 1)^2*(4*sigma^2 - 2*sigma + 1)*r^(8*sigma - 16*sigma^2 - 4)"),
    ("taub", "ricci = 0"),
    ("taub", "kretschmann = 3/(4*z^3)"),
    ("taub_nut", "ricci = 0"),
    ("kantowski_sachs", "einstein[1,1] = beta_t(t)^2 + 2*alpha_t(t)*beta_t(t) + exp(-2*beta(t))"),
    ("kantowski_sachs", "ricci[1,1] = -alpha_t_t(t) - 2*beta_t_t(t) - alpha_t(t)^2 - 2*beta_t(t)^2"),
    ("bianchi_i", "einstein[1,1] = 3*(a_t(t)^2 - b_t(t)^2 - c_t(t)^2)"),
    ("bianchi_v", "ricci[1,2] = 2*a_t(t) - b_t(t) - c_t(t)"),
    ("bianchi_v", "ricci[1,1] = -a_t_t(t) - b_t_t(t) - c_t_t(t) - a_t(t)^2 - b_t(t)^2 - c_t(t)^2"),
    ("mixmaster", "ricci[1,1] = -a_t_t(t) - b_t_t(t) - c_t_t(t) - a_t(t)^2 - b_t(t)^2 - c_t(t)^2"),
    ("mixmaster", "ricci[4,4] = exp(2*c(t))*(c_t_t(t) + c_t(t)*(a_t(t) + b_t(t) + c_t(t))) + (exp(4*c(t)) - (exp(2*a(t)) - exp(2*b(t)))^2)/(2*exp(2*a(t) + 2*b(t)))"),
    ("milne", "curvature = 0"),
    ("c_metric", "ricci = 0"),
    ("reissner_nordstroem_isotropic", "scalar_curvature = 0"),
    ("reissner_nordstroem_isotropic", "ricci[3,3] = Q^2/(r^2*((1 + M/(2*r))^2 - Q^2/(4*r^2))^2)"),
    ("majumdar_papapetrou", "scalar_curvature = 0"),
    ("majumdar_papapetrou", "einstein[1,1] = (U_x(x,y,z)^2 + U_y(x,y,z)^2 + U_z(x,y,z)^2)/U(x,y,z)^6"),
    ("extreme_pair", "scalar_curvature = 0"),
    ("morris_thorne", "einstein[1,1] = b_r(r)*exp(2*Phi(r))/r^2"),
    ("morris_thorne", "einstein[2,2] = 2*Phi_r(r)/r - b(r)/(r^2*(r - b(r)))"),
    ("ellis", "scalar_curvature = -2/(k^2*cosh(x)^4)"),
    ("ellis", "ricci[2,2] = -2/cosh(x)^2"),
    ("btz", "sectional = -1/L^2"),
    ("btz_proper", "sectional = -1/L^2"),
    ("stephani", "weyl = 0"),
    ("stephani", "einstein[1,2] = 0"),
    ("mcvittie", "einstein[1,2] = 0"),
    ("mcvittie", "einstein[1,1] = 3*b_t(t)^2*((2*r*exp(b(t)) - m)/(2*r*exp(b(t)) + m))^2"),
    ("gross_perry", "ricci = 0"),
    ("kasner_anti_de_sitter", "ricci = -4/L^2*metric"),
    ("painleve_gullstrand", "ricci = 0"),
    ("painleve_gullstrand", "kretschmann = 48*M^2/r^6"),
    ("eddington_finkelstein", "ricci = 0"),
    ("eddington_finkelstein", "kretschmann = 48*M^2*exp(-6*x)"),
    ("schwarzschild_isotropic", "ricci = 0"),
    ("schwarzschild_isotropic", "kretschmann = 48*M^2/(sqrt(x^2 + y^2 + z^2) + M + M^2/(4*sqrt(x^2 + y^2 + z^2)))^6"),
    ("tortoise", "ricci = 0"),
    ("tortoise", "affinities[1,1,2] = M/r(x)^2"),
    ("witten", "scalar_curvature = 4/(L^2*cosh(r/L)^2)"),
    ("lifshitz", "scalar_curvature = -2*(w^2 + 2*w + 3)/L^2"),
    ("lifshitz", "ricci[1,1] = w*(w + 2)*r^(2*w)"),
    ("kiselev", "scalar_curvature = 3*c*w*(3*w - 1)*r^(-3*w - 3)"),
    ("kiselev", "einstein[3,3] = -3/2*c*w*(3*w + 1)*r^(-3*w - 1)"),
    ("janis_newman_winicour", "ricci[1,1] = 0"),
    ("janis_newman_winicour", "ricci[2,2] = b^2*(1 - g^2)/(2*r^2*(r - b)^2)"),
    ("janis_newman_winicour", "scalar_curvature = b^2*(1 - g^2)*(1 - b/r)^(g - 2)/(2*r^4)"),
    ("bardeen", "einstein[1,1] = 6*M*q^2/(r^2 + q^2)^(5/2)*(1 - 2*M*r^2/(r^2 + q^2)^(3/2))"),
    ("dymnikova", "einstein[1,1] = 6*M/a^3*exp(-r^3/a^3)*(1 - 2*M/r*(1 - exp(-r^3/a^3)))"),
    ("self_similar", "ricci[1,2] = -2*B_r(r/t)/t^2"),
    ("liouville", "scalar_curvature = -2*exp(-2*f(x,y))*(f_x_x(x,y) + f_y_y(x,y))"),
    ("liouville_equation", "sectional = K"),
    ("catenoid", "sectional = -1/(a^2*cosh(v/a)^4)"),
    ("sine_gordon", "sectional = -1"),
    ("surface_of_revolution", "sectional = alpha_s(s)*sin(alpha(s))/f(s)"),
];

/// The same of the files of `examples/definitions/`, which say their sources: C. W. Misner, K. S. Thorne, J. A. Wheeler,
/// *Gravitation* (1973), (31.7); K. Martel, E. Poisson, *Am. J. Phys.* 69 (2001) 476; R. C. Henry, *Astrophys. J.* 535 (2000) 350;
/// S. Weinberg, *Gravitation and Cosmology* (1972), (15.1.18)-(15.1.20).
#[rustfmt::skip]
const EXAMPLES: &[(&str, &str)] = &[
    ("sphere", "sectional = 1/a^2"),
    ("schwarzschild", "ricci = 0"),
    ("schwarzschild", "kretschmann = 48*M^2/r^6"),
    ("schwarzschild", "curvature[1,2,1,2] = 2*M/(r^2*(r - 2*M))"),
    ("schwarzschild", "affinities[2,1,1] = M*(r - 2*M)/r^3"),
    ("schwarzschild", "affinities[2,2,2] = -M/(r*(r - 2*M))"),
    ("schwarzschild", "affinities[2,3,3] = 2*M - r"),
    ("schwarzschild", "affinities[3,4,4] = -sin(theta)*cos(theta)"),
    ("expanding_universe", "ricci[1,1] = -3*a_t_t(t)/a(t)"),
    ("expanding_universe", "ricci[3,3] = r^2*(a(t)*a_t_t(t) + 2*a_t(t)^2 + 2*k)"),
    ("expanding_universe", "ricci[1,2] = 0"),
    ("expanding_universe", "scalar_curvature = 6*(a(t)*a_t_t(t) + a_t(t)^2 + k)/a(t)^2"),
];

#[rustfmt::skip]
const CHARTS: &[(&str, &str)] = &[
    ("hyperbolic-space", "sectional = -1/R^2"),
    ("3-sphere", "sectional = 1/R^2"),
    ("petrov", "ricci = 0"),
    ("kerr", "ricci = 0"),
    ("kerr", "kretschmann = 48*M^2*(r^2 - a^2*cos(theta)^2)*((r^2 + a^2*cos(theta)^2)^2 - 16*r^2*a^2*cos(theta)^2)/(r^2 + a^2*cos(theta)^2)^6"),
];

#[test]
fn line_elements_have_their_published_properties() {
    statement::assert_all("tests/data/line_elements", CLAIMS);
    statement::assert_all("examples/definitions", EXAMPLES);
    statement::assert_all("documents/charts", CHARTS);
    // in moving frames, which the Python reference does not read
    let observer = "schwarzschild-observers";
    let framed = [
        (observer, "ricci = 0"),
        (observer, "kretschmann = 48*M^2/r^6"),
        (observer, "affinities[2,1,1] = M/r^2/sqrt(r - 2*M)*sqrt(r)"),
    ];
    statement::assert_all("examples/definitions", &[("hyperbolic_plane", "sectional = -1")]);
    statement::assert_all("documents/charts", &framed);
}

/// Every file has a claim.
#[test]
fn every_line_element_is_tested() {
    for entry in std::fs::read_dir(root().join("tests/data/line_elements")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let stem = name.strip_suffix(".toml").unwrap();
        assert!(CLAIMS.iter().any(|(other, _)| *other == stem), "{name}");
    }
}
