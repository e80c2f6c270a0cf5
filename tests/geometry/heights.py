"""Heights of a profile between its points."""

import numpy as np

from contact.geometry import profile
from contact.kernels.geometry import curve


def height(shape: profile.Profile, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return z [mm] and dz/dy of a profile at y [mm], interpolated between its points."""
    table = np.stack((shape.y, shape.z, np.tan(shape.angle)))
    segments = np.clip(np.searchsorted(shape.y, 1e-3 * y) - 1, 0, shape.y.size - 2)
    values = [curve.at(table, int(j), 1e-3 * v) for j, v in zip(segments, y, strict=True)]
    return 1e3 * np.array([v[0] for v in values]), np.array([v[1] for v in values])
