"""Check the FMUs that the command line names."""

import sys

from . import main

sys.exit(main(sys.argv[1:]))
