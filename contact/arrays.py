"""The type of arrays of numbers, by one name for all modules."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
