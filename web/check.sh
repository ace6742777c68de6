#!/usr/bin/env bash
# Builds the page and tests it in Chromium. PROFILE is the profile of cargo; AFFINOR_COMMAND a program to compare with.
set -euo pipefail
cd "$(dirname "$0")"

step() {
    printf '\n== %s\n' "$*"
    "$@"
}

rustup target list --installed | grep -q wasm32-unknown-unknown || step rustup target add wasm32-unknown-unknown
if [ -z "${CHROMIUM:-}" ]; then
    command -v chromium >/dev/null || { step apt-get update -qq; step apt-get install -y -qq chromium; }
    CHROMIUM=$(command -v chromium)
    export CHROMIUM
fi
step cargo run -p affinor-web-build
step npm ci --no-audit --no-fund
step npm test
