"""kills.py - processes that are killed while they write."""

import os
import signal
import sys

EVENTS = {"open", "os.rename", "os.link", "os.remove", "os.mkdir", "os.rmdir", "os.symlink", "os.truncate"}


def die_after(folder, steps):
    """Kill this process at a number of steps in a folder, never at 0. Gives a function: how many there were so far."""
    left = steps

    def count(event, words):
        nonlocal left
        if event in EVENTS and isinstance(words[0], (str, bytes)) and os.fsdecode(words[0]).startswith(folder):
            left -= 1
            if left == 0:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.addaudithook(count)
    return lambda: steps - left
