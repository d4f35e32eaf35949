"""The page of a class: a folder of HTML that opens offline, made of a ClassResult alone."""

from grader.publish.pages.write import write_site

__all__ = ["write_site"]
