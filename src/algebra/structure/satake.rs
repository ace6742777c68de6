//! Real forms of the simple complex algebras: Cartan decompositions, restricted roots and Satake
//! diagrams, computed from Vogan diagrams (A. W. Knapp, *Lie Groups Beyond an Introduction*, VI).
//!
//! A Vogan diagram is an involution of the Dynkin diagram with at most one painted fixed node. It
//! defines a Cartan involution on a Chevalley basis, for a maximally compact Cartan subalgebra.
//! Cayley transforms in noncompact imaginary roots lead to a maximally noncompact one. There, the
//! restrictions of the roots to the noncompact part are the restricted roots.

use super::real_forms::{Candidate, candidates};
use super::vogan::VoganDiagram;
use crate::algebra::roots::{
    CartanType, RootSystem, Series, automorphisms, chevalley_constants, identify, numbering,
};
use affinor_tensors::stop::checkpoint;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt;

/// A real form of a simple complex algebra, with its Cartan decomposition `g = k + p`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RealForm {
    /// The type of the complex algebra.
    pub cartan_type: CartanType,
    /// The name, as in [`real_forms`](super::real_forms::real_forms).
    pub name: String,
    /// The types of the simple factors of the maximal compact subalgebra `k`.
    pub compact_types: Vec<CartanType>,
    /// The dimension of the centre of `k`: 0 or 1.
    pub compact_centre: usize,
    /// The dimension of `k`.
    pub compact_dimension: usize,
    /// The dimension of a maximal abelian subspace of `p`.
    pub real_rank: usize,
    /// The type of the restricted roots, such as `BC2`; `None` for the compact form.
    pub restricted_type: Option<RestrictedType>,
    /// The multiplicities of the restricted roots, by increasing length: the squared length over
    /// the least one, and the multiplicity.
    pub multiplicities: Vec<(i64, usize)>,
    /// The black nodes of the Satake diagram: simple roots whose restriction vanishes, numbered
    /// from 1 as in Bourbaki.
    pub black: Vec<usize>,
    /// The arrows of the Satake diagram: pairs of white nodes with equal restrictions.
    pub arrows: Vec<(usize, usize)>,
    /// The Vogan diagram, with at most one painted node.
    pub vogan: VoganDiagram,
}

/// The type of an irreducible system of restricted roots, which need not be reduced.
///
/// ```
/// use affinor::algebra::structure::RestrictedType;
/// assert_eq!(RestrictedType::BC(2).to_string(), "BC2");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestrictedType {
    /// A reduced system.
    Reduced(CartanType),
    /// The system of this rank that contains twice its short roots.
    BC(usize),
}

impl fmt::Display for RestrictedType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RestrictedType::Reduced(cartan_type) => write!(f, "{cartan_type}"),
            RestrictedType::BC(rank) => write!(f, "BC{rank}"),
        }
    }
}

impl RealForm {
    /// The real forms of a type, the compact form first.
    ///
    /// ```
    /// use affinor::algebra::roots::{CartanType, Series};
    /// use affinor::algebra::structure::RealForm;
    /// let f4 = CartanType::new(Series::F, 4)?;
    /// let forms = RealForm::all(f4);
    /// let names: Vec<&str> = forms.iter().map(|form| &form.name[..]).collect();
    /// assert_eq!(names, ["f4(-52)", "f4(4)", "f4(-20)"]);
    /// assert_eq!(forms[2].multiplicities, [(1, 8), (4, 7)]);
    /// # Ok::<(), affinor::algebra::roots::RootError>(())
    /// ```
    #[doc(alias("Satake diagram", "Vogan diagram", "restricted roots"))]
    pub fn all(cartan_type: CartanType) -> Vec<Self> {
        let roots = Roots::new(cartan_type);
        let mut forms: Vec<Self> = vec![];
        for diagram in VoganDiagram::all(cartan_type, &roots.gram) {
            checkpoint();
            if let Some(form) = roots.real_form(&diagram, None)
                && forms.iter().all(|other| other.name != form.name)
            {
                forms.push(form);
            }
        }
        forms
    }

