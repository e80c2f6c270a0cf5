"""The native packaging: FMUs that need no Python. Their kernels are compiled from the sources that Python runs."""
