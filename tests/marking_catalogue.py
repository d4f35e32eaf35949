"""A catalogue for tests that marks what it translates: `<template>`."""

from __future__ import annotations

import gettext


class MarkingCatalogue(gettext.NullTranslations):
    """Returns every template in angle brackets."""

    def gettext(self, message: str) -> str:
        return f"<{message}>"
