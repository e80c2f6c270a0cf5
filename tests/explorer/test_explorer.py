"""The explorer's module against Python, and the page in a browser."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import contact
from contact.geometry import conicity, profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact_fmu.tables.wheel_rail_pair import table
from explorer.bundle import RAILS, WHEELS
from reference.random_cases import PARTNERS
from tests.explorer.wrong_files import FILES, written

METHODS = contact.methods().batched


@pytest.fixture(scope="session")
def page(once) -> Path:
    """Return the page that `python -m explorer` writes."""
    return once("page") / "explorer.html"


def _states(count: int) -> list[dict]:
    """Return random states of the page, with every method."""
    rng = np.random.default_rng(11)
    normal = list(METHODS.normal.values())
    states = []
    for i in range(count):
        values = {
            "pose.y": rng.uniform(-8.0, 8.0),
            "pose.yaw": rng.uniform(-20.0, 20.0),
            "pose.roll": rng.uniform(-5.0, 5.0),
            "load.normal_force": rng.uniform(20.0, 150.0),
            "creepage": rng.uniform(-1.0, 1.0),
            "velocity.x": rng.uniform(5.0, 80.0),
            "friction.coefficient": rng.uniform(0.1, 0.5),
        }
        method = normal[i % len(normal)]
        partners = [name for name, law in METHODS.tangential.items() if law.family == PARTNERS[method.family]]
        states.append(
            {
                "wheel": WHEELS[i % len(WHEELS)],
                "rail": RAILS[i % len(RAILS)],
                "values": values,
                "methods": [{"normal": method.name, "tangential": partners[i // len(normal) % len(partners)]}],
            }
        )
    return states


def _python(state: dict) -> contact.pair.PairSolution:
    values, method = state["values"], state["methods"][0]
    pair = Pair(profile.load(state["wheel"], "wheel"), profile.load(state["rail"], "rail"))
    solver = WheelRailPair(pair, **method)
    speed = values["velocity.x"]
    velocity = Velocity(forward=speed, spin=-speed / pair.nominal_radius * (1.0 - values["creepage"] / 100.0))
    pose = Pose(**{name: 1e-3 * values[f"pose.{name}"] for name in ("y", "roll", "yaw")})
    return solver.solve(pose, velocity, load=1e3 * values["load.normal_force"], friction=values["friction.coefficient"])


@pytest.mark.skipif(not shutil.which("node"), reason="needs node")
def test_the_module_answers_as_python_does(page, tmp_path):
    states = _states(200)
    (tmp_path / "states.json").write_text(json.dumps(states))
    done = subprocess.run(
        ["node", str(Path(__file__).with_name("answers.js")), str(page), str(tmp_path / "states.json")],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(answers) == len(states)
    solved = 0
    for state, answer in zip(states, answers, strict=True):
        try:
            expected = _python(state)
        except contact.ContactError:
            assert answer["code"] > max(contact.Status), state
            continue
        solved += 1
        assert answer["code"] == expected.status, state
        size = 1e-10 * 1e3 * state["values"]["load.normal_force"]
        np.testing.assert_allclose(answer["force"], expected.force, rtol=1e-10, atol=size, err_msg=str(state))
        np.testing.assert_allclose(answer["moment"], expected.moment, rtol=1e-10, atol=size, err_msg=str(state))
        np.testing.assert_allclose(answer["pressure"], expected.max_pressure, rtol=1e-10)
        for patch, found in zip(answer["patches"], [c for c in expected.contacts if c.N > 0.0], strict=False):
            assert patch["loads"] == pytest.approx(found.N, rel=1e-10)
    assert solved > 150


@pytest.fixture
def browser():
    """Return Debian's Chromium, driven by playwright."""
    playwright = pytest.importorskip("playwright.sync_api")
    chromium = shutil.which("chromium")
    if not chromium:
        pytest.skip("needs chromium")
    with playwright.sync_playwright() as driver:
        opened = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        yield opened
        opened.close()


def _open(browser, page: Path, state: str, width: int = 1440):
    tab = browser.new_page(viewport={"width": width, "height": 900})
    errors: list[str] = []
    tab.on("pageerror", lambda error: errors.append(str(error)))
    tab.goto(f"{page.as_uri()}#{state}")
    tab.wait_for_function("window.last && lines.creepage")
    return tab, errors


