"""Compiled code of the solvers, shared by the library, batches and FMUs."""
