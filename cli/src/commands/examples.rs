//! Examples of the commands. The help shows them, and a test runs them.

use clap::Command;

/// For each command, two examples, which run in the root folder of the project.
const EXAMPLES: [(&str, [&str; 2]); 30] = [
    ("compare", ["affinor compare", "affinor compare so3@plus aff1@plus --format markdown"]),
    (
        "table",
        [
            "affinor table so3 --metric \"diag(a,b,c)\" --show ricci",
            "affinor table \"[x,y]=z\" --connection plus --format latex",
        ],
    ),
    (
        "check",
        [
            "affinor check \"[t,x]=x, [t,y]=-y\"",
            "affinor check examples/definitions/schwarzschild.toml",
        ],
    ),
    ("verify", ["affinor verify so3@zero table.json", "affinor verify so3@zero tables --all"]),
    (
        "claims",
        [
            "affinor claims so3 examples/claims/so3.txt --metric \"diag(a,b,c)\"",
            "affinor claims aff1 claims.txt --metric identity",
        ],
    ),
    ("info", ["affinor info \"so(3,1)+heisenberg(3)\"", "affinor info \"[x,y]=z\" --format json"]),
    (
        "properties",
        [
            "affinor properties aff1 --metric identity",
            "affinor properties \"heisenberg(3)\" --metric \"diag(a,b,c)\"",
        ],
    ),
    (
        "isometries",
        [
            "affinor isometries examples/definitions/schwarzschild.toml",
            "affinor isometries \"heisenberg(3)\" --metric \"diag(a,b,c)\" --homothetic",
        ],
    ),
    (
        "spacetime",
        [
            "affinor spacetime schwarzschild",
            "affinor spacetime kerr --tetrad \"(r^2+a^2)*d_t+a*d_phi, d_r\"",
        ],
    ),
    (
        "forms",
        [
            "affinor forms reissner-nordstrom --form \"Q/r^2*dt^dr\"",
            "affinor forms sphere --form \"cos(theta)\"",
        ],
    ),
    (
        "hypersurface",
        [
            "affinor hypersurface schwarzschild --function r",
            "affinor hypersurface friedmann --function t",
        ],
    ),
    (
        "solve",
        [
            "affinor solve so3 --metric \"diag(a,b,c)\" --for einstein",
            "affinor solve \"[x,y]=p*y,[x,z]=q*z\" --metric identity --for constant-curvature",
        ],
    ),
    (
        "rep",
        [
            "affinor rep \"SU(5)\" 10 --tensor 5bar",
            "affinor rep \"SU(5)\" 10 --branch \"SU(3)xSU(2)xU(1)\" --format json",
        ],
    ),
    ("coupling", ["affinor coupling 1 1/2", "affinor coupling 1 1 1 --real --format json"]),
    (
        "equations",
        [
            "affinor equations so3 --metric \"diag(a,b,c)\"",
            "affinor equations aff1 --kind autoparallel --metric identity",
        ],
    ),
    ("exp", ["affinor exp so3 0,0,pi/2", "affinor exp se3 0,0,pi/2,1,0,0 --format csv"]),
    (
        "log",
        [
            "affinor log so3 \"0,-1,0,1,0,0,0,0,1\"",
            "affinor log so3 --restore \"0,-1,0,1,0,0,0,0,0.9999\"",
        ],
    ),
    (
        "compose",
        ["affinor compose so3 0,0,pi/2,pi/2,0,0", "affinor compose \"heisenberg(3)\" 1,0,0,0,1,0"],
    ),
    ("adjoint", ["affinor adjoint so3 0,0,pi/2", "affinor adjoint se3 0,0,pi/2,1,0,0"]),
    (
        "transport",
        [
            "affinor transport so3 --along 0,0,pi --connection zero",
            "affinor transport so3 --along 0,0,180 --degrees 1,0,0",
        ],
    ),
    (
        "geodesic",
        [
            "affinor geodesic sphere --set R=1 --from pi/2,0 --to pi/3,1",
            "affinor geodesic so3 --metric \"diag(1,2,3)\" --from 0,0,0 --to 0.3,1,-0.5",
        ],
    ),
    (
        "mobility",
        [
            "affinor mobility examples/mechanisms/bricard.toml",
            "affinor mobility examples/mechanisms/bennett.toml --format json",
        ],
    ),
    (
        "linearize",
        [
            "affinor linearize examples/mechanisms/bicycle.toml --set v=5",
            "affinor linearize examples/mechanisms/double_pendulum.toml --format json",
        ],
    ),
    (
        "convert",
        [
            "affinor convert --from ZYX --to matrix --degrees 90,0,0",
            "affinor convert --from quaternion --order xyzw --to vector 0,0,1,0",
        ],
    ),
    (
        "simulate",
        [
            "affinor simulate examples/motions/heavy_top.toml",
            "affinor simulate examples/motions/heavy_top.toml --method rkmk4 --step 0.001",
        ],
    ),
    (
        "plot",
        [
            "affinor plot animation examples/motions/precessing_top.toml -o top.svg",
            "affinor plot dynkin E8 -o E8.svg",
        ],
    ),
    ("paper", ["affinor paper -o paper.html", "affinor paper --format markdown -o paper.md"]),
    ("list", ["affinor list heis", "affinor list --where \"dimension=4, nilpotent\""]),
    ("conventions", ["affinor conventions", "affinor conventions --format latex"]),
    ("completions", ["affinor completions bash", "affinor completions zsh"]),
];

/// Adds the examples to the end of the help of each command.
pub fn with_examples(program: Command) -> Command {
    EXAMPLES.into_iter().fold(program, |program, (name, [first, second])| {
        let text = format!("Examples:\n  {first}\n  {second}");
        program.mut_subcommand(name, |command| command.after_help(text))
    })
}
