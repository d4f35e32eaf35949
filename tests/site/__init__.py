"""The page of a class, looked at in a real browser."""
