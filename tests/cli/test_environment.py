"""What the programs that `veldt` starts see of its environment: the variables of a list, and the system's PATH."""

import subprocess
import sys
from pathlib import Path

import pytest

import fake_blender
import numpy_settings
from configs import tiny
from python_environments import ENVIRONMENTS

PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
HANDED_DOWN = {
    "HOME": "/srv/a b",
    "TMPDIR": "/tmp",
    "LANG": "C.UTF-8",
    "LC_ALL": "C.UTF-8",
    "LANGUAGE": "en",
    "OMP_NUM_THREADS": "2",
    "OPENBLAS_NUM_THREADS": "2",
    "MKL_NUM_THREADS": "2",
}
KEPT = {
    "VIRTUAL_ENV": "/venv",
    "PYTHONPATH": "/junk",
    "PYTHONHOME": "/junk",
    "PYTHONSTARTUP": "/junk/a.py",
    "CONDA_PREFIX": "/conda",
    "PYENV_VERSION": "3.7.1",
    "LD_LIBRARY_PATH": "/junk",
    "BLENDER_USER_SCRIPTS": "/junk",
    "BLENDER_SYSTEM_PYTHON": "/junk",
    "OCIO": "/junk/config.ocio",
    "DISPLAY": ":7",
    "USER": "somebody",
}


# Columns of an array that ends where the result begins: some versions of NumPy then call the C library's functions
# instead of their own, and the results of the two differ in the last bit.
SAME_BITS = """
import numpy as np

ROWS = 64
for function, count in (np.sin, 1), (np.cos, 1), (np.tan, 1), (np.arcsin, 1), (np.arctan2, 2), (np.exp, 1), (np.power, 2):
    memory = np.zeros(4 * ROWS)
    table = memory[: 3 * ROWS].reshape(ROWS, 3)
    table[:] = np.random.default_rng(1).uniform(0.01, 1, table.shape)
    columns = [table[:, 2 - k] for k in range(count)]
    apart = function(*(column.copy() for column in columns))
    if not np.array_equal(function(*columns, out=memory[3 * ROWS :]), apart):
        print(function.__name__)
"""


def _noting(veldt, name: str, instead_of: str) -> Path:
    """A program that notes the environment it was started with, as the system has it, and becomes another."""
    notes = veldt.folder / f"{name}_environment"
    program = veldt.write(
        name, f'#!/bin/sh\ntr "\\0" "\\n" </proc/$$/environ >"{notes}"\nexec "{instead_of}" "$@"\n'
    )
    program.chmod(0o755)
    return program


def _noted(veldt, name: str) -> dict:
    lines = (veldt.folder / f"{name}_environment").read_text(encoding="utf-8").splitlines()
    return dict(line.split("=", 1) for line in lines)


def _generate(veldt, env: dict):
    """Runs with a Blender and a Python that note their environments."""
    veldt.write("config.json", tiny())
    blender = _noting(veldt, "blender", str(fake_blender.install(veldt.folder)))
    env = env | {"VELDT_PYTHON": str(_noting(veldt, "python", sys.executable))}
    return veldt("generate", "config.json", "--out", "out", "--blender", blender, "--quiet", env=env)


def test_blender_and_python_see_the_variables_of_the_list_and_no_other(veldt):
    done = _generate(veldt, HANDED_DOWN | KEPT)
    assert (done.code, done.out, done.err) == (0, "", "")
    expected = HANDED_DOWN | {"PATH": PATH} | numpy_settings.REPRODUCIBLE
    locale = {name: value for name, value in _noted(veldt, "blender").items() if name.startswith("LC_")}
    assert _noted(veldt, "blender") == expected | locale  # the tests may run under LC_CTYPE or the like
    assert _noted(veldt, "python") == expected | locale


@pytest.mark.parametrize("settings", [{}, {"NPY_DISABLE_CPU_FEATURES": ""}], ids=["unset", "empty"])
def test_numpy_gives_the_same_bits_wherever_arrays_lie(veldt, settings):
    done = _generate(veldt, settings)
    assert (done.code, done.err) == (0, "")
    for name in ("blender", "python"):
        python = [sys.executable, "-I", "-c", SAME_BITS]
        seen = subprocess.run(python, env=_noted(veldt, name), capture_output=True, text=True, check=True)
        assert (seen.stdout, seen.stderr) == ("", "")


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_the_planning_python_is_the_systems(veldt, tmp_path_factory, name):
    """Whatever Python is first on PATH: it is found, reported and run as everywhere else."""
    env = ENVIRONMENTS[name](tmp_path_factory.mktemp(name) / "prefix")
    usual = veldt("doctor", "--json")
    report = {finding["what"]: finding["found"] for finding in veldt("doctor", "--json", env=env).json()}
    assert report == {finding["what"]: finding["found"] for finding in usual.json()}
    assert report["Python"].endswith(", /usr/bin/python3")
    veldt.write("config.json", tiny())
    done = veldt("generate", "config.json", "--out", "out", "--dry-run", env=env)
    assert (done.code, done.err) == (0, "")
