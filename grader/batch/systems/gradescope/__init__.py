"""batch.systems.gradescope"""
