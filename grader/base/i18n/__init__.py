"""Texts in the reader's language: marked with `say` and `msg`, translated by a `Translator`.

`grader.cli.update_translations` gathers what is marked into `ko/LC_MESSAGES/grader.po`.
"""
