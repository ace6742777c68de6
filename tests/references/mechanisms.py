#!/usr/bin/env python3
"""Mechanisms, rolling bodies and an arm: states in 25 digits, written to tests/data/mechanisms.json.

Every problem is reduced by hand to as few coordinates as possible and integrated with 42 digits, by Gragg's extrapolation or by
collocation (`initial_value.py`); the folder `mechanism` has a file for each. Each state is computed twice: with other equations or closed
forms, or, for Bricard's mechanism, the slider-crank, the governor and Stewart's platform, with other methods and steps. `digits` is the number of significant
digits that both have in common, relative to the largest number of the state. `maximal.py` confirms the reductions in double precision by
multipliers, Pinocchio the arm, and `assert` compares with published numbers.

Problems A01 to A05 are those of the IFToMM benchmark library. Units are SI. Input is exact: decimals or formulas in the data.

    python3 tests/references/mechanisms.py [NAME ...]

Needs gmpy2, mpmath, numpy, scipy and pin (Pinocchio, from PyPI).
"""
import json
import sys
import time
from pathlib import Path

from mechanism.arm import arm
from mechanism.bicycle import bicycle
from mechanism.bricard import bricard
from mechanism.closed import pendulum, windows
from mechanism.governor import governor
from mechanism.rolling import coin, disk
from mechanism.slider_crank import slider_crank
from mechanism.snakeboard import snakeboard
from mechanism.squeezer import squeezer
from mechanism.stewart import stewart

DATA = Path(__file__).resolve().parents[1] / "data"
PROBLEMS = {"pendulum": pendulum, "windows": windows, "bricard": bricard, "squeezer": squeezer, "slider_crank": slider_crank, "governor": governor,
            "bicycle": bicycle, "disk": disk, "coin": coin, "arm": arm,
            "snakeboard": snakeboard, "stewart": stewart}


def main():
    path = DATA / "mechanisms.json"
    for name in sys.argv[1:] or PROBLEMS:
        start = time.time()
        found = PROBLEMS[name]()
        data = (json.loads(path.read_text()) if path.exists() else {}) | {name: found}
        print(f"{name}: {time.time() - start:.0f} s", file=sys.stderr, flush=True)
        path.write_text(json.dumps({key: data[key] for key in PROBLEMS if key in data}, indent=1) + "\n")


if __name__ == "__main__":
    main()
