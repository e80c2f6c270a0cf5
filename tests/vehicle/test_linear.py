"""Linear analysis: modes of the benchmark vehicle, Klingel's wavelength, critical speed of the wheelset."""

import dataclasses
import math

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import WheelSurface
from contact_models.vehicle import linear
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Axis
from tests.vehicle.parts import simulation

#: Own calculation with 18 degrees of freedom, wheelsets held, no effect of weights: frequencies without dampers, with them
#: (|eigenvalue|/2π) and damping ratios of lower sway, body yaw, bounce, upper sway, pitch.
REFERENCE = {
    "undamped": [0.596, 0.855, 1.074, 1.278, 1.303],
    "damped": [0.650, 0.868, 1.080, 1.192, 1.315],
    "ratio": [0.24, 0.53, 0.135, 0.35, 0.16],
}


def body_modes(sim) -> np.ndarray:
    """Return |eigenvalue|/2π and damping ratio of the five slowest modes with wheelsets held."""
    held = tuple(name for name in sim.names if name.startswith("wheelset"))
    found = [
        (math.hypot(2.0 * math.pi * m.frequency, m.growth) / (2.0 * math.pi), m.damping)
        for m in linear.modes(sim, held=held)
    ]
    return np.array(sorted(found)[:5]).T


def test_modes_of_the_benchmark_vehicle():
    sim = simulation("manchester")
    sim.model.elements["preload"][:] = 0.0  # the reference has no weights
    frequency, ratio = body_modes(sim)
    order = np.argsort(REFERENCE["damped"])
    assert frequency == pytest.approx(np.array(REFERENCE["damped"])[order], rel=0.02)
    assert ratio == pytest.approx(np.array(REFERENCE["ratio"])[order], abs=0.01)
    sim.model.elements["damping"][:] = 0.0
    assert body_modes(sim)[0] == pytest.approx(REFERENCE["undamped"], rel=0.02)


def test_weights_lower_the_sway():
    """The body is an inverted pendulum on its springs: 0.65 Hz without weights, 0.60 Hz with them."""
    assert body_modes(simulation("manchester"))[0][0] == pytest.approx(0.597, rel=0.01)


def test_a_free_conical_wheelset_has_klingels_wavelength():
    """At low speed, without springs, λ = 2π √(r b/γ); b is half the distance of the contacts."""
    conicity, speed = 0.05, 5.0
    wheelset = read("wheelset")
    free = dataclasses.replace(
        wheelset, springs=tuple(dataclasses.replace(s, stiffness=(1.0, 1.0, 1e3)) for s in wheelset.springs)
    )
    sim = simulation(free, speed=speed, wheel=profile.cone(conicity))
    lateral = [m for m in linear.modes(sim) if 0.1 < m.frequency < 5.0 and abs(m.damping) < 0.5]
    sim.advance(1e-6)
    half_base = 0.5 * (sim.wheel_arrays.contacts["y"][0, 0] - sim.wheel_arrays.contacts["y"][1, 0])
    wavelength = 2.0 * math.pi * math.sqrt(0.46 * half_base / conicity)
    assert speed / min(m.frequency for m in lateral) == pytest.approx(wavelength, rel=0.01)


@pytest.mark.parametrize("vehicle", ["wheelset", "manchester"])
def test_derivatives_of_the_contacts_give_the_matrix_and_the_eigenvalues_of_differences(vehicle):
    """Differences leave out what is not linear over 10 µm; their own noise is .0003 of the norm, .004 of an eigenvalue."""
    sim = simulation(vehicle)
    exact, secant = linear.state_matrix(sim), linear.state_matrix(sim, 1e-5)
    assert np.linalg.norm(exact - secant) < 1e-3 * np.linalg.norm(secant)
    values = np.linalg.eigvals(secant)
    for value in np.linalg.eigvals(exact):
        assert np.abs(values - value).min() < 0.01 * max(abs(value), 1.0)


def test_derivatives_of_the_contacts_leave_the_vehicle_as_it_was():
    sim, other = simulation("wheelset"), simulation("wheelset")
    linear.state_matrix(sim)
    for each in (sim, other):
        each.advance(2e-4, 50)
    np.testing.assert_array_equal(sim.state.q, other.state.q)


def test_a_wheel_beside_its_rail_has_no_state_matrix():
    sim = simulation("wheelset")
    sim.state.q[1, Axis.Y] = 0.2
    with pytest.raises(ContactError, match="has left its rail"):
        linear.state_matrix(sim)


def test_contacts_on_surfaces_have_no_state_matrix():
    sim = simulation("wheelset", uneven={0: WheelSurface.constant(profile.s1002())})
    with pytest.raises(ContactError, match="on surfaces"):
        linear.state_matrix(sim)


def test_growth_changes_sign_at_the_critical_speed_and_motion_agrees():
    def at_speed(speed: float):
        return simulation("wheelset", speed=speed, length=200.0, wheel=profile.cone(0.1))

    critical = linear.critical_speed(at_speed, tolerance=0.5, bounds=(5.0, 100.0))
    assert 20.0 < critical < 60.0
    for speed, grows in ((0.9 * critical, False), (1.1 * critical, True)):
        sim = at_speed(speed)
        sim.state.q[1, Axis.Y] = 5e-4
        sizes = []
        for _ in range(4):
            path = []
            for _ in range(200):
                sim.advance(2e-4, 10)
                path.append(sim.state.q[1, Axis.Y])
            sizes.append(np.ptp(path))
        assert (sizes[-1] > sizes[1]) == grows


def test_noise_of_slow_motions_is_no_instability(monkeypatch):
    """A soft wheelset has motions that neither grow nor decay; the sign of their growth is that of round-off."""
    monkeypatch.setattr(linear, "growth", lambda speed, amplitude: 0.005 if speed < 30.0 else 1.0)
    assert linear.critical_speed(lambda speed: speed, tolerance=0.1) == pytest.approx(30.0, abs=0.1)


def test_a_step_above_stability_multiplies_small_motions():
    sim = simulation("wheelset", speed=10.0)
    assert linear.amplification(sim, 1e-4) < 1.001
    assert linear.amplification(sim, 1.2e-3) > 1.5
