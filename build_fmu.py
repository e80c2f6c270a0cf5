"""Build the FMUs: python build_fmu.py [--out dist] [--points 41] [--describe]."""

from __future__ import annotations

import argparse
from pathlib import Path

try:
    from fmu_src.documentation import markdown
    from fmu_src.python.packaging import build, models
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: install what building needs with  pip install '.[fmu]'") from None


def main() -> None:
    """Build what the command line asks for, and say so."""
    parser = argparse.ArgumentParser(description="Build the FMUs of wheelrail-contact.")
    parser.add_argument("--packaging", choices=["python", "all"], default="all", help="kind of FMU (default: all)")
    parser.add_argument("--out", type=Path, default=Path("dist"), metavar="FOLDER", help="where to (default: dist)")
    parser.add_argument(
        "--points",
        type=int,
        default=41,
        help="samples of the separation of WheelRailContact, at least 3 (default: 41, what Wheelset gives)",
    )
    parser.add_argument("--describe", action="store_true", help="print the variables as Markdown and build nothing")
    arguments = parser.parse_args()
    if arguments.points < 3:
        parser.error(f"--points {arguments.points}: a separation has at least 3 samples")

    chosen = models(arguments.points)
    if arguments.describe:
        print("\n".join(markdown(model.table) for model in chosen))
        return
    for model in chosen:
        print(
            f"{model.table.name}: {len(model.table.scalars)} variables, for hosts with Python ... ", end="", flush=True
        )
        path = build(model, arguments.out)
        print(f"{path} ({path.stat().st_size / 1024:.0f} kB)")


if __name__ == "__main__":
    main()