    /// The real form of a type with a name of [`real_forms`](super::real_forms::real_forms).
    pub fn named(cartan_type: CartanType, name: &str) -> Option<Self> {
        let roots = Roots::new(cartan_type);
        let forms = VoganDiagram::all(cartan_type, &roots.gram).into_iter();
        let mut forms = forms.filter_map(|diagram| roots.real_form(&diagram, Some(name)));
        forms.find(|form| form.name == name)
    }

    /// The character `dim p - dim k`.
    pub fn character(&self) -> i64 {
        self.cartan_type.dimension() as i64 - 2 * self.compact_dimension as i64
    }

    /// The type of the maximal compact subalgebra, such as `A2 + T1`.
    pub fn compact_type(&self) -> String {
        let mut names: Vec<String> = self.compact_types.iter().map(ToString::to_string).collect();
        if self.compact_centre > 0 || names.is_empty() {
            names.push(format!("T{}", self.compact_centre));
        }
        names.join(" + ")
    }
}

/// The restricted roots and the Satake diagram of a real form, with the fields of [`RealForm`].
struct Restricted {
    rank: usize,
    restricted_type: Option<RestrictedType>,
    multiplicities: Vec<(i64, usize)>,
    black: Vec<usize>,
    arrows: Vec<(usize, usize)>,
}

type Root = Vec<i64>;

/// The root system of a type, with data for involutions.
struct Roots {
    cartan_type: CartanType,
    /// The positive roots.
    positive: Vec<Root>,
    all: HashSet<Root>,
    /// The inner products of the simple roots.
    gram: Vec<Vec<i64>>,
    /// `N_αβ` for positive roots with a positive sum, by their positions.
    constants: HashMap<(usize, usize), (usize, i64)>,
}

impl Roots {
    fn new(cartan_type: CartanType) -> Self {
        let system = RootSystem::new(cartan_type);
        let list = system.positive_roots();
        let positive: Vec<Root> = list.iter().map(|root| root.coefficients().to_vec()).collect();
        let negative = positive.iter().map(|root| scaled(root, -1));
        let all = positive.iter().cloned().chain(negative).collect();
        let cartan = cartan_type.cartan_matrix();
        let product = |i: usize, j: usize| cartan[i][j] * list[j].squared_length() / 2;
        let rank = cartan_type.rank();
        let gram = (0..rank).map(|i| (0..rank).map(|j| product(i, j)).collect()).collect();
        let count = positive.len();
        let of_positive = chevalley_constants(&system)
            .into_iter()
            .filter(|&(i, j, k, _)| i < count && j < count && k < count);
        let constants = of_positive.flat_map(|(i, j, k, v)| [((i, j), (k, v)), ((j, i), (k, -v))]);
        Roots { cartan_type, all, gram, constants: constants.collect(), positive }
    }

    fn product(&self, a: &[i64], b: &[i64]) -> i64 {
        let row = |(i, x): (usize, &i64)| {
            let terms = b.iter().zip(&self.gram[i]).map(|(y, g)| x * y * g);
            terms.sum::<i64>()
        };
        a.iter().enumerate().map(row).sum()
    }

    /// The signs `θ e_α = ±e_θα` of the positive roots. The automorphism without a painted node
    /// permutes the generators `e_i`.
    fn signs(&self, diagram: &VoganDiagram) -> Vec<i64> {
        let rank = self.cartan_type.rank();
        let position: HashMap<&Root, usize> =
            self.positive.iter().enumerate().map(|(at, root)| (root, at)).collect();
        let image = |root: &Root| position[&permuted(root, &diagram.images)];
        let mut signs = vec![1; self.positive.len()];
        for (at, root) in self.positive.iter().enumerate().skip(rank) {
            // a positive root that is not simple is the sum of a simple and a positive root
            let found = (0..rank).find_map(|i| {
                let mut rest = root.clone();
                rest[i] -= 1;
                let rest = *position.get(&rest)?;
                Some((i, rest, self.constants.get(&(i, rest))?.1))
            });
            if let Some((i, rest, value)) = found {
                let pair = (diagram.images[i], image(&self.positive[rest]));
                let other = self.constants.get(&pair).map_or(value, |(_, value)| *value);
                signs[at] = signs[rest] * other.signum() * value.signum();
            }
        }
        if let Some(node) = diagram.node {
            for (sign, root) in signs.iter_mut().zip(&self.positive) {
                if root[node] % 2 != 0 {
                    *sign = -*sign;
                }
            }
        }
        signs
    }

