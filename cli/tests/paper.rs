//! `affinor paper`: the document as the program writes it, with its figures.

use crate::program::{root, stdout};
use std::collections::BTreeSet;

/// The page is well-formed, its links lead to its own elements, and it does not load external
/// resources.
#[test]
fn html_stands_alone() {
    let text = stdout(root(), &["paper"]);
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&text, options).unwrap();
    let elements = || document.descendants().filter(|node| node.is_element());
    let mut ids = BTreeSet::new();
    for id in elements().filter_map(|node| node.attribute("id")) {
        assert!(ids.insert(id), "{id} stands twice");
    }
    for node in elements() {
        let name = node.tag_name().name();
        assert!(!["script", "link", "iframe", "img"].contains(&name), "{name}");
        assert!(node.attribute("src").is_none(), "{name}");
        if let Some(link) = node.attribute("href") {
            let id = link.strip_prefix('#').unwrap_or_else(|| panic!("{link} is elsewhere"));
            assert!(ids.contains(id), "{link} leads nowhere");
        }
    }
    assert!(!text.contains("@import") && !text.contains("url("));
    let count = |name: &str| elements().filter(|node| node.tag_name().name() == name).count();
    assert_eq!((count("h1"), count("main")), (1, 1));
    assert_eq!(count("figure"), 5);
    assert!(count("math") > 300);
}
