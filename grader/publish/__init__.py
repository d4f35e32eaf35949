"""What goes back into other systems: one module a format, each a pure function of a result."""
