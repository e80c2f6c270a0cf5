"""A wheelset modelled in exudyn with contact forces from the native FMU, compared with the project's own wheelset.

python examples/exudyn_wheelset/wheelset.py [--fmu dist/native/WheelRailContact.fmu] [--picture out/exudyn.png]
"""

from __future__ import annotations

import argparse
import math
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    CoordinateConstraint,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    RigidBodySpringDamper,
)
from exudyn.rigidBodyUtilities import RigidBodyInertia

from contact.arrays import Array
from contact_models.runs.scenario import Scenario
from contact_models.vehicle.assembly import GRAVITY
from contact_models.vehicle.declared import SIDES, Rail
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset import system
from examples.exudyn_wheelset.native_contact import NativeContact

SPEEDS = (18.0, 22.0, 26.0, 30.0)  # [m/s]


class Motion(NamedTuple):
    """Time [s], lateral displacement [m] and its rate [m/s], yaw [rad]."""

    time: Array
    lateral: Array
    rate: Array
    yaw: Array


def on_rigid_track(speed: float) -> Scenario:
    """Return the included wheelset on rails that do not give way, as those of exudyn."""
    given = system.scenario(speed)
    return replace(given, vehicle=replace(given.vehicle, rail=Rail(mass=0.0)))


def in_exudyn(fmu: Path, given: Scenario, lateral: float, duration: float, step: float = 5e-4) -> Motion:
    """Run the wheelset in exudyn: a rigid body with six degrees of freedom, of which motion along the track is held."""
    radius, (axle,), (spring,) = given.vehicle.radius, given.vehicle.wheelsets, given.vehicle.springs
    start = system.simulation(given, lateral)
    q = start.state.q[start.model.wheelsets[0]]
    turn = _about_x(float(q[Axis.ROLL]))
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.CreateGround()
    body = mbs.CreateRigidBody(
        referencePosition=[0.0, lateral, float(q[Axis.Z]) - radius],
        referenceRotationMatrix=turn,
        initialAngularVelocity=-given.speed(0.0) / radius * turn[:, 1],
        inertia=RigidBodyInertia(axle.mass, np.diag(axle.inertia)),
        nodeType=exu.NodeType.RotationRotationVector,
    )
    node = mbs.GetObject(body)["nodeNumber"]
    mbs.CreateForce(itemNumber=body, loadVector=[0.0, 0.0, axle.mass * GRAVITY + 2.0 * spring.preload])
    _, arm, _ = spring.at
    for y in (arm, -arm):
        mbs.CreateCartesianSpringDamper(
            itemNumbers=[ground, body],
            localPosition0=[0.0, y, -radius],
            localPosition1=[0.0, y, 0.0],
            stiffness=list(spring.stiffness),
            damping=list(spring.damping),
        )
    fixed = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0))
    along = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
    mbs.AddObject(CoordinateConstraint(markerNumbers=[fixed, along]))

    def state(quantity: exu.OutputVariableType) -> Array:
        return mbs.GetNodeOutput(node, quantity)

    rows = []

    def record(mbs: exu.MainSystem, end_of_step: float) -> bool:
        axle = state(exu.OutputVariableType.RotationMatrix).reshape(3, 3)[:, 1]
        _, y, _ = state(exu.OutputVariableType.Position)
        rows.append((end_of_step - step, y, state(exu.OutputVariableType.Velocity)[1], math.atan2(-axle[0], axle[1])))
        return True

    with ExitStack() as stack:
        contacts = [stack.enter_context(NativeContact(fmu, given, side)) for side in SIDES]

        def wheel_rail_forces(mbs: exu.MainSystem, time: float, *connector: object) -> Array:
            """Return the load for exudyn. The sign is reversed, since a connector pulls its second marker back."""
            centre, velocity = state(exu.OutputVariableType.Position), state(exu.OutputVariableType.Velocity)
            axle = state(exu.OutputVariableType.RotationMatrix).reshape(3, 3)[:, 1]
            rotation = state(exu.OutputVariableType.AngularVelocity)
            return -sum(contact.wrench(centre, axle, velocity, rotation) for contact in contacts)

        mbs.AddObject(
            RigidBodySpringDamper(
                markerNumbers=[mbs.AddMarker(MarkerBodyRigid(bodyNumber=b)) for b in (ground, body)],
                springForceTorqueUserFunction=wheel_rail_forces,
            )
        )
        mbs.SetPreStepUserFunction(record)
        mbs.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.endTime = duration
        settings.timeIntegration.numberOfSteps = round(duration / step)
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write = False
        if not mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK44):
            raise RuntimeError("exudyn could not solve the equations of motion")
    return Motion(*np.array(rows).T)


