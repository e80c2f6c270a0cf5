"""CasADi: the coupled wheelset from its SSP, from model exchange. Usage: casadi_coupled.py SSP [STEP STEPS].

The forces are those at the start of a step and constant during it. They depend on the load, and the load on the forces, so the
load follows the forces of the step before.
"""

import sys
import tempfile
import zipfile
from pathlib import Path

import casadi
import numpy as np
from structure import read

ssp, step, steps = sys.argv[1], *(sys.argv[2:] or ("2e-4", "60"))
SUBSTEPS = 10  # of the integration


def imported(name, path, parameters):
    """Return an FMU with the parameters as its start values."""
    folder = Path(path).with_suffix("") / name
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    fmu = casadi.DaeBuilder(name, str(folder))
    for parameter, value in parameters.items():
        fmu.set_start(parameter, value)
    return fmu


with tempfile.TemporaryDirectory() as folder:
    paths, parameters, connections = read(ssp, folder)
    fmus = {name: imported(name, path, parameters[name]) for name, path in paths.items()}
    inputs = {name: np.array([fmu.start(u)[0] for u in fmu.u()]) for name, fmu in fmus.items()}
    places = [(a, fmus[a].y().index(output), b, fmus[b].u().index(input_)) for a, output, b, input_ in connections]
    # CasADi takes no variable twice, and the wheelset's outputs include derivatives: hence two functions
    derivatives, outputs = (fmus["wheelset"].create(kind, ["x", "u"], [kind]) for kind in ("ode", "y"))
    contacts = {name: fmu.create(name, ["u"], ["y"]) for name, fmu in fmus.items() if name != "wheelset"}
    x, u = casadi.MX.sym("x", fmus["wheelset"].nx()), casadi.MX.sym("u", fmus["wheelset"].nu())
    equations = {"x": x, "p": u, "ode": derivatives(x, u)}
    advance = casadi.integrator("advance", "rk", equations, 0.0, float(step), {"number_of_finite_elements": SUBSTEPS})

    def send(sender, values):
        """Give the outputs of an FMU to the inputs that they are connected to."""
        for a, output, b, input_ in places:
            if a == sender:
                inputs[b][input_] = float(values[output])

    # a function of the inputs alone has the states of the start
    at_start = fmus["wheelset"].create("at_start", ["u"], ["y"])(inputs["wheelset"])
    states = np.array([float(at_start[fmus["wheelset"].y().index(name)]) for name in fmus["wheelset"].x()])
    lateral = fmus["wheelset"].x().index("lateral")
    for _ in range(int(steps)):
        send("wheelset", outputs(states, inputs["wheelset"]))
        for name, solve in contacts.items():
            send(name, solve(inputs[name]))
        states = np.array(advance(x0=states, p=inputs["wheelset"])["xf"]).ravel()
        print("lateral", repr(float(states[lateral])))
