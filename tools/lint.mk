# Every linter to its end, side by side; fails when one of them complains. Needs the tools of
# pyproject.toml's group "lint" on PATH: make lint.
# How far the static analyzer of clang-tidy follows calls: shallow, or deep, as at night, for which
# it takes as long again as for everything else. The bindings, whose headers take clang-tidy as long
# as all of cpp/, are looked at by night too.
ANALYZER ?= shallow
SOURCES := $(wildcard cpp/src/*/*.cpp)
ifeq ($(ANALYZER),deep)
SOURCES += $(wildcard bindings/*.cpp bindings/c/*.cpp bindings/fmu/*.cpp)
endif
HEADERS := $(wildcard cpp/include/cdcr/*.hpp cpp/src/*/*.hpp bindings/*.hpp bindings/fmu/*.hpp)
CHECKED := $(SOURCES:%=build/tidy/$(ANALYZER)/%)

# The longest of one process first.
LINTERS := mypy imports ruff ruff-format codespell words silence gersemi clang-format
.PHONY: all $(LINTERS)
all: $(LINTERS) $(CHECKED)

mypy:
	mypy
imports:
	PYTHONPATH=python lint-imports --no-cache
ruff:
	ruff check --no-cache
ruff-format:
	ruff format --check
codespell:
	codespell
# One word for one thing: see cpp/README.md. Where a foreign format asks for another, the line says
# whose it is.
words:
	! grep -rniwE 'tendons?|wires?' cpp bindings python --include='*.[chp]pp' --include='*.py*' | \
	  grep -v "# MuJoCo's word$$"
# The library never prints.
silence:
	! grep -rnE '\b(std::(cout|cerr|clog)|f?printf|puts) *[(<]' cpp/include cpp/src
gersemi:
	. tools/sources.sh; gersemi --check --quiet $$(cmake_sources)
clang-format:
	. tools/sources.sh; clang-format --dry-run -Werror $$(cpp_sources)

# clang-tidy, one source at a time, again only after a change; its compile database is made once.
build/tidy/compile_commands.json: CMakeLists.txt CMakePresets.json $(wildcard */CMakeLists.txt)
	cmake --preset tidy -DPython_EXECUTABLE="$$(command -v python)" \
	  -Dpybind11_DIR="$$(python -m pybind11 --cmakedir)" >build/tidy.log || \
	  { cat build/tidy.log; exit 1; }
	touch $@

build/tidy/$(ANALYZER)/%: % $(HEADERS) .clang-tidy bindings/.clang-tidy | build/tidy/compile_commands.json
	@echo clang-tidy $<
	@clang-tidy --quiet -p build/tidy --extra-arg=-Xclang --extra-arg=-analyzer-config \
	  --extra-arg=-Xclang --extra-arg=mode=$(ANALYZER) \
	  --extra-arg=-Wno-unknown-warning-option $<
	@mkdir -p $(@D)
	@touch $@
