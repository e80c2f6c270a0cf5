"""Numbers outside their ranges are refused by name, at every door of Python; `test_refused_arguments.py` has other faults."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import contact
from contact.damage import DamageParameters, evaluate
from contact.friction import Friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.inputs.options import MEMBERS, Real, Whole
from contact.pair import ElasticRail, WheelRailPair
from tests.doors import ELLIPSE, PAIR, RAIL, WHEEL, law, rolled, solve, steel


def on_surfaces(**given):
    return WheelRailPair(SurfacePair(WHEEL, RAIL)).solve(Pose(), load=8e4, **given)


#: A function of Python, what its messages put before an argument's name, and argument → member of a record in `MEMBERS`.
Door = tuple[Callable[..., Any], str, dict[str, str]]


def same(record: str, *without: str) -> dict[str, str]:
    """Return the members of a record that are arguments of the same name: all but `without`."""
    assert set(without) <= set(MEMBERS[record])
    return {name: name for name in MEMBERS[record] if name not in without}


TURNS = {"roll": "roll_rate", "yaw": "yaw_rate"}
#: Members of CASE that are numbers of a friction law, and those that follow from other arguments.
OF_LAW = ["kinetic", "half_speed", "slope", "slope_far", "slope_rate", "gauge_factor", "border", "border_width"]
OF_LAW += ["k_A", "k_S"]
DERIVED = {"tolerance", "law", "velocity", "warm", "heating", "conformal", "load_kind"}
DOORS: dict[str, list[Door]] = {
    "case": [
        (lambda **given: solve(**{"load": 1.0, **given}), "", {"speed": "speed", "load": "amount", "friction": "mu"}),
        (contact.Solver, "", {"speed": "speed", "friction": "mu", "max_iterations": "max_iterations"}),
        (Friction, "friction.", {"static": "mu"}),
        (rolled, "", {"friction": "mu"}),
        (law, "friction.", {name: name for name in OF_LAW} | {"hot_factor": "drop", "temperature_range": "warm_range"}),
        (steel, "", {"shear_modulus": "G", "poisson_ratio": "nu", "pressure_limit": "pressure_limit"}),
        (contact.Creepage, "creepage.", {"longitudinal": "vx", "lateral": "vy", "spin": "phi"}),
        (lambda **given: contact.Separation(ELLIPSE.y, ELLIPSE.g, 1.0, **given), "", {"rolling": "rolling"}),
    ],
    "contact_options": [
        (contact.Solver, "", {"n_strips": "n_strips", "n_elements": "n_elements", "max_iterations": "max_iterations"}),
        (lambda **given: solve(load=1.0, **given), "", {"n_strips": "n_strips", "n_elements": "n_elements"}),
        (lambda **given: WheelRailPair(PAIR, **given), "", {"n_strips": "n_strips", "n_elements": "n_elements"}),
        (steel, "", same("contact_options", "n_strips", "n_elements", "max_iterations", "conformal")),
    ],
    "pair_options": [
        (
            lambda **given: Pair(WHEEL, RAIL, **given),
            "",
            same("pair_options", "wheel_radius", "reach", "tilted", "n_bins", "bin_start", "bin_width")
            | {"nominal_radius": "wheel_radius"},
        ),
        (lambda **given: SurfacePair(WHEEL, RAIL, **given), "", {"reach": "reach"}),
    ],
    "pair_input": [
        (rolled, "", {"load": "amount", "distance": "distance"}),
        (on_surfaces, "", {"station": "station", "rotation": "rotation"}),
    ],
    "given": [
        (Pose, "pose.", {"y": "y", "z": "z", "roll": "roll", "yaw": "yaw"}),
        (Velocity, "velocity.", {"forward": "vx", "y": "vy", "z": "vz", "spin": "spin", **TURNS}),
        (Irregularity, "irregularity.", {"y": "rail_y", "z": "rail_z", "roll": "rail_roll"}),
        (Irregularity, "irregularity.", {"y_rate": "rail_vy", "z_rate": "rail_vz", "roll_rate": "rail_roll_rate"}),
    ],
    "wheel_offset": [(WheelOffset, "offset.", same("wheel_offset"))],
    "elastic_rail": [(ElasticRail, "rail.", same("elastic_rail"))],
    "damage_parameters": [
        (steel, "", {"hardness": "hardness", "shear_yield": "shear_yield"}),
        (lambda **given: evaluate(solve(load=8e4), **given), "", {"wheel_radius": "wheel_radius"}),
        (DamageParameters, "", {"rail_wear": "rail_wear"}),
    ],
}
#: Members that no function of Python takes as a number: choices, switches, what follows from other arguments.
WITHOUT = {
    "case": DERIVED,
    "contact_options": {"conformal"},
    "pair_options": {"tilted", "n_bins", "bin_start", "bin_width"},
    "pair_input": {"height"},
    "damage_parameters": {"speed", "with_spin", "wear_law"},
}


def outside(limits: Whole | Real) -> Iterator[float]:
    """Yield values just outside a range and far outside, none that is allowed."""
    if isinstance(limits, Whole):
        yield from (limits.least - 1, limits.most + 1, limits.least + 0.5)
        return
    yield math.nan
    if limits.above:
        yield limits.least
    if limits.least > -math.inf:
        yield from (math.nextafter(limits.least, -math.inf), -math.inf)
    if limits.most < math.inf:
        yield from (math.nextafter(limits.most, math.inf), math.inf)


def test_every_number_that_a_user_gives_has_a_door():
    for record, members in MEMBERS.items():
        taken = {member for _, _, arguments in DOORS[record] for member in arguments.values()}
        assert set(members) == taken | WITHOUT.get(record, set()), record
        assert not taken & WITHOUT.get(record, set())


@pytest.mark.parametrize(
    ("door", "told", "argument", "limits"),
    [
        pytest.param(
            door, prefix + argument, argument, MEMBERS[record][member], id=f"{record}.{member}-{prefix}{argument}"
        )
        for record, doors in DOORS.items()
        for door, prefix, arguments in doors
        for argument, member in arguments.items()
    ],
)
def test_a_number_outside_its_range_is_refused_with_name_value_and_range(door, told, argument, limits):
    for value in outside(limits):
        with pytest.raises(contact.ContactError) as error:
            door(**{argument: value})
        said = str(error.value)
        assert said.startswith((f"{told} = {value:g} is", f"{told} = {value} is")), said
        assert "allowed range" in said or said.endswith("is not finite"), said
