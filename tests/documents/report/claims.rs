//! The paper's claims hold for the geometry that they are about. The report of a claim that fails
//! names the first such component with its value.

use affinor::Geometry;
use affinor::geometry::properties::Property;
use affinor_documents::report::Claim;
use affinor_documents::space::{Request, ScalarChoice, Space, paper};
use affinor_documents::{Coefficient, over_kind};
use affinor_tensors::Tolerance;

/// Whether a claim holds; `None` without a metric.
type Verdict = Option<Property<String>>;

/// The verdicts on a geometry, each compared with loops over its components.
fn verdicts_over<S: Coefficient>(space: &Space) -> Vec<(Claim, Verdict, Option<String>)> {
    let geometry = space.definition.geometry::<S>(Tolerance::default()).unwrap();
    let both = |claim: Claim| (claim, claim.holds(&geometry).unwrap(), by_loops(claim, &geometry));
    Claim::ALL.into_iter().map(both).collect()
}

fn verdicts(space: &str) -> Vec<(Claim, Verdict, Option<String>)> {
    of_request(&Request { space: Some(space.into()), ..Request::default() })
}

fn of_request(request: &Request) -> Vec<(Claim, Verdict, Option<String>)> {
    let space = Space::open(request).unwrap();
    over_kind!(space.kind(ScalarChoice::Exact).unwrap(), S => verdicts_over::<S>(&space))
}

/// The text of a failing verdict.
fn residual(space: &str, claim: Claim) -> String {
    let verdict = verdicts(space).into_iter().find(|(other, ..)| *other == claim).unwrap().1;
    match verdict {
        Some(Property::Fails(witness)) => witness.to_string(),
        other => panic!("{claim:?} of {space}: {other:?}"),
    }
}

/// The first component that is nonzero although a claim says it is zero, from sums by loops.
/// Returns the end of a residual, ` = value`; `None` if the claim holds or does not apply.
fn by_loops<S: Coefficient>(claim: Claim, geometry: &Geometry<S>) -> Option<String> {
    let n = geometry.frame().dimension();
    let c = |i, j, k| geometry.frame().structure_functions().get(&[i, j, k]);
    let gamma = |i, j, k| geometry.connection().affinities().get(&[i, j, k]);
    let g = |i, j| geometry.metric().unwrap().components().get(&[i, j]);
    let over = |term: &dyn Fn(usize) -> S| (0..n).map(term).fold(S::zero(), |sum, v| sum + &v);
    let torsion = |i, j, k| gamma(i, j, k) - &gamma(i, k, j) - &c(i, j, k);
    let curvature = |i, j, k, l| {
        over(&|m| {
            gamma(i, k, m) * &gamma(m, l, j)
                - &(gamma(i, l, m) * &gamma(m, k, j))
                - &(c(m, k, l) * &gamma(i, m, j))
        })
    };
    let ratio = |numerator, denominator| S::from_quotient(numerator, denominator).unwrap();
    let first = |rank: usize, component: &dyn Fn(&[usize]) -> S| {
        let digits = |at: usize| (0..rank).rev().map(move |slot| at / n.pow(slot as u32) % n);
        let components =
            (0..n.pow(rank as u32)).map(|at| component(&digits(at).collect::<Vec<_>>()));
        components.into_iter().find(|v| !v.vanishes()).map(|value| format!(" = {value}"))
    };
    // along n = e_j: nabla_n n should be zero, or Lambda^i_jk should be share c^i_jk
    let transport = |share: S| {
        (0..n).find_map(|j| {
            let bends = (0..n).any(|i| !gamma(i, j, j).vanishes());
            let label = &geometry.frame().labels()[j];
            let text =
                first(2, &|at: &[usize]| c(at[0], j, at[1]) * &share - &gamma(at[0], j, at[1]));
            match bends {
                true => Some(format!(" for n = {label}")),
                false => text.map(|text| format!("{text} for n = {label}")),
            }
        })
    };
    let nonmetricity = |k: usize, i: usize, j: usize| {
        -over(&|m| gamma(m, k, i) * &g(m, j) + &(gamma(m, k, j) * &g(i, m)))
    };
    match claim {
        Claim::AffinitiesAreStructure => {
            first(3, &|at| gamma(at[0], at[1], at[2]) - &c(at[0], at[1], at[2]))
        }
        Claim::TorsionIsStructure => {
            first(3, &|at| torsion(at[0], at[1], at[2]) - &c(at[0], at[1], at[2]))
        }
        Claim::Antisymmetric => {
            first(3, &|at| gamma(at[0], at[1], at[2]) + &gamma(at[0], at[2], at[1]))
        }
        Claim::StructureIsTwiceAffinities => {
            let two = ratio(2, 1);
            first(3, &|at| c(at[0], at[1], at[2]) - &(gamma(at[0], at[1], at[2]) * &two))
        }
        Claim::TorsionFree => first(3, &|at| torsion(at[0], at[1], at[2])),
        Claim::Flat => first(4, &|at| curvature(at[0], at[1], at[2], at[3])),
        Claim::CurvedByBracket => {
            let residual = first(4, &|at| {
                let bracket = over(&|m| c(m, at[2], at[3]) * &c(at[0], m, at[1]));
                curvature(at[0], at[1], at[2], at[3]) + &(bracket * &ratio(1, 4))
            });
            let flat = first(4, &|at| curvature(at[0], at[1], at[2], at[3])).is_none();
            residual.or(flat.then(|| " = 0".into()))
        }
        Claim::TransportByAd => transport(S::one()),
        Claim::TransportByHalfAd => transport(ratio(1, 2)),
        _ if geometry.metric().is_none() => None,
        Claim::Compatible => first(3, &|at| nonmetricity(at[0], at[1], at[2])),
        Claim::Incompatible => {
            let compatible = first(3, &|at| nonmetricity(at[0], at[1], at[2])).is_none();
            compatible.then(|| " = 0".into())
        }
        Claim::BiInvariant => first(3, &|at| {
            let [k, i, j] = [at[0], at[1], at[2]];
            over(&|m| g(m, j) * &c(m, k, i) + &(g(i, m) * &c(m, k, j)))
        }),
    }
}

