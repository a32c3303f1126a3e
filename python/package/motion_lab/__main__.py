"""`python -m motion_lab` runs the program `motion-lab` that this package brings."""

import os
import sys
import sysconfig
from pathlib import Path


def program() -> Path:
    """Where the program is: among this Python's scripts, the user's own, or those of a folder given to `pip --target`.

    Raises FileNotFoundError where the package was built without it, as from its sources alone.
    """
    name = "motion-lab" + (sysconfig.get_config_var("EXE") or "")
    schemes = [sysconfig.get_default_scheme(), sysconfig.get_preferred_scheme("user")]
    folders = [Path(sysconfig.get_path("scripts", scheme)) for scheme in schemes]
    for folder in [*folders, Path(__file__).parents[1] / "bin", Path(sys.executable).parent]:
        if (folder / name).is_file():
            return folder / name
    raise FileNotFoundError(
        f"{name} is not beside this package: a wheel brings it, a package built from sources does not"
    )


if __name__ == "__main__":
    try:
        found = program()
    except FileNotFoundError as missing:
        sys.exit(str(missing))
    if sys.platform == "win32":
        import subprocess

        sys.exit(subprocess.run([found, *sys.argv[1:]]).returncode)
    os.execv(found, [str(found), *sys.argv[1:]])
