"""Compiled code of a vehicle. It has its own folder because kernels are cached by the content of their folder."""
