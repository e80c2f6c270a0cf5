"""Profile files that tests write, and how far what is read from them is off."""

import numpy as np

from contact.geometry import profile

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
COLUMNS = {"kind": "wheel", "unit": "mm", "side": "right"}


def table(y, z, template="{:.9e} {:.9e} 1.0"):
    return "\n".join(template.format(a, b) for a, b in zip(y, z, strict=True))


def same(read: profile.Profile, shape: profile.Profile, tolerance=1e-9):
    """Check that points agree, and tangents too away from joints, where a spline bends."""
    assert read.kind == shape.kind
    np.testing.assert_allclose(read.y, shape.y, rtol=0, atol=tolerance)
    np.testing.assert_allclose(read.z, shape.z, rtol=0, atol=tolerance)
    assert np.median(np.abs(read.angle - shape.angle)) < 1e-5


def wheel_file(path, y, z, template="{:.4f} {:.4f}"):
    path.write_text(table(1e3 * y, 1e3 * z, template))
    return path


def distance(read, shape=WHEEL):
    """Return the greatest vertical distance between two profiles where the wheel is not steep [m]."""
    inside = (read.y > -0.03) & (read.y < 0.055)
    return np.abs(read.z[inside] - np.interp(read.y[inside], shape.y, shape.z)).max()
