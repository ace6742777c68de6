#!/usr/bin/env bash
# Makes the fonts of the page in page/fonts: STIX Two Math as a subset, and its text companion. They are stored in the repository; run this
# only to change the set of characters. Needs npm, and a Python with fonttools and brotli (PYTHON).
set -euo pipefail
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && npm pack --silent @fontsource/stix-two-math@5.3.0 @fontsource/stix-two-text@5.3.0 >/dev/null && for file in *.tgz; do
    mkdir "${file%.tgz}" && tar xzf "$file" -C "${file%.tgz}"; done)
math="$work/fontsource-stix-two-math-5.3.0/package"
text="$work/fontsource-stix-two-text-5.3.0/package"
# Latin, Greek, arrows, operators, and the italic, bold, script, double-struck and fraktur letters that reports use
characters='U+20-7E,U+A0,U+A8,U+AC,U+AF,U+B1,U+B7,U+D7,U+F7,U+131,U+237,U+2C6,U+2C7,U+2D8-2DC,U+300-304,U+306-308,U+30A,U+30C,U+338,U+391-3A9,U+3B1-3C9'
characters+=',U+3D1,U+3D5,U+3F5,U+2016,U+2020,U+2026,U+2032-2034,U+203E,U+2044,U+2061-2064,U+20D7,U+210B-210E,U+2110-2113,U+211B-211D,U+2124,U+2128'
characters+=',U+2190-2199,U+21A6,U+21D0-21D5,U+2200-2209,U+220F-2213,U+2217-221E,U+2223-222B,U+222E,U+223C,U+2243,U+2245,U+2248,U+2260-2262'
characters+=',U+2264,U+2265,U+226A,U+226B,U+2282-2287,U+2295-2299,U+22A4-22A5,U+22C0-22C6,U+22C9,U+22CA,U+22EE-22F1,U+2308-230B,U+27E8,U+27E9'
characters+=',U+1D400-1D467,U+1D49C-1D4CF,U+1D504-1D537,U+1D538-1D56B,U+1D6A4-1D71B'
"${PYTHON:-python3}" -m fontTools.subset "$math/files/stix-two-math-latin-400-normal.woff2" --unicodes="$characters" \
    --layout-features=ssty,dtls,flac,kern,mark --no-hinting --desubroutinize --flavor=woff2 --output-file=page/fonts/math.woff2
for style in normal italic; do
    cp "$text/files/stix-two-text-latin-400-$style.woff2" "page/fonts/text-$style.woff2"
done
cp "$text/files/stix-two-text-latin-600-normal.woff2" page/fonts/text-strong.woff2
cp "$text/files/stix-two-text-greek-400-normal.woff2" page/fonts/text-greek.woff2
cp "$math/LICENSE" page/fonts/LICENSE.txt
