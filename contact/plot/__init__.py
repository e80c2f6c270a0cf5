"""Figures of solutions in the style of the thesis. Only this package of the library imports matplotlib.

The functions do not use pyplot's global state. Each returns a `matplotlib.figure.Figure` (``figure.savefig("patch.png")``)
or draws on the axes or figure that it is given.
"""

try:
    import matplotlib as _matplotlib  # noqa: F401
except ImportError as missing:
    raise ImportError("contact.plot needs matplotlib: pip install 'wheelrail-contact[plot]'") from missing

from contact.plot.comparison import comparison
from contact.plot.display import show_in_notebooks
from contact.plot.lines import curve, time_histories
from contact.plot.passage import passage
from contact.plot.patches import patch
from contact.plot.position import Wheel, position
from contact.plot.profiles import profile_check, profiles
from contact.plot.rolling import conicity, contact_points
from contact.plot.shakedown import shakedown
from contact.plot.stress import stress
from contact.plot.wear import fatigue, shares, wear, worn_profile

__all__ = [
    "Wheel",
    "comparison",
    "conicity",
    "contact_points",
    "curve",
    "fatigue",
    "passage",
    "patch",
    "position",
    "profile_check",
    "profiles",
    "shakedown",
    "shares",
    "stress",
    "time_histories",
    "wear",
    "worn_profile",
]

show_in_notebooks()
