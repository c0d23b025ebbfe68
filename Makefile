# Everything a user or developer runs. `make` alone lists the targets.
SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --warn-undefined-variables --no-print-directory

# Where it is set, each of the many processes of tests compiles all modules anew.
unexport PYTHONDONTWRITEBYTECODE

VENV := .venv
OUT := out
STYLE :=
JOBS := auto
PYTEST_ARGS :=
FUZZ_SECONDS := 60
FUZZ_FILES := 2000
FUZZ_SEED :=
BIN := $(VENV)/bin
PYTEST = $(BIN)/python -m pytest -n $(JOBS) $(PYTEST_ARGS)
BUILD := $(BIN)/python -m tools.build --scripts figures --out $(OUT) $(if $(STYLE),--style $(STYLE))

.PHONY: help install system opengl browser librsvg inkscape emulator figures poster animations test test-thorough test-large long-run mutations coverage \
	test-source test-pythons test-lowest sanitize fuzz fuzz-files check \
	lint web built stub bench peers dist dist-again source check-archives rehearse wheels cross baselines names readme-images web-images docs clean

help: ## list the targets
	@sed -nE 's/^([a-z-]+):.*## (.*)/  make \1|\2/p' $(firstword $(MAKEFILE_LIST)) | column -t -s '|'

# One environment, which grows by what a target needs: tools/install.sh says what that is. The script does nothing when the
# files hold what was installed last, so a touched file needs no network; a changed kernel is built alone. Folders stand
# for kernel sources that were added or removed. Two targets must not install at once.
.NOTPARALLEL:
KERNEL := $(shell find stereodel/kernel tests/kernel/probe)
$(VENV)/installed-%: pyproject.toml constraints.txt CMakeLists.txt $(KERNEL) \
		tools/install.sh tools/shell.sh tools/build_kernel.sh tools/find_python.sh tools/system_packages.sh \
		stereodel/web/script/package-lock.json
	@tools/install.sh $(VENV) $*

install: $(VENV)/installed-library ## create .venv with the compiled kernel and all that the library can use
	@:

system: opengl browser librsvg ## get what the system has packages of, one by one, or say how

opengl: # what draws without a display
	@tools/system_packages.sh opengl

browser: # what shows the interactive page to its tests
	@tools/system_packages.sh browser

librsvg: # what shows vector files to their tests
	@tools/system_packages.sh librsvg

emulator: # what runs wheels of another processor
	@tools/system_packages.sh emulator

inkscape: # what opens and changes them
	@tools/system_packages.sh inkscape

figures: $(VENV)/installed-figures opengl ## draw every figure that is out of date into out/; STYLE=dark or a style file: into a folder of it
	@$(BUILD) fig claim globe earth sky

poster: $(VENV)/installed-figures opengl ## draw figures/globe_poster.py 16384 pixels across into out/poster: a minute, and 0.8 GB of memory
	@mkdir -p $(OUT)/poster
	@$(BIN)/python figures/globe_poster.py --out $(OUT)/poster --size 16384

animations: $(VENV)/installed-animations opengl ## draw every animation that is out of date into out/
	@$(BUILD) anim

test: $(VENV)/installed-test system ## what every change must pass: pictures first, and no further if one differs; then all else once
	$(PYTEST) tests/images tests/figures
	$(PYTEST) --ignore=tests/images --ignore=tests/figures

test-thorough: $(VENV)/installed-test system inkscape ## the same for more cases, 500 examples of each property, and the pictures on EGL
	$(PYTEST) -m '(thorough or hypothesis) and not large' --hypothesis-profile=thorough
	STEREODEL_GL=egl $(PYTEST) -m 'images and not thorough' tests/images

test-large: $(VENV)/installed-test ## the tests that take minutes or gigabytes
	$(BIN)/python -m pytest -m large -o faulthandler_timeout=3600 $(PYTEST_ARGS)

long-run: $(VENV)/installed-test system inkscape ## an hour and a half of what shows only after long: kills, damaged files, random bytes, millions of points, mistakes, memory, long films
	tools/long_run.sh $(VENV)

mutations: $(VENV)/installed-test system ## change the library at one place after another: the tests named for each must fail
	$(BIN)/python -m tools.mutate

coverage: $(VENV)/installed-test system inkscape ## lines and branches of Python and C++ that all tests but the large ones reach
	tools/coverage.sh $(VENV) -n $(JOBS) $(PYTEST_ARGS)

test-source: $(VENV)/installed-test opengl librsvg ## the tests from the unpacked source archive, as distributions run them
	tools/test_source.sh $(VENV) -n $(JOBS) $(PYTEST_ARGS)

sanitize: $(VENV)/installed-test opengl ## one definition a name; the tests, then random bytes, on a kernel that stops at wrong addresses and undefined behaviour
	tools/one_definition.sh $(VENV)
	tools/sanitize.sh $(VENV) -n $(JOBS) $(PYTEST_ARGS)
	tools/fuzz.sh $(VENV) $(FUZZ_SECONDS)

