//! Files that are not text or have another encoding, and missing files.

use crate::bad_input::case::{Case, USAGE, commands, refuse};
use crate::program::run;
use std::fs;
use tempfile::TempDir;

const PLANE: &str = "basis = ['x', 'y']\nbrackets = '[x, y] = x'\n";

fn refuse_bytes(name: &str, content: &[u8], says: &[&str]) {
    let arguments = ["table", "a.toml"];
    let file = Some(("a.toml", content));
    refuse([Case { name, arguments: &arguments, file, input: b"", status: USAGE, says }]);
    // standard input is read in the same way
    let says: Vec<String> = says.iter().map(|s| s.replace("a.toml", "<standard input>")).collect();
    let says: Vec<&str> = says.iter().map(String::as_str).collect();
    let arguments = ["check", "-"];
    let status = USAGE;
    refuse([Case { name, arguments: &arguments, file: None, input: content, status, says: &says }]);
}

#[test]
fn not_utf_8() {
    let utf_16 = |bom: char, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        format!("{bom}{PLANE}").encode_utf16().flat_map(bytes).collect()
    };
    let little = utf_16('\u{feff}', u16::to_le_bytes);
    let big = utf_16('\u{feff}', u16::to_be_bytes);
    refuse_bytes(
        "UTF-16, little end first",
        &little,
        &["a.toml is encoded in UTF-16", "save the file as UTF-8"],
    );
    refuse_bytes(
        "UTF-16, big end first",
        &big,
        &["a.toml is encoded in UTF-16", "save the file as UTF-8"],
    );
    let rubbish: Vec<u8> = (0..4096u32).map(|i| (i * 167 + 201) as u8).collect();
    refuse_bytes("rubbish", &rubbish, &["a.toml is not text: byte 1 is not UTF-8"]);
    let latin = b"basis = ['x', 'y']\n# caf\xe9\nbrackets = ''";
    refuse_bytes("Latin-1", latin, &["a.toml is not text: byte 25 is not UTF-8"]);
    refuse_bytes("zeros", &[0; 1000], &["a.toml:1:1"]);
    refuse_bytes("a program", b"\x7fELF\x02\x01\x01", &["a.toml:1:"]);
    refuse_bytes("nothing", b"", &["a.toml is empty"]);
}

#[test]
fn other_texts_are_read() {
    let dos = PLANE.replace('\n', "\r\n");
    let block = "basis = ['x', 'y']\r\nbrackets = \"\"\"\r\n[x, y] = x # both\r\n\"\"\"\r\n";
    let bom = format!("\u{feff}{PLANE}");
    let json = "\u{feff}{\"basis\": [\"x\", \"y\"],\r\n \"brackets\": \"[x, y] = x\"}\r\n";
    for text in [PLANE, &dos, block, &bom, json] {
        let folder = TempDir::new().unwrap();
        let name = if text.contains('{') { "a.json" } else { "a.toml" };
        fs::write(folder.path().join(name), text).unwrap();
        let arguments = ["table", name, "--show", "structure", "--format", "csv"];
        let outcome = run(folder.path(), &arguments, b"");
        assert_eq!(outcome.status, 0, "{text:?}: {}", outcome.err);
        let rows = "tensor,i,j,k,l,value\nstructure,1,1,2,,1\nstructure,1,2,1,,-1\n";
        assert_eq!(outcome.out, rows, "{text:?}");
    }
}

#[test]
fn not_there() {
    commands(&[]).usage(&[
        ("table no.toml", &["cannot read no.toml", "No such file"]),
        ("table no/such.json", &["cannot read no/such.json", "No such file"]),
        ("table ./", &["cannot read ./", "Is a directory"]),
        ("table .", &["no algebra named `.`"]),
        ("check /dev/null", &["/dev/null is empty"]),
        ("check /dev/zero", &["/dev/zero has more than"]),
        ("verify so3 no.json", &["cannot read no.json", "No such file"]),
        ("verify so3 .", &["the folder . has no .json or .csv file"]),
        ("verify so3 /dev/null", &["/dev/null", "the header is not"]),
    ]);
}

#[cfg(unix)]
#[test]
fn links_and_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    symlink("loop.toml", at("loop.toml")).unwrap();
    let outcome = run(folder.path(), &["table", "loop.toml"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("cannot read loop.toml: "), "{}", outcome.err);
    symlink("nowhere.toml", at("broken.toml")).unwrap();
    let outcome = run(folder.path(), &["table", "broken.toml"], b"");
    assert_eq!(outcome.status, 2);
    assert!(outcome.err.contains("cannot read broken.toml: "), "{}", outcome.err);

    fs::write(at("secret.toml"), PLANE).unwrap();
    fs::set_permissions(at("secret.toml"), fs::Permissions::from_mode(0o000)).unwrap();
    // the user root can read every file
    if fs::read(at("secret.toml")).is_err() {
        let outcome = run(folder.path(), &["table", "secret.toml"], b"");
        assert_eq!(outcome.status, 2);
        let refused = "cannot read secret.toml: Permission denied";
        assert!(outcome.err.contains(refused), "{}", outcome.err);
    }
}
