"""The corpus: packages like those of students, with the verdict expected for each."""
