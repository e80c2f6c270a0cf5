"""Published cases of the field beside this library. `python -m benchmarks.proof` writes docs/check/proof.md."""
