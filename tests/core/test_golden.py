"""What the product computes is what tests/golden/expected.json says, for any number of workers."""

import subprocess
import sys
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[1] / "golden"


def test_golden_digests_are_as_expected():
    done = subprocess.run([sys.executable, str(GOLDEN / "check.py")], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.endswith("all digests are as expected\n")
