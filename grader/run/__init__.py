"""Builds and runs one package in a sandbox, and observes the node."""
