"""batch.systems.canvas"""
