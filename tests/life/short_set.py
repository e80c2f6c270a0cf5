"""A set of two scenarios of two metres."""

from pathlib import Path

from contact_models.life.scale import Workers
from contact_models.life.wear import Life

STRAIGHT = """
name = "straight"
length = 2.0
speed = 20.0
[track.alignment]
spectrum = "ERRI B176 high"
[recording]
settling = 0.5
[profiles]
wheel = "1/40"
[methods]
normal = "analyn"
tangential = "fastrip"
strips = 20
elements = 12
"""
CURVE = (
    STRAIGHT.replace("straight", "curve")
    + "[[track.curves]]\nstart = 0.0\nradius = 300.0\nlength = 5.0\ntransition = 1.0\n"
)
SET = """
name = "short"
mileage = 1e6
alike = "all"
amplitudes = [3e-3]
[[scenarios]]
file = "straight.toml"
weight = 3.0
[[scenarios]]
file = "curve.toml"
weight = 1.0
[steps]
distance = 4e5
"""


def completed(life: Life, *, go_on: bool = False) -> Life:
    """Complete a study. With `go_on` runs may be too rough to close, as those of two metres are."""
    with Workers() as pool:
        while not life.ended:
            life.step(pool, go_on=go_on)
    return life


def written(folder: Path) -> Path:
    """Write the files of the set into `folder` and return the path of the set."""
    for name, text in (("straight", STRAIGHT), ("curve", CURVE), ("set", SET)):
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    return folder / "set.toml"
