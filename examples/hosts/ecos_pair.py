"""Ecos: two steps of the pair with one input given. Usage: ecos_pair.py FMU INPUT VALUE OUTPUT."""

import sys

from ecospy import EcosSimulation, EcosSimulationStructure

path, given, value, wanted = sys.argv[1:]
with EcosSimulationStructure() as structure:
    structure.add_model("pair", path)
    structure.add_parameter_set("given", {f"pair::{given}": float(value)})
    with EcosSimulation(structure=structure, step_size=1e-3) as simulation:
        simulation.init(parameter_set="given")
        simulation.step(2)
        print(wanted, repr(simulation.get_real(f"pair::{wanted}")))
