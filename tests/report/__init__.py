"""The report: its schema, its page on terminals, its files."""
