"""Intake: reads a submission without running or trusting any of it."""
