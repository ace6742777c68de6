//! Tables from the literature: real algebras up to dimension 4, nilpotent algebras up to dimension
//! 6, and nilpotent algebras of step 2 in dimension 7.

use super::bianchi::evaluate;
use super::name::{Argument, rule};
use super::{CatalogueError, Entry, Family, Reader, numbered};
use affinor_tensors::expression::{Expression, Scalars, no_function};
use affinor_tensors::{Notation, Symbolic};
use std::collections::BTreeMap;

/// The indecomposable real algebras of dimension up to 4. If some parameters are zero, a row may be
/// a direct sum.
///
/// J. Patera, R. T. Sharp, P. Winternitz, H. Zassenhaus, *J. Math. Phys.* 17 (1976) 986-994, after
/// G. M. Mubarakzyanov, *Izv. Vyssh. Uchebn. Zaved. Mat.* 32 (1963) 114-123.
pub(super) const PATERA: Family = Family {
    pattern: "patera(n,k,a=v,b=v)",
    needs: "2,1 or 3,1 to 3,9 or 4,1 to 4,12; `a=v` in 3,5 3,7 4,2 4,5 4,6 4,11, `b=v` in 4,5 4,6 4,9",
    summary: "A_n,k of Patera, Sharp, Winternitz and Zassenhaus: indecomposable real algebras of \
              dimension up to 4, but for sums at a = 0 in 3,5 4,2 4,5 4,6 and at b = 0 in 4,5; basis e1..en; a and b are \
              parameters if not given",
    example: "patera(4,8)",
    reader: Reader::Words(|name, arguments| read(&PATERA, PATERA_TABLE, name, arguments)),
};

/// The indecomposable nilpotent algebras of dimension up to 6. One row is a direct sum for a range
/// of its parameter.
///
/// W. A. de Graaf, *J. Algebra* 309 (2007) 640-653.
pub(super) const DE_GRAAF: Family = Family {
    pattern: "degraaf(n,k,e=v)",
    needs: "3,2 or 4,3 or 5,4 to 5,9 or 6,10 to 6,26; `e=v` in 6,19 6,21 6,22 6,24",
    summary: "L_n,k of de Graaf: indecomposable nilpotent algebras of dimension up to 6, but for 6,22 at e > 0, the sum \
              of two 3,2; basis e1..en; over the reals e = -1, 0, 1 are enough; e is a parameter if not given",
    example: "degraaf(5,6)",
    reader: Reader::Words(|name, arguments| read(&DE_GRAAF, DE_GRAAF_TABLE, name, arguments)),
};

/// The indecomposable real nilpotent algebras of dimension 7: 140 of them and 9 families with a
/// parameter.
///
/// M.-P. Gong, *Classification of nilpotent Lie algebras of dimension 7 (over algebraically closed
/// fields and R)*, Ph.D. thesis, University of Waterloo 1998. The number of an algebra consists of
/// the dimensions of the upper central series and a letter; a digit after the letter marks other
/// real forms. Different values of a parameter may give isomorphic algebras, even if their numbers
/// differ.
///
/// The algebras of step 2 can be checked by hand. With a centre of dimension 1, there is one
/// algebra. With a centre of dimension 2, the algebras are pencils of alternating forms on R^5
/// without a common kernel, of which there are two (Kronecker). With a centre of dimension 3, they
/// are nets of alternating forms on R^4. The rank and the signature (up to sign) of the Pfaffian
/// distinguish these nets; there are six (Witt).
pub(super) const GONG: Family = Family {
    pattern: "gong(7,k,a=v)",
    needs: "7 and a number of Gong: 17, 27A, 37B1, .. 123457I; `a=v` in 147E 147E1 1357M 1357N 1357S 1357QRS1 12457N 12457N2 123457I",
    summary: "the indecomposable real nilpotent algebras of dimension 7, in the numbers of Gong; basis e1..e7; a is a \
              parameter if not given",
    example: "gong(7,37D1)",
    reader: Reader::Words(|name, arguments| read(&GONG, GONG_TABLE, name, arguments)),
};

