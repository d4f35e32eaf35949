"""What the courses' systems give an instructor to download: one module for each."""
