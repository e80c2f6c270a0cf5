"""The contact explorer: one web page in which the kernels of `WheelRailPair`, as WebAssembly, answer sliders.

`python -m explorer` writes dist/explorer.html, a single file that needs no server.
"""
