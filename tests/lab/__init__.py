"""Tests of the lab, which students use."""
