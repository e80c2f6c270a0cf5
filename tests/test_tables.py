"""Results as tables of pandas and xarray: axes, values and units."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import contact
from contact import Creepage, Separation
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair, over_poses
from contact.view.tables import axes_of

pandas = pytest.importorskip("pandas")
xarray = pytest.importorskip("xarray")

GAP = Separation.hertzian(1.1, 0.8)
PAIR = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)))
CREEPAGE = Creepage(1e-3, -5e-4, 0.2)
RESULTS = {
    "forces": lambda: contact.forces(GAP, ([0.0, 1e-3, 2e-3], 0.0, 0.0), load=np.array([[4e4], [8e4]])),
    "case": lambda: contact.Solver().forces(GAP, CREEPAGE, load=8e4),
    "poses": lambda: over_poses(PAIR, y=np.linspace(-4e-3, 4e-3, 3)[:, None], load=[6e4, 1e5]),
    "run": lambda: PAIR.run({"time": [0.0, 0.1, 0.2], "pose.y": [0.0, 1e-3, 2e-3], "load": 8e4, "velocity.x": 20.0}),
    "along": lambda: PAIR.run({"station": [0.0, 1.0], "load": 8e4}),
    "patches": lambda: PAIR.solve(Pose(y=6.3e-3), Velocity(20.0), load=8e4),
    "no patch": lambda: PAIR.solve(Pose(z=-1e-3)),
    "strips": lambda: contact.solve(GAP, CREEPAGE, load=8e4),
    "elements": lambda: contact.solve(
        GAP, CREEPAGE, load=8e4, normal="halfspace", tangential="halfspace", spacing=1e-3
    ),
    "forces only": lambda: contact.solve(GAP, CREEPAGE, load=8e4, tangential="polach"),
    "no contact": lambda: contact.solve(GAP, CREEPAGE, approach=-1e-3),
}
#: What is no quantity.
BARE = {"status", "patch", "patches", "n_patches", "strip", "element", "stick", "separation"}


@pytest.fixture(params=RESULTS)
def result(request):
    return RESULTS[request.param]()


def test_every_quantity_has_its_unit_in_both_tables(result):
    frame, dataset = result.to_dataframe(), result.to_xarray()
    for name in (*frame.columns, *frame.index.names):
        if name in BARE or name.startswith(("case", "axis_")):
            assert name not in frame.attrs["units"]
        else:
            assert frame.attrs["units"][name], name
    for name, variable in dataset.variables.items():
        assert variable.attrs.get("units") == frame.attrs["units"].get(name), name


def test_both_tables_hold_the_same_numbers(result):
    frame, dataset = result.to_dataframe(), result.to_xarray()
    assert list(frame.index.names) == list(dataset.sizes)
    for name in dataset.data_vars:
        spread = np.broadcast_to(
            dataset[name].values.reshape(*dataset[name].shape, *(1,) * (len(dataset.sizes) - dataset[name].ndim)),
            tuple(dataset.sizes.values()),
        )
        np.testing.assert_array_equal(frame[name].to_numpy(), spread.ravel(), err_msg=name)


def test_axes_are_named_by_the_input_that_varies_along_them():
    found = RESULTS["poses"]()
    dataset = found.to_xarray()
    assert dataset.Fy.dims == ("y", "load")
    np.testing.assert_array_equal(dataset.Fy.sel(load=1e5), found.Fy[:, 1])
    assert dataset.y.attrs["units"] == "m"
    frame = found.to_dataframe()
    assert frame.loc[(4e-3, 6e4), "Q"] == found.Q[2, 0]
    forces = RESULTS["forces"]().to_xarray()
    assert forces.Fx.dims == ("load", "longitudinal")
    for name, dims in (("forces", ("load", "longitudinal")), ("poses", ("y", "load"))):
        copied = pickle.loads(pickle.dumps(copy.copy(RESULTS[name]())))
        assert copied.to_xarray().N.dims == dims
    both = contact.forces(GAP, ([0.0, 1e-3], 0.0, 0.0), load=[4e4, 8e4]).to_xarray()
    assert both.Fx.dims == ("case",)
    np.testing.assert_array_equal(both["load"], [4e4, 8e4])
    np.testing.assert_array_equal(both["longitudinal"], [0.0, 1e-3])
    many = contact.forces([GAP, GAP], Creepage(), load=8e4).to_xarray()
    assert many.Fx.dims == ("separation",)


def test_a_height_that_is_given_is_an_axis_and_no_column():
    z = PAIR.solve(Pose(), load=8e4).z
    dataset = over_poses(PAIR, z=[z, z + 1e-5]).to_xarray()
    assert dataset.N.dims == ("z",)
    assert "z" not in dataset.data_vars


def test_a_run_is_a_table_over_time_or_stations_and_its_spin_is_a_rate():
    run = RESULTS["run"]()
    frame = run.to_dataframe()
    assert frame.index.name == "time"
    np.testing.assert_array_equal(frame["Q"], run["Q"])
    assert frame.attrs["units"]["spin"] == "rad/s"
    assert RESULTS["along"]().to_xarray().Q.dims == ("station",)


def test_fields_lie_over_strips_and_elements():
    solution = RESULTS["strips"]()
    dataset = solution.to_xarray()
    assert dataset.qx.dims == ("strip", "element")
    assert set(dataset.coords) == {"strip", "element", "x", "y", "patch"}
    assert dataset.attrs == {"normal": "strip_halfspace", "tangential": "fastrip_mapped", "status": "OK"}
    np.testing.assert_array_equal(dataset.p, solution.p)
    frame = solution.to_dataframe()
    assert (frame["p"] * frame["dA"]).sum() == pytest.approx(solution.N, rel=0.02)
    assert set(RESULTS["forces only"]().to_xarray().data_vars) == {"p", "dA"}


def test_patches_of_a_pair_are_rows():
    solution = RESULTS["patches"]()
    frame = solution.to_dataframe()
    assert len(frame) == len(solution.contacts)
    assert frame["N"].tolist() == [patch.N for patch in solution.contacts]
    assert frame["on_rail_y"].tolist() == [patch.on_rail[0] for patch in solution.contacts]
    assert RESULTS["no patch"]().to_dataframe().empty


def test_a_file_keeps_units(tmp_path):
    RESULTS["poses"]().to_xarray().to_netcdf(tmp_path / "poses.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "poses.nc", engine="scipy") as read:
        assert read.max_pressure.attrs["units"] == "Pa"


def test_dir_of_a_solution_shows_what_is_made_when_it_is_read():
    solution = RESULTS["strips"]()
    names = dir(solution)
    assert {"x", "y", "p", "qx", "qy", "sx", "sy", "stick", "dA", "strips", "friction", "Fx", "damage"} <= set(names)
    assert "_left" in solution.__dict__  # nothing was made
    assert all(hasattr(solution, name) for name in set(names) - {"utilisation"})  # an earlier name, with a warning
    assert set(names) == set(dir(solution))
    assert "x" in dir(copy.copy(solution))


def test_axes_of_inputs():
    y, load = np.linspace(0.0, 1.0, 3)[:, None], np.array([1.0, 2.0])
    axes, beside = axes_of((3, 2), {"y": y, "load": load, "spin": np.array(0.0)})
    assert list(axes) == ["y", "load"]
    assert beside == {}
    axes, beside = axes_of((3, 2), {"y": y + load, "load": load})
    assert list(axes) == ["axis_0", "axis_1"]
    assert list(beside) == ["y", "load"]
    assert list(axes_of((), {})[0]) == ["case"]


def test_a_missing_library_is_named_with_its_extra():
    code = """
import sys
sys.modules["pandas"] = None
import contact
solution = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=8e4)
solution.to_dataframe()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 1
    assert "ImportError: tables need pandas: pip install 'wheelrail-contact[tables]'" in done.stderr
