"""The pages of a class: a folder of HTML that opens offline, made from a ClassResult alone."""

from grader.publish.pages.write import write_site

__all__ = ["write_site"]
