"""A run of four metres."""

from pathlib import Path

from models.life.run import Run
from models.life.scenario import Declaration, Profiles, Recording, Scenario

SHORT = Recording(settling=0.5, spacing=0.25)


def scenario(length: float = 4.0, **changes) -> Scenario:
    declared = Declaration(**({"name": "short", "length": length, "speed": 20.0, "recording": SHORT} | changes))
    return Scenario(declared, *Profiles().load(Path()))


def completed(run: Run, steps: int | None = None) -> Run:
    while not run.done and (steps is None or run.steps < steps):
        run.advance()
    return run
