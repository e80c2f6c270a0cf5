"""The FMUs that this project builds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.profile import Kind, Profile
from contact.geometry.surfaces import SurfacePair
from contact_models.runs import scenario
from contact_models.wheelset import system as wheelset
from . import profiles, starts
from . import surfaces as slices
from .native import components
from .native.component import Component
from .tables.vehicle import START, TRACK
from .tables.wheel_rail_contact import POINTS
from .track import pack, pack_rows
from .variables import Table


@dataclass(frozen=True)
class Model:
    """An FMU: the function of `native.components` that declares it, its arguments, and its files in resources/."""

    declared: str
    options: dict[str, Any]
    resources: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def table(self) -> Table:
        """Variable table of the FMU."""
        return self.component.table

    @cached_property
    def component(self) -> Component:
        """What the FMU has beside its table, and the table."""
        return getattr(components, self.declared)(**self.options)


def models(points: int, given: Mapping[Kind, Profile] | None = None, accumulation: bool = False) -> tuple[Model, ...]:
    """Return all FMUs: the contact with `points` samples of the separation, the pair with the `given` profiles.

    With `accumulation` the pair has its bins of accumulated damage as outputs.

    The default profiles are S1002 and 60E1. The default rail is inclined by 1:40; a given rail is not turned. The wheelset is
    placed for the default profiles.
    """
    both: dict[Kind, Profile] = {"wheel": profile.s1002(), "rail": profile.rail_60e1(0.0), **(given or {})}
    inclination = 0.0 if given and "rail" in given else 1.0 / 40.0
    return (
        Model("contact", {"points": points}),
        Model("contact", {"points": points, "elliptic": True}),
        Model(
            "pair",
            {"inclination": inclination, "accumulation": accumulation},
            profiles.resources(both["wheel"], both["rail"]),
        ),
        axle(),
    )


@cache
def axle() -> Model:
    """Return the FMU `Wheelset`: the included vehicle of one wheelset without contacts, on straight track."""
    its = starts.of_simulation(wheelset.scenario(), wheelset.simulation(wheelset.scenario()), 0.0)
    options = {"vehicle": wheelset.scenario().declared.vehicle, "starts": its, "name": "Wheelset"}
    return Model("vehicle_alone", options, {TRACK: pack_rows(wheelset.track())})


def surfaces(given: Mapping[Kind, Profile] | None = None) -> Model:
    """Return the native FMU of surfaces that change along the way, with the profiles of `models` all along."""
    both: dict[Kind, Profile] = {"wheel": profile.s1002(), "rail": profile.rail_60e1(), **(given or {})}
    return Model("surface_pair", {}, slices.of_pair(SurfacePair(both["wheel"], both["rail"])))


def vehicles(path: Path, given: Mapping[Kind, Profile] | None = None) -> tuple[Model, ...]:
    """Return the native FMUs of the vehicle of a scenario's file, on its track: with contacts, and without them.

    Profiles are as in `models`. What the scenario gives of the variables are their starts.

    Raises
    ------
    ContactError
        As `contact_models.runs.scenario.read`, and for what the FMUs have not: flats, polygons, slices, torques,
        different rails.
    """
    declared = scenario.read(path)
    declared.require_profiles(path.name, "the FMUs of a vehicle take")
    pair = next(model for model in models(POINTS, given) if model.declared == "pair")
    beside = path.parent / declared.declared.vehicle
    vehicle = str(beside) if beside.is_file() else declared.declared.vehicle
    track = {TRACK: pack(declared)}
    try:
        inclination = pair.options["inclination"]
        its = {"vehicle": vehicle, "inclination": inclination, "starts": starts.vehicle(declared, START)}
        alone = {"vehicle": vehicle, "starts": starts.open_vehicle(declared, START)}
        found = Model("whole_vehicle", its, {**pair.resources, **track}), Model("vehicle_alone", alone, track)
        for model in found:
            _ = model.table  # checks the starts
    except ContactError as error:
        raise ContactError(f"{path.name}.{error}") from None
    return found
