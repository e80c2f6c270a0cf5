"""What the step of a vehicle costs in accuracy: dissipation and wear at the default step against small steps."""

import pytest

from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import Methods, Recording
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from tests.vehicle.parts import completed, scenario

#: Irregular track in a curve, where the flange root of the outer wheel slides.
ROUGH = Track(
    curves=(Curve(start=5.0, radius=500.0, length=40.0, transition=20.0, cant=0.05),),
    alignment=Irregularities(spectrum="ERRI B176 high"),
)


def damage(step: float | None, pace: int, **changes) -> tuple[float, float]:
    """Return the energy [J/m] and the worn volume [m³/m] of a wheelset on the rough track."""
    methods = Methods(normal="analyn", tangential="fastrip", strips=20, elements=12, pace=pace)
    recording = Recording(settling=10.0, step=step)
    run = VehicleRun(scenario(track=ROUGH, length=60.0, seed=5, methods=methods, recording=recording, **changes))
    completed(run)
    assert 0.0 <= run.distance - 60.0 + 1e-6 < 0.25  # not a sample more by rounding
    damages = run.damage().values()
    distance = next(iter(damages)).distance
    return run.energy / distance, sum(histogram.volume for histogram in damages) / distance


@pytest.mark.slow
def test_dissipation_and_wear_at_the_default_step_are_near_those_of_a_fifth_of_it():
    """With every step counted there. Now they are .0048 and .0195 off at 12 m/s (.0006 and .0068 at 20). Creepages half a step
    late lost .015 of both on this track, and .024 and .06 on a longer one."""
    energy, volume = damage(None, 4, speed=12.0)
    exact = damage(VehicleRun(scenario(track=ROUGH, speed=12.0)).step / 5.0, 1, speed=12.0)
    assert energy == pytest.approx(exact[0], rel=6e-3)
    assert volume == pytest.approx(exact[1], rel=0.024)
