"""The program ``affinor``, which is also started by ``python -m affinor``."""

import signal
import sys

from affinor._engine import run_command


def main() -> int:
    """Runs the command line with the arguments of this process, and returns the exit status."""
    # disables the handler of Python, which would raise KeyboardInterrupt; the command handles signals itself
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run_command(["affinor", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
