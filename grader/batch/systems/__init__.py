"""The learning management systems: one package for each, to read and to fill in its files."""