def test_a_link_restores_the_state_and_the_page_shows_the_numbers_of_python(page, browser):
    tab, errors = _open(browser, page, "pose.y=-3&load.normal_force=100&method2=analyn+fastrip")
    state = _states(1)[0] | {"wheel": "S1002", "rail": "60E1"}
    state["values"] = dict.fromkeys(state["values"], 0.0) | {
        "pose.y": -3.0, "load.normal_force": 100.0, "velocity.x": table().row["velocity.x"].start, "friction.coefficient": 0.3,
    }  # fmt: skip
    for method in (
        {"normal": "strip_halfspace", "tangential": "fastrip_mapped"},
        {"normal": "analyn", "tangential": "fastrip"},
    ):
        expected = _python(state | {"methods": [method]})
        assert f"{expected.max_pressure / 1e6:.4g} MPa" in tab.inner_text("#numbers")
    assert tab.inner_text("#trouble") == ""
    assert tab.evaluate("lines['pose.y'].length") == 2
    assert errors == []


def test_sliders_move_by_mouse_and_keyboard_and_change_the_answer(page, browser):
    tab, errors = _open(browser, page, "")
    before = tab.evaluate("last.force")
    box = tab.locator("[id='input-pose.y']").bounding_box()
    tab.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    tab.mouse.down()
    tab.mouse.move(box["x"] + 0.9 * box["width"], box["y"] + 0.5 * box["height"], steps=20)
    tab.mouse.up()
    tab.wait_for_function(f"last.force[1] !== {before[1]}")
    assert "pose.y=" in tab.evaluate("location.hash")
    dragged = tab.evaluate("state.values['pose.y']")
    tab.keyboard.press("ArrowLeft")
    assert tab.evaluate("state.values['pose.y']") == pytest.approx(dragged - 0.02)
    assert errors == []


def test_conicity_is_that_of_the_library(page, browser):
    """A contact under 1 kN instead of rigid touch: within .015 of the library's, where it does not jump."""
    tab, errors = _open(browser, page, "")
    line = tab.evaluate("lines.conicity[0]")
    amplitudes = np.array(line["x"])
    expected = conicity(profile.s1002(), profile.rail_60e1(inclination=1 / 40), 1e-3 * amplitudes).conicity
    smooth = np.abs(np.gradient(expected, amplitudes)) < 0.1
    assert smooth.sum() > 15
    np.testing.assert_allclose(np.array(line["results"]["conicity"])[smooth], expected[smooth], atol=0.015)
    assert errors == []


def test_a_number_is_explained_where_it_is_asked_for(page, browser):
    tab, errors = _open(browser, page, "")
    assert "stick" not in tab.inner_text("#numbers")
    tab.click("[data-why='slip.ratio']")
    tab.wait_for_function("document.querySelector('.why')")
    assert "does not mean no force" in tab.inner_text("#numbers")
    tab.click("[data-why='slip.ratio']")
    tab.wait_for_function("!document.querySelector('.why')")
    assert errors == []


def test_the_left_wheel_is_the_mirror_image(page, browser):
    tab, _ = _open(browser, page, "pose.y=4&pose.yaw=2")
    force = tab.evaluate("['x', 'y', 'z'].map(axis => left.get('force.' + axis))")
    state = _states(1)[0] | {"wheel": "S1002", "rail": "60E1"}
    state["values"] = dict.fromkeys(state["values"], 0.0) | {
        "pose.y": -4.0, "pose.yaw": -2.0, "load.normal_force": tab.evaluate("state.values['load.normal_force']"),
        "velocity.x": table().row["velocity.x"].start, "friction.coefficient": 0.3,
    }  # fmt: skip
    state["methods"] = [{"normal": "strip_halfspace", "tangential": "fastrip_mapped"}]
    assert force == pytest.approx(_python(state).force.tolist(), rel=1e-9, abs=1e-3)


def test_a_positive_creepage_brakes_and_links_of_earlier_versions_keep_their_state(page, browser):
    tab, _ = _open(browser, page, "creepage=0.5")
    assert tab.evaluate("last.force[0]") < 0.0
    tab, _ = _open(browser, page, "slip=-0.5")
    assert tab.evaluate("state.values.creepage") == 0.5


def test_nothing_is_cut_off_on_a_phone(page, browser):
    tab, _ = _open(browser, page, "", width=380)
    assert tab.evaluate("document.documentElement.scrollWidth") <= 380


