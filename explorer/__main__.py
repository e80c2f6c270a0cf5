"""Write the page: `python -m explorer [--out dist/explorer.html]`."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from explorer.bundle import bundle

_FOLDER = Path(__file__).parent
_LINK = (
    "-target",
    "wasm32-wasi",
    "-mexec-model=reactor",
    "-O2",
    "-msimd128",
    "-mbulk-memory",
    "-mnontrapping-fptoint",
    "-ffp-contract=off",
    "-fno-sanitize=undefined",
    "-s",
    "-Wl,-z,stack-size=1048576",
)


def module(folder: Path) -> bytes:
    """Return the WebAssembly module. It imports nothing. `folder` is for the objects."""
    root = _FOLDER.parent
    subprocess.run([sys.executable, "-m", "explorer.emit", str(folder)], check=True, cwd=root)
    made = folder / "explorer.wasm"
    parts = [str(_FOLDER / "explorer.c"), str(folder / "kernels.o"), str(folder / "data.o")]
    subprocess.run([sys.executable, "-m", "ziglang", "cc", *_LINK, *parts, "-lm", "-o", str(made)], check=True)
    return made.read_bytes()


def page(wasm: bytes) -> str:
    """Return the page with everything that it needs."""
    content = bundle(wasm)
    texts = {
        "STYLE": (_FOLDER / "page" / "style.css").read_text(encoding="utf-8"),
        "VERSION": content["version"],
        "BUNDLE": json.dumps(content, ensure_ascii=False).replace("</", "<\\/"),
        **{
            name.upper(): (_FOLDER / "page" / f"{name}.js").read_text(encoding="utf-8")
            for name in ("solver", "worker", "false_rows", "profile", "draw", "page")
        },
    }
    text = (_FOLDER / "page" / "index.html").read_text(encoding="utf-8")
    before, _, after = text.partition("@BUNDLE@")  # first, so that nothing is sought in the data
    for name, value in texts.items():
        before, after = before.replace(f"@{name}@", value), after.replace(f"@{name}@", value)
    return before + texts["BUNDLE"] + after


def main() -> None:
    """Compile the kernels and write the page."""
    parser = argparse.ArgumentParser(prog="python -m explorer", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("dist/explorer.html"))
    out = parser.parse_args().out
    print("Compiling the kernels to WebAssembly (two to four minutes) ...", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        wasm = module(Path(folder))
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(page(wasm), encoding="utf-8")
    print(f"Wrote {out}: {out.stat().st_size / 1e6:.1f} MB, module {len(wasm) / 1e6:.2f} MB. Open it in a browser.")


if __name__ == "__main__":
    main()
