"""A headless Chromium, to test pages."""

from __future__ import annotations

import base64
import shutil
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.wait import WebDriverWait

from processes import PATIENCE_S

DESKTOP = (1280, 800)
PHONE = (390, 844)


class Browser:
    """Shows one page after another; `scheme` is light or dark."""

    def __init__(self, profile: Path):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "disable-gpu", "hide-scrollbars"):
            options.add_argument(f"--{flag}")
        options.add_argument(f"--user-data-dir={profile}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self._driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))

    def open(
        self, page: Path, size: tuple[int, int] = DESKTOP, scheme: str = "light", fragment: str = ""
    ) -> None:
        """Load a file in a window of this size; a narrow one is a phone's, with touch."""
        width, height = size
        phone = width < 600
        self._command(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 2 if phone else 1, "mobile": phone},
        )
        self._command("Emulation.setTouchEmulationEnabled", {"enabled": phone})
        feature = {"name": "prefers-color-scheme", "value": scheme}
        self._command("Emulation.setEmulatedMedia", {"features": [feature]})
        self.complaints()  # those of the page before
        self._driver.get("about:blank")  # another fragment of a page does not load it again
        self._driver.get(page.resolve().as_uri() + fragment)
        # A busy machine's driver can answer from the blank page before the new one takes its place.
        self.wait_for("location.protocol === 'file:' && document.readyState === 'complete'")

    def run(self, script: str):
        """What a JavaScript function body returns."""
        return self._driver.execute_script(script)

    def wait_for(self, condition: str) -> None:
        """Wait until a JavaScript expression is true."""
        WebDriverWait(self._driver, PATIENCE_S, poll_frequency=0.02).until(
            lambda _: self.run(f"return {condition}"), f"never true: {condition}"
        )

    def press(self, *keys: str) -> None:
        """Press keys one after another; "shift+x" with Shift."""
        for key in keys:
            *held, last = key.split("+") if len(key) > 1 else [key]
            chain = ActionChains(self._driver)
            if held:
                chain.key_down(Keys.SHIFT)
            chain.send_keys(getattr(Keys, last.upper(), last) if len(last) > 1 else last)
            if held:
                chain.key_up(Keys.SHIFT)
            chain.perform()

    def point(self, x_px: float, y_px: float) -> None:
        """Move the mouse to a place of the window."""
        self._command("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x_px, "y": y_px})

    def names(self) -> list[tuple[str, str]]:
        """Role and accessible name of everything that can have the focus."""
        nodes = self._command("Accessibility.getFullAXTree", {})["nodes"]
        return [
            (node["role"]["value"], node.get("name", {}).get("value", ""))
            for node in nodes
            if any(p["name"] == "focusable" and p["value"]["value"] for p in node.get("properties", []))
        ]

    def complaints(self) -> list[str]:
        """Messages on the console since the last call: errors, warnings and all others."""
        return [entry["message"] for entry in self._driver.get_log("browser")]

    def picture(self, file: Path) -> None:
        """Write a PNG of the whole page, as far down as it goes."""
        height = self.run("return document.documentElement.scrollHeight")
        width = self.run("return window.innerWidth")
        clip = {"x": 0, "y": 0, "width": width, "height": height, "scale": 1}
        shot = self._command("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
        file.write_bytes(base64.b64decode(shot["data"]))

    def close(self) -> None:
        """Ends the browser."""
        self._driver.quit()

    def _command(self, name: str, values: dict) -> dict:
        return self._driver.execute_cdp_cmd(name, values)


def open_browser(profile: Path) -> Browser:
    """A browser; where none can be had, the test fails with the reason."""
    for program in ("chromium", "chromedriver"):
        if shutil.which(program) is None:
            pytest.fail(f"no {program} on PATH; install chromium and chromium-driver")
    return Browser(profile)
