"""The mutants of `decisions.py`: by file the tests that should see them, and texts with their mutants.

A site occurs once in its file. It is an expression, or a statement if it ends as one. A filter names tests of the
program `affinor`, `lib:` begins one of unit tests and `documents:` one of that program. A mutant with a reason is
equivalent, or only weakens a certificate or a search whose result stays the same.
"""

MECHANICS = {
    "src/mechanics/events.rs": ("mechanics::events", [
        ("before != 0.0 && (after == 0.0 || (before < 0.0) != (after < 0.0))",
         "before != 0.0 && (before < 0.0) != (after < 0.0)"),
        ("before != 0.0 && (after == 0.0 || (before < 0.0) != (after < 0.0))",
         "after == 0.0 || (before < 0.0) != (after < 0.0)"),
        ("(before < 0.0) == (length > 0.0)", "before < 0.0"),
        ("a.0.abs().total_cmp(&b.0.abs())", "a.0.total_cmp(&b.0)"),
        ("(behind == 0.0 || !grows).then_some(b)", "Some(b)"),
        ("behind == 0.0 || !(at.is_finite() && at != a && at != b)", "!(at.is_finite() && at != a && at != b)",
         "the bracket ends at the same zero, and the points stay within the number of evaluations allowed"),
        ("f64::EPSILON * start.abs().max((start + end).abs())", "1e-6 * start.abs().max((start + end).abs())"),
        ("allowed *= 0.5;", "allowed *= 0.9;"),
        ("value.is_nan()", "false"),
    ]),
    "src/mechanics/integrators/adaptive.rs": ("mechanics::integrators", [
        ("0.9 * error.powf(-self.exponent())", "0.9 * error.powf(self.exponent())"),
        ("1.0 / f64::from(self.pair.order())", "0.5 / f64::from(self.pair.order())"),
        ("!last && h.abs() < LEAST_STEP * state.time.abs()", "false"),
        ("error <= 1.0", "error <= 10.0"),
        ("if last { end } else { reached.time }", "reached.time"),
        ("steps == self.max_steps", "steps > self.max_steps"),
        ("guess.min(self.max_step)", "guess"),
    ]),
    "src/mechanics/integrators/tolerance.rs": ("mechanics::integrators lib:mechanics::integrators", [
        ("self.relative * lengths[part] / LONG", "self.relative * lengths[part]"),
        ("coordinates[i] / span", "coordinates[i]"),
    ]),
    "src/mechanics/integrators/moser_veselov.rs": ("mechanics::integrators mechanics::bodies", [
        ("Vector3::new(j2 - j3, j3 - j1, j1 - j2)", "Vector3::new(j2 - j3, j1 - j3, j1 - j2)"),
        ("(9.0 * det * p(-1) + det * q(1, 2) - 11.0 * p(2))", "(9.0 * det * p(-1) + det * q(1, 2) - 10.0 * p(2))"),
        ("(165.0 * p(1) - det * q(1, 3) - 9.0 * q(2, 1) - 145.0 * det * p(-2))",
         "(165.0 * p(1) - det * q(1, 3) - 9.0 * q(2, 1) - 144.0 * det * p(-2))"),
        ("NEWTON * NEWTON * c.norm_squared()", "1e-2 * c.norm_squared()"),
        ("-c.norm_squared() / (1.0 + length)", "-c.norm_squared() / (2.0 * length)"),
    ]),
    "src/mechanics/integrators/generalised_alpha.rs": ("generalised_alpha mechanics::systems::constrained", [
        ("0.25 * (gamma + 0.5).powi(2)", "0.3 * (gamma + 0.5).powi(2)"),
        ("0.5 + alpha_f - alpha_m", "0.5 - alpha_f + alpha_m"),
        ("(2.0 * rho - 1.0) / (rho + 1.0)", "(2.0 * rho - 1.5) / (rho + 1.0)"),
        ("system.group().bracket(v, a) * (1.0 / 12.0)", "system.group().bracket(v, a) * (-1.0 / 12.0)"),
        ("Some(jerk * self.lead())", "Some(jerk * 0.0)"),
        ("size <= f64::EPSILON * acceleration.largest()", "size <= 1e-6 * acceleration.largest()"),
        ("(near * 4.0 - far) * (0.5 / s)", "near * (1.0 / s)"),
    ]),
    "src/mechanics/integrators/simo_wong.rs": ("mechanics::integrators", [
        ("state.time + 0.5 * h", "state.time"),
        ("size <= f64::EPSILON * length || (size >= last && size <= ROUNDING * length)", "size <= 1e-3 * length"),
    ]),
    "src/mechanics/integrators/kick.rs": ("mechanics::integrators", [
        ("time += share * h;", "time += 0.0;"),
        ("0.5 - a[0] - a[1]", "0.5 - a[0] + a[1]"),
    ]),
    "src/mechanics/integrators/munthe_kaas.rs": ("mechanics::integrators", [
        ("velocity + once * 0.5 + twice * (1.0 / 12.0)", "velocity + once * 0.5"),
        ("order > 4", "order > 5"),
    ]),
    "src/mechanics/integrators/step_start.rs": ("mechanics::integrators mechanics::systems claims::travelling", [
        ("state.spatial.clone() + (change - along)", "state.spatial.clone() + change"),
        ("pushed / present[part]", "0.0 * pushed"),
    ]),
    "src/mechanics/bodies/elliptic.rs": ("mechanics::bodies", [
        ("product < 0.5", "true"),
        ("1.0 + e3 / 14.0 - e2 / 10.0 + e2 * e2 / 24.0 - 3.0 / 44.0 * e2 * e3",
         "1.0 + e3 / 14.0 - e2 / 10.0 + e2 * e2 / 24.0",
         "deviations below CLOSE make the term at most 5e-16, two rounding errors of the sum"),
        ("3.0 / 26.0 * e5", "3.0 / 20.0 * e5",
         "deviations below CLOSE make the difference at most 4e-16, two rounding errors of the sum"),
        ("e > 1e-5", "e > 1e-1"),
        ("c.max(0.0)", "c",
         "a negative rounding error of the cosine changes the integral by as much"),
        ("k > CIRCULAR && jacobi.levels < LEVELS", "k > 1e-4 && jacobi.levels < LEVELS"),
    ]),
    "src/mechanics/bodies/free_body.rs": ("mechanics::bodies", [
        ("outer - inner <= ON_SEPARATRIX * outer", "outer - inner <= 1e-9 * outer"),
        ("total - dynamic", "total + dynamic"),
        ("(energy / self.inertia.principal_moments().min()).sqrt().max(argument)",
         "(energy / self.inertia.principal_moments().min()).sqrt()"),
        ("turns.rem_euclid(2.0) == 0.0", "turns % 2.0 == 0.0",
         "the remainder of an even number is 0 with either sign, and -1 and 1 are both odd"),
    ]),
    "src/mechanics/bodies/inertia.rs": ("mechanics::bodies", [
        ("off > SYMMETRIC * matrix.amax()", "off > 1e-6 * matrix.amax()"),
        ("(c - b) - a <= FLAT * size", "(c - b) - a <= 1e-3 * size"),
    ]),
    "src/mechanics/bodies/mass.rs": ("mechanics::bodies documents:claims::mass_properties", [
        ("least > ROUNDING * largest", "least > 0.0"),
        ("self.mass * share", "part"),
    ]),
    "src/mechanics/systems/constrained.rs": ("mechanics::systems::constrained", [
        ("value.is_nan() || value.abs() > OFF * change", "value.is_nan() || value.abs() > 1e-3 * change"),
        ("rate.abs() > rest + OFF * terms.sum::<f64>()", "rate.abs() > rest + 1e-3 * terms.sum::<f64>()"),
        ("rest.norm() <= DEPENDENT * row.norm()", "rest.norm() <= 1e-3 * row.norm()"),
        ("rest.norm() <= DEPENDENT * row.norm()", "rest.norm() <= 0.0"),
        ("(given - slope).abs() > ROUGH * (size + slope.abs())", "(given - slope).abs() > 0.1 * (size + slope.abs())"),
        ("(8.0 * near - far) / (12.0 * step)", "near / (2.0 * step)"),
    ]),
    "src/mechanics/systems/euler_poincare.rs": ("mechanics::integrators", [
        ("SAME * inertia.trace()", "1e-3 * inertia.trace()"),
    ]),
    "src/mechanics/systems/isospectral/manakov.rs": ("mechanics::systems::isospectral", [
        ("product = -product;", "product *= 1.0;"),
        ("sum.is_nan() || sum <= 0.0 || sum.is_infinite()", "sum.is_nan() || sum < 0.0 || sum.is_infinite()"),
    ]),
    "src/mechanics/systems/isospectral/toda.rs": ("mechanics::systems::isospectral", [
        ("-0.5 * momenta[i]", "0.5 * momenta[i]"),
        ("(length.abs() * sums.fold(0.0, f64::max)).max(1.0).ceil()", "1.0_f64"),
    ]),
    "src/mechanics/integrators/isospectral_midpoint.rs": ("mechanics::systems::isospectral", [
        ("off == 0.0 || (off >= last && off <= NOISE * size)", "off <= 1e-6 * size"),
    ]),
    "src/mechanics/integrators/magnus.rs": ("mechanics::integrators", [
        ("bracket(&left, &(b + q)) * (1.0 / 240.0)", "bracket(&left, &b) * (1.0 / 240.0)"),
    ]),
    "src/mechanics/integrators/compensated.rs": ("mechanics::integrators mechanics::bodies", [
        ("(self.value - next) + term", "term * 0.0"),
    ]),
}