def our_own(given: Scenario, lateral: float, duration: float, step: float = 2e-4) -> Motion:
    """Run the same case with the vehicle of this package."""
    simulation = system.simulation(given, lateral)
    i, rows = simulation.model.wheelsets[0], []
    for _ in range(round(duration / step)):
        q, u = simulation.state.q[i], simulation.state.u[i]
        rows.append((simulation.time, q[Axis.Y], u[Axis.Y], q[Axis.YAW]))
        simulation.advance(step)
    return Motion(*np.array(rows).T)


def apart(theirs: Motion, own: Motion) -> float:
    """Return the largest difference of the lateral displacements [m]."""
    return float(np.abs(theirs.lateral - np.interp(theirs.time, own.time, own.lateral)).max())


def hunting(motion: Motion) -> tuple[float, float]:
    """Return frequency [Hz] and growth rate [1/s] of the lateral motion, from all its half periods."""
    t, y, v = motion.time, motion.lateral, motion.rate
    k = np.flatnonzero(np.diff(np.sign(y)))
    crossings = t[k] - y[k] * (t[k + 1] - t[k]) / (y[k + 1] - y[k])
    half = float(np.diff(crossings).mean())
    window = (t >= crossings[0]) & (t <= crossings[-1])
    envelope = 0.5 * np.log(y[window] ** 2 + (v[window] * half / math.pi) ** 2)
    return 0.5 / half, float(np.polyfit(t[window], envelope, 1)[0])


def report(fmu: Path, duration: float = 1.5) -> list[tuple[float, Motion, Motion]]:
    """Run both models from 1 mm at SPEEDS, print a comparison and return the motions."""
    print("speed    frequency [Hz]     growth [1/s]      difference")
    print(" [m/s]   exudyn     own    exudyn     own     [mm]")
    runs, growths = [], []
    for speed in SPEEDS:
        given = on_rigid_track(speed)
        runs.append((speed, in_exudyn(fmu, given, 1e-3, duration), our_own(given, 1e-3, duration)))
        (f, growth), (own_f, own_growth) = map(hunting, runs[-1][1:])
        growths.append((growth, own_growth))
        difference = 1e3 * apart(*runs[-1][1:])
        print(f"{speed:6.1f} {f:8.3f} {own_f:7.3f} {growth:9.3f} {own_growth:7.3f} {difference:8.3f}", flush=True)
    limits = (float(np.interp(0.0, column, SPEEDS)) for column in zip(*growths, strict=True))
    print("critical speed: {:.1f} m/s in exudyn, {:.1f} m/s with the own model".format(*limits))
    return runs


def picture(runs: list[tuple[float, Motion, Motion]], path: Path) -> None:
    """Draw the lateral displacement of both models over time, one panel for each speed."""
    from matplotlib.figure import Figure

    figure = Figure((8.0, 1.7 * len(runs)), layout="constrained")
    for axes, (speed, exudyn, own) in zip(figure.subplots(len(runs), sharex=True), runs, strict=True):
        axes.plot(exudyn.time, 1e3 * exudyn.lateral, label="exudyn + native FMU")
        axes.plot(own.time, 1e3 * own.lateral, "--", label="vehicle of this package")
        axes.set_ylabel(f"y [mm] at {speed:g} m/s")
        axes.grid(alpha=0.3)
    figure.axes[0].legend(loc="upper right", fontsize="small")
    figure.axes[-1].set_xlabel("time [s]")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=150)


def _about_x(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, default=Path("dist/native/WheelRailContact.fmu"), help="the native FMU")
    parser.add_argument("--picture", type=Path, help="write a picture of the motions to this file")
    arguments = parser.parse_args()
    if not arguments.fmu.is_file():
        parser.error(f"{arguments.fmu} is missing; build it with  python build_fmu.py --packaging native")
    runs = report(arguments.fmu)
    if arguments.picture:
        picture(runs, arguments.picture)


if __name__ == "__main__":
    main()
