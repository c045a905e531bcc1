# crestline: set-up, demonstration, tests and checks. `make help` lists what there is.

SHELL := /bin/bash
MAKEFLAGS += --no-print-directory

# Smallest share of lines, in per cent, that the tests must run, of R and of C++ each.
COVERAGE_MIN ?= 90
export COVERAGE_MIN

# The real scans some tests and the tables use, where they lie beside the project.
ifeq ($(origin CRESTLINE_SHARED), undefined)
ifneq ($(wildcard ../shared/data),)
export CRESTLINE_SHARED := $(realpath ../shared/data)
endif
endif

# A private library to install crestline into: make test CRESTLINE_LIB=/some/where
ifdef CRESTLINE_LIB
export CRESTLINE_LIB
export R_LIBS := $(CRESTLINE_LIB):$(R_LIBS)
endif

# No display is needed, threads that wait do not spin, and text is UTF-8 wherever no locale is set.
export RGL_USE_NULL := TRUE
export OMP_WAIT_POLICY := passive
ifeq ($(LC_ALL)$(LC_CTYPE)$(LANG),)
export LC_ALL := C.UTF-8
endif

.PHONY: help setup install demo test check coverage sanitize studies document site lint clean

help:  ## this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' Makefile

setup:  ## installs what is missing: R, packages, pandoc
	@$(if $(CRESTLINE_LIB),mkdir -p $(CRESTLINE_LIB))
	@tools/setup.sh

install: setup  ## builds and installs crestline
	@tools/install.sh

demo: export CRESTLINE_NEEDS := demo
demo: install  ## the main job: the curves of Rvcg's face, into demo-output/
	@echo "==> the curves of a face, into demo-output/"
	@Rscript tools/demo.R

test: install  ## all tests; ends with "N passed, N failed, N skipped"
	@echo "==> tests"
	@Rscript tools/run-tests.R

check: setup  ## R CMD check --as-cran of the built package, vignettes included
	@tools/check.sh

coverage: setup  ## lines of R and C++ that the tests run; fails under COVERAGE_MIN per cent
	@tools/coverage.sh

sanitize: setup  ## the tests under the address and undefined-behaviour sanitizers
	@tools/sanitize.sh

studies: install  ## the vignettes' simulation studies again, beside the tables that ship: N=20: short, WRITE=write: new tables
	@echo "==> studies"
	@Rscript tools/studies.R $(N) $(WRITE)

document: setup  ## writes NAMESPACE, man/ and the Rcpp exports
	@tools/document.sh

site: install  ## the site, by pkgdown, into site/; every page opened in headless Chromium
	@tools/site.sh

lint: setup  ## lintr over R/ and tools/ by the rules of .lintr, lines elsewhere; fails on any lint
	@tools/lint.sh

clean:  ## removes what builds leave in the tree
	@rm -rf demo-output site crestline.Rcheck src/*.o src/*.so
