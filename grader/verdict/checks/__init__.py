"""The checks: one module for each stage, or for a part of one."""
