# Every target makes its own environment in .venv; all it needs is Python 3.11 or newer with venv, and the network once.
#
#   make demo         the main job on built-in input; the report is demo-run/report.html
#   make test         the test suite (with CI=true: all of it, else without the tests marked slow)
#   make test-all     all of the test suite
#   make test-lowest  the tests without the slow ones, with the lowest supported version of every dependency (Python 3.11)
#   make test-plain   the tests without the slow ones, without the fast transforms
#   make coverage     which lines the tests without the slow ones run; pages in htmlcov/
#   make lint         style and types; `make style`, `make layout` and `make types` one by one
#   make fix          mends what ruff can mend
#   make hooks        checks style and types before every commit (pre-commit)
#   make release-check  one version everywhere; archives in dist/, checked and installed with the newest and the lowest dependencies; the site and its links (LINKS=--external asks other sites too)
#   make bench        every benchmark: tables and picture of benchmarks/README.md, ten minutes (BENCH="layered paths" some, BENCH=--full all sizes, hours)
#   make validate     every page of validation/ anew, one process at a time, their summary, and pictures in PICTURES=validation-pictures
#   make docs         the site in build/docs/html, without network; warnings are errors
#   make docs-serve   shows it on http://127.0.0.1:8000 (PORT=8000), on this machine only
#   make clean        remove the environments and everything that was built
#
# PYTHON=/path/to/python chooses the interpreter, VENV=folder the environment, WORKERS=n the test processes,
# EXTRAS=[fast,dask] the extras, GROUP=test less than all the tools of a developer.

VENV    ?= .venv
WORKERS ?= 2
PYTHON  ?=
EXTRAS  ?= [fast]
GROUP   ?= dev

BIN     := $(VENV)/bin
USER_OK := $(VENV)/.installed
DEV_OK  := $(VENV)/.installed-dev
DOCS_OK := $(VENV)/.installed-docs
SOURCES := $(wildcard .ci src tests benchmarks examples validation docs)

# One thread per test process: two processes on two cores must not become four threads.
ONE_THREAD := ASPERITY_THREADS=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
# Each process has a half of the tests in their order, so that what a module solves for its tests is solved once, and takes from the other's at the end.
PYTEST     := $(ONE_THREAD) $(BIN)/python -m pytest -n $(WORKERS) --dist worksteal
SELECTION  := $(if $(filter true 1,$(CI)),,-m "not slow")

.DEFAULT_GOAL := help
.PHONY: help demo test test-all test-lowest test-plain coverage lint style layout types fix hooks release-check bench validate docs docs-serve clean

help:
	@sed -n 's/^#   //p' Makefile

demo: $(USER_OK)
	$(BIN)/asperity demo --out demo-run --force

test: $(DEV_OK)
	$(PYTEST) $(SELECTION)

test-all: $(DEV_OK)
	$(PYTEST)

# Libraries of that age warn of what they use themselves, so warnings are no errors here.
test-lowest:
	PIP_CONSTRAINT="$(CURDIR)/.ci/lowest.txt" $(MAKE) VENV=.venv-lowest EXTRAS="[fast,dask]" GROUP=test .venv-lowest/.installed-dev
	$(ONE_THREAD) .venv-lowest/bin/python -m pytest -n $(WORKERS) -m "not slow" -o filterwarnings=ignore

test-plain:
	$(MAKE) VENV=.venv-plain EXTRAS= GROUP=test .venv-plain/.installed-dev
	$(ONE_THREAD) .venv-plain/bin/python -m pytest -n $(WORKERS) -m "not slow"

coverage: $(DEV_OK)
	$(PYTEST) -m "not slow" --cov --cov-report= && $(BIN)/coverage html --quiet && $(BIN)/coverage report --format=total

lint: style layout types

style: $(DEV_OK)
	$(BIN)/ruff check $(SOURCES)

layout: $(DEV_OK)
	$(BIN)/ruff format --check $(SOURCES)

types: $(DEV_OK)
	$(BIN)/mypy

fix: $(DEV_OK)
	$(BIN)/ruff check --fix $(SOURCES)
	$(BIN)/ruff format $(SOURCES)

hooks: $(DEV_OK)
	$(BIN)/pre-commit install

# No index of packages but the one that pip knows. The archives are left in dist/.
release-check: $(DEV_OK) $(DOCS_OK)
	$(BIN)/python .ci/release_check.py $(LINKS)

bench: $(DEV_OK)
	$(BIN)/python benchmarks/bench.py $(BENCH)

# Scripts with a page; stops at the end, with an error, if one of them disagrees with what was published.
PAGES    := $(filter-out validation/README.md,$(sort $(wildcard validation/*.md)))
PICTURES ?= validation-pictures

validate: $(DEV_OK)
	@status=0; for page in $(PAGES:.md=.py); do $(ONE_THREAD) $(BIN)/python $$page || status=1; done; \
	$(BIN)/python validation/summary.py || status=1; \
	$(ONE_THREAD) $(BIN)/python validation/pictures.py $(PICTURES) || status=1; exit $$status

docs: $(DOCS_OK)
	$(BIN)/python docs/site/build.py

PORT ?= 8000

docs-serve: docs
	$(BIN)/python -m http.server --bind 127.0.0.1 --directory build/docs/html $(PORT)

clean:
	rm -rf $(VENV) .venv-lowest .venv-plain build dist demo-run validation-pictures htmlcov
	rm -rf .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks .coverage .coverage.*
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
	$(BIN)/python -m pip install --quiet --editable ".$(EXTRAS)"
	@touch $@

$(DEV_OK): $(USER_OK)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --group $(GROUP)
	@touch $@

$(DOCS_OK): $(USER_OK)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --group docs
	@touch $@
