//! Diagrams with labels.

use crate::representation::common::weight;
use affinor::representation::diagram::labelled;

#[test]
fn diagrams_have_the_labels_behind_the_numbers() {
    assert_eq!(labelled(&weight("A3", &[1, 0, 12])), "A3  1:1---2:0---3:12");
    assert_eq!(
        labelled(&weight("E6", &[1, 2, 3, 4, 5, 6])),
        "E6  1:1---3:3---4:4---5:5---6:6\n                |\n                2:2"
    );
    // the branch is below its node, whatever the lengths of the labels before it
    let d12 = labelled(&weight("D12", &[10, 0, 0, 0, 0, 0, 0, 0, 0, 7, 8, 9]));
    let lines: Vec<&str> = d12.lines().collect();
    assert_eq!(lines[0].find("10:7"), lines[1].find('|'));
    assert_eq!(lines[2].trim(), "12:9");
    assert_eq!(
        labelled(&weight("B2 + A1 + T2", &[1, 0, 3, -1, 4])),
        "B2  1:1==>2:0\nA1  1:3\ncharges -1, 4"
    );
    assert_eq!(labelled(&weight("T1", &[5])), "charge 5");
}
