"""Texts in the reader's language: marked with `say` and `msg`, translated by a `Translator`.

`grader.cli.update_translations` collects the marked texts into `ko/LC_MESSAGES/grader.po`.
"""
