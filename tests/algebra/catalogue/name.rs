//! Names that the catalogue accepts, and invalid names with their error messages.

use affinor::algebra::catalogue;
use affinor::algebra::catalogue::{CatalogueError, MAX_DIMENSION};

/// The full name, and other ways to write it.
const READ: &str = "\
so(3) <- so(3)|so3| so ( 3 ) |so 3|so\t3
so(5) <- so5
so(10) <- so10
so(3,1) <- so(3,1)|so( 3 , 1 )|so3,1|so (3,1)
R^3 <- R^3|R3|R ^ 3|R(3)|R^(3)|R 3
R^12 <- R12
su(3) <- su3|su(3)
su(2,1) <- su(2,1)
sl(2) <- sl(2,R)
sl(2,C) <- sl(2,C)|sl( 2 , C )
sl(2,H) <- sl(2,H)
so*(6) <- so*(6)|so*6
sp(2,1) <- sp(2,1)
sp(4,C) <- sp(4,C)
usp(4) <- usp4
u(3) <- u3
iso(3,1) <- iso(3,1)
filiform_q(6) <- filiform_q(6)
filiform(5) <- filiform5
free_nilpotent(2,3) <- free_nilpotent(2,3)
compact(E8) <- compact(E8)|compactE8
borel(E6) <- borel(E6)|borel E6
parabolic(E7,1,7) <- parabolic(E7,7,1)
patera(4,5,a=1/2,b=b) <- patera(4,5,b=b,a=1/2)
patera(4,11) <- patera(4,11)
degraaf(6,22,e=-1) <- degraaf(6,22,e=-1)
sl(12) <- sl12|sl( 12)
gl(2) <- gl2
sp(6) <- sp(6)|sp6
se(3) <- se3|se(3)
heisenberg(5) <- heisenberg(5)|heisenberg5|heisenberg 5
aff(1) <- aff1|aff(1)
A2 <- A2|A(2)|A 2
A12 <- A12
D4 <- D4
E8 <- E8
G2 <- G2
bianchi(IX) <- bianchi(IX)|bianchiIX|bianchi IX
bianchi(VI) <- bianchi(VI)|bianchiVI
bianchi(VII) <- bianchi(VII)
bianchi(VI,h=-1/2) <- bianchi(VI,h=-1/2)|bianchi( VI , h = -0.5 )|bianchi VI,h=-1/2
bianchi(VI,h=32) <- bianchi(VI,h=2*(1+3)^2)
bianchi(VI,h=h) <- bianchi(VI,h=h)
bianchi(VII,h=b*c) <- bianchi(VII,h=b*c)|bianchi(VII,h=c*b)
bianchi(VII,h=(a + 1)/b) <- bianchi(VII,h=(1+a)/b)";

#[test]
fn names_that_are_read() {
    for row in READ.lines() {
        let (name, written) = row.split_once(" <- ").unwrap();
        for written in written.split('|').chain([name]) {
            let entry = catalogue::find(written);
            let entry = entry.unwrap_or_else(|error| panic!("{written}: {error}"));
            assert_eq!(entry.name, name, "{written}");
        }
    }
}

