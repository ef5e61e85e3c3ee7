"""Fixtures for tests with a real Blender or a real browser."""

import os
import shutil

import pytest


@pytest.fixture(scope="session", name="blender")
def _blender() -> str:
    """The Blender on PATH, or the one that BLENDER names."""
    found = os.environ.get("BLENDER") or shutil.which("blender")
    if found is None:
        pytest.fail("no Blender: neither on PATH nor named by BLENDER")
    return found


@pytest.fixture(scope="module", name="browser")
def _browser(tmp_path_factory):
    """Chromium, without a window."""
    from browser import open_browser  # Selenium, which no other test here needs

    browser = open_browser(tmp_path_factory.mktemp("profile"))
    yield browser
    browser.close()
