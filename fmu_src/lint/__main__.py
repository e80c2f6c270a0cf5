"""Check the FMUs that the command line names."""

import sys

from fmu_src.lint import main

sys.exit(main(sys.argv[1:]))
