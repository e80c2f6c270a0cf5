"""Values that no wheel on a rail has are doubted in C by the rules of Python."""

import warnings
from collections import Counter

import numpy as np
import pytest

import contact
from contact.errors import ModelWarning, PlausibilityWarning, silent
from contact.geometry import profile
from contact.geometry.wheelset import Pair as Profiles
from contact.geometry.wheelset import Pose, Velocity
from contact.inputs.plausibility import USUAL, doubt_case, doubt_value
from contact.kernels.records import RESULT
from contact.pair import WheelRailPair
from contact.results import ANSWERS, BEND
from contact.study.ellipse import ellipse
from tests.capi.library import Pair, Patch

SIZES = 10.0 ** np.arange(-4.0, 5.0)  # factors on usual values


def texts(library, doubts):
    """Return the texts of all doubts."""
    found = []
    assert doubts >= 0
    while doubts:
        found.append(library.c.wr_doubt(doubts).decode())
        doubts &= doubts - 1
    return found


def hints(library, doubts):
    """Return what is usual for each of the doubts."""
    return Counter(text.split(": ", 1)[1] for text in texts(library, doubts))


def of_python(function):
    """Return what is usual for each of the warnings of a function."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        function()
    said = [str(each.message) for each in caught if each.category is PlausibilityWarning]
    return Counter(
        next(u.hint for u in sorted(USUAL.values(), key=lambda u: -len(u.hint)) if s.endswith(u.hint)) for s in said
    )


def test_every_rule_has_a_bit_and_its_text(library):
    every = {**USUAL, **ANSWERS}
    assert texts(library, 2 ** len(every) - 1) == [f"{name}: {usual.hint}" for name, usual in every.items()]


@pytest.mark.parametrize("seed", range(4))
def test_a_patch_is_doubted_as_in_python(library, seed):
    rng, patch, fired = np.random.default_rng(seed), Patch(library), Counter()
    case = patch.case
    for _ in range(100):
        factor = rng.choice(SIZES, 12) * rng.uniform(0.5, 2.0, 12) * rng.choice((0.0, 1.0, 1.0, 1.0), 12)
        creepage = 1e-3 * factor[0] * rng.choice((-1, 1)), 1e-3 * factor[1], 0.2 * factor[2]
        by_load = rng.random() < 0.5
        load, approach = (80e3 * factor[3], None) if by_load else (None, 1e-4 * factor[3])
        friction, speed, modulus, limit = (
            0.3 * factor[4],
            20.0 * factor[5],
            min(8.2e10 * factor[6], 1e15) or 8.2e10,
            1e9 * factor[7],
        )
        y = np.linspace(-0.5, 0.5, 101) * 0.02 * (factor[8] or 1.0)
        A = 1.1 * (factor[9] or 1.0)

        def doubt(values=(load, approach, creepage, friction, speed), y=y, A=A, modulus=modulus, limit=limit):
            doubt_case(*values)
            contact.Separation(y, y**2, A)
            contact.Material(modulus, 0.28)
            doubt_value("pressure_limit", limit)

        with silent():
            separation = patch.separation(held := contact.Separation(y, y**2, A))
        case["load_kind"], case["amount"] = (0, load) if by_load else (1, approach)
        case["vx"], case["vy"], case["phi"] = creepage
        case["mu"], case["speed"], case["G"], case["pressure_limit"] = friction, speed, modulus, limit
        found = hints(library, library.call("wr_contact_doubts", separation, case))
        assert found == of_python(doubt), held
        fired += found
    assert len(fired) > 7


@pytest.mark.parametrize("seed", range(4))
def test_a_pair_is_doubted_as_in_python(library, seed):
    rng, fired = np.random.default_rng(seed), Counter()
    pair = Pair(library, wheel := profile.s1002(), rail := profile.rail_60e1())
    motion = pair.input["motion"]
    for _ in range(100):
        y, roll, yaw = (rng.choice((0.0, 0.5, 2.0), 3) * (0.015, 0.05, 0.05) * rng.choice((-1, 1), 3)).tolist()
        vx, spin = (
            float(rng.choice((-20.0, 0.0, 20.0, 40.0, 144.0, 200.0))),
            float(rng.choice((-43.5, 43.5, -87.0, -313.0))),
        )
        rates = rng.choice((0.0, 0.2, 5.0), 4).tolist()  # y, z, roll, yaw
        height, amount = int(rng.choice((0, 2, 3))), float(rng.choice((0.0, 80.0, 80e3, 8e7)))
        friction, radius = float(rng.choice((0.3, 35.0))), float(rng.choice((0.1, 0.46, 0.92)))
        motion["y"], motion["roll"], motion["yaw"], motion["vx"], motion["spin"] = y, roll, yaw, vx, spin
        motion["vy"], motion["vz"], motion["roll_rate"], motion["yaw_rate"] = rates
        pair.input["height"], pair.input["amount"], pair.input["surface"]["mu"] = height, amount, friction

        velocity, pair.options["wheel_radius"] = Velocity(vx, *rates, spin=spin), radius
        load = amount if height else None

        def doubt(pose=(y, 0.0, roll, yaw), velocity=velocity, load=load, friction=friction, radius=radius):
            Profiles(wheel, rail, nominal_radius=radius).doubt(Pose(*pose), velocity, load)
            doubt_value("friction", friction)

        found = hints(library, library.call("wr_pair_doubts", pair.options, pair.input))
        assert found == of_python(doubt)
        fired += found
    assert len(fired) > 5


@pytest.mark.parametrize("normal", ["strip_halfspace", "analyn"])
def test_an_answer_is_doubted_as_in_python(library, normal):
    wheel, rail, fired = profile.s1002(), profile.rail_60e1(), Counter()
    for y in np.linspace(4e-3, 7.5e-3, 15):
        pair = WheelRailPair(Profiles(wheel, rail), normal=normal)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = pair.solve(Pose(y=float(y)), Velocity(20.0, spin=-20.0 / 0.46), friction=0.3, load=80e3)
        said = [str(each.message) for each in caught if each.category is ModelWarning]
        of_c = Pair(library, wheel, rail)
        of_c.options["patch"]["normal"] = int(contact.methods().normal[normal].id)
        of_c = Pair(library, wheel, rail, patch=of_c.options["patch"].copy())
        of_c.input["motion"]["y"] = y
        of_c.solve()
        assert of_c.answer["total"]["bend"] == pytest.approx(found.bend, abs=1e-9)
        doubts = texts(library, library.call("wr_pair_answer_doubts", of_c.options, of_c.answer))
        bent, gap = (sum(word in text for text in said) for word in ("the contact angle changes", "gap_error = "))
        assert Counter(text.split(":")[0].split(" ")[0] for text in doubts) == Counter(bend=bent, gap_error=gap)
        fired.update(bend=bent, gap_error=gap)
        assert bent == (found.bend > BEND)
    assert fired["bend"] > 0
    assert fired["gap_error"] > 0 or normal == "strip_halfspace"


@pytest.mark.parametrize(("deeper", "told"), [(1e-4, []), (1.5e-3, ["N"])])
def test_a_wheel_that_lies_a_millimetre_inside_its_rail_is_doubted(library, deeper, told):
    pair = Pair(library, profile.s1002(), profile.rail_60e1())
    pair.input["height"], pair.input["amount"] = 2, 80e3
    pair.solve()
    pair.input["height"], pair.input["motion"]["z"] = 0, pair.answer["total"]["z"] + deeper
    pair.solve()
    doubts = texts(library, library.call("wr_pair_answer_doubts", pair.options, pair.answer))
    assert [text.split(":")[0] for text in doubts] == told


@pytest.mark.parametrize(("a_over_b", "told"), [(0.05, 1.0), (25.0, 0.0), (45.0, 1.0)])
def test_a_patch_beyond_the_table_of_creep_forces_is_doubted(library, a_over_b, told):
    patch, result, held = Patch(library), np.zeros(1, RESULT), ellipse(a_over_b, 6e-3, 80e3)
    patch.case["load_kind"], patch.case["amount"], patch.case["vx"] = 0, 80e3, 1e-3
    library.need("wr_contact_solve", patch.memory, patch.separation(held), patch.case, result)
    doubts = texts(library, library.call("wr_contact_answer_doubts", patch.options, result))
    assert result["beyond"][0] == pytest.approx(told, abs=1e-3)
    assert [text.split(":")[0] for text in doubts] == ["beyond"] * int(told)
