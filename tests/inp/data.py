"""Small input files after examples of CONTACT 25.1, printed results in its form, and a place of its search."""

import numpy as np

from contact.inp.search import Found

HEAD = """ 3 MODULE
 {word}
 {second}
 {third}
   999 100 30 {maxout} 1e-6
"""
#: 2-D Carter/Fromm problem: one row of elements (CONTACT 25.1, carter2d).
CARTER = (
    HEAD.format(word="203100", second="022020", third="0001341", maxout=1)
    + """ 35780. -0.00024 0. 0.
 0.3 0.3
 0. 0.0401 30000.
 0.28 0.28 82000. 82000.
 3
 55 1 -1.05 0. 0.04 200.
 1 1
 0.001 0 0 0 0 0
 0 MODULE
"""
)
#: Results of CARTER as CONTACT 25.1 prints them (carter2d.ref_out), with the approach left open.
PRINTED = """ Case     1

 TOTAL FORCES, TORSIONAL MOMENT, ELASTIC ENERGY, FRICTIONAL POWER
     FN          FX          FY          MZ         ELAST.EN.   FRIC.POWER
     3.578E+04   6955.       0.000       0.000      0.1162      -47.62
     FN/G      FX/FSTAT/FN  FY/FSTAT/FN  APPROACH     PMAX
    0.4363      0.6480       0.000      {approach}   113.9
"""


def found(y, angle, weight=1.0):
    """Return a place of contact 2 mm wide."""
    ends = np.array([[y - 1e-3, 0.0], [y + 1e-3, 0.0]])
    return Found(np.array([0.0, y, 0.0]), angle, weight, (-1e-3, 1e-3), ends)