#[test]
fn every_claim_holds_of_the_geometry_it_is_about_and_of_no_other() {
    let (m3, so3) = (paper::m3().unwrap(), paper::so3().unwrap());
    for claim in Claim::ALL {
        let holds = [
            claim.holds(&m3).unwrap() == Some(Property::Holds(())),
            claim.holds(&so3).unwrap() == Some(Property::Holds(())),
        ];
        let about = ["M(3)", "SO(3)"].map(|name| claim.about().contains(&name));
        assert_eq!(holds, about, "{claim:?}");
        assert!(!claim.equation().is_empty() && !claim.statement().is_empty());
    }
}

#[test]
fn claims_of_m3_and_so3_as_the_paper_makes_them() {
    // five claims about M(3), one about M(3) and "SO(3)", six about "SO(3)"
    let about: Vec<_> = Claim::ALL.into_iter().map(|claim| claim.about().join(" ")).collect();
    let expected = [["M(3)"; 5].as_slice(), &["M(3) SO(3)"], &["SO(3)"; 6]].concat();
    assert_eq!(about, expected);
}

#[test]
fn a_failing_claim_names_its_first_component() {
    let body = "so3@levi-civita;metric=diag(1,2,3)";
    let table = [
        (Claim::AffinitiesAreStructure, "SO3", "Lambda^1_23 - c^1_23 = -1/2"),
        (Claim::TorsionIsStructure, "SO3", "tau^1_23 - c^1_23 = -1"),
        (Claim::TorsionIsStructure, "so3@minus", "tau^1_23 - c^1_23 = -2"),
        (Claim::Flat, "SO3", "R^1_212 = 1/4"),
        // [H_2 is the third vector of sl(2)]: R(E,F)E = -1/4 [[E,F],E] = -1/2 E
        (Claim::Flat, "sl(2)@zero", "R^1_112 = -1/2"),
        // ad_e1 e3 = -e2, and G = -1/2 ad
        (Claim::TransportByAd, "SO3", "G^2_3 + ad^2_3 = -1/2 for n = e1"),
        (Claim::TransportByAd, "so3@minus", "G^2_3 + ad^2_3 = -1 for n = e1"),
        (Claim::Incompatible, "SO3", "(nabla_k g)_ij = 0"),
        // (J1 - J2 + J3)/(2 J1) + (-J1 - J2 + J3)/(2 J1)
        (Claim::Antisymmetric, body, "Lambda^1_23 + Lambda^1_32 = 1"),
        (Claim::StructureIsTwiceAffinities, "M3", "c^1_23 - 2 Lambda^1_23 = -1"),
        (Claim::TorsionFree, "M3", "tau^1_23 = 1"),
        (Claim::TorsionFree, "aff(1)@lambda=a", "tau^2_12 = 2*a - 1"),
        // c^3_12 c^1_32 = -1
        (Claim::CurvedByBracket, "M3", "R^1_212 + 1/4 c^m_12 c^1_m2 = -1/4"),
        // two-step nilpotent: the formula holds, but the curvature is zero
        (Claim::CurvedByBracket, "heisenberg3@zero", "R^i_jkl = 0"),
        (Claim::TransportByHalfAd, "M3", "G^2_3 + 1/2 ad^2_3 = 1/2 for n = e1"),
        (Claim::Compatible, "M3", "(nabla_1 g)_12 = -J13"),
        (Claim::BiInvariant, "M3", "g_m2 c^m_11 + g_1m c^m_12 = J13"),
        // eleven dimensions: x1 is the first, y1 the sixth, z = [x1, y1] the last
        (Claim::AffinitiesAreStructure, "heisenberg(11)@zero", "Lambda^11_1,6 - c^11_1,6 = -1/2"),
    ];
    for (claim, space, text) in table {
        assert_eq!(residual(space, claim), text, "{claim:?} of {space}");
    }
    for claim in Claim::ALL {
        assert!(table.iter().any(|(other, ..)| *other == claim), "{claim:?} fails nowhere");
    }
}