    /// The real form of a Vogan diagram; `None` if its root systems are not recognized, or if the
    /// dimension of `k` excludes the wanted name.
    fn real_form(&self, diagram: &VoganDiagram, wanted: Option<&str>) -> Option<RealForm> {
        let rank = self.cartan_type.rank();
        let signs = self.signs(diagram);
        // the imaginary positive roots, and whether they are compact
        let mut imaginary: Vec<(Root, bool)> = vec![];
        // twice the restrictions of the roots of k
        let mut compact: HashSet<Root> = HashSet::new();
        for (root, sign) in self.positive.iter().zip(signs) {
            let image = permuted(root, &diagram.images);
            let is_compact = sign > 0;
            if image == *root {
                imaginary.push((root.clone(), is_compact));
            }
            if image != *root || is_compact {
                compact.insert(sum(root, &image, 1));
            }
        }
        let moved = (0..rank).filter(|&i| diagram.images[i] != i).count();
        let torus = rank - moved / 2;
        let compact_dimension = torus + 2 * compact.len();
        let names = candidates(self.cartan_type, compact_dimension);
        if wanted.is_some_and(|wanted| names.iter().all(|one| one.name != wanted)) {
            return None;
        }
        let compact: Vec<Root> = compact.into_iter().collect();
        let simple = indecomposable(&compact);
        let compact_centre = torus - simple.len();
        let mut compact_types: Vec<CartanType> =
            identify(&self.cartan_matrix(&simple))?.into_iter().map(|(one, _)| one).collect();
        compact_types.sort_by_key(|one| (one.series() as usize, one.rank()));
        // of two names, `su*` is an outer form, and `so*` has the subalgebra `u(n)`
        let is_quaternionic = match self.cartan_type.series() {
            Series::A => moved > 0,
            _ => compact_centre == 1 && compact_types.iter().all(|one| one.series() == Series::A),
        };
        let decisive = names.len() > 1;
        let fits = |one: &Candidate| !decisive || one.is_quaternionic == is_quaternionic;
        let Candidate { name, is_quaternionic } = names.into_iter().find(fits)?;
        // Cayley transforms, each with the reflection in a noncompact imaginary root
        let unit = |i: usize| (0..rank).map(|j| i64::from(i == j)).collect::<Root>();
        let mut involution: Vec<Root> = (0..rank).map(|i| unit(diagram.images[i])).collect();
        while let Some((beta, _)) = imaginary.iter().find(|(_, compact)| !compact).cloned() {
            for image in &mut involution {
                let factor = 2 * self.product(image, &beta) / self.product(&beta, &beta);
                *image = sum(image, &beta, -factor);
            }
            imaginary.retain(|(root, _)| self.product(root, &beta) == 0);
            for (root, compact) in &mut imaginary {
                // orthogonal roots whose sum is a root exchange compact and noncompact
                *compact ^= self.all.contains(&sum(root, &beta, 1));
            }
        }
        let image = |root: &Root| {
            let terms = root.iter().zip(&involution);
            terms.fold(vec![0; rank], |all, (c, image)| sum(&all, image, *c))
        };
        let restricted = self.restricted(image, is_quaternionic)?;
        Some(RealForm {
            cartan_type: self.cartan_type,
            name,
            compact_types,
            compact_centre,
            compact_dimension,
            real_rank: restricted.rank,
            restricted_type: restricted.restricted_type,
            multiplicities: restricted.multiplicities,
            black: restricted.black,
            arrows: restricted.arrows,
            vogan: diagram.clone(),
        })
    }

