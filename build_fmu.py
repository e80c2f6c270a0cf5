"""Build the FMUs: python build_fmu.py [--packaging python|native|all] [--out dist] [options]; --help lists them."""

import sys
from pathlib import Path

# The packages of a clone that nobody has installed.
sys.path[:0] = [str(Path(__file__).parent / folder) for folder in ("fmu_src", "models")]
try:
    import typer

    from contact_fmu.command import fmu
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: install the build requirements with  pip install '.[fmu,native]'") from None

if __name__ == "__main__":
    typer.run(fmu)
