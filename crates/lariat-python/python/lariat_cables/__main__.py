"""The command ``lariat``, which is that of the crate lariat-scene: ``lariat run SCENE --out DIR``, ``lariat --help``."""

import sys

from lariat_cables import _lariat


def main() -> None:
    """Runs the command with the arguments of the program, and ends it with the exit code of the command."""
    sys.exit(_lariat.run_command(["lariat", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
