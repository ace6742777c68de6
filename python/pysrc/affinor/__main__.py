"""``python -m affinor``: the comparison of the paper's two geometries of rotation, or of two spaces."""

import sys

from affinor import AffinorError, compare


def main(arguments: list[str]) -> int:
    """Prints the comparison; the exit status is that of the command line."""
    if len(arguments) not in (0, 2):
        print("usage: python -m affinor [SPACE SPACE]", file=sys.stderr)
        return 2
    try:
        print(compare(*arguments), end="")
    except AffinorError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
