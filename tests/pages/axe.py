"""axe-core, the accessibility checker."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import Page

from tests.installed import npm_packages

HERE = Path(__file__).resolve().parent


def axe_source() -> str:
    """Return the checker's JavaScript."""
    return (npm_packages(HERE) / "axe-core/axe.min.js").read_text(encoding="utf-8")


def violations(page: Page, source: str) -> list[str]:
    """Return axe's findings on the page with all rules, including experimental ones."""
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
