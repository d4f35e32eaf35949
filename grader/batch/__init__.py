"""A whole class: who handed in what, the verdicts that were reached, and what each is worth."""
