# Everything runs in .venv, which is built when it is missing, unfinished, moved or out of date.
# Needs only make and Python 3.11 or newer. To choose the Python: make test PYTHON=python3.13

PYTHON ?=
PYTEST_ARGS ?=
VENV := .venv
BIN := $(VENV)/bin

# Parallel runs use processes; threads below them only slow them down.
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1
export MKL_NUM_THREADS := 1

.DEFAULT_GOAL := help
.PHONY: help venv demo test lint bench

help:
	@echo "make demo    flutter boundary of the three-segment wing, compared with measurements"
	@echo "make test    all tests (some of them: make test PYTEST_ARGS='-k hinge')"
	@echo "make lint    style, types and the layers of imports"
	@echo "make bench   benchmarks"

demo: venv
	$(BIN)/foldwing boundary three-segment --fold2 0:150:2.5 --fold3 level \
	    --measured level-tip-wind-tunnel --trace

test: venv
	$(BIN)/python -m pytest -q -n auto --maxprocesses 8 $(PYTEST_ARGS)

lint: venv
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy --strict src
	$(BIN)/lint-imports

bench: venv
	@for script in benchmarks/*.py; do \
	    echo "$$script"; \
	    $(BIN)/python "$$script" || exit 1; \
	done

# The stamp is written last, so that an interrupted build counts as none. Its lines: this folder,
# the Python below the environment, the checksum of pyproject.toml.
STAMP := $(VENV)/complete
stamped = $$(sed -n $(1)p $(STAMP) 2>/dev/null || :)

# The Python below a command, also when that command belongs to an active virtual environment.
BASE := import os, sys; sys.version_info < (3, 11) and sys.exit(1); \
    print(os.path.realpath(getattr(sys, "_base_executable", sys.executable)))

define find_python
	base=; seen=; \
	for name in $(if $(PYTHON),"$(PYTHON)",python3 python3.14 python3.13 python3.12 python3.11); do \
	    if ! command -v "$$name" >/dev/null; then seen="$$seen, $$name (not found)"; continue; fi; \
	    base=$$("$$name" -c '$(BASE)' 2>/dev/null) && break; \
	    base=; seen="$$seen, $$name ($$("$$name" -V 2>&1 | head -n 1))"; \
	done; \
	if [ -z "$$base" ]; then \
	    echo "foldwing needs Python 3.11 or newer; tried$${seen#,}." >&2; \
	    echo "Install one, or say where it is: make PYTHON=/path/to/python3.11 ..." >&2; \
	    exit 1; \
	fi
endef

# One run compiles the modules that runs need: all of them would take half as much space again.
define compile_what_runs
	scratch=$$(mktemp -d); \
	env -u PYTHONDONTWRITEBYTECODE $(BIN)/foldwing flutter goland --out "$$scratch/result" \
	    >/dev/null 2>&1 || :; \
	rm -rf "$$scratch"
endef

venv:
	@set -e; \
	checksum=$$(cksum < pyproject.toml); \
	base="$(call stamped,2)"; \
	usable=no; \
	if [ "$(call stamped,1)" = "$(CURDIR)" ] && $(BIN)/python -c 'import pytest' 2>/dev/null; then \
	    usable=yes; \
	fi; \
	if [ $$usable = no ] || [ -n "$(PYTHON)" ]; then \
	    $(find_python); \
	    if [ "$(call stamped,2)" != "$$base" ]; then usable=no; fi; \
	fi; \
	if [ $$usable = yes ] && [ "$(call stamped,3)" = "$$checksum" ]; then exit 0; fi; \
	rm -f $(STAMP); \
	if [ $$usable = no ]; then \
	    echo "Building $(VENV) with $$("$$base" -V); the first time takes a minute or two."; \
	    "$$base" -m venv --clear $(VENV); \
	else \
	    echo "Updating $(VENV): pyproject.toml has changed."; \
	fi; \
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile -e '.[dev]'; \
	$(compile_what_runs); \
	printf '%s\n' "$(CURDIR)" "$$base" "$$checksum" > $(STAMP).new; \
	mv $(STAMP).new $(STAMP)
