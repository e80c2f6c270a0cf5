"""The native `WheelRailSurfaces`: the solver's results over sweeps, exchange of surfaces, and resources that are refused."""

import shutil
from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_instance import DISCARD, Instance, answered_extremes, recovers
from pair_case import METHODS, R0, expected, scale, solved
from typer.testing import CliRunner

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import Flat, Polygon, SurfacePair, WheelSurface
from contact.kernels.entries.surfaces import HEAD
from contact.pair import WheelRailPair
from contact_fmu import profiles, resources, surfaces
from contact_fmu.exchange import app
from contact_fmu.tables.wheel_rail_surfaces import RAIL, WHEEL
from examples.crossing.crossing import crossing

S1002, UIC60, SPEED = profile.s1002(), profile.rail_60e1(), 20.0


def measured_wheel() -> WheelSurface:
    """Return a wheel from 24 slices all around, out of round by some tenths of a millimetre."""
    theta, y = np.linspace(-np.pi, np.pi, 25)[:-1], np.linspace(-0.05, 0.04, 31)
    depth = 2e-4 * np.sin(3.0 * theta)[:, None] * (1.0 + 5.0 * y)
    return WheelSurface.from_deviations(theta, y, depth + np.interp(y, S1002.y, S1002.z))


#: Surfaces, the sweep (station [m], rotation [rad]), and other values of the FMU.
CASES = {
    "constant": (lambda: SurfacePair(S1002, UIC60), [(0.0, 0.0), (3.7, -2.1)], {"pose.y": 2e-3, "pose.yaw": 3e-3}),
    "flat": (
        lambda: SurfacePair(WheelSurface.constant(S1002, Flat(0.05)), UIC60, side="left"),
        [(0.0, a) for a in np.linspace(-0.08, 0.08, 9)],
        {"side": 1, "load.kind": 3},
    ),
    "polygon": (
        lambda: SurfacePair(WheelSurface.constant(S1002, Polygon(12, 2e-4)), UIC60),
        [(R0 * a, -a) for a in np.linspace(0.0, 0.6, 7)],
        {"pose.y": -1e-3, "irregularity.roll": 2e-3},
    ),
    "slices around the wheel": (lambda: SurfacePair(measured_wheel(), UIC60), [(0.0, a) for a in (0.0, 2.0, 9.0)], {}),
    "crossing": (
        lambda: SurfacePair(S1002, crossing(), rail_origin=(0.75, 0.0), tilted=True),
        [(s, -s / R0) for s in (0.1, 0.156, 0.158, 0.16, 0.162, 0.2, 0.45)],
        {"surfaces.frame": 2},
    ),
}  # fmt: skip


@cache
def resources_of(case: str) -> dict[str, bytes]:
    return surfaces.of_pair(CASES[case][0]())


@pytest.fixture(scope="module")
def folder(native_surfaces, tmp_path_factory) -> Path:
    """Return the folder of the unzipped FMU, whose resources tests replace."""
    return Path(
        fmpy.extract(str(native_surfaces[0]), str(tmp_path_factory.mktemp("unzipped") / "with blanks, ümläuts"))
    )


@pytest.fixture
def open_fmu(folder, freed):
    """Return a function that instantiates the FMU with other resources."""

    def open_fmu(new: dict[str, bytes], kind: str = "CoSimulation"):
        for name, content in new.items():
            (folder / "resources" / name).write_bytes(content)
        return freed(Instance(folder, kind=kind))

    return open_fmu


def start_values(given: dict[str, float]) -> dict[str, float]:
    fine = {"resolution.n_strips": 24, "resolution.n_elements": 16, "velocity.x": SPEED, "velocity.spin": -SPEED / R0}
    methods = {"method.normal": list(METHODS.normal).index("strip_halfspace") + 1}
    return {**fine, **methods, "pose.yaw": 1e-3, **given}


def solver(pair: SurfacePair) -> WheelRailPair:
    return WheelRailPair(pair, normal="strip_halfspace", n_strips=24, n_elements=16)


@pytest.mark.parametrize("case", CASES)
def test_the_fmu_gives_the_solvers_result_along_the_way(open_fmu, case):
    make, sweep, given = CASES[case]
    pair, values = make(), start_values(given)
    fmu, reference = open_fmu(resources_of(case)), solver(pair)
    fmu.update(values)
    fmu.initialize()
    patches = set()
    for station, rotation in sweep:
        fmu.update({"pose.station": station, "pose.rotation": rotation})
        fmu.step()
        wanted = expected(solved(values, reference, station=station, rotation=rotation), SPEED)
        worst = {name: abs(fmu[name] - x) / scale(name, values, wanted) for name, x in wanted.items()}
        assert max(worst.values()) <= 1e-9, (station, max(worst, key=worst.get), max(worst.values()))
        patches.add(int(wanted["patches.count"]))
    assert patches == ({1, 2} if case == "crossing" else {1})


