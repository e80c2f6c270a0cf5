"""The derivatives of the half space are those of its solutions."""

import numpy as np
import pytest

import contact
from contact import Creepage, Separation
from contact.errors import ContactError
from contact.friction import Friction

GAP, LOAD, AT = Separation.hertzian(1.1, 0.8), 80e3, (1e-3, 5e-4, 0.2)
FORCES = ("Fx", "Fy", "Mz", "power_per_metre")


def solve(at=AT, load=LOAD, friction=0.3, **options):
    size = {"n_strips": 24, "n_elements": 24} | options
    return contact.solve(
        GAP, Creepage(*at), load=load, friction=friction, normal="halfspace", tangential="halfspace", **size
    )


@pytest.mark.parametrize("at", [AT, (4e-4, -2e-4, -0.3), (0.0, 6e-3, 0.0), (0.0, 0.0, 0.0)])
def test_forces_grow_with_creepages_and_friction_together(at):
    """On a given pressure, twice creepages and friction give twice the forces and four times the power (Euler)."""
    solution = solve(at, derivatives=True)
    for name, degree in zip(FORCES, (1, 1, 1, 2), strict=True):
        row = [solution.jacobian[name, column] for column in ("longitudinal", "lateral", "spin", "friction")]
        assert np.dot(row, (*at, 0.3)) == pytest.approx(degree * getattr(solution, name), rel=1e-5, abs=1e-6)


@pytest.mark.parametrize(("k", "step"), [(0, 1e-6), (1, 1e-6), (2, 1e-3)])
def test_columns_of_creepages_are_differences(k, step):
    jacobian = solve(derivatives=True).jacobian
    ends = [solve([v + sign * step * (j == k) for j, v in enumerate(AT)]) for sign in (1, -1)]
    for name in FORCES[:3]:
        slope = (getattr(ends[0], name) - getattr(ends[1], name)) / (2 * step)
        assert slope == pytest.approx(jacobian[name, jacobian.columns[k]], rel=1e-3)


@pytest.mark.parametrize("given", ["load", "approach"])
def test_the_column_of_the_load_or_approach_is_a_difference(given):
    first = solve(derivatives=True)
    spacing = tuple(float(axis[1] - axis[0]) for axis in first.grid[:2])
    amount = {"load": first.N, "approach": first.approach}[given]

    def at(share, **options):
        return solve(**({"load": None, given: amount * share, "spacing": spacing} | options))

    jacobian, ends = at(1.0, derivatives=True).jacobian, [at(1.0 + sign * 5e-3) for sign in (1, -1)]
    for name in (*FORCES, "N", "approach"):
        slope = (getattr(ends[0], name) - getattr(ends[1], name)) / (0.01 * amount)
        assert slope == pytest.approx(jacobian[name, given], rel=0.03)


def test_a_law_of_friction_counts_in_the_columns_of_the_creepages():
    law = Friction(0.35, 0.15, half_speed=0.2, law="exponential")
    at = (8e-3, 3e-3, 0.0)
    jacobian = solve(at, friction=law, derivatives=True).jacobian
    ends = [solve((at[0] + sign * 1e-5, *at[1:]), friction=law) for sign in (1, -1)]
    assert (ends[0].Fx - ends[1].Fx) / 2e-5 == pytest.approx(jacobian["Fx", "longitudinal"], rel=0.01)


@pytest.mark.parametrize("given", [{"load": 0.0}, {"load": None, "approach": -1e-5}])
def test_without_contact_all_derivatives_are_zero_as_on_strips(given):
    assert not np.asarray(solve(**given, derivatives=True).jacobian).any()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"normal": "halfspace", "material": contact.Material.from_pair(210e9, 0.3, 100e9, 0.4)}, "unlike materials"),
        ({"normal": "halfspace", "layer": contact.ThirdBody(4e-14)}, "a layer"),
        ({}, "normal = 'strip_halfspace' and tangential = 'halfspace'"),
    ],
)
def test_what_has_no_derivatives_is_refused(options, said):
    options = {"tangential": "halfspace", "n_strips": 8, "n_elements": 8} | options
    with pytest.raises(ContactError, match=f"derivatives = True does not work with {said}"):
        contact.solve(GAP, Creepage(*AT), load=LOAD, derivatives=True, **options)
