"""Tables as JSON obey ``docs/table.schema.json``, and the schema refuses what is wrong."""

import copy
import json
import types

import jsonschema
import pytest
from test_command_line import ROOT, needs_command, run, spaces

import affinor as af

SCHEMA = json.loads((ROOT / "docs" / "table.schema.json").read_text(encoding="utf-8"))
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


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


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
        (["scalar"], "float"),  # its components are no texts
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
