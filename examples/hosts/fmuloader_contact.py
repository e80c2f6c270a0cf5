"""fmuloader: one step of an FMU with the bare calls of FMI 2.0 or 3.0. Usage: fmuloader_contact.py FMU [INPUT VALUE OUTPUT].

Of an FMU of FMI 3.0 it also prints the slope of the output by the input, as a directional and as an adjoint derivative.
"""

import sys
import zipfile
from xml.etree import ElementTree

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type
from fmuloader.fmi3 import Fmi3Slave

given, value, wanted = sys.argv[2:] or ("creepage.longitudinal", "1e-3", "force.x")
with zipfile.ZipFile(sys.argv[1]) as archive:
    description = ElementTree.fromstring(archive.read("modelDescription.xml"))
of_3 = description.get("fmiVersion").startswith("3")
variables = description.find("ModelVariables")
reference = {v.get("name"): int(v.get("valueReference")) for v in variables}
contact = (Fmi3Slave if of_3 else Fmi2Slave)(sys.argv[1], model_identifier=description.get("modelName"))
if of_3:
    contact.instantiate_co_simulation("contact", instantiation_token=description.get("instantiationToken"))
    contact.enter_initialization_mode(start_time=0.0)
    contact.set_float64([reference[given]], [float(value)])
else:
    contact.instantiate("contact", Fmi2Type.CO_SIMULATION, guid=description.get("guid"))
    contact.setup_experiment(0.0)
    contact.enter_initialization_mode()
    contact.set_real([reference[given]], [float(value)])
contact.exit_initialization_mode()
contact.do_step(0.0, 1e-3)
get = contact.get_float64 if of_3 else contact.get_real
print(wanted, repr(get([reference[wanted]])[0]))
if of_3:
    unknown, known = [reference[wanted]], [reference[given]]
    print("directional", repr(contact.get_directional_derivative(unknown, known, [1.0])[0]))
    print("adjoint", repr(contact.get_adjoint_derivative(unknown, known, [1.0])[0]))
contact.terminate()
contact.free_instance()
