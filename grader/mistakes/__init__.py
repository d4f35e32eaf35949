"""The catalogue of what beginners get wrong, and how each kind is recognised."""
