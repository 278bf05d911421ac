# Every target makes its own environment in .venv; all it needs is Python 3.11 or newer with venv, and the network once.
#
#   make demo       the main job on built-in input; the report is demo-run/report.html
#   make test       the test suite (with CI=true: all of it, else without the tests marked slow)
#   make test-all   all of the test suite
#   make lint       style and types
#   make bench      speed, as ratios, against other packages if they are installed (BENCH="--sizes 256" passes options)
#   make validate   every page of validation/ anew, one process at a time, and pictures in PICTURES=validation-pictures
#   make clean      remove the environment and everything that was built
#
# PYTHON=/path/to/python chooses the interpreter, VENV=folder the environment, WORKERS=n the test processes.

VENV    ?= .venv
WORKERS ?= 2
PYTHON  ?=

BIN     := $(VENV)/bin
USER_OK := $(VENV)/.installed
DEV_OK  := $(VENV)/.installed-dev
SOURCES := $(wildcard src tests benchmarks examples validation)

# One thread per test process: two processes on two cores must not become four threads.
ONE_THREAD := ASPERITY_THREADS=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
PYTEST     := $(ONE_THREAD) $(BIN)/python -m pytest -n $(WORKERS)
SELECTION  := $(if $(filter true 1,$(CI)),,-m "not slow")

.DEFAULT_GOAL := help
.PHONY: help demo test test-all lint bench validate clean

help:
	@sed -n 's/^#   //p' Makefile

demo: $(USER_OK)
	$(BIN)/asperity demo --out demo-run --force

test: $(DEV_OK)
	$(PYTEST) $(SELECTION)

test-all: $(DEV_OK)
	$(PYTEST)

lint: $(DEV_OK)
	$(BIN)/ruff check $(SOURCES)
	$(BIN)/ruff format --check $(SOURCES)
	$(BIN)/mypy

bench: $(DEV_OK)
	$(BIN)/python benchmarks/run.py $(BENCH)

# Scripts with a page; stops at the end, with an error, if one of them disagrees with what was published.
PAGES    := $(filter-out validation/README.md,$(sort $(wildcard validation/*.md)))
PICTURES ?= validation-pictures

validate: $(DEV_OK)
	@status=0; for page in $(PAGES:.md=.py); do $(ONE_THREAD) $(BIN)/python $$page || status=1; done; \
	$(ONE_THREAD) $(BIN)/python validation/peng_pictures.py $(PICTURES) || status=1; exit $$status

clean:
	rm -rf $(VENV) build dist demo-run validation-pictures .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks .coverage
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +

# The first interpreter that runs, is new enough and can make environments; names on the PATH may be dead shims.
$(USER_OK): pyproject.toml
	@set -e; \
	for candidate in $(if $(PYTHON),"$(PYTHON)",python3 python3.14 python3.13 python3.12 python3.11 python); do \
	  if "$$candidate" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	    python="$$candidate"; break; \
	  fi; \
	done; \
	if [ -z "$${python:-}" ]; then \
	  echo "asperity needs Python 3.11 or newer with the modules venv and ensurepip (Debian: python3-venv), but" \
	    "$(if $(PYTHON),PYTHON=$(PYTHON) is not such a one,none is on the PATH; name one by make PYTHON=/path/to/python)." >&2; \
	  exit 1; \
	fi; \
	echo "environment $(VENV): $$("$$python" --version)"; \
	"$$python" -m venv "$(VENV)"
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade "pip>=25.1"
	$(BIN)/python -m pip install --quiet --editable ".[fast]"
	@touch $@

$(DEV_OK): $(USER_OK)
	$(BIN)/python -m pip install --quiet --group dev
	@touch $@
