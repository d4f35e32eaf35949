"""Assignments: their model, rules, policy and loader, and how a course is found."""
