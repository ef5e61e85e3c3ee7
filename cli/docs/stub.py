"""A stand-in for the compiled module of the Python package, to read its docstrings without a build."""

import importlib.machinery
import importlib.util
import sys
from pathlib import Path


def load_stub(name: str, file: Path) -> None:
    """Import a stub (.pyi), with classes and functions that do nothing, as module `name`."""
    loader = importlib.machinery.SourceFileLoader(name, str(file))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.modules[name] = module
    loader.exec_module(module)
