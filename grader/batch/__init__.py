"""Marks a whole class: submissions, roster, verdicts, policy and corrections."""
