"""A small problem, and methods that solve it."""

import contact

METHODS = ("hertz+fastsim", "analyn+fastrip")


def problem(name="ellipse", **given):
    return contact.Case(
        contact.Separation.hertzian(1.1, 0.8), contact.Creepage(-1e-3, 5e-4, 0.1), **({"load": 60e3} | given), name=name
    )