LOGARITHMS = "group::groups::matrix_group group::groups::a_logarithm lib:numerics::logarithm"
GROUP = {
    "src/numerics/logarithm.rs": (LOGARITHMS, [
        ("off <= OFF", "off <= 1e-3"),
        ("value.re <= -known && value.im.abs() <= rounding", "value.re <= -known && value.im.abs() <= 0.1 * a.norm()"),
        ("value.re <= -known && value.im.abs() <= rounding", "value.re <= -known && value.im.abs() <= 1e-4 * a.norm()"),
        ("off <= COARSE", "off <= 1e-6"),
        ("(power * x).iter().all(|entry| *entry == 0.0)", "(power * x).iter().all(|entry| entry.abs() <= 1e-9)"),
        ("rounded_x.norm() <= NEAR", "rounded_x.norm() <= 0.9"),
        ("distance < 1e-6 && distance >= before", "distance < 1e-1 && distance >= before",
         "it converges quadratically below 0.1; if it stagnates above 1e-6, the exponential rejects the logarithm"),
    ]),
    "src/group/groups/matrix_group.rs": (LOGARITHMS, [
        ("outside <= OUTSIDE * (1.0 + log.norm())", "outside <= 1e-3 * (1.0 + log.norm())"),
        ("lost > ILL_CONDITIONED && self.size() <= ROWS", "false"),
        ("off <= tolerance * k as f64 * (1.0 + log.norm())", "off <= 1e3 * tolerance * (1.0 + log.norm())"),
        ("off.is_nan() || off > tolerance * self.span.norm(at)", "off.is_nan()"),
        ("(special && !is_one) || determinant <= 0.0", "determinant <= 0.0"),
        ("(special && !is_one) || determinant <= 0.0", "special && !is_one"),
        ("terms <= roundings * size", "true"),
        ("self.outside(&log) <= roundings * f64::EPSILON * log.norm()", "true"),
        ("outside <= CLOSE", "outside <= 1e-6"),
        ("x.norm().max(y.norm()) <= SHORT", "x.norm().max(y.norm()) <= 1.0"),
        ("square > 0.0 && (&cube + &b * square).norm() <= ROUNDING * cube.norm()", "square > 0.0"),
        ("g[(j, i)] * form[j] / form[i]", "g[(j, i)] * form[i] / form[j]"),
        ("1..=POWERS", "1..=1"),
    ]),
    "src/group/groups/matrix_group/fit.rs": (LOGARITHMS, [
        ("length <= SETTLED * x.norm() || length >= 0.5 * before", "length <= 1e-6 * x.norm()"),
        ("length <= OFF * x.norm() && off.norm() <= OFF * target.norm()", "true"),
        ("0.5 * f64::EPSILON * changes.amax()", "0.005 * f64::EPSILON * changes.amax()"),
    ]),
    "src/group/groups/matrix_group/half_turn.rs": (LOGARITHMS, [
        ("0.0 < gap && gap < NEAR_PI", "gap < NEAR_PI"),
        ("*sine <= DECIDED * rounding", "*sine <= 0.0"),
        ("(angles.max() < PI - BRANCH).then_some(x)", "Some(x)"),
    ]),
    "src/group/groups/matrix_group/span.rs": (LOGARITHMS, [
        ("&forms + residual * &forms", "&forms + residual * 0.0 * &forms"),
    ]),
    "src/group/groups/matrix_group/splitting.rs": ("group::groups::matrix_group claims::travelling", [
        ("(&matrix * &f - &right).amax() > ROUNDING * size * (1.0 + f.amax())", "false"),
        ("!pairs().all(|(x, y)| is_zero(&bracket(x, y)))", "false"),
        ("(x - x.round()).abs() <= ROUNDING", "false"),
    ]),
    "src/group/groups/so3.rs": ("group::groups::so3 group::rotation group::embedded lib:group::groups::so3", [
        ("off.abs() < 1e-8", "off.abs() < 1e-2"),
        ("(norm - 1.0).abs() < 1e-8", "(norm - 1.0).abs() < 1e-2"),
        ("square <= 1e30", "true"),
        ("near.try_normalize(0.0).unwrap_or_default()", "Vector3::zeros()"),
        ("((near.dot(&axis) - angle) / std::f64::consts::TAU).round()",
         "((near.dot(&axis) - angle) / std::f64::consts::TAU).floor()"),
    ]),
    "src/group/rotation/conversions.rs": ("group::rotation group::groups::so3 group::embedded", [
        ("largest < 1e-300", "false",
         "quotients of components and the largest one have no rounding error of their own below the normal range"),
        ("defect.max() <= tolerance", "defect.max() < tolerance"),
        ("r.determinant() < 0.0", "false"),
        ("r.amax().max(1.0)", "1.0"),
    ]),
    "src/group/rotation/euler.rs": ("group::rotation", [
        ("of_difference <= ROUNDING * length", "of_difference <= 0.0"),
        ("of_sum <= ROUNDING * length", "of_sum <= 1e-4 * length"),
        ("if intrinsic { sum } else { -sum }", "sum"),
    ]),
    "src/group/mean.rs": ("group::groups::means group::embedded", [
        ("size <= own.max(1e6 * ROUNDING * spread) && size >= before", "false"),
        ("size <= ROUNDING * spread", "size <= 1e-3 * spread"),
    ]),
    "src/group/groups/sl2.rs": ("group::groups::sl2 group::groups::unimodular group::embedded", [
        ("terms > CANCELLED * (part.amax() + cos.abs())", "false"),
        ("TOLERANCE * (1.0 + m.norm_squared())", "1e-2 * (1.0 + m.norm_squared())"),
        ("square.abs() < NEAR", "square.abs() < 0.5",
         "the quotient is below 1 up to 0.5 as well, so both estimates bound the lost digits"),
    ]),
    "src/group/groups/homotheties.rs": ("group::groups group::tangent", [
        ("w.abs() < 1.0", "w.abs() < 1e-5"),
    ]),
    "src/group/transport.rs": ("group::transport", [
        ("noise < NOISE", "true"),
        ("generator.amax() < LARGE || exponential::balanced(&generator).0.amax() < LARGE", "generator.amax() < LARGE"),
        ("f64::EPSILON * terms.amax() / carried.amax()", "0.0"),
    ]),
}

