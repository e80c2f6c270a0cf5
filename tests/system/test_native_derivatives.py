"""Directional derivatives and creep stiffness of the native `WheelRailContact`."""

import numpy as np
import pytest
from contact_case import CREEPAGES, geometry, posed


@pytest.fixture
def fmu(open_native):
    """In the case of `contact_case`, ready to step."""
    return posed(open_native()).initialize(stop_time=1.0)


def test_creep_stiffness_belongs_to_the_last_step(fmu):
    fmu.step()
    first = fmu["creep_stiffness[1,1]"]
    fmu.update({"creepage.longitudinal": 5e-3})
    assert fmu["creep_stiffness[1,1]"] == first
    fmu.step(1e-3)
    assert abs(fmu["creep_stiffness[1,1]"]) < 0.9 * abs(first)


DERIVATIVES = [
    *((unknown, known) for known in CREEPAGES for unknown in ("force.x", "force.y", "moment.z")),
    *(("force.x", known) for known in ("load.normal_force", "friction.coefficient", "geometry.A[21]")),
    *((unknown, "load.normal_force") for unknown in ("force.y", "moment.z", "approach", "pressure.max", "patch.width")),
    ("power.friction", "speed"),
    ("pressure.max", "geometry.g[23]"),
]


@pytest.mark.parametrize("scale", [0.02, 0.5])
def test_directional_derivatives_are_those_of_the_solver(open_native, scale):
    """Against central differences of the fourth order of outputs in model exchange; in small and medium creepage."""
    fmu = posed(open_native("ModelExchange"))
    fmu.update({name: scale * value for name, value in CREEPAGES.items()})
    fmu.initialize()
    for unknown, known in DERIVATIVES:
        (slope,) = fmu.fmu.getDirectionalDerivative(
            [fmu.variables[unknown].valueReference], [fmu.variables[known].valueReference], [1.0]
        )
        at = fmu[known]
        h = 3e-10 if known == "geometry.g[23]" else 3e-6 * abs(at)
        found = []
        for k in (-2, -1, 1, 2):
            fmu.update({known: at + k * h})
            found.append(fmu[unknown])
        fmu.update({known: at})
        wanted = (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)
        bound = 1e-4 * max(abs(wanted), 1e-3 * abs(fmu[unknown] / at))
        assert slope == pytest.approx(wanted, abs=bound), (unknown, known)


@pytest.mark.parametrize("scale", [0.02, 0.5])
def test_forces_by_the_scale_of_the_geometry(open_native, scale):
    """Along (g, A) itself, all 82 samples at once: the contact becomes flatter or sharper."""
    fmu = posed(open_native("ModelExchange"))
    fmu.update({name: scale * value for name, value in CREEPAGES.items()})
    fmu.initialize()
    start = geometry()
    unknowns = ("force.x", "force.y", "moment.z", "approach", "pressure.max")
    references = ([fmu.variables[name].valueReference for name in names] for names in (unknowns, start))
    slopes = fmu.fmu.getDirectionalDerivative(*references, list(start.values()))
    h, found = 3e-6, []
    for k in (-2, -1, 1, 2):
        fmu.update({name: (1.0 + k * h) * value for name, value in start.items()})
        found.append(np.array(list(fmu.read(unknowns).values())))
    wanted = (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)
    np.testing.assert_allclose(slopes, wanted, rtol=1e-4)
    assert (np.abs(wanted) > 0.01 * np.abs(found[0])).all()


def test_a_directional_derivative_adds_up_what_its_seed_says(open_native):
    fmu = posed(open_native("ModelExchange")).initialize()
    knowns = [fmu.variables[name].valueReference for name in (*CREEPAGES, "load.normal_force")]
    unknowns = [fmu.variables[name].valueReference for name in ("force.x", "force.y")]
    seed = [2e-4, -1e-4, 0.05, 3e3]
    single = [fmu.fmu.getDirectionalDerivative(unknowns, [k], [s]) for k, s in zip(knowns, seed, strict=True)]
    np.testing.assert_allclose(fmu.fmu.getDirectionalDerivative(unknowns, knowns, seed), np.sum(single, 0), rtol=1e-4)


def test_a_derivative_at_the_end_of_a_range_is_one_sided(fmu):
    """Friction 0 is the least; there |F| grows with mu N."""
    fmu.update({"friction.coefficient": 0.0})
    (slope,) = fmu.fmu.getDirectionalDerivative(
        [fmu.variables["force.x"].valueReference], [fmu.variables["friction.coefficient"].valueReference], [1.0]
    )
    assert -8e4 <= slope < -1e4