def test_rolling_back_is_refused_by_name(open_fmu):
    fmu = open_fmu(resources_of("constant")).initialize()
    recovers(fmu, {"velocity.x": -1.0}, "velocity.x = -1 is outside the allowed range [0, inf[")


def test_outputs_do_not_depend_on_the_searches_before(open_fmu):
    """Grids of the last search serve again only for the same place, so a state goes on as if it had never been left."""
    _, sweep, given = CASES["crossing"]
    fmu = open_fmu(resources_of("crossing"))
    fmu.update(start_values({**given, "method.normal": 1}))
    fmu.initialize()

    def outputs(station: float, rotation: float) -> dict[str, float]:
        fmu.update({"pose.station": station, "pose.rotation": rotation})
        fmu.step()
        return {name: x for name, x in fmu.all("output").items() if not name.startswith("total.")}

    forth = [outputs(*place) for place in sweep]
    back = [outputs(*place) for place in reversed(sweep)]
    assert back[::-1] == forth


def test_directional_derivatives_follow_station_and_rotation(open_fmu):
    """On a smooth polygon they are those of wider central differences, within 2 %."""
    fmu = open_fmu(resources_of("polygon"), kind="ModelExchange")
    fmu.update(start_values({"load.kind": 2, "pose.rotation": 0.05}))
    fmu.update({"pose.z": 0.0})
    fmu.initialize()
    z = fmu["wheelset.z"]
    fmu.update({"pose.z": z + 3e-4})
    turning = ["force.z"], ["pose.rotation"], [1.0]
    found, wanted = fmu.directional(*turning), fmu.quotient(*turning, 5e-5)
    assert abs(wanted) > 1e5
    assert found == pytest.approx(wanted, rel=0.02)


def numbers_of(content: bytes) -> np.ndarray:
    return np.frombuffer(content[24:]).copy()  # after the kind, the checksum and the number of points


def packed(kind: str, numbers: np.ndarray) -> bytes:
    return resources.pack(surfaces.MAGIC[kind], numbers[None], numbers.size)


def spoilt(fault: str) -> dict[str, bytes]:
    """Return the resources of a crossing with a fault that the checksum does not show."""
    content = resources_of("crossing")
    rail = numbers_of(content[RAIL])
    slices, paths = int(rail[0]), int(rail[1])
    runs = HEAD + slices + 12 * slices * paths
    first: dict[str, tuple[int, object]] = {  # where new numbers begin
        "unordered slices": (HEAD + 3, rail[[HEAD + 4, HEAD + 3]]),
        "a gap between runs": (runs, rail[runs + 1]),
        "paths beyond the last": (runs + 1, paths + 1),
        "half a path": (runs, rail[runs] + 0.5),
        "non-matching widths": (1, paths + 1),
        "no slices": (0, 0),
        "negative slices": (0, -slices),
        "huge sizes": (0, 3 * [1e15]),
        "slices at one place": (HEAD + 4, np.nextafter(rail[HEAD + 3], 1.0)),
        "a point far away": (HEAD + slices + 100, -1e300),
    }
    at, new = first.get(fault, (0, rail[0]))
    rail[at : at + np.size(new)] = new
    rail = rail[: {"only a head": HEAD, "less than a head": 4}.get(fault)]
    return {**content, RAIL: packed("rail", rail)}


@pytest.mark.parametrize(
    "fault",
    ["unordered slices", "a gap between runs", "paths beyond the last", "half a path", "non-matching widths", "no slices",
     "negative slices", "huge sizes", "slices at one place", "a point far away", "only a head", "less than a head"],
)  # fmt: skip
def test_a_surface_that_is_no_surface_is_refused_by_name(open_fmu, fault):
    fmu = open_fmu(spoilt(fault))
    with pytest.raises(FMICallException) as caught:
        fmu.initialize()
    assert caught.value.status == DISCARD
    assert "resource rail.surface: its slices are not in order" in fmu.log[-1][1]