STRUCTURE = {
    "src/algebra/structure/killing.rs": ("algebra::structure::of_ algebra::structure::ideals", [
        ("n > 0 && (regular || self.killing().rank() == n)", "regular || self.killing().rank() == n"),
        ("value.clone() + value", "value.clone()"),
    ]),
    "src/algebra/structure/series.rs": ("algebra::structure::of_ algebra::structure::ideals brackets_of_subspaces", [
        ("if v == w { at + 1 } else { 0 }", "0", "the bracket is antisymmetric: the other pairs repeat these"),
        ("if v == w { at + 1 } else { 0 }", "at + 1"),
        ("self.is_solvable() && self.lower_central_series().last().is_some_and(Subspace::is_zero)",
         "self.is_solvable()"),
        ("radical.is_zero() || radical == &self.centre()", "radical.is_zero()"),
        ("v.reduce(ad.image(x))", "ad.image(x)"),
        ("(k * n + i, value)", "(k + i, value)"),
        ("last.into_iter().skip(1)", "last.into_iter().skip(0)"),
    ]),
    "src/algebra/structure/index.rs": ("algebra::structure::of_ algebra::structure::symplectic", [
        ("index <= self.centre().dimension().max(n % 2)", "index <= self.centre().dimension().max(1)",
         "the index has the parity of n, so an index of 1 occurs in odd dimensions only"),
        ("2 * v.dimension() >= n + index", "2 * v.dimension() >= index",
         "only the certificate is weaker: an index that is not proved otherwise is not known"),
        ("pfaffian(&form, &rows).vanishes()", "true",
         "only the certificate is weaker: the rows are maximal unless six primes are exceptional at once"),
    ]),
    "src/algebra/structure/cartan.rs": ("algebra::structure::root_spaces algebra::structure::gap_in_the_basis", [
        ("self.products.of(at).iter().all(|(k, ..)| !chosen.contains(k))", "true"),
        ("kernel.dimension() == rank && form.rank().ok()? == rank", "kernel.dimension() == rank"),
        ("sub.is_nilpotent()", "true"),
    ]),
    "src/algebra/structure/radical.rs": ("algebra::structure::of_ algebra::structure::ideals", [
        ("inside.subalgebra(&found).is_ok_and(|candidate| candidate.is_nilpotent())", "true"),
    ]),
    "src/algebra/structure/levi.rs": ("algebra::structure::of_ algebra::structure::ideals", [
        ("put(i * d + a, &moved[j][a], &-S::one());", "put(i * d + a, &moved[j][a], &S::one());"),
        ("smaller.dimension() < self.dimension()", "false"),
    ]),
    "src/algebra/structure/derivations.rs": ("algebra::structure::of_ algebra::structure::certificates", [
        ("n - z + z * z", "n + z * z"),
        ("factors.len() + z * (z + 1) / 2", "factors.len() + z * z"),
        ("counted.proved || counted.dimension == inner", "counted.proved",
         "the count by equations proves the same dimension"),
        ("collected(terms).is_empty()", "true",
         "only the certificate is weaker: wrong maps are not known to be reconstructed from residues"),
        ("collected(terms).is_empty()", "false"),
        ("j != k", "true"),
    ]),
    "src/algebra/structure/cohomology.rs": ("algebra::structure::of_ algebra::structure::certificates", [
        ("!(below(i) ^ below(j) ^ below(*l))", "below(i) ^ below(j) ^ below(*l)",
         "a differential of the opposite sign has the same kernel and image"),
        ("!(below(i) ^ below(j) ^ below(*l))", "!(below(i) ^ below(j))"),
        ("*dual < k && self.is_unimodular()", "*dual < k"),
        ("2 * m + 1", "m + 1"),
    ]),
    "src/algebra/structure/symplectic.rs": ("algebra::structure::of_ algebra::structure::symplectic", [
        ("self.is_unimodular() && !self.is_solvable()", "self.is_unimodular()"),
        ("self.is_unimodular() && self.dimension() > 0", "self.is_unimodular()"),
        ("rank + 1 >= n - kernel", "rank + 2 >= n - kernel"),
        ("index.proved && index.dimension > most", "index.proved && index.dimension >= most",
         "if the index is small enough there are forms, and the search before finds one"),
    ]),
    "src/algebra/structure/decomposition.rs": ("algebra::structure::decomposition", [
        ("real + (factor.deg() - real) / 2", "factor.deg()"),
        ("factors.iter().map(|(factor, _)| factor.deg()).sum::<usize>() < eigenvalues", "false"),
    ]),
    "src/algebra/structure/quadratic.rs": ("algebra::structure::symplectic", [
        ("if i == *j { 1 } else { 2 }", "1"),
    ]),
    "src/algebra/structure/dynkin.rs": ("algebra::structure::root_spaces algebra::roots", [
        ("rank % degree != 0 || roots % degree != 0", "false",
         "only the certificate is weaker: both are multiples unless the random element is exceptional"),
        ("p.integer(2 * n as i64 + 4)", "p.integer(2 * n as i64 + 2)"),
        ("(ranks == split.rank).then_some(types)", "Some(types)",
         "only the certificate is weaker: the ranks add up unless the random element is exceptional"),
        ("p.add(2, p.neg(four))", "p.neg(four)"),
    ]),
    "src/algebra/structure/real_forms.rs": ("algebra::structure::real_forms claims::families", [
        ("r == 4 && series == Series::D", "false"),
        ("n > 2 && n.is_multiple_of(2)", "n.is_multiple_of(2)"),
    ]),
    "src/algebra/structure/root_spaces.rs": ("algebra::structure::root_spaces", [
        ("matrix[next][other] == wanted[at][k] && matrix[other][next] == wanted[k][at]",
         "matrix[next][other] == wanted[at][k]",
         "a double or triple bond in the other order has the other entry, so one of both decides"),
    ]),
    "src/algebra/structure/ideals.rs": ("algebra::structure::ideals algebra::structure::real_forms", [
        ("(all + excess(&Killing::new(form))?) / 2", "(all - excess(&Killing::new(form))?) / 2"),
        ("noncompact > half / 2", "noncompact >= half / 2",
         "another criterion decides before, of the types with a choice, whose least dimension is 153"),
    ]),
    "src/algebra/structure/identification/sign.rs": ("algebra::structure::identification::nilpotent", [
        ("a * &c * &Rational::from(4) - &(b.clone() * &b)", "a * &c - &(b.clone() * &b)"),
        ("a * &c * &Rational::from(4) - &(b.clone() * &b)", "a * &c * &Rational::from(4)"),
    ]),
}

