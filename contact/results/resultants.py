"""`Forces` of arrays of cases, and `CaseForces` of one case: what is known of a contact without its fields."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import brief
from contact.kernels.enumerations import Status
from contact.results.jacobian import Jacobian
from contact.view.tables import ArrayOfResults

Numbers = float | NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Forces(ArrayOfResults):
    """Results of arrays of cases. Each member is an array of the input's broadcast shape; units and signs as in `Solution`.

    `jacobian` is None unless it was asked for. In `to_dataframe` and `to_xarray` inputs name the axes along which they vary.

    Examples
    --------
    >>> import contact
    >>> gap = contact.Separation.hertzian(1.1, 0.8)
    >>> found = contact.forces(gap, contact.Creepage(1e-3), load=[40e3, 80e3])
    >>> found.N.tolist(), found.status.tolist()
    ([40000.0, 80000.0], [1, 1])
    """

    Fx: Numbers
    Fy: Numbers
    Mz: Numbers
    N: Numbers
    approach: Numbers
    max_pressure: Numbers
    area: Numbers
    slip_ratio: Numbers
    power_per_metre: Numbers
    status: int | NDArray[np.int64]
    gap_error: Numbers
    jacobian: Jacobian | None = None

    __repr__ = brief

    __getstate__ = ArrayOfResults.__getstate__  # with the names of the axes
    __setstate__ = ArrayOfResults.__setstate__


@dataclass(frozen=True, slots=True)
class CaseForces(Forces):
    """Results of one case: `Forces` with numbers instead of arrays."""

    Fx: float
    Fy: float
    Mz: float
    N: float
    approach: float
    max_pressure: float
    area: float
    slip_ratio: float
    power_per_metre: float
    status: Status
    gap_error: float