fuzz: $(VENV)/installed-kernel ## feed random bytes to the kernel for FUZZ_SECONDS
	tools/fuzz.sh $(VENV) $(FUZZ_SECONDS)

fuzz-files: $(VENV)/installed-test ## give FUZZ_FILES changed files of all formats to the readers; those that fail are kept in build/fuzz/files
	$(BIN)/python -m tests.fuzz.files $(FUZZ_FILES) $(FUZZ_SEED)

check: lint built docs ## format, lint, types, tracked text, workflows, the page's built files, documentation

lint: $(VENV)/installed-lint ## what check does, without the documentation
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/python tools/kernel_stub.py --check
	$(BIN)/python -m tools.bill --check
	$(BIN)/python tools/tracked_text.py
	PATH=$(CURDIR)/$(BIN):$$PATH npm --prefix stereodel/web/script --silent run check
	$(BIN)/zizmor --offline --quiet --strict-collection .github
	PATH=$(CURDIR)/$(BIN):$$PATH actionlint
	$(BIN)/check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff

web: $(VENV)/installed-web ## build the interactive page's kernel and scripts into stereodel/web/built
	@tools/build_web.sh $(VENV)

built: $(VENV)/installed-web ## build them anew, and compare with the tracked ones byte by byte
	@tools/build_web.sh $(VENV) compare

stub: $(VENV)/installed-lint ## write the kernel's type stub anew
	$(BIN)/python tools/kernel_stub.py

bench: $(VENV)/installed-library ## measure against other libraries, which are installed into benchmarks/.peers
	benchmarks/install_peers.sh
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.rasters

peers: $(VENV)/installed-test ## run the lines of the pages for users of other libraries, with those libraries
	benchmarks/install_peers.sh
	$(BIN)/python -m pytest $(PYTEST_ARGS) tests/peers.py

dist: $(VENV)/installed-wheels opengl ## source archive, wheel and npm archive into dist/, each tried as users get it
	tools/dist.sh $(VENV)

dist-again: $(VENV)/installed-wheels ## those of dist/ once more, the wheel in another folder: the same sources must give the same bytes
	tools/dist.sh $(VENV) again

source: $(VENV)/installed-wheels ## the source archive into dist/
	@tools/source_archive.sh $(VENV) dist

check-archives: $(VENV)/installed-wheels ## check the archives in dist/: their texts, and the interface of wheels for several Pythons
	tools/check_archives.sh $(VENV)

rehearse: $(VENV)/installed-wheels opengl emulator ## a release as if it were published: bare roots, a local index and a local registry; ends with a table of what was tried
	tools/rehearse.sh $(VENV)

MACHINES := x86_64 aarch64
wheels: $(VENV)/installed-wheels ## source archive and wheels for Linux on MACHINES into dist/, by zig, checked and tried on each Python found
	tools/wheels.sh $(VENV) $(MACHINES)

cross: $(VENV)/installed-wheels ## compile and link the kernel for macOS, Windows and musl by zig; what this machine can run, is run
	tools/cross.sh $(VENV)

baselines: $(VENV)/installed-animations opengl ## draw the stored pictures of the image tests anew: look at what git shows before you commit
	$(BIN)/python -m tools.baselines --scripts figures --store tests/images/baselines

names: $(VENV)/installed-test ## write the tables of docs/names.md from the library anew
	$(BIN)/python -m tools.names

readme-images: $(VENV)/installed-figures opengl ## draw the small pictures of the README anew
	$(BIN)/python -m tools.pictures readme

web-images: $(VENV)/installed-test browser ## draw the screenshots of the interactive page in README and documentation anew
	$(BIN)/python -m tools.pictures web

# Always from nothing: the gallery looks at the scripts alone, and pictures depend on the library too.
docs: $(VENV)/installed-docs opengl ## build the documentation into docs/_build/html; warnings are errors
	@rm -rf docs/_build docs/gallery docs/api/generated
	$(BIN)/python -m sphinx -W --keep-going -q -j auto -d docs/_build/doctrees -b html docs docs/_build/html
	$(BIN)/python tools/offline_pages.py docs/_build/html
	@echo "Open docs/_build/html/index.html"

test-pythons: system ## run the tests on the other Python versions found here
	@tools/test_pythons.sh 3.12 3.13

test-lowest: system ## the tests of the command, of files and of stereodel.spatial with the least versions of all libraries at once
	@tools/test_lowest.sh -n $(JOBS) $(PYTEST_ARGS)

clean: ## remove what was built; the environments stay
	rm -rf build dist docs/_build docs/gallery docs/api/generated docs/sg_execution_times.rst .pytest_cache .mypy_cache .ruff_cache
	find $(OUT) -mindepth 1 ! -name .gitkeep -delete
	find stereodel figures tests tools -name __pycache__ -prune -exec rm -rf {} +
