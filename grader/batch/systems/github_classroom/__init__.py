"""batch.systems.github_classroom"""
