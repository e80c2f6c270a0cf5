"""Version of the package, its library and its FMUs. A test compares it with pyproject.toml."""

__version__ = "0.8.0"
