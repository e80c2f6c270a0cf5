"""The rows of a yawed wheel's separation against the wheel's own surface beside its trace line."""

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.pair import SurfacePair
from contact.geometry.wheelset import Pair, Pose
from contact.halfspace import Gap

WHEEL, RAIL = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
PAIR = Pair(WHEEL, RAIL)
#: Lateral position [m], yaw [rad] and load [N] of wheels at the flange.
FLANGE = {
    "half a ring's way": (7.4e-3, 15e-3, 4e4),
    "a long patch": (7.5e-3, 30e-3, 4e4),
    "turned back": (7.2e-3, -25e-3, 5e4),
}


def placed(y, yaw, load):
    """Return the patch of the profiles at the flange, and a function for the true distance in its frame [m]."""
    patch = min(PAIR.contacts(Pose(y=y, yaw=yaw), load=load), key=lambda one: one.angle)
    surfaces = SurfacePair(WHEEL, RAIL)
    surfaces.contacts(Pose(y=y, yaw=yaw, z=PAIR.z))
    frame = Frame.turned(np.array(patch.position), patch.angle)
    return patch, lambda x, across: surfaces.distance(frame, x, across)


@pytest.mark.parametrize("case", FLANGE)
def test_the_parabolas_of_a_yawed_flange_follow_the_wheel_beside_its_trace_line(case):
    """From the trace line alone they are .0033, .042 and .021 of the approach off (root mean square over the overlap)."""
    patch, distance = placed(*FLANGE[case])
    sep = patch.separation
    longest = np.sqrt(patch.approach / sep.A.min())
    x, y = np.linspace(-1.5 * longest, 1.5 * longest, 121), np.linspace(*patch.edges, 41)
    true = distance(x, y) + patch.approach
    g, A, x_c = (np.interp(y, sep.y, values)[:, None] for values in (sep.g, sep.A, sep.x_c))
    depth = np.maximum(patch.approach - true, 0.0)
    miss = g + A * (x - x_c) ** 2 - true
    assert np.sqrt(np.sum(depth * miss**2) / depth.sum()) < 0.02 * patch.approach


@pytest.mark.parametrize("case", FLANGE)
def test_pressures_of_a_yawed_flange_are_those_of_the_true_distance(case):
    patch, distance = placed(*FLANGE[case])
    load, low, high = 1e5, *patch.edges
    longest = 1.3 * np.sqrt(patch.approach / patch.separation.A.min())
    x, y = np.linspace(-longest, longest, 100), np.linspace(low, high, 100)
    h = distance(x, y)
    both = {"load": load, "normal": "halfspace", "tangential": "halfspace"}
    exact = contact.solve(Gap(x, y, h - h.min()), contact.Creepage(0.0, 0.0, 0.0), **both)
    ours = contact.solve(patch.separation, contact.Creepage(0.0, 0.0, 0.0), load=load)
    elements = contact.solve(patch.separation, contact.Creepage(0.0, 0.0, 0.0), n_strips=120, n_elements=120, **both)
    assert ours.max_pressure == pytest.approx(exact.max_pressure, rel=0.03)
    assert ours.approach == pytest.approx(exact.approach, rel=0.01)
    assert elements.max_pressure == pytest.approx(exact.max_pressure, rel=0.03)
