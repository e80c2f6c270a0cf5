"""CasADi: the contact as a differentiable function, from the FMU for model exchange. Usage: casadi_sensitivity.py FMU."""

import sys
import tempfile
import zipfile

import casadi
import numpy as np

with tempfile.TemporaryDirectory() as folder:
    zipfile.ZipFile(sys.argv[1]).extractall(folder)
    contact = casadi.DaeBuilder("contact", folder)
    force = contact.create("force", ["u"], ["y"])
    inputs = np.array([contact.start(name)[0] for name in contact.u()])
    xi, Fx = contact.u().index("creepage.longitudinal"), contact.y().index("force.x")
    inputs[xi] = 1e-3
    outputs = force(inputs)
    print("force.x", repr(float(outputs[Fx])))
    print("d force.x/d creepage", repr(float(force.jacobian()(inputs, outputs)[Fx, xi])))
