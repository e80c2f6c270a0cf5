# Every target installs what it needs, so `make demo` or `make test` can be the first command on a fresh machine.
PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
READY_FOR_DEMO := $(VENV)/.ready-for-demo
READY_FOR_DOCS := $(VENV)/.ready-for-docs

.DEFAULT_GOAL := help
.PHONY: help demo docs explorer test check coverage soak bounds traps wheels lint fmu accuracy proof bank bench coupling smoothness pictures format clean

help:            ## list the targets
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*##/\t/' | expand -t 12

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed; give its name with PYTHON=..."; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(READY): pyproject.toml | $(BIN)/python
	@echo "Setting up $(VENV) for development (some minutes the first time) ..."
	$(BIN)/python -m pip install --quiet --no-compile --editable '.[dev]'
	@touch $@ $(READY_FOR_DEMO)

$(READY_FOR_DEMO): pyproject.toml | $(BIN)/python
	@echo "Setting up $(VENV) for the demo (a minute the first time) ..."
	$(BIN)/python -m pip install --quiet --no-compile --editable '.[plot,native]'
	@touch $@

demo: $(READY_FOR_DEMO) ## build the FMUs, run the coupled wheelset, write pictures and a CSV to out/
	$(BIN)/python build_fmu.py --packaging python
	$(BIN)/contact demo --out out

fmu: $(READY)    ## build the FMUs into dist/native and dist/python (three and a half minutes of processor time the first time, then seconds)
	$(BIN)/python build_fmu.py --packaging all
	$(BIN)/python -m contact_fmu.lint dist/python/*.fmu dist/native/*.fmu dist/native/fmi3/*.fmu

test: $(READY)   ## run the tests
	$(BIN)/python -c 'from contact_fmu.native import systems; systems.folder()'
	$(BIN)/python -m pytest -n 2 --dist worksteal

check: $(READY)  ## run the quick tests (a minute once the library is built)
	$(BIN)/python -c 'import contact; contact.get_library()'
	$(BIN)/python -m pytest -n 2 --dist worksteal -m "not slow"

coverage: $(READY) ## run the quick tests and print which lines of the package no test runs (kernels are compiled: not seen)
	$(BIN)/python -c 'import contact; contact.get_library()'
	$(BIN)/python -m coverage run --source contact,contact_fmu,contact_models --omit '*/kernels/*' -m pytest -m "not slow"
	$(BIN)/python -m coverage report --skip-covered --show-missing

soak: $(READY)   ## check memory over a million steps of every native FMU, wrong calls, damaged files, vehicles under Wine (minutes)
	SOAK=1 $(BIN)/python -m pytest tests/system/test_native_host.py tests/system/test_native_sources.py tests/test_readers.py \
		tests/test_damaged_files.py -k "leave_memory or wrong_call or hard or damaged or random_calls or any_order or sanitizers or ehicle or option_arm"

KERNELS := tests/normal tests/tangential tests/pair tests/geometry tests/damage tests/test_properties.py tests/test_every_method.py tests/test_robustness.py
bounds: $(READY) ## run the tests of the kernels with numba's check of array bounds (twenty minutes)
	CONTACT_JIT=1 NUMBA_BOUNDSCHECK=1 $(BIN)/python -m pytest -n 2 --dist worksteal $(KERNELS)

traps: $(READY)  ## run the same tests with floating-point traps
	$(BIN)/python -c 'import contact; contact.get_library()'
	$(BIN)/python -m pytest -p tests.traps $(KERNELS)

SYSTEMS := linux64 aarch64-linux win64 darwin64 aarch64-darwin
wheels: $(READY) ## build the wheels of all systems into dist/wheels (five minutes the first time)
	for system in $(SYSTEMS); do $(BIN)/python -m build --no-isolation --wheel --config-setting system=$$system --outdir dist/wheels || exit 1; done

lint: $(READY)   ## ruff, mypy, import-linter
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

accuracy: $(READY) ## write the accuracy tables, with CONTACT's own methods for comparison, to docs/
	PYTHONPATH=. $(BIN)/python benchmarks/accuracy.py --write docs/check/accuracy.md
	PYTHONPATH=. $(BIN)/python benchmarks/normal_methods.py --write docs/check/normal_methods.md
	PYTHONPATH=. $(BIN)/python benchmarks/halfspace.py --write docs/check/halfspace.md
	PYTHONPATH=. $(BIN)/python -m benchmarks.manchester --write docs/check/manchester.md
	PYTHONPATH=. $(BIN)/python -m benchmarks.statistics --write docs/check/statistics.md

proof: $(READY)   ## write published cases beside ours to docs/check/proof.md
	PYTHONPATH=. $(BIN)/python -m benchmarks.proof

bank: $(READY)    ## run a folder of CONTACT's input files, BANK=folder, and write the tables of docs/use/from_contact.md
	PYTHONPATH=. $(BIN)/python benchmarks/contact_bank.py $(BANK) --write docs/use/from_contact.md

smoothness: $(READY) ## write jumps, noise and resolution of sweeps to docs/check/smoothness.md
	PYTHONPATH=. $(BIN)/python benchmarks/smoothness.py --write docs/check/smoothness.md

coupling: $(READY) ## write the largest stable steps of the coupling schemes to docs/check/coupling.md
	PYTHONPATH=. $(BIN)/python benchmarks/coupling.py --write docs/check/coupling.md

bench: $(READY)  ## print the speed tables
	PYTHONPATH=. $(BIN)/python benchmarks/pose_times.py
	PYTHONPATH=. $(BIN)/python benchmarks/vehicle_speed.py
	PYTHONPATH=. $(BIN)/python benchmarks/fmu_speed.py
	PYTHONPATH=. $(BIN)/python benchmarks/contact_features.py

$(READY_FOR_DOCS): $(READY)
	$(BIN)/python -m pip install --quiet --editable '.[docs]'
	@touch $@

EXPLORER := $(wildcard explorer/*.py explorer/*.c explorer/page/* fmu_src/contact_fmu/tables/*.py fmu_src/contact_fmu/native/*.py contact/compile/*.py) $(shell find contact/kernels -name '*.py')
dist/explorer.html: $(EXPLORER) | $(READY)
	$(BIN)/python -m explorer --out $@

explorer: dist/explorer.html ## compile the kernels to WebAssembly and write the contact explorer, one web page

docs: $(READY_FOR_DOCS) dist/explorer.html ## build the documentation site in build/docs/html; warnings, broken links and misspellings are errors
	PYTHONPATH="$(CURDIR)" $(BIN)/python -m sphinx -W --keep-going -q -b html docs build/docs/html
	$(BIN)/python docs/check.py build/docs/html
	$(BIN)/codespell $$(git ls-files '*.md' '*.py' '*.toml' '*.m' '*.c' '*.h' Makefile)
	@echo "build/docs/html/index.html"

pictures: $(READY) ## make the pictures of the README and of the page on vehicles
	PYTHONPATH=. $(BIN)/python docs/pictures/make.py

format: $(READY) ## format the code
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean:           ## remove generated files
	rm -rf dist out build .pytest_cache .mypy_cache .ruff_cache *.egg-info
