"""Version of the package, its library and its FMUs, and how it is cited. A test compares the version with pyproject.toml."""

__version__ = "0.8.0"
TITLE = "wheelrail-contact: non-elliptic wheel-rail contact, creep forces and damage"

_BIBTEX = """\
@software{{wheelrail_contact,
  author  = {{{{The wheelrail-contact authors}}}},
  title   = {{{title}}},
  year    = {{2026}},
  version = {{{version}}},
  license = {{MIT}},
}}

@phdthesis{{ShahzamanianSichani2016,
  author  = {{Shahzamanian Sichani, Matin}},
  title   = {{On Efficient Modelling of Wheel-Rail Contact in Vehicle Dynamics Simulation}},
  school  = {{KTH Royal Institute of Technology}},
  address = {{Stockholm}},
  year    = {{2016}},
  number  = {{TRITA-AVE 2016:02}},
  isbn    = {{978-91-7595-846-0}},
}}
"""


def cite() -> str:
    """Return two BibTeX entries: this software in its installed version, and the thesis that it implements.

    Examples
    --------
    >>> import contact
    >>> print(contact.cite().splitlines()[0])
    @software{wheelrail_contact,
    """
    return _BIBTEX.format(title=TITLE, version=__version__)
