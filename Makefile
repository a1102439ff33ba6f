# A thin front of CMake (CMakePresets.json). `make demo` and `make check` also install
# what is missing, with apt. Only `make check` builds the tests.

MAKEFLAGS += --no-print-directory
JOBS := $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local

.PHONY: all setup demo check check-python check-viewer wheel bench score install format clean

all:
	@cmake --preset release -DCMAKE_INSTALL_PREFIX=$(PREFIX) >build-log 2>&1 || \
	  { cat build-log; rm -f build-log; echo "make: 'make setup' installs what is missing" >&2; exit 1; }
	@rm -f build-log
	@cmake --build build -j $(JOBS) --target flowgrain_program manual

setup:
	@scripts/setup

demo: setup
	@$(MAKE) --no-print-directory all
	@build/flowgrain run data/gfs_20140131.nc -o demo --force
	@echo "The pictures are in $(CURDIR)/demo; demo/index.html shows them all in a browser"

check: setup
	@scripts/check

# the Python package: build-python/flowgrain-*.whl; its tests beside the program in build/
wheel:
	@scripts/setup --python
	@python/wheel

check-python: setup all
	@scripts/setup --python
	@python/check build

# the npm package: build-viewer/package
check-viewer: setup all
	@scripts/setup --viewer
	@viewer/check build

# prints the tables of docs/benchmarks.md; WHOLE=1: the long ones, too
bench: setup all
	@cmake --build build --target bench_all -j $(JOBS) >/dev/null
	@bench/run build
	@echo
	@bench/scaling build
	@echo
	@bench/contest/run build $(if $(WHOLE),--whole)

# how well flowgrain and its rivals tell fields: docs/method/score.md
score: all
	@scripts/score

install: all
	@cmake --install build

format:
	@git ls-files -z '*.c' '*.h' | xargs -0 clang-format -i

clean:
	@cmake -E rm -rf build demo