def test_on_a_phone_the_main_results_stay_in_sight_while_the_sliders_are_moved(page, browser):
    tab, _ = _open(browser, page, "", width=380)
    tab.evaluate("document.querySelector('#inputs input:last-of-type').scrollIntoView({block: 'end'})")
    box = tab.locator("#brief").bounding_box()
    assert box["y"] >= 0.0
    assert box["y"] + box["height"] <= 900.0
    before = tab.inner_text("#brief")
    assert f"{float(tab.evaluate('+(solvers[0].get(`pressure.max`) / 1e6).toPrecision(3)')):.0f} MPa" in before
    tab.evaluate("state.values['pose.y'] = 5; dirty = true")
    tab.wait_for_function(f"document.querySelector('#brief').textContent !== {json.dumps(before)}")


def test_the_border_of_stick_follows_carter_between_the_elements(page, browser):
    """A strip of 20 elements with Carter's traction: q / (mu p) is 1 from the border to the trailing edge."""
    tab, _ = _open(browser, page, "")
    found = tab.evaluate(
        """(() => {
          const m = 20, border = -0.233, s = Array.from({ length: m }, (_, j) => 1 - (2 * j + 1) / m);
          const half = (1 - border) / 2, centre = (1 + border) / 2, root = x => Math.sqrt(Math.max(0, x));
          const P = s.map(x => root(1 - x * x)), QX = s.map((x, j) => P[j] - root(half * half - (x - centre) ** 2));
          return stickZones({ m, P, QX, QY: s.map(() => 0), STICK: s.map(x => x > border ? 1 : 0) }, 0, s);
        })()"""
    )
    assert found == [[1, pytest.approx(-0.233, abs=1e-9)]]  # elements are .1 wide


def test_an_own_profile_is_used(page, browser, tmp_path):
    tab, _ = _open(browser, page, "pose.y=2")
    wheel = profile.s1002()
    good = tmp_path / "mine.txt"
    good.write_text("\n".join(f"{1e3 * y:.9f} {1e3 * z:.9f}" for y, z in zip(wheel.y, wheel.z, strict=True)))
    before = tab.evaluate("last.force[1]")
    tab.set_input_files("#file", good)
    tab.wait_for_function("state.wheel === 'mine.txt' && !dirty")
    assert tab.evaluate("last.force[1]") == pytest.approx(before, rel=1e-4)  # exact tangents for those of a spline
    assert "nothing found" in tab.inner_text("#findings")


def test_thirty_wrong_files_are_told_beside_the_field_and_the_page_goes_on(page, browser, tmp_path):
    """No alert, no error of the page, and a solved state after each of them."""
    tab, errors = _open(browser, page, "pose.y=2")
    said: list[str] = []
    tab.on("dialog", lambda dialog: (said.append(dialog.message), dialog.accept()))
    for name, path in written(tmp_path).items():
        _, words, kind = FILES[name]
        before = tab.evaluate("[state.wheel, state.rail]")
        content = base64.b64encode(path.read_bytes()).decode()
        dropped = f"new File([Uint8Array.from(atob('{content}'), c => c.charCodeAt(0))], {json.dumps(name)})"
        tab.evaluate(f"$('drop').ondrop({{preventDefault() {{}}, dataTransfer: {{files: [{dropped}]}}}})")
        tab.wait_for_function(
            f"document.querySelector('#findings li')?.textContent.startsWith({json.dumps(name)}) && !dirty"
        )
        assert words in tab.inner_text("#findings"), name
        refused = tab.evaluate("!!document.querySelector('#findings .bad')")
        assert refused == (kind is None), (name, tab.inner_text("#findings"))
        if kind is None:
            assert tab.evaluate("[state.wheel, state.rail]") == before, name
        else:
            assert tab.evaluate(f"state.{kind}") == name
            assert tab.evaluate("last.found[0].failed") is False or name == "circle.txt", name
    assert (errors, said, len(FILES)) == ([], [], 30)


def test_every_slider_choice_and_result_is_a_variable_of_the_fmu():
    from explorer.bundle import CHOICES, RESULTS, SLIDERS

    rows = table().row
    for name, _, low, high, step in SLIDERS:
        assert low < high
        assert 0.0 < step < high - low
        assert name in rows or name == "creepage"
    assert all(name in rows for name, *_ in (*CHOICES, *RESULTS))
