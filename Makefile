# The commands of this project. Variables are data: make and the shell run no part of their values,
# as in `make grade STUDENT='any name; $(at) all'`. GNU make turns every failure into exit status 2;
# scripts should call .venv/bin/grader.

.DEFAULT_GOAL := help
.PHONY: help setup lab images grade grade-all check fix validate test test-all test-long recordings bench bench-diagnosis pictures lock lint clean
SHELL := /bin/sh

# A variable's raw text reaches the recipes through the environment; nothing expands it.
VARIABLES := STUDENT PACKAGE ASSIGNMENT LESSON DISTRO SANDBOX NAME OUT WORKSPACE BASE BASE_IMAGE EXTRA_CA APT_MIRROR \
  PIP_INDEX_URL PYTHON PYTEST_ARGS SUBMISSIONS ROSTER WORKERS REGRADE WORKSHEET CANVAS CANVAS_COLUMN \
  GRADE_COLUMN FEEDBACK_COLUMN ACCEPT JOIN EXTENSIONS TIMES COURSE XLSX PSEUDONYMS BRIGHTSPACE BRIGHTSPACE_COLUMN DRY_RUN YES SCHEDULER APPLY HINTS EXPLAIN \
  ALL KEYS GRADER_COURSE GRADER_ASSIGNMENT LAB_PROCESSES LAB_MEMORY LAB_TMP LAB_NETWORK PAGE
$(foreach v,$(VARIABLES),$(if $(filter-out undefined,$(origin $v)),$(eval override $v := $$(value $v))$(eval export $v)))

BOOTSTRAP := python3 grader/bootstrap.py $${PYTHON:+--python "$$PYTHON"}
# (a test that hangs fails, with its place, instead of stopping the run)
# one process more than cores: a node under observation leaves them mostly idle
PYTEST := .venv/bin/python -m pytest -q --timeout 600 --durations 40 --dist worksteal -n $$(( $$(getconf _NPROCESSORS_ONLN) + 1 ))
# those with containers and real runs wait for a third of their time
PYTEST_FULL := .venv/bin/python -m pytest -q --timeout 600 --durations 60 --dist worksteal -n $$(( 2 * $$(getconf _NPROCESSORS_ONLN) ))
# those that keep every core busy, or whose limits in wall time need a quiet machine, run after the
# others (PYTEST_ARGS chooses a part: all at once)
ALONE := .venv/bin/python -m pytest -q --timeout 1200 -p no:xdist tests/test_load.py tests/test_ceiling.py
define run_tests
if [ -n "$${PYTEST_ARGS:-}" ]; then $(PYTEST_FULL) -m "$(1)" $${PYTEST_ARGS}; \
  else $(PYTEST_FULL) -m "($(1)) and not alone" && $(ALONE) -m "($(1)) and alone"; fi
endef
# the tests whose verdicts are from recorded evidence
RECORDED := tests/test_verdicts.py tests/test_build_check.py tests/fix tests/mistakes/test_korean_verdicts.py \
  tests/batch/test_grade_all.py tests/batch/test_language.py tests/test_cli.py \
  tests/test_another_course.py tests/test_weather_course.py tests/gradebook/test_gradescope_run.py
GRADER := .venv/bin/python -m grader
export GRADER_CALLED_BY := make
OPTIONS := $${ASSIGNMENT:+--assignment "$$ASSIGNMENT"} $${DISTRO:+--distro "$$DISTRO"} \
  $${SANDBOX:+--sandbox "$$SANDBOX"}

# A verdict is no error of make, which adds "*** Error 1" to a command that fails. With --question, make
# takes a command's status 1 for an answer, and ends with it without a word; any other status is still
# an error, and status 2. (The sign + has a command run all the same.)
ifneq (,$(MAKECMDGOALS))
ifeq (,$(filter-out grade grade-all check fix validate,$(MAKECMDGOALS))$(findstring n,$(firstword -$(MAKEFLAGS))))
MAKEFLAGS += --question
unexport MAKEFLAGS
RUN := +
endif
endif

