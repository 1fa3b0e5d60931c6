# The front door. Each target first installs what is missing (tools/setup), then uses the presets
# of CMakePresets.json; whoever has everything installed can use cmake and ctest directly.

PRESET ?= release
OUT    ?= out/gallery
GRID   ?= reference_scenes/grids/sphere_grid.xml
JOBS   ?= $(shell nproc)
SETUP  ?= yes
FUZZ_SECONDS ?= 60
MINUTES ?= 10
PREFIX  ?= /usr/local
BENCH   ?= out/bench.json
BASE    ?= HEAD
SEED    ?= $(shell date +%s)

# SETUP=no: for systems whose packages have other names than Debian's.
setup     = $(if $(filter no,$(SETUP)),@:,@tools/setup)
for_tests = build engines browser shaders wasm slurm python packaging docs
npm       = $(if $(filter no,$(SETUP)),@:,@tools/web)
configure = cmake --preset "$(PRESET)"
# One more than processors: some tests wait.
ctest     = ctest --preset "$(PRESET)" --parallel "$$(($(JOBS) + 1))"
space     = $(subst ,, )
build     = cmake --build --preset "$(PRESET)" --parallel "$(JOBS)"

.DEFAULT_GOAL := help
.PHONY: help gallery screenshots references test test-all test-long mutants sanitize sanitize-short build bench bench-compare fuzz chaos lint docs headers install uninstall package clean
.NOTPARALLEL:

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /make \1\t/p' Makefile | expand -t 24
	@echo
	@echo 'Variables: PRESET (release, dev, asan, tsan, ci), OUT (where the gallery goes), JOBS,'
	@echo 'PREFIX (where install copies to), GRID (a grid file), SETUP=no (look for no missing packages), FUZZ_SECONDS, MINUTES, SEED,'
	@echo 'QUICK=yes, BENCH (where figures of speed are kept), BASE (a commit), GROUPS (of long tests), ONLY (some faults)'

gallery: ## builds, renders the sphere grid with every engine, compares, writes a gallery to out/gallery
	@echo 'make gallery: from a fresh clone about 14 minutes on 2 cores (a first page after 11), plus 1 or 2 to install missing packages'
	$(setup) build engines wasm
	$(npm)
	$(configure)
	@tools/tell 'make gallery: building' '' $(build) --target lobelia lobelia_image_io
	@tools/gallery "build/$(PRESET)/bin/lobelia" "$(GRID)" "$(OUT)" "$(BENCH)"

screenshots: ## pictures of every view of the gallery in OUT, for a desktop and a phone, into OUT-screenshots
	$(setup) build browser
	$(npm)
	node gallery/web/screenshots.mjs "$(OUT)" "$(OUT)-screenshots"

references: ## measures how far ours and every engine are from the formulas, into out/references (half an hour)
	$(setup) build engines
	$(npm)
	$(configure)
	$(build) --target lobelia lobelia_image_io
	"build/$(PRESET)/bin/lobelia" verify references -o out/references

test: ## builds the program and its short tests, and runs these
	$(setup) $(for_tests)
	$(npm)
	$(configure)
	$(build) --target short_tests
	$(ctest) --label-regex -short

test-all: ## the short tests and the long ones (tests/suites.txt): browsers, a cluster, packages, all engines and models
	$(setup) $(for_tests)
	$(npm)
	$(configure)
	$(build) --target all
	$(ctest)

test-long: ## the long tests of some GROUPS, as in GROUPS='pages cli'
	$(setup) $(for_tests)
	$(npm)
	$(configure)
	$(build) --target all
	$(ctest) --label-regex '-long-($(subst all_,[a-z]+_,$(subst $(space),|,$(strip $(GROUPS)))))'

mutants: ## plants faults in a copy of the source, one at a time, and says which test finds each (an hour); ONLY=WORD
	$(setup) $(for_tests) mutants
	$(npm)
	tests/mutants/plant --long --jobs "$(JOBS)" --table docs/mutants.md $(if $(ONLY),--only "$(ONLY)") build/mutants

