"""batch.systems.moodle"""
