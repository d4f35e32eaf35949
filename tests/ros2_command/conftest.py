from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from .surroundings import Surroundings, umask_of_a_student


@pytest.fixture(autouse=True)
def umask() -> Iterator[None]:
    former = umask_of_a_student()
    yield
    os.umask(former)


@pytest.fixture
def jazzy(tmp_path: Path) -> Surroundings:
    surroundings = Surroundings(tmp_path)
    surroundings.build()
    return surroundings


@pytest.fixture
def kilted(tmp_path: Path) -> Surroundings:
    surroundings = Surroundings(tmp_path, distro="kilted")
    surroundings.build()
    return surroundings
