//! Tables of structure constants with one damaged character: the readers never panic.

use affinor_documents::space::Definition;

const TABLES: [&str; 12] = [
    "tensor,i,j,k,l,value\nstructure,3,1,2,,\"1/2\"\n",
    "j,k,i,value\n1,2,3,a^2\n",
    "3 1 2 1\n",
    "{\"schema\": \"affinor.table/1\", \"algebra\": {\"basis\": [\"x\", \"y\"]}, \"tensors\": {\"structure\": {\"components\": [[[2,1,2],\"1\"]]}}}",
    "T := EmptySCTable( 3, 0 );\nSetEntrySCTable( T, 1, 2, [ 1, 3 ] );",
    "L := LieAlgebraData([\n  [x, y] = Pi*z\n], [x, y, z], Alg):",
    "L := _DG([[\"LieAlgebra\", Alg1, [3]], [[[1, 2, 1], 1]]]);",
    "L.<x,y,z> = LieAlgebra(QQ, {('x','y'): {'z': QQ('1/2')}}, names='x,y,z')",
    "{(\"ω\",'y'): {'z': 1}}",
    "(0^2,12,-a*1.3,{1,4} − 2·23)",
    "[x, y] = z, [y, z] = -a*x;[z, x] = y # ω",
    "basis: x, y, ω\n[x, y] = ω",
];

#[test]
fn damaged_tables_do_not_panic() {
    for table in TABLES {
        assert!(Definition::parse("table", table).is_ok(), "{table}");
        let boundaries: Vec<usize> = table.char_indices().map(|(at, _)| at).collect();
        for (at, symbol) in table.char_indices() {
            let behind = &table[at + symbol.len_utf8()..];
            drop(Definition::parse("table", &table[..at]));
            drop(Definition::parse("table", &table[at..]));
            for inserted in [
                "",
                "ω",
                "(",
                ")",
                "'",
                "\"",
                ",",
                "{",
                "}",
                "[",
                "]",
                "-",
                "\n",
                "9999999999999999999999",
            ] {
                drop(Definition::parse("table", &format!("{}{inserted}{behind}", &table[..at])));
            }
            for other in boundaries.iter().filter(|other| **other > at).step_by(7) {
                drop(Definition::parse("table", &format!("{}{}", &table[..at], &table[*other..])));
            }
        }
    }
}
