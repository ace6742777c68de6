//! Invalid robots in URDF, and tables that do not fit to the robot.

use crate::bad_input::case::{Case, MATHEMATICS, USAGE, refuse};

const HEAD: &str = "coordinates = \"joints\"\nurdf = \"arm.urdf\"\n";
const OUTPUT: &str = "output = { end = 1, every = 0.5 }\n";

const ROBOT: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <mass value="2"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.2"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 1 0"/>
  </joint>
</robot>
"#;

/// Runs the robot with a text replaced, and expects an error.
fn robots(status: i32, rows: &[(&str, &str, &[&str])]) {
    let input = format!("{HEAD}{OUTPUT}");
    let files: Vec<String> = rows
        .iter()
        .map(|(old, new, _)| {
            assert!(ROBOT.contains(old), "{old}");
            ROBOT.replacen(old, new, 1)
        })
        .collect();
    refuse(rows.iter().zip(&files).map(|((_, name, says), file)| Case {
        name,
        arguments: &["simulate", "-"],
        file: Some(("arm.urdf", file.as_bytes())),
        input: input.as_bytes(),
        status,
        says,
    }));
}

/// Runs the robot with keys of the file that names it, and expects an error.
fn tables(rows: &[(&str, &[&str])]) {
    let inputs: Vec<String> =
        rows.iter().map(|(keys, _)| format!("{HEAD}{keys}\n{OUTPUT}")).collect();
    refuse(rows.iter().zip(&inputs).map(|((name, says), input)| Case {
        name,
        arguments: &["simulate", "-"],
        file: Some(("arm.urdf", ROBOT.as_bytes())),
        input: input.as_bytes(),
        status: USAGE,
        says,
    }));
}

#[test]
fn links() {
    robots(
        USAGE,
        &[
            (
                "<child link=\"upper\"/>",
                "<child link=\"uper\"/>",
                &["arm.urdf:11:18", "there is no link `uper`", "did you mean `upper`?"],
            ),
            (
                "<child link=\"upper\"/>",
                "",
                &["arm.urdf:9:3", "joint `shoulder` has no element <child>", "<child link="],
            ),
            (
                "<link name=\"base\"/>",
                "<link name=\"base\"/><link name=\"stand\"/>",
                &["arm.urdf:2:", "two root links, `base` and `stand`", "give a joint"],
            ),
            (
                "</robot>",
                "<joint name=\"back\" type=\"fixed\"><parent link=\"upper\"/><child link=\"base\"/></joint></robot>",
                &[
                    "arm.urdf:14:",
                    "form a cycle",
                    "`upper`",
                    "`base`",
                    "close the loop by [[joints]]",
                ],
            ),
            (
                "</robot>",
                "<joint name=\"again\" type=\"fixed\"><parent link=\"base\"/><child link=\"upper\"/></joint></robot>",
                &["arm.urdf:14:14", "child of two joints, the first is `shoulder`", "[[joints]]"],
            ),
            (
                "<link name=\"base\"/>",
                "<link name=\"upper\"/>",
                &["arm.urdf:3:15", "two links have the name `upper`", "another name"],
            ),
            (
                "<link name=\"base\"/>",
                "<link/>",
                &["arm.urdf:2:3", "no attribute `name`", "<link name="],
            ),
        ],
    );
}

#[test]
fn masses() {
    robots(
        MATHEMATICS,
        &[
            (
                "value=\"2\"",
                "value=\"-2\"",
                &[
                    "arm.urdf:5:20",
                    "link `upper`",
                    "the mass is -2, which is not positive",
                    "give a positive mass",
                ],
            ),
            (
                "ixx=\"0.1\"",
                "ixx=\"0.5\"",
                &[
                    "arm.urdf:6:7",
                    "link `upper`",
                    "triangle inequality",
                    "at most the sum of the other two",
                ],
            ),
            ("value=\"2\"", "value=\"0\"", &["arm.urdf:5:20", "the mass is 0"]),
        ],
    );
    robots(
        USAGE,
        &[
            (
                "ixx=\"0.1\"",
                "ixx=\"nan\"",
                &["arm.urdf:6:21", "`nan` is not finite", "decimal number"],
            ),
            ("ixx=\"0.1\" ", "", &["arm.urdf:6:7", "<inertia> has no attribute `ixx`"]),
            ("ixx=\"0.1\"", "ixx=\"${m/12}\"", &["arm.urdf:6:21", "is not a number", "xacro"]),
            ("<mass value=\"2\"/>", "", &["arm.urdf:4:5", "<inertial> has no element <mass>"]),
        ],
    );
}

