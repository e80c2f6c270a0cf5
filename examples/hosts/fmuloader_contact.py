"""fmuloader: one step of an FMU with the bare calls of FMI 2.0. Usage: fmuloader_contact.py FMU [INPUT VALUE OUTPUT]."""

import sys
import zipfile
from xml.etree import ElementTree

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

given, value, wanted = sys.argv[2:] or ("creepage.longitudinal", "1e-3", "force.x")
with zipfile.ZipFile(sys.argv[1]) as archive:
    description = ElementTree.fromstring(archive.read("modelDescription.xml"))
reference = {v.get("name"): int(v.get("valueReference")) for v in description.iter("ScalarVariable")}
contact = Fmi2Slave(sys.argv[1], model_identifier=description.get("modelName"))
contact.instantiate("contact", Fmi2Type.CO_SIMULATION, guid=description.get("guid"))
contact.setup_experiment(0.0)
contact.enter_initialization_mode()
contact.set_real([reference[given]], [float(value)])
contact.exit_initialization_mode()
contact.do_step(0.0, 1e-3)
print(wanted, repr(contact.get_real([reference[wanted]])[0]))
contact.terminate()
contact.free_instance()