sanitize: ## runs the suite in the presets asan and tsan, without engines, browsers and long tests
	$(setup) build
	cmake --preset asan
	cmake --build --preset asan --parallel "$(JOBS)" --target quick_tests
	ctest --preset asan --parallel "$(JOBS)" --label-regex quick
	cmake --preset tsan
	cmake --build --preset tsan --parallel "$(JOBS)" --target threaded_tests
	ctest --preset tsan --parallel "$(JOBS)" --label-regex threads --label-regex quick

sanitize-short: ## the part of it that reads scenes and pictures, and the farm's unit tests; no thread sanitizer
	$(setup) build
	cmake --preset asan
	cmake --build --preset asan --parallel "$(JOBS)" --target reader_tests
	ctest --preset asan --parallel "$(JOBS)" --label-regex 'short-.*readers'

build: ## builds everything into build/release
	$(setup) build
	$(configure)
	$(build)

bench: ## measures each goal of speed beside what it is held to, in one table; QUICK=yes takes two minutes
	$(setup) build engines browser
	$(npm)
	$(configure)
	$(build) --target lobelia lobelia_image_io bench_goals
	@"build/$(PRESET)/bin/bench_goals" "build/$(PRESET)/bin/lobelia" $(if $(filter yes,$(QUICK)),--quick) \
	    --commit "$$(git describe --always --dirty=+ --exclude='*')" --committed "$$(git log -1 --format=%cs)" --keep "$(BENCH)"

bench-compare: ## what became slower or faster since the commit BASE, both builds in turn
	$(setup) build
	$(configure)
	$(build) --target lobelia lobelia_image_io bench_paired
	@tools/bench_compare "$(PRESET)" "$(BASE)"

fuzz: ## looks for files that break a reader, and scenes that break a law, FUZZ_SECONDS (60) each; needs Clang
	$(setup) build fuzz
	cmake --preset fuzz
	cmake --build --preset fuzz --parallel "$(JOBS)"
	$(configure)
	$(build) --target test_renderer test_renderer_random_scenes test_formulas test_accuracy
	@tools/fuzz build/fuzz "$(FUZZ_SECONDS)" "build/$(PRESET)/bin"

chaos: ## faults at random for MINUTES (10): first farms are disturbed, then system calls of six commands fail; SEED=N repeats them
	$(setup) build chaos
	$(configure)
	$(build) --target test_farm_chaos lobelia lobelia_image_io
	LOBELIA_RANDOM_SEED="$(SEED)" LOBELIA_RANDOM_SECONDS=$$((30 * $(MINUTES))) "build/$(PRESET)/bin/test_farm_chaos"
	tests/faults/inject --seed "$(SEED)" --minutes $$(($(MINUTES) / 2)).$$(($(MINUTES) % 2 * 5)) "build/$(PRESET)/bin/lobelia"

lint: ## checks the layout of the source, and for common mistakes with TIDY=yes (minutes)
	$(setup) build lint
	@tools/lint format
ifeq ($(TIDY),yes)
	$(configure)
	$(build)
	@tools/lint tidy "build/$(PRESET)" "$(JOBS)"
endif

docs: ## writes docs/ as a site to out/docs, with a search; no network is needed to read it
	$(setup) build docs
	$(configure)
	$(build) --target lobelia
	@LOBELIA_PROGRAM="build/$(PRESET)/bin/lobelia" tools/docs out/docs

headers: ## writes the headers that people copy, program/library/lobelia/highlight.hpp and flip_highlight.hpp
	@tools/headers program/library/lobelia

install: ## builds, and copies programs, library and docs to PREFIX (/usr/local)
	$(setup) build
	$(configure)
	$(build) --target installed
	@tools/install "build/$(PRESET)" "$(PREFIX)"

uninstall: ## removes what install copied to PREFIX, and no file that was changed since
	@tools/install --remove "$(PREFIX)"

package: ## builds Debian packages into build/release/packages
	$(setup) build packaging
	$(configure)
	$(build) --target installed
	cd "build/$(PRESET)" && cpack > packages.log 2>&1 || { cat packages.log; exit 1; }
	@ls "build/$(PRESET)"/packages/*.deb

clean: ## removes what make built: build/ and out/
	rm -rf build out
