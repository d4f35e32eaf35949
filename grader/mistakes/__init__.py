"""The catalogue of beginners' mistakes, and how each kind is recognised and fixed."""
