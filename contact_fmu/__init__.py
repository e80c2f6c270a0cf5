"""The name that the package `fmu_src` has in an installation, in a checkout too. See `contact_models`."""

from contact_models import Alias

Alias(__name__, "fmu_src")
