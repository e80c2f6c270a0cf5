"""The FMUs that this project builds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
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
from .tables.vehicle import START, TRACK
from .tables.wheel_rail_contact import POINTS
from .track import pack, pack_rows
from .variables import Table


@dataclass(frozen=True)
class Model:
    """An FMU: name of its module in `tables`, options of its table and component, and its files in resources/.

    `view` are options that change only what hosts see of the table. `declared` names the function of `native.components`.
    """

    name: str
    options: Mapping[str, Any]
    resources: Mapping[str, bytes] = field(default_factory=dict)
    view: Mapping[str, bool] = field(default_factory=dict)
    declared: str = ""

    @property
    def table(self) -> Table:
        """Variable table of the FMU."""
        return import_module(f".tables.{self.name}", __package__).table(**self.all_options)

    @property
    def all_options(self) -> dict[str, Any]:
        """Options of table and component."""
        return {**self.options, **self.view}

    def component(self) -> Any:
        """Return what the FMU has beside its table (`native.component.Component`)."""
        return getattr(import_module(".native.components", __package__), self.declared)(**self.all_options)


def models(points: int, given: Mapping[Kind, Profile] | None = None, accumulation: bool = False) -> tuple[Model, ...]:
    """Return all FMUs: the contact with `points` samples of the separation, the pair with the `given` profiles.

    With `accumulation` the pair has its bins of accumulated damage as outputs.

    The default profiles are S1002 and 60E1. The default rail is inclined by 1:40; a given rail is not turned. The wheelset is
    placed for the default profiles.
    """
    both: dict[Kind, Profile] = {"wheel": profile.s1002(), "rail": profile.rail_60e1(0.0), **(given or {})}
    inclination = 0.0 if given and "rail" in given else 1.0 / 40.0
    return (
        Model("wheel_rail_contact", {"points": points}, declared="contact"),
        Model("wheel_rail_contact", {"points": points}, view={"elliptic": True}, declared="contact"),
        Model(
            "wheel_rail_pair",
            {"inclination": inclination},
            profiles.resources(both["wheel"], both["rail"]),
            {"accumulation": accumulation},
            "pair",
        ),
        axle(),
    )


@cache
def axle() -> Model:
    """Return the FMU `Wheelset`: the included vehicle of one wheelset without contacts, on straight track."""
    its = starts.of_simulation(wheelset.scenario(), wheelset.simulation(wheelset.scenario()), 0.0)
    options = {"vehicle": wheelset.scenario().declared.vehicle, "starts": its, "name": "Wheelset"}
    return Model("open_vehicle", options, {TRACK: pack_rows(wheelset.track())}, declared="vehicle_alone")


def surfaces(given: Mapping[Kind, Profile] | None = None) -> Model:
    """Return the native FMU of surfaces that change along the way, with the profiles of `models` all along."""
    both: dict[Kind, Profile] = {"wheel": profile.s1002(), "rail": profile.rail_60e1(), **(given or {})}
    return Model(
        "wheel_rail_surfaces", {}, slices.of_pair(SurfacePair(both["wheel"], both["rail"])), declared="surface_pair"
    )


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
    pair = next(model for model in models(POINTS, given) if model.name == "wheel_rail_pair")
    beside = path.parent / declared.declared.vehicle
    vehicle = str(beside) if beside.is_file() else declared.declared.vehicle
    track = {TRACK: pack(declared)}
    try:
        its = {"vehicle": vehicle, **pair.options, "starts": starts.vehicle(declared, START)}
        alone = {"vehicle": vehicle, "starts": starts.open_vehicle(declared, START)}
        whole = Model("vehicle", its, {**pair.resources, **track}, declared="whole_vehicle")
        found = whole, Model("open_vehicle", alone, track, declared="vehicle_alone")
        for model in found:
            _ = model.table  # checks the starts
    except ContactError as error:
        raise ContactError(f"{path.name}.{error}") from None
    return found
