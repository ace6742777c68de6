"""Every report as JSON obeys its schema in ``docs/schemas``, and the schema of tables refuses what is wrong."""

import copy
import json
import types

import jsonschema
import pytest
from test_command_line import ROOT, needs_command, run, spaces

import affinor as af

SCHEMAS = {
    path.name.removesuffix(".schema.json"): json.loads(path.read_text(encoding="utf-8"))
    for path in (ROOT / "docs" / "schemas").glob("*.json")
}
SCHEMA = SCHEMAS["table"]
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
SPACES = [
    ("so3", "--metric", "diag(a,b,c)"),
    ("so3", "--metric", "diag(a,b,c)", "--set", "a=1,b=2,c=3", "--scalar", "float"),
    ("se3", "--metric", "identity", "--connection", "levi-civita"),
    ("heisenberg(3)@lambda=h", "--metric", "identity"),
    ("heisenberg(3)@lambda=1/3", "--scalar", "float"),
    ("sl2@plus", "--metric", "killing", "--frame", "right"),
]
OPTIONS = [(), ("--independent",), ("--common-factors",)]


def written(*arguments):
    return json.loads(run("table", *arguments, "--show", "all", "--format", "json").stdout)


@pytest.mark.parametrize("name", sorted(SCHEMAS))
def test_the_schemas_are_schemas(name):
    jsonschema.Draft202012Validator.check_schema(SCHEMAS[name])
    assert SCHEMAS[name]["title"] == f"affinor.{name}/1"


def test_every_quantity_is_a_property():
    names = SCHEMA["properties"]["tensors"]["propertyNames"]["enum"]
    assert len(names) > 15
    for name in names:
        assert isinstance(getattr(af.Geometry, name), types.GetSetDescriptorType), name


@needs_command
@pytest.mark.parametrize("name", list(spaces()))
def test_catalogue(name):
    VALIDATOR.validate(written(name))


@needs_command
@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "definitions").glob("*.toml")), ids=lambda path: path.stem)
def test_definitions(path):
    VALIDATOR.validate(written(path))


@needs_command
@pytest.mark.parametrize("space", SPACES, ids=" ".join)
@pytest.mark.parametrize("options", OPTIONS, ids=" ".join)
def test_options(space, options):
    VALIDATOR.validate(written(*space, *options))


OF_SPACES = [
    ("check",),
    ("info",),
    ("properties",),
    ("properties", "--metric", "identity"),
    ("equations", "--metric", "identity"),
    ("equations", "--kind", "autoparallel"),
    ("equations", "--kind", "transport"),
]
STRUCTURES = ["so3", "so(3,1)", "sl(3)", "heisenberg(5)", "bianchi(VI)", "so3+R^3", "sl(2,C)", "u(2)", "[x,y]=z"]
OTHERS = [
    ("check", "[x,y]=z; [y,z]=y"),
    ("compare",),
    ("compare", "so3", "se3"),
    ("list",),
    ("list", "--where", "nilpotent"),
    ("conventions",),
    ("rep", "E8", "248"),
    ("rep", "SU(5)", "10", "--tensor", "5bar", "--power", "2", "--kind", "exterior"),
    ("rep", "SU(5)", "10", "--branch", "SU(3)xSU(2)xU(1)", "--weights"),
    ("rep", "SU(5)", "5bar", "--matrices"),
    ("rep", "G2", "7", "--matrices=all"),
    ("coupling", "1", "3/2"),
    ("coupling", "1", "2", "--real"),
    ("coupling", "1", "2", "2", "--symbol", "3j"),
    ("coupling", "1", "1", "1", "1", "1", "1", "--symbol", "6j"),
    ("claims", "so3", "examples/claims/so3.txt", "--metric", "diag(a,b,c)"),
    ("simulate", "examples/motions/heavy_top.toml"),
    ("equations", "examples/definitions/sphere.toml", "--kind", "autoparallel"),
    ("isometries", "examples/definitions/schwarzschild.toml"),
    ("isometries", "so3", "--metric", "identity", "--homothetic"),
    ("isometries", "minkowski", "--conformal", "--fields"),
    ("spacetime", "schwarzschild"),
    ("spacetime", "pp-wave"),
    ("forms", "reissner-nordstrom", "--form", "Q/r^2*dt^dr"),
    ("forms", "so3", "--form", "e1"),
    ("mobility", "examples/mechanisms/bricard.toml"),
    ("linearize", "examples/mechanisms/bicycle.toml"),
    ("hypersurface", "friedmann", "--function", "t"),
    ("hypersurface", "kerr", "--function", "t"),
    ("properties", "so3", "--metric", "diag(a,a,b)"),
    ("solve", "so3", "--metric", "diag(a,b,c)", "--for", "einstein"),
    ("solve", "so3", "--metric", "diag(1,p^3-1,q^2-1)", "--for", "einstein"),
    ("solve", "se2", "--metric", "diag(a,b,c)", "--for", "flat"),
]


@needs_command
@pytest.mark.parametrize(
    "arguments", [(first, space, *rest) for space in STRUCTURES for first, *rest in OF_SPACES] + OTHERS, ids=" ".join
)
def test_reports(arguments):
    of_files = [ROOT / word if word.startswith("examples/") else word for word in arguments]
    report = json.loads(run(*of_files, "--format", "json", ok=False).stdout)
    name = report["schema"].removeprefix("affinor.").removesuffix("/1")
    jsonschema.Draft202012Validator(SCHEMAS[name]).validate(report)


@needs_command
def test_verifications(tmp_path):
    stored = tmp_path / "table.json"
    stored.write_text(json.dumps(written("so3@zero")))
    for arguments in [("so3@zero", stored), ("so3@plus", stored), ("so3@zero", stored, stored)]:
        report = json.loads(run("verify", *arguments, "--format", "json", ok=False).stdout)
        jsonschema.Draft202012Validator(SCHEMAS["verify"]).validate(report)


def replaced(value, path, new):
    value = copy.deepcopy(value)
    *parents, last = path
    inside = value
    for key in parents:
        inside = inside[key]
    inside[last] = new
    return value


@needs_command
@pytest.mark.parametrize(
    ("path", "new"),
    [
        (["schema"], "affinor.table/2"),
        (["scalar"], "float"),  # its components are not texts
        (["tensors", "curvature", "components", 0, 1], 0.25),
        (["tensors", "curvature", "components", 0, 0, 0], 0),  # indices count from 1
        (["tensors", "curvature", "indices", 0], "sideways"),
        (["tensors", "nothing"], {}),
        (["conventions", "frame"], "no frame"),
        (["algebra"], {"name": "so(3)"}),
    ],
)
def test_what_is_wrong(path, new):
    table = written("so3@zero")
    VALIDATOR.validate(table)
    assert not VALIDATOR.is_valid(replaced(table, path, new))