@pytest.mark.parametrize("damage", ["a bit", "truncated", "too large", "another kind", "not finite", "no file"])
def test_a_damaged_surface_is_refused_when_instantiated(native_surfaces, tmp_path, damage):
    folder = Path(fmpy.extract(str(native_surfaces[0]), str(tmp_path / "fmu")))
    path = folder / "resources" / WHEEL
    content = bytearray(path.read_bytes())
    if damage == "a bit":
        content[3000] ^= 1
    elif damage == "truncated":
        content = content[:-8]
    elif damage == "too large":
        content = resources.pack(surfaces.MAGIC["wheel"], np.zeros((1, 2_000_001)), 3_000_000)
    elif damage == "another kind":
        content = (folder / "resources" / RAIL).read_bytes()
    elif damage == "not finite":
        numbers = numbers_of(bytes(content))
        numbers[-20] = np.nan
        content = packed("wheel", numbers)
    path.write_bytes(content)
    if damage == "no file":
        path.unlink()
    log = []
    with pytest.raises(Exception, match="instantiate"):
        Instance(folder, log)
    assert f"resource {WHEEL}" in log[0][1]


def test_extreme_inputs_give_finite_outputs_or_none(open_fmu):
    fmu = open_fmu(resources_of("crossing")).initialize()

    def chosen(rng):
        return {"method.normal": 1, "load.kind": int(rng.integers(1, 3)), "pose.station": rng.uniform(0.0, 0.5)}

    assert answered_extremes(fmu, 100, chosen) > 10


def command(path: Path, *words: object):
    """Call what `python -m contact_fmu.exchange surfaces` does."""
    return CliRunner().invoke(app, [str(word) for word in ("surfaces", path, *words)])


def test_the_command_replaces_surfaces_in_a_finished_fmu(native_surfaces, tmp_path):
    path = Path(shutil.copy(native_surfaces[0], tmp_path))
    done = command(path, "--wheel", "S1002", "--flat", 0.06, "--flat-depth", 5e-4, "--rail", "54E4")
    assert done.exit_code == 0, done.stderr
    flat = WheelSurface.constant(profile.named("S1002"), Flat(0.06, depth=5e-4))
    wanted = surfaces.of_pair(SurfacePair(flat, profile.named("54E4")))
    folder = Path(fmpy.extract(str(path), str(tmp_path / "fmu"))) / "resources"
    assert {name: (folder / name).read_bytes() for name in wanted} == wanted


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--flat", 0.05), "--flat and --polygon need --wheel"),
        (("--wheel", "S1002", "--flat-depth", 1e-3), "needs --flat"),
        (("--wheel", "S1002", "--flat", 5.0), "--flat 5 is outside"),
        (("--rail", "absent.slcs", "--origin", 0.75, 0.0), "absent.slcs"),
        ((), "nothing to do"),
    ],
)
def test_the_command_refuses_by_name(native_surfaces, tmp_path, words, message):
    path = Path(shutil.copy(native_surfaces[0], tmp_path))
    done = command(path, *words)
    assert done.exit_code == 2
    assert message in done.stderr
    assert path.read_bytes() == native_surfaces[0].read_bytes()


def test_a_rail_of_slices_is_read_with_its_place(native_surfaces, tmp_path):
    path, slices = Path(shutil.copy(native_surfaces[0], tmp_path)), tmp_path / "ramp.slcs"
    for name, height in (("low", 0.0), ("high", -0.5)):
        (tmp_path / f"{name}.txt").write_text("".join(f"{y} {y**2 / 600.0 + height}\n" for y in range(-30, 31, 2)))
    slices.write_text("0.0 1.0\n2\n0 0 0\n1\n0.0 'low.txt'\n400.0 'high.txt'\n")
    done = command(path, "--rail", slices, "--origin", 0.75, 1e-3)
    assert done.exit_code == 0, done.stderr
    numbers = numbers_of((Path(fmpy.extract(str(path), str(tmp_path / "fmu"))) / "resources" / RAIL).read_bytes())
    assert numbers[[0, 3, 4]].tolist() == [2.0, 0.75, 1e-3]
    done = command(path, "--rail", slices)
    assert done.exit_code == 2
    assert "rail_origin = None" in done.stderr


def test_other_fmus_take_no_surfaces_and_this_one_no_profiles(native_surfaces, native):
    with pytest.raises(ContactError, match="it is not a WheelRailSurfaces FMU"):
        surfaces.exchange(native, surfaces.of_pair(SurfacePair(S1002, UIC60)))
    with pytest.raises(ContactError, match="it is not a WheelRailPair FMU"):
        profiles.exchange(native_surfaces[0], {"wheel": S1002})
