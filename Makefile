# Everything a newcomer needs: `make demo` and `make test`. The rest is listed by `make help`.
PYTHON ?= python3
VENV   ?= .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
ARGS   ?=
export PIP_DISABLE_PIP_VERSION_CHECK = 1
export PYTHONWARNINGS =

.PHONY: help setup demo run test lint benchmark screenshots guide-pictures soak installers-test freeze deb tarball windows clean

help:  ## list the commands
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):[^#]*## */  make \1\t/' | expand -t 20

setup: $(READY)  ## a virtual environment with everything in it

$(READY): pyproject.toml constraints.txt packaging/linux/system-libraries
	@sh packaging/linux/system-libraries
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "Installing the packages into $(VENV) (about a minute) ..."
	@$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[cad,cluster,dev]'
	@touch $@

demo: $(READY)  ## the main job on a bundled sample: leaves CSV and picture in out/
	@BOBDESK=$(BIN)/bobdesk sh packaging/demo

run: $(READY)  ## start the window; make run ARGS="check PLAN --length 1300 --drop 120" runs a command
	@$(BIN)/bobdesk $(ARGS)

test: $(READY)  ## all tests
	@QT_QPA_PLATFORM=offscreen $(BIN)/python -m pytest

lint: $(READY)  ## style, types, and the direction of dependencies
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/lint-imports --verbose 2>&1 | tail -n 12; $(BIN)/lint-imports >/dev/null

benchmark: $(READY)  ## seconds and memory beside a peer, as a table
	@$(BIN)/python -m tests.benchmarks

screenshots: $(READY)  ## a picture of every screen and dialog, in out/screenshots
	@$(BIN)/python packaging/screenshots.py
	@$(BIN)/python packaging/guide_pictures.py out/screenshots/guide

guide-pictures: $(READY)  ## take the pictures of the user's guide anew, in resources/guide/pictures
	@$(BIN)/python packaging/guide_pictures.py

soak: $(READY)  ## ten minutes of editing, being killed, random gestures, and being closed in mid-run
	@OPENBLAS_NUM_THREADS=1 $(BIN)/python -m tests.soak.kill_while_editing --seconds 200
	@OPENBLAS_NUM_THREADS=1 QT_QPA_PLATFORM=offscreen $(BIN)/python -m tests.soak.random_gestures --seconds 300
	@QT_QPA_PLATFORM=offscreen $(BIN)/python -m tests.soak.closing --times 50

freeze: $(READY)  ## the program with all it needs in a folder of its own, dist/bobdesk
	@$(BIN)/python packaging/freeze/freeze.py dist

deb: freeze  ## a package for Debian and its relatives, in dist/
	@$(BIN)/python packaging/linux/build_deb.py dist/bobdesk dist

tarball: freeze  ## the same for any Linux, as tar.xz with a script that installs it, in dist/
	@$(BIN)/python packaging/linux/build_tarball.py dist/bobdesk dist

windows: $(READY)  ## setup.exe for Windows, made on Linux, in dist/
	@$(BIN)/python packaging/windows/build.py

installers-test: $(READY)  ## make and try the packages: fresh roots of Debian, and Wine; needs root
	@PYTHON=$(BIN)/python packaging/linux/test
	@PYTHON=$(BIN)/python packaging/windows/test
	@$(BIN)/python packaging/same_figures.py $$(find out/installers -name '*selftest*.json')

clean:  ## remove what the other commands made
	rm -rf $(VENV) out build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
