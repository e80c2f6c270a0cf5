"""`contact rail`: torques, springs and displaced wheels reach the solver, are shown, and wrong ones are refused."""

import json

import pytest

from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Pose, Velocity
from contact.pair import ElasticRail
from tests.command_line import call


@pytest.mark.parametrize(
    ("words", "given", "name", "of", "shown", "wrong", "message"),
    [
        (("--torque", 5e3), {"torque": 5e3}, "spin", lambda s: s.spin, "rotation of the wheel",
         ("--torque", 5e3, "--force", 1e3), "exactly one of force and torque"),
        (("--springs", 8e6, 5e7), {"rail": ElasticRail(8e6, 5e7)}, "deflection_y", lambda s: s.deflection[0],
         "lateral deflection", ("--springs", 0, 1e7), "rail.ky = 0"),
        (("--wheel-offset", 0, 2e-3, 0, 0, 0, 0), {"offset": WheelOffset(y=2e-3)}, "Fy", lambda s: s.force[1],
         "Fy on the wheel", ("--wheel-offset", 0, 0, 0, 0, 0, 0.5), "offset.yaw = 0.5 is outside"),
    ],
    ids=["torque", "springs", "displaced wheel"],
)  # fmt: skip
def test_an_option_of_a_pair_gives_the_numbers_of_the_python_api(pair, words, given, name, of, shown, wrong, message):
    at = ("rail", "--y", 4e-3, "--vertical", 7e4)
    (found, *_) = json.loads(call(*at, *words, "--json").stdout)["sides"]
    wanted = of(pair.solve(Pose(y=4e-3), Velocity(20.0), vertical=7e4, **given))
    assert found[name] == pytest.approx(wanted, rel=1e-5)
    assert shown in call(*at, *words).stdout
    assert message in call(*at, *wrong, code=2).stderr
