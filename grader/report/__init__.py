"""The report: one typed model, and its renderers, each a pure function of it."""
