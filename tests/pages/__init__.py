"""The pages of a class, some tested in a real browser."""
