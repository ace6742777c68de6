//! Tables of the literature: real algebras of dimension up to 4, nilpotent ones of dimension up to 6, and of step 2 in dimension 7.

use super::bianchi::evaluate;
use super::name::{Argument, rule};
use super::{CatalogueError, Entry, Family, Reader, numbered};
use affinor_tensors::expression::{Expression, Scalars, no_function};
use affinor_tensors::{Notation, Symbolic};
use std::collections::BTreeMap;

/// The real algebras of dimension up to 4 that are no sums.
///
/// J. Patera, R. T. Sharp, P. Winternitz, H. Zassenhaus, *J. Math. Phys.* 17 (1976) 986-994, after
/// G. M. Mubarakzyanov, *Izv. Vyssh. Uchebn. Zaved. Mat.* 32 (1963) 114-123.
pub(super) const PATERA: Family = Family {
    pattern: "patera(n,k,a=v,b=v)",
    needs: "2,1 or 3,1 to 3,9 or 4,1 to 4,12; `a=v` in 3,5 3,7 4,2 4,5 4,6 4,11, `b=v` in 4,5 4,6 4,9",
    summary: "A_n,k of Patera, Sharp, Winternitz and Zassenhaus: real algebras of dimension up to 4 that are \
              no sums; basis e1..en; a and b are parameters if not given",
    example: "patera(4,8)",
    reader: Reader::Words(|name, arguments| read(&PATERA, PATERA_TABLE, name, arguments)),
};

/// The nilpotent algebras of dimension up to 6 that are no sums.
///
/// W. A. de Graaf, *J. Algebra* 309 (2007) 640-653.
pub(super) const DE_GRAAF: Family = Family {
    pattern: "degraaf(n,k,e=v)",
    needs: "3,2 or 4,3 or 5,4 to 5,9 or 6,10 to 6,26; `e=v` in 6,19 6,21 6,22 6,24",
    summary: "L_n,k of de Graaf: nilpotent algebras of dimension up to 6 that are no sums; basis e1..en; over \
              the reals e = -1, 0, 1 are enough; e is a parameter if not given",
    example: "degraaf(5,6)",
    reader: Reader::Words(|name, arguments| read(&DE_GRAAF, DE_GRAAF_TABLE, name, arguments)),
};

/// The nilpotent algebras of dimension 7 and step 2 that are no sums.
///
/// With a centre of dimension 1 there is one; with dimension 2 they are pencils of alternating forms on R^5 without a common
/// kernel, two by Kronecker; with dimension 3 nets of alternating forms on R^4, which the rank and the signature of the
/// Pfaffian up to sign tell apart, six by Witt. Numbers of M.-P. Gong, *Classification of nilpotent Lie algebras of dimension 7*,
/// Ph.D. thesis, University of Waterloo 1998: the dimensions of the upper central series, then a letter.
pub(super) const GONG: Family = Family {
    pattern: "gong(7,k)",
    needs: "7,17 or 7,27A or 7,27B or 7,37A to 7,37D or 7,37B1 or 7,37D1",
    summary: "the real nilpotent algebras of dimension 7 and step 2 that are no sums, in the numbers of Gong; basis e1..e7",
    example: "gong(7,37D1)",
    reader: Reader::Words(|name, arguments| read(&GONG, GONG_TABLE, name, arguments)),
};

/// The number, the parameters, and the brackets `jk>i:v`, meaning `[e_j, e_k] = .. + v e_i`.
const PATERA_TABLE: &str = "\
2,1|12>2:1
3,1|23>1:1
3,2|13>1:1 23>1:1 23>2:1
3,3|13>1:1 23>2:1
3,4|13>1:1 23>2:-1
3,5 a|13>1:1 23>2:a
3,6|13>2:-1 23>1:1
3,7 a|13>1:a 13>2:-1 23>1:1 23>2:a
3,8|12>1:1 13>2:-2 23>3:1
3,9|12>3:1 13>2:-1 23>1:1
4,1|24>1:1 34>2:1
4,2 a|14>1:a 24>2:1 34>2:1 34>3:1
4,3|14>1:1 34>2:1
4,4|14>1:1 24>1:1 24>2:1 34>2:1 34>3:1
4,5 a b|14>1:1 24>2:a 34>3:b
4,6 a b|14>1:a 24>2:b 24>3:-1 34>2:1 34>3:b
4,7|14>1:2 23>1:1 24>2:1 34>2:1 34>3:1
4,8|23>1:1 24>2:1 34>3:-1
4,9 b|14>1:1+b 23>1:1 24>2:1 34>3:b
4,10|23>1:1 24>3:-1 34>2:1
4,11 a|14>1:2*a 23>1:1 24>2:a 24>3:-1 34>2:1 34>3:a
4,12|13>1:1 14>2:-1 23>2:1 24>1:1";