    /// The restricted roots and the Satake diagram of an involution that is maximally noncompact.
    fn restricted(
        &self,
        image: impl Fn(&Root) -> Root,
        is_quaternionic: bool,
    ) -> Option<Restricted> {
        // twice the restrictions of all roots to the noncompact and to the compact part
        let pairs: Vec<(&Root, Root, Root)> = self
            .all
            .iter()
            .map(|root| {
                let image = image(root);
                (root, sum(root, &image, -1), sum(root, &image, 1))
            })
            .collect();
        let is_zero = |root: &Root| root.iter().all(|c| *c == 0);
        // the lexicographic order; the noncompact part decides first
        let key =
            |(_, a, b): &&(&Root, Root, Root)| a.iter().chain(b).find(|c| **c != 0) > Some(&0);
        let positive: Vec<Root> = pairs.iter().filter(key).map(|(r, ..)| (*r).clone()).collect();
        let simple = indecomposable(&positive);
        let matrix = self.cartan_matrix(&simple);
        let nodes: Vec<usize> = (0..simple.len()).collect();
        let order = numbering(&matrix, &self.cartan_type.cartan_matrix(), &nodes)?;
        let satake = |nodes: &[usize]| {
            let restrictions: Vec<Root> = nodes
                .iter()
                .map(|&i| &simple[order[i]])
                .map(|root| sum(root, &image(root), -1))
                .collect();
            let rank = restrictions.len();
            let is_black = |i: &usize| is_zero(&restrictions[*i]);
            let black: Vec<usize> = (0..rank).filter(is_black).map(|i| i + 1).collect();
            let pairs = (0..rank).flat_map(|i| (i + 1..rank).map(move |j| (i, j)));
            let arrows = pairs
                .filter(|(i, j)| restrictions[*i] == restrictions[*j] && !is_black(i))
                .map(|(i, j)| (i + 1, j + 1));
            (black, arrows.collect::<Vec<_>>())
        };
        // of the numberings, the usual one: the black nodes of so(p,q) come last, those of so*(2n)
        // come first
        let diagrams = automorphisms(self.cartan_type).into_iter().map(|nodes| satake(&nodes));
        let (black, arrows) = if is_quaternionic { diagrams.min() } else { diagrams.max() }?;
        let mut counted: HashMap<&Root, usize> = HashMap::new();
        for (_, restriction, _) in pairs.iter().filter(key).filter(|(_, a, _)| !is_zero(a)) {
            *counted.entry(restriction).or_default() += 1;
        }
        let restricted: Vec<Root> = counted.keys().map(|root| (*root).clone()).collect();
        let simple = indecomposable(&restricted);
        let doubled = |root: &Root| counted.contains_key(&scaled(root, 2));
        let restricted_type = if restricted.is_empty() {
            None
        } else if restricted.iter().any(doubled) {
            Some(RestrictedType::BC(simple.len()))
        } else {
            let found = identify(&self.cartan_matrix(&simple))?;
            found.first().map(|(one, _)| RestrictedType::Reduced(*one))
        };
        let mut lengths: BTreeMap<i64, usize> = BTreeMap::new();
        for (root, count) in &counted {
            lengths.insert(self.product(root, root), *count);
        }
        let least = lengths.keys().next().copied().unwrap_or(1);
        Some(Restricted {
            rank: simple.len(),
            restricted_type,
            multiplicities: lengths.into_iter().map(|(l, count)| (l / least, count)).collect(),
            black,
            arrows,
        })
    }

    /// The Cartan matrix `2 (a, b)/(b, b)` of vectors.
    fn cartan_matrix(&self, simple: &[Root]) -> Vec<Vec<i64>> {
        let entry = |a: &Root, b: &Root| 2 * self.product(a, b) / self.product(b, b);
        simple.iter().map(|a| simple.iter().map(|b| entry(a, b)).collect()).collect()
    }
}

/// The vectors that are not a sum of two of the vectors.
fn indecomposable(positive: &[Root]) -> Vec<Root> {
    let all: HashSet<&Root> = positive.iter().collect();
    let is_sum = |root: &&Root| positive.iter().any(|other| all.contains(&sum(root, other, -1)));
    positive.iter().filter(|root| !is_sum(root)).cloned().collect()
}

fn permuted(root: &[i64], images: &[usize]) -> Root {
    let mut image = vec![0; root.len()];
    for (c, &at) in root.iter().zip(images) {
        image[at] = *c;
    }
    image
}

fn scaled(root: &[i64], factor: i64) -> Root {
    root.iter().map(|c| c * factor).collect()
}

/// The vector `a + factor b`.
fn sum(a: &[i64], b: &[i64], factor: i64) -> Root {
    a.iter().zip(b).map(|(x, y)| x + factor * y).collect()
}
