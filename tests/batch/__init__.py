"""A whole class: what is downloaded, and what becomes of it."""
