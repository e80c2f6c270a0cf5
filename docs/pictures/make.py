"""Draw the pictures of the README: `make pictures`. That of the explorer needs Chromium and `dist/explorer.html`."""

import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

TARGET = Path(__file__).with_name("patch.png")
EXPLORER = Path(__file__).with_name("explorer.png")
PAGE = Path(__file__).parents[2] / "dist" / "explorer.html"
#: State of the page: where the contact moves to the flange, and the thesis' methods join two patches.
STATE = "pose.y=5.6&map=pressure&method2=analyn+fastrip"
METHODS = ["--normal", "strip_halfspace", "--tangential", "fastrip_mapped"]


def main() -> None:
    subprocess.run([Path(sys.executable).with_name("contact"), "patch", *METHODS, "--out", TARGET], check=True)
    # 128 colours are enough for a page and a sixth of the size
    Image.open(TARGET).convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(TARGET, optimize=True)
    chromium = shutil.which("chromium")
    if chromium and PAGE.exists():
        _explorer(chromium)
    else:
        sys.stderr.write("No Chromium or no dist/explorer.html (make explorer): its picture stays as it is.\n")


def _explorer(chromium: str) -> None:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1200, "height": 1150}, color_scheme="light")
        page.goto(f"{PAGE.as_uri()}#{STATE}")
        page.wait_for_function("lines.slip && last")
        page.screenshot(path=EXPLORER)
        browser.close()
    Image.open(EXPLORER).convert("RGB").resize((900, 862), Image.Resampling.LANCZOS).save(EXPLORER, optimize=True)


if __name__ == "__main__":
    main()
