"""Ecos: the coupled wheelset from its SSP, 80 ms in steps of 20 µs. Usage: ecos_coupled.py SSP."""

import sys

from ecospy import EcosSimulation

with EcosSimulation(ssp_path=sys.argv[1], step_size=2e-5) as simulation:
    simulation.init(parameter_set="coupled")
    for _ in range(4):
        simulation.step(1000)
        print("lateral", repr(simulation.get_real("vehicle::body[2].y")))
