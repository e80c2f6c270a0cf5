"""Draw the picture of the README: `make pictures`."""

import subprocess
import sys
from pathlib import Path

from PIL import Image

TARGET = Path(__file__).with_name("patch.png")
METHODS = ["--normal", "strip_halfspace", "--tangential", "fastrip_mapped"]


def main() -> None:
    subprocess.run([Path(sys.executable).with_name("contact"), "patch", *METHODS, "--out", TARGET], check=True)
    # 128 colours are enough for a page and a sixth of the size
    Image.open(TARGET).convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(TARGET, optimize=True)


if __name__ == "__main__":
    main()
