# clang-tidy, one source at a time and side by side, again only after a change.
# Needs the compile database of preset tidy: make lint.
SOURCES := $(wildcard cpp/src/*/*.cpp bindings/*.cpp bindings/fmu/*.cpp)
HEADERS := $(wildcard cpp/include/cdcr/*.hpp cpp/src/*/*.hpp bindings/*.hpp bindings/fmu/*.hpp)

all: $(SOURCES:%=build/tidy/ok/%)

build/tidy/ok/%: % $(HEADERS) .clang-tidy bindings/.clang-tidy
	@echo clang-tidy $<
	@clang-tidy --quiet -p build/tidy $<
	@mkdir -p $(@D)
	@touch $@
