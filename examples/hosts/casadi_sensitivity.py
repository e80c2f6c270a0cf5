"""CasADi: an FMU as a differentiable function, from model exchange. Usage: casadi_sensitivity.py FMU [INPUT VALUE OUTPUT]."""

import sys
import tempfile
import zipfile

import casadi
import numpy as np

given, value, wanted = sys.argv[2:] or ("creepage.longitudinal", "1e-3", "force.x")
with tempfile.TemporaryDirectory() as folder:
    zipfile.ZipFile(sys.argv[1]).extractall(folder)
    contact = casadi.DaeBuilder("contact", folder)
    force = contact.create("force", ["u"], ["y"])
    inputs = np.array([contact.start(name)[0] for name in contact.u()])
    i, k = contact.u().index(given), contact.y().index(wanted)
    inputs[i] = float(value)
    outputs = force(inputs)
    print(wanted, repr(float(outputs[k])))
    print("slope", repr(float(force.jacobian()(inputs, outputs)[k, i])))
