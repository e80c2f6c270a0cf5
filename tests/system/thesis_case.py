"""The methods of the thesis as values of an FMU. Their answers do not depend on earlier steps, so tests may compare bits."""

import contact
from contact_fmu.tables.solver import NORMAL_METHOD, TANGENTIAL_METHOD

THESIS = {
    "method.normal": NORMAL_METHOD.number(contact.THESIS["normal"]),
    "method.tangential": TANGENTIAL_METHOD.number(contact.THESIS["tangential"]),
    "resolution.n_strips": contact.THESIS["n_strips"],
    "resolution.n_elements": contact.THESIS["n_elements"],
}
