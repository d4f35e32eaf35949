"""The corpus: packages as students hand them in, and what each of them deserves."""
