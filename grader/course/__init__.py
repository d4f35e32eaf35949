"""Assignments as data: the model, its rules, its policy, and where a course is found."""