#[test]
fn a_direction_that_bends_away_is_named() {
    // the hyperbolic plane: nabla_y y = x
    let request = Request {
        basis: Some("y x".into()),
        brackets: vec!["[x,y]=y".into()],
        connection: Some("levi-civita".into()),
        metric: Some("identity".into()),
        ..Request::default()
    };
    for (claim, verdict, _) in of_request(&request) {
        if matches!(claim, Claim::TransportByAd | Claim::TransportByHalfAd) {
            match verdict {
                Some(Property::Fails(witness)) => {
                    assert_eq!(witness.to_string(), "nabla_n n = x for n = y");
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

#[test]
fn residuals_are_those_of_loops_over_the_components() {
    let algebras = ["so3", "sl(2)", "se(2)", "aff(1)", "heisenberg3", "se(3)", "aff(1)+R^1"];
    let connections = ["plus", "zero", "minus", "lambda=1/3", "lambda=a", "levi-civita"];
    let metrics = ["", ";metric=identity"];
    for space in algebras {
        for (connection, metric) in connections.iter().flat_map(|c| metrics.map(|m| (c, m))) {
            if (*connection, metric) == ("levi-civita", "") {
                continue;
            }
            let space = format!("{space}@{connection}{metric}");
            for (claim, verdict, expected) in verdicts(&space) {
                match (verdict, expected) {
                    (Some(Property::Fails(found)), Some(end)) => {
                        assert!(
                            found.to_string().ends_with(&end),
                            "{claim:?} of {space}: {found:?}, {end}"
                        );
                    }
                    (Some(Property::Holds(())), None) => {}
                    (None, None) => assert_eq!(metric, "", "{claim:?}"),
                    other => panic!("{claim:?} of {space}: {other:?}"),
                }
            }
        }
    }
}

#[test]
fn indices_of_a_residual_are_those_of_its_value() {
    // a connection with a single affinity: every claim that fails names its component
    let table = [
        ("nabla[e1,e2] = 5*e2", Claim::AffinitiesAreStructure, "Lambda^2_12 - c^2_12 = 4"),
        ("nabla[e1,e2] = 5*e2", Claim::TorsionFree, "tau^2_12 = 4"),
        ("nabla[e2,e1] = 7*e2", Claim::Antisymmetric, "Lambda^2_12 + Lambda^2_21 = 7"),
        // R^2_112 = -Lambda^2_2m Lambda^m_11 - c^2_12 Lambda^2_21 = -7
        ("nabla[e2,e1] = 7*e2", Claim::Flat, "R^2_112 = -7"),
        // (nabla_2 g)_12 = -Lambda^2_21 g_22
        ("nabla[e2,e1] = 7*e2", Claim::Compatible, "(nabla_2 g)_12 = -7"),
        // G^2_2 = -Lambda^2_12 = -5 and ad^2_2 = 1 along e1
        ("nabla[e1,e2] = 5*e2", Claim::TransportByAd, "G^2_2 + ad^2_2 = -4 for n = e1"),
    ];
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("one.toml");
    for (affinities, claim, text) in table {
        let definition = format!(
            "dimension = 2\nbrackets = \"[e1,e2] = e2\"\nmetric = \"identity\"\n\
             affinities = \"{affinities}\"\n"
        );
        std::fs::write(&path, definition).unwrap();
        assert_eq!(residual(path.to_str().unwrap(), claim), text, "{affinities}");
    }
}

#[test]
fn without_a_metric_its_claims_do_not_apply() {
    let about_metrics = [Claim::Incompatible, Claim::Compatible, Claim::BiInvariant];
    for (claim, verdict, _) in verdicts("so3@zero") {
        assert_eq!(verdict.is_some(), !about_metrics.contains(&claim), "{claim:?}");
    }
}
