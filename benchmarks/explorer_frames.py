"""Frames a second of the explorer while its lateral shift slides, in headless Chromium with software rendering.

python -m benchmarks.explorer_frames dist/explorer.html: 40 s; needs playwright and Debian's chromium. On a busy machine put
`chrt -r 5` in front, which gives the browser a real-time priority. docs/use/explorer.md has the result.
"""

from __future__ import annotations

import argparse
from pathlib import Path

WIDTHS = (1440, 390)
STATES = {"one method": "", "two methods": "method2=analyn+fastrip"}
#: Slide for some seconds. Return frames a second and the times of frames [ms]: median, 95 %, largest.
SLIDE = """async seconds => {
  const input = document.getElementById("input-pose.y"), times = [], begin = performance.now();
  let last = begin;
  await new Promise(done => {
    const frame = now => {
      times.push(now - last);
      last = now;
      const time = performance.now() - begin;
      input.value = 4 * Math.sin(time / 700);
      input.dispatchEvent(new Event("input"));
      if (time < 1e3 * seconds) requestAnimationFrame(frame); else done();
    };
    requestAnimationFrame(frame);
  });
  const rate = 1e3 * times.length / (performance.now() - begin), sorted = times.slice(1).sort((a, b) => a - b);
  return [rate, sorted[sorted.length >> 1], sorted[Math.floor(0.95 * sorted.length)], sorted[sorted.length - 1]];
}"""


def main() -> None:
    """Print a row for each width and state: the better one of two runs of four seconds."""
    from playwright.sync_api import sync_playwright

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    page = parser.parse_args().page.resolve()
    print("width [px] | | frames a second | frame [ms], median | 95 % | largest")
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path="/usr/bin/chromium", args=["--no-sandbox"])
        for width in WIDTHS:
            for name, state in STATES.items():
                tab = browser.new_page(viewport={"width": width, "height": 900})
                tab.goto(f"{page.as_uri()}#{state}")
                tab.wait_for_function("window.last && lines.creepage")
                best = max(tab.evaluate(SLIDE, 4.0) for _ in range(2))
                print(f"{width} | {name} | " + " | ".join(f"{value:.1f}" for value in best), flush=True)
                tab.close()
        browser.close()


if __name__ == "__main__":
    main()