PROPERTIES = {
    "src/geometry/properties.rs": ("geometry::properties claims::property_witnesses claims::families", [
        ("index + 1", "index + 0"),
        ("position == 0", "position == 1"),
        ("self.parallel_curvature()", "Property::Holds(())"),
        ('"kij"', '"ijk"'),
        ('"imjk"', '"mijk"'),
        ('"imjkl"', '"mijkl"'),
    ]),
    "src/geometry/properties/einstein.rs": ("geometry::properties algebra::frame claims::floats", [
        ("y.1.pivot_weight().total_cmp(&x.1.pivot_weight())", "x.1.pivot_weight().total_cmp(&y.1.pivot_weight())"),
        ('vanishing(&frame.derivative(&scalar)?, "e_k(S)".into(), "k")', "Property::Holds(())"),
        ('vanishing(&frame.derivative(&value)?, format!("e_k({c})"), "k")', "Property::Holds(())"),
    ]),
    "src/geometry/properties/invariant.rs": ("geometry::properties geometry::connection claims::families", [
        ("!self.frame().is_invariant()", "false"),
        ("(at[1] * n + at[0], value)", "(at[0] * n + at[1], value)"),
        ("[at[0], at[2]]", "[at[2], at[0]]"),
    ]),
    "src/geometry/properties/isometries.rs": ("geometry::properties claims::property_witnesses", [
        ("variation.is_empty()", "false",
         "the system is homogeneous then, and its solution with zeros for free unknowns is 0 as well"),
        ("at[1] * n + at[2]", "at[1] * n + at[1]"),
        ("system.add(image.chain(bracket).collect(), S::zero())?;", "let _ = (image, bracket);",
         "a search of 59,000 metrics on 18 algebras found no metric on which the equivariance of phi decides"),
        ("(unknown(a, j), lowered.get(&[i, z, a]))", "(unknown(a, j), lowered.get(&[j, z, a]))"),
        ("-constant.clone()", "constant.clone()"),
        ("-within.get(&[q, b, a])", "within.get(&[q, b, a])"),
    ]),
    "src/geometry/properties/sectional.rs": ("geometry::properties claims::milnor", [
        ("(2..=MAX_SEARCHED).contains(&n)", "(2..MAX_SEARCHED).contains(&n)"),
        ("(2..=MAX_SEARCHED).contains(&n)", "n >= 2"),
        ("factor.deg() != 1", "false"),
        ("if sign > 0.0 { &mut least } else { &mut most }", "&mut least"),
        ("bound.curvature.vanishes()", "true"),
        ("side * (value - known) > 1e-9", "side * (value - known) > 0.0"),
        ("side * (value - known) > 1e-9", "side * (value - known) > 1e-2"),
        ("side * (improved - value) > 1e-15", "side * (improved - value) > 1e-3"),
        ("unchanged == 2", "unchanged == 1"),
        ("t.clone() * &half - value", "t.clone() * &half + value"),
        ("(v - v.round()).abs() > 1e-6", "(v - v.round()).abs() > 1e-1"),
        ("(v - v.round()).abs() > 1e-6", "(v - v.round()).abs() > 1e-14",
         "searches that find a plane with simple fractions are known to end closer to it than 1e-14"),
        ("(entry(j, l) + entry(l, j)) / 2.0", "entry(j, l)",
         "the curvature is symmetric in its pairs"),
        ("2.0 * form.norm() + 1e-3", "1e-3"),
        ("0..RANDOM_STARTS", "0..0",
         "random starts guard against local extremes; no metric is known on which the others end in one"),
    ]),
    "src/geometry/properties/soliton.rs": ("geometry::properties", [
        ("c.map(|value| -value.clone())", "c.map(|value| value.clone())"),
    ]),
    "src/geometry/reductive.rs": ("geometry::reductive", [
        ("vectors.rank()? < h.len()", "false"),
        ("null.rows() > 0", "false"),
        ("index + 1", "index + 0"),
    ]),
}

SITES = MECHANICS | GROUP | STRUCTURE | PROPERTIES
