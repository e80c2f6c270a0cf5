"""fmuloader: one step of the FMU with nothing but the calls of FMI 2.0. Usage: fmuloader_contact.py FMU."""

import sys
import zipfile
from xml.etree import ElementTree

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

with zipfile.ZipFile(sys.argv[1]) as archive:
    description = ElementTree.fromstring(archive.read("modelDescription.xml"))
reference = {v.get("name"): int(v.get("valueReference")) for v in description.iter("ScalarVariable")}
contact = Fmi2Slave(sys.argv[1], model_identifier=description.get("modelName"))
contact.instantiate("contact", Fmi2Type.CO_SIMULATION, guid=description.get("guid"))
contact.setup_experiment(0.0)
contact.enter_initialization_mode()
contact.set_real([reference["creepage.longitudinal"]], [1e-3])
contact.exit_initialization_mode()
contact.do_step(0.0, 1e-3)
print("force.x", repr(contact.get_real([reference["force.x"]])[0]))
contact.terminate()
contact.free_instance()
