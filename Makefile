# The everyday commands; CMake does the work, and CMakePresets.json has the other builds.
BUILD ?= build
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
# For the first time that a folder is configured, for instance -DPORTALENS_PORTABLE=ON.
CMAKE_OPTIONS ?=
DEMO_SCENE ?= scenes/demo.toml
DEMO_PICTURE ?= $(BUILD)/demo.png
sources = $(shell find src include tests benchmarks fuzz examples -name '*.h' -o -name '*.cpp')

.PHONY: all demo test test-long differential fuzz bench install format clean

all: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS)

# Configured once; CMake itself sees later whether it must do so again.
$(BUILD)/build.ninja:
	@scripts/install-deps
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release \
	  -DPORTALENS_UNITY=ON $(CMAKE_OPTIONS)

demo: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS) --target portalens
	@$(BUILD)/portalens render $(DEMO_SCENE) -o $(DEMO_PICTURE) --stats

test: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS) --target tested_programs
	@cd $(BUILD) && ctest --output-on-failure --parallel $(JOBS)

test-long: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS) --target tested_programs
	@cd $(BUILD) && PORTALENS_TEST_SCALE=10 ctest --output-on-failure --parallel $(JOBS)

# So many random scenes by all engines (make differential N=100 SEED=7 DIFFERENTIAL=--minimise).
N ?= 1000
SEED ?= 1
differential: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS) --target differential
	@$(BUILD)/tests/differential --scenes $(N) --seed $(SEED) $(DIFFERENTIAL)

# So many seconds for each target (make fuzz FUZZ_SECONDS=1200); what is found lies in build/fuzz.
FUZZ_SECONDS ?= 60
fuzz:
	@scripts/install-deps --fuzz
	@cmake --preset fuzz
	@cmake --build --preset fuzz --parallel $(JOBS)
	@python3 fuzz/fuzz.py --seconds $(FUZZ_SECONDS) $(FUZZ_TARGETS)

bench: all
	@set -e; for program in $(BUILD)/benchmarks/bench_*; do echo "== $${program##*/}"; $$program; done

# Program, manual page, completions, scenes and library: make install PREFIX=$$HOME/.local
PREFIX ?= /usr/local
install: $(BUILD)/build.ninja
	@cmake --build $(BUILD) --parallel $(JOBS) --target portalens
	@cmake --install $(BUILD) --prefix $(PREFIX)

format:
	@clang-format-14 -i $(sources)

clean:
	@rm -rf $(BUILD)
