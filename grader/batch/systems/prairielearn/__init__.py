"""batch.systems.prairielearn"""
