"""Where CONTACT's search puts a contact, and the heights between the nodes of its meshes."""

import numpy as np
import pytest

from contact import inp
from contact.geometry import profile
from contact.inp.nodes import bicubic, bilinear
from contact.inp.search import joined
from tests.inp.data import found

#: A wheel on a rail under a given height.
PAIR = """\
 1 MODULE
 1203000
 00{D}2033 {second}
 0001321
   999 100 30 1 1e-5 {most}
 .3 .3
 .28 .28 82000. 82000.
 {dx} {dx} 1.0 90d 8.0 4.0
 -1.0 753.0 0.0 0.0
 '{rail}' 0 1.0 0.0 -1
 0 0 0 0 0 0
 1360. -70. 460.
 '{wheel}' 0 1.0 0.0 -1
 0 2.0 .15 0 {yaw} 0
 2000. 0 0 0 0 -4.348
 0 MODULE
"""


@pytest.fixture
def solved(tmp_path):
    """Return a function that solves a case on S1002 and 60E1, with slices of one profile if wanted."""
    for name, one in (("wheel.prw2", profile.s1002()), ("rail.prr2", profile.rail_60e1())):
        np.savetxt(tmp_path / name, 1e3 * np.stack((one.y, one.z), axis=1))
    for name, one, at in (
        ("rail.slcs", "rail.prr2", range(-300, 301, 100)),
        ("wheel.slcw", "wheel.prw2", np.linspace(-3.0, 3.0, 25)),
    ):
        lines = ["0.0 1.0", f"{len(at)}", "0 0 0", "1", *(f"{u:.6f} '{one}'" for u in at)]
        (tmp_path / name).write_text("\n".join(lines) + "\n")

    def values(rail="rail.prr2", wheel="wheel.prw2", D=2, dx=0.4, yaw=0.0, second="", most=20000):
        text = PAIR.format(rail=rail, wheel=wheel, D=D, dx=dx, yaw=yaw, second=second, most=most)
        (tmp_path / "case.inp").write_text(text)
        result = inp.solve(inp.read(tmp_path / "case.inp"))[0]
        (patch,) = result.patches
        return patch.values

    return values


def test_cubics_between_nodes_are_exact_for_parabolas_and_straight_lines_are_not():
    i, j = np.meshgrid(np.arange(6.0), np.arange(5.0), indexing="ij")
    nodes = np.stack((0.5 * j, 2.0 * i, i * i - 3.0 * i * j + j), axis=-1)
    a, b = np.array([[2.3, 1.5]]), np.array([[1.2, 2.9]])
    x, y, z = 0.5 * b, 2.0 * a, a * a - 3.0 * a * b + b
    assert bicubic(nodes, x, y, a + 0.4, b - 0.3) == pytest.approx(z, abs=1e-12)
    assert bilinear(nodes, x, y, a, b) - z == pytest.approx((a % 1.0) * (1.0 - a % 1.0), abs=1e-12)


def test_a_rail_of_equal_slices_is_that_rail(solved):
    straight, slices = solved(), solved(rail="rail.slcs")
    for name in ("FN", "PMAX", "APPROACH"):
        assert slices[name] == pytest.approx(straight[name], rel=2e-4)
    for name in ("YCP(TR)", "XCP(TR)"):
        assert slices[name] == pytest.approx(straight[name], abs=2e-6)


def test_a_wheel_of_equal_slices_is_that_wheel_but_for_the_mesh(solved):
    round_, slices = solved(D=5, dx=0.2), solved(D=5, dx=0.2, wheel="wheel.slcw")
    for name in ("FN", "PMAX", "APPROACH"):
        assert slices[name] == pytest.approx(round_[name], rel=2e-3)


def test_mesh_and_surfaces_lead_to_reference_points_some_micrometres_apart(solved):
    for dx in (0.8, 0.2):
        mesh, surfaces = (solved(D=D, dx=dx, yaw=0.02) for D in (5, 2))
        apart = np.hypot(*(mesh[name] - surfaces[name] for name in ("XCP(TR)", "YCP(TR)")))
        assert 1e-7 < apart < 1e-5


