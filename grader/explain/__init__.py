"""`grader explain`: the entries of the catalogue, and what the output of a terminal shows."""