#[test]
fn joints() {
    robots(
        USAGE,
        &[
            (
                "type=\"revolute\"",
                "type=\"revolut\"",
                &["arm.urdf:9:32", "no joint of the type `revolut`", "did you mean `revolute`?"],
            ),
            (
                "type=\"revolute\"",
                "type=\"ball\"",
                &["the types are revolute, continuous, prismatic, fixed, floating, planar"],
            ),
            (
                "xyz=\"0 1 0\"",
                "xyz=\"0 0 0\"",
                &["arm.urdf:12:5", "the axis of joint `shoulder` has length zero", "<axis xyz="],
            ),
            (
                "xyz=\"0 1 0\"",
                "xyz=\"0 1\"",
                &["arm.urdf:12:16", "2 numbers instead of 3", "xyz=\"0 0 1\""],
            ),
            ("xyz=\"0 1 0\"", "xyz=\"0 inf 0\"", &["arm.urdf:12:16", "`inf` is not finite"]),
            (
                "<axis xyz=\"0 1 0\"/>",
                "<mimic joint=\"elbow\"/>",
                &["arm.urdf:12:5", "joint `shoulder` mimics another joint", "leave <mimic> out"],
            ),
            (
                "<axis xyz",
                "<axes xyz",
                &["arm.urdf:12:5", "no element <axes>", "did you mean `axis`?"],
            ),
            (
                "<axis xyz=\"0 1 0\"/>",
                "<axis xyz=\"0 1 0\"/><axis xyz=\"1 0 0\"/>",
                &["arm.urdf:12:24", "two elements <axis>"],
            ),
        ],
    );
}

#[test]
fn files() {
    robots(
        USAGE,
        &[
            ("</robot>\n", "", &["arm.urdf is not valid XML", "<robot name="]),
            ("</link>", "</robot>", &["arm.urdf:8:", "not valid XML", "expected 'link'"]),
            (ROBOT, "solid cube", &["arm.urdf:1:1", "not valid XML"]),
            (
                ROBOT,
                "<sdf version=\"1.6\"/>",
                &["arm.urdf:1:1", "<sdf> is not the element of a robot"],
            ),
            (ROBOT, "<robot name=\"a\"/>", &["arm.urdf:1:1", "the robot has no links"]),
            (
                "<link name=\"base\"/>",
                "<xacro:link name=\"a\"/>",
                &["arm.urdf:2:", "xacro robot.xacro"],
            ),
        ],
    );
    let input = format!("{HEAD}{OUTPUT}").replace("arm.urdf", "leg.urdf");
    refuse([Case {
        name: "a missing file",
        arguments: &["simulate", "-"],
        file: None,
        input: input.as_bytes(),
        status: USAGE,
        says: &["<standard input>:2:9", "cannot read leg.urdf", "relative to the folder"],
    }]);
}

#[test]
fn tables_that_do_not_fit() {
    tables(&[
        (
            "joints = [{ name = \"elbow\", rate = 1 }]",
            &[":3:21", "arm.urdf has no joint `elbow`", "a joint of the robot: shoulder"],
        ),
        (
            "joints = [{ name = \"shoulder\", axis = [1, 0, 0] }]",
            &[":3:32", "`axis` of the joint `shoulder` is given by arm.urdf", "leave the key out"],
        ),
        (
            "joints = [{ name = \"shoulder\", rate = 1 }, { name = \"shoulder\", rate = 1 }]",
            &["two tables describe the joint `shoulder`"],
        ),
        ("joints = [{ rate = 1 }]", &[":3:", "has no `bodies`", "name the two bodies"]),
        (
            "bodies = [{ name = \"upper\", fixed = true }]",
            &[":3:21", "two bodies have the name `upper`"],
        ),
        ("space = \"so3\"", &[":3:1", "has no `space`"]),
    ]);
}

/// Without joint coordinates, each moving body needs a mass, and dampers are not supported.
#[test]
fn poses_and_constraints() {
    let tool = "<link name=\"tool\"/><joint name=\"mount\" type=\"fixed\"><parent link=\"upper\"/>\
                <child link=\"tool\"/></joint></robot>";
    let massless = ROBOT.replace("</robot>", tool);
    let damped = ROBOT.replace("<axis", "<dynamics damping=\"0.5\"/><axis");
    let input = format!("coordinates = \"poses\"\nurdf = \"arm.urdf\"\n{OUTPUT}");
    let expected: [(&str, &[&str]); 2] = [
        (
            &massless,
            &["arm.urdf:14:", "the moving link `tool` has no mass", "coordinates = \"poses\" out"],
        ),
        (&damped, &["arm.urdf", "damping of joint `shoulder`", "coordinates = \"poses\" out"]),
    ];
    refuse(expected.iter().map(|(file, says)| Case {
        name: "poses",
        arguments: &["simulate", "-"],
        file: Some(("arm.urdf", file.as_bytes())),
        input: input.as_bytes(),
        status: USAGE,
        says,
    }));
}
