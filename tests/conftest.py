"""The package under test is the one in addon/, with the module that scripts/build put there."""

import sys
from pathlib import Path

REPO = Path(__file__).resolve().parents[1]
for folder in (REPO / "addon", REPO):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
