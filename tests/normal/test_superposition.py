"""Two equal lobes far apart under 2 N have the approach, pressure, area and forces of one lobe under N.

If lobes interact in a method, they do so by the far field of the load: a half space moves by N/(π E* d) at distance d, which is
a share f of the approach δ. To first order in f the equations of each method give:

* Interacting strips add this to the approach, δ (1 + f), and keep pressure and area.
* Virtual penetration equates the displacement at the deepest point, δ^-½ + f δ^-½, with an approach that also sets the size of
  the patch. This gives δ (1 + ⅔ f), the area grows and the pressure falls by the same share.
* In multi-Hertz the first ellipse acts on the second, but not the reverse: loads (1 ± ¾ f) N, approach δ (1 + ½ f). The first,
  which carries more, has the pressure p0 (1 + ¼ f).
"""

import math
from typing import NamedTuple

import numpy as np
import pytest

import contact

LOAD, A, B = 1e4, 1.0, 2.0
NORMAL = contact.methods().batched.normal
#: Methods with one patch by definition: an ellipse at the least gap, or one in place of all patches.
SINGLE = {"hertz", "kpec", "pascal_sauvage"}


class Felt(NamedTuple):
    """Relative changes by the other lobe, in multiples of f."""

    approach: float = 0.0
    pressure: float = 0.0
    area: float = 0.0
    load: float = 0.0  # of the lobe that carries more


VIRTUAL_PENETRATION = Felt(approach=2 / 3, pressure=-2 / 3, area=2 / 3)
#: Methods in which lobes interact. In all others they do not.
FELT = {
    "strip_halfspace": Felt(approach=1.0),
    "kik_piotrowski": VIRTUAL_PENETRATION,
    "kik_piotrowski_2008": VIRTUAL_PENETRATION,
    "linder": VIRTUAL_PENETRATION,
    "multi_hertz": Felt(approach=1 / 2, pressure=1 / 4, load=3 / 4),
}


def solved(normal, distance, lobes):
    """Return the solution for one parabola at half the distance to the left, or for two on both sides."""
    half = 0.5 * distance + 12e-3
    y = np.linspace(-half, half, 2 * round(half / 5e-5) + 1)
    g = np.min([B * (y + side * 0.5 * distance) ** 2 for side in (1.0, -1.0)[:lobes]], axis=0)
    separation = contact.Separation(y, g, A)
    # the default's tangential method lets the tractions of lobes act on each other (test_pulls.py)
    rolling = contact.Creepage(5e-4, -3e-4)
    return contact.solve(separation, rolling, load=lobes * LOAD, normal=normal, tangential="fastrip")


def loads(sol):
    """Return the share of N of each patch, the greatest first."""
    own = 0.5 * math.pi * sol.strips.p0 * sol.strips.a * sol.strips.dy
    return sorted((float(own[sol.strips.patch == k].sum()) / LOAD for k in range(sol.n_patches)), reverse=True)


def test_the_list_of_one_patch_methods_is_complete():
    assert {name for name, method in NORMAL.items() if not method.several_patches} == SINGLE
    assert set(FELT) < set(NORMAL) - SINGLE


@pytest.mark.parametrize("distance", [15e-3, 60e-3])
@pytest.mark.parametrize("normal", [name for name in NORMAL if name not in SINGLE])
def test_two_lobes_far_apart_are_twice_one_lobe(normal, distance):
    two, one = solved(normal, distance, 2), solved(normal, distance, 1)
    assert (two.n_patches, one.n_patches) == (2, 1)
    felt, f = FELT.get(normal), LOAD / (math.pi * contact.STEEL.contact_modulus * distance) / one.approach
    tolerance = 1e-9 if felt is None else f * f + 5e-4  # strips are solved to 1e-4, their ends to 2e-4
    found = (two.approach / one.approach, two.max_pressure / one.max_pressure, 0.5 * two.area / one.area, *loads(two))
    felt = felt or Felt()
    changes = f * np.array([felt.approach, felt.pressure, felt.area, felt.load, -felt.load])
    np.testing.assert_allclose(found, 1.0 + changes, rtol=0, atol=tolerance)
    # forces change at most as much as the size of the patch; moments are about the middle of the lobe
    tolerance += f * felt.area
    np.testing.assert_allclose((two.Fx, two.Fy), (2.0 * one.Fx, 2.0 * one.Fy), rtol=tolerance)
    if felt.load == 0.0:
        own = one.Mz - 0.5 * distance * one.Fx
        assert two.Mz == pytest.approx(2.0 * own, abs=tolerance * one.friction * LOAD * math.sqrt(one.area))
