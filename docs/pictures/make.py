"""Draw the pictures of the README and of the page on vehicles: `make pictures`.

That of the explorer needs Chromium and `dist/explorer.html`.
"""

import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

from contact import plot
from contact_models.runs import scenario
from contact_models.runs.run import VehicleRun

TARGET = Path(__file__).with_name("patch.png")
EXPLORER = Path(__file__).with_name("explorer.png")
PAGE = Path(__file__).parents[2] / "dist" / "explorer.html"
#: State of the page: where the contact moves to the flange, and the thesis' methods join two patches.
STATE = "pose.y=5.6&map=pressure&method2=analyn+fastrip"
CURVE = Path(__file__).with_name("vehicle_300.png")
SCENARIO = Path(__file__).parents[2] / "examples" / "scenarios" / "vehicle_300.toml"
METHODS = ["--normal", "strip_halfspace", "--tangential", "fastrip_mapped"]


def main() -> None:
    subprocess.run([Path(sys.executable).with_name("contact"), "patch", *METHODS, "--out", TARGET], check=True)
    draw_curve()
    for path in (TARGET, CURVE):  # 128 colours are enough for a page and a sixth of the size
        Image.open(path).convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(path, optimize=True)
    chromium = shutil.which("chromium")
    if chromium and PAGE.exists():
        draw_explorer(chromium)
    else:
        sys.stderr.write("No Chromium or no dist/explorer.html (make explorer): its picture stays as it is.\n")


def draw_curve() -> None:
    """Run the benchmark vehicle through a curve of 300 m and draw its motion and the forces on its outer wheels."""
    run = VehicleRun(scenario.read(SCENARIO))
    while not run.done:
        run.advance()
    s = run.series
    axles = {f"wheelset {k}": f"wheelset_{k}" for k in range(1, 5)}
    panels = {
        "y [mm]": {name: 1e3 * s[f"{key}_lateral"] for name, key in axles.items()},
        "yaw [mrad]": {name: 1e3 * s[f"{key}_yaw"] for name, key in axles.items()},
        "outer Y [kN]": {name: 1e-3 * s[f"{key}_left_lateral_force"] for name, key in axles.items()},
        "outer Q [kN]": {name: 1e-3 * s[f"{key}_left_vertical_force"] for name, key in axles.items()},
        "outer T-gamma [N]": {name: s[f"{key}_left_T_gamma"] for name, key in axles.items()},
    }
    plot.time_histories(s["distance"], panels, xlabel="distance [m]").savefig(CURVE, dpi=100.0)


def draw_explorer(chromium: str) -> None:
    """Show the page in Chromium and keep what it shows."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1200, "height": 1184}, color_scheme="light")
        page.goto(f"{PAGE.as_uri()}#{STATE}")
        page.wait_for_function("lines.creepage && last")
        page.screenshot(path=EXPLORER)
        browser.close()
    Image.open(EXPLORER).convert("RGB").resize((900, 888), Image.Resampling.LANCZOS).save(EXPLORER, optimize=True)


if __name__ == "__main__":
    main()