/// The error variant, a part of the message, and names.
const REFUSED: &str = "\
ambiguous; so(31) or so(3,1); so31|so 31
ambiguous; so(11) or so(1,1); so11
ambiguous; so(123) or so(1,23) or so(12,3); so123
ambiguous; so(99) or so(9,9); so99
incomplete; so(3) or so(3,1); so|so()|so( )
incomplete; heisenberg(3); heisenberg
incomplete; bianchi(IX); bianchi
incomplete; R^3; R|R^
incomplete; E8; E
unknown; nearest is so(4); SO(4)|So4|os(4)|sox(4)
unknown; nearest is so(3,1) or so(31); SO31
unknown; nearest is su(3); Su(3)|SU3
unknown; nearest is E8; e8
unknown; nearest is R^3; r3
unknown; nearest is heisenberg(7); heisenburg(7)|Heisenberg7
unknown; nearest is bianchi(IV); Bianchi(IV)
unknown; no algebra named; foo(3)||3|(3)|+|,|\u{17f}o3|é
none; n >= 2; so(0)|so(1)|so(-3)|so(3.5)|so(03)|so(n)|so(+3)|se(1)|su(1)|B1
none; p, q >= 1; so(3,0)|so(0,3)|so(1,2,3)
none; so(n) needs; so(3,)|so(,)|so(\u{663})|so 3 1|so^3|so3)|so3x
none; even; sp(5)|sp(0)
none; odd; heisenberg(4)|heisenberg(1)
none; n >= 1; R^0|R^-1|A0|gl(0)
none; n >= 1; aff(0)|aff(-1)
none; p, q >= 1; su(2,0)|so(3,R)
none; n >= 2; sl(2,Q)
none; n = 6, 7, 8; E5|E9
none; n >= 3; D2
none; n = 2; G3
none; n = 4; F5
none; I to IX; bianchi9|bianchi(ix)|bianchi(X)|bianchi(,)|bianchix(IX)
none; VI and VII only; bianchi(IX,h=1)
none; h=v; bianchi(VI,1)|bianchi(VI,a=1)|bianchi(VI,h=1,h=2)|bianchi(VI,)
large; 2048; so(65)|so(33,32)|R^2049|su(46)|sl(46)|gl(46)|sp(64)|se(64)|heisenberg(2049)|A45|B32
large; 2048; so(99999999999999999999)|so99999999999999999999|E99999999999999999999
large; 2048; so(18446744073709551615)|so(18446744073709551615,18446744073709551615)
large; 2048; sp(18446744073709551614)|se(18446744073709551615)|su(18446744073709551615)
malformed; not closed; so(3|bianchi(VI,h=(1)|so((3)
malformed; nothing is expected; so(3))|so(3)x|so(3)+R^3|so()3
value; ends where a value; bianchi(VI,h=)
value; division by zero; bianchi(VI,h=1/0)|bianchi(VI,h=1/(a-a))
value; `*`; bianchi(VI,h=2x)";

#[test]
fn names_that_are_refused() {
    use CatalogueError::*;
    let variant = |error: &CatalogueError| match error {
        Unknown { .. } => "unknown",
        Ambiguous { .. } => "ambiguous",
        Incomplete { .. } => "incomplete",
        NoSuchAlgebra { .. } => "none",
        TooLarge { .. } => "large",
        Malformed { .. } => "malformed",
        Value { .. } => "value",
        _ => "other",
    };
    for row in REFUSED.lines() {
        let [expected, says, names] = row.splitn(3, "; ").collect::<Vec<_>>().try_into().unwrap();
        for name in names.split('|') {
            let Err(error) = catalogue::find(name) else { panic!("{name} is read") };
            let message = error.to_string();
            assert_eq!(variant(&error), expected, "{name}: {message}");
            assert!(message.contains(says), "{name}: {message}");
        }
    }
}

#[test]
fn messages_have_no_control_characters() {
    let tails = ["", "(3)", "(", "(3)x", "(VI,h=\u{7})", "(IX)", "31", "99999999999999999999"];
    for head in ["\u{1b}[31m", "so\u{1b}", "so\n", "\r\nbianchi", "R^\u{7}", "E\t"] {
        for tail in tails {
            if let Err(error) = catalogue::find(&format!("{head}{tail}")) {
                let message = error.to_string();
                assert!(!message.contains(char::is_control), "{message:?}");
            }
        }
    }
}

#[test]
fn a_wrong_value_is_found_in_the_whole_name() {
    let name = "  bianchi( VI, h = 1 + 2/0 )";
    let Err(CatalogueError::Value { source, .. }) = catalogue::find(name) else { panic!("{name}") };
    assert_eq!(&name[source.span], "0");
}

#[test]
fn hostile_names_are_refused_at_once() {
    let [digits, open, letters] = ["7", "(", "s"].map(|symbol| symbol.repeat(100_000));
    let names = [
        format!("so{digits}"),
        format!("so({digits})"),
        format!("so({digits},{digits})"),
        format!("so{open}"),
        format!("bianchi(VI,h={open}"),
        format!("bianchi(VI,h={open}1{})", ")".repeat(100_000)),
        format!("bianchi(VI,h={digits})"),
        "bianchi(VI,h=(9^999)^999)".into(),
        "bianchi(VI,h=(a+b)^9999)".into(),
        digits,
        letters,
    ];
    for name in names {
        assert!(catalogue::find(&name).is_err());
    }
}

#[test]
fn the_largest_of_a_family_stays_within_the_limit() {
    assert_eq!(catalogue::find(&format!("R^{MAX_DIMENSION}")).unwrap().dimension(), MAX_DIMENSION);
    assert_eq!(catalogue::find("A44").unwrap().dimension(), 45 * 45 - 1);
}

#[test]
fn no_names_beyond_the_limit() {
    for dimension in [0, MAX_DIMENSION + 1, usize::MAX - 1, usize::MAX] {
        assert_eq!(catalogue::names(dimension), [""; 0], "{dimension}");
    }
}