help:  ## Show this help
	@echo "ROS 2 teaching lab and autograder"
	@echo
	@sed -n 's/^\([a-z-]*\):.*##/  make \1\t/p' Makefile | expand -t 18
	@echo
	@echo "Variables: STUDENT=path PACKAGE=path ASSIGNMENT=id|file DISTRO=jazzy[,kilted]"
	@echo "           SANDBOX=auto NAME=student OUT=reports PYTHON=python3"
	@echo "           WORKSPACE=~/ros2_ws BASE=ros|wheels BASE_IMAGE=name (docs/images.md: networks)"
	@echo "           LAB_MEMORY=4g LAB_PROCESSES=2048 LAB_TMP=1g (limits: lab/README.md)"
	@echo "           PAGE=1 LAB_NETWORK=own (make lab in the browser: lab/README.md)"
	@echo "           KEYS=folder (solution and hidden checks of your own assignment)"
	@echo "           GRADER_COURSE=folder (the lessons of another course: docs/assignments.md)"
	@echo "           SUBMISSIONS=path ROSTER=csv WORKSHEET=csv CANVAS=csv BRIGHTSPACE=csv WORKERS=n REGRADE=1"
	@echo "           JOIN=csv EXTENSIONS=csv TIMES=csv DRY_RUN=1 YES=1"
	@echo "           COURSE=yaml XLSX=1 (all lessons of a course, one gradebook) PSEUDONYMS=1"
	@echo "           GRADE_COLUMN=, FEEDBACK_COLUMN= (of WORKSHEET), CANVAS_COLUMN= (of CANVAS), BRIGHTSPACE_COLUMN="
	@echo "           ACCEPT=join|lower SCHEDULER=tcp://host:8786 (docs/classes.md, docs/cluster.md)"

setup:  ## Make the grader's environment and the ROS prefix, once (DISTRO=jazzy)
	@$(BOOTSTRAP)
	@$(GRADER) prefix $${DISTRO:+--distro "$$DISTRO"}

lab:  ## Open a ROS 2 terminal with the course's guide (LESSON=id WORKSPACE=~/ros2_ws PAGE=1: in the browser)
	@$(BOOTSTRAP)
	@.venv/bin/python -m lab $(OPTIONS) $${LESSON:+--lesson "$$LESSON"} $${WORKSPACE:+--workspace "$$WORKSPACE"} \
	  $${PAGE:+--page}

images:  ## Build the Docker images of a distro and list them with their sizes (DISTRO=jazzy)
	@$(BOOTSTRAP)
	@$(GRADER) images $${DISTRO:+--distro "$$DISTRO"} $${BASE:+--base "$$BASE"} \
	  $${BASE_IMAGE:+--base-image "$$BASE_IMAGE"} \
	  $${EXTRA_CA:+--extra-ca "$$EXTRA_CA"} $${APT_MIRROR:+--apt-mirror "$$APT_MIRROR"} \
	  $${PIP_INDEX_URL:+--pip-index "$$PIP_INDEX_URL"}

grade:  ## Mark one package: make grade STUDENT=path [ALL=1]
	$(RUN)@if [ -z "$$STUDENT" ]; then \
	  echo "make grade: no package was given: make grade STUDENT=path/to/package" >&2; exit 2; fi
	$(RUN)@$(BOOTSTRAP)
	$(RUN)@$(GRADER) grade $(OPTIONS) $${KEYS:+--keys "$$KEYS"} $${NAME:+--name "$$NAME"} $${OUT:+--out "$$OUT"} \
	  $${ALL:+--all} -- "$$STUDENT"

grade-all:  ## Mark a class: make grade-all SUBMISSIONS=path [ROSTER=csv] [REGRADE=1]
	$(RUN)@if [ -z "$$SUBMISSIONS" ]; then \
	  echo "make grade-all: no class was given: make grade-all SUBMISSIONS=path/to/downloads" >&2; \
	  exit 2; fi
	$(RUN)@$(BOOTSTRAP)
	$(RUN)@$(GRADER) grade-all $(OPTIONS) $${KEYS:+--keys "$$KEYS"} $${OUT:+--out "$$OUT"} \
	  $${ROSTER:+--roster "$$ROSTER"} $${JOIN:+--join "$$JOIN"} \
	  $${EXTENSIONS:+--extensions "$$EXTENSIONS"} $${TIMES:+--times "$$TIMES"} \
	  $${COURSE:+--course "$$COURSE"} $${XLSX:+--xlsx} $${PSEUDONYMS:+--pseudonyms} \
	  $${DRY_RUN:+--dry-run} $${YES:+--yes} \
	  $${WORKERS:+--workers "$$WORKERS"} $${REGRADE:+--regrade} \
	  $${WORKSHEET:+--worksheet "$$WORKSHEET"} $${CANVAS:+--canvas "$$CANVAS"} \
	  $${BRIGHTSPACE:+--brightspace "$$BRIGHTSPACE"} \
	  $${BRIGHTSPACE_COLUMN:+--brightspace-column "$$BRIGHTSPACE_COLUMN"} \
	  $${GRADE_COLUMN:+--grade-column "$$GRADE_COLUMN"} \
	  $${FEEDBACK_COLUMN:+--feedback-column "$$FEEDBACK_COLUMN"} \
	  $${CANVAS_COLUMN:+--canvas-column "$$CANVAS_COLUMN"} $${ACCEPT:+--accept "$$ACCEPT"} \
	  $${SCHEDULER:+--scheduler "$$SCHEDULER"} -- "$$SUBMISSIONS"

