"""Runs each scene in a process of its own with a time limit: python run.py [NAME ...]."""

import os
import subprocess
import sys
import time
from pathlib import Path

SCENES = Path(__file__).parent / "scenes"
SECONDS = float(os.environ.get("SELVEDGE_SCENE_SECONDS", 240))


def run(scene):
    """Returns whether a scene passed; prints what failed."""
    environment = os.environ | {"PYTHONPATH": str(SCENES.parent)}
    begin = time.monotonic()
    try:
        done = subprocess.run(
            [sys.executable, str(scene)], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=SECONDS
        )
        status, output = done.returncode, done.stdout
    except subprocess.TimeoutExpired as expired:
        status, output = 1, f"{(expired.stdout or b'').decode(errors='replace')}\nno end after {SECONDS:.0f} s"
    print(f"{'ok    ' if status == 0 else 'FAILED'} {scene.stem} ({time.monotonic() - begin:.1f} s)", flush=True)
    if status != 0:
        print(output)
    return status == 0


def main(names):
    scenes = sorted(scene for scene in SCENES.glob("*.py") if not names or scene.stem in names)
    passed = sum(run(scene) for scene in scenes)
    print(f"{passed} passed, {len(scenes) - passed} failed")
    return 0 if passed == len(scenes) > 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
