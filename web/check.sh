#!/usr/bin/env bash
# Builds the page, holds it to its size, and tests it in Chromium; where there is no Chromium and none can be installed, it says so.
# PROFILE is the profile of cargo, CHROMIUM the browser. AFFINOR_COMMAND is the program to compare with, which is built otherwise,
# AFFINOR_PYTHON a Python with the package `affinor`, for the copies as Python.
set -euo pipefail
cd "$(dirname "$0")"

step() {
    printf '\n== %s\n' "$*"
    "$@"
}

step cargo run -p affinor-web-build
if ! command -v npm >/dev/null; then
    printf '\n== skipped: the size of the page, and the page in a browser, for there is no Node with npm\n'
    exit
fi

CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
if [ -z "$CHROMIUM" ] && [ "$(id -u)" = 0 ] && step apt-get update -qq && step apt-get install -y -qq chromium; then
    CHROMIUM=$(command -v chromium)
fi
export CHROMIUM

# a copy in Python prints the report
python=${AFFINOR_PYTHON:-$(command -v python3 || true)}
if [ -n "$python" ] && "$python" -c 'import affinor' 2>/dev/null; then
    # from the root, where it is built already
    (cd .. && step env AFFINOR_PYTHON="$python" cargo test --test main python_prints_the_report)
else
    printf '\n== skipped: copies as Python, for AFFINOR_PYTHON names no Python with the package affinor\n'
fi

if [ -z "$CHROMIUM" ]; then
    step node --test tests/engine-size.test.mjs
    printf '\n== skipped: the page in a browser, for there is no Chromium, and it cannot be installed\n'
    exit
fi
if [ -z "${AFFINOR_COMMAND:-}" ]; then
    (cd .. && step cargo build)
    export AFFINOR_COMMAND=${CARGO_TARGET_DIR:-$PWD/../target}/debug/affinor
fi
step npm ci --no-audit --no-fund
step npm test
