#!/usr/bin/env bash
# Builds the wheel and the source distribution, installs the wheel in a fresh environment without Rust, and tests it there: types, tests,
# notebooks.
# PYTHON is the interpreter (3.11 or later), PROFILE the profile of cargo. AFFINOR_RAY=1 tests sweeps on Ray too.
# AFFINOR_COMMAND is the program to compare with, if it is built; WORKERS the number of processes of the tests;
# ENVIRONMENT a folder for the environment that is tested, which then stays.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-python3}
profile=${PROFILE:-dev}
work=$(mktemp -d)
environment=${ENVIRONMENT:-$work/test}
trap 'rm -rf "$work"' EXIT

step() {
    printf '\n== %s\n' "$*" >&2
    "$@"
}

# packages of the tests arrive while the wheel is built
extras=test
[ "${AFFINOR_RAY:-}" = 1 ] && extras=test,ray
step "$python" -m venv "$environment"
"$environment/bin/python" -m pip install --quiet $("$python" - "$extras" <<'PYTHON'
import re, sys, tomllib

project = tomllib.load(open("python/pyproject.toml", "rb"))["project"]

def packages(extra):
    for package in project["optional-dependencies"][extra]:
        own = re.fullmatch(r"affinor\[(.*)\]", package)
        yield from (p for name in own[1].split(",") for p in packages(name)) if own else [package]

names = [*project["dependencies"], *(p for extra in sys.argv[1].split(",") for p in packages(extra))]
print(*dict.fromkeys(names))
PYTHON
) >"$work/packages.txt" 2>&1 &
packages=$!

step "$python" -m venv "$work/build"
step "$work/build/bin/python" -m pip install --quiet "maturin>=1.9.4,<2"
export PYO3_PYTHON=${PYO3_PYTHON:-$("$python" -c 'import sys; print(sys.executable)')}
# the program, which the tests compare with: built together with the bindings, so that the engine is compiled once
command=${AFFINOR_COMMAND:-}
if [ -z "$command" ]; then
    step cargo build --locked --profile "$profile" -p affinor-cli --bin affinor -p affinor-python --lib
    folder=$profile
    [ "$profile" = dev ] && folder=debug
    command=${CARGO_TARGET_DIR:-$PWD/target}/$folder/affinor
fi
# the lock file holds; the wheel needs no build isolation
step "$work/build/bin/maturin" build --locked --profile "$profile" --manifest-path python/Cargo.toml \
    --interpreter "$python" --out "$work/dist"

# the source distribution has every package that it names
step "$work/build/bin/maturin" sdist --manifest-path python/Cargo.toml --out "$work/source"
tar -xzf "$work"/source/*.tar.gz -C "$work/source"
(cd "$work"/source/*/ && step cargo tree --offline -p affinor-python >"$work/tree.txt")

# a second environment without Rust, and tests away from the sources
wheel=$(echo "$work"/dist/*.whl)
wait "$packages" || { cat "$work/packages.txt" >&2; exit 1; }
step "$environment/bin/python" -m pip install --quiet "$wheel[$extras]"
here=$PWD
cd "$work"
run() {
    step env -u CARGO_HOME -u RUSTUP_HOME PATH="$environment/bin:/usr/bin:/bin" AFFINOR_COMMAND="$command" "$@"
}
# the command of the wheel is the program
run affinor compare >"$work/comparison.txt"
cmp "$work/comparison.txt" <("$command" compare)
cmp "$work/comparison.txt" <(run python -m affinor compare)
# types beside the tests: both wait much of their time
{
    run python -m mypy --config-file "$here/python/pyproject.toml"
    run python -m mypy.stubtest affinor --mypy-config-file "$here/python/pyproject.toml" \
        --allowlist "$here/python/stubtest.txt" --ignore-unused-allowlist
} >"$work/types.txt" 2>&1 &
types=$!
run timeout 1200 python -m pytest -q -n "${WORKERS:-2}" --dist loadgroup --durations=10 \
    -c "$here/python/pyproject.toml" --rootdir "$here/python" "$here/python/tests"
wait "$types" || { cat "$work/types.txt" >&2; exit 1; }