const DE_GRAAF_TABLE: &str = "\
3,2|12>3:1
4,3|12>3:1 13>4:1
5,4|12>5:1 34>5:1
5,5|12>3:1 13>5:1 24>5:1
5,6|12>3:1 13>4:1 14>5:1 23>5:1
5,7|12>3:1 13>4:1 14>5:1
5,8|12>4:1 13>5:1
5,9|12>3:1 13>4:1 23>5:1
6,10|12>3:1 13>6:1 45>6:1
6,11|12>3:1 13>4:1 14>6:1 23>6:1 25>6:1
6,12|12>3:1 13>4:1 14>6:1 25>6:1
6,13|12>3:1 13>5:1 15>6:1 24>5:1 34>6:1
6,14|12>3:1 13>4:1 14>5:1 23>5:1 25>6:1 34>6:-1
6,15|12>3:1 13>4:1 14>5:1 15>6:1 23>5:1 24>6:1
6,16|12>3:1 13>4:1 14>5:1 25>6:1 34>6:-1
6,17|12>3:1 13>4:1 14>5:1 15>6:1 23>6:1
6,18|12>3:1 13>4:1 14>5:1 15>6:1
6,19 e|12>4:1 13>5:1 24>6:1 35>6:e
6,20|12>4:1 13>5:1 15>6:1 24>6:1
6,21 e|12>3:1 13>4:1 14>6:1 23>5:1 25>6:e
6,22 e|12>5:1 13>6:1 24>6:e 34>5:1
6,23|12>3:1 13>5:1 14>6:1 24>5:1
6,24 e|12>3:1 13>5:1 14>6:e 23>6:1 24>5:1
6,25|12>3:1 13>5:1 14>6:1
6,26|12>4:1 13>5:1 23>6:1";

const GONG_TABLE: &str = "\
7,17|12>7:1 34>7:1 56>7:1
7,27A|12>6:1 14>7:1 35>7:1
7,27B|12>6:1 15>7:1 23>7:1 34>6:1
7,37A|12>5:1 23>6:1 24>7:1
7,37B|12>5:1 23>6:1 34>7:1
7,37B1|12>5:1 13>6:1 14>7:1 24>6:1 34>5:-1
7,37C|12>5:1 23>6:1 24>7:1 34>5:1
7,37D|12>5:1 13>6:1 24>7:1 34>5:1
7,37D1|12>5:1 13>6:1 14>7:1 23>7:1 24>6:-1 34>5:1";

/// The names of all rows of a family; none for a family without a table.
pub(super) fn names(family: &Family) -> Vec<String> {
    let table = match family.pattern {
        pattern if pattern == PATERA.pattern => PATERA_TABLE,
        pattern if pattern == DE_GRAAF.pattern => DE_GRAAF_TABLE,
        pattern if pattern == GONG.pattern => GONG_TABLE,
        _ => return vec![],
    };
    let number = |row: &str| row.split([' ', '|']).next().unwrap_or_default().to_string();
    table.lines().map(|row| format!("{}({})", family.head(), number(row))).collect()
}

fn read(
    family: &Family,
    table: &'static str,
    name: &str,
    arguments: &[Argument],
) -> Result<Entry, CatalogueError> {
    let refused =
        || CatalogueError::NoSuchAlgebra { name: name.trim().to_string(), rule: rule(&[family]) };
    let [n, k, given @ ..] = arguments else { return Err(refused()) };
    let number = format!("{},{}", n.text, k.text);
    let row = table.lines().find_map(|row| {
        let (head, brackets) = row.split_once('|')?;
        let mut words = head.split(' ');
        (words.next()? == number).then(|| (words.collect::<Vec<_>>(), brackets))
    });
    let (parameters, brackets) = row.ok_or_else(refused)?;
    let mut values = BTreeMap::new();
    for argument in given {
        let (letter, value) = argument.text.split_once('=').ok_or_else(refused)?;
        let value = argument.from(argument.text.len() - value.len());
        let letter = parameters.iter().find(|p| **p == letter.trim_end()).ok_or_else(refused)?;
        if values.insert(*letter, evaluate(name, value)?).is_some() {
            return Err(refused());
        }
    }
    let written: String =
        values.iter().map(|(letter, value)| format!(",{letter}={value}")).collect();
    let full = format!("{}({number}{written})", family.head());
    let value_of = |text: &str| {
        let parameter = |name: &str| match values.get(name) {
            Some(value) => Ok(value.clone()),
            None => Notation::parameter(name).ok_or_else(String::new),
        };
        let value =
            Expression::parse(text).and_then(|e| e.evaluate(&Scalars(parameter, no_function)));
        value.expect("the tables hold expressions in their parameters")
    };
    let constants = brackets.split(' ').map(|bracket| {
        let digit = |at: usize| usize::from(bracket.as_bytes()[at] - b'1');
        let value: Symbolic = value_of(&bracket[5..]);
        (digit(0), digit(1), digit(3), value)
    });
    let dimension = usize::from(number.as_bytes()[0] - b'0');
    Ok(Entry::new(full, numbered("e", dimension), constants))
}
