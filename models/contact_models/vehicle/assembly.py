"""From a declared vehicle to the arrays of the kernels."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.errors import ContactError
from .declared import Body, Damper, Joint, Spring, Stop, VehicleDeclaration, Wheelset
from .kernels.layout import BODY, ELEMENT, LINK, Axis, Kind

GRAVITY = 9.81  # [m/s²]
_HELD = ("x", "y", "z", "roll", "pitch", "yaw")


class Assembly(NamedTuple):
    """Arrays of a vehicle, as in `contact_models.vehicle.kernels.layout.Model`."""

    names: tuple[str, ...]
    bodies: NDArray
    links: NDArray
    elements: NDArray
    table: Array
    wheelsets: NDArray[np.int64]
    rail: Array


def assemble(v: VehicleDeclaration) -> Assembly:
    """Return the arrays of a vehicle, with the preloads by which it rests in its nominal place.

    Raises
    ------
    ContactError
        If a free body does not rest on springs.
    """
    declared: tuple[Body | Wheelset, ...] = (*v.bodies, *v.wheelsets)
    names = tuple(body.name for body in declared)
    bodies = np.zeros(len(declared), BODY)
    for made, body in zip(bodies, declared, strict=True):
        made["mass"], made["inertia"], made["place"] = body.mass, body.inertia, body.at
        if isinstance(body, Wheelset):
            made["wheelset"], made["height"], made["torque"] = 1, v.radius, body.torque
        else:
            made["height"], made["held"] = body.height, [name in body.held for name in _HELD]
    links: dict[tuple[int, int], int] = {}
    elements: list[np.void] = []
    tables = [np.zeros((2, 2))]  # the first two rows stand for no table
    for joint in (*v.springs, *v.dampers, *v.stops):
        rows = sum(table.shape[1] for table in tables)
        if isinstance(joint, Stop):
            tables.append(np.array([joint.deformation, joint.force]))
        for first, second in joint.between:
            a, b = names.index(first), names.index(second)
            link = links.setdefault((a, b), len(links))
            sides = (1.0, -1.0) if joint.mirrored else (1.0,)
            elements.extend(_element(joint, bodies, (a, b), link, side, rows) for side in sides)
    made_links = np.zeros(len(links), LINK)
    for (a, b), k in links.items():
        made_links[k]["a"], made_links[k]["b"] = a, b
    made_elements = np.array(elements, ELEMENT)
    _settle(names, bodies, made_links, made_elements)
    r = v.rail
    rail = np.array([r.mass, r.lateral_stiffness, r.lateral_damping, r.vertical_stiffness, r.vertical_damping])
    wheelsets = np.flatnonzero(bodies["wheelset"])
    return Assembly(names, bodies, made_links, made_elements, np.concatenate(tables, axis=1), wheelsets, rail)


def _element(joint: Joint, bodies: NDArray, ends: tuple[int, int], link: int, side: float, rows: int) -> np.void:
    made = np.zeros(1, ELEMENT)[0]
    made["link"] = link
    ahead, right, height = joint.at
    for body, arm in zip((bodies[k] for k in ends), ("on_a", "on_b"), strict=True):
        x = bodies[ends[0]]["place"] + ahead - body["place"]
        made[arm] = x, side * right, body["height"] - height
    if isinstance(joint, Stop):
        made["kind"], made["table"], made["table_end"] = Kind.STOP, rows, rows + len(joint.deformation)
    elif isinstance(joint, Damper):
        made["kind"], made["stiffness"], made["damping"] = Kind.SERIES, joint.stiffness, joint.damping
    elif isinstance(joint, Spring):
        made["kind"], made["stiffness"], made["damping"] = Kind.PARALLEL, joint.stiffness, joint.damping
        made["turning"], made["preload"] = joint.turning, (0.0, 0.0, joint.preload)
    return made


def _settle(names: tuple[str, ...], bodies: NDArray, links: NDArray, elements: NDArray) -> None:
    """Set the vertical preloads that carry the weights, and the static load of each wheel.

    Each spring carries what it would under the static sinking of the vehicle with its wheelsets held.
    """
    axes = (Axis.Z, Axis.ROLL, Axis.PITCH)
    free = [
        (i, axis) for i, body in enumerate(bodies) if not body["wheelset"] for axis in axes if not body["held"][axis]
    ]
    springs = np.flatnonzero(elements["kind"] == Kind.PARALLEL)
    sinking = np.zeros((len(springs), len(free)))  # of each spring, by each coordinate
    turning = np.zeros((len(free), len(free)))
    for row, k in enumerate(springs):
        e = elements[k]
        link = links[e["link"]]
        for body, arm, sign in ((link["a"], e["on_a"], -1.0), (link["b"], e["on_b"], 1.0)):
            for column, (i, axis) in enumerate(free):
                if i == body:
                    sinking[row, column] += sign * {Axis.Z: 1.0, Axis.ROLL: arm[1], Axis.PITCH: -arm[0]}[axis]
        for axis, about in ((Axis.ROLL, 0), (Axis.PITCH, 1)):
            way = np.array([(axis == own) * (float(i == link["a"]) - float(i == link["b"])) for i, own in free])
            turning += e["turning"][about] * np.outer(way, way)
    stiffness = elements["stiffness"][springs, 2]
    given = elements["preload"][springs, 2]
    matrix = sinking.T @ (stiffness[:, None] * sinking) + turning
    weight = np.array([bodies[i]["mass"] * GRAVITY * (axis == Axis.Z) for i, axis in free])
    if free and np.linalg.matrix_rank(matrix) < len(free):
        loose = ", ".join(sorted({names[i] for i, _ in free}))
        raise ContactError(f"springs: not all of {loose} rest on vertical springs")
    sunk = np.linalg.solve(matrix, weight - sinking.T @ given) if free else np.zeros(0)
    elements["preload"][springs, 2] = given + stiffness * (sinking @ sunk)
    for axle in np.flatnonzero(bodies["wheelset"]):
        load = bodies[axle]["mass"] * GRAVITY
        for e in elements[springs]:
            link = links[e["link"]]
            load += e["preload"][2] * (float(link["a"] == axle) - float(link["b"] == axle))
        bodies[axle]["load"] = 0.5 * load
