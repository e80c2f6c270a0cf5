"""The native packaging: FMUs without Python, their kernels compiled from the very sources that Python runs."""
