"""axe-core, the accessibility checker: fetched by npm once, held to the hash in package-lock.json."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from pathlib import Path
from typing import Any

from playwright.sync_api import Page

from grader.ros.cache import cache_root
from grader.ros.cache import make_once
from tests.site.browser import installed

HERE = Path(__file__).resolve().parent
FILES = ("package.json", "package-lock.json")


def axe_source() -> str:
    """Return the checker's JavaScript; npm refuses what has another hash than the lock says."""
    digest = hashlib.sha256((HERE / FILES[1]).read_bytes()).hexdigest()[:16]
    folder = cache_root() / "npm" / digest
    make_once(folder, _fetch, say=lambda text: None)
    return (folder / "node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")


def _fetch(staging: Path) -> None:
    npm = installed("npm", "npm")
    for name in FILES:
        shutil.copy(HERE / name, staging / name)
    words = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"]
    done = subprocess.run(
        [str(npm), *words], cwd=staging, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise RuntimeError(f"npm ci ended with {done.returncode}:\n{done.stderr[-2000:]}")


def violations(page: Page, source: str) -> list[str]:
    """Return what axe finds on the page with all of its rules, experimental ones too."""
    page.evaluate(source)
    found: dict[str, Any] = page.evaluate(
        """async () => await axe.run(document, {
            runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice",
                      "experimental"],
            resultTypes: ["violations"],
        })"""
    )
    assert len(found["passes"]) > 20, "axe has looked at the page"
    return [
        f"{v['id']}: {v['help']}: {node['html'][:200]}: {node.get('failureSummary', '')[:300]}"
        for v in found["violations"]
        for node in v["nodes"][:3]
    ]
