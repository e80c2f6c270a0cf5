"""A contact case for the tests of FMI 3.0, in which arrays and fields are variables."""

from contact_case import CREEPAGES, separation

from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.kernels.records import MAX_PATCHES

SHAPE = (MAX_PATCHES, N_STRIPS.usual, N_ELEMENTS.usual)

FIELDS = {
    "field.x": "x", "field.y": "y", "field.area": "dA", "field.pressure": "p", "field.traction_x": "qx",
    "field.traction_y": "qy", "field.slip_x": "sx", "field.slip_y": "sy", "field.stick": "stick",
}  # fmt: skip


def pose(fmu):
    """Set `separation` and CREEPAGES in an instance and return it."""
    s = separation()
    fmu.update({"geometry.g": s.g, "geometry.A": s.A, **CREEPAGES})
    fmu.update({"geometry.y0": -0.02, "geometry.dy": 0.001, "speed": 30.0})
    return fmu


def arrays(values: dict) -> dict:
    """Return the values of `random_case` with geometry.g[1] … as one array."""
    whole = {name: value for name, value in values.items() if not name.endswith("]")}
    for name in ("geometry.g", "geometry.A", "geometry.tilt"):
        whole[name] = [value for key, value in values.items() if key.startswith(name + "[")]
    return whole
