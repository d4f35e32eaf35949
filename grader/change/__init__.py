"""Changes of a program: operators, each with the reason that explains what it corrects."""
