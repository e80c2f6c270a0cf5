"""Headers of the FMI project (2-clause BSD licence), of which fmpy has a copy."""

from pathlib import Path

import fmpy

HEADERS = Path(fmpy.__file__).parent / "c-code"