/// Rows with the number, the parameters, and the brackets `jk>i:v`, meaning
/// `[e_j, e_k] = ... + v e_i`.
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
7,37D1|12>5:1 13>6:1 14>7:1 23>7:1 24>6:-1 34>5:1
7,357A|12>3:1 13>5:1 14>7:1 24>6:1
7,357B|12>3:1 13>5:1 14>7:1 23>6:1
7,357C|12>3:1 13>5:1 14>7:1 23>6:1 24>5:1
7,257A|12>3:1 13>6:1 15>7:1 24>6:1
7,257B|12>3:1 13>6:1 14>7:1 25>7:1
7,257C|12>3:1 13>6:1 24>6:1 25>7:1
7,257D|12>3:1 13>6:1 14>7:1 24>6:1 25>7:1
7,257E|12>3:1 13>6:1 24>7:1 45>6:1
7,257F|12>3:1 23>6:1 24>7:1 45>6:1
7,257G|12>3:1 13>6:1 15>7:1 24>7:1 45>6:1
7,257H|12>3:1 13>6:1 24>6:1 45>7:1
7,257I|12>3:1 13>6:1 14>6:1 15>7:1 23>7:1
7,257J|12>3:1 13>6:1 15>7:1 23>7:1 24>6:1
7,257J1|12>3:1 13>6:1 14>6:1 15>7:1 23>7:1 25>6:1
7,257K|12>3:1 13>6:1 23>7:1 45>7:1
7,257L|12>3:1 13>6:1 23>7:1 24>6:1 45>7:1
7,247A|12>4:1 13>5:1 14>6:1 15>7:1
7,247B|12>4:1 13>5:1 14>6:1 35>7:1
7,247C|12>4:1 13>5:1 14>6:1 15>7:1 35>6:1
7,247D|12>4:1 13>5:1 14>6:1 25>7:1 34>7:1
7,247E|12>4:1 13>5:1 14>6:1 15>6:1 25>7:1 34>7:1
7,247E1|12>4:1 13>5:1 14>6:1 24>7:1 35>7:1
7,247F|12>4:1 13>5:1 24>6:1 25>7:1 34>7:1 35>6:1
7,247F1|12>4:1 13>5:1 24>6:1 25>7:1 34>7:1 35>6:-1
7,247G|12>4:1 13>5:1 14>6:1 15>6:1 24>6:1 25>7:1 34>7:1 35>6:1
7,247H|12>4:1 13>5:1 14>6:1 24>6:1 25>7:1 34>7:1 35>6:1
7,247H1|12>4:1 13>5:1 14>6:1 24>6:1 25>7:1 34>7:1 35>6:-1
7,247I|12>4:1 13>5:1 25>6:1 34>6:1 35>7:1
7,247J|12>4:1 13>5:1 15>6:1 25>7:1 34>7:1 35>6:1
7,247K|12>4:1 13>5:1 14>6:1 25>7:1 34>7:1 35>6:1
7,247L|12>4:1 13>5:1 14>6:1 15>7:1 23>6:1
7,247M|12>4:1 13>5:1 14>6:1 23>6:1 35>7:1
7,247N|12>4:1 13>5:1 15>6:1 23>7:1 24>6:1
7,247O|12>4:1 13>5:1 14>6:1 15>7:1 23>7:1 35>6:1
7,247P|12>4:1 13>5:1 23>6:1 25>7:1 34>7:1
7,247P1|12>4:1 13>5:1 23>6:1 24>7:1 35>7:1
7,247Q|12>4:1 13>5:1 14>6:1 23>6:1 25>7:1 34>7:1
7,247R|12>4:1 13>5:1 14>6:1 15>6:1 23>6:1 25>7:1 34>7:1
7,247R1|12>4:1 13>5:1 14>6:1 23>6:1 24>7:1 35>7:1
7,2457A|12>3:1 13>4:1 14>6:1 15>7:1
7,2457B|12>3:1 13>4:1 14>7:1 25>6:1
7,2457C|12>3:1 13>4:1 14>6:1 15>7:1 25>6:1
7,2457D|12>3:1 13>4:1 14>6:1 15>7:1 23>6:1 25>6:1
7,2457E|12>3:1 13>4:1 14>7:1 23>6:1 25>6:1
7,2457F|12>3:1 13>4:1 14>6:1 15>7:1 23>6:1
7,2457G|12>3:1 13>4:1 14>7:1 15>6:1 23>6:1
7,2457H|12>3:1 13>4:1 14>7:1 23>6:1 25>7:1
7,2457I|12>3:1 13>4:1 14>6:1 23>6:1 25>7:1
7,2457J|12>3:1 13>4:1 14>6:1 23>6:1 23>7:1 25>7:1
7,2457K|12>3:1 13>4:1 14>7:1 15>6:1 23>6:1 25>7:1
7,2457L|12>3:1 13>4:1 14>6:1 15>7:1 23>5:1 24>7:1 25>6:1
7,2457L1|12>3:1 13>4:1 14>6:1 15>7:1 23>5:1 24>7:1 25>6:-1
7,2457M|12>3:1 13>4:1 14>7:1 15>6:1 23>5:1 24>6:1
7,2357A|12>4:1 14>5:1 15>7:1 23>5:1 23>6:1 34>7:-1
7,2357B|12>4:1 13>6:1 14>5:1 15>7:1 23>5:1 34>7:-1
7,2357C|12>4:1 14>5:1 15>7:1 23>5:1 24>6:1 34>7:-1
7,2357D|12>4:1 13>6:1 14>5:1 15>7:1 23>5:1 24>6:1 34>7:-1
7,2357D1|12>4:1 13>6:1 14>5:1 15>7:1 23>5:1 24>6:-1 34>7:-1
7,23457A|12>3:1 13>4:1 14>5:1 15>6:1 23>7:1
7,23457B|12>3:1 13>4:1 14>5:1 23>7:1 25>6:1 34>6:-1
7,23457C|12>3:1 13>4:1 14>5:1 15>6:1 25>7:1 34>7:-1
7,23457D|12>3:1 13>4:1 14>5:1 15>6:1 23>6:1 25>7:1 34>7:-1
7,23457E|12>3:1 13>4:1 14>5:1 15>6:1 23>5:1 23>7:1 24>6:1
7,23457F|12>3:1 13>4:1 14>5:1 23>5:1 23>7:1 25>6:1 34>6:-1
7,23457G|12>3:1 13>4:1 14>5:1 15>6:1 23>5:1 24>6:1 25>7:1 34>7:-1
7,157|12>3:1 13>7:1 24>7:1 56>7:1
7,147A|12>4:1 13>5:1 16>7:1 25>7:1 34>7:1
7,147A1|12>4:1 13>5:1 16>7:1 24>7:1 35>7:1
7,147B|12>4:1 13>5:1 14>7:1 26>7:1 35>7:1
7,147D|12>4:1 13>6:-1 15>7:1 16>7:1 23>5:1 26>7:1 34>7:-2
7,147E a|12>4:1 13>6:-1 15>7:-1 23>5:1 26>7:a 34>7:1-a
7,147E1 a|12>4:1 13>6:-1 16>7:-a 23>5:1 25>7:a 26>7:2 34>7:-2
7,1457A|12>3:1 13>4:1 14>7:1 56>7:1
7,1457B|12>3:1 13>4:1 14>7:1 23>7:1 56>7:1
7,137A|12>5:1 15>7:1 34>6:1 36>7:1
7,137A1|13>5:1 14>6:1 15>7:1 23>6:-1 24>5:1 26>7:1
7,137B|12>5:1 15>7:1 24>7:1 34>6:1 36>7:1
7,137B1|13>5:1 14>6:1 15>7:1 23>6:-1 24>5:1 26>7:1 34>7:1
7,137C|12>5:1 14>6:1 16>7:1 23>6:1 35>7:-1
7,137D|12>5:1 14>6:1 16>7:1 23>6:1 24>7:1 35>7:-1
7,1357A|12>4:1 14>5:1 15>7:1 23>5:1 26>7:1 34>7:-1
7,1357B|12>4:1 14>5:1 15>7:1 23>5:1 34>7:-1 36>7:1
7,1357C|12>4:1 14>5:1 15>7:1 23>5:1 24>7:1 34>7:-1 36>7:1
7,1357D|12>3:1 16>7:1 23>5:1 24>6:1 25>7:1 34>7:1
7,1357E|12>3:1 23>5:1 24>6:1 25>7:1 46>7:1
7,1357F|12>3:1 13>7:1 23>5:1 24>6:1 25>7:1 46>7:-1
7,1357F1|12>3:1 13>7:1 23>5:1 24>6:1 25>7:1 46>7:1
7,1357G|12>3:1 14>6:1 16>7:1 23>5:1 25>7:1
7,1357H|12>3:1 14>6:1 16>7:1 23>5:1 25>7:1 26>7:1 34>7:-1
7,1357I|12>3:1 14>6:1 23>5:1 25>7:1 46>7:1
7,1357J|12>3:1 13>7:1 14>6:1 23>5:1 25>7:1 46>7:1
7,1357L|12>3:1 13>5:1 14>6:1 15>7:1 23>7:1 24>5:1 26>7:1/2 34>7:1/2
7,1357M a|12>3:1 13>5:1 14>6:1 15>7:1 24>5:1 26>7:a 34>7:1-a
7,1357N a|12>3:1 13>5:1 14>6:1 15>7:1 23>7:a 24>5:1 34>7:1 46>7:1
7,1357O|12>3:1 13>5:1 16>7:1 23>6:1 24>5:1 25>7:1
7,1357P|12>3:1 13>5:1 15>7:1 23>6:1 24>5:1 26>7:1 34>7:1
7,1357P1|12>3:1 13>5:1 15>7:1 23>6:1 24>5:1 26>7:-1 34>7:1
7,1357Q|12>3:1 13>5:1 15>7:1 23>6:1 24>6:1 26>7:1
7,1357Q1|12>3:1 13>5:1 15>7:1 23>6:1 24>6:1 26>7:-1
7,1357R|12>3:1 13>5:1 16>7:1 23>6:1 24>6:1 25>7:1 34>7:1
7,1357S a|12>3:1 13>5:1 15>7:1 16>7:1 23>6:1 24>6:1 25>7:1 26>7:a 34>7:1
7,1357QRS1 a|12>3:1 13>5:1 14>6:1 15>7:1 23>6:-1 24>5:1 26>7:a 34>7:1-a
7,13457A|12>3:1 13>4:1 14>5:1 15>7:1 26>7:1
7,13457B|12>3:1 13>4:1 14>5:1 15>7:1 23>7:1 26>7:1
7,13457C|12>3:1 13>4:1 14>5:1 16>7:1 25>7:1 34>7:-1
7,13457D|12>3:1 13>4:1 14>5:1 15>7:1 23>5:1 24>7:1 26>7:1
7,13457E|12>3:1 13>4:1 14>5:1 16>7:1 23>5:1 25>7:1 34>7:-1
7,13457F|12>3:1 13>4:1 14>5:1 15>7:1 23>6:1 26>7:1
7,13457G|12>3:1 13>4:1 14>5:1 16>7:1 23>6:1 24>7:1 25>7:1 34>7:-1
7,13457I|12>3:1 13>4:1 14>5:1 15>7:1 23>6:1 25>7:1 26>7:1 34>7:-1
7,12457A|12>3:1 13>4:1 14>6:1 16>7:1 25>6:1 35>7:1
7,12457B|12>3:1 13>4:1 14>6:1 16>7:1 25>6:1 25>7:1 35>7:1
7,12457C|12>3:1 13>4:1 14>6:1 25>6:1 26>7:1 34>7:-1
7,12457D|12>3:1 13>4:1 14>6:1 15>7:1 25>6:1 26>7:1 34>7:-1
7,12457E|12>3:1 13>4:1 14>6:1 16>7:1 23>6:1 24>7:1 25>6:1 35>7:1
7,12457F|12>3:1 13>4:1 14>6:1 23>6:1 25>6:1 26>7:1 34>7:-1
7,12457G|12>3:1 13>4:1 14>6:1 15>7:1 23>6:1 25>6:1 26>7:1 34>7:-1
7,12457H|12>3:1 13>4:1 15>6:1 16>7:1 23>5:1 24>6:1 34>7:1
7,12457I|12>3:1 13>4:1 15>6:1 16>7:1 23>5:1 24>6:1 25>7:1 34>7:1
7,12457J|12>3:1 13>4:1 14>7:1 15>6:1 16>7:1 23>5:1 24>6:1 25>7:1 34>7:1
7,12457J1|12>3:1 13>4:1 14>7:1 15>6:1 16>7:1 23>5:1 24>6:1 25>7:-1 34>7:1
7,12457K|12>3:1 13>4:1 14>7:1 15>6:1 16>7:1 23>5:1 24>6:1 34>7:1
7,12457L|12>3:1 13>4:1 15>6:1 16>7:1 23>5:1 24>6:1 26>7:1 34>7:1 35>7:-1
7,12457L1|12>3:1 13>4:1 14>6:-1 16>7:1 23>5:1 25>6:-1 35>7:-1
7,12457N a|12>3:1 13>4:1 14>7:1 15>6:1 16>7:1 23>5:1 24>6:1 25>7:a 26>7:1 34>7:1 35>7:-1
7,12457N1|12>3:1 13>4:1 14>6:-1 16>7:1 23>5:1 25>6:-1 25>7:1 35>7:-1
7,12457N2 a|12>3:1 13>4:1 14>6:-1 15>7:1 16>7:1 23>5:1 24>7:1 25>6:-1 25>7:a 35>7:-1
7,12357A|12>4:1 14>5:1 15>6:1 16>7:1 23>5:1 34>6:-1 35>7:-1
7,12357B|12>4:1 14>5:1 15>6:1 16>7:1 23>5:1 23>7:1 34>6:-1 35>7:-1
7,12357B1|12>4:1 14>5:1 15>6:1 16>7:1 23>5:1 23>7:-1 34>6:-1 35>7:-1
7,12357C|12>4:1 14>5:1 15>6:1 16>7:1 23>5:1 24>7:1 34>6:-1 35>7:-1
7,123457A|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1
7,123457B|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>7:1
7,123457C|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 25>7:1 34>7:-1
7,123457D|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>6:1 24>7:1
7,123457E|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>6:1 23>7:1 24>7:1
7,123457F|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>6:1 24>7:1 25>7:1 34>7:-1
7,123457H|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>5:1 23>7:1 24>6:1 25>7:1
7,123457H1|12>3:1 13>4:1 14>5:1 15>6:1 16>7:-1 23>5:1 23>7:1 24>6:1 25>7:-1
7,123457I a|12>3:1 13>4:1 14>5:1 15>6:1 16>7:1 23>5:1 24>6:1 25>7:a 34>7:1-a";

/// The names of all rows of a family; empty for a family without a table.
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
