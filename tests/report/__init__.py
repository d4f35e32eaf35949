"""The report: its schema, its terminal page, its files."""
