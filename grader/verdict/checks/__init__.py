"""The checks: one module for each stage."""
