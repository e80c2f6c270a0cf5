"""The vehicle of the FMUs."""

from pathlib import Path

SCENARIO = Path(__file__).parents[2] / "examples" / "scenarios" / "vehicle_300.toml"
