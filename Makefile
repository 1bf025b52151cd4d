# Everything a person does with this project. A first run installs what it needs and says so.
PYTHON ?= python3
VENV := .venv
# OFF builds without SUNDIALS and its hundreds of packages: without the methods bdf and adams.
CVODE ?= ON
export PYTHON VENV CVODE
# Python keeps what it has compiled, since tests start it hundreds of times.
unexport PYTHONDONTWRITEBYTECODE
# Tools come from the venv; make's own PATH stays, so that PYTHON means the same throughout.
IN_VENV := PATH="$(CURDIR)/$(VENV)/bin:$$PATH"

SPHINX := python -m sphinx -W --keep-going -q

.NOTPARALLEL:
.PHONY: help demo test lint format validate bench bench-smoke compare view-test wheel docs docs-links asan tsan fuzz builds test-arm64 lock audit clean setup setup-dev setup-docs test-cpp types test-python

help: ## list the commands
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: setup ## install cdcr, pull cable 1 of the paper's robot with 5 N, write picture and data to out/
	@echo "[4/4] cdcr run step-tension"
	@$(VENV)/bin/cdcr run step-tension --out out --overwrite

test: setup-dev ## all tests, C++ and Python, and the type checks
	@$(IN_VENV) tools/test.sh

lint: setup-dev ## style and static analysis: clang-format, clang-tidy, ruff, mypy, gersemi, codespell
	@mkdir -p build
	@$(IN_VENV) make --no-print-directory --keep-going --output-sync=target -j "$$(nproc)" \
	  -f tools/lint.mk
	@echo "lint: no complaints"

format: setup-dev ## rewrite all sources in the project's style
	@$(IN_VENV) tools/format.sh

# Where measurements and results of others are: validation/README.md says which.
DATA ?= validation/data
validate: setup-dev ## the table of how true it is, of the sources whose data are in DATA=FOLDER
	@$(IN_VENV) python validation/all.py $(DATA)

bench: setup-dev ## build and run the benchmarks
	@$(IN_VENV) cmake --preset bench
	@$(IN_VENV) cmake --build --preset bench
	@$(IN_VENV) python bench/run.py --build-dir build/bench

compare: setup ## set cdcr beside other software, in build/compare (1.5 GB); the figure goes to out/
	@mkdir -p out
	@VENV="$(VENV)" tools/compare.sh --figure out/compare.png

bench-smoke: setup-dev
	@$(IN_VENV) cmake --preset bench
	@$(IN_VENV) cmake --build --preset bench
	@set -e; for program in build/bench/bench/bench_*; do \
	  if [ -f $$program ]; then $(IN_VENV) $$program --quick >/dev/null; fi; done

view-test: setup-dev ## the live view in a real browser (Debian's chromium, by Playwright); its frame rate
	@command -v chromium >/dev/null || { echo "make view-test: apt-get install chromium" >&2; exit 1; }
	@$(IN_VENV) python -m pip install --quiet --group browser
	@$(IN_VENV) pytest tests/python/test_view_browser.py

wheel: setup-dev ## a wheel that needs nothing installed, in dist/
	@$(IN_VENV) tools/wheel.sh

docs: setup-docs ## the documentation site in build/docs; every page's code runs, warnings are errors
	@rm -rf build/docs
	@$(IN_VENV) $(SPHINX) -E -b html -d build/docs-doctrees docs build/docs
	@$(IN_VENV) python docs/check_site.py build/docs

docs-links: setup-docs ## look up the links of the site that lead elsewhere
	@$(IN_VENV) $(SPHINX) -b linkcheck -D nb_execution_mode=off docs build/docs-links

asan: setup-dev ## C++ tests under the address and undefined-behaviour sanitizers
	@$(IN_VENV) cmake --preset asan
	@$(IN_VENV) cmake --build --preset asan
	@$(IN_VENV) ctest --preset asan

tsan: setup-dev ## C++ tests of threads under the thread sanitizer
	@$(IN_VENV) cmake --preset tsan
	@$(IN_VENV) cmake --build --preset tsan
	@$(IN_VENV) ctest --preset tsan -R 'cpp.(threads|simulate|cvode|loop_log)'

# How long each target of make fuzz runs.
SECONDS ?= 60
fuzz: setup-dev ## fuzz the C++ interface and the readers of files, SECONDS=60 each, by clang
	@$(IN_VENV) cmake --preset fuzz
	@$(IN_VENV) cmake --build --preset fuzz
	@$(IN_VENV) tools/fuzz.sh $(SECONDS)

builds: setup-dev ## other ways to build, tested: clang, AVX2, shared and hidden, without CVODE (an hour)
	@$(IN_VENV) tools/builds.sh

test-arm64: setup-dev ## C++ tests built for 64-bit ARM, under qemu-user; exported C for a Cortex-M7
	@$(IN_VENV) nice -n 19 tools/arm64.sh

lock: setup-dev ## find the versions and hashes of tools/lock anew
	@$(IN_VENV) python -m pip install --quiet --group lock
	@$(IN_VENV) tools/lock.sh

audit: setup-dev ## look up known vulnerabilities of what tools/lock installs
	@$(IN_VENV) python -m pip install --quiet --group lock
	@$(IN_VENV) pip-audit --strict --require-hashes --disable-pip \
	  $(patsubst %,-r %,$(wildcard tools/lock/*.txt))

clean: ## remove what make made, .venv included; out/ stays
	rm -rf build dist $(VENV) .mypy_cache .pytest_cache .ruff_cache .hypothesis

setup:
	@tools/setup.sh demo

setup-dev:
	@tools/setup.sh dev

setup-docs:
	@tools/setup.sh docs

test-cpp: setup-dev
	@$(IN_VENV) tools/test.sh cpp

types: setup-dev
	@$(IN_VENV) tools/test.sh types

test-python: setup-dev
	@$(IN_VENV) tools/test.sh python
