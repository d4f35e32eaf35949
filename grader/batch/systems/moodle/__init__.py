"""Moodle: its download, its worksheet and its gradebook import."""