check:  ## Check your own package before you submit it: make check [PACKAGE=path] [HINTS=n] [EXPLAIN=1] [ALL=1]
	$(RUN)@$(BOOTSTRAP)
	$(RUN)@$(GRADER) check $(OPTIONS) \
	  $${HINTS:+--hints "$$HINTS"} $${EXPLAIN:+--explain} $${ALL:+--all} $${PACKAGE:+-- "$$PACKAGE"}

fix:  ## Show fixes for your own package, or apply them: make fix [PACKAGE=path] [APPLY=1]
	$(RUN)@$(BOOTSTRAP)
	$(RUN)@$(GRADER) fix $(OPTIONS) $${APPLY:+--apply} $${PACKAGE:+-- "$$PACKAGE"}

validate:  ## Test an assignment with its solution and mutants (ASSIGNMENT=id KEYS=folder)
	$(RUN)@$(BOOTSTRAP)
	$(RUN)@$(GRADER) validate $${DISTRO:+--distro "$$DISTRO"} $${SANDBOX:+--sandbox "$$SANDBOX"} \
	  $${KEYS:+--keys "$$KEYS"} $${ASSIGNMENT:+-- "$$ASSIGNMENT"}

test:  ## Run the tests that need no Docker
	@$(BOOTSTRAP) --tests
	@$(MAKE) --no-print-directory --jobs=2 lint fast

# (the images are made beside the first part: they mostly wait for downloads)
test-all:  ## Run all tests (as root: installs and starts Docker if it is missing)
	@$(BOOTSTRAP) --tests
	@if [ "$${GRADER_TESTS_WITHOUT_DOCKER:-}" = 1 ]; then \
	  echo "make test-all: GRADER_TESTS_WITHOUT_DOCKER=1: the tests that need Docker are skipped" >&2; \
	  $(MAKE) --no-print-directory test && { $(call run_tests,full and not docker and not long); }; \
	else \
	  trap '.venv/bin/python -m tests.engine down' EXIT; \
	  .venv/bin/python -m tests.engine up & engine=$$!; \
	  $(MAKE) --no-print-directory test; tested=$$?; \
	  wait $$engine && [ $$tested = 0 ] && { $(call run_tests,(full or docker) and not long); }; \
	fi

test-long:  ## Run what counts in dozens: every package for real, attacks, kills (as root; part: PYTEST_ARGS=path)
	@$(BOOTSTRAP) --tests
	@trap '.venv/bin/python -m tests.engine down' EXIT; \
	  .venv/bin/python -m tests.engine up all && { $(call run_tests,long); } && \
	  GRADER_TESTS_EVIDENCE=real $(PYTEST) $(RECORDED)

recordings:  ## Record the evidence of the tests' packages anew (three quarters of an hour)
	@$(BOOTSTRAP) --tests
	@rm -rf tests/recordings/evidence
	@GRADER_TESTS_EVIDENCE=record $(PYTEST) $(RECORDED)

# the tests begin as soon as they are compiled, beside the rest of mypy
.PHONY: fast rewritten
fast: rewritten
	@$(PYTEST) -m "not full and not docker and not long" $${PYTEST_ARGS}

# pytest's own compiled form of the tests, once instead of once in each test process
rewritten:
	@found=$$(PYTHONDONTWRITEBYTECODE= .venv/bin/python -m pytest -qq --collect-only -p no:xdist) || \
	  { echo "$$found" >&2; exit 1; }

lint:
	@.venv/bin/python -m ruff check --quiet .
	@.venv/bin/python -m ruff format --quiet --check .
	@.venv/bin/python -m mypy --no-error-summary grader lab tests
	@found=$$(.venv/bin/lint-imports) || { echo "$$found"; exit 1; }
	@.venv/bin/python -m tests.structure

bench:  ## Measure the time of a verdict relative to the bare commands (needs Docker and root)
	@$(BOOTSTRAP) --tests
	@trap '.venv/bin/python -m tests.engine down' EXIT; \
	  .venv/bin/python -m tests.engine up && .venv/bin/python -m tests.bench && \
	  .venv/bin/python -m tests.bench_diagnosis && .venv/bin/python -m tests.bench_matrix && \
	  .venv/bin/python -m tests.bench_class

bench-diagnosis:  ## Measure how failed verdicts are explained, with mutants of every lesson (half an hour)
	@$(BOOTSTRAP) --tests
	@.venv/bin/python -m tests.bench_explained --write docs/diagnosis.md

pictures:  ## Make the README's pictures of the lab and of a marked class (needs root)
	@$(BOOTSTRAP) --tests
	@.venv/bin/python -m tests.pictures

lock:  ## Update the lock files from their .in files (needs uv)
	@sh grader/ros/locks/lock.sh

clean:  ## Remove the environment and build output (keeps the ROS prefixes in the cache)
	rm -rf .venv .venv.lock build install log .mypy_cache .ruff_cache .pytest_cache
