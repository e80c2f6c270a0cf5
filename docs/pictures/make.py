"""Draw the pictures of the README: `make pictures`."""

from pathlib import Path

import subprocess
import sys

from PIL import Image

HERE = Path(__file__).parent


def main() -> None:
    target = HERE / "patch.png"
    command = [Path(sys.executable).with_name("contact"), "patch", "--normal", "strip_halfspace", "--tangential", "fastrip_mapped"]
    subprocess.run([*command, "--out", target], check=True)
    # 128 colours are enough for a page and a sixth of the size
    Image.open(target).convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(target, optimize=True)


if __name__ == "__main__":
    main()
