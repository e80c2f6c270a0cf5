"""Finite inputs of any decade: a contact of finite numbers, or an error that names the input and its range."""

import numpy as np
import pytest

import contact

METHODS = contact.methods()
#: Members of a solution that are numbers.
NUMBERS = ("N", "Fx", "Fy", "Mz", "max_pressure", "area", "power_per_metre", "approach")


@pytest.mark.parametrize("normal", METHODS.normal)
def test_inputs_of_any_decade_give_a_contact_or_an_error_that_names_them(normal):
    """Half curvatures of both 1e-9 gave no contact under 80 kN, 1e100 and 1e300 gave NaN on the half space."""
    rng, on_grid = np.random.default_rng(11), normal == "halfspace"
    tangential = [name for name in METHODS.tangential if (name == "halfspace") is on_grid]
    size = {"n_strips": 10, "n_elements": 10} if on_grid else {}

    def any_of(low, high):
        """Return a number of any decade, mostly between these."""
        return 10.0 ** (rng.uniform(-300.0, 300.0) if rng.random() < 0.1 else rng.uniform(low, high))

    refused = []
    for _ in range(12 if on_grid else 100):
        A, B, G, load = any_of(-6, 9), any_of(-6, 9), any_of(-3, 15), any_of(2, 6)
        how = {"normal": normal, "tangential": str(rng.choice(tangential)), "throw": False, **size}
        try:
            separation = contact.Separation.hertzian(A, B)
            s = contact.solve(
                separation,
                contact.Creepage(any_of(-6, 2)),
                load=load,
                friction=any_of(-3, 1),
                material=contact.Material(G, 0.28),
                **how,
            )
        except contact.ContactError as error:
            refused.append(str(error))
            continue
        assert np.isfinite([getattr(s, name) for name in NUMBERS]).all(), (A, B, G, load, how)
        assert s.status is not contact.Status.NO_CONTACT or load < 1.0, (A, B, G, load, how)
    assert refused
    assert all("is outside the allowed range" in text for text in refused), refused
