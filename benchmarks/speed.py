"""Run the speed benchmarks and print them as a table, with CONTACT's times for comparison (`make bench`)."""

from __future__ import annotations

import json
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
CONTACT = (
    "CONTACT 25.1 on the same patch (design figures, another machine): solvers alone 100 µs (ANALYN + FaStrip, 28 × 50 "
    "elements), whole case 700 µs; full half space 47 ms."
)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "bench.json"
        subprocess.run(
            [sys.executable, "-m", "pytest", str(HERE / "test_speed.py"), "-q", "-p", "no:xdist", f"--benchmark-json={target}",
             "--benchmark-warmup=on"],
            check=True, cwd=HERE.parent, stdout=subprocess.DEVNULL,
        )  # fmt: skip
        data = json.loads(target.read_text())
    cpu = data["machine_info"].get("cpu", {}).get("brand_raw", platform.processor())
    print(f"{cpu}, {platform.python_implementation()} {platform.python_version()}; least / median of many rounds\n")
    print("| what | least | median | least per element |\n| --- | --- | --- | --- |")
    for row in data["benchmarks"]:
        name = row["name"].removeprefix("test_").replace("_", " ")
        cases, elements = row["extra_info"].get("cases", 1), row["extra_info"].get("elements")
        least, median = row["stats"]["min"] / cases, row["stats"]["median"] / cases
        print(f"| {name} | {scaled(least)} | {scaled(median)} | {scaled(least / elements) if elements else ''} |")
    print(f"\n{CONTACT}")


def scaled(seconds: float) -> str:
    for unit, factor in (("s", 1.0), ("ms", 1e3), ("µs", 1e6)):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


if __name__ == "__main__":
    main()
