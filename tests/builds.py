"""What tests share and takes long to build. ``python -m tests.builds NAME PATH`` builds one; the fixture `once` calls that."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[1]


def _fmus(path: Path, packaging: str, *options: str | Path) -> None:
    """Build the FMUs into a folder, as a user does."""
    command = [sys.executable, "build_fmu.py", "--packaging", packaging, "--accumulation", *options, "--out", path]
    subprocess.run(command, check=True)


#: Friction of the track of the FMUs of vehicles, behind its curve.
SLIPPERY = "[track.friction]\nat = [195.0, 200.0]\nright = [1.0, 0.7]\nleft = [1.0, 0.5]\n"


def _native(path: Path) -> None:
    """Build the native FMUs, and beside their folder one of those of vehicles, with their scenario."""
    from reference.native import SCENARIO

    path.mkdir(parents=True, exist_ok=True)
    scenario = path / "vehicle.toml"
    scenario.write_text(SCENARIO.read_text(encoding="utf-8") + SLIPPERY, encoding="utf-8")
    _fmus(path, "native", "--vehicle", scenario)
    native = path / "native"
    for one in [one for one in native.rglob("*") if one.stem.lower().endswith("vehicle")]:
        apart = path / "vehicles" / one.relative_to(native)
        apart.parent.mkdir(parents=True, exist_ok=True)
        one.rename(apart)


def _surfaces(path: Path) -> None:
    from contact_fmu.catalogue import surfaces
    from contact_fmu.native import packaging

    packaging.build(surfaces(), path)


def _page(path: Path) -> None:
    subprocess.run([sys.executable, "-m", "explorer", "--out", path / "explorer.html"], check=True)


def _wine(path: Path) -> None:
    """Let Wine fill its folder: half a minute and 700 MB."""
    if shutil.which("wine"):
        own = os.environ | {"WINEPREFIX": str(path), "WINEDEBUG": "-all"}
        subprocess.run(["wineboot", "--init"], check=True, env=own, capture_output=True, timeout=600)


#: Name of a fixture → how to build what it returns, in the order in which they are built.
BUILDS: dict[str, Callable[[Path], None]] = {
    "native": _native,
    "fmus": lambda path: _fmus(path, "python"),
    "wine": _wine,
    "native_surfaces": _surfaces,
    "page": _page,
}


if __name__ == "__main__":
    BUILDS[sys.argv[1]](Path(sys.argv[2]))
