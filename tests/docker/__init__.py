"""Tests that need the Docker daemon."""
