"""The distance between a rail and the mesh by which CONTACT describes a wheel."""

import numpy as np
import pytest

from contact.geometry.records import Pose
from contact.geometry.shape import Profile
from contact.geometry.surfaces import SurfacePair
from contact.halfspace.lattice import Lattice
from contact.inp.mesh import flattened
from contact.inp.nodes import bilinear
from contact.inp.outline import Outline, Outlines

RADIUS, STEP = 0.05, 4e-4  # of the hollow wheel, and of the elements [m]


def lowered(yaw, step=STEP, side="right"):
    """Return by how much the mesh lies below the wheel on each element [m], in a patch at a hollow of the wheel."""
    y = np.linspace(-0.03, 0.03, 241)
    hollow = Profile("wheel", y, RADIUS - np.sqrt(RADIUS**2 - y**2), name="hollow")
    round_ = Profile(
        "rail", y, 0.03 - np.sqrt(0.03**2 - np.clip(y, -0.028, 0.028) ** 2) + 0.2 * (abs(y) > 0.028) * abs(y)
    )
    pair = SurfacePair(hollow, round_, side=side, rail_origin=(0.75, 0.0), flange_back=1.36, spacing=STEP)
    pair.division = Lattice.centred(pair.division.spacing)
    pose = Pose(yaw=yaw)
    (patch,) = pair.contacts(pose, penetration=1e-4)
    mesh = flattened(patch, pair, pose, Outlines(Outline.of(hollow), Outline.of(round_)), step)
    return (patch.gap.h - patch.approach) - (mesh.gap.h - mesh.approach)


@pytest.mark.filterwarnings("ignore")
def test_without_yaw_the_mesh_is_the_wheel_around_the_reference_point():
    off = lowered(0.0)
    middle = off.shape[0] // 2  # further off, steps along the profile are longer than those of the plane
    assert abs(off[middle - 3 : middle + 4]).max() < 0.05 * STEP**2 / (8.0 * RADIUS)


@pytest.mark.filterwarnings("ignore")
def test_with_yaw_the_flats_lie_off_the_wheel_by_the_square_of_the_step_over_eight_radii():
    sag = STEP**2 / (8.0 * RADIUS)
    off = lowered(0.05)
    assert abs(off).max() == pytest.approx(sag, rel=0.1)
    assert abs(lowered(0.05, 0.5 * STEP)).max() == pytest.approx(0.25 * sag, rel=0.3)
    # the flats of a hollow wheel lie on one side of it; those around the axle add little
    assert min(off.max(), -off.min()) < 0.3 * sag


@pytest.mark.filterwarnings("ignore")
def test_the_mesh_of_a_left_wheel_is_the_mirror_image():
    right, left = lowered(0.05), lowered(-0.05, side="left")
    assert left == pytest.approx(right[::-1], abs=1e-12)


def test_a_place_that_no_piece_of_the_mesh_covers_has_no_height():
    i, j = np.meshgrid(np.arange(-3.0, 4.0), np.arange(3.0), indexing="ij")
    folded = np.stack((abs(i), j, np.full_like(i, 7.0)), axis=-1)  # x is at least 0
    x, y = np.array([[1.5, -1.0]]), np.ones((1, 2))
    found = bilinear(folded, x, y, np.full((1, 2), 5.0), y)
    assert found[0, 0] == pytest.approx(7.0)
    assert np.isnan(found[0, 1])
