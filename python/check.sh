#!/usr/bin/env bash
# Builds the wheel, installs it in a fresh environment without Rust, and tests it there: types, tests, notebooks.
# PYTHON is the interpreter (3.11 or later), PROFILE the profile of cargo. AFFINOR_RAY=1 tests sweeps on Ray too.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-python3}
profile=${PROFILE:-dev}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

step() {
    printf '\n== %s\n' "$*" >&2
    "$@"
}

# the program, which the tests compare with; `cargo test` has built it
step cargo build -p affinor-cli --bin affinor
command=${CARGO_TARGET_DIR:-$PWD/target}/debug/affinor

step "$python" -m venv "$work/build"
step "$work/build/bin/python" -m pip install --quiet "maturin>=1.9.4,<2"
export PYO3_PYTHON=${PYO3_PYTHON:-$("$python" -c 'import sys; print(sys.executable)')}
# the lock file holds; the wheel needs no build isolation
step "$work/build/bin/maturin" build --locked --profile "$profile" --manifest-path python/Cargo.toml \
    --interpreter "$python" --out "$work/dist"

# a second environment without Rust, and tests away from the sources
wheel=$(echo "$work"/dist/*.whl)
extras=test
[ "${AFFINOR_RAY:-}" = 1 ] && extras=test,ray
step "$python" -m venv "$work/test"
step "$work/test/bin/python" -m pip install --quiet "$wheel[$extras]"
here=$PWD
cd "$work"
run() {
    step env -u CARGO_HOME -u RUSTUP_HOME PATH="$work/test/bin:/usr/bin:/bin" AFFINOR_COMMAND="$command" "$@"
}
run python -m affinor >"$work/comparison.txt"
cmp "$work/comparison.txt" <("$command" compare)
run python -m mypy --config-file "$here/python/pyproject.toml"
run python -m mypy.stubtest affinor --mypy-config-file "$here/python/pyproject.toml"
run timeout 1200 python -m pytest -q -c "$here/python/pyproject.toml" --rootdir "$here/python" "$here/python/tests"
