"""Published cases of the field beside this library, one module a case. `python -m benchmarks.proof` writes the pages."""
