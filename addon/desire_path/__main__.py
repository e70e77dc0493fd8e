"""python -m desire_path: the commands, where Python has what they need."""

import sys

try:
    from .commands import main
except ModuleNotFoundError as problem:
    if problem.name != "numpy":
        raise
    sys.exit("Desire Path needs NumPy: install it for this Python, as by python -m pip install numpy.")

if __name__ == "__main__":
    sys.exit(main())
