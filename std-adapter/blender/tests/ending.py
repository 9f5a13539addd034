"""Ends a test's process at once, since bpy may hang at its exit."""

import os
import sys
import traceback
from collections.abc import Callable
from typing import NoReturn


def end_after(test: Callable[[], object]) -> NoReturn:
    """Runs a test and ends the process: with status 0, or 1 and a traceback."""
    status = 1
    try:
        test()
        status = 0
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
