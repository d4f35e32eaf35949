"""Outputs for other systems, read by those systems' own rules."""