def test_linear_weights_move_the_reference_point_and_not_the_force(solved):
    squared, linear = solved(), solved(second="11")
    assert abs(linear["YCP(TR)"] - squared["YCP(TR)"]) > 1e-5
    assert linear["FN"] == pytest.approx(squared["FN"], rel=3e-3)


def test_elements_are_doubled_until_there_are_less_than_npot_max(solved):
    many, few = solved(), solved(most=400)
    assert few["NCON"] < 0.3 * many["NCON"]
    assert few["FN"] == pytest.approx(many["FN"], rel=0.02)


def test_patches_nearer_than_the_least_distance_with_like_angles_are_one():
    pair = found(0.0, 0.2), found(0.008, 0.1, 3.0)  # their ends are 6 mm apart
    assert len(joined(pair, (5e-3, 1.0), lambda x, y: 0.0)) == 2
    assert len(joined(pair, (7e-3, 0.05), lambda x, y: 0.0)) == 2
    (one,) = joined(pair, (7e-3, 1.0), lambda x, y: 2e-3)
    assert one.at == pytest.approx([0.0, 0.006, 2e-3])
    assert one.angle == pytest.approx(0.125)
    assert one.ends[:, 0] == pytest.approx([-1e-3, 9e-3])


#: A wheel with a round profile of 10 mm in a groove, under 10 kN. Numbers from CONTACT 25.1 (its groove_r1010).
GROOVE = """\
 1 MODULE
 1203100
 00{D}2033
 0001321
   999 100 30 15 1e-6
 .3 .3
 .28 .28 82000. 82000.
 .2 .25 1.0 90d 8.0 4.0
 -1. 0. 0. 0.
 'groove.txt' 0 1.0 0.0 -1
 0 0 0 0 0 0
 0 0 420.
 'wheel.txt' 0 1.0 0.0 -1
 0 0 10000. 0 0 0
 420. 0 0 0 0 -1.0002
 0 MODULE
"""


@pytest.mark.parametrize(
    ("D", "force", "pressure", "approach", "count"),
    [(2, -682.747, 413.79921, 0.0192333, 715), (4, 588.489, 416.23666, 0.0191041, 745)],
)
def test_a_groove_in_a_flat_is_contacts_on_plane_and_curved_elements(tmp_path, D, force, pressure, approach, count):
    """The groove has a radius of 10.1 mm and edges of nearly 90 degrees, at which its spline breaks. Six decimals are given."""
    across = np.arange(-10.1, 10.11, 0.1)
    groove = np.sqrt(np.maximum(10.1**2 - across**2, 0.0)) - 10.1
    flat = np.arange(10.2, 20.11, 0.1)
    y = np.concatenate((-flat[::-1], across, flat))
    z = np.concatenate((np.full(flat.size, -10.1), groove, np.full(flat.size, -10.1)))
    np.savetxt(tmp_path / "groove.txt", np.stack((y, z), axis=1), fmt="%.6f")
    y = np.arange(9.9, -9.91, -0.1)
    np.savetxt(tmp_path / "wheel.txt", np.stack((y, np.sqrt(100.0 - y**2) - 10.0), axis=1), fmt="%.6f")
    (tmp_path / "case.inp").write_text(GROOVE.format(D=D))
    (patch,) = inp.solve(inp.read(tmp_path / "case.inp"))[0].patches
    assert patch.values["FX"] == pytest.approx(force, abs=1e-4 * 1e4)
    assert 1e-6 * patch.values["PMAX"] == pytest.approx(pressure, rel=1e-4)
    assert 1e3 * patch.values["APPROACH"] == pytest.approx(approach, rel=1e-4)
    assert patch.values["NCON"] == pytest.approx(count, abs=2)
